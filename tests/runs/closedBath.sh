#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: closedBath.sh.  Two boxes of rubber in a closed bath are driven apart.  Nothing tells the level of p there (theory 7.4), however
# the boxes deform: they mirror each other within 5 %, and the sources, whose energy is sum V p q, bring none.
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase bath
echo "rho 1000; mu 0.02; bodyForce { left (-0.5 0 0); right (0.5 0 0); }" > constant/physicalProperties
echo "structureModel totalLagrangian; material { type neoHookean; G 2e4; }" > constant/structureProperties
cat > constant/boundary <<'BOUNDARY'
below { type symmetryPlane; point (0 0 0); normal (0 -1 0); } behind { type symmetryPlane; point (0 0 0); normal (0 0 -1); }
walls { type wall; }
BOUNDARY
cat > system/particleDict <<'PARTICLES'
dx 1e-3;
zones
{
    fluid { phase fluid; shape box; min (-12e-3 0 0); max (12e-3 6e-3 6e-3); }
    left { phase solid; shape box; min (-7e-3 0 0); max (-1e-3 3e-3 3e-3); }
    right { phase solid; shape box; min (1e-3 0 0); max (7e-3 3e-3 3e-3); }
}
PARTICLES
cat > system/controlDict <<'CONTROL'
endTime 0.2; deltaT 1e-3; adjustTimeStep yes; writeControl none;
functions
{
    left { type volFieldValue; operation volAverage; zones (left); fields (U); }
    right { type volFieldValue; operation volAverage; zones (right); fields (U); }
    corner { type probes; fields (p); probeLocations ((11e-3 5e-3 5e-3)); }
}
CONTROL
place; solved
speed() { tail -n 1 postProcessing/"$1"/0/volFieldValue.dat | tr -d '()' | awk '{ print $2 }'; }
awk -v left="$(speed left)" -v right="$(speed right)" 'BEGIN { s = left + right; exit !(right > 5e-3 && s*s < 2.5e-3*right*right) }' ||
    fail "the boxes move with $(speed left) and $(speed right) m/s"
awk '!/^#/ && !($2*$2 < 100) { print "  p " $2 " Pa at " $1 " s"; exit 1 }' postProcessing/corner/0/p || fail "p"
[ $failures = 0 ]
