#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A pattern in constant/boundary stands for the patches that it matches, as in OpenFOAM: the case has the same particles and the
# same result, bit by bit, as with an entry for each patch.  An entry of its own wins; a pattern without a patch is refused
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir system constant constant/triSurface
echo "coupling projection;" > system/sphSolution
: > system/sphSchemes
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
echo "startTime 0; endTime 0.02; deltaT 0.01; writeControl timeStep; writeInterval 2;" > system/controlDict
# an open duct of 8 x 8 x 12 mm: its two ends are capped as cap0 and cap1
awk 'function t(a, b, c) { print "facet normal 0 0 0\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet" }
    BEGIN { print "solid duct"; split("0 0,8 0,8 8,0 8,0 0", p, ",")
        for (k = 1; k < 5; ++k) { t(p[k] " 0", p[k+1] " 0", p[k+1] " 12"); t(p[k] " 0", p[k+1] " 12", p[k] " 12") }
        print "endsolid duct" }' > constant/duct.stl
echo 'dx 1e-3; zones { water { phase fluid; file "constant/duct.stl"; unit mm; capping automatic; } }' > system/particleDict
# run name boundary: makes the particles and solves
run() {
    rm -rf 0 0.* constant/triSurface constant/*.hdf
    echo "$2" > constant/boundary; place; solved
    mkdir -p "$1"; cp -r 0 0.02 "$1"
}
run literal 'walls { type wall; } cap1 { type open; p 0; } cap0 { type open; p 5; }'
run pattern 'walls { type wall; } "cap.*" { type open; p 5; } cap1 { type open; p 0; }'
[ -s constant/triSurface/cap0.stl ] && [ -s constant/triSurface/cap1.stl ] || fail "caps: $(ls constant/triSurface)"
cmp -s literal/0/particles.hdf pattern/0/particles.hdf || fail "other particles with a pattern"
same literal/0.02 pattern/0.02 "another result with a pattern"
run sorted 'walls { type wall; } "cap.*" { type open; p 2; } "cap0|lid" { type open; p 5; }'
run literalSorted 'walls { type wall; } cap0 { type open; p 5; } cap1 { type open; p 2; }'
same literalSorted/0.02 sorted/0.02 "another result with two patterns"
run every '".*" { type open; p 2; } cap0 { type open; p 5; } "wal+s" { type wall; }'
cmp -s every/0/particles.hdf literalSorted/0/particles.hdf || fail "other particles where the walls have a pattern"
# faces that the particleDict names
echo 'dx 1e-3; nDims 2; zones { water { phase fluid; shape box; min (0 0 0); max (12e-3 8e-3 0); } }
    patches { capIn { box ((-1e-4 -1 -1) (1e-4 1 1)); } capOut { box ((11.9e-3 -1 -1) (12.1e-3 1 1)); } }' > system/particleDict
run box '"cap.*" { type open; p 2; } "w.*" { type wall; }'
[ "$(ls constant/triSurface | paste -sd ' ')" = "capIn.stl capOut.stl walls.stl" ] || fail "patches: $(ls constant/triSurface)"
# surfaces of an earlier run that this one does not make are removed; those of the user stay
cp constant/triSurface/capOut.stl constant/triSurface/own.stl
sed -i 's/capOut/capEnd/' system/particleDict; rm -rf 0 0.*; place; solved
[ "$(ls constant/triSurface | paste -sd ' ')" = "capEnd.stl capIn.stl own.stl walls.stl" ] || fail "old surfaces: $(ls constant/triSurface)"
sed -i 's/capEnd/capOut/' system/particleDict; run box '"cap.*" { type open; p 2; } "w.*" { type wall; }'
grep -q "capIn" log && grep -q "capOut" log || fail "the log has no flux through the caps"
echo '"cap.*" { type open; p 2; } "w.*" { type wall; } "lid.*" { type wall; }' > constant/boundary
solve && fail "a pattern without a patch is accepted"
grep -q "Nothing reads the dictionary 'lid.\*'" log || fail "a pattern without a patch: $(tail -n 5 log)"
[ $failures = 0 ]
