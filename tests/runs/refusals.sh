#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fields and lines that a case without a structure must not have, and cases that the programs refuse or warn of
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
control=system/controlDict; solution=system/sphSolution
says() { grep -qE -- "$1" log || fail "$PWD: '$1' is not said: $(tail -n 6 log)"; }
refused() { solve && fail "$PWD: not refused"; says "$1"; }

# ---- fluid only: no field, no line of a structure --------------------------------------------------
for coupling in projection monolithic; do
    newCase piston fluidOnly; place
    setEntry $control endTime 0.02; setEntry $control writeInterval 1
    setEntry $solution coupling $coupling
    solved
    h5dump -n 1 0.02/particles.hdf | grep -E "x0|surfaceSides|volumeLedger" && fail "$coupling: fields of a structure"
    about=$(sed '1,/^Create time/d' log | grep -iE "structure|wall |cavity|spring")
    [ "$about" = "structure: none" ] || fail "$coupling: $about"
done
echo "monolithic { theta 0.5; }" >> $solution
refused "It acts on a solid, and this case has none"
echo "coupling monolithic;" > $solution
echo "structureModel springNetwork;" > constant/structureProperties
refused "no particle is solid"

# ---- a blow-up names particle, time and what to do, and is never written ---------------------------
jump='sed -i "s/p 0;/p table ((0 0) (0.03 0) (0.031 1e300));/" constant/boundary'
for template in piston membrane; do
    newCase $template blowUp; eval "$jump"; place
    setEntry $control writeInterval 1
    refused "Time 0.0[34] s: .*particle [0-9]+ \(zone (water|bath)\) at \(.*whether a load or a motion jumps"
    [ "$(ls -d 0.*)" = $'0.01\n0.02\n0.03' ] || fail "$template: $(ls -d 0.*)"
    for t in 0.0*; do h5dump -d /VTKHDF/PointData/U "$t/particles.hdf" | grep -qi "nan\|inf" && fail "$template: $t"; done
done

# ---- a time step beyond a limit: the limit's name and the largest step, which is then accepted -------
limited() { # rule, expected step or nothing, deltaT asked
    setEntry $control deltaT "$3"; setEntry $control endTime 100; setEntry $control writeControl none
    refused "is beyond the $1 limit: the largest admissible value now is"
    local most
    most=$(awk '{ for (i = 1; i < NF; ++i) if ($i == "is" && $(i-1) == "now") print $(i+1) }' log)
    [ -z "$2" ] || awk -v a="$most" -v b="$2" 'BEGIN { exit !((a/b - 1)^2 < 1e-10) }' || fail "$1: $most, not $2"
    grep -q "^Time = " log && fail "$1: a step was taken"
    setEntry $control deltaT "$(awk -v a="$most" 'BEGIN { print a*(1 - 1e-5) }')"
    setEntry $control endTime "$(getEntry $control deltaT)"
    solved
}
newCase piston limits; place
sed -i 's/displacement { .* } }/displacement table ((0 0) (100 25)); }/' constant/boundary
limited CFL 0.0208 0.03                                        # 0.4 * 0.013 / 0.25
newCase piston limits; place
echo "projection { viscosity explicit; }" >> $solution
limited "explicit viscosity" 0.021125 0.03                      # 0.013^2 / 8 / 1e-3
newCase membrane limits; place
setEntry $solution coupling projection; setEntry constant/structureProperties E 30
echo "bodyForce { chamber (10 0 0); }" >> constant/physicalProperties
limited force 0.0127475 0.02       # sqrt(0.013 / 5) / 4: by 5 the two fluid zones differ from their mean
newCase membrane limits; place
setEntry $solution coupling projection
limited stiffness "" 0.1

