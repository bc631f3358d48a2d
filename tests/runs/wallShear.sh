#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: wallShear.sh.  Wall shear stress against the exact one: in a plane channel of 20 spacings whose fluid starts from rest within
# 2 % once the flow is steady, and its mean over time (TAWSS) within 1 %; TAWSS in pipes of six spacings over the radius and
# of ten with Casson's law within 1 %, and the walls' friction within 1 % of the force that drives the flow.  Prints the ratio for boundary layers sqrt(nu t) of 1 to 8 spacings
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
        if ($1 > 0.6) { n++; if ((ratio - 1)^2 > 0.02^2) bad = $1 " s: " ratio; mean = $4/2 } }
    END { printf "    steady: %.4f, TAWSS %.4f of the exact stress\n", ratio, mean; if (bad) print "    at " bad; exit !(n > 10 && !bad && (mean - 1)^2 < 0.01^2) }' \
    postProcessing/w/0/low.dat || fail "wall shear stress in the channel"

# pipe name viscosity force(m/s2) dx: TAWSS within 1 % and friction within 1 % of the force; prints the mean velocity in a pipe of 1 mm
# radius over the `exact` one
pipe() {
    bareCase "$1"
    echo "rho 1000; $2" > constant/physicalProperties; echo "value (0 0 $3);" > constant/g
    echo "dx $4; zones { blood { phase fluid; shape cylinder; point1 (0 0 0); point2 (0 0 0.6e-3); radius 1e-3; } }" > system/particleDict
    echo "walls { type wall; } ends { type cyclic; point (0 0 0); separation (0 0 0.6e-3); }" > constant/boundary
    echo "coupling monolithic;" > system/sphSolution
    echo "startTime 0; endTime 0.5; deltaT 4e-3; writeControl none;
    functions { w { type wallShearStress; patches (walls); start 0.4; writeControl onEnd; }
        f { type forces; patches (walls); writeControl timeStep; writeInterval 1; }
        U { type volFieldValue; operation volAverage; fields (U); writeControl timeStep; writeInterval 1; } }" > system/controlDict
    place; solved
    awk -v G="$3" '!/^#/ { mean = $4/(1000*G*1e-3/2) } END { printf "    '"$1"': TAWSS %.4f of the exact stress\n", mean; exit !((mean - 1)^2 < 0.01^2) }' \
        postProcessing/w/0/walls.dat || fail "$1: wall shear stress"
    awk -v G="$3" '{ gsub(/[()]/, "") } !/^#/ && $1 > 0.4 { n++; sum += $4 } END { ratio = sum/n/(1000*G*atan2(0, -1)*1e-6*0.6e-3)
            printf "    '"$1"': friction %.4f of the force\n", ratio; exit !((ratio - 1)^2 < 0.01^2) }' postProcessing/f/0/force.dat || fail "$1: friction"
    awk -v exact="$exact" '{ gsub(/[()]/, "") } !/^#/ && $1 > 0.4 { n++; sum += $4 } END { ratio = sum/n/exact
            printf "    '"$1"': mean velocity %.4f of the exact one\n", ratio; exit !((ratio - 1)^2 < 0.06^2) }' postProcessing/U/0/volFieldValue.dat || fail "$1: flow"
}
# g R^2/(8 nu)
exact=$(awk 'BEGIN { print 0.5*1e-6/(8*3.5e-6) }')
pipe pipe "mu 3.5e-3;" 0.5 1.6667e-4
# int r^2 (sqrt(G r/2) - sqrt(yieldStress))^2/mu dr/R^2
exact=$(awk 'BEGIN { R = 1e-3; n = 4000; for (k = 0.5; k < n; ++k) { r = k*R/n; s = sqrt(50*r/2) - sqrt(5e-3); if (s > 0) sum += r*r*s*s/3.5e-3*R/n }; print sum/(R*R) }')
pipe Casson "viscosityModel Casson; mu 3.5e-3; yieldStress 5e-3; muMax 1;" 0.05 1e-4
[ $failures = 0 ]
