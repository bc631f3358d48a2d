#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Logs of both couplings, read as foamLog and pyFoam do: each query finds one number per step, each
# "Solving for" line has their form, and no other line counts as a time
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
steps=4

# extract name regex text: "step value" for every hit, as foamLog's generated awk does
extract() {
    awk -v sel="$3" "/^[ \\t]*Time = /"' { ++step }
        /'"$2"'/ { rest = substr($0, index($0, sel) + length(sel)); split(rest, v, " "); gsub(/[,:]/, "", v[1]); print step + 0, v[1] }' log
}
check() { # name of the run
    local name regex text values residual='[-+0-9.e]+'
    while IFS=/ read -r name regex text; do
        values=$(extract "$name" "$regex" "$text")
        [ "$(wc -l <<< "$values")" = $steps ] || fail "$1: $name: $(wc -l <<< "$values") values in $steps steps"
        awk '$2 !~ /^[-+]?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?$/ { exit 1 }' <<< "$values" || fail "$1: $name: $values"
    done < <(grep -v '^#' "$cases/foamLog.db")
    [ "$(grep -c 'Time = ' log)" = $((2*steps)) ] || fail "$1: lines with 'Time = ' beside a step's two"
    [ "$(grep -cE '^Time = [^ ]+$' log)" = $steps ] || fail "$1: pyFoam's time line"
    grep -qE "^ExecutionTime = [^ ]+ s  ClockTime = [^ ]+ s$" log || fail "$1: ExecutionTime"
    [ "$(grep -c 'Solving for' log)" -ge $steps ] || fail "$1: nothing is solved for"
    grep 'Solving for' log |
        grep -vE "^[A-Za-z]+:  Solving for [A-Za-z]+, Initial residual = $residual, Final residual = $residual, No Iterations [0-9]+$" &&
        fail "$1: lines foamLog cannot read"
    # times and steps are those of the run
    [ "$(extract Time '^Time = ' 'Time = ' | awk '{ printf "%s ", $2 }')" = "0.01 0.02 0.03 0.04 " ] || fail "$1: times"
    [ "$(tail -n 1 log)" = End ] || fail "$1: End"
    # the times of all stages and function objects add up to the run
    sed -n '/^Stages of the run/,/^$/p' log > table
    for stage in start neighbours "rest of the steps" "function object speed"; do
        grep -qE "^    $stage +[0-9.]+ s +[0-9.]+ % +[-0-9.]+ +[-0-9]+ +[-0-9.]+ +-$" table ||
            fail "$1: no time of $stage: $(cat table)"
    done
    grep -qE "^    operators .* % +[0-9.]+ +[0-9]+ +[0-9.]+ +-$" table || fail "$1: no work of the operators: $(cat table)"
    awk '/^    / && !/together/ { s += $(NF - 7); share += $(NF - 5); pairs += $(NF - 3); iterations += $(NF - 2) }
        /together/ { whole = $(NF - 7); allPairs = $(NF - 3); allIterations = $(NF - 2) }
        END { exit !((s - whole)^2 < 0.1^2 && (share - 100)^2 < 1 && iterations == allIterations &&
                     (pairs - allPairs)^2 < (0.01*allPairs)^2) }' table || fail "$1: what does not add up: $(cat table)"
}
for case in "piston projection" "piston monolithic" "membrane monolithic"; do
    read -r template coupling <<< "$case"
    newCase "$template" "$template-$coupling"; place
    setEntry system/controlDict endTime 0.04; setEntry system/controlDict deltaT 0.01
    setEntry system/sphSolution coupling "$coupling"
    echo "functions { speed { type minMax; fields (U); } }" >> system/controlDict
    solved
    check "$case"
done
[ $failures = 0 ]
