#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# generateParticles on geometry files of other programs: declared units, files whose content differs from their type,
# files that are cut off, and readers that hang or end the process
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
. "$(dirname "$0")/../cases/geometryFunctions"
mkdir tmp
export TMPDIR=$scratch/tmp

# ---- units: 10 x 10 x 10 of each; the report names the unit ------------------------------------------------
printf 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 10, 10, 10};\n' > constant/cube.geo
gmsh -0 -format step -o constant/mm.step constant/cube.geo > /dev/null
sed 's/SI_UNIT(.MILLI.,.METRE.)/SI_UNIT($,.METRE.)/' constant/mm.step > constant/m.stp
sed "s/LENGTH_UNIT() NAMED_UNIT(\*) SI_UNIT(.MILLI.,.METRE.)/CONVERSION_BASED_UNIT('INCH',#9001) LENGTH_UNIT() NAMED_UNIT(#9002)/" constant/mm.step |
    awk '/^ENDSEC;/ && ++n == 2 { print "#9001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9003);"
        print "#9002 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);"
        print "#9003 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );" } { print }' > constant/inch.STEP
while read -r file dx volume; do
    dict "file \"constant/$file\";" "$dx"
    accepted "$file" "^water  *$volume  *1000 "
done <<'END2'
mm.step   1e-3    1e-06
m.stp     1       1000
inch.STEP 25.4e-3 0.016387
END2
# a unit entry may repeat the declared unit, but not contradict it
dict 'file "constant/inch.STEP"; unit inch;' 25.4e-3
accepted "inch.STEP that is in inch" "STEP in inch, as it declares" "^water  *0.016387  *1000 "
dict 'file "constant/inch.STEP"; unit mm;'
refused "inch.STEP for mm" "inch.STEP declares that it is in inch, but 'unit mm;' says mm" "at line 1"
dict 'file "constant/m.stp"; unit inch;'
refused "m.stp for inch" "m.stp declares that it is in m, but 'unit inch;' says inch"
dict 'file "constant/mm.step"; unit mm;'
accepted "mm.step that is in mm" "^water  *1e-06  *1000 "
sed "3s/2,2HMM,/1,2HIN,/" "$geometry/hccB.igs" > constant/unit.igs
dict 'file "constant/unit.igs"; unit mm; colour (204 0 0);'
refused "IGES in inch for mm" "declares that it is in inch, but 'unit mm;' says mm"
sed "3s/2,2HMM,/0,2HMM,/" "$geometry/hccB.igs" > constant/unit.igs
dict 'file "constant/unit.igs"; unit cm; colour (204 0 0);' 0.04
accepted "IGES without a unit, said to be in cm" "IGES in cm" "^water .* 74 "
# the global section of an IGES file: flag 2 is mm, 6 m, 1 inch; the wall's volume in cubes of the unit stays
while read -r flag unit; do
    sed "3s/2,2HMM,/$flag,/" "$geometry/hccB.igs" > constant/unit.igs
    dict 'file "constant/unit.igs"; colour (204 0 0);' "$(awk -v u="$unit" 'BEGIN { print 4*u }')"
    accepted "IGES unit $flag" "^water .* 74 "
    awk -v u="$unit" '/^water / { v = $2/u^3 } END { exit !(v > 4755 && v < 4765) }' out || fail "$flag: $(grep '^water ' out)"
done <<'END2'
2,2HMM 1e-3
6,2HM_ 1
1,2HIN 25.4e-3
END2

# without a flag gmsh would read inch; a model scale of 2 means that lengths are twice as long as the body's.  The last
# column is the spacing that fills the wall with the same number of particles
globalSection() { # the values of the model scale, the unit's flag and its name: constant/unit.igs
    awk -v values="$1" 'NR == 3 { sub(/1[.],2,2HMM,/, values); sub(/ *G0000002/, ""); $0 = sprintf("%-72sG0000002", $0) } { print }' \
        "$geometry/hccB.igs" > constant/unit.igs
}
while read -r global unit dx; do
    globalSection "$global"
    dict "file \"constant/unit.igs\"; $([ "$unit" = - ] || echo "unit $unit;") colour (204 0 0);" "$dx"
    accepted "IGES $global unit $unit" "^water .* 74 "
    [ "$unit" != - ] || [[ $global = *,2,* ]] || grep -q "unit.igs declares no unit that is known: it is read in mm" out ||
        fail "IGES $global: nothing said of its unit"
done <<'END2'
1.,,, - 4e-3
1.,,, mm 4e-3
1.,,, cm 4e-2
1.,,2HIN, - 4e-3
1.,0,, - 4e-3
1.,12,2HMM, - 4e-3
2.,2,2HMM, - 2e-3
.5D0,2,2HMM, - 8e-3
2.,,, cm 2e-2
,2,2HMM, - 4e-3
END2
grep -q "model scale" out && fail "a model scale is told of that there is not"
globalSection 2.,2,2HMM,
dict 'file "constant/unit.igs"; colour (204 0 0);' 2e-3
accepted "IGES at twice its size" "IGES in mm, as it declares, model scale 2: lengths are divided by it"
for scale in 0. -1. two; do
    globalSection "$scale,2,2HMM,"
    refused "a model scale of $scale" "has the model scale '$scale'" "no positive number" "water.file at line 1"
