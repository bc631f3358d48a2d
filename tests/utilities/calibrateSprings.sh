#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# calibrateSprings fails if a requested modulus is not reached; without a requested modulus it judges none
set -uo pipefail
. "$(dirname "$0")/../cases/functions"

newCase membrane calibrated
place
calibrated() { # links status verdict
    echo "structureModel springNetwork; $1" > constant/structureProperties
    calibrateSprings -layers 4 > log 2>&1; local status=$?
    [ $status = "$2" ] || fail "$1 exit status $status"
    grep -q "$3" log || fail "$1 $(tail -n 3 log)"
}
calibrated "E 1e4; links radius; radius 2.1;" 0 ": within 0.95 to 1.05"
calibrated "E 1e4; links radius; radius 1.42;" 1 ": NOT within"
calibrated "k_e 1e4; links lattice8;" 0 "not judged"
# E is the modulus at rest, without what is added along fibres
tissue="E 1e4; links radius; radius 2.1; stiffening 5; fibreWeight 3; fibres { type uniform; directions ((1 0 0)); }"
calibrated "$tissue" 0 ": within 0.95 to 1.05"
grep -q "without the weights of their fibres" log && grep -q "stiffening 5" log || fail "fibres: $(head -n 20 log)"

# -response: the modulus of 18 springs is 3 k/dx, that of a slab of three layers 5/6 of it; hByDx is that of the case
mkdir -p response/system response/constant; cd response || exit 1
echo "hByDx 1.5;" > system/sphSchemes
echo "structureModel springNetwork; links lattice18; k_e 1e4;" > constant/structureProperties
asked="lattice cubic; layers (0 3); directions ((1 0 0)); motions (uniaxial); stretches (1.2);"
echo "$asked" > system/calibrateSpringsDict
calibrateSprings -response > log 2>&1 || fail "-response: $(tail -n 3 log)"
awk -F, 'NR > 1 { print $1, $4 }' postProcessing/calibrateSprings/moduli.csv > moduli
awk '{ wanted = 4.5e4*($1 == 0 ? 1 : 5/6); bad += ($2/wanted - 1)^2 > 1e-12 } END { exit NR != 2 || bad }' moduli ||
    fail "moduli: $(cat moduli)"
[ "$(wc -l < postProcessing/calibrateSprings/response.csv)" = 3 ] || fail "response.csv"
refused() { # what is said, changed entry
    echo "$asked $2" > system/calibrateSpringsDict
    calibrateSprings -response > log 2>&1 && fail "accepted: $2"
    grep -q -- "$1" log || fail "$2: $(tail -n 5 log)"
}
refused "cubic square triangular" "lattice hexagonal;"
refused "Slabs have 2 to 100 layers" "layers (1);"
refused "equibiaxial" "motions (biaxial);"
refused "no direction of a cubic lattice" "directions ((0 0 0));"
refused "lies in the plane" "lattice square; directions ((1 0 1));"
refused "from 0.2 to 5" "stretches (-1);"
refused "Nothing reads the entry 'strech'" "strech 1;"
[ $failures = 0 ]
