#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Files that a run writes: both formats, purged times, tables of function objects during the run and afterwards;
# damaged states, a full disk and folders that cannot be made
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
control=system/controlDict
says() { grep -qE -- "$1" log || fail "$PWD: '$1' is not said: $(tail -n 6 log)"; }
refused() { solve && fail "$PWD: not refused"; says "$1"; }
vtpTimes() { awk -f "$cases/series.awk" particles.vtp.series | sort -g | tr '\n' ' '; }

# ---- solids that touch are one body: the log says so, with the number of links by hand -------------------------------
# three rows on either side of the face, links to 2.1 dx: 3 of dx, 4 oblique ones, 6 of 2 dx
newCase membrane zones
place; setEntry $control endTime 0.01
solved; says "^zones wall and left: 13 links$"; says "^zones wall and right: 13 links$"; says "^structure: springNetwork"
! grep -q "^zones left and right" log || fail "links between zones that do not touch"

# ---- ascii and hdf5 continue each other bit by bit ----------------------------------------------------
newCase membrane hdf5
setEntry $control writeInterval 10; setEntry $control endTime 0.3
echo 'functions
{
    top     { type patchFlux; patch top; }
    exit    { type patchFlux; surface wall_to_bath; zones (bath); }
    mid     { type zoneDiameter; surface wall_to_chamber; point (0.1 0.1 0); axis (0 0 1); enabled no; }
    cavity  { type cavityVolume; surface wall_to_chamber; }
    line    { type lineProfile; start (0.1 0.01 0); end (0.1 0.19 0); fields (U p); phase all; }
    most    { type minMax; timeStart 0.05; timeEnd 0.25; }
    at      { type probes; probeLocations ((0.1 0.05 0)); }
    leaks   { type surfaceLeaks; surface wall_to_chamber; zones (chamber); }
    load    { type forces; patches (piston); zones (wall); }
    shear   { type surfaceSample; patches (walls); zones (wall); surfaceFormat raw; }
    map     { type planeMap; point (0 0 0); normal (0 0 1); xAxis (1 0 0); xRange (0 0.2); yRange (-0.2 0);
              spacing 0.02; zones (chamber bath); fields (U p); slice { zones (wall); thickness 0.01; } }
    power   { type energy; }
}' >> $control
place
solved
for mixed in ascii-ascii hdf5-ascii ascii-hdf5; do
    rm -rf "../$mixed"; cp -r . "../$mixed"; cd "../$mixed" || exit 1
    rm -r 0.* postProcessing particles.hdf.series log
    for format in ${mixed/-/ } hdf5; do  # of 0.1, of 0.2, of 0.3
        echo "writeFormat $format;" >> $control
        solved
        [ $format = hdf5 ] || [ -e 0.3/U ] || fail "$mixed: $(ls 0.3)"
        [ -e kept ] && rm -rf 0.3 || rm -rf 0.2 0.3
        touch kept
    done
    solved
    same 0.3 ../hdf5/0.3 "$mixed"
    cd ../hdf5 || exit 1
done
cd ../ascii-ascii || exit 1
[ "$(vtpTimes)" = "0.1 0.1/particles.vtp 0.2 0.2/particles.vtp " ] || fail "particles.vtp.series: $(vtpTimes)"
grep -q "^    class       particleVectorField;$" 0.1/U || fail "0.1/U has no header: $(head -n 8 0.1/U)"

# ---- afterwards the tables are those of the run ---------------------------------------------------------
cd ../hdf5 || exit 1
mv postProcessing written
ispfPostProcess > log 2>&1 || fail "ispfPostProcess: $(tail -n 5 log)"
[ "$(ls postProcessing)" = "$(ls written | grep -vx -e volumeLedger -e energyLedger)" ] || fail "other functions: $(ls postProcessing)"
for file in $(cd postProcessing && find . -type f); do
    # compares the rows of the written times; texts without times must be equal
    awk -v times=" 0 0.1 0.2 0.3 " -v table="$([[ $file == *.dat && $file != */line.dat && $file != ./map/* ]] || [[ $file == ./at/* ]]; echo $?)" \
        '/^#/ || table != 0 || index(times, " " $1 " ")' "written/$file" | cmp -s - "postProcessing/$file" ||
        fail "$file: $(awk 'index(" 0 0.1 0.2 0.3 ", " " $1 " ")' "written/$file" | diff - "postProcessing/$file" | head -n 4)"