# ---- adjusted steps: however long deltaT is, fluid at rest that a pressure sets in motion gets to its end in steps of its own
for coupling in projection monolithic; do
    rm -rf "$scratch/fromRest"; mkdir -p "$scratch/fromRest/system" "$scratch/fromRest/constant"; cd "$scratch/fromRest" || exit 1
    echo "dx 0.5e-3; nDims 2; zones { blood { phase fluid; shape box; min (0 0 0); max (20e-3 8e-3 0); } }" > system/particleDict
    echo "walls { type wall; } in { type open; point (0 0 0); normal (-1 0 0); p 40; }
        out { type open; point (20e-3 0 0); normal (1 0 0); p 0; }" > constant/boundary
    echo "rho 1060; mu 3.5e-3;" > constant/physicalProperties
    echo "coupling $coupling;" > $solution; : > system/sphSchemes
    echo "endTime 0.1; deltaT 50; adjustTimeStep yes; writeControl none; functions { speed { type minMax; fields (U); } }" > $control
    place; solved
    grep -q "^Step size: half of one that was refused" log || fail "$coupling: no step was refused"
    awk '!/^#/ { if (n && $1 + 0 <= last) exit 1; last = $1 + 0; ++n } END { exit !(n > 30 && last == 0.1) }' \
        postProcessing/speed/0/minMax.dat || fail "$coupling: its steps: $(cut -f 1 postProcessing/speed/0/minMax.dat | tr '\n' ' ')"
done

# ---- a step that is made too long while the run goes on is refused before it is taken ----------------------
newCase piston later; place
setEntry $control writeControl none; setEntry $control endTime 1e4; setEntry $control deltaT 0.002
echo "runTimeModifiable yes;" >> $control
ispfFsiFoam > log 2>&1 & run=$!
until grep -q "^Time = 0.004" log || ! kill -0 $run 2> /dev/null; do sleep 0.01; done
setEntry $control deltaT 0.5
wait $run && fail "a step of 0.5 s was accepted during a run"
says "deltaT 0.5 s is beyond the .* limit"
[ "$(grep -c "^deltaT = 0.002$" log)" = "$(grep -c "^deltaT = " log)" ] || fail "another step was taken: $(grep "^deltaT" log | tail -n 1)"

# ---- words that nobody reads, values out of range, files that are missing ------------------------------
# with file, text, what is said: a case of one step, the text added to the file
with() {
    cp "$1" kept; printf '%s\n' "$2" >> "$1"
    refused "$3"
    mv kept "$1"
}
newCase piston words; place
setEntry $control endTime 0.01
with $control "writeIntervall 5;" "'writeIntervall'.*Did you mean 'writeInterval'"
with $control "maxCo 0.5;" "Nothing reads the entry 'maxCo'"
with $control "functions { f { type minMax; zones (lake); } }" "controlDict.functions.f.zones at line"
with $control "stopAt end;" "Valid stopAts are: endTime"
with constant/g "gravity (0 0 1);" "Nothing reads the entry 'gravity'"
with constant/g "value (0 -9.81 1);" "'value' must not have a component along z"
with constant/physicalProperties "bodyForce { lake (1 0 0); }" "Unknown zone 'lake'"
with constant/physicalProperties "bodyForce { water (1 0 1); }" "'water' must not have a component along z"
p="solver PCG; preconditioner DIC;"
with $solution "solvers { p { $p tolerance 1; } }" "'tolerance' is 1, but must lie between 0 and 0.1"
with $solution "solvers { p { $p relTol 1; } }" "'relTol' is 1, but must lie between 0 and 0.5"
with $solution "solvers { p { $p maxIter 0; } }" "'maxIter' is 0, but must lie between 1 and"
with $solution "solvers { p { $p maxIter 2.5; } }" "'maxIter' should be a whole number"
# entries that act on nothing: of other words, and what neither coupling reads, whichever is chosen
for coupling in projection monolithic; do
    setEntry $solution coupling $coupling
    with $solution "solvers { p { $p restart 30; } }" "It has no effect with solver PCG"
    with $solution "solvers { p { $p cycle K; } }" "It has no effect with preconditioner DIC"
    with $solution "solvers { p { solver direct; tolerance 1e-6; } }" "It has no effect with solver direct"
    with $solution "solvers { pFinal { $p } }" "sphSolution.solvers.pFinal at line 2"
    with $solution "projection { gradient corrected; divergence standard; }" "Nothing reads the entry '(gradient|divergence)'"
    with $solution "projection { viscosity none; }" "Valid .*s are: explicit implicit"
    with $solution "monolithic { tolerence 1e-3; }" "Nothing reads the entry 'tolerence'.*Did you mean 'tolerance'"
    with $solution "monolithic { solid { solver direct; } }" "sphSolution.monolithic.solid"
    cp $solution kept
    echo "projection { viscosity implicit; } monolithic { tolerance 1e-3; } solvers { U { solver PCG; } }" >> $solution
    solved
    # the tolerance of U is 1e-8 also where its dictionary does not say so
    awk -v c=$coupling '/Solving for U,/ { gsub(",", ""); ++n; if ($12 > 1e-8) bad = 1 }
        END { exit bad || (n > 0) != (c == "projection") }' log || fail "solvers.U: $(grep 'Solving for U' log)"
    mv kept $solution
