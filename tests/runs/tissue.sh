#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: tissue.sh.  Springs around a ring and a sphere of rubber, 16 dx in radius, that are inflated, (5.27): the pressure inside
# is that of the incompressible wall and of the springs on its surface within 1 %.  Prints the pressures.
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase tissue
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
cat > system/controlDict <<'CONTROL'
startTime 0; endTime 0.8; deltaT 0.02; writeControl none;
functions { lumen { type cavityVolume; surface wall_to_lumen; } chamber { type probes; fields (p); probeLocations ((4.6e-3 4.6e-3 4.6e-3)); } }
CONTROL
cat > constant/boundary <<'BOUNDARY'
left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
inlet { type open; flowRate table ((0 0) (0.1 1e-4) (0.5 1e-4) (0.6 0)); }
BOUNDARY

# measured nDims stiffness: inflates the wall, once with nothing around it and once with springs.  Their share of the pressure
# is k (b - B) (B/b)^(nDims - 1), as they hold the area at rest
measured()
{
    local n=$1 k=$2 outside
    local -a pressure=()
    place
    for outside in "pressure 0" "stiffness $k"; do
        echo "structureModel totalLagrangian; material { type neoHookean; G 5e4; } outside { $outside; }" > constant/structureProperties
        rm -rf postProcessing; solved
        pressure+=("$(tail -n 1 postProcessing/chamber/0/p | awk '{ print $2 }')")
    done
    awk -v n="$n" -v k="$k" -v alone="${pressure[0]}" -v both="${pressure[1]}" \
        -v J="$(tail -n 1 postProcessing/lumen/0/cavityVolume.dat | awk '{ print $4 + 1 }')" 'BEGIN {
            B = 16e-3; b = (B^n + 1e-2^n*(J - 1))^(1/n); exact = k*(b - B)*(B/b)^(n - 1); found = both - alone
            printf "nDims %d: %.1f Pa without springs, they add %.1f for %.1f Pa: %+.2f %%\n", n, alone, found, exact, 100*(found/exact - 1)
            exit !(found > 0.99*exact && found < 1.01*exact) }' || fail "springs around a wall in $n dimensions"
}

cat > system/particleDict <<'PARTICLES'
dx 1e-3; nDims 2;
zones
{
    wall { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius 16e-3; }
    lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-3; outerRadius 10e-3; }
}
patches { inlet { box ((-5.1e-3 -5.1e-3 -1) (5.1e-3 5.1e-3 1)); } }
PARTICLES
setEntry system/controlDict functions.chamber.probeLocations "((5e-3 5e-3 0))"
measured 2 1e7

cat > system/particleDict <<'PARTICLES'
dx 1e-3;
zones
{
    wall { phase solid; shape sphere; centre (0 0 0); radius 16e-3; }
    lumen { phase fluid; shape sphere; centre (0 0 0); radius 10e-3; }
    inlet { phase rigid; shape sphere; centre (0 0 0); radius 6e-3; }
}
PARTICLES
cat > constant/boundary <<'BOUNDARY'
left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
behind { type symmetryPlane; point (0 0 0); normal (0 0 -1); }
inlet { type open; flowRate table ((0 0) (0.1 6e-7) (0.5 6e-7) (0.6 0)); }
BOUNDARY
setEntry system/controlDict functions.chamber.probeLocations "((4.6e-3 4.6e-3 4.6e-3))"
measured 3 1e7
[ $failures = 0 ]