done
cp -r postProcessing before
ispfPostProcess -func "(most load)" -time '0.1:0.2' > log 2>&1 || fail "-func: $(tail -n 5 log)"
[ "$(grep -vc '^#' postProcessing/most/0.1/minMax.dat)" = 2 ] && [ -e postProcessing/load/0.1/force.dat ] || fail "-func, -time"
ispfPostProcess -latestTime > log 2>&1 && ispfPostProcess > log 2>&1 || fail "again: $(tail -n 5 log)"
cmp -s before/most/0/minMax.dat postProcessing/most/0/minMax.dat || fail "a table of before was touched"
cmp -s before/most/0/minMax.dat postProcessing/most/0/minMax_0.dat || fail "no minMax_0.dat beside it"
echo "a { type minMax; writePrecision 2; fields (p); } b { type probes; probeLocations ((0.1 0.05 0)); }" > system/more
ispfPostProcess -dict system/more -latestTime > log 2>&1 || fail "-dict: $(tail -n 5 log)"
awk '!/^#/ && $2 ~ /^-?[0-9][.][0-9][0-9]e/ { found = 1 } END { exit !found }' postProcessing/a/0.3/minMax.dat || fail "writePrecision"
echo "type minMax;" > system/extremes
ispfPostProcess -func extremes -time 0.2 > log 2>&1 && [ -e postProcessing/extremes/0.2/minMax.dat ] || fail "-func of a file: $(tail -n 3 log)"
denied() { ispfPostProcess "${@:2}" > log 2>&1 && fail "accepted: ${*:2}"; says "$1"; }
denied "Did you mean 'most'" -func mots
denied "nearest time is 0.[12]" -time 0.15
denied "is not a list of times" -time x
mv 0.3 0.30001  # a name of few digits; the time in the state selects it too
ispfPostProcess -func extremes -time 0.3 > log 2>&1 || fail "-time of a state: $(tail -n 3 log)"
mv 0.30001 0.3
denied "is not a list of times" -time ""
denied "No particles were written at times 7:" -time 7:

# ---- a tube that widens, its diameter during the run and afterwards -------------------------------------
mkdir -p ../tube/{system,constant}; cd ../tube || exit 1
ends() { echo "$1 { phase clamped; shape annulus; point1 (0 0 $2); point2 (0 0 $3); innerRadius 4e-3; outerRadius 6e-3; }"; }
face() { echo "$1 { box ((-4.1e-3 -4.1e-3 $2) (4.1e-3 4.1e-3 $3)); }"; }
echo "dx 1e-3; placement lattice; zones {
    water { phase fluid; shape cylinder; point1 (0 0 0); point2 (0 0 10e-3); radius 4e-3; }
    tube { phase solid; shape annulus; point1 (0 0 2e-3); point2 (0 0 8e-3); innerRadius 4e-3; outerRadius 6e-3; }
    $(ends left -3e-3 2e-3) $(ends right 8e-3 13e-3) }
    patches { $(face in -1e-4 1e-4) $(face out 9.9e-3 10.1e-3) }" > system/particleDict
for side in in out; do echo "$side { type open; p table ((0 0) (0.05 100)); }"; done > constant/boundary
echo 'rho 1000; mu 0.02;' > constant/physicalProperties
echo 'structureModel springNetwork; E 5000; links radius; radius 2.1;' > constant/structureProperties
echo 'coupling monolithic;' > system/sphSolution; : > system/sphSchemes
echo 'startTime 0; endTime 0.05; deltaT 5e-3; writeControl timeStep; writeInterval 5; functions {
    d { type zoneDiameter; surface tube_to_water; point (0 0 5e-3); axis (0 0 1); } }' > $control
