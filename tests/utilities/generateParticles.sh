#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# generateParticles on a small STL case, then with typical mistakes of users: each gives a clear error, status 1,
# and no particles
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
. "$(dirname "$0")/../cases/geometryFunctions"

# A cube of 10 mm; $1: triangles left out at the end
cube() {
    local n=$((12 - ${1:-0}))
    awk -v n="$n" 'BEGIN {
        print "solid water"
        split("0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5", c, " ")
        for (t = 0; t < n; ++t) {
            print "facet normal 0 0 0\nouter loop"
            for (k = 1; k <= 3; ++k) { i = c[3*t + k]; print "vertex", 10*(i%2), 10*(int(i/2)%2), 10*int(i/4) }
            print "endloop\nendfacet" }
        print "endsolid water" }' > constant/cube.stl
}
stl='file "constant/cube.stl"; unit mm;'
igs="file \"$geometry/hccB.igs\";"

cube
dict "$stl"
generateParticles > out 2>&1 && grep -q '^water .* 1000  *+0.00' out || fail "a cube: $(cat out)"
sed -i 's/^endsolid/facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 10 0\nendloop\nendfacet\n&/' constant/cube.stl
generateParticles > out 2>&1 && grep -q '^water .* 1000  *+0.00' out && grep -q 'cube.stl: triangles without area dropped: 1' out || fail "a flat triangle: $(cat out)"
dict "file \"constant/cube.stl\"; unit um;" 0.1
refused "a cube smaller than what is joined" "room for 0 particles" "Are dx and the unit of the file right"
dict "$stl"
# in two dimensions all particles stay at z = 0 when a solid is packed
cp system/particleDict keptDict
echo 'dx 0.01; nDims 2; zones { water { phase fluid; shape box; min (0 0 0); max (0.2 0.1 0); }
    plate { phase solid; shape box; min (0 0.1 0); max (0.2 0.13 0); } }' > system/particleDict
generateParticles > out 2>&1 && h5dump -m %.17g -y -w 1 -d /VTKHDF/Points 0/particles.hdf | tr -d ' ,' | grep -E '^[-0-9.e+]+$' |
    paste - - - | awk 'NF == 3 { ++n; bad = bad || $3 != 0 } END { exit bad || n < 250 }' || fail "z in two dimensions: $(tail -n 5 out)"
# a quarter of a tube between planes that face each other, in any order of the planes: 0.25 pi (0.01^2 - 0.005^2) 0.003/0.0006^3
cp constant/boundary boundary.kept
echo 'dx 6e-4; zones { tube { phase solid; shape annulus; point1 (0 0 0); point2 (0 0 3e-3); innerRadius 5e-3; outerRadius 10e-3; } }' > system/particleDict
left='left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }' below='below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }'
near='near { type symmetryPlane; point (0 0 0); normal (0 0 -1); }' far='far { type symmetryPlane; point (0 0 3e-3); normal (0 0 1); }'
for planes in "$left $below $near $far" "$far $left $near $below"; do
    echo "$planes" > constant/boundary
    generateParticles > out 2>&1 && awk '$1 == "tube" && ($3/818 - 1)^2 < 0.01^2 { ok = 1 } END { exit !ok }' out || fail "a tube between planes: $(grep -A1 ^zone out)"
done
mv boundary.kept constant/boundary
# thin plates, beside other zones and with fluid all around, get all their particles
for zones in 'ch { phase fluid; shape box; min (-0.2 0 0); max (0.2 0.1 0); } bath { phase fluid; shape box; min (-0.2 0.13 0);
        max (0.2 0.2 0); } plate { phase solid; shape box; min (-0.2 0.1 0); max (0.2 0.13 0); }' \
    'tank { phase fluid; shape box; min (-0.1 0 0); max (0.3 0.2 0); } plate { phase solid; shape box; min (0 0.1 0); max (0.2 0.12 0); }' \
    'tank { phase fluid; shape box; min (-0.1 0 0); max (0.5 0.2 0); } plate { phase solid; shape box; min (0 0.1 0); max (0.4 0.14 0); }'; do
    echo "dx 0.01; nDims 2; zones { $zones }" > system/particleDict
    generateParticles > out 2>&1 && grep -Eq '^plate +[^ ]+ +[0-9]+ +[-+]0.00' out && ! grep Warning out | grep -qv "has 2 layers" || fail "a thin plate: $(tail -n 8 out)"
    [ "$(grep -c "has 2 layers of particles where it is thinnest. So few cannot bend" out)" = "$(grep -c '(0.2 0.12 0)' system/particleDict)" ] ||
        fail "two layers, and they alone, are told: $(tail -n 8 out)"
