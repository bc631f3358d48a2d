#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Surfaces of strangers through generateParticles: what is repaired and said, what is refused and where; facets in
# any order; vessels with open ends, capped, through the solver
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
. "$(dirname "$0")/../cases/geometryFunctions"
stl='file "constant/part.stl"; unit mm;'

# boxes x0 y0 z0 x1 y1 z1 [...]: "facet" lines of nine numbers; stl name: those lines as a solid
boxes() {
    awk -v list="$*" 'BEGIN { n = split(list, b, " ")
        split("0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5", c, " ")
        for (o = 0; o < n; o += 6) for (t = 0; t < 12; ++t) { line = ""
            for (k = 1; k <= 3; ++k) { i = c[3*t + k]
                line = line " " b[o + 1 + 3*(i%2)] " " b[o + 2 + 3*(int(i/2)%2)] " " b[o + 3 + 3*int(i/4)] }
            print line } }'
}
stl() {
    awk -v name="$1" 'BEGIN { print "solid", name } { print "facet normal 0 0 0\nouter loop"
        for (k = 0; k < 3; ++k) print "vertex", $(3*k + 1), $(3*k + 2), $(3*k + 3)
        print "endloop\nendfacet" } END { print "endsolid", name }'
}
facetsOf() { awk '/^ *vertex/ { printf "%s %s %s%s", $2, $3, $4, ++n % 3 ? " " : "\n" }' "$1"; }
# the same facets in another order; every second one is turned and begins at another corner
shuffled() { awk -v seed="$1" 'BEGIN { srand(seed) } { print rand(), $0 }' | sort -g | awk '{ k = NR % 3
    for (i = 0; i < 3; ++i) for (j = 0; j < 3; ++j) c[i, j] = $(2 + 3*i + j)
    s = NR % 2 ? 1 : 2; line = ""
    for (i = 0; i < 3; ++i) for (j = 0; j < 3; ++j) line = line " " c[(k + s*i) % 3, j]
    print line }'; }

# ---- reported and repaired ----------------------------------------------------------------------------------------
boxes 0 0 0 10 10 10 | awk '{ print } NR == 4' | stl part > constant/part.stl
dict "$stl"
accepted "a facet twice" "^Zone water: constant/part.stl \(STL in mm\), 13 facets" "box *\(0 0 0\) to \(0.01 0.01 0.01\) m: 10 x 10 x 10 dx" \
    "repaired *1 facets dropped" "volume *1e-06 m3, about 1000 particles" "thinnest *0.01 m = 10 dx at" "^water .* 1000 "
boxes 0 0 0 10 10 10 | shuffled 1 | stl part > constant/part.stl
accepted "turned facets" "repaired *[0-9]+ of 12 facets turned" "^water .* 1000 "
boxes 0 0 0 10 10 10 | awk '{ print $1, $2, $3, $7, $8, $9, $4, $5, $6 }' | stl part > constant/part.stl
accepted "inside out" "repaired *all normals pointed inwards" "^water .* 1000 "
boxes 0 0 0 10 10 0.8 | stl part > constant/part.stl
dict "$stl" 1e-3 "weldTolerance 1e-7;"
accepted "a thin plate" "thinnest *0.0008 m = 0.8 dx at" "encloses 0.0008 m = 0.8 dx at .*, its thinnest place"
# two bodies, half a spacing apart
boxes 0 0 0 10 10 10 10.5 0 0 20 10 10 | stl part > constant/part.stl
dict "$stl"
accepted "a gap" "gap *0.0005 m = 0.5 dx at \(0.01025 " "leaves a gap of 0.0005 m = 0.5 dx at \(0.01025 " "2 part\(s\)"
# a hole smaller than a particle
{ boxes 0 0 0 10 10 10 | awk 'NR != 3'
  printf '%s 10\n' '0 0 10 10 0 10 9.5 8' '0 0 10 9.5 8 10 9 8' '10 0 10 10 10 10 9.5 8.5' '10 0 10 9.5 8.5 10 9.5 8' \
      '10 10 10 0 0 10 9 8' '10 10 10 9 8 10 9.5 8.5'; } | stl part > constant/part.stl
accepted "a small hole" "repaired *1 holes closed, the largest 0.0005 m across at \(0.0093[0-9]* 0.0081[0-9]* 0.01\)" "^water .* 1000 "
dict "$stl" 1e-3 "closeHoles 0;"
refused "a small hole not to be closed" "not closed" "hole at (0.0093" "= 0.5 dx across, 3 edges"

