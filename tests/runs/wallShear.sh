#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: wallShear.sh.  Wall shear stress against the exact one: in a plane channel of 20 spacings whose fluid starts from rest within
# 6 % once the flow is steady, and its mean over time (TAWSS) within 5 %; TAWSS in a pipe with six spacings over its radius within 5 %.
# Prints the ratio for boundary layers sqrt(nu t) of 1 to 8 spacings
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase channel
echo "rho 1000; mu 0.05;" > constant/physicalProperties; echo "value (1 0 0);" > constant/g
echo "dx 2e-4; nDims 2; zones { blood { phase fluid; shape box; min (0 0 0); max (2e-3 4e-3 0); } }" > system/particleDict
echo "low { type wall; point (0 0 0); normal (0 -1 0); } high { type wall; point (0 4e-3 0); normal (0 1 0); }
    ends { type cyclic; point (0 0 0); separation (2e-3 0 0); }" > constant/boundary
echo "coupling monolithic;" > system/sphSolution
echo "startTime 0; endTime 0.7; deltaT 4e-4; writeControl none;
    functions { w { type wallShearStress; patches (low); start 0.6; writeControl timeStep; writeInterval 1; } }" > system/controlDict
place; solved
awk '!/^#/ && $1 > 0 { pi = atan2(0, -1); H = 4e-3; nu = 5e-5; sum = 0
        for (k = 1; k < 400; k += 2) sum += exp(-nu*k*k*pi*pi*$1/(H*H))/(k*k)
        ratio = $2/(2*(1 - 8/(pi*pi)*sum)); layer = sqrt(nu*$1)/2e-4
        if (layer >= next_) { printf "    boundary layer of %.1f dx: %.3f of the exact stress\n", layer, ratio; next_ = next_ ? 2*next_ : 1; if (next_ > 8) next_ = 1e9 }
        if ($1 > 0.6) { n++; if ((ratio - 1)^2 > 0.06^2) bad = $1 " s: " ratio; mean = $4/2 } }
    END { printf "    steady: %.4f, TAWSS %.4f of the exact stress\n", ratio, mean; if (bad) print "    at " bad; exit !(n > 10 && !bad && (mean - 1)^2 < 0.05^2) }' \
    postProcessing/w/0/low.dat || fail "wall shear stress in the channel"

bareCase pipe
echo "rho 1000; mu 3.5e-3;" > constant/physicalProperties; echo "value (0 0 0.5);" > constant/g
echo "dx 1.6667e-4; zones { blood { phase fluid; shape cylinder; point1 (0 0 0); point2 (0 0 1e-3); radius 1e-3; } }" > system/particleDict
echo "walls { type wall; } ends { type cyclic; point (0 0 0); separation (0 0 1e-3); }" > constant/boundary
echo "coupling monolithic;" > system/sphSolution
echo "startTime 0; endTime 0.4; deltaT 2e-3; writeControl none;
    functions { w { type wallShearStress; patches (walls); start 0.3; writeControl onEnd; } }" > system/controlDict
place; solved
awk '!/^#/ { mean = $4/0.25 } END { printf "    pipe: TAWSS %.4f of the exact stress\n", mean; exit !(mean > 0 && (mean - 1)^2 < 0.05^2) }' postProcessing/w/0/walls.dat ||
    fail "wall shear stress in the pipe"
[ $failures = 0 ]
