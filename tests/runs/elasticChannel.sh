#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Flow between two elastic walls (half of the channel), by a given flow rate: wall shear stress on the solid's triangles,
# fields of solid and fluid on them and at points, pressure of the open faces, integrals without what lies beyond them
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir -p constant system
cat > system/particleDict <<'END'
dx 0.5e-3; nDims 2; placement lattice;
zones
{
    blood { phase fluid; shape box; min (0 0 0); max (30e-3 5e-3 0); }
    wall  { phase solid; shape box; min (2e-3 5e-3 0); max (28e-3 8e-3 0); }
    c1    { phase clamped; shape box; min (-3e-3 5e-3 0); max (2e-3 8e-3 0); }
    c2    { phase clamped; shape box; min (28e-3 5e-3 0); max (33e-3 8e-3 0); }
}
patches { in { box ((-1 -1 -1) (1e-4 5.01e-3 1)); } out { box ((29.99e-3 -1 -1) (1 5.01e-3 1)); } }
END
cat > constant/boundary <<'END'
low { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
in  { type open; flowRate { type scale; value 2.7778e-5; scale { type halfCosineRamp; start 0; duration 0.02; } } profile parabolic; }
out { type open; p { type scale; value 20; scale { type halfCosineRamp; start 0; duration 0.02; } } }
END
echo 'rho 1000; mu 1;' > constant/physicalProperties
echo 'structureModel totalLagrangian; material { type neoHookean; E 1e6; viscosity 1; }' > constant/structureProperties
echo 'coupling monolithic;' > system/sphSolution
echo 'kernel WendlandC2;' > system/sphSchemes
cat > system/controlDict <<'END'
startFrom latestTime; startTime 0; endTime 0.1; deltaT 1e-3; writeControl timeStep; writeInterval 50; writeFormat ascii;
functions
{
    age     { type residenceTime; }
    shear   { type wallShearStress; zones (wall); start 0.09; }
    walls   { type surfaceSample; zones (wall); fields (displacement vonMises sigma_x stretches residenceTime); surfaceFormat raw; }
    walls3  { type surfaceSample; zones (wall); fields (vonMises); }
    ofWall  { type materialProbes; probeLocations ((7.5e-3 5.25e-3 0)); fields (displacement vonMises sigma_x sigma_y stretches); }
    inlet   { type surfaceFieldValue; operation areaAverage; patches (in); fields (p U); }
    outlet  { type surfaceFieldValue; operation areaAverage; patches (out); fields (p U); }
    lumen   { type volFieldValue; operation volIntegrate; fields (U); zones (blood); }
    energy  { type energy; }
}
END
place; solved

# tau = 3 mu Q/(2 H^2) of the whole flow Q: 1.6667 Pa
read -r tau < <(awk 'END { print $2 }' postProcessing/shear/0/wall.dat)
echo "    wall shear stress $tau Pa, exact 1.6667"
awk -v t="$tau" 'BEGIN { exit !((t/1.66667 - 1)^2 < 0.02^2) }' || fail "wall shear stress"
# 30 mm of tau 2/(whole height)
read -r in Ux < <(awk 'END { gsub(/[()]/, ""); print $2, $3 }' postProcessing/inlet/0/surfaceFieldValue.dat)
read -r out < <(awk 'END { print $2 }' postProcessing/outlet/0/surfaceFieldValue.dat)
echo "    pressure of the faces $in and $out Pa, mean velocity $Ux m/s"
awk -v i="$in" -v o="$out" -v u="$Ux" 'BEGIN { exit !((o - 20)^2 < 0.01 && ((i - o)/10 - 1)^2 < 0.05^2 && (u/2.7778e-3 - 1)^2 < 0.03^2) }' || fail "pressure or velocity of the faces"
# the integral of U over the channel: flow times length
awk 'END { gsub(/[()]/, ""); exit !(($2/(0.5*2.7778e-5*30e-3) - 1)^2 < 0.02^2) }' postProcessing/lumen/0/volFieldValue.dat || fail "the integral of U: $(tail -n 1 postProcessing/lumen/0/volFieldValue.dat)"
# raw: x y z p U shear, then displacement (3) vonMises sigma_x (3) stretches (3) residenceTime
awk '!/^#/ && $1 > 8e-3 && $1 < 22e-3 { n++; if (NF != 21 || !($21 > 0.02 && $21 <= 0.1001) || !($18 >= 1 && $20 <= 1 && $18*$19*$20 > 0.99)) bad++; s += $12 } END { exit !(n > 20 && !bad && s > 0) }' postProcessing/walls/0.1/wall.raw || fail "fields on the wall's triangles: $(sed -n 1,3p postProcessing/walls/0.1/wall.raw)"
grep -q "SCALARS vonMises\|vonMises 1" postProcessing/walls3/0.1/wall.vtk || fail "no vonMises in wall.vtk"
grep -q '0.1/wall.vtk' postProcessing/walls3/wall.vtk.series && grep -q '0.05/wall.vtk' postProcessing/shear/wall.vtk.series || fail "series"
# the wall carries the fluid's pressure: sigma_yy = - p at its surface
read -r syy < <(awk 'END { gsub(/[()]/, ""); print $3 }' postProcessing/ofWall/0/sigma_y)
echo "    sigma_yy half a dx within the wall $syy Pa, p 27.5 Pa"
awk -v s="$syy" 'BEGIN { exit !((s/-27.5 - 1)^2 < 0.15^2) }' || fail "sigma_yy at the probe"
# the function object's dissipation is that of the ledger over a step
awk '!/^#/ { d = $6; if (n++) step = d - last; last = d; power = $5 } END { exit !(n > 10 && (step/(power*1e-3) - 1)^2 < 0.02^2) }' <(awk '!/^#/ { print $1, $2, $3, $4, $5, -$15 }' postProcessing/energy/0/energy.dat) || fail "dissipation against the ledger: $(tail -n 2 postProcessing/energy/0/energy.dat)"

refusedFunction() { # functions, words
    sed -i '/^functions/,$d' system/controlDict; echo "functions { $1 }" >> system/controlDict; rm -rf 0.* postProcessing
    ispfFsiFoam > log.refused 2>&1 && fail "accepted: $1"
    grep -q "$2" log.refused || fail "$1: $(tail -n 6 log.refused)"
}
refusedFunction "a { type residenceTime; } b { type residenceTime; }" "carries the field residenceTime"
refusedFunction "a { type surfaceSample; patches (in); fields (vonMises); }" "Field vonMises is one of a solid"
refusedFunction "a { type surfaceFieldValue; operation areaAverage; patches (in); fields (q); }" "Valid fields are: U p wallShearStress"
refusedFunction "a { type surfaceFieldValue; operation areaAverage; zones (wall); fields (q); }" "Valid fields are: F_x .* wallShearStress"
refusedFunction "a { type surfaceFieldValue; operation areaAverage; patches (in); fields (vonMises); }" "one of solids: it needs 'zones' of solids alone"
refusedFunction "a { type probes; probeLocations ((0 0 0)); fields (misses); }" "vonMises"
[ $failures = 0 ]
