#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fluid of one zone flows into another and out of an open face whose sites belong to the second: it counts there as the fluid of
# the face.  The pressure in the channel is Poiseuille's as with one zone, and as many particles cross the faces.  Prints both
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase channel
echo "coupling monolithic;" > system/sphSolution
echo "rho 1000; mu 4e-3;" > constant/physicalProperties
echo "walls { type wall; } in { type open; velocity 0.02; profile parabolic; } out { type open; p 0; }" > constant/boundary
echo "startTime 0; endTime 6; deltaT 0.01; writeControl none;
    functions { at { type probes; fields (p); probeLocations ((18e-3 5e-3 0)); } }" > system/controlDict
box() { echo "$1 { phase fluid; shape box; min ($2 0 0); max ($3 10e-3 0); }"; }
created=""
for zones in "$(box all 0 24e-3)" "$(box first 0 12e-3) $(box second 12e-3 24e-3)"; do
    echo "dx 1e-3; nDims 2; zones { $zones }
        patches { in { box ((-1e-4 -1 -1) (1e-4 1 1)); } out { box ((23.9e-3 -1 -1) (24.1e-3 1 1)); } }" > system/particleDict
    rm -rf 0 postProcessing; place; solved
    # 12 mu U L/h^2 between the probe and the face
    awk '!/^#/ && $1 > 3 { s += $2; ++n } END { p = s/n; exact = 12*4e-3*0.02*6e-3/1e-4
        printf "    p 6 mm before the face %.4f Pa, exact %.4f\n", p, exact; exit !((p/exact - 1)^2 < 0.1^2) }' postProcessing/at/0/p ||
        fail "the pressure before the face"
    created+=" $(sed -nE 's/.*so far created ([0-9]+),.*/\1/p' log | tail -n 1)"
done
awk -v c="$created" 'BEGIN { split(c, n, " "); printf "    %d and %d particles have entered\n", n[1], n[2]; exit !((n[2]/n[1] - 1)^2 < 0.02^2) }' ||
    fail "with two zones other numbers of particles enter"
[ $failures = 0 ]