done
# each layer along a wall's surfaces has the particles of its area: layersOf inner outer layers, radii in dx, for a quarter
cp constant/boundary keptBoundary
echo 'a { type symmetryPlane; point (0 0 0); normal (-1 0 0); } b { type symmetryPlane; point (0 0 0); normal (0 -1 0); } walls { type wall; }' > constant/boundary
layersOf() {
    echo "dx 0.01; nDims 2; zones { ring { phase solid; shape annulus; point1 (0 0 0); innerRadius $1e-2; outerRadius $2e-2; }
        lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-2; outerRadius $1e-2; } }" > system/particleDict
    generateParticles > out 2>&1 && h5dump -m %.17g -y -w 1 -d /VTKHDF/Points 0/particles.hdf | tr -d ' ,' | grep -E '^[-0-9.e+]+$' |
        paste - - - | awk -v inner="$1" -v outer="$2" -v layers="$3" '
            { r = 100*sqrt($1*$1 + $2*$2) } r > inner && r < outer { ++n[int((r - inner)*layers/(outer - inner))] }
            END { pi = atan2(0, -1); width = (outer - inner)/layers
                  for (k = 0; k < layers; ++k) if (k < 1 || k == layers - 1 || layers < 6) {
                      share = n[k]/(0.5*pi*(inner + (k + 0.5)*width)*width)
                      if (share < 0.95 || share > 1.05) { print "    layer", k + 1, "of", layers ":", share; bad = 1 } }
                  exit bad }' || fail "the layers of a ring: $(tail -n 5 out)"
}
layersOf 20 24 4
layersOf 20 25 5
layersOf 20 26 6
layersOf 20 32 12
mv keptBoundary constant/boundary
mv keptDict system/particleDict; generateParticles > out 2>&1
grep -q "earlier run" out && fail "a cube: told of an earlier run that there is not"
mkdir 0.5 1; touch 0.5/particles.hdf
generateParticles > out 2>&1; grep -q "times of an earlier run: 0.5\." out || fail "an earlier run: $(cat out)"
rm -r 0.5 1

# In 2D a zone is open where symmetry planes cut it; its area is known nevertheless
plane() { echo "$1 { type symmetryPlane; point ($2 0); normal ($3 0); }"; }
for planes in "$(plane a '0 0' '-1 0')" "$(plane a '0 0' '-1 0') $(plane b '0.01 0' '1 0')" \
    "$(plane a '0 0' '-1 0') $(plane b '0.02 0.02' '0 1')" \
    "$(plane a '0 0' '-1 0') $(plane b '0.01 0' '1 0') $(plane c '0 0.02' '0 1')" \
    "$(plane a '0 0' '-1 0') $(plane b '0.01 0' '1 0') $(plane c '0 0.02' '0 1') $(plane d '0 0' '0 -1')"; do
    case $planes in *d\ *) echo "$planes" ;; *) echo "walls { type wall; } $planes" ;; esac > constant/boundary
    dict 'shape box; min (0 0 0); max (0.01 0.02 0);' 1e-3 'nDims 2;'
    generateParticles > out 2>&1 && grep -q '^water  *0.0002  *200  *[+-]0.00' out || fail "2D, $planes: $(tail -n 8 out)"
    rm -rf 0
done
echo "walls { type wall; } $(plane a '0 0' '-1 0') $(plane b '0 0' '-1 0')" > constant/boundary
refused "a plane twice" "planes are the same" "(-1 0 0)"
echo "walls { type wall; } $(plane a '0.005 0' '-1 -1') $(plane b '0.005 0' '1 -1')" > constant/boundary
generateParticles > out 2>&1 && grep -Eq 'Warning.* [0-9]+ particles of zone water .*image.* nearer than 0.4 dx. The nearest pair is [-0-9.e]+ dx apart, at \([^)]+\) m\. A lattice' out || fail "a lattice on its image: $(tail -n 8 out)"
rm -rf 0
# in 3D
echo "$(for p in '0 0 0:-1 0 0' '0.01 0 0:1 0 0' '0 0 0:0 -1 0' '0 0.01 0:0 1 0' '0 0 0:0 0 -1' '0 0 0.01:0 0 1'; do
    echo "p${p//[: .-]/_} { type symmetryPlane; point (${p%:*}); normal (${p#*:}); }"; done)" > constant/boundary