# ---- refused, and where ----------------------------------------------------------------------------------------------
dict "$stl"
boxes 0 0 0 10 10 10 9 4 4 20 6 6 | stl part > constant/part.stl
refused "crossing parts" "passes through itself: two facets cross at (0.01 0.00" "Unite the parts" "water.file at line 1"
boxes 0 0 0 10 10 10 5 0 0 20 10 10 | stl part > constant/part.stl
refused "parts with common planes" "has parts within one another" "lies in another part"
boxes 0 0 0 10 10 10 | awk 'NR > 2' | stl part > constant/part.stl
refused "an open face" "not closed: 4 open edges of total length 0.04 m, the longest at (" ") m." "hole at (0.005 0.005 0) m, 0.01 m = 10 dx across, 4 edges" "'capping'"
boxes 0 0 0 10 10 10 | stl part > constant/part.stl
printf 'solid a\nfacet normal 0 0 1\nouter loop\nver\001\377tex\n' > constant/part.stl
refused "a byte that is no letter" "Line 4 of the surface file" "'ver\x01\xfftex' stands where vertex should"
boxes 0 0 0 10 10 10 | stl part > constant/part.stl
dict 'file ("constant/part.stl" "constant/other.stl"); unit mm;'
refused "two files for a zone" "A zone has one file" "part.stl" "Give each file a zone of its own" "water.file at line 1"
echo "walls { type wall; } outside { type wall; }" > constant/boundary
dict "$stl"
refused "a patch without faces" "Patch outside has no face" "Patches with faces: walls."
echo "walls { type wall; }" > constant/boundary
boxes 0 0 0 10 10 10 | stl part > constant/part.stl
dict 'file "constant/part.stl"; unit m;' 1e-3
refused "metres for millimetres" "room for 1e+12 particles" "unit" "it would hold about 1e+03"
dict 'file "constant/part.stl"; unit mm;' 1
refused "dx for metres" "could not hold a particle" "it would hold about 1e+03"
dict 'file "constant/part.stl"; unit m;' 1e-9
refused "ten milliard dx" "measures 10 m = 1e+10 dx across"
echo "walls { type wall; } lid { type wall; } side { type wall; }" > constant/boundary
dict 'shape box; min (0 0 0); max (0.01 0.01 0.01);' 1e-3 \
    'patches { lid { box ((-1 -1 0.0099) (1 1 1)); } side { box ((-1 -1 -1) (1 1 1)); } }'
refused "two boxes over one face" "The patches lid and side both choose the facet of a shape, around" "patches.side"
echo "walls { type wall; }" > constant/boundary
solidAt() { dict 'shape box; min (0 0 0); max (0.01 0.01 0.01);' 1e-3; sed -i "s/water {/block { phase solid; shape box; min ($1 0 0); max ($2 0.01 0.01); } water {/; s/lattice/bodyFitted/" system/particleDict; }
solidAt 0.1 0.11
refused "a solid far from the fluid" "The solid zone block touches no fluid" "is 0.09" "Are the units"
solidAt 0.01 0.02
accepted "a solid beside the fluid" "^block .* 1000 "

# ---- several named solids: one file, two zones -------------------------------------------------------------------------
{ boxes 0 0 0 10 10 10 | stl "left part"; boxes 10 0 0 15 10 10 | stl RIGHT; } | tr 'a-z' 'A-Z' > constant/part.stl
echo "dx 1e-3; zones { l { phase fluid; $stl group LEFT_PART; } r { phase fluid; $stl group RIGHT; } }" > system/particleDict
accepted "named solids" "^l .* 1000 " "^r .* 500 "

digits() { # of the particles made
    for file in 0/particles constant/wallParticles; do
        for set in Points PointData/zone; do h5dump -m %.17g -y -w 1 -d "/VTKHDF/$set" $file.hdf 2>/dev/null | sed 1d; done
    done
}
# ---- facets in any order: the same particles, bit for bit --------------------------------------------------------------
echo 'SetFactory("OpenCASCADE"); Sphere(1) = {0.3, 0, 0, 6}; Cylinder(2) = {0, 0, 0, 0, 0, 14, 3};
BooleanUnion { Volume{1}; Delete; }{ Volume{2}; Delete; }' > flask.geo
gmsh -2 -clmax 1 -format stl -o flask.stl flask.geo > /dev/null
facetsOf flask.stl > flask
for placement in lattice bodyFitted; do
    for seed in 0 1 2; do
        { [ $seed = 0 ] && cat flask || shuffled $seed < flask; } | stl part > constant/part.stl
        dict "$stl"; sed -i "s/lattice/$placement/" system/particleDict
        accepted "order $seed" "^water "
        digits > "particles.$seed"
    done
    [ "$(wc -l < particles.0)" -gt 3000 ] || fail "$placement: no particles"
    cmp -s particles.0 particles.1 && cmp -s particles.0 particles.2 || fail "$placement: the order of facets matters"