done
with $solution "monolithic { tolerance 0.9; }" "'tolerance' is 0.9, but must lie between 1e-14 and 0.1"
with $solution "monolithic { maxIter -3; }" "'maxIter' is -3, but must lie between 1 and"
mv constant/boundary kept
refused "Cannot read .*constant/boundary: No such file"
sed '/^piston/,/^}/d' kept > constant/boundary
refused "wallParticles.hdf has [0-9]+ points of a patch 'piston'"
sed '/^top/d' kept > constant/boundary
refused "openSites.hdf has [0-9]+ points of a patch 'top'"
sed 's/direction (0 1 0)/direction (0 1 1)/' kept > constant/boundary
refused "patch piston must not move along z"
mv kept constant/boundary
setEntry $control deltaT 0.02; setEntry $control writeInterval 1
setEntry $control endTime 0.01  # a step is longer than the run
refused "deltaT 0.02 s is twice as long as the run or longer, from 0 to endTime 0.01 s"
setEntry $control endTime 0.011
solved
grep -qx "endTime 0.011 s lies between two steps of deltaT 0.02 s: the run ends at 0.02 s, and tables over time are asked up to there" log || fail "no word of another end"
[ -e 0.02/particles.hdf ] && seriesComplete "one long step" || fail "no step: $(tail -n 4 log)"
newCase membrane flat; place
setEntry $control endTime 0.01
with $solution "volumeLedger { zone blood; }" "sphSolution.volumeLedger.zone at line"
with $solution "volumeLedger { cavity wall_to_blood; }" "Valid surfaces are: .*wall_to_bath wall_to_chamber"
echo "functions { c { type cavityVolume; surface wall_to_chamber; } }" >> $control
solved
grep -qi "inf" postProcessing/c/0/*.dat && fail "a flat cavity's change: $(cat postProcessing/c/0/*.dat)"

# ---- the other programs --------------------------------------------------------------------------------
denied() { # what is said, command
    "${@:2}" > log 2>&1 && fail "accepted: ${*:2}"
    says "$1"
}
newCase membrane programs; place
denied "numbers from 2 to 100" calibrateSprings -layers 1000000000
truncate -s 3000 0/particles.hdf
for program in ispfFsiFoam checkParticles "calibrateSprings -bodyOnly"; do
    # shellcheck disable=SC2086
    denied "Cannot read '.*/0/particles.hdf': not an HDF5 file, or truncated" $program
done

# ---- a flow far from resolved is warned of, and an adjusted step does not shrink without end -----------
mkdir -p "$scratch/swirl/system" "$scratch/swirl/constant"; cd "$scratch/swirl" || exit 1
echo 'dx 1e-3; nDims 2; zones { water { phase fluid; shape box; min (-10e-3 -10e-3 0); max (10e-3 10e-3 0);
    U ("50*y*(1-(y/10e-3)^2)*(1-(x/10e-3)^2)^2" "-50*x*(1-(x/10e-3)^2)*(1-(y/10e-3)^2)^2" 0); } }' > system/particleDict
