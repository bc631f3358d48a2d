#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The annotated dictionaries form one case.  It runs; a program refuses entries that it does not read, so each
# entry stands where it is read.  Entries in comments replace others: each of these cases runs too
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
annotated=$cases/../../etc/caseDicts/annotated
annotatedCase() {
    rm -rf "$scratch/case"; mkdir -p "$scratch/case/system" "$scratch/case/constant"; cd "$scratch/case" || exit 1
    cp "$annotated"/{controlDict,functions,particleDict,sphSchemes,sphSolution} system/
    cp "$annotated"/{boundary,g,physicalProperties,porosityProperties,structureProperties} constant/
}
annotatedCase; place
solved
[ -e 0.02/particles.hdf ] && [ -e 0.015/particles.hdf ] || fail "no result: $(ls)"
[ "$(ls postProcessing | paste -sd ' ')" = "$(awk '/^    my/ { print $1 }' system/functions | sort | sed "1i energyLedger" | paste -sd ' ') volumeLedger" ] ||
    fail "function objects: $(ls postProcessing)"
[ -s postProcessing/myMap/0.02/myMap.slice.dat ] || fail "no slice"
ispfPostProcess > log 2>&1 || fail "ispfPostProcess: $(tail -n 5 log)"
checkParticles > log 2>&1 || grep -q "^Particles" log || fail "checkParticles: $(tail -n 5 log)"
setEntry system/sphSolution coupling projection
setEntry constant/structureProperties E 30; sed -i 's/^mu .*/mu 1e-3;/' constant/physicalProperties
solve || grep -q "beyond the" log || fail "projection: $(tail -n 5 log)"

# inPlaceOf file, entry in a comment, entry that it replaces
inPlaceOf() {
    annotatedCase
    sed -i -E "s|^( *)//($2 )|\1\2|; s|^( *)($3 )|\1//\2|" "$1"
    grep -qE "^ *$2 " "$1" || fail "$1: there is no $2"
    place; solved
}
inPlaceOf constant/physicalProperties nu mu
inPlaceOf constant/porosityProperties permeability d
inPlaceOf constant/structureProperties G E
inPlaceOf constant/structureProperties k_e E
for shape in 'sphere; centre (0.1 0.1 0); radius 0.1' 'cylinder; point1 (0.1 0.1 0); radius 0.1' 'formula; formula "min(1, max(0, x/0.04))"'; do
    annotatedCase; sed -i -E "s|^( *)shape .*|shape $shape;|; s|^ *m(in\|ax) .*||" constant/porosityProperties
    place; solved
done
annotatedCase
# entries in comments below this line replace those above it
sed -i -E '1,/^\/\/ with structureModel totalLagrangian/d; /^\/\/ other materials/,$d; s|^( *)//((zeroEnergy\|radius\|material\|type\|E) .*\|[{}])|\1\2|' constant/structureProperties
echo "structureModel totalLagrangian;" >> constant/structureProperties
place; solved; grep -q "structure: totalLagrangian, neoHookean" log || fail "totalLagrangian: $(tail -n 5 log)"
annotatedCase
sed -i -E '/^\/\/contact/,/^\/\/\}/ s|^( *)//|\1|' constant/structureProperties
place; solved
annotatedCase
{ echo "structureModel totalLagrangian; material { type neoHookean; E 1e4; }"
  sed -nE '/^\/\/prestress/,/^\/\/\}/ s|^( *)//|\1|p' "$annotated/structureProperties"; } > constant/structureProperties
place; solved; grep -q "^Prestress: pass" log || fail "prestress: $(tail -n 5 log)"
while read -r line; do
    annotatedCase
    echo "structureModel totalLagrangian; ${line#//}" > constant/structureProperties
    place; solved
done < <(grep -E '^//materials? +\{ ' "$annotated/structureProperties")
inPlaceOf system/functions zones phase
annotatedCase
sed -i -E "s|^( *)surface( *)myWall_to_myFluid;( *)// needed, or patches|\1patches\2(myWalls);|; s|^( *)patch .*||; s|//surface |surface |" system/functions
place; solved
ls postProcessing/myFlux/0/*.dat > /dev/null && grep -q myWalls postProcessing/myLeaks/0/*.dat || fail "a surface in place of a patch"
annotatedCase
sed -i -E "s|^ *direction .*||; s|^ *displacement .*||; s|//(velocity .*1e-3 .*)|\1|" constant/boundary
place; solved

# boundaryWith: entries in comments of constant/boundary replace other entries
boundaryWith() {
    annotatedCase
    sed -i -E "$1" constant/boundary
    place
}
shown() { printf 's|^( *)//(%s)|\\1\\2|; ' "$@"; }
# nothing can leave in this case, so the piston has to be at rest
boundaryWith "$(shown 'velocity .*into the fluid' 'profile ' 'direction .*of flowRate')s/^( *)(p|outlet|backflow) .*//; s|amplitude 0.005|amplitude 0|"; solved
boundaryWith "$(shown 'flowRate ')s/^( *)(p|outlet|backflow) .*//"
solved
mv constant/triSurface/myOpenFace.stl extent
solve && fail "a flow rate through a plane without an end is accepted"
grep -q "The area of a plane" log || fail "flowRate: $(tail -n 5 log)"
mv extent constant/triSurface/myOpenFace.stl
boundaryWith "$(shown 'slip ')s|^( *)representation .*||; s|^    velocity .*||"; solved
boundaryWith "$(shown 'velocity .*speed')s|^    velocity  *\\(.*||"; solved
boundaryWith "$(shown 'rotation .*itself')s|^    velocity  *\\(.*||"
solve && fail "plane walls that turn in themselves are accepted"
grep -q "of this velocity points out of it" log || fail "rotation: $(tail -n 5 log)"

# an entry in a wrong place is reported
annotatedCase; place
echo "theta 0.5;" >> system/sphSolution
solve && fail "theta beside monolithic is accepted"
grep -q "Nothing reads the entry 'theta'" log || fail "theta: $(tail -n 5 log)"

# functions of time: each of the file in turn, as the pressure of the open face
printf 'time,value\n0,0\n1,2\n' > values.csv
annotatedCase; place
printf 'time,value\n0,0\n1,2\n' > values.csv
for name in p myTable myCsv mySine myPolynomial myRamp myProduct; do
    { sed -n '/^type\|^$/d; p' "$annotated/boundary"; echo "#include \"Function1\""; echo "myOpenFace { p \$$name; }"
      for other in p myTable myCsv mySine myPolynomial myRamp myProduct; do echo "#remove $other"; done; } > constant/boundary
    cp "$annotated/Function1" constant/
    solved
done
[ $failures = 0 ]