place; solved
mv postProcessing written; ispfPostProcess > log 2>&1 || fail "zoneDiameter: $(tail -n 5 log)"
awk '/^#/ || index(" 0 0.025 0.05 ", " " $1 " ")' written/d/0/zoneDiameter.dat | cmp -s - postProcessing/d/0/zoneDiameter.dat ||
    fail "zoneDiameter afterwards: $(diff written/d/0/zoneDiameter.dat postProcessing/d/0/zoneDiameter.dat | head -n 4)"
awk '!/^#/ { if (!n++) first = $2; last = $2 } END { exit !(n == 3 && first > 7e-3 && first < 9e-3 && last > 1.01*first && last < 1.5*first) }' \
    postProcessing/d/0/zoneDiameter.dat || fail "a tube that widens: $(grep -v '^#' postProcessing/d/0/zoneDiameter.dat)"

# ---- energies: a decaying flow, and an elastic wall that a piston bulges ever faster --------------------
cp -r "$cases/../../tutorials/ispfFsiFoam/taylorGreen" ../decay; cd ../decay || exit 1
echo "functions { e { type energy; } } endTime 0.1;" >> $control
place; solved
awk '!/^#/ { if (!n++) { e0 = $2; bad = ($2/0.25 - 1)^2 > 1e-8 || ($5/(16*3.14159265^2*0.01*0.25) - 1)^2 > 1e-4 } last = ($2 + $7)/e0 }
    END { exit bad || n != 51 || (last - 1)^2 > 1e-4 }' postProcessing/e/0/energy.dat || fail "Taylor-Green: $(sed -n '3p;$p' postProcessing/e/0/energy.dat)"
# a growing body force, afterwards: its value at each time
rm -rf 0.* postProcessing
echo "dimensions [0 1 -2 0 0 0 0]; value table ((0 (0 0 0)) (0.1 (0 -1 0)));" > constant/g
echo "writeControl runTime; writeInterval 0.05;" >> $control
solved; mv postProcessing written; ispfPostProcess > log 2>&1 || fail "energy: $(tail -n 5 log)"
potentials() { awk '$1 == 0 || $1 == 0.05 || $1 == 0.1 { print $1, $4 }' $1/e/0/energy.dat; }
potentials written | awk '{ v[$1] = $2 } END { exit !(v[0] == 0 && v[0.05] > 1e-3 && v[0.1] > 1.9*v[0.05]) }' &&
    diff <(potentials written) <(potentials postProcessing) || fail "potential energy under a growing body force: $(potentials written)"
grep -q "did not have it" log && fail "its past is in the written times"
echo "late { type energy; }" > system/more; ispfPostProcess -dict system/more > log 2>&1 || fail "energy that the run had not: $(tail -n 5 log)"
[ "$(grep -c "Function object late: the run that wrote these times did not have it" log)" = 1 ] || fail "no word of the missing past: $(cat log)"