echo "startTime 0; endTime 0.01; deltaT 1e-3; writeControl none; writeInterval 1;" > $control
echo "coupling monolithic;" > $solution; touch system/sphSchemes
echo "walls { type wall; }" > constant/boundary; echo "rho 1000; mu 1e-3;" > constant/physicalProperties
place; solved
[ "$(grep -c "cell Reynolds number U dx/nu is 19" log)" = 1 ] || fail "cell Reynolds number: $(grep -a Warning log | head -n 3)"
echo "rho 1000; mu 4e-3;" > constant/physicalProperties
sed -i "s/endTime 0.01/endTime 0.2/; s/deltaT 1e-3/deltaT 2e-3; functions { u { type minMax; fields (U); } }/" $control
solved
awk -F'\t' '/^#/ { next } !first { first = $4 } { last = $4; if ($4 > most) most = $4 }
    END { exit !(first > 0.19 && last < 0.9*first && most < 1.05*first) }' postProcessing/u/0/minMax.dat || fail "a resolved swirl gains speed"
grep -q "cell Reynolds" log && fail "warns of a cell Reynolds number of 48"
sed -i "s/deltaT 2e-3/deltaT 1e4; adjustTimeStep yes/" $control
refused "the CFL limit is 0.0027[0-9]* s, less than 1e-06 of deltaT"