dict 'shape box; min (0 0 0); max (0.01 0.01 0.01);'
generateParticles > out 2>&1 && grep -q '^water  *1e-06  *1000  *[+-]0.00' out || fail "planes on all sides: $(tail -n 8 out)"
rm -rf 0
echo "walls { type wall; }" > constant/boundary

# Velocity and pressure at the start, from formulas
dict "$stl U (\"10*x - y\" 2 \"sin(pi*z/0.02)\"); p \"dx*sqrt(x*x)\";"
generateParticles > out 2>&1 || fail "initial fields: $(tail -n 5 out)"
columns() { h5dump -m %.12g -y -w 1 -d "/VTKHDF/$1" 0/particles.hdf | sed '/ATTRIBUTE/,$d' | tr -d ' ,' | grep -E '^[-0-9.e+]+$'; }
columns Points > points; columns PointData/U > U; columns PointData/p > p
[ "$(wc -l < U)" = 3000 ] && [ "$(wc -l < p)" = 1000 ] || fail "initial fields: $(wc -l < U) $(wc -l < p)"
paste <(paste - - - < points) <(paste - - - < U) p | awk '
    function off(a, b) { return (a - b)^2 > 1e-18 }
    off($4, 10*$1 - $2) || off($5, 2) || off($6, sin(atan2(0, -1)*$3/0.02)) || off($7, 1e-3*$1) { bad = 1 }
    END { exit bad }' || fail "initial fields: not the formulas"
dict "$stl p \"rho*x\";"
refused "unknown name in a formula" "rho" "Valid names are:" "dx" "pi" "sqrt" "particleDict"
dict "$stl U (1 2);"
refused "two components" "three formulas"
dict "$stl p \"1 + \";"
refused "broken formula" "1 + "
dict "$stl p \"sqrt(x - 0.005)\";"
refused "formula without a finite value" "nan at (0.0005"
dict "$stl p \"x = 5\";"
refused "assignment" "must not assign"

