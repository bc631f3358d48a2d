#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The short tutorials end with the numbers that they are there for; the cavity coarser than as it stands
set -uo pipefail
. "$(dirname "$0")/cases/functions"
export ISPF_DIR=$cases/../..  # they are copies out of the tree
run() { # tutorial picture [file entry value]...
    rm -rf "${scratch:?}/$1"
    cp -r "$ISPF_DIR/tutorials/ispfFsiFoam/$1" "$scratch/"
    cd "$scratch/$1" || exit 1
    local name=$1 picture=$2; shift 2
    while [ $# -gt 0 ]; do setEntry "$1" "$2" "$3"; shift 3; done
    ./Allclean && ./Allrun > out 2>&1 || fail "$name: $(tail -n 8 out)"
    [ -s "comparison/$picture.png" ] || fail "$name: no picture"
}
below() { # what value limit
    awk -v v="$2" -v most="$3" 'BEGIN { exit !(v != "" && v*v < most*most) }' || fail "$1: $2"
}
number() { awk -v key="$1" 'at = index($0, key) { split(substr($0, at + length(key)), word, " "); print word[1]; exit }' comparison/table.txt; }

run taylorGreen taylorGreen
below "Taylor-Green [%]" "$(number 'largest difference ')" 1
run taylorGreen taylorGreen system/sphSolution coupling monolithic
below "Taylor-Green, monolithic [%]" "$(number 'largest difference ')" 1
grep -q "^coupling: monolithic" log.ispfFsiFoam || fail "not monolithic"
run poiseuille poiseuille
awk '$1 + 0 > 0 { ++n; worse += $4*$4 > 0.7^2 } END { exit n != 5 || worse }' comparison/table.txt ||
    fail "Poiseuille: $(cat comparison/table.txt)"
run hydrostaticBox hydrostaticBox
below "speed at rest [m/s]" "$(number 'largest speed in 1 s ')" 1e-6
below "hydrostatic pressure" "$(number 'rho g (1/2 - z)')" 1e-9
run lidDrivenCavity lidDrivenCavity system/particleDict dx 0.05 system/controlDict deltaT 0.02
below "cavity, u" "$(number 'u on x = 1/2: root mean square of the difference ')" 0.03
below "cavity, v" "$(number 'v on y = 1/2: root mean square of the difference ')" 0.03
[ $failures = 0 ]