done

# ---- vessels with open ends ----------------------------------------------------------------------------------------------
# vessel name, script: writes its surface without the faces named in ends(), as STL
vessel() {
    printf 'SetFactory("OpenCASCADE"); %s\n' "$2" > "constant/$1.geo"
    { cat "constant/$1.geo"; echo 's() = Surface{:}; s() -= ends(); Physical Surface("vessel") = s();'; } > "$1.geo"
    gmsh -2 -clmax 0.5 -format stl -o constant/part.stl "$1.geo" > "$1.log" 2>&1 || fail "$1: $(tail -n 3 "$1.log")"
}
# within $1 to $2 percent of $3 m3
volumeIs() { awk -v v="$3" -v lo="$1" -v hi="$2" '/^water / { off = 100*($2/v - 1) } END { exit !(off > lo && off < hi) }' out || fail "$4: $(grep '^water ' out), not $3 m3"; }
steps() { # what: takes five steps from the particles made; fluid enters and leaves through the caps
    echo "coupling projection;" > system/sphSolution; : > system/sphSchemes
    echo "rho 1000; mu 4e-3;" > constant/physicalProperties
    echo "startTime 0; endTime 5e-3; deltaT 1e-3; writeControl timeStep; writeInterval 5;" > system/controlDict
    { solve && [ -f 0.005/particles.hdf ]; } || fail "$1: $(tail -n 8 log)"
    rm -rf 0.*
}

vessel tube 'Cylinder(1) = {0, 0, 0, 0, 0, 16, 5};
ends() = Surface In BoundingBox {-6, -6, -0.1, 6, 6, 0.1}; ends() += Surface In BoundingBox {-6, -6, 15.9, 6, 6, 16.1};'
dict "$stl"
refused "open ends" "hole at (" "0.016) m, 0.01 m = 10 dx across" "ask for 'capping'"
dict "$stl capping automatic;"
refused "automatic caps without a patch" "belongs to patch cap0, which constant/boundary lacks" "capped      cap1 at (0 0 0.016)"
dict "$stl capping { in { near (0 0 0); } out { near (0 0 0.001); } }"
refused "two caps at one end" "The caps in and out are nearest to the same open end"
dict "$stl capping { in { naer (0 0 0); } }"
refused "a misspelt cap" "'near'"
echo "walls { type wall; } in { type open; p 20; } out { type open; p 0; }" > constant/boundary
dict "$stl capping { in { near (0 0 0); } out { near (0 0 0.02); } }"
sed -i 's/lattice/bodyFitted/' system/particleDict
accepted "a capped tube" "capped *in at \(.* 0\) m, 0.01 m = 10 dx across, [0-9]+ edges, normal \(0 0 -1\)" "capped *out at .*normal \(0 0 1\)"
! grep -q "rim moved" out || fail "a capped tube: rounding is told as a move: $(grep "rim moved" out)"
volumeIs -1 0.01 1.256637e-6 "a capped tube"    # pi 5^2 16; facets lie inside
for cap in in out; do
    [ "$(grep -c "facet normal -*0 -*0 -*1$" constant/triSurface/$cap.stl)" = "$(grep -c "facet normal" constant/triSurface/$cap.stl)" ] || fail "$cap is not plane"
done
steps "a capped tube"

