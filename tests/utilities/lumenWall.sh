#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `thickness`: walls around the lumens of vessels.  Volumes of straight and bent tubes and of a channel in two dimensions,
# no solid particle in a lumen or across an opening, what is refused and where
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
. "$(dirname "$0")/../cases/geometryFunctions"

# tube file script: facets around the axis through the points that x, y and z of awk's script give for the angle a and the
# way s from 0 to 1, as the solids wall, in and out
tube() {
    awk "BEGIN { n = 60; m = 40; pi = atan2(0, -1)
        facets(\"wall\"); facets(\"in\"); facets(\"out\") }
    function facets(name,   i, j) { print \"solid\", name
        for (i = 0; i < n; ++i) {
            if (name == \"in\" && i > 0) facet(at(0, 0), at(i + 1, 0), at(i, 0))
            if (name == \"out\" && i > 0) facet(at(0, m), at(i, m), at(i + 1, m))
            for (j = 0; name == \"wall\" && j < m; ++j) {
                facet(at(i, j), at(i + 1, j), at(i + 1, j + 1)); facet(at(i, j), at(i + 1, j + 1), at(i, j + 1)) } }
        print \"endsolid\", name }
    function facet(p, q, r) { if (p != q && q != r && p != r)
        print \"facet normal 0 0 0\nouter loop\nvertex \" p \"\nvertex \" q \"\nvertex \" r \"\nendloop\nendfacet\" }
    function at(i, j,   a, s, x, y, z) { a = 2*pi*(i%n)/n; s = j/m; $2; return sprintf(\"%.9g %.9g %.9g\", x, y, z) }" > "constant/$1.stl"
}
straight='x = 5*cos(a); y = 5*sin(a); z = 20*s'
oblique='x = 5*cos(a); y = 5*sin(a); z = (20 + x)*s'
bend() { echo "r = $1 + 5*cos(a); y = 5*sin(a); x = r*cos($2*s); z = r*sin($2*s)"; } # radius of the axis, angle
# case file dx thickness [of the wall [of the blood [further entries]]]
ends='patches { in { group in; } out { group out; } }'
case_() {
    cat > system/particleDict <<DICT
dx $2; ${6:-$ends}
zones
{
    wall  { phase solid; file "constant/$1.stl"; unit mm; thickness $3; ${4:-} }
    blood { phase fluid; file "constant/$1.stl"; unit mm; ${5:-} }
}
DICT
}
# volumeIs zone exact: within 0.2 %
volumeIs() { awk -v zone="$1" -v v="$2" '$1 == zone { off = $2/v - 1; found = 1 } END { exit !(found && off*off < 4e-6) }' out || fail "volume of $1: $(grep "^$1 " out), not $2"; }
# places number: x y z of the particles of the zone with this number
places() {
    paste -d ' ' <(h5dump -m %.17g -y -w 1 -d /VTKHDF/PointData/zone 0/particles.hdf | awk 'NF == 1 && $1 ~ /^[0-9]+,?$/ { print $1 + 0 }') \
        <(h5dump -m %.17g -y -w 1 -d /VTKHDF/Points 0/particles.hdf | tr -d ',' | awk 'NF == 1 && $1 ~ /^[-+.0-9e]+$/ { printf "%s%s", $1, ++n % 3 ? " " : "\n" }') |
        awk -v zone="$1" '$1 == zone { print $2, $3, $4 }'
}
# noneWhere condition what: no solid particle (x y z in mm) where the condition of awk holds
noneWhere() {
    places 0 | awk "{ x = 1e3*\$1; y = 1e3*\$2; z = 1e3*\$3; r = sqrt(x*x + y*y) } $1 { ++bad } END { exit !(NR > 0 && bad == 0) }" ||
        fail "$2: a solid particle where $1, or none at all"
}
echo "in { type open; p 0; } out { type open; p 0; }" > constant/boundary

# ---- a straight tube: pi ((R + h)^2 - R^2) L ----------------------------------------------------------------------------
tube straight "$straight"
case_ straight 1e-3 2e-3
accepted "a straight tube" "wall *0.002 m = 2 dx thick around the lumen, .* open at in \(0 0 0\) m, open at out \(0 0 0.02\) m" "^wall .* 2\$"
volumeIs wall 1.507964e-6
volumeIs blood 1.570796e-6
noneWhere "r < 5 || r > 7 || z < 0 || z > 20" "a straight tube"
# open faces: no facet of the wall in their planes within the lumen, and none of the fluid's walls is left
[ "$(ls constant/triSurface)" = "$(printf 'in.stl\nout.stl\nwall_to_blood.stl')" ] || fail "surfaces of a tube: $(ls constant/triSurface)"
case_ straight 1e-3 3e-3 "openings (in out);"
accepted "listed openings" "^wall .* 3\$"
volumeIs wall 2.450442e-6
# an open face beside a solid: the wall reaches beyond it, and the solver takes it
case_ straight 1e-3 3e-3 "beyond 3e-3;"
accepted "beyond the openings" "open at out \(0 0 0.02\) m, 0.003 m beyond them" "^wall .* 3\$"
volumeIs wall 3.185575e-6
noneWhere "r < 5 || r > 8 || z < -3 || z > 23" "a wall beyond the openings"
echo "in { type open; p 20; } out { type open; p 0; }" > constant/boundary
echo "coupling monolithic;" > system/sphSolution; : > system/sphSchemes
echo "rho 1000; mu 4e-3;" > constant/physicalProperties
echo "structureModel springNetwork; E 1e5; links radius; radius 2.1;" > constant/structureProperties
echo "startTime 0; endTime 2e-3; deltaT 5e-4; writeControl timeStep; writeInterval 4;" > system/controlDict
{ solve && [ -f 0.002/particles.hdf ]; } || fail "the solver with a wall beyond the openings: $(tail -n 8 log)"
rm -rf 0.*
case_ straight 1e-3 2e-3 "openings (in);" "" "patches { in { group in; } }"
echo "in { type open; p 0; }" > constant/boundary
accepted "one opening: a wall over the other end" "open at in \(0 0 0\) m$"
noneWhere "r < 5 && z < 20 || z < 0" "a wall over one end"
places 0 | awk '$3 > 0.02 { ++n } END { exit !(n > 150) }' || fail "no wall over the end that is no opening"
# a file with open ends: each is an opening
echo "in { type open; p 0; } out { type open; p 0; }" > constant/boundary
sed '/^solid in/,$d' constant/straight.stl > constant/ends.stl
case_ ends 1e-3 2e-3 "" "capping { in { near (0 0 0); } out { near (0 0 0.02); } }" "defaultPatch walls;"
accepted "open ends" "open at cap[01] \(0 0 0\) m" "^wall .* 2\$"
volumeIs wall 1.507964e-6
# cut at 45 degrees: the wall ends in the plane of the opening
tube oblique "$oblique"
case_ oblique 1e-3 2e-3
accepted "an oblique end" "^wall "
volumeIs wall 1.507964e-6
noneWhere "r < 5 || r > 7 || z < 0 || z > 20 + x" "an oblique end"

# ---- a bent tube: pi ((R + h)^2 - R^2) B angle ----------------------------------------------------------------------------
tube bent "$(bend 10 pi/2)"
case_ bent 1e-3 3e-3
accepted "a bent tube" "^wall .* 3\$"
volumeIs wall 1.924226e-6
noneWhere "(sqrt(x*x + z*z) - 10)^2 + y*y < 25 || z < 0 || x < 0" "a bent tube"

# ---- a fork of three openings, whose wall must be the points nearer than 2 mm to the lumen -----------------------------------
printf 'SetFactory("OpenCASCADE"); %s\n' 'Cylinder(1) = {0, 0, 0, 0, 0, 16, 5}; Cylinder(2) = {0, 0, 14, 8, 0, 14, 3.5};
Cylinder(3) = {0, 0, 14, -8, 0, 14, 3.5}; BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };' > constant/fork.geo
fork() { # thickness
    cat > system/particleDict <<DICT
dx 1e-3; patches { trunk { box ((-1 -1 -1e-6) (1 1 1e-6)); } left { box ((-12e-3 -1 25e-3) (-4e-3 1 31e-3)); } right { box ((4e-3 -1 25e-3) (12e-3 1 31e-3)); } }
zones { wall { phase solid; file "constant/fork.geo"; unit mm; thickness $1; } blood { phase fluid; file "constant/fork.geo"; unit mm; } }
DICT
}
echo "trunk { type open; p 0; } left { type open; p 0; } right { type open; p 0; }" > constant/boundary
fork 2e-3
accepted "a fork" "open at trunk \(0 0 0\) m" "open at left" "open at right" "^wall .* 2\$"
# inside the lumen; below the trunk's end; beyond the planes of the branches, whose axes lead to (8 0 28) and (-8 0 28)
noneWhere "r < 4.98 && z < 16" "the trunk of a fork"
noneWhere "z < 0 || (8*x + 14*(z - 14) > 260) || (-8*x + 14*(z - 14) > 260)" "the ends of a fork"
for side in 1 -1; do
    noneWhere "(s = ($side*8*x + 14*(z - 14))/16.1245) > 2 && x*x + y*y + (z - 14)^2 - s*s < 3.48^2" "a branch of a fork"
done

# ---- two dimensions: a channel and a ring ------------------------------------------------------------------------------------
echo "in { type open; p 0; } out { type open; p 0; }" > constant/boundary
prism() { # file outline: x y and the name of the side that begins there, counter-clockwise
    awk -v n=0 '{ x[n] = $1; y[n] = $2; s[n++] = $3 } function f(p, q, r) { print "facet normal 0 0 0\nouter loop\nvertex " p "\nvertex " q "\nvertex " r "\nendloop\nendfacet" }
    function at(i, z) { return x[i % n] " " y[i % n] " " z }
    END { for (i = 0; i < n; ++i) { print "solid", s[i]; f(at(i, 0), at(i+1, 0), at(i+1, 3)); f(at(i, 0), at(i+1, 3), at(i, 3)); print "endsolid", s[i] }
        print "solid ends"; for (i = 1; i + 1 < n; ++i) { f(at(0, 0), at(i+1, 0), at(i, 0)); f(at(0, 3), at(i, 3), at(i+1, 3)) } print "endsolid ends" }' > "constant/$1.stl"
}
printf '%s\n' '0 0 low' '30 0 out' '40 10 high' '0 10 in' | prism channel
case_ channel 1e-3 3e-3 "" "" "nDims 2; $ends"
accepted "a channel" "open at in \(0 0.005 0\) m" "^wall "
volumeIs wall 210e-6    # 3 (30 - 3/2 + 40 + 3/2): the outlet's plane leans by 45 degrees
volumeIs blood 350e-6
noneWhere "y > 0 && y < 10 || y < -3 || y > 13 || x < 0 || x > 30 + y" "a channel"
awk 'BEGIN { for (k = 0; k < 120; ++k) { a = 8*atan2(1, 1)*k/120; print 8*cos(a), 8*sin(a), "round" } }' | prism disc
: > constant/boundary
case_ disc 0.5e-3 2e-3 "" "" "nDims 2;"
accepted "a ring without an opening" "^wall .* 4\$"
volumeIs wall 113.0973e-6    # pi (10^2 - 8^2)
noneWhere "r < 7.98 || r > 10" "a ring"

# ---- refused ------------------------------------------------------------------------------------------------------------------
echo "in { type open; p 0; } out { type open; p 0; }" > constant/boundary
case_ straight 1e-3 -1e-3
refused "a negative thickness" "'thickness' is -0.001, but must lie between" "wall.thickness at line 4"
case_ straight 1e-3 0.5e-3
refused "thinner than a particle" "'thickness' is 0.0005, but must lie between 0.001"
case_ straight 1e-3 2e-3 "openings (inn out);"
refused "an opening that is not there" "group, a patch or a cap 'inn'" "Valid names are: in out wall" "wall.openings at line 4"
case_ straight 1e-3 2e-3
sed -i 's/phase solid/phase fluid/' system/particleDict
refused "a wall of fluid" "must have the phase solid or clamped, not fluid" "wall.thickness at line 4"
sed -i 's/wall  {.*/wall { phase solid; shape box; min (0 0 0); max (1 1 1); thickness 2e-3; }/' system/particleDict
refused "no lumen" "Zone wall has a shape and so no lumen" "shape annulus" "wall.thickness at line 4"
tube tight "$(bend 6 pi)"    # the inner side of the bend has a radius of 1 mm
case_ tight 1e-3 2e-3
refused "a bend tighter than the wall is thick" "A wall of 0.002 m is too thick" "the lumen turns back" "0.00" "wall.thickness at line 4"
tube conical 'x = 5*cos(a); y = 5*sin(a); z = 20*s; if (s == 1) { z = 20 + 0.3*cos(2*a) }'
case_ conical 1e-3 2e-3
refused "an opening that is not plane" "The opening out at (" "is not plane: it leaves its plane by up to 0.000" "wall.thickness"
printf '%s\n' '0 0 low' '10 0 hole' '20 0 low' '30 0 right' '30 10 high' '0 10 left' | prism basin
echo "walls { type wall; } hole { type open; p 0; }" > constant/boundary
case_ basin 1e-3 3e-3 "" "" "nDims 2; patches { hole { group hole; } }"
refused "an opening in a wall" "The opening hole at (0.015 0 0) m does not end the vessel" "Draw a piece of vessel"
[ $failures = 0 ]
