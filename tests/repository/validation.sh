#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The quick tier: tutorials compared with their references; errors are reported as FAIL
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
validate=$cases/../../bin/ispfValidate
export ISPF_BIN=${ISPF_BIN:-$ispfRoot/build/${OPT:-Release}/bin}

"$validate" -tier quick -folder "$scratch/quick" || fail "quick tier"
[ "$(head -n 1 "$scratch/quick/summary.csv")" = \
    "case,quantity,reference,value,unit,error,tolerance,status,tier,particles,steps,cpuSeconds" ] || fail "summary's header"
for tutorial in $("$validate" -tier quick -list | cut -d ' ' -f 1 | sort -u); do
    grep -q "^$(basename "$tutorial")/.*,pass,quick," "$scratch/quick/summary.csv" || fail "$tutorial is judged nowhere"
done

# the last page of the report has a line for every tutorial with expected errors
sed -n '/^# What to expect/,$p' "$scratch/quick/report.md" > "$scratch/page"
for family in couette hydrostaticBox stirredRing womersley; do
    grep -qE "^\| $family \| .* \| \*[^ ]+\* [0-9.e-]+ \([0-9]+, [0-9.]+ s\)" "$scratch/page" || fail "not on the last page: $family"
done
[ "$(wc -l < "$scratch/page")" -le 60 ] || fail "the last page has $(wc -l < "$scratch/page") lines"

# a tree with one tutorial, broken in each way
hydrostatics=../../../bin/tools/hydrostatics.py
broken() { # status pattern-of-what-is-said command that changes the tutorial [options]
    rm -rf "$scratch/tree"; mkdir -p "$scratch/tree/tutorials/ispfFsiFoam"
    cp -r "$ispfRoot/bin" "$ispfRoot/etc" "$scratch/tree/"
    cp -r "$ispfRoot/tutorials/ispfFsiFoam/hydrostaticBox" "$scratch/tree/tutorials/ispfFsiFoam/"
    cd "$scratch/tree/tutorials/ispfFsiFoam/hydrostaticBox" && ./Allclean > /dev/null 2>&1 || exit 1
    echo "rest quick system/controlDict endTime 0.05; system/controlDict writeInterval 0.05" > validation/variants
    eval "$3"
    "$scratch/tree/bin/ispfValidate" -tier quick "${@:4}" > "$scratch/out" 2>&1
    [ $? = "$1" ] || fail "status is not $1: $3: $(cat "$scratch/out")"
    grep -qE -- "$2" "$scratch/out" || fail "'$2' is not said: $(cat "$scratch/out")"
}
broken 0 "5 quantities of 1 runs, 0 FAIL" ""
broken 1 "largest speed.*FAIL" "sed -i 's/1e-6 if/-1 if/' $hydrostatics"
broken 1 "largest error of p.*FAIL" "sed -i 's/rho \* dot(row/1.01 * &/' $hydrostatics"
# the end time does not matter; values from before the first step are not judged
short="rest quick system/controlDict endTime 0.05"
broken 0 "5 quantities of 1 runs, 0 FAIL" "echo '$short' > validation/variants"
for none in depth extremes; do
    broken 1 "rest: FAIL, Allrun failed" "echo '$short; system/controlDict functions.$none.writeControl writeTime' > validation/variants"
    grep -qE "functions.$none .*(no time after the first|no) step" "$scratch/tree/validation/.state/ispfFsiFoam/hydrostaticBox/rest/complaints" || fail "$none: no reason"
