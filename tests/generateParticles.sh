#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# generateParticles on a small STL case, then on what people get wrong: each a clear error, status 1,
# and no particles
set -uo pipefail
cd "$(dirname "$0")/.."
root=$PWD
PATH=$PWD/$ISPF_BIN:$PATH
export OMP_NUM_THREADS=1
failures=0
fail() { echo "  FAILED: $1"; failures=$((failures+1)); }
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
mkdir system constant
echo "walls { type wall; }" > constant/boundary

# A cube of 10 mm; $1: triangles left out at the end
cube() {
    local n=$((12 - ${1:-0}))
    awk -v n="$n" 'BEGIN {
        print "solid water"
        split("0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5", c, " ")
        for (t = 0; t < n; ++t) {
            print "facet normal 0 0 0\nouter loop"
            for (k = 1; k <= 3; ++k) { i = c[3*t + k]; print "vertex", 10*(i%2), 10*(int(i/2)%2), 10*int(i/4) }
            print "endloop\nendfacet" }
        print "endsolid water" }' > constant/cube.stl
}
# zone entry [dx [further entries]]
dict() { echo "dx ${2:-1e-3}; placement lattice; zones { water { phase fluid; $1 } } ${3:-}" > system/particleDict; }
# refused "what" words...: status 1, every word in the text, no particles
refused() {
    local what=$1 word; shift
    rm -rf 0
    generateParticles > out 2>&1
    [ $? = 1 ] || fail "$what: status"
    [ ! -e 0/particles.hdf ] || fail "$what: particles were written"
    for word in "$@"; do grep -qF -- "$word" out || fail "$what: no '$word' in: $(tail -n 8 out)"; done
}
stl='file "constant/cube.stl"; unit mm;'
igs="file \"$root/tutorials/ispfFsiFoam/hemisphereCappedCylinder/constant/geometry/hccB.igs\";"

cube
dict "$stl"
generateParticles > out 2>&1 && grep -q '^water .* 1000  *+0.00' out || fail "a cube: $(cat out)"

# Velocity and pressure at the start, by formulas
dict "$stl U (\"10*x - y\" 2 \"sin(pi*z/0.02)\"); p \"dx*sqrt(x*x)\";"
generateParticles > out 2>&1 || fail "initial fields: $(tail -n 5 out)"
columns() { h5dump -m %.12g -y -w 1 -d "/VTKHDF/$1" 0/particles.hdf | tr -d ' ,' | grep -E '^[-0-9.e+]+$'; }
columns Points > points; columns PointData/U > U; columns PointData/p > p
[ "$(wc -l < U)" = 3000 ] && [ "$(wc -l < p)" = 1000 ] || fail "initial fields: $(wc -l < U) $(wc -l < p)"
paste <(paste - - - < points) <(paste - - - < U) p | awk '
    function off(a, b) { return (a - b)^2 > 1e-18 }
    off($4, 10*$1 - $2) || off($5, 2) || off($6, sin(atan2(0, -1)*$3/0.02)) || off($7, 1e-3*$1) { bad = 1 }
    END { exit bad }' || fail "initial fields: not the formulas"
dict "$stl p \"rho*x\";"
refused "unknown name in a formula" "rho" "Valid names are:" "dx" "pi" "sqrt" "particleDict"
dict "$stl U (1 2);"
refused "two components" "three formulas"
dict "$stl p \"1 + \";"
refused "broken formula" "1 + "
dict "$stl p \"sqrt(x - 0.005)\";"
refused "formula without a finite value" "nan at (0.0005"

dict 'file "constant/missing.stl"; unit mm;'
refused "missing file" "no geometry file" "constant/missing.stl"
echo nonsense > constant/cube.xyz
dict 'file "constant/cube.xyz";'
refused "unknown type" "cube.xyz" ".igs" ".stl"
dict 'file "constant/cube.stl";'
refused "no unit" "unit" "cube.stl"
dict 'file "constant/cube.stl"; unit furlong;'
refused "unknown unit" "furlong" "mm" "inch"
dict "$igs unit inch;"
refused "unit of a file that has its own" "declares its own unit"
dict 'file "constant/cube.stl"; unit um;'
refused "wrong unit" "could not hold a particle" "unit"
dict "$igs colour (1 2 3);" 5e-3
refused "colour that no face has" "colour (1 2 3)" "with the colours" "(255 153 0)"
[ "$(grep -o "with the colours.*" out | grep -o "(" | wc -l)" = 6 ] || fail "colours: not all are listed"
dict "$stl group wine;"
refused "group that no face has" "group wine"
dict "$stl" 1e-3 "patches { lid { faces (1); } }"
refused "patch that constant/boundary has not" "lid" "walls"
dict "$stl colur (1 2 3);"
refused "misspelt entry" "colur"
dict "phase2 x;"
refused "zone without shape" "file or a shape"
cube 1
dict "$stl"
refused "leaky surface" "not closed" "water"
: > constant/cube.stl
refused "empty file" "cube.stl"
printf 'IGES\n' > constant/cube.igs
dict 'file "constant/cube.igs";'
refused "broken IGES" "cube.igs"
[ $failures = 0 ]