dict 'file "constant/missing.stl"; unit mm;'
refused "missing file" "no geometry file" "constant/missing.stl"
echo nonsense > constant/cube.xyz
dict 'file "constant/cube.xyz";'
refused "unknown type" "cube.xyz" ".igs" ".stl"
dict 'file "constant/cube.stl";'
refused "no unit" "unit" "cube.stl"
dict 'file "constant/cube.stl"; unit furlong;'
refused "unknown unit" "furlong" "mm" "inch"
dict "$igs unit inch;"
refused "unit of a file that has its own" "declares that it is in mm, but 'unit inch;' says inch"
dict 'file "constant/cube.stl"; unit um;'
refused "wrong unit" "could not hold a particle" "unit"
dict "$igs colour (1 2 3);" 5e-3
refused "colour that no face has" "colour (1 2 3)" "with the colours" "(255 153 0)"
[ "$(grep -o "with the colours.*" out | grep -o "(" | wc -l)" = 6 ] || fail "colours: not all are listed"
dict "$stl group wine;"
refused "group that no face has" "group wine"
dict "$stl" 1e-3 "patches { lid { faces (1); } }"
refused "patch that constant/boundary has not" "lid" "walls"
dict "$stl colur (1 2 3);"
refused "misspelt entry" "colur"
dict "phase2 x;"
refused "zone without shape" "file or a shape"

# Impossible shapes and useless numbers
shape() { echo "dx 1e-3; placement lattice; ${2:-} zones { water { phase fluid; shape $1 } ${3:-} }" > system/particleDict; }
box="box; min (0 0 0); max (0.01 0.01 0.01);"
tube="point1 (0 0 0); point2 (0 0 0.01);"
shape "sphere; centre (0 0 0); radius -0.01;"
refused "negative radius" "'radius' is -0.01, but must lie between" "water.radius at line 1"
shape "sphere; centre (0 0 0); radius 10;"
refused "a radius in millimetres" "'radius' is 10, but must lie between"
shape "annulus; $tube innerRadius 0.02; outerRadius 0.01;"
refused "inner beyond outer" "innerRadius 0.02 must be smaller than the outerRadius 0.01"
shape "cylinder; point1 (0 0 0); point2 (0 0 0); radius 0.01;"
refused "no length" "the same point"
shape "box; min (0 0 0); max (0.01 -0.01 0.01);"
refused "box inside out" "Every coordinate of max"
shape "ellipsoid; centre (0 0 0); semiAxes (0.01 0.01 0);"
refused "flat ellipsoid" "Each of the semiAxes must lie between"
shape "box; min (0 0 0); max (10 10 10);"
refused "too many particles" "room for 1e+12 particles"
shape "$box" "stripLayers -2;"
refused "strip" "'stripLayers' is -2, but must lie between 2 and 100"
shape "$box" "weldTolerance 1;"
refused "weld" "'weldTolerance' is 1, but must lie between 0 and 0.0005"
shape "$box" "surfaceSize -1;"
refused "mesh size" "'surfaceSize' is -1, but must lie between 1e-05 and 1"
shape "$box" "defaultPatch wals;"
refused "patch that is nowhere" "belongs to patch wals" "Did you mean 'walls'?"
shape "$box U (0 0 1);" "nDims 2;"
refused "velocity out of the plane" "U must not point along z"
shape "$box" "" '"my zone" { phase fluid; shape sphere; centre (0 0 0); radius 1; }'
refused "name with a blank" "cannot be a name"
dict 'file "";'
refused "no file name" "is not a file" "water.file at line 1"

# gmsh continues a script after a line that it cannot read; a part of the geometry would be missing
for line in "Box(2) = {20, 0, 0, 10" "Merge \"nothere.step\";" "garbage words;"; do
    printf 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 10, 10, 10};\n%s\n' "$line" > constant/bad.geo
    dict 'file "constant/bad.geo"; unit mm;'
    refused "a script with '$line'" "gmsh stumbles" "bad.geo"
done

# Zones that only touch do not overlap; a spacing that does not divide a box is reported
ring='shape annulus; point1 (0 0 0); point2 (0 0 0.02); innerRadius 4e-3; outerRadius 6e-3;'
echo "dx 1e-3; placement lattice; zones { ring { phase solid; $ring } lumen { phase fluid; shape cylinder;
    point1 (0 0 0); point2 (0 0 0.02); radius 4e-3; } }" > system/particleDict
generateParticles > out 2>&1 || fail "ring and lumen: $(tail -n 5 out)"
! grep -q overlap out || fail "ring and lumen: $(grep overlap out)"
dict "shape box; min (0 0 0); max (1.04e-2 1.04e-2 1.04e-2);"
generateParticles > out 2>&1 && grep -q "water miss its volume by -.* bodyFitted" out || fail "spacing and box: $(cat out)"

# Zones that overlap: which zone takes how much of which, and where
ice='ice { phase fluid; shape box; min (0.008 0 0); max (0.012 0.01 0.01);'
shape "$box" "" "$ice }"
refused "ice half in the water" "Zone ice lies partly in zone water, which comes before it, and takes 2e-07 m3 of it around (0.009 0.005 0.005)" "mayOverlap yes" "particleDict.zones.ice at line"
shape "$box" "" "$ice mayOverlap yes; }"
generateParticles > out 2>&1 || fail "overlap: $(tail -n 5 out)"
grep -q "overlap: ice takes 2e-07 m3 of water, which comes before it, around (0.009 0.005 0.005)" out || fail "overlap: $(cat out)"
block="walls { phase rigid; ${ice#*fluid;}"
shape "$box" "" "$block }"
generateParticles > out 2>&1 || fail "a rigid zone half in the water: $(tail -n 5 out)"
shape "$box" "" "$block mayOverlap yes; }"
refused "mayOverlap of a rigid zone" "Zone walls is rigid" "may lie partly in them" "zones.walls.mayOverlap at line"
# in either order, and however small the losing zone is
echo "dx 1e-3; placement lattice; zones { ice { phase fluid; shape box; min (-0.002 0 0); max (0.002 0.01 0.01); }
    ocean { phase fluid; shape box; min (0 0 0); max (0.05 0.05 0.05); } }" > system/particleDict
