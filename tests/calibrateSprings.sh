#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# calibrateSprings fails where a modulus that is asked for is missed, and judges none where none is asked for
set -uo pipefail
. "$(dirname "$0")/cases/functions"

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
[ $failures = 0 ]
