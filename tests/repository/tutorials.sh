#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every tutorial runs in a short form, and a failure is reported; tests/repository/validation.sh runs them in full
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
runs=$cases/../../bin/ispfRunTutorials
# every tutorial runs in a short form; a tutorial that fails is reported, for each reason
"$runs" -folder "$scratch/short" || fail "shortened tutorials"
broken() { # what is said, command that breaks a copy of the tree
    rm -rf "$scratch/tree"; mkdir -p "$scratch/tree/tutorials/ispfFsiFoam"
    cp -r "$ispfRoot/bin" "$ispfRoot/etc" "$scratch/tree/"
    cp -r "$ispfRoot/tutorials/ispfFsiFoam/hydrostaticBox" "$scratch/tree/tutorials/ispfFsiFoam/"
    cd "$scratch/tree/tutorials/ispfFsiFoam/hydrostaticBox" && ./Allclean > /dev/null 2>&1 || exit 1
    eval "$2"
    "$scratch/tree/bin/ispfRunTutorials" -steps 4 > "$scratch/out" 2>&1 && fail "passed: $2"
    grep -qE -- "$1" "$scratch/out" || fail "'$1' is not said: $(cat "$scratch/out")"
}
export ISPF_BIN=${ISPF_BIN:-$ispfRoot/build/${OPT:-Release}/bin}
broken "Unknown coupling 'none'" "setEntry system/sphSolution coupling none"
broken "log.ispfFsiFoam reached 0.02 of 0.04 s" "sed -i 's/^runApplication ispf.*/&; sed -i s,0.04,0.02,g log.ispfFsiFoam/' Allrun"
broken "log.generateParticles has no End" "sed -i 's/^runApplication ispf.*/sed -i s,End,, log.generateParticles; &/' Allrun"
broken "comparison/hydrostaticBox.png was not made" "sed -i '/^runComparison/s/.*/mkdir comparison; validation\/compare/' Allrun"
broken "[Ww]arning" "sed -i 's/kPa/&/; \$a plot \"nothing\"' validation/plot.gp"
broken "Allclean does not leave" "echo > Allclean"
broken "no tutorial|Allrun failed" "rm system/particleDict"
# steps with units, of awkward lengths, and an end between two of them: the right number of steps and no failure
variant() { # what is said of the run (pattern), number of steps, lines of controlDict, options...
    local said=$1 steps=$2 log
    rm -rf "$scratch/tree" "$scratch/run"; mkdir -p "$scratch/tree/tutorials/ispfFsiFoam"
    cp -r "$ispfRoot/bin" "$ispfRoot/etc" "$scratch/tree/"
    cp -r "$ispfRoot/tutorials/ispfFsiFoam/hydrostaticBox" "$scratch/tree/tutorials/ispfFsiFoam/"
    cd "$scratch/tree/tutorials/ispfFsiFoam/hydrostaticBox" && ./Allclean > /dev/null 2>&1 || exit 1
    echo "$3" >> system/controlDict
    "$scratch/tree/bin/ispfRunTutorials" "${@:4}" -folder "$scratch/run" > "$scratch/out" 2>&1
    grep -q -- "$said" "$scratch/out" || fail "$3: $(cat "$scratch/out")"
    log=$scratch/run/ispfFsiFoam/hydrostaticBox/log.ispfFsiFoam
    [ "$(grep -c '^Time = ' "$log")" = "$steps" ] || fail "$3: $(grep '^Time = ' "$log" | tail -n 1)"
}
variant "0 failed" 5 "deltaT 1.25 [ms];" -steps 5
variant "0 failed" 3 "deltaT 1.234567e-3;" -steps 3
variant "0 failed" 3 "deltaT 0.02 [s]; endTime 1e-3 [min]; startTime 0 [ms]; adjustTimeStep yes; writeControl timeStep; writeInterval 1;" -full
variant "0 failed" 3 "deltaT 2 [ms]; endTime 0.0069; writeControl timeStep; writeInterval 1;" -full
variant "reached 0.004 of 0.0071 s" 2 "deltaT 2 [ms]; endTime 0.0071; stopAt nextWrite; writeControl timeStep; writeInterval 2;" -full
variant "reached 0.006 of 0.008 s" 3 "deltaT 2 [ms]; endTime 8 [ms]; stopAt nextWrite; writeControl timeStep; writeInterval 3;" -full
[ $failures = 0 ]