refused "ice half in the ocean" "Zone ocean lies partly in zone ice, which comes before it, and takes 2e-07 m3 of it" "mayOverlap yes"
shape "$box" "" "pea { phase fluid; shape sphere; centre (0.005 0.005 0.005); radius 0.003; }"
generateParticles > out 2>&1 && grep -q "overlap: pea takes" out || fail "pea: $(tail -n 5 out)"
# Layers that meet at cyclic planes: two particles, pressed into a corner, stayed in one place
for size in "0.1 0.03" "0.15 0.02"; do
    read -r length thick <<< "$size"
    mkdir -p "$scratch/layers"/{constant,system}
    echo "dx 0.01; nDims 2; zones { w { phase fluid; shape box; min (0 0.05 0); max ($length 0.2 0); }
        s { phase solid; shape box; min (0 $(awk "BEGIN { print 0.05 - $thick }") 0); max ($length 0.05 0); }
        k { phase clamped; shape box; min (0 $(awk "BEGIN { print 0.03 - $thick }") 0); max ($length $(awk "BEGIN { print 0.05 - $thick }") 0); } }" > "$scratch/layers/system/particleDict"
    echo "walls { type wall; } c { type cyclic; point (0 0 0); separation ($length 0 0); }" > "$scratch/layers/constant/boundary"
    generateParticles -case "$scratch/layers" > out 2>&1 || fail "layers $size: $(tail -n 5 out)"
    awk '$1 == "s" { exit !($2*1e4 == $3 && $(NF - 1) > 0.6) }' out || fail "layers $size: $(grep '^s ' out)"
done
# A rigid body is a hole with a patch of its own name
shape "$box" "" "pillar { phase rigid; shape box; min (0.004 0 0); max (0.006 0.01 0.01); }"
refused "rigid zone without a patch" "belongs to patch pillar" "Valid patches are: walls"
echo "pillar { type wall; }" >> constant/boundary
generateParticles > out 2>&1 && grep -q '^water .* 800  *+0.00' out && ! grep -q overlap out || fail "pillar: $(cat out)"
grep -q "facet" constant/triSurface/pillar.stl || fail "no surface of the pillar"
shape "$box" "" "pillar { phase rigid; file \"constant/cube.stl\"; unit mm; }"
cube 1
refused "leaky rigid body" "zone pillar" "not closed" "hole at (0.01 "
echo "walls { type wall; }" > constant/boundary

# Two zones from one file, with its unit given twice; volumes that touch, with a face each or a common face
cat > constant/two.geo <<'END'
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 10, 10, 10};
Box(2) = {10, 0, 0, 5, 10, 10};
END
geo='phase fluid; file "constant/two.geo"; unit mm;'
dict 'file "constant/two.geo"; unit mm;'
generateParticles > out 2>&1 && grep -q '^water .* 1500  *+0.00' out || fail "two touching volumes: $(cat out)"
# a box selects the bodies inside it, not those that only have a face there
echo "dx 1e-3; placement lattice; zones { water { $geo box ((-1 -1 -1) (0.0101 1 1)); } ice { $geo box ((0.0099 -1 -1) (1 1 1)); } }" > system/particleDict
generateParticles > out 2>&1 && grep -q '^water .* 1000  *+0.00' out && grep -q '^ice .* 500  *+0.00' out || fail "boxes: $(tail -n 9 out)"
dict 'file "constant/two.geo"; unit mm;'
printf '%s\n' 'BooleanFragments { Volume{1}; Delete; }{ Volume{2}; Delete; }' 'Physical Volume("ice") = {2};' >> constant/two.geo
generateParticles > out 2>&1 && grep -q '^water .* 1500  *+0.00' out || fail "two volumes with a common face: $(cat out)"
for ice in "group ice;" "faces (11);" "box ((0.014 -1 -1) (1 1 1));"; do
    echo "dx 1e-3; placement lattice; zones { water { $geo box ((-1 -1 -1) (0.001 1 1)); } ice { $geo $ice } }" > system/particleDict
    generateParticles > out 2>&1 && grep -q '^water .* 1000  *+0.00' out && grep -q '^ice .* 500  *+0.00' out ||
        fail "two zones of one file, $ice: $(cat out)"