# ---- forces: shear between plates, and what a pressure drop pushes through them --------------------------
for walls in particles mirror; do
    mkdir -p "$scratch/plates.$walls"/{constant,system}; cd "$scratch/plates.$walls" || exit 1
    echo "rho 1000; mu 1000;" > constant/physicalProperties
    echo "ends { type cyclic; point (0 0 0); separation (0.4 0 0); }
        lid { type wall; representation $walls; point (0 1 0); normal (0 1 0); velocity (1 0 0); }
        floor { type wall; representation $walls; point (0 0 0); normal (0 -1 0); }" > constant/boundary
    echo 'dx 0.04; nDims 2; zones { f { phase fluid; shape box; min (0 0 0); max (0.4 1 0); U ("y" 0 0); } }' > system/particleDict
    echo "coupling projection;" > system/sphSolution; : > system/sphSchemes
    echo "endTime 0.5; deltaT 0.005; writeControl runTime; writeInterval 0.1; functions { f { type forces; patches (lid floor); } }" > $control
    place; solved
    # mu U/H of 0.4 m; steady from the start, so the last half
    for wall in lid floor; do
        tr -d '()' < postProcessing/f/0/force_$wall.dat | awk '$1 > 0.25 { sum += $8; ++n } END { f = sum/n/400; exit !(f*f > 0.97^2 && f*f < 1.02^2) }' ||
            fail "plates of $walls: $(tail -n 1 postProcessing/f/0/force_$wall.dat)"
    done
    mv postProcessing written; ispfPostProcess > log 2>&1 || fail "forces: $(tail -n 5 log)"
    grep '^0.3 ' written/f/0/force.dat | cmp -s - <(grep '^0.3 ' postProcessing/f/0/force.dat) ||
        fail "forces afterwards: $(grep -h '^0.3 ' {written,postProcessing}/f/0/force.dat)"
    rm -r 0.* written postProcessing
    sed -i 's/velocity (1 0 0);//; s/separation (0.4 0 0);/& pressureDrop 1000;/' constant/boundary
    sed -i 's/U ("y" 0 0)/U ("0.5*1000\/0.4\/1000*y*(1-y)" 0 0)/' system/particleDict
    place; solved
    # both walls together carry the force of the drop
    tr -d '()' < postProcessing/f/0/force.dat | awk '$1 > 0.25 { sum += $8; ++n } END { f = sum/n/1000; exit !(f > 0.98 && f < 1.02) }' ||
        fail "a drop between $walls: $(tail -n 1 postProcessing/f/0/force.dat)"
done

# ---- what sticks has been stuck to the wall before p moves it: neither friction nor flow changes with the step -------
mkdir -p "$scratch/slip"/{constant,system}; cd "$scratch/slip" || exit 1
echo "rho 1; mu 0.1;" > constant/physicalProperties
echo 'dx 0.05; nDims 2; zones { f { phase fluid; shape box; min (0 0 0); max (0.8 0.5 0); U ("2.5*y*(0.5-y)" 0 0); } }
    patches { left { box ((-1 -1 -1) (0.001 1 1)); } right { box ((0.799 -1 -1) (2 1 1)); } }' > system/particleDict
echo "coupling projection;" > system/sphSolution; : > system/sphSchemes
mean() { tr -d '()' < "$1" | awk -v c="$2" '$1 > 3 { sum += $c; ++n } END { print sum/n }'; }
surplus() { # patch boundary...: friction and flow with one dt over the other, of 0.2 and of Poiseuille's flow; is a flow 0.5 % off?
    local dt
    echo "${*:2} walls { type wall; }" > constant/boundary
    for dt in 0.01 0.0025; do
        rm -rf [1-9]* postProcessing
        echo "endTime 5; deltaT $dt; writeControl runTime; writeInterval 5;
            functions { f { type forces; patches (walls); } q { type patchFlux; patch $1; } }" > $control
        place; solved
        echo "$dt $(mean postProcessing/f/0/force.dat 8) $(mean postProcessing/q/0/patchFlux.dat 2)"
    done | awk '{ f = $2/0.2 - f; q = $3/0.0520833 - q; if (($3/0.0520833 - 1)^2 > 0.005^2) off = 1 } END { print -f, -q, off + 0 }'
}
surplus right 'left { type open; p 0.4; } right { type open; p 0; }' > open
awk '{ print "    projection between open faces, four times the step: friction", $1, "flow", $2, "more"
       exit !($1^2 < 0.01^2 && $2^2 < 0.01^2 && !$3) }' open || fail "a projection that slips: $(cat open)"
sed -i 's/patches {.*//' system/particleDict
surplus ends 'ends { type cyclic; point (0 0 0); separation (0.8 0 0); pressureDrop 0.4; }' > drop
awk '{ exit !($1^2 < 1e-6 && $2^2 < 1e-6) }' drop || fail "a projection with a pressureDrop slips: $(cat drop)"

