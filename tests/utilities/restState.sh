#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A solid placed in another shape than its shape at rest: the files that generateParticles writes, the maps that it refuses,
# and a run that continues from such a state as if it had not stopped
set -uo pipefail
. "$(dirname "$0")/../cases/functions"

tutorial=$ispfRoot/tutorials/ispfFsiFoam/relaxingRing
cp -r "$tutorial" "$scratch/ring" && cd "$scratch/ring" || exit 1
dict=system/particleDict
setEntry $dict dx 0.4e-3
place
columns() { h5dump -m %.12g -y -w 1 -d "/VTKHDF/PointData/$1" 0/particles.hdf | sed '/ATTRIBUTE/,$d' | tr -d ' ,' | grep -E '^[-0-9.e+]+$'; }
columns x0 | paste - - - > x0; columns zone > zone
# between circles of 5 and 8 mm, half a particle off; fluid has no rest state
paste x0 zone | awk '$4 == 1 { bad = bad || $1 || $2 || $3; next } { r = sqrt($1^2 + $2^2); ++n; bad = bad || r < 5.1e-3 || r > 7.9e-3 || $3 }
    END { exit bad || n < 150 }' || fail "rest positions: $(head -n 3 x0)"
awk '/vertex/ { r = sqrt($2^2 + $3^2); ++n; bad = bad || r < 4.98e-3 || r > 5.02e-3 } END { exit bad || n < 30 }' \
    constant/triSurface/wall_to_lumen.stl || fail "the surface is not at rest"

refusedRest() { # what, entry, words
    cp $dict kept
    ispfDictionary $dict -entry "zones.$2" -set "$3" > /dev/null || fail "$1: cannot be set"
    rm -rf 0; generateParticles > out 2>&1; local status=$?
    [ $status = 1 ] && [ ! -e 0/particles.hdf ] || fail "$1: exit status $status"
    for words in "${@:4}"; do grep -q "$words" out || fail "$1: no '$words': $(tail -n 8 out)"; done
    mv kept $dict
}
refusedRest "a rest state 3 % larger" wall.rest '("1.03*x" y 0)' "incompressible" "particleDict"
refusedRest "a rest state 3 % smaller" wall.rest '("0.97*x" y 0)' "incompressible" "particleDict"
refusedRest "a rest state that is not symmetric" wall.rest '("x + 2e-6" y 0)' "symmetry plane" "particleDict"
refusedRest "two formulas" wall.rest '("x" y)' "three formulas"
refusedRest "a rest state out of the plane" wall.rest '(x y 1e-3)' "must not point along z"
refusedRest "a fluid's rest state" lumen.rest '(x y 0)' "Only what is solid"
refusedRest "a formula with a wrong word" wall.rest '("foo*x" y 0)' "foo"
cp constant/boundary keptBoundary; echo 'top { type wall; surface plane; point (0 0.1 0); normal (0 1 0); clamps (wall); }' >> constant/boundary
generateParticles > out 2>&1 && fail "clamped by a wall" || grep -q "A wall of constant/boundary clamps zone wall" out || fail "clamped by a wall: $(tail -n 5 out)"
mv keptBoundary constant/boundary

# A continued run
place
control=system/controlDict
for entry in "deltaT 4e-3" "endTime 0.08" "writeInterval 0.04" "writeFormat hdf5"; do read -r key value <<< "$entry"; setEntry $control "$key" "$value"; done
solved
cp -r . ../continued && cd ../continued || exit 1
rm -r 0.08; solved
same 0.08 ../ring/0.08 "ten steps from a state with another rest state"
awk 'NR > 3 && $1 > 0 { last = $2 } END { exit !(last > 1.13e-4 && last < 1.22e-4) }' postProcessing/lumen/*/cavityVolume.dat || fail "area inside"
[ $failures = 0 ]