done
sed -i 's/\(ice.*\)unit mm/\1unit cm/' system/particleDict
refused "two units of one file" "An earlier zone reads the same file in mm" "ice.unit at line 1"
dict 'file "constant/two.geo"; unit mm; faces (1 99);'
refused "no such face" "has no face 99" "1 to 11"
# In 2D the bodies of a file are prisms, wherever they lie along z
for z in "0 1" "1 3" "-0.5 0.5"; do
    set -- $z
    cat > constant/hole.geo <<END
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, $1, 20, 10};
Disk(2) = {10, 5, $1, 2};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Extrude {0, 0, $2 - ($1)} { Surface{3}; }
END
    echo 'dx 1e-3; nDims 2; zones { water { phase fluid; file "constant/hole.geo"; unit mm; } }' > system/particleDict
    generateParticles > out 2>&1 && grep -q '^water  *0.0001874[0-9]*  *187 ' out || fail "2D from a file, z $z: $(tail -n 8 out)"
done
# A zone from a file takes its room from a shape and from another file, whatever their heights: 4e-4 m2 less the polygon of 1.25203e-5 m2
printf 'SetFactory("OpenCASCADE"); Disk(1) = {12, 5, 0, 2}; Extrude {0, 0, 1} { Surface{1}; }\n' > constant/disk.geo
printf 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 7, 40, 10, 3};\n' > constant/box.geo
echo "walls { type wall; } post { type wall; }" > constant/boundary
for around in 'shape box; min (0 0 0); max (0.04 0.01 0);' 'file "constant/box.geo"; unit mm;'; do
    for phase in rigid solid fluid; do
        [ $phase = rigid ] || echo "walls { type wall; }" > constant/boundary
        echo "dx 0.4e-3; nDims 2; placement lattice; zones { water { phase fluid; $around }
            post { phase $phase; file \"constant/disk.geo\"; unit mm; } }" > system/particleDict
        accepted "a $phase disk from a file" '^water  *0.00038748  *242[12] '
        ! grep -q Warning out || fail "a $phase disk from a file: $(grep -A 2 Warning out)"
    done
    echo "walls { type wall; } post { type wall; }" > constant/boundary
done
echo "walls { type wall; }" > constant/boundary
printf 'SetFactory("OpenCASCADE"); Sphere(1) = {12, 5, 0, 2};\n' > constant/disk.geo
refused "a sphere in 2D" "disk.geo has another outline half-way up than at (" "must be prisms along z"
# A needle, 0.01 dx wide and 10,000 dx long, along an axis and oblique, is refused in bounded memory
needle() {
    awk 'BEGIN { split("0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5", c, " ")
        print "solid needle"
        for (t = 0; t < 12; ++t) {
            print "facet normal 0 0 0\nouter loop"
            for (k = 1; k <= 3; ++k) { i = c[3*t + k]; a = 0.01*(i%2); b = 10000*(int(i/2)%2)
                print "vertex", 0.8*a + 0.6*b, 0.8*b - 0.6*a, int(i/4) }
            print "endloop\nendfacet" }
        print "endsolid needle" }' > constant/needle.stl
}
needle
for body in 'shape box; min (0 0 0); max (1e-5 10 0);' 'file "constant/needle.stl"; unit mm;'; do
    echo "dx 1e-3; nDims 2; placement bodyFitted; zones { water { phase fluid; $body } }" > system/particleDict
    (ulimit -v 4000000; refused "a needle in 2D" "m thick and the particle spacing dx is 0.001 m" "could not hold a particle"; [ $failures = 0 ]) ||
        failures=$((failures+1))
done
echo 'dx 1e-3; nDims 2; zones { water { phase fluid; file "constant/hole.geo"; unit mm; } }' > system/particleDict
sed -i '/Extrude/d' constant/hole.geo
refused "flat file in 2D" "hole.geo is flat" "along z"
# Faces of shapes are selected by boxes
echo "walls { type wall; } lid { type wall; }" > constant/boundary
dict 'shape box; min (0 0 0); max (0.01 0.01 0.01);' 1e-3 'patches { lid { box ((-1 -1 0.0099) (1 1 1)); } }'
generateParticles > out 2>&1 && [ "$(grep -c "facet normal 0 0 1" constant/triSurface/lid.stl)" = "$(grep -c "facet normal" constant/triSurface/lid.stl)" ] &&
    [ "$(grep -c "facet normal" constant/triSurface/walls.stl)" -ge 10 ] || fail "a box's lid: $(tail -n 8 out)"