# ---- moments: a cylinder that turns around one at rest (Taylor & Couette), 4 pi mu omega /(1/ri^2 - 1/ro^2) ---------
for walls in particles mirror; do
    mkdir -p "$scratch/turning.$walls"/{constant,system}; cd "$scratch/turning.$walls" || exit 1
    echo "rho 1; mu 1;" > constant/physicalProperties
    echo "inner { type wall; representation $walls; }
        outer { type wall; representation $walls; rotation { origin (0 0 0); axis (0 0 1); omega 2; } }" > constant/boundary
    echo 'dx 0.06; nDims 2; zones { f { phase fluid; shape annulus; point1 (0 0 0); innerRadius 0.5; outerRadius 1; } }
        patches { inner { box ((-0.6 -0.6 -1) (0.6 0.6 1)); } } defaultPatch outer;' > system/particleDict
    echo "coupling monolithic;" > system/sphSolution; : > system/sphSchemes
    echo "endTime 0.5; deltaT 0.005; writeControl timeStep; writeInterval 100;
        functions { f { type forces; patches (inner outer); } e { type energy; } }" > $control
    place; solved
    for wall in inner outer; do
        tr -d '()' < postProcessing/f/0/moment_$wall.dat | awk -v sign=$([ $wall = inner ] && echo 1 || echo -1) '
            $1 > 0.35 { sum += $4; ++n } END { m = sign*sum/n/8.37758; exit !(m > 0.95 && m < 1.05) }' ||
            fail "a cylinder of $walls that turns: $wall: $(tail -n 1 postProcessing/f/0/moment_$wall.dat)"
    done
    awk '$1 > 0.35 { sum += $6; ++n } END { p = sum/n/16.7552; exit !(p > 0.95 && p < 1.05) }' postProcessing/e/0/energy.dat ||
        fail "a cylinder of $walls that turns: power: $(tail -n 1 postProcessing/e/0/energy.dat)"
done
newCase membrane bulging
ramp=$(awk 'BEGIN { for (i = 0; i <= 50; ++i) { t = i*0.0025; printf "(%.6g %.8g)", t, 0.5*t*t } }')
sed -i "s/displacement { .* } }/displacement table ($ramp); }/" constant/boundary
echo "functions { e { type energy; } f { type forces; patches (piston); } } endTime 0.125; deltaT 0.0025; writeInterval 50;" >> $control
place; solved
# The power in that state belongs to the load over the last step: 0.5 t^2 moves at t - dt/2
paste <(tail -n 1 postProcessing/e/0/energy.dat) <(tail -n 1 postProcessing/f/0/force.dat | tr -d '()') |
    awk '{ ratio = -$6/$23/0.12375; exit !(ratio > 0.9999 && ratio < 1.0001) }' ||
    fail "power of the piston: $(tail -qn 1 postProcessing/e/0/energy.dat postProcessing/f/0/force.dat)"
awk '!/^#/ { all = $2 + $3 + $7; work = $8; share = $3/all } END { exit !(share > 0.05 && (all/work - 1)^2 < 0.0025) }' \
    postProcessing/e/0/energy.dat || fail "what the piston puts in and where it is: $(tail -n 1 postProcessing/e/0/energy.dat)"
# Poiseuille's flow from inlet to outlet: the power 12 mu U L/H^2 over U H comes in and goes into friction.  With 16
# particles across, friction is 6 % too large (32: 2 %)
mkdir -p ../through/{system,constant}; cd ../through || exit 1
echo 'dx 5e-3; nDims 2; zones { water { phase fluid; shape box; min (0 0 0); max (0.3 0.1 0);
    U ("6*y*(0.1 - y)" 0 0); p "2.4*(0.3 - x)"; } }
