#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Plug flow through a channel between symmetry planes: behind the front of the fluid that was there at the start, the residence
# time of each particle is its way from the inlet over the speed, within the way of a spacing.  A run that was written and
# continued has the same fields bit by bit; without the function object the field vanishes.  Prints the differences
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir channel channel/system channel/constant; cd channel || exit 1
echo "coupling projection;" > system/sphSolution
: > system/sphSchemes
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
echo "low { type symmetryPlane; point (0 0 0); normal (0 -1 0); } high { type symmetryPlane; point (0 8e-3 0); normal (0 1 0); }
    in { type open; velocity 0.01; } out { type open; p 0; }" > constant/boundary
echo "dx 1e-3; nDims 2; zones { water { phase fluid; shape box; min (0 0 0); max (20e-3 8e-3 0); } }
    patches { in { box ((-1e-4 -1 -1) (1e-4 1 1)); } out { box ((19.9e-3 -1 -1) (20.1e-3 1 1)); } }" > system/particleDict
# control end: two passages take 4 s
control() {
    echo "startFrom latestTime; startTime 0; endTime $1; deltaT 0.02; writeControl timeStep; writeInterval 50; functions { $2 }" > system/controlDict
}
age="age { type residenceTime; }"
# place and residence time of each particle at a time; h5dump prints the checksums behind the values
columns() {
    paste <(h5dump -m %.12g -y -w 1 -d /VTKHDF/Points "$1/particles.hdf" | tr -d ' ,' | grep -E '^[-0-9.e+]+$' | paste - - -) \
        <(h5dump -m %.12g -y -w 1 -d /VTKHDF/PointData/residenceTime "$1/particles.hdf" | tr -d ' ,' | grep -E '^[-0-9.e+]+$') |
        awk 'NF == 4'
}
control 1 "$age"; place; solved
columns 1 | awk '$1 > 0.012 && $1 < 0.0195 { ++n; if (($4 - 1)^2 > 1e-20) bad = 1 } END { exit !(n > 30) || bad }' ||
    fail "fluid that was there at the start has not the time of the run"
rm -rf ../run; cp -r postProcessing ../run; rm -rf postProcessing
ispfPostProcess > log 2>&1 || fail "ispfPostProcess: $(tail -n 5 log)"
diff <(awk '!/^#/ { print $2, $3 }' ../run/age/0/residenceTime.dat | sed -n '1p;$p') \
    <(awk '!/^#/ { print $2, $3 }' postProcessing/age/0/residenceTime.dat | sed -n '1p;$p') || fail "afterwards the mean is another one"
rm -rf postProcessing; cp -r ../run postProcessing
cp -r . ../whole
rm -rf [1-9]* postProcessing
control 1 "age { type residenceTime; timeStart 0.29; }"; solved    # within the 15th step
columns 1 | awk '$1 > 0.012 && $1 < 0.0195 { ++n; if (($4 - 0.71)^2 > 1e-20) bad = 1 } END { exit !(n > 30) || bad }' ||
    fail "the time before timeStart counts"
rm -rf ../channel/*; cp -r ../whole/. .
control 4 "$age"; solved                                    # continued from 1 s
columns 4 | awk '$1 > 0 && $1 < 0.0195 { e = $4 - $1/0.01; ++n; s += e*e; if (e > most) most = e; if (-e > most) most = -e }
    $1 < -0.001 && $4 != 0 { outside = 1 }
    END { printf "    %d particles: residence time less x/U, rms %.3f s, largest %.3f s, of 2 s\n", n, sqrt(s/n), most
          exit n < 140 || most > 0.1 || outside }' || fail "residence time of plug flow"
awk '!/^#/ { last = $0 } END { split(last, v, /[ \t]+/); printf "    mean %.4f s, largest %.4f s\n", v[2], v[3]
    exit (v[2] - 1)^2 > 0.03^2 || (v[3] - 2)^2 > 0.1^2 }' postProcessing/age/1/residenceTime.dat || fail "mean and largest"
(cd ../whole && rm -rf 1 postProcessing && control 4 "$age" && solve) || fail "the run in one piece"
same 4 ../whole/4 "a continued run differs"
ispfPostProcess -latestTime > log 2>&1 || fail "ispfPostProcess: $(tail -n 5 log)"
control 5 ""; solved
control 5 "$age"; ispfPostProcess -latestTime > log 2>&1 && fail "a field that no run has written"
grep -q "have no field residenceTime: it grows while the solver runs" log || fail "ispfPostProcess: $(tail -n 5 log)"
h5dump -n 5/particles.hdf 2> /dev/null | grep -q residenceTime && fail "the field stays without the function object"
# a function object named after it may draw its field from the start on
rm -rf [0-9]* postProcessing
control 0.1 "$age map { type planeMap; zones (water); point (0 0 0); normal (0 0 -1); xAxis (1 0 0); xRange (0 0.02); yRange (0 8e-3); spacing 1e-3; fields (residenceTime); writeControl timeStep; }"
place; solved
[ $failures = 0 ]
