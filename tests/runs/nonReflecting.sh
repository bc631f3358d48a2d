#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A pulse of pressure travels along half a channel whose soft wall stands before springs: c^2 = H stiffness/rho.  It comes in
# through a face that lets waves out.  At the other end a given pressure sends it back as a whole, and an end without
# reflection less than 5 %.  Prints the speed of the front, where p is half of its peak, and both shares.  The mass of the wall
# and of the flow across slow short waves down, by kx^2 (H h + H^2/3)/2: 2 % of the pulse's speed.  A
# wall too soft in shear would slow it too: the fluid presses it aside by p kx^2 h^3/(3 G), here 0.5 % of what the springs give way
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir tube tube/system tube/constant; cd tube || exit 1
echo "coupling monolithic;" > system/sphSolution
echo "ddtScheme DLN;" > system/sphSchemes
echo "rho 1000; mu 0;" > constant/physicalProperties
echo "structureModel totalLagrangian; material { type neoHookean; G 2000; } outside { stiffness 2.5e5; }" > constant/structureProperties
echo "dx 1e-3; nDims 2; placement lattice; zones { water { phase fluid; shape box; min (0 0 0); max (0.15 4e-3 0); }
    wall { phase solid; shape box; min (-3e-3 4e-3 0); max (0.153 8e-3 0); } }
    patches { in { box ((-1e-4 -1 -1) (1e-4 4.1e-3 1)); } out { box ((0.1499 -1 -1) (0.1501 4.1e-3 1)); } }" > system/particleDict
echo "startTime 0; endTime 0.39; deltaT 1.5e-3; writeControl none;
    functions { p { type probes; fields (p); probeLocations ((0.05 1.5e-3 0) (0.075 1.5e-3 0) (0.1 1.5e-3 0)); } }" > system/controlDict
# pulse outlet: 10 sin^2 Pa in 0.15 s, twice as much as p of the face
pulse() {
    { echo "middle { type symmetryPlane; point (0 0 0); normal (0 -1 0); }"
      awk 'BEGIN { printf "in { type open; outlet nonReflecting; waveSpeed 1; p table ("
          for (t = 0; t <= 0.15001; t += 0.005) printf " (%g %g)", t, 20*sin(3.14159265*t/0.15)^2
          print " (1 0)); }" }'
      echo "out { type open; p 0; outlet $1; }"; } > constant/boundary
    place; solved
    # what comes back is at the middle from 0.225 s on, its peak at 0.3 s; before that the tail of the pulse still passes there
    awk '!/^#/ { for (k = 2; k <= 4; ++k) { if ($k > 5 && !at[k]) at[k] = t + ($1 - t)*(5 - p[k])/($k - p[k]); p[k] = $k }; t = $1
            if ($3 > most) most = $3
            if ($1 > 0.285) { if ($3 > back) back = $3; if (-$3 > back) back = -$3 } }
        END { printf "%.4f %.4f %.4f\n", most, back/most, 0.05/(at[4] - at[2]) }' postProcessing/p/0/p > shares
    rm -rf postProcessing 0
}
pulse fixedPressure; read -r high whole speed < shares
pulse "nonReflecting; waveSpeed 1"; read -r _ part _ < shares
echo "    pulse $high Pa of 10, speed $speed m/s of 1; sent back: $whole by a given pressure, $part without reflection"
awk -v p="$part" -v w="$whole" -v h="$high" -v c="$speed" 'BEGIN { exit !(p < 0.05 && w > 0.9 && (h - 10)^2 < 0.5^2 && (c - 1)^2 < 0.06^2) }' || fail "the end reflects"
[ $failures = 0 ]
