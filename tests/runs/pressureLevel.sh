#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: pressureLevel.sh [p/G ...].  A pressure that is the same inside and outside of a ring of rubber does not move it, however large: no
# particle goes 1e-3 dx, and the enclosed area keeps its size within 1e-5.  Prints both.  A ring around a closed lumen with a disc in it
# has the pressure from outside alone
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
[ $# -gt 0 ] || set -- 0.5 20
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
                  exit !(most < 1e-3 && J^2 < 1e-10) }' || fail "p = $ratio G"
done
rm -rf 0 1 postProcessing
cat > system/particleDict <<'PARTICLES'
dx 5e-4; nDims 2;
zones
{
    wall { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius 12e-3; }
    lumen { phase fluid; shape cylinder; point1 (0 0 0); point2 (0 0 1); radius 10e-3; }
    disc { phase solid; shape cylinder; point1 (0 0 0); point2 (0 0 1); radius 6e-3; }
}
PARTICLES
echo "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }" > constant/boundary
echo "structureModel totalLagrangian; material { type neoHookean; G 600; } outside { pressure { type table; values ((0 0) (0.5 3000) (1 3000)); } }" > constant/structureProperties
echo "startTime 0; endTime 1; deltaT 5e-3; writeControl none; adjustTimeStep yes;
    functions { area { type cavityVolume; surface wall_to_lumen; } p { type volFieldValue; operation volAverage; zones (lumen disc); fields (p); } }" > system/controlDict
place; solved
awk '!/^#/ { p = $2 } END { exit !((p - 3000)^2 < 30^2) }' postProcessing/p/0/volFieldValue.dat || fail "p in the closed lumen: $(tail -n 1 postProcessing/p/0/volFieldValue.dat)"
awk '!/^#/ { J = $4 } END { exit !(J^2 < 1e-10) }' postProcessing/area/0/cavityVolume.dat || fail "the closed lumen: $(tail -n 1 postProcessing/area/0/cavityVolume.dat)"
[ $failures = 0 ]
