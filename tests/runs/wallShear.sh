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

# Couette flow between walls of 6 and 12 spacings that turn against each other, u = a r + b/r: tau = mu (du/dr - u/r) = -2 mu b/r^2, TAWSS within 6 %
bareCase round
echo "rho 1000; mu 1;" > constant/physicalProperties; echo "coupling monolithic;" > system/sphSolution
echo "dx 1e-3; nDims 2; placement bodyFitted; zones { blood { phase fluid; shape annulus; point1 (0 0 0); innerRadius 6e-3; outerRadius 12e-3; } }
    patches { inner { box ((-6.5e-3 -6.5e-3 -1) (6.5e-3 6.5e-3 1)); } }" > system/particleDict
echo "inner { type wall; rotation { origin (0 0 0); axis (0 0 1); omega 10; } } walls { type wall; rotation { origin (0 0 0); axis (0 0 1); omega -5; } }" > constant/boundary
echo "startTime 0; endTime 0.06; deltaT 1e-3; writeControl none; functions { w { type wallShearStress; patches (inner walls); start 0.03; writeControl onEnd; } }" > system/controlDict
place; solved
for wall in inner:40 walls:10; do
    awk -v exact="${wall#*:}" '!/^#/ { ratio = $4/exact } END { printf "    round, '"${wall%:*}"': TAWSS %.4f of the exact stress\n", ratio; exit !((ratio - 1)^2 < 0.06^2) }' \
        "postProcessing/w/0/${wall%:*}.dat" || fail "wall shear stress on the round wall ${wall%:*}"
done

# between a wall at rest and a lid: each goes on with its own history, whatever the order; with another start both begin anew
bareCase order
echo "rho 1000; mu 0.05;" > constant/physicalProperties; echo "value (0 0 0);" > constant/g
echo "dx 2e-4; nDims 2; zones { blood { phase fluid; shape box; min (0 0 0); max (1e-3 2e-3 0); } }" > system/particleDict
echo "low { type wall; point (0 0 0); normal (0 -1 0); } high { type wall; point (0 2e-3 0); normal (0 1 0); velocity (0.01 0 0); }
    ends { type cyclic; point (0 0 0); separation (1e-3 0 0); }" > constant/boundary
echo "coupling monolithic;" > system/sphSolution
until_() { # time, patches, start
    echo "startFrom latestTime; endTime $1; deltaT 1e-3; writeControl timeStep; writeInterval 1;
        functions { w { type wallShearStress; patches ($2); start $3; writeControl timeStep; writeInterval 1; } }" > system/controlDict
    solved
}
place; until_ 0.01 "low high" 0; until_ 0.011 "high low" 0
mean() { awk '!/^#/ { last = $4 } END { print last }' "postProcessing/w/$1/$2.dat"; }
for wall in low high; do
    awk -v a="$(mean 0 $wall)" -v b="$(mean 0.01 $wall)" 'BEGIN { exit !(a > 0 && (b/a - 1)^2 < 0.3^2) }' ||
        fail "continued in another order: $wall $(mean 0 $wall), then $(mean 0.01 $wall)"
done
awk -v a="$(mean 0 low)" -v b="$(mean 0 high)" 'BEGIN { exit !(b > 2*a) }' || fail "the histories do not differ"
until_ 0.012 "high low" 0.005
grep -q "begin anew" log || fail "another start is taken without a word"
[ $failures = 0 ]