sed -i 's/0.0099/0.1/' system/particleDict
refused "no face of a shape" "No face has the box" "chosen by a box"
echo "walls { type wall; }" > constant/boundary

# Behind a wall that ends at open faces there are as many particles as fit: with 3 % fewer the fluid beside it would be too
# dense by the same amount
echo "walls { type wall; } low { type open; p 0; surface plane; point (0 0 0); normal (0 0 -1); }
    high { type open; p 0; surface plane; point (0 0 0.018); normal (0 0 1); }" > constant/boundary
echo "dx 1e-3; placement bodyFitted; zones { water { phase fluid; shape cylinder; point1 (0 0 0);
    point2 (0 0 0.018); radius 6e-3; } }" > system/particleDict
generateParticles > out 2>&1 || fail "a pipe: $(tail -n 8 out)"
h5dump -m %.12g -y -w 1 -d /VTKHDF/Points constant/wallParticles.hdf | tr -d ' ,' | grep -E '^[-0-9.e+]+$' |
    paste - - - | awk '{ r = 1e3*sqrt($1*$1 + $2*$2); z = 1e3*$3; if (z > 1 && z < 17) ++n[int(r)] }
    END { for (k = 6; k < 8; ++k) { part = n[k] / (3.14159265 * 16 * (2*k + 1)); print k, part; bad += part < 0.98 || part > 1.02 }
          exit bad > 0 }' > counts || fail "a pipe's wall lacks particles: $(cat counts)"
rm -rf 0
echo "walls { type wall; }" > constant/boundary

# One file per part, and a patch from one of them
echo "end { type wall; }" >> constant/boundary
cube
cat > system/particleDict <<'END'
dx 1e-3; placement lattice;
zones { water { phase fluid; file "constant/two.geo"; unit mm; group ice; } cube { phase fluid; file "constant/cube.stl"; unit mm; } }
patches { end { box ((0.0149 -1 -1) (1 1 1)); } }
END
generateParticles > out 2>&1 || fail "a patch of one file of two: $(tail -n 8 out)"
[ "$(grep -c facet constant/triSurface/end.stl)" -gt 1 ] || fail "no patch end"
sed -i 's/0.0149/0.1/' system/particleDict
refused "patch in no file" "No face has the box" "cube.stl has 1 faces" "two.geo has 11 faces"
echo "walls { type wall; }" > constant/boundary
# A blue face; gmsh reports blue also for faces without a colour
sed 's/^314,80.000001088,0.,0.,4HRED3; /314,0.,0.,100.,4HBLUE;         /' "$geometry/hccB.igs" > constant/blue.igs
dict 'file "constant/blue.igs"; colour (1 2 3);' 5e-3
refused "colour beside blue" "with the colours (0 0 255) "
head -c 71000 "$geometry/hccB.igs" > constant/cut.igs
dict 'file "constant/cut.igs";' 5e-3
refused "IGES without its end" "cut.igs is cut off"
gmsh -2 -save_all -format msh41 -clmax 3 -o constant/whole.msh constant/two.geo > /dev/null
dict 'file "constant/whole.msh"; unit mm; group ice;'
generateParticles > out 2>&1 && grep -q '^water .* 500  *+0.00' out || fail "a mesh file: $(tail -n 8 out)"
# BREP has no unit: without an entry mm are assumed, with a message
gmsh -0 -format brep -o constant/whole.brep constant/two.geo > /dev/null
for unit in "" "unit mm;" "unit cm;"; do
    dict "file \"constant/whole.brep\"; $unit box ((0.0099 -1 -1) (1 1 1));" 1e-3
    [ "$unit" = "unit cm;" ] && dict "file \"constant/whole.brep\"; $unit box ((0.099 -1 -1) (1 1 1));" 1e-2
    generateParticles > out 2>&1 && grep -q '^water .* 500  *+0.00' out || fail "a .brep file, '$unit': $(tail -n 8 out)"
    [ -z "$unit" ] && { grep -q 'whole.brep is read in mm' out || fail "a .brep file: nothing said of its unit"; }
