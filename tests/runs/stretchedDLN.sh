#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: stretchedDLN.sh.  Solids at rest under tension stay at rest with ddtScheme DLN, (7.25) and (8.47): a plane ring whose lumen has
# taken up 30 % keeps it within 1e-3, soft and stiff, and a bar in space that is pulled by a third keeps its sides, with one pass and
# with Newton's.  No step is halved
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase ring
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
echo "ddtScheme DLN;" > system/sphSchemes
cat > system/particleDict <<'PARTICLES'
dx 5e-4; nDims 2;
zones
{
    wall { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius 16e-3; }
    lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-3; outerRadius 10e-3; }
}
patches { inlet { box ((-5.1e-3 -5.1e-3 -1) (5.1e-3 5.1e-3 1)); } }
PARTICLES
echo "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
    inlet { type open; flowRate table ((0 0) (0.02 4e-4) (0.24 4e-4) (0.26 0)); }" > constant/boundary
echo "startTime 0; endTime 0.7; deltaT 5e-3; writeControl none; functions { area { type cavityVolume; surface wall_to_lumen; } }" > system/controlDict
place
for G in 1e4 1e6; do
    rm -rf postProcessing
    echo "structureModel totalLagrangian; material { type neoHookean; G $G; }" > constant/structureProperties
    solved
    awk -v G="$G" '!/^#/ && $1 > 0.3 { if (!n++) least = most = $4; if ($4 < least) least = $4; if ($4 > most) most = $4 }
        END { printf "    G %g Pa: dV/V %.5f to %.5f\n", G, least, most; exit !(least > 0.3 && most - least < 3e-4) }' postProcessing/area/0/cavityVolume.dat ||
        fail "the ring of $G Pa does not rest"
    ! grep -q halved log || fail "ring of $G Pa: $(grep -m 1 halved log)"
done

bareCase bar
echo "rho 1000; mu 1e-2;" > constant/physicalProperties
echo "ddtScheme DLN;" > system/sphSchemes
cat > system/particleDict <<'PARTICLES'
dx 1e-3; placement lattice;
zones
{
    bath { phase fluid; shape box; min (0 0 0); max (12e-3 7e-3 7e-3); }
    bar { phase solid; shape box; min (0 0 0); max (12e-3 4e-3 4e-3); }
}
PARTICLES
cat > constant/boundary <<'BOUNDARY'
left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
back { type symmetryPlane; point (0 0 0); normal (0 0 -1); } side { type symmetryPlane; point (0 0 7e-3); normal (0 0 1); }
pull { type wall; point (12e-3 0 0); normal (1 0 0); clamps (bar); motion { direction (1 0 0); displacement table ((0 0) (0.2 4e-3)); } }
top { type open; surface plane; point (0 7e-3 0); normal (0 1 0); p 0; }
BOUNDARY
echo "structureModel totalLagrangian; material { type neoHookean; G 1e4; }" > constant/structureProperties
echo "startTime 0; endTime 0.6; deltaT 1e-2; writeControl none; functions { side { type materialProbes; probeLocations ((3e-3 2.5e-3 0.5e-3)); zones (bar); fields (F_y); } }" > system/controlDict
place
for passes in 1 5; do
    rm -rf postProcessing
    echo "monolithic { newton { maxIter $passes; } }" > system/sphSolution
    solved
    tr -d '()' < postProcessing/side/0/F_y | awk -v passes="$passes" '!/^#/ && $1 > 0.45 { if (!n++) least = most = $3; if ($3 < least) least = $3; if ($3 > most) most = $3 }
        END { printf "    bar, %d passes: stretch across %.5f to %.5f\n", passes, least, most; exit !(n > 10 && least > 0.8 && most - least < 1e-3) }' ||
        fail "the bar does not rest with $passes passes"
    ! grep -q halved log || fail "bar, $passes passes: $(grep -m 1 halved log)"
done
[ $failures = 0 ]