done
broken 1 "largest speed.*nan .*FAIL" "sed -i 's|rows\[-1\]\[5\] /|math.nan /|' $hydrostatics"
broken 1 "the run .*FAIL" "sed -i 's/^runComparison/true/' Allrun"
broken 1 "rest: FAIL, Allrun failed: .*'none'.*/out" "setEntry system/sphSolution coupling none"
grep -q "Allrun failed: .*'none'.*complaints" "$scratch/tree/validation/report.md" || fail "the report does not say why: $(cat "$scratch/tree/validation/report.md")"
broken 1 "rest: FAIL, Allrun failed" "sed -i 's/report = /1 + &/' $hydrostatics"
broken 1 "reached 0.02 of 0.05 s" "sed -i 's/^runApplication ispf.*/&; sed -i s,0.05,0.02,g log.ispfFsiFoam/' Allrun"
broken 1 "no picture was made" "sed -i '/^out/s/.*/&; exit/' validation/plot.gp"
broken 1 "rest: FAIL, Allrun failed" "echo 'rest quick system/controlDict endTimes 0.05' > validation/variants"
broken 1 "rest: FAIL, .*system/sphDict" "echo 'rest quick system/sphDict coupling monolithic' > validation/variants"
broken 1 "no tier 'fast'|of tier 'fast'; valid: quick validate validateLong" "echo 'rest fast' > validation/variants"
broken 1 "there is no tutorial 'nothing'" "" nothing
broken 1 "unknown option '-tiers'; valid" "" -tiers
broken 1 "rest: FAIL, .*compare, line [0-9]*: OSError" "sed -i 's/^sys.exit(\(.*\))/\1; raise OSError/' validation/compare"
broken 1 "rest: FAIL, it is running already" "mkdir -p ../../../validation/.state/ispfFsiFoam/hydrostaticBox/rest; flock ../../../validation/.state/ispfFsiFoam/hydrostaticBox/rest/lock sleep 60 & sleep 0.5" -jobs 2
kill %1
# results of runs in the tutorial's own folder do not count
broken 0 "5 quantities of 1 runs, 0 FAIL" "printf 'deltaT = 1\nTime = 0.05\nEnd\n' > log.ispfFsiFoam; mkdir 0.05 comparison" hydrostaticBox hydrostaticBox
broken 0 "5 quantities of 1 runs, 0 FAIL" "printf %s \"\$(cat validation/variants)\" > validation/variants"
broken 1 "study .*FAIL" "printf '#!/bin/sh\nexit 1\n' > validation/study; chmod +x validation/study"

# a finished run is not repeated; an interrupted run continues, and the steps of both parts are counted
broken 0 "0 FAIL" "echo 'rest quick system/controlDict endTime 2; system/controlDict writeInterval 1' > validation/variants"
validate=$scratch/tree/bin/ispfValidate results=$scratch/tree/validation
"$validate" -tier quick > "$scratch/out" 2>&1
grep -q "has ended before" "$scratch/out" || fail "run again: $(cat "$scratch/out")"
cp "$results/summary.csv" "$scratch/once.csv"
# a finished run with a changed judgement is compared again, but not run again
solved=$(stat -c %y "$results/ispfFsiFoam/hydrostaticBox/rest/log.ispfFsiFoam")
sed -i 's/1e-6 if/1e-7 if/' $hydrostatics
"$validate" -tier quick > "$scratch/out" 2>&1
grep -q "is compared again" "$scratch/out" && grep -q "over sqrt(g H).* of    1e-07  pass" "$scratch/out" || fail "compared again: $(cat "$scratch/out")"
[ "$(stat -c %y "$results/ispfFsiFoam/hydrostaticBox/rest/log.ispfFsiFoam")" = "$solved" ] || fail "run again, not only compared"
sed -i 's/1e-7 if/1e-6 if/' $hydrostatics; "$validate" -tier quick > /dev/null 2>&1
# a run whose comparison has been removed does not count as judged
for gone in comparison/summary.csv ""; do
    rm -r "$results/ispfFsiFoam/hydrostaticBox/rest/$gone"
    "$validate" -tier quick > "$scratch/out" 2>&1 && grep -q "5 quantities of 1 runs, 0 FAIL" "$scratch/out" ||
        fail "without rest/$gone: $(cat "$scratch/out")"
    diff <(cut -d, -f 1-11 "$scratch/once.csv") <(cut -d, -f 1-11 "$results/summary.csv") || fail "without rest/$gone the summary differs"
