#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: contrast.sh ["Gi Go" ...].  A ring of two materials, 5 layers each, whose moduli Gi and Go differ by up to 1000, is
# inflated, (7.23), (7.24): the pressure inside is that of the incompressible ring in plane strain within 3 %.  Prints the pressures.
# ENTRIES: further entries of totalLagrangian
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase ring
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
cat > constant/boundary <<'BOUNDARY'
left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
inlet { type open; flowRate { type table; values ((0 0) (0.1 6e-7) (0.2 2.17e-6) (0.3 4.11e-6) (0.4 5.68e-6) (0.5 6.28e-6) (0.6 5.68e-6)
    (0.7 4.11e-6) (0.8 2.17e-6) (0.9 6e-7) (1 0)); } }
BOUNDARY
cat > system/particleDict <<'PARTICLES'
dx 5e-4; nDims 2;
zones
{
    inner { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius 12.5e-3; }
    outer { phase solid; shape annulus; point1 (0 0 0); innerRadius 12.5e-3; outerRadius 15e-3; }
    lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-3; outerRadius 10e-3; }
}
patches { inlet { box ((-5.1e-3 -5.1e-3 -1) (5.1e-3 5.1e-3 1)); } }
PARTICLES
cat > system/controlDict <<'CONTROL'
startTime 0; endTime 1; deltaT 5e-3; writeControl none; adjustTimeStep yes;
functions { lumen { type cavityVolume; surface inner_to_lumen; } chamber { type probes; fields (p); probeLocations ((5.7e-3 5.7e-3 0)); } }
CONTROL
place
[ $# -gt 0 ] || set -- "3e6 3e6" "3e4 3e6" "3e6 3e4" "3e3 3e6" "3e6 3e3"
for moduli; do
    read -r inner outer <<< "$moduli"
    echo "structureModel totalLagrangian; ${ENTRIES:-} materials { inner { type neoHookean; G $inner; } outer { type neoHookean; G $outer; } }" \
        > constant/structureProperties
    rm -rf postProcessing; solved
    # the pressure is the integral of (l^2 - l^-2) G dr/r over the wall, l = r/R, r^2 - R^2 = K
    awk -v inner="$inner" -v outer="$outer" -v p="$(tail -n 1 postProcessing/chamber/0/p | awk '{ print $2 }')" \
        -v J="$(tail -n 1 postProcessing/lumen/0/cavityVolume.dat | awk '{ print $4 + 1 }')" '
        function part(G, A, B,   k, R, l) {
            K = 1e-4*(J - 1); sum = 0
            for (k = 0; k < 200; ++k) { R = A + (B - A)*(k + 0.5)/200; l = sqrt(R^2 + K)/R; sum += G*(l^2 - 1/l^2)*R/(R^2 + K)*(B - A)/200 }
            return sum
        }
        BEGIN { exact = part(inner, 10e-3, 12.5e-3) + part(outer, 12.5e-3, 15e-3)
            printf "    G %g within %g Pa: p %.1f Pa, exact %.1f, %+.1f %%\n", inner, outer, p, exact, 100*(p/exact - 1)
            exit !((p/exact - 1)^2 < 0.03^2) }' || fail "G $moduli"
done
[ $failures = 0 ]
