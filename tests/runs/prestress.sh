#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A quarter of a thick neo-Hookean tube that starts under the pressure to which it would be inflated from a lumen smaller by a
# fifth.  The rest is found within 3 % of its distance from the image, a cycle of filling and emptying ends with the pressure of
# the start within 0.1 %, its stress is the exact one, and a continued run goes on with the rest that was found.  The same with a wall that has been stretched
# by a half within, in a few passes
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
cp -r "$cases/../../tutorials/ispfFsiFoam/inflatedVessel" tube; cd tube || exit 1
# exact: a^2 - A^2 = k on both sides of the wall [mm2], G 50 kPa
exactPressure() { awk -v k="$1" 'BEGIN { a = sqrt(100/(100 - k)); b = sqrt(169/(169 - k)); print 5e4*(log(a/b) + 0.5*(1/b^2 - 1/a^2)) }'; }
# restIsExact time k
restIsExact() {
    sed "/^(/!d; s/[()]//g" "$1/x0" > x0; sed "/^(/!d; s/[()]//g" "$1/restPlaces" > rest; sed -n "/^(/,\$p" "$1/zone" | sed "/^[0-9]/!d" > zone
    paste x0 rest zone | awk -v k="$2e-6" 'NF == 7 && $7 == 0 { n++; sum += (sqrt($4^2 + $5^2) - sqrt($1^2 + $2^2 - k))/(10e-3 - sqrt(1e-4 - k)) }
        END { printf "    rest of %d particles off by %.4f of the distance\n", n, sum/n; exit !(n > 100 && sum/n < 0.03 && sum/n > -0.03) }' ||
        fail "the rest that is found at $2 mm2"
}
# stressIsExact time k most: von Mises' stress of each particle of the image, in the mean within 2 %, none further off than `most`
stressIsExact() {
    for d in Points PointData/vonMises; do
        h5dump -d "/VTKHDF/$d" -y -w 1 -m %.9g "postProcessing/stress/$1/solid.hdf" |
            awk '/DATA \{/ { on = 1; next } /\}/ { on = 0 } on { gsub(/[(),]/, " "); for (i = 1; i <= NF; i++) print $i }' > "$(basename "$d").txt"
    done
    paste - - - < Points.txt | paste - vonMises.txt | awk -v k="$2" -v most="$3" '
        NF == 4 { r2 = 1e6*($1*$1 + $2*$2); l = r2/(r2 - k); exact = 5e4*sqrt(((l - 1/l)^2 + (l - 1)^2 + (1 - 1/l)^2)/2)
          e = $4/exact - 1; sum += e; n++; if (e*e > worst*worst) worst = e }
        END { printf "    von Mises stress of %d particles: %.4f off in the mean, %.3f at most\n", n, sum/n, worst
              exit !(n > 100 && (sum/n)^2 < 4e-4 && worst^2 < most^2) }' || fail "the stress of the rest that is found at $2 mm2"
}
pressure=$(exactPressure 20)
cat > constant/structureProperties <<END
structureModel  totalLagrangian;
material        { type neoHookean; G 5e4; }
prestress       { pressures { lumen $pressure; } }
END
setEntry system/particleDict zones.wall.outerRadius 13e-3
setEntry constant/boundary inlet.flowRate "{ type sine; amplitude 78e-6; frequency 1; }"
setEntry system/controlDict endTime 0.5
echo "functions { stress { type solidStress; writeControl writeTime; } }" >> system/controlDict
place; solved
setEntry system/controlDict endTime 1
ispfFsiFoam > log.again 2>&1 || fail "continued: $(tail -n 5 log.again)"
grep -q "prestress: the places at rest were found at the start" log.again || fail "it is not told that nothing is searched"
grep -q Prestress log.again && fail "the rest is searched again"
[ "$(grep -c Prestress log)" -gt 2 ] || fail "no pass is told"
restIsExact 0.5 20
first=$(awk '!/^#/ { print $2; exit }' postProcessing/chamber/0/p) last=$(awk 'END { print $2 }' postProcessing/chamber/0.5/p)
echo "    pressure $first Pa at the start, $last Pa after a cycle; asked $pressure"
awk -v a="$first" -v b="$last" -v p="$pressure" 'BEGIN { exit !((b/a - 1)^2 < 1e-6 && (a/p - 1)^2 < 1e-6) }' || fail "the pressure drifts"
stressIsExact 1 20 0.15

