#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# checkParticles on generated particles: its last line and its status
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir system constant

# A tank of water on an elastic floor with the given thickness in millimetres, held at its ends; dx 1 mm
tank() {
    cat > system/particleDict <<END
dx 1e-3; nDims 2; placement lattice;
zones
{
    water { phase fluid; shape box; min (0 0 0); max (0.03 0.02 0); }
    floor { phase solid; shape box; min (0 0 0); max (0.03 $1e-3 0); }
    left  { phase clamped; shape box; min (-0.004 0 0); max (0 $1e-3 0); }
    right { phase clamped; shape box; min (0.03 0 0); max (0.034 $1e-3 0); }
}
END
}
cat > constant/boundary <<END
walls { type wall; }
top   { type open; p 10; point (0 0.02 0); normal (0 1 0); }
END
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
echo "structureModel springNetwork; E 1e4; links lattice8;" > constant/structureProperties
echo "coupling monolithic;" > system/sphSolution
echo "startTime 0; endTime 1; deltaT 1e-3; writeControl timeStep; writeInterval 1000;" > system/controlDict
: > system/sphSchemes
: > constant/g

for layers in 4 3 2; do
    tank $layers
    generateParticles > log.generate 2>&1 || fail "generateParticles: $(cat log.generate)"
    checkParticles > log.$layers 2>&1
    [ $? = $((layers < 3)) ] || fail "status with $layers layers: $(cat log.$layers)"
    grep -q "Layers through zone floor: $layers " log.$layers || fail "layers: $(cat log.$layers)"
done
grep -q '^Particles OK\.$' log.4 && ! grep -q '^ *\*' log.4 || fail "a sound case: $(cat log.4)"
grep -q '^   \*Layers' log.3 && grep -q '^Particles OK\.$' log.3 || fail "one layer too few is a warning"
grep -q '^Failed 1 check\.$' log.2 || fail "two layers too few"
grep -q 'Two layers cannot bend' log.2 || fail "no reason: $(cat log.2)"
grep -q 'Time per step .* s by the clock' log.4 && grep -q '^    Memory' log.4 || fail "no prediction"

# ---- a zone's volume is its own, without what fills the strips beyond open faces -----------------------
tank 4; generateParticles > log.generate 2>&1
checkParticles -steps 0 > log.zones 2>&1
awk '$1 == "water" && $2 == "fluid" { found = ($4 > 0 && ($5/(0.03*0.016) - 1)^2 < 0.01^2) } END { exit !found }' log.zones ||
    fail "volume of a zone before an open face: $(cat log.zones)"

# ---- the steps that a run will take, by what is given then: those of the run, within 1.5 --------------------
for coupling in projection monolithic; do
    mkdir -p "$scratch/pulse.$coupling"/{system,constant}; cd "$scratch/pulse.$coupling" || exit 1
    echo "dx 0.5e-3; nDims 2; zones { blood { phase fluid; shape box; min (0 0 0); max (10e-3 5e-3 0); } }" > system/particleDict
    echo "walls { type wall; slip yes; } out { type open; point (10e-3 0 0); normal (1 0 0); p 0; }
        in { type open; point (0 0 0); normal (-1 0 0); profile flat;
             velocity { type table; values ((0 0.01) (0.1 0.2) (0.2 0.2) (0.3 0.01)); } }" > constant/boundary
    echo "rho 1060; mu 3.5e-3;" > constant/physicalProperties
    echo "coupling $coupling;" > system/sphSolution; : > system/sphSchemes
    echo "endTime 0.3; deltaT 5e-3; adjustTimeStep yes; writeControl none;" > system/controlDict
    generateParticles > log.generate 2>&1 || fail "generateParticles: $(cat log.generate)"
    checkParticles > log.check 2>&1 || fail "$coupling: $(cat log.check)"
    ispfFsiFoam > log.run 2>&1 || fail "$coupling: $(tail -n 3 log.run)"
    predicted=$(sed -nE 's/.*: about ([^ ]+) steps of .*the shortest .* by the CFL limit.*/\1/p' log.check)
    taken=$(grep -c '^Time = ' log.run)
    awk -v a="${predicted:-0}" -v b="$taken" 'BEGIN { exit !(b > 100 && a < 1.5*b && b < 1.5*a) }' ||
        fail "$coupling: $taken steps, '$predicted' predicted: $(grep endTime log.check)"
done
cd "$scratch" || exit 1

checkParticles -steps 0 | grep -q 'Time per step' && fail "-steps 0 makes steps"
for steps in -1 2.5 many; do checkParticles -steps $steps > out 2>&1 && fail "-steps $steps is accepted"; done
refused() { # what it says, what is wrong
    checkParticles > out 2>&1 && fail "$2 passes"
    grep -q "$1" out || fail "$2: $(tail -n 6 out)"
}
echo "coupling projection;" > system/sphSolution
refused '^ \*\*\*deltaT 0.001 s is beyond the stiffness limit' "a deltaT that the solver refuses"
echo "coupling monolithic;" > system/sphSolution
echo "writeIntervall 1;" >> system/controlDict
refused "writeIntervall.*writeInterval" "a word that nobody reads"
sed -i '/writeIntervall/d' system/controlDict
rm 0/particles.hdf
checkParticles > log.none 2>&1 && fail "a case without particles passes"
grep -q particles.hdf log.none || fail "no word of what is missing"
[ $failures = 0 ]
