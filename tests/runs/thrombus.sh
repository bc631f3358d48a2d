#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A channel with a pocket in its lower wall.  A clot grows in the pocket, where fluid stays and is hardly sheared; not in the
# channel, which is washed out, nor beside its wall, where fluid is old but sheared.  The clot then holds its fluid.  A
# continued run is that in one piece bit by bit, and the field vanishes with the model
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir channel channel/system channel/constant; cd channel || exit 1
echo "coupling monolithic;" > system/sphSolution
: > system/sphSchemes
echo "rho 1000; mu 4e-3;" > constant/physicalProperties
echo "clot { type thrombus; d 1e9; residenceTime 3; shearRate 2; growthTime 1; }" > constant/porosityProperties
echo "high { type symmetryPlane; point (0 8e-3 0); normal (0 1 0); } walls { type wall; }
    in { type open; velocity 0.02; profile parabolic; } out { type open; p 0; }" > constant/boundary
echo "dx 1e-3; nDims 2; zones { water { phase fluid; shape box; min (0 0 0); max (30e-3 8e-3 0); }
    pocket { phase fluid; shape box; min (10e-3 -8e-3 0); max (20e-3 0 0); } }
    patches { in { box ((-1e-4 -1 -1) (1e-4 1 1)); } out { box ((29.9e-3 -1 -1) (30.1e-3 1 1)); } }" > system/particleDict
control() { # endTime
    echo "startFrom latestTime; startTime 0; endTime $1; deltaT 0.01; writeControl timeStep; writeInterval 50;
        functions { age { type residenceTime; } }" > system/controlDict
}
# place, thrombus, residence time and speed of each particle at a time
columns() {
    values() { h5dump -m %.12g -y -w 1 -d "/VTKHDF/$2" "$1/particles.hdf" | tr -d ' ,' | grep -E '^[-0-9.e+]+$'; }
    paste <(values "$1" Points | paste - - -) <(values "$1" PointData/thrombus) <(values "$1" PointData/residenceTime) \
        <(values "$1" PointData/U | paste - - -) | awk 'NF == 8'
}
control 5; place; solved
columns 5 | awk '$2 < -1e-3 { ++n; s += $4; if ($2 < -5e-3) { ++deep; d += $4; u += $6^2 + $7^2 } }
    $2 > 1.5e-3 && $1 > 0 && $1 < 0.03 { ++m; if ($4 > 0) grown = 1 }
    $2 > 0 && $2 < 1e-3 && $1 > 0.024 && $1 < 0.03 { ++w; if ($4 > 0) beside = 1; if ($5 > 3) ++old }
    END { printf "    clot: mean %.3f in the pocket, %.3f deep in it, speed there %.2g m/s; beside the wall %d of %d old\n", s/n, d/deep, sqrt(u/deep), old, w
          exit !(s/n > 0.5 && d/deep > 0.95 && sqrt(u/deep) < 1e-5) || grown || beside || m < 100 || old < 2 }' || fail "the clot is not where it should be"
cp -r . ../whole; control 6; solved
(cd ../whole && rm -rf 5 5.* 4.5 && control 6 && solve) || fail "the run from an earlier time"
same 6 ../whole/6 "a continued run differs"
rm constant/porosityProperties; control 6.5; solved
h5dump -n 1 6.5/particles.hdf 2> /dev/null | grep -q thrombus && fail "the field stays without the model"
echo "functions { }" >> system/controlDict
echo "clot { type thrombus; d 1e9; residenceTime 3; shearRate 2; growthTime 1; }" > constant/porosityProperties
sed -i 's/functions { age.*//; s/endTime 6.5/endTime 7/' system/controlDict
solve && fail "a thrombus without the residence time is accepted"
grep -q "Add age { type residenceTime; }" log || fail "without residence time: $(tail -n 5 log)"
[ $failures = 0 ]