# the times that are written, the start among them, have the stress that the run has measured
cp -r postProcessing run; rm -rf postProcessing; ispfPostProcess -func stress > log.post 2>&1 || fail "ispfPostProcess: $(tail -n 3 log.post)"
for t in 0.25 0.5; do
    grep -h "^ *$t[[:space:]]" run/stress/0/solidStress.dat > one; grep -h "^ *$t[[:space:]]" postProcessing/stress/0/solidStress.dat > other
    [ -s one ] && cmp -s one other || fail "the stress at $t s: $(cat one other)"
done

# 1/(1 - k/100) = 1.5^2
cp -r . ../wide
(cd ../wide && rm -rf 0.* 1 postProcessing && sed -i "s/^prestress.*/prestress { pressures { lumen $(exactPressure 55.5556); } maxIter 15; }/" constant/structureProperties &&
    setEntry system/controlDict endTime 0.01 && setEntry system/controlDict writeInterval 0.01 && solved && restIsExact 0.01 55.5556 && stressIsExact 0.01 55.5556 0.15 && [ $failures = 0 ]) || fail "a wall that has been stretched by a half"

# stays pressure outside most: the wall moves by less than `most` [m] within 0.02 s
stays() {
    sed -i "s/^prestress.*/prestress { pressures { \"lum.*\" $1; } maxIter 15; } outside { $2 }/" constant/structureProperties
    rm -rf 0.* 1 postProcessing; setEntry system/controlDict endTime 0.02; setEntry system/controlDict writeInterval 0.02; solved
    awk -v most="$3" 'END { printf "    the wall moves by %s m\n", $NF; exit !($NF >= 0 && $NF < most) }' postProcessing/stress/0/solidStress.dat || fail "$1 Pa within, $2: the start is not at rest"
}
# pressure outside alone, and the same beside a level of 5 kPa, of which nothing may be left; a support far stiffer than the wall
cp -r . ../level
(cd ../level && setEntry constant/boundary inlet.flowRate 0 && stays 0 "pressure 200;" 1e-8 && stays 5000 "pressure 5200;" 1e-8 && stays $pressure "stiffness 1e8; damping 1e6;" 1e-8 && [ $failures = 0 ]) || fail "a pressure or tissue outside"
(cd ../level && ispfDictionary constant/boundary -entry inlet -set "{ type open; p 0; }" > /dev/null && rm -rf 0.* && solved && grep -q "has 0 Pa at the start, and prestress.pressures has" log && [ $failures = 0 ]) || fail "an open face with another pressure"
# a whole ring, which turns freely but for a support
cp -r . ../whole
(cd ../whole && sed -i "/symmetryPlane/d" constant/boundary && rm -rf 0 && place && setEntry constant/boundary inlet.flowRate 0 && stays $pressure "stiffness 1e8;" 1e-6 && [ $failures = 0 ]) || fail "a whole ring"

sed -i "s/^prestress/without/" constant/structureProperties; cp -r . ../late; sed -i "s/^without/prestress/" constant/structureProperties
(cd ../late && rm -rf 0.* 1 && sed -i "/^without/d" constant/structureProperties && setEntry system/controlDict endTime 0.02 && setEntry system/controlDict writeInterval 0.02 && ispfFsiFoam > log 2>&1 &&
    echo "prestress { pressures { lumen $pressure; } }" >> constant/structureProperties && setEntry system/controlDict endTime 0.04; ispfFsiFoam > log 2>&1
    grep -q "The case has run without it until 0.02 s" log) || fail "prestress of a case that has run: $(tail -n 3 ../late/log)"

# refused: springs, a solid zone, no such zone, an entry without effect, more than the wall can carry
refused() { # entry words...
    sed -i "s/^prestress.*/prestress { $1 }/" constant/structureProperties; rm -rf 0.* 1 postProcessing
    ispfFsiFoam > log.refused 2>&1 && fail "accepted: $1"
    grep -q "$2" log.refused || fail "$1: $(tail -n 5 log.refused)"
}
refused "pressures { wall 1; }" "Zone wall is solid"
refused "pressures { blood 1; }" "lumen"
refused "" "Nothing loads the solid at the start"
refused "pressure 1;" "Valid are: pressures tolerance maxIter"
refused "pressures { lumen 3e5; } maxIter 20;" "No shape at rest is found"
ispfDictionary system/particleDict -entry zones.wall.rest -set '("x/1.02" "y*1.02" "z")' > /dev/null; place
refused "pressures { lumen 1; }" "Leave one of the two away"
sed -i 's/totalLagrangian/springNetwork/; s/^material.*/G 5e4; links radius; radius 2.1;/' constant/structureProperties
refused "pressures { lumen 1; }" "Take structureModel totalLagrangian"
[ $failures = 0 ]
