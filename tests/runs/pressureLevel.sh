#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: pressureLevel.sh [p/G ...].  The same pressure inside and outside a ring of rubber, which it ought not to move: up to half of
# its shear modulus G no particle goes 0.2 dx, and the enclosed area keeps its size within 0.2 %.  Prints both
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase ring
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
cat > system/particleDict <<'PARTICLES'
dx 5e-4; nDims 2;
zones
{
    wall { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius 15e-3; }
    lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-3; outerRadius 10e-3; }
}
patches { inlet { box ((-5.1e-3 -5.1e-3 -1) (5.1e-3 5.1e-3 1)); } }
PARTICLES
cat > system/controlDict <<'CONTROL'
startTime 0; endTime 1; deltaT 5e-3; writeControl runTime; writeInterval 1; adjustTimeStep yes;
functions { area { type cavityVolume; surface wall_to_lumen; } }
CONTROL
[ $# -gt 0 ] || set -- 0.5
for ratio; do
    rise="{ type table; values ((0 0) (0.5 $(awk -v r="$ratio" 'BEGIN { print 600*r }')) (1 $(awk -v r="$ratio" 'BEGIN { print 600*r }'))); }"
    echo "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
        inlet { type open; p $rise }" > constant/boundary
    echo "structureModel totalLagrangian; material { type neoHookean; G 600; } outside { pressure $rise }" > constant/structureProperties
    rm -rf 0 1 postProcessing; place; solved
    places() { h5dump -m %.12g -y -w 1 -d "/VTKHDF/$1" 1/particles.hdf | tr -d ' ,' | grep -E '^[-0-9.e+]+$' | paste - - -; }
    paste <(places Points) <(places PointData/x0) <(h5dump -m %d -y -w 1 -d /VTKHDF/PointData/zone 1/particles.hdf | tr -d ' ,' | grep -E '^[0-9]+$') |
        awk -v ratio="$ratio" -v J="$(tail -n 1 postProcessing/area/0/cavityVolume.dat | awk '{ print $4 }')" '
            $7 == 0 { way = sqrt(($1 - $4)^2 + ($2 - $5)^2)/5e-4; if (way > most) most = way }
            END { printf "    p = %g G: particles go up to %.3f dx, the area changes by %.3f %%\n", ratio, most, 100*J
                  exit !(most < 0.2 && J^2 < 0.002^2) }' || fail "p = $ratio G"
done
[ $failures = 0 ]
