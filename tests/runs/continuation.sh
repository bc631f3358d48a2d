#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The result is the same, bit for bit: continued after a stop or after kill -9, run twice, with one thread and two
set -uo pipefail
. "$(dirname "$0")/../cases/functions"

# 13 steps and 13 more, in a run that was never interrupted and in one that starts from the 13th step
continued() { # template name
    newCase "$1" "$2"
    eval "${3:-}"
    place
    solved
    grep -q "^particles: " log || fail "$2: no particles"
    cp -r . "../$2.continued"
    cd "../$2.continued" && rm -r 0.26
    solved
    grep -q "^Time = 0.13$" log && fail "$2: begins anew"
    same 0.26 "../$2/0.26" "$2: continued from half way"
    local ledger
    for ledger in volumeLedger energyLedger; do
        [ "$(tail -n 1 "../$2/postProcessing/$ledger/0/$ledger.dat")" = \
          "$(tail -n 1 "postProcessing/$ledger/0.13/$ledger.dat")" ] || fail "$2: another $ledger"
    done
    seriesComplete "$2"
}
adjusted='setEntry system/controlDict writeControl adjustableRunTime
    setEntry system/controlDict writeInterval 0.13; echo "adjustTimeStep yes;" >> system/controlDict'
explicitWall='setEntry system/sphSolution coupling projection; setEntry constant/structureProperties E 1000'
continued piston fluidProjection
continued piston fluidProjectionAdjusted "$adjusted"
continued piston fluidSecondOrder 'echo "ddtScheme DLN;" >> system/sphSchemes'
continued piston fluidSecondOrderMonolithic 'echo "ddtScheme DLN;" >> system/sphSchemes
    setEntry system/sphSolution coupling monolithic'
continued piston fluidMonolithic 'setEntry system/sphSolution coupling monolithic'
continued membrane wallMonolithic
continued membrane wallSecondOrder 'echo "ddtScheme DLN;" >> system/sphSchemes'
continued membrane wallProjection "$explicitWall; $adjusted"

# The run is killed while it writes every step; what remains of a folder does not matter
newCase piston killed
setEntry system/controlDict writeInterval 1; setEntry system/controlDict endTime 0.5
setEntry system/controlDict deltaT 0.005
place
cp -r . ../notKilled
ispfFsiFoam > log 2>&1 & run=$!
until [ -e 0.05/particles.hdf ] || ! kill -0 $run 2> /dev/null; do sleep 0.01; done
kill -9 $run; wait $run 2> /dev/null
[ -e 0.5 ] && fail "killed too late for a test"
solved
[ "$(grep -m 1 '^Time = ' log)" != "Time = 0.005" ] || fail "a killed run begins anew"
(cd ../notKilled && solved)
same 0.5 ../notKilled/0.5 "continued after kill -9"
seriesComplete "killed"

# Steps too small for the digits of the times: each start continues with names that distinguish the times, in order
newCase piston fineSteps; place
solved
for more in "timePrecision 2; deltaT 2e-5; writeInterval 1; endTime 0.26004;" "endTime 0.26008;" "endTime 0.2601;"; do
    echo "$more" >> system/controlDict
    solved
    seriesComplete "fine steps, $more"
done
[ "$(echo 0.26*)" = "0.26 0.26002 0.26004 0.26006 0.26008 0.2601" ] || fail "fine steps: $(echo 0.26*)"
newCase piston manyDigits; place
echo "deltaT 0.0123456789; writeInterval 1; endTime 0.024;" >> system/controlDict
solved
[ "$(awk -f "$cases/series.awk" particles.hdf.series)" = $'0.0246913578 0.0246914/particles.hdf
0.0123456789 0.0123457/particles.hdf
0 0/particles.hdf' ] || fail "many digits: $(cat particles.hdf.series)"

# Large enough for several threads
for template in piston membrane; do
    newCase $template threads
    setEntry system/particleDict dx 0.0025; setEntry system/controlDict deltaT 0.002
    setEntry system/controlDict endTime 0.004; setEntry system/controlDict writeInterval 2
    place
    for n in 1 2; do
        solved -threads $n
        grep -q "^threads: $n$" log || fail "$template: not $n threads"
        mv 0.004 threads$n
    done
    solved -threads 2
    same threads1 threads2 "$template: one thread and two"
    same threads2 0.004 "$template: run twice"
done
# The run asks functions of time only for its own times: a table that ends with the run is enough, also if the end shortens
# the last steps or if the start is not 0
newCase piston range
place
mv 0 5
range='type table; outOfBounds error; values'
echo "walls { type wall; }
piston { type wall; point (0 0 0); normal (0 -1 0); velocity { $range ((5 (0 0 0)) (5.05 (1e-3 0 0))); }
    motion { direction (0 1 0); displacement { $range ((5 0) (5.05 1e-3)); } } }
top { type open; p { $range ((5 0) (5.05 1)); } surface plane; point (0 0.2 0); normal (0 1 0); }" > constant/boundary
echo "value { $range ((5 (0 0 0)) (5.05 (0 -1 0))); }" > constant/g
echo 'startTime 5; endTime 5.05; deltaT 0.02; writeControl adjustableRunTime; writeInterval 0.02;
functions { through { type patchFlux; patch top; } }' >> system/controlDict
for coupling in monolithic projection; do
    setEntry system/sphSolution coupling $coupling
    cp -r . ../$coupling.range; cd ../$coupling.range || exit 1
    solved
    ispfPostProcess > log.post 2>&1 || fail "$PWD: $(tail -n 5 log.post)"
    sed -i 's/outOfBounds error/outOfBounds warn/' constant/boundary constant/g; rm -r 5.0*
    solved
    grep -q "outside the table" log && fail "$PWD: asked for times that are not the run's: $(grep -B 3 outside log)"
    rm -r 5.04; echo "deltaT 0.03;" >> system/controlDict  # longer than the whole run so far
    solved
    grep -q "outside the table" log && fail "$PWD: continued, asked for times before the run: $(grep -B 3 outside log)"
    sed -i 's/outOfBounds warn/outOfBounds error/' constant/boundary constant/g
    sed -i 's/endTime 5.05/endTime 5.06/' system/controlDict
    solve && fail "$PWD: beyond the table"
    grep -q "Time 5.06 lies outside the table, which spans 5 to 5.05" log || fail "$PWD: $(tail -n 5 log)"
    cd ../range || exit 1
done
[ $failures = 0 ]