patches { in { box ((-1 -1 -1) (0.001 1 1)); } out { box ((0.299 -1 -1) (1 1 1)); } }' > system/particleDict
echo 'in { type open; flowRate 1e-3; profile parabolic; } out { type open; p 0; backflow 0; } walls { type wall; }' > constant/boundary
echo 'rho 1000; mu 0.2;' > constant/physicalProperties
echo 'coupling projection;' > system/sphSolution; : > system/sphSchemes
echo 'startTime 0; endTime 0.15; deltaT 2.5e-3; writeControl timeStep; writeInterval 20; functions {
    e { type energy; } in { type patchFlux; patch in; } out { type patchFlux; patch out; } }' > $control
place; solved
awk '!/^#/ && $1 > 0.04 { if (!n++) { t = $1; all = $2 + $7; work = $10 } rest = ($2 + $7 - all)/($10 - work) - 1; power = ($10 - work)/($1 - t) }
    END { exit !(n > 40 && (power/7.2e-4 - 1)^2 < 0.04^2 && rest*rest < 0.1^2) }' postProcessing/e/0/energy.dat ||
    fail "energies of a flow through: $(tail -n 1 postProcessing/e/0/energy.dat)"
for face in in out; do
    awk -v sign="$([ $face = in ] && echo -1 || echo 1)" '!/^#/ { flux = sign*$2; volume = sign*$3; t = $1 }
        END { exit !((flux/1e-3 - 1)^2 < 0.02^2 && (volume/(1e-3*t) - 1)^2 < 0.02^2) }' postProcessing/$face/0/patchFlux.dat ||
        fail "flux through $face: $(tail -n 1 postProcessing/$face/0/patchFlux.dat)"
done
mv postProcessing written
ispfPostProcess > log 2>&1 || fail "ispfPostProcess: $(tail -n 5 log)"
for file in in/0/patchFlux.dat out/0/patchFlux.dat; do
    awk 'index(" 0 0.05 0.1 0.15 ", " " $1 " ")' written/$file | cmp -s - <(grep -v '^#' postProcessing/$file) || fail "$file afterwards"
done
cd ../hdf5 || exit 1