# ---- an opening in the side of a ball: walls continued past its rim cover what is beyond it --------
mkdir -p "$scratch/ball"/{constant,system}; cd "$scratch/ball" || exit 1
opening() { # its width over dx
    rm -rf 0 0.* constant/*.hdf
    echo "SetFactory(\"OpenCASCADE\"); Sphere(1) = {0, 0, 0, 10};
        Box(2) = {-20, -20, Sqrt(100 - $1*$1/4), 40, 40, 20}; BooleanDifference { Volume{1}; Delete; } { Volume{2}; Delete; }
        Box(3) = {-20, -20, -40, 40, 40, 40 - Sqrt(100 - $1*$1/4)};
        BooleanDifference { Volume{1}; Delete; } { Volume{3}; Delete; }" > constant/ball.geo
    echo "dx 1e-3; zones { water { phase fluid; file \"constant/ball.geo\"; unit mm; } }
        patches { in { box ((-1 -1 -1) (1 1 $(awk -v w="$1" 'BEGIN { print -1e-3*(sqrt(100 - w*w/4) - 0.1) }'))); }
                  out { box ((-1 -1 $(awk -v w="$1" 'BEGIN { print 1e-3*(sqrt(100 - w*w/4) - 0.1) }')) (1 1 1)); } }" > system/particleDict
    place
}
echo "walls { type wall; } in { type open; velocity 0.01; } out { type open; p 0; }" > constant/boundary
echo "rho 1000; mu 0.01;" > constant/physicalProperties
echo "coupling projection;" > $solution; : > system/sphSchemes
echo "startTime 0; endTime 0.3; deltaT 1e-2; writeControl timeStep; writeInterval 30;" > $control
opening 4
refused "Open patch in: its walls, continued past its rim, cover all of the strip 2 dx beyond it.*is [34][.0-9]* dx wide. Take half the dx"
grep -q "^Time = " log && fail "an opening in a ball: a step was taken"
opening 8
solved
grep "^patch flux" log | tail -n 1 | awk '{ exit !($NF^2 < 1e-10^2) }' || fail "an opening in a ball: $(grep '^patch flux' log | tail -n 1)"

# ---- densities, words, kernels -------------------------------------------------------------------------
newCase membrane words; place
setEntry $control endTime 0.01
echo "zoneDensities { wall 1100; }" >> constant/physicalProperties
refused "Zone wall has density 1100, the fluid 1000.*must be equal"
newCase membrane words; place
setEntry $control endTime 0.01
setEntry $solution coupling partitioned
refused "Valid .*s are: .*monolithic projection"
newCase membrane words; place
setEntry $control endTime 0.01
echo "kernel gauss;" > system/sphSchemes
refused "Valid .*s are: WendlandC2 WendlandC4 cubic quintic|Valid .*s are: cubic quintic WendlandC2 WendlandC4"
echo "kernel WendlandC2; hByDx 1;" > system/sphSchemes
solved
says "Warning : kernel WendlandC2 with hByDx 1: this pair is known to blow up"
echo "kernel cubic; hByDx 1;" > system/sphSchemes
solved
grep -q "Warning : kernel" log && fail "warns of a pair that is well"

# ---- entries without effect, and a symmetry plane that the particles were cut at ------------------------
newCase piston cut
sed -i 's/min (0 0 0)/min (-0.2 0 0)/' system/particleDict
echo "middle { type symmetryPlane; point (0 0 0); normal (-1 0 0); }" >> constant/boundary
place
setEntry $control endTime 0.01
solved
cp constant/boundary withPlane
sed -i '/^middle/d' constant/boundary
refused "symmetry plane through \(0 0 0\) with the normal \(-1 0 0\), and no patch lies there"
echo "again { type symmetryPlane; point (0 0.1 0); normal (-2 0 0); }" >> constant/boundary
rm -rf 0.01; solved
echo "bodyForce { }" >> constant/physicalProperties
refused "It names no zone and has no effect"
sed -i '/^bodyForce/d' constant/physicalProperties
echo "functions { most { type minMax; fields (); } }" >> $control
refused "It names no field and has no effect"

# ---- entries of a structure without effect -----------------------------------------------------------------
bareCase still
cat > system/particleDict <<'PARTICLES'
dx 1e-3; nDims 2;
zones
{
    water { phase fluid; shape box; min (0 0 0); max (16e-3 16e-3 0); }
    a { phase solid; shape cylinder; point1 (8e-3 8e-3 0); point2 (8e-3 8e-3 1); radius 4e-3; }
}
PARTICLES
echo "walls { type wall; }" > constant/boundary
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
echo "endTime 2e-3; deltaT 1e-3; writeControl none;" > $control
echo "coupling monolithic;" > $solution
place
body() { echo "structureModel totalLagrangian; $1" > constant/structureProperties; }
for entry in "gap 0;" "gap 1.5; viscosity 1;"; do
    body "material { type neoHookean; G 1e4; } contact { $entry }"
    refused "no effect. Give more, or leave 'contact' away"; says "structureProperties.contact.* at line 1"
done
body "material { type HolzapfelGasserOgden; G 1e4; k1 1e3; k2 1; fibres { type uniform; directions ((0 0 1)); } }"
refused "across the plane of a two-dimensional case"
body "material { type neoHookean; G 1e4; }"
solved
echo "densityFeedback 1;" >> $solution
refused "before open faces, and the case has none: it has no effect"
# ---- a soft layer in a stiff one under a pressure far above its shear modulus: one warning ------------------
bareCase soft
cat > system/particleDict <<'PARTICLES'
dx 1e-3; nDims 2;
zones
{
    inner { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius 13e-3; }
    outer { phase solid; shape annulus; point1 (0 0 0); innerRadius 13e-3; outerRadius 16e-3; }
    lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-3; outerRadius 10e-3; }
}
patches { inlet { box ((-5.1e-3 -5.1e-3 -1) (5.1e-3 5.1e-3 1)); } }
PARTICLES
echo "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
    inlet { type open; p 1e3; }" > constant/boundary
echo "rho 1000; mu 1e-3;" > constant/physicalProperties
echo "endTime 2e-3; deltaT 1e-3; writeControl none;" > $control
echo "coupling monolithic;" > $solution
place
for G in 10 1e5; do
    echo "structureModel totalLagrangian; materials { inner { type neoHookean; G $G; } outer { type neoHookean; G 2e5; } }" \
        > constant/structureProperties
    solved
    warnings=$(grep -c "The pressure in zone inner is .* times its shear modulus G" log)
    [ $G-$warnings = 10-1 ] || [ $G-$warnings = 1e5-0 ] || fail "G $G: $warnings warnings of a soft layer"
done
[ $failures = 0 ]
