#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: closedBath.sh.  Two boxes of rubber in a closed bath are driven apart.  Nothing tells the level of p there (theory 7.4), however
# the boxes deform, and whatever pressure another vessel has: they mirror each other within 5 %.
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
bareCase bath
echo "rho 1000; mu 0.02; bodyForce { left (-0.5 0 0); right (0.5 0 0); }" > constant/physicalProperties
echo "structureModel totalLagrangian; material { type neoHookean; G 2e4; }" > constant/structureProperties
cat > constant/boundary <<'BOUNDARY'
below { type symmetryPlane; point (0 0 0); normal (0 -1 0); } behind { type symmetryPlane; point (0 0 0); normal (0 0 -1); }
walls { type wall; }
BOUNDARY
vessel() { cat > system/particleDict <<PARTICLES
dx 1e-3;
zones
{
    fluid { phase fluid; shape box; min (-12e-3 0 0); max (12e-3 6e-3 6e-3); }
    $1
    left { phase solid; shape box; min (-7e-3 0 0); max (-1e-3 3e-3 3e-3); }
    right { phase solid; shape box; min (1e-3 0 0); max (7e-3 3e-3 3e-3); }
}
PARTICLES
}
cat > system/controlDict <<'CONTROL'
endTime 0.2; deltaT 1e-3; adjustTimeStep yes; writeControl none;
functions
{
    left { type volFieldValue; operation volAverage; zones (left); fields (U); }
    right { type volFieldValue; operation volAverage; zones (right); fields (U); }
    corner { type probes; fields (p); probeLocations ((11e-3 5e-3 5e-3)); }
}
CONTROL
speed() { tail -n 1 postProcessing/"$1"/0/volFieldValue.dat | tr -d '()' | awk '{ print $2 }'; }
for pipe in "" "pipe { phase fluid; shape box; min (-14e-3 10e-3 0); max (14e-3 16e-3 6e-3); }"; do
    rm -rf 0 postProcessing
    vessel "$pipe"
    [ -z "$pipe" ] || echo "in { type open; p 2000; surface plane; point (-14e-3 13e-3 3e-3); normal (-1 0 0); }
        out { type open; p 2000; surface plane; point (14e-3 13e-3 3e-3); normal (1 0 0); }" >> constant/boundary
    place; solved
    awk -v left="$(speed left)" -v right="$(speed right)" 'BEGIN { s = left + right; exit !(right > 5e-3 && s*s < 2.5e-3*right*right) }' ||
        fail "the boxes move with $(speed left) and $(speed right) m/s"
    awk '!/^#/ && !($2*$2 < 100) { print "  p " $2 " Pa at " $1 " s"; exit 1 }' postProcessing/corner/0/p || fail "p"
done
# Packed discs in a closed plane bath under g: nothing is absent around them, whatever the disorder of the particles, and all rests
rm -rf 0 postProcessing
echo "rho 1000; mu 1e-3;" > constant/physicalProperties; echo "value (3 -9.81 0);" > constant/g
echo "structureModel totalLagrangian; material { type neoHookean; G 1e4; }" > constant/structureProperties
echo "walls { type wall; }" > constant/boundary
echo "endTime 0.05; deltaT 2e-3; writeControl none; functions { fastest { type minMax; fields (U); phase all; } }" > system/controlDict
for solid in "shape cylinder; point1 (10e-3 10e-3 0); point2 (10e-3 10e-3 1); radius 5e-3;" "shape box; min (8e-3 0 0); max (12e-3 16e-3 0);"; do
    echo "dx 1e-3; nDims 2; zones { water { phase fluid; shape box; min (0 0 0); max (20e-3 20e-3 0); } solid { phase solid; $solid } }" > system/particleDict
    rm -rf 0 postProcessing; place; solved
    speed=$(grep -v "^#" postProcessing/fastest/0/*.dat | tail -n 1 | tr -d '()' | awk '{ print ($2 > 0 ? $2 : -$2) + ($6 > 0 ? $6 : -$6) }')
    awk -v u="$speed" 'BEGIN { exit !(u != "" && u < 1e-6) }' || fail "$solid moves by itself at $speed m/s"
done
[ $failures = 0 ]