done
# texts whose length is not the one announced: readers wait for ever or read something else
for wrong in 's/8HhccB.igs/9HhccB.igs/' 's/8HhccB.igs/7HhccB.igs/' 's/4HRED3;  /400HRED3;/' 's/4HRED3/3HRED3/'; do
    sed "$wrong" "$geometry/hccB.igs" > constant/unit.igs
    start=$(date +%s)
    refused "a text of another length, $wrong" "of the IGES file" "announces a text of" "number before the H is wrong"
    [ $(($(date +%s) - start)) -lt 10 ] || fail "$wrong: $(($(date +%s) - start)) s"
done
dict 'file "constant/unit.igs"; colour (204 0 0);' 4e-3
# an entity that refers to itself, a curve made of itself twice, takes any memory and time if it may
awk -v own=19 '{ kind = substr($0, 73, 1); number = substr($0, 74) + 0 }
    kind == "D" && (number == own || number == own + 1) { $0 = sprintf("%8d", 102) substr($0, 9) }
    kind == "P" && substr($0, 65, 8) + 0 == own { $0 = sprintf("%-64s", n++ ? "" : "102,2," own "," own ";") substr($0, 65) }
    { print }' "$geometry/hccB.igs" > constant/unit.igs
start=$(date +%s)
(ulimit -v 6000000; refused "a curve made of itself" "does one of its entities refer to itself" "water.file at line 1"; [ $failures = 0 ]) || failures=$((failures+1))
[ $(($(date +%s) - start)) -lt 20 ] || fail "a curve made of itself: $(($(date +%s) - start)) s"

# ---- content differs from the type ----------------------------------------------------------------------------
printf 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n' > constant/one.stl
lies() { # what is in it, its name, then words
    cp "$1" "constant/$2"
    dict "file \"constant/$2\"; unit mm;"
    refused "$1 as $2" "${@:3}"
}
lies constant/one.stl lie.step "named as STEP but holds STL data" "water.file at line 1"
lies constant/one.stl lie.igs "named as IGES but holds STL data"
lies constant/mm.step lie.stl "named as STL but holds STEP data"
lies constant/mm.step lie.brep "named as BREP but holds STEP data"
lies constant/mm.step lie.geo "named as a gmsh script but holds STEP data"
gzip -c constant/one.stl > one.gz
lies one.gz lie.stl "holds gzip-compressed data"
lies constant/boundary lie.step "is not STEP: its first line should be ISO-10303-21;"
lies constant/boundary lie.stl "is not STL"
lies /dev/null lie.step "lie.step is empty"
mkdir constant/folder.stl
dict 'file "constant/folder.stl"; unit mm;'
refused "a folder" "folder.stl is not a file"
mkfifo constant/pipe.stl
dict 'file "constant/pipe.stl"; unit mm;'
refused "a pipe that nobody fills" "pipe.stl is not a file"

# ---- cut off at any place: reported at once -------------------------------------------------------------------
gmsh -0 -format brep -o constant/whole.brep constant/cube.geo > /dev/null
cp constant/mm.step constant/whole.step
cp "$geometry/hccB.igs" constant/whole.igs
for type in brep step igs; do
    size=$(stat -c %s constant/whole.$type)
    for part in 30 60 90 99; do
        head -c $((size * part / 100)) constant/whole.$type > constant/cut.$type
        dict "file \"constant/cut.$type\";" 5e-3
        refused "$part % of a .$type" "cut.$type is cut off"
    done
done

# ---- readers that hang, end the process, or are ended ------------------------------------------------------------
printf 'For i In {1:1000000000}\nEndFor\n' > constant/hang.geo
dict 'file "constant/hang.geo"; unit mm;' 1e-3 "timeLimit 1;"
start=$(date +%s)
refused "a script without an end" "hang.geo with gmsh did not finish within 1 s" "'timeLimit' sets" "water.file at line 1"
[ $(($(date +%s) - start)) -lt 20 ] || fail "a script without an end: $(($(date +%s) - start)) s"
echo 'Exit;' > constant/exit.geo
dict 'file "constant/exit.geo"; unit mm;'
refused "a script that ends the process" "exit.geo with gmsh ended its process with status 0"
echo 'SystemCall "kill -SEGV $PPID";' > constant/killed.geo
dict 'file "constant/killed.geo"; unit mm;'
refused "a reader that is ended" "was ended by the signal Segmentation fault after"
grep -q "$(printf '\033')" out && fail "colours of a terminal are quoted: $(cat -v out)"
dict 'file "constant/mm.step"; group C;'
refused "a group that is not there" "No face of" "has group C" "6 faces with no colours and no groups"
dict 'shape box; min (0 0 0); max (1e300 1 1);'
refused "a box beyond all sense" "The coordinate 1e+300 m of max" "zones.water.max at line 1"
dict 'shape sphere; radius 0.01; centre (0 1e300 0);'
refused "a sphere beyond all sense" "The coordinate 1e+300 m of centre" "zones.water.centre at line 1"
dict 'shape box; min (0 0 0); max (0.01 0.01 0.01); p "1e3*z" [bar];'
refused "a unit behind a formula" "A unit [...] cannot stand behind the value of 'p'" "zones.water.p at line 1"
dict 'shape box; min (0 0 0); max (0.01 0.01 0.01); p 2 [bar];'
accepted "a unit behind a number"
h5dump -d /VTKHDF/PointData/p 0/particles.hdf > out; grep -q "(0): 200000, " out || fail "p 2 [bar]: $(head out)"
[ -z "$(ls -A tmp)" ] || fail "files are left: $(ls tmp)"
! pgrep -P $$ generatePartic > /dev/null || fail "a process is left"
[ $failures = 0 ]