vessel wall 'Cylinder(1) = {0, 0, 0, 0, 0, 16, 5}; Cylinder(2) = {0, 0, 0, 0, 0, 16, 3};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
ends() = Surface In BoundingBox {-6, -6, -0.1, 6, 6, 0.1}; ends() += Surface In BoundingBox {-6, -6, 15.9, 6, 6, 16.1};'
dict "$stl capping { in { near (0 0 0); } out { near (0 0 0.016); } }"
sed -i 's/lattice/bodyFitted/' system/particleDict
accepted "a thick vessel's wall" "capped *in at .* m = (10|9.99) dx across" "capped *out at " "thinnest *0.00(19|2)"
volumeIs -1.5 0.1 8.04248e-7 "a thick vessel's wall"    # pi (5^2 - 3^2) 16
printf 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 10, 10, 10}; Fillet{1}{1}{0.5}\n' > constant/rounded.geo
echo "walls { type wall; }" > constant/boundary
dict 'file "constant/rounded.geo"; unit mm;'
accepted "a rounded edge" "rounding *radius 0.000[45][0-9]* m = 0.[45][0-9]* dx at" "is rounded with a radius of"

vessel fork 'Cylinder(1) = {0, 0, 0, 0, 0, 16, 5}; Cylinder(2) = {0, 0, 14, 8, 0, 14, 3.5};
Cylinder(3) = {0, 0, 14, -8, 0, 14, 3.5}; BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
ends() = Surface In BoundingBox {-6, -6, -0.1, 6, 6, 0.1}; ends() += Surface In BoundingBox {4, -4, 25, 12, 4, 31};
ends() += Surface In BoundingBox {-12, -4, 25, -4, 4, 31};'
echo "walls { type wall; }" > constant/boundary
dict 'file "constant/fork.geo"; unit mm;'
accepted "a fork by OpenCASCADE" "^water "
exact=$(awk '/^water / { print $2 }' out)
echo "walls { type wall; } trunk { type open; p 20; } left { type open; p 0; } right { type open; p 0; }" > constant/boundary
facetsOf constant/part.stl | shuffled 5 | stl part > shuffled.stl && mv shuffled.stl constant/part.stl
dict "$stl capping { left { near (-8e-3 0 28e-3); } right { near (8e-3 0 28e-3); } trunk { near (0 0 0); } }"
sed -i 's/lattice/bodyFitted/' system/particleDict
accepted "a fork" "capped *right at \(0.00[78][0-9.]* .*normal \(0.496139 .* 0.868243\)" "capped *trunk"
volumeIs -1 0.1 "$exact" "a fork"
steps "a fork"

# a tube of 48 sides, cut at 45 degrees
awk 'BEGIN { n = 48; m = 12
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
        a = at(i, j); b = at(i + 1, j); c = at(i + 1, j + 1); d = at(i, j + 1); print a, b, c; print a, c, d } }
    function at(i, j,   x) { x = 5*cos(8*atan2(1, 1)*(i%n)/n)
        return sprintf("%.12g %.12g %.12g", x, 5*sin(8*atan2(1, 1)*(i%n)/n), (20 + x)*j/m) }' > oblique
echo "walls { type wall; } in { type open; p 20; } out { type open; p 0; }" > constant/boundary
dict "$stl capping { in { near (0 0 0); } out { near (0 0 0.02); } }"
sed -i 's/lattice/bodyFitted/' system/particleDict
for sense in given turned shuffled; do
    case $sense in given) cat oblique ;; turned) awk '{ print $7, $8, $9, $4, $5, $6, $1, $2, $3 }' oblique ;; shuffled) shuffled 6 < oblique ;; esac |
        stl part > constant/part.stl
    accepted "an oblique end, $sense" "^water "
    digits > "particles.$sense"
    cmp -s particles.given "particles.$sense" || fail "the sense of facets matters where ends are capped: $sense"
done
volumeIs -0.001 0.001 1.566314e-6 "an oblique end"    # 24 sin(2 pi/48) 5^2 20
! grep -q "rim moved\|e-[0-9][0-9] [-0-9]*)" out || fail "an oblique end: rounding is told: $(grep "rim moved\|e-" out)"
# digits that are cut off are no move, teeth of 0.2 mm are
awk '{ for (k = 1; k < 9; ++k) printf "%.4f ", $k; printf "%.4f\n", $9 }' oblique | stl part > constant/part.stl
accepted "an oblique end of few digits" "capped *out at "
! grep -q "rim moved" out || fail "digits that are cut off are told as a move: $(grep "rim moved" out)"
awk '{ for (k = 3; k <= 9; k += 3) if ($k > 19.999 + $(k - 2)) $k += $(k - 1) > 0 ? 0.1 : -0.1; print }' oblique | stl part > constant/part.stl
accepted "an oblique end with teeth" "capped *out at .*, rim moved by up to [0-9.]*e-05 m = 0.0[0-9]* dx"
[ $failures = 0 ]