done
# files that the tutorial had before and does not have any more judge nothing
compare=validation/compare; echo 1 > validation/table.csv; sed -i 's/^sys.exit/open("validation\/table.csv"); &/' $compare
"$validate" -tier quick > "$scratch/out" 2>&1 || fail "with a table: $(cat "$scratch/out")"
rm validation/table.csv
"$validate" -tier quick > "$scratch/out" 2>&1 && fail "a table that is no more is read: $(cat "$scratch/out")"
grep -q "rest: FAIL, Allrun failed: .*compare, line [0-9]*: FileNotFoundError: .*validation/table.csv" "$scratch/out" || fail "no table: $(cat "$scratch/out")"
sed -i 's/open("validation.table.csv"); //' $compare; "$validate" -tier quick > /dev/null 2>&1
summary=$results/ispfFsiFoam/hydrostaticBox/rest/comparison/summary.csv
cp "$summary" "$scratch/whole.csv"; head -c -9 "$scratch/whole.csv" > "$summary"
"$validate" -tier quick > "$scratch/out" 2>&1 && fail "cut off in the last column, and the status is 0"
grep -q "summary.csv is cut off" "$results/report.md" || fail "cut off in the last column: $(cat "$scratch/out")"
cp "$scratch/whole.csv" "$summary"
sed -i 1q "$results/ispfFsiFoam/hydrostaticBox/rest/comparison/summary.csv"
"$validate" -tier quick > "$scratch/out" 2>&1 && fail "nothing was compared, and the status is 0"
grep -q "nothing was compared" "$results/report.md" || fail "nothing was compared: $(cat "$scratch/out")"
interrupted() { # folder log time: a validation whose solver was stopped when it had come so far [options]
    local attempt run k
    for attempt in {1..20}; do # until the signal comes before the end, which on a busy machine it may not
        rm -rf "$1"
        setsid "$validate" -tier quick -folder "$1" "${@:4}" > /dev/null 2>&1 & run=$!
        until grep -qs "^Time = $3" "$1/$2" || ! kill -0 $run 2> /dev/null; do sleep 0.02; done
        kill -TERM -- -$run 2> /dev/null; wait $run 2> /dev/null && continue
        for k in {1..100}; do # until it has written what it had
            ! grep -q "^End" "$1/$2" || break
            sleep 0.1
        done
        ! grep -q "SIGTERM" "$1/$2" || return 0
    done
    fail "$2 was not interrupted: $(tail -n 4 "$1/$2")"
}
interrupted "$results" ispfFsiFoam/hydrostaticBox/rest/log.ispfFsiFoam 0.5
"$validate" -tier quick > "$scratch/out" 2>&1 || fail "goes on: $(cat "$scratch/out")"
grep -q "rest: goes on" "$scratch/out" || fail "begins anew: $(cat "$scratch/out")"
diff <(cut -d, -f 1-11 "$scratch/once.csv") <(cut -d, -f 1-11 "$results/summary.csv") || fail "interrupted, the summary differs"
# also in a folder that the tutorial itself has made
validate=$ispfRoot/bin/ispfValidate
interrupted "$scratch/own" ispfFsiFoam/invariance/allAtOnce/plain/log.ispfFsiFoam 0.1 invariance
"$validate" -tier quick -folder "$scratch/own" invariance > "$scratch/out" 2>&1 || fail "goes on in its own folder: $(cat "$scratch/out")"
grep -q "allAtOnce: goes on" "$scratch/out" || fail "begins anew in its own folder: $(cat "$scratch/out")"
# tables of published values report the place of an error
values() { # text, what is said
    printf '%b' "$1" > "$scratch/table.csv"
    (cd "$scratch" && PYTHONPATH=$ispfRoot/bin/tools python3 -c \
        'from validation import reference; print(reference("table.csv", ("name",)))') > "$scratch/out" 2>&1
    grep -qF -- "$2" "$scratch/out" || fail "table '$1': '$2' is not said: $(cat "$scratch/out")"
}
values '# whose\nname,s,v\na,1,2.5\nb,,-1e-3\n' "[{'name': 'a', 's': 1.0, 'v': 2.5}, {'name': 'b', 's': None, 'v': -0.001}]"
values '# whose\nname,s,v\na,1\n' "table.csv, line 3: 2 columns where the header has 3: a,1"
values 'name,s,v\na,1,abc\n' "table.csv, line 2: no number where the header has s, v: a,1,abc"
values 'name,s,v\n' "table.csv has no values"
[ $failures = 0 ]
