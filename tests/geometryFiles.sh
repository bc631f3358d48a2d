#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Geometry files of strangers through generateParticles: units they declare, files that are not what they say,
# that are cut off, and readers that hang or end the process
set -uo pipefail
. "$(dirname "$0")/cases/functions"
. "$(dirname "$0")/cases/geometryFunctions"
mkdir tmp
export TMPDIR=$scratch/tmp

# ---- units: 10 x 10 x 10 in each, the report says which ----------------------------------------------------
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

# ---- not what its name says -----------------------------------------------------------------------------------
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

# ---- cut off: told at once, wherever --------------------------------------------------------------------------
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
[ -z "$(ls -A tmp)" ] || fail "files are left: $(ls tmp)"
! pgrep -P $$ generatePartic > /dev/null || fail "a process is left"
[ $failures = 0 ]
