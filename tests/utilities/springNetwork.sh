#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The law of the spring network (bin/tools/springNetwork.py): small strains give Lame's thick walls, its integral
# agrees with closed forms, and its lattice sums are the moduli that calibrateSprings measures
set -uo pipefail
. "$(dirname "$0")/../cases/functions"

python3 - <<'EOF' || fail "the law: see above"
import sys
from math import cos, hypot, isclose, log, pi, sin
import springNetwork as law

failures = 0
def check(what, found, expected, tolerance):
    global failures
    if not isclose(found, expected, rel_tol=tolerance):
        failures += 1
        print(f"  {what}: {found}, not {expected}")

A, B = 1.0, 1.6
for strain in (1e-4, -1e-4):  # G. Lame's walls, incompressible: 2 G e (1 - A^2/B^2) and 4 G e (1 - A^3/B^3)
    for m in (2, 3):
        check(f"Lame m={m}", law.pressure(A * (1 + strain), A, B, m), 2 * (m - 1) * strain * (1 - (A / B) ** m), 1e-3)
for a in (0.9, 1.25, 1.5):    # neo-Hooke in closed form
    b2 = law.outerRadius(a, A, B, 2)
    K = a * a - A * A
    check("tube", law.pressure(a, A, B, 2, law.neoHookeSlope), log(a * B / (b2 * A)) + K / 2 * (1 / a**2 - 1 / b2**2), 1e-4)
    la, lb = a / A, law.outerRadius(a, A, B, 3) / B
    check("sphere", law.pressure(a, A, B, 3, law.neoHookeSlope),
          0.5 * (lb**-4 + 4 / lb - la**-4 - 4 / la), 1e-4)
def energy(l, m, n=2000):     # 4 G <(|F n| - 1)^2> of directions in the plane, 15/2 G in space; G = 1
    if m == 2:
        return 4 * sum((hypot(l * cos(t), sin(t) / l) - 1)**2 for t in (pi * (k + 0.5) / n for k in range(n))) / n
    rings = [pi / 2 * (k + 0.5) / n for k in range(n)]  # each as wide as its sine
    return 7.5 * sum(sin(t) * (hypot(l * sin(t), cos(t) / l**2) - 1)**2 for t in rings) * pi / 2 / n
for l in (0.8, 1.3):          # far from rest
    for m in (2, 3):
        check(f"slope m={m}", law.networkSlope(l, m), (energy(l + 1e-4, m) - energy(l - 1e-4, m)) / 2e-4, 1e-4)
# known values: K/dx and 1 for 18 links of the cubic lattice, E/3 = K/dx; K/2 for the square lattice's 8 links
check("lattice18", law.isotropicShear(law.ruleLinks("lattice18", 3), 3), 1.0, 1e-12)
check("lattice8", law.isotropicShear(law.ruleLinks("lattice8", 2), 2), 0.5, 1e-12)
check("26 links", len(law.ruleLinks("radius", 3, 3**0.5)), 26, 0)
sys.exit(failures > 0)
EOF

# values of the solver's library for the same links, k = k_e h
for rule in "lattice8;" "radius; radius 1.5;"; do
    newCase membrane "k_e${rule//[^a-z0-9]/}"; place
    echo "structureModel springNetwork; k_e 1e4; links $rule" > constant/structureProperties
    calibrateSprings -layers 4 > log 2>&1
    theirs=$(sed -n 's/.*, G \([0-9.e+]*\) Pa, E = .*/\1/p' log | head -n 1)
    ours=$(python3 "$ispfRoot/bin/tools/springNetwork.py" | sed -n 's/^shear modulus \(.*\) Pa$/\1/p')
    awk -v a="$theirs" -v b="$ours" 'BEGIN { exit !(a > 0 && (a/b - 1)^2 < 1e-4) }' || fail "links $rule G $ours, calibrateSprings $theirs"
done
for modulus in "G 1e4" "E 3e4"; do
    echo "structureModel springNetwork; $modulus; links lattice8;" > constant/structureProperties
    ours=$(python3 "$ispfRoot/bin/tools/springNetwork.py") && [[ $ours = "shear modulus 10000 Pa"* ]] || fail "$modulus: $ours"
done
[ $failures = 0 ]