# ---- purged times leave the series true, in both formats and after a restart ---------------------------
for format in hdf5 ascii; do
    rm -rf ../purge; cp -r ../hdf5 ../purge; cd ../purge || exit 1
    rm -r 0.* particles.*.series; sed -i '/^functions/,$d' $control
    echo "writeFormat $format; purgeWrite 2; writeInterval 2; endTime 0.1;" >> $control
    solved
    echo "endTime 0.16;" >> $control
    solved
    file=particles.$([ $format = hdf5 ] && echo hdf || echo vtp)
    [ "$(awk -f "$cases/series.awk" $file.series | sort -g)" = "$(for f in */"$file"; do echo "${f%%/*} $f"; done | sort -g)" ] ||
        fail "$format: $(cat $file.series)"
    [ "$(ls -d 0.* | tr '\n' ' ')" = "0.08 0.1 0.14 0.16 " ] || fail "$format: purged to $(ls -d 0.*)"
done

# ---- a last state that is no good is the user's to put away -------------------------------------------
cd ../hdf5 || exit 1
cp 0.3/particles.hdf good.hdf
truncate -s -100 0.3/particles.hdf
refused "Cannot read '.*/0.3/particles.hdf': not an HDF5 file, or truncated"
says "To continue from time 0.2, move the folder .*/0.3 away, or set startFrom startTime and startTime 0.2"
printf x | dd of=0.3/particles.hdf bs=1 seek=20000 conv=notrunc 2> log.dd; cp good.hdf 0.3/particles.hdf
printf '\x55' | dd of=0.3/particles.hdf bs=1 seek=$(($(stat -c %s good.hdf) / 2)) conv=notrunc 2> log.dd
refused "checksum of '/.*' does not fit its content"
h5dump -d /VTKHDF/PointData/p -o values.txt good.hdf > log.h5dump && echo "solid" > 0.3/particles.hdf
refused "not an HDF5 file"
mv 0.3 ../bad
solved
cp good.hdf ../bad/particles.hdf; same 0.3 ../bad "from the state before"
cp 0.2/particles.hdf 0.3/particles.hdf; solved
says "The particles in .*/0.3 were written at time 0.2: they are taken for those of time 0.3"
cp good.hdf 0.3/particles.hdf
cp 0.3/uniform/time goodTime; sed -i 's/^index .*/index 77;/; /^checksum/d' 0.3/uniform/time; solved
says "0.3/uniform/time is not of these particles: step 77 of 0.01 s, not 30 of 0.01 s. The clock is set from the particles"
mv goodTime 0.3/uniform/time
echo "startFrom startTime; startTime 0.25;" >> $control
refused "There are no particles of time 0.25: .*/0.25/particles.hdf is missing"
says "Times with particles: 0 0.1 0.2 0.3; startFrom and startTime"

# ---- a file of the last state that is gone is missed: it is not gone on from an earlier one over it ------------------
rm -rf ../parts; cp -r ../purge ../parts; cd ../parts || exit 1
echo "endTime 0.18;" >> $control
for lost in uniform/particles U positions; do
    mv 0.16/$lost lost; sums=$(cksum 0.16/* 2> /dev/null)
    refused "/0.16 is incomplete: particles.vtp is there, but neither particles.hdf nor uniform/particles|/0.16/$lost.* is missing"
    [ "$sums" = "$(cksum 0.16/* 2> /dev/null)" ] || fail "without $lost: 0.16 has changed"
    mv lost 0.16/$lost
done
sed -i.sound 's/^deltaT .*/deltaT 0.02;/' 0.16/uniform/time
refused "/0.16/uniform/time was damaged, or edited"
sed -i '/^checksum/d' 0.16/uniform/time; mkdir 0.3; touch 0.3/picture.png; mkdir 0.4; touch 0.4/positions 0.4/U.tmp
solved
says "/0.3 holds no particles .but picture.png.: it is passed over"
says "/0.4 was being written when its run was ended"
[ "$(grep -m 1 '^Time = ' log)" = "Time = 0.17" ] || fail "begins with $(grep -m 1 '^Time = ' log)"
cd ../hdf5 && sed -i '/^startFrom startTime; startTime 0.25/d' $control && mv 0.3/particles.hdf 0.3/kept.hdf || exit 1
refused "/0.3 is incomplete: uniform/time is there, but neither particles.hdf"
mv 0.3/kept.hdf 0.3/particles.hdf

# ---- a full disk, folders that cannot be made: what was written stays ---------------------------------
cd ../purge || exit 1
echo "purgeWrite 0; writeFormat hdf5; endTime 0.18;" >> $control
cp -r . ../full; cd ../full || exit 1
find . -type f -not -name 'log*' -not -path './system/*' -exec md5sum {} + | sort > ../sums
# a limit on the size of a file fails as a full disk does
(ulimit -f 40; trap '' XFSZ; ispfFsiFoam > /dev/null 2> log) && fail "a full disk is not noticed"
says "Free some space or raise the limit"
md5sum --quiet -c ../sums > log.sums 2>&1 || fail "full disk: $(cat log.sums)"
find . -name '*.tmp' | grep . && fail "temporary files are left"
echo "writeFormat ascii;" >> $control
(ulimit -f 20; trap '' XFSZ; ispfFsiFoam > /dev/null 2> log) && fail "a full disk is not noticed, ascii"
says "Free some space or raise the limit"
md5sum --quiet -c ../sums > log.sums 2>&1 || fail "full disk, ascii: $(cat log.sums)"
[ -e 0.18/U ] && fail "a part of a state: $(ls 0.18)"
rm -rf 0.18; echo "not a folder" > 0.18
refused "Cannot write '.*/0.18/.*': creating folder"
rm 0.18; rm -rf postProcessing; echo "not a folder" > postProcessing
refused "Cannot write '.*/postProcessing/.*': creating folder"
md5sum --quiet -c <(grep -v postProcessing ../sums) > log.sums 2>&1 || fail "no folder: $(cat log.sums)"
[ $failures = 0 ]