done
# two bodies in one file that touch over part of a face, with any facets there: the wall is around them, not between them
echo 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 10, 10, 10}; Box(2) = {10, 3, 3, 5, 4, 4};' > constant/touching.geo
{ cat constant/touching.geo; echo 'BooleanUnion { Volume{1}; Delete; } { Volume{2}; Delete; }'; } > constant/union.geo
gmsh -0 -format step -o constant/touching.step constant/touching.geo > /dev/null
gmsh -2 -clmin 20 -clmax 20 -format stl -o constant/touching.stl constant/touching.geo > /dev/null
gmsh -2 -clmin 1.6 -clmax 1.6 -format stl -o constant/fine.stl constant/touching.geo > /dev/null
for kind in lattice bodyFitted; do
    expected=""
    for file in union.geo touching.step touching.stl fine.stl; do
        dict "file \"constant/$file\"; unit mm;" 1e-3
        sed -i "s/placement lattice/placement $kind/" system/particleDict
        generateParticles > out 2>&1 || fail "$file, $kind: $(tail -n 8 out)"
        found=$(awk '/^water .*%?/ && $3 > 0 { print $3, $9 < 0.7 ? "too close: " $9 : "" } /rigid wall/' out | tr '\n' ' ')
        [ -n "$expected" ] || expected=$found
        [[ $found = "$expected" && $found = 1080\ * && $found != *close* ]] ||
            fail "bodies that touch, $file, $kind: $found, not $expected"
    done
done
head -c $(($(stat -c %s constant/whole.msh) * 8 / 10)) constant/whole.msh > constant/cut.msh
dict 'file "constant/cut.msh"; unit mm; group ice;'
refused "mesh file without its end" "cut.msh is cut off"
# A ball touches all six faces of its box, a disc all four: what faces that touch without meeting enclose is not the zone's volume
cp constant/boundary boundary.kept
echo "walls { type wall; }" > constant/boundary
touching() {
    rm -rf 0; echo "dx 1e-3; $2 zones { water { phase fluid; shape box; $3 } ball { phase solid; $4 } }" > system/particleDict
    generateParticles > out 2>&1 || fail "touching $1: $(tail -n 8 out)"
    awk -v n="$5" '/^water / && $3 > 0.99*n && $3 < 1.01*n { found = 1 } END { exit !found }' out ||
        fail "touching $1: $(grep '^water ' out), not $5"
}
touching balls "" "min (-6e-3 -6e-3 -6e-3); max (6e-3 6e-3 6e-3);" "shape sphere; centre (0 0 0); radius 6e-3;" 823.2
grep -q "Zone water: its faces enclose .* touch there without meeting" out || fail "touching balls: no warning"
touching discs "nDims 2;" "min (-15e-3 -15e-3 0); max (15e-3 15e-3 0);" "shape cylinder; point1 (0 0 0); point2 (0 0 1); radius 15e-3;" 193.1
mv boundary.kept constant/boundary
# A pipe into a pot with an open bottom: a strip beside the pipe would lie behind the pipe's wall
cp constant/boundary boundary.kept
echo 'SetFactory("OpenCASCADE"); Cylinder(1) = {0, 0, 0, 0, 0, 8, 4}; Cylinder(2) = {0, 0, 8, 0, 0, 6, 10};
BooleanUnion { Volume{1}; Delete; }{ Volume{2}; Delete; }' > constant/pot.geo
echo "walls { type wall; } out { type open; p 0; }" > constant/boundary
echo 'dx 1e-3; zones { water { phase fluid; file "constant/pot.geo"; unit mm; } }
    patches { out { box ((-11e-3 -11e-3 7.9e-3) (11e-3 11e-3 15e-3)); } }' > system/particleDict
refused "strip behind a wall" "Open patch out meets the back of wall walls near"
mv boundary.kept constant/boundary
cube 1
dict "$stl"
refused "leaky surface" "not closed" "water"
: > constant/cube.stl
refused "empty file" "cube.stl"
printf 'IGES\n' > constant/cube.igs
dict 'file "constant/cube.igs";'
refused "broken IGES" "cube.igs"
[ $failures = 0 ]
