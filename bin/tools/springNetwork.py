#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: springNetwork.py [-case folder] [-inner A -outer B]
Prints the law of the spring network in constant/structureProperties, independent of the solver: its shear modulus, and
the pressure that inflates a long cylinder (plane strain) and a sphere of rest radii A and B [m], beside
that of a neo-Hookean wall of the same modulus.  Python's standard library alone.

Links are linear springs, k (d - d0).  In an affine deformation F a particle of volume V has the energy density

    W(F) = 1/(4 V) sum_links k d0^2 (|F n| - 1)^2                                                          [Pa]

n the directions of its links at rest.  Averaged over all orientations of the packing, the links' lengths drop out:

    W = 4 G <(|F n| - 1)^2> in plane strain,      W = 15/2 G <(|F n| - 1)^2> in space,      < > over directions

since the isotropic part of the modulus tensor is G = sum k d0^2/(16 V), /(30 V) (springLinks.H).  The wall is
incompressible, so that one stretch l = r/R of its circumference tells all of F: principal stretches l, 1/l in the
plane, l, l, 1/l^2 on a sphere.  Equilibrium then gives (e.g. R. W. Ogden 1984, Non-linear Elastic Deformations, 5.3)

    p = int_{l_b}^{l_a} W'(l)/(l^m - 1) dl,      m = 2 cylinder, 3 sphere;      l_b from the wall's volume

E or G name the modulus: the solver fits its links to it, at surfaces too.  With k_e
it is the sum over the lattice: missing neighbours soften a wall of N layers further, which is no part of this law."""
import argparse
import math
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from validation import entry, number  # noqa: E402

FILE = "constant/structureProperties"


def latticeLinks(nDims, reach):
    """Offsets in dx of the neighbours on a square or cubic lattice within `reach` dx, those at it included"""
    n = range(-math.ceil(reach), math.ceil(reach) + 1)
    every = [(i, j, k) for i in n for j in n for k in (n if nDims == 3 else [0])]
    return [d for d in every if 0 < math.hypot(*d) <= reach * (1 + 1e-6)]


def ruleLinks(rule, nDims, radius=0.0):
    """Offsets [dx] of the links of a rule, and their stiffnesses relative to the stiffest"""
    links = latticeLinks(nDims, radius if rule == "radius" else math.sqrt(2))
    return [(d, 0.5 if rule == "lattice8" and math.hypot(*d) > 1.2 else 1.0) for d in links]


def isotropicShear(links, nDims):
    """sum k d0^2/(30 V), in plane strain /(16 V), in units of k/dx (of k in two dimensions)"""
    return sum(k * math.hypot(*d) ** 2 for d, k in links) / (30 if nDims == 3 else 16)


def shearModulus(nDims, h, dx):
    """G [Pa] of the case in the present folder"""
    for key, factor in (("G", 1.0), ("E", 1 / 3)):
        if (value := number(FILE, key, math.nan)) == value:
            return factor * value
    rule = entry(FILE, "links")
    links = ruleLinks(rule, nDims, number(FILE, "radius", 0))
    return isotropicShear(links, nDims) * number(FILE, "k_e") * h / (dx if nDims == 3 else 1)


def fittedShearModulus():
    """G [Pa] of the case in the present folder, whose links are fitted to it; SystemExit if it names a spring constant:
    stiffness then depends on direction and on what packing has made of the neighbours"""
    if entry(FILE, "E", "none") == entry(FILE, "G", "none") == "none":
        sys.exit(f"{FILE} has neither E nor G: the law is known for links that are fitted to a modulus, as those of "
                 "packed particles are to E; of k_e it would be the sum over a lattice, which is not theirs.  Give E")
    return shearModulus(3, math.nan, math.nan)


def networkSlope(stretch, m, n=200):
    """W'(l)/G of the network averaged over directions; m = 2 in plane strain, 3 on a sphere"""
    total = 0.0
    for k in range(n):
        if m == 2:  # midpoints of a quarter turn
            u = math.cos(0.5 * math.pi * (k + 0.5) / n) ** 2
            s = stretch**2 * u + (1 - u) / stretch**2
            ds = 2 * stretch * u - 2 * (1 - u) / stretch**3
        else:       # of the cosine to the thickness
            u = ((k + 0.5) / n) ** 2
            s = stretch**2 * (1 - u) + u / stretch**4
            ds = 2 * stretch * (1 - u) - 4 * u / stretch**5
        total += (1 - 1 / math.sqrt(s)) * ds
    return (4 if m == 2 else 7.5) * total / n


def neoHookeSlope(stretch, m):
    """W'(l)/G of W = G/2 (tr F F^T - 3)"""
    return stretch - stretch**-3 if m == 2 else 2 * (stretch - stretch**-5)


def outerRadius(a, A, B, m):
    """The wall keeps its volume"""
    return (B**m + a**m - A**m) ** (1 / m)


def pressure(a, A, B, m, slope=networkSlope, n=100):
    """p/G that holds the inner radius a of a wall with rest radii A and B"""
    la, lb = a / A, outerRadius(a, A, B, m) / B
    step = (la - lb) / n
    middles = [lb + step * (k + 0.5) for k in range(n)]
    return step * sum(slope(l, m) / (l**m - 1) for l in middles) if step else 0.0


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("-case", default=".")
    words.add_argument("-inner", type=float, default=1.0)
    words.add_argument("-outer", type=float, default=1.6)
    given = words.parse_args()
    if not 0 < given.inner < given.outer:
        words.error(f"rest radii {given.inner} and {given.outer}: 0 < inner < outer is wanted")
    if not shutil.which("ispfDictionary"):
        sys.exit("ispfDictionary, which reads the case, is not on the PATH: run 'make', then "
                 "export PATH=<where this is>/build/Release/bin:$PATH")
    if not os.path.isdir(given.case):
        sys.exit(f"there is no folder {given.case}: -case wants that of a case")
    os.chdir(given.case)
    nDims = int(number("system/particleDict", "nDims", 3))
    dx = number("system/particleDict", "dx")
    G = shearModulus(nDims, number("system/sphSchemes", "hByDx", 1.3) * dx, dx)
    print(f"shear modulus {G:.6g} Pa\n\nrest radii {given.inner} m and {given.outer} m")
    print(f"{'a/A':>6}" + "".join(f"{s + ' p [Pa]':>20} {'of neo-Hooke':>13}" for s in ("cylinder", "sphere")))
    for k in range(0, 11):
        a = given.inner * (1 + 0.05 * k)
        ours = [pressure(a, given.inner, given.outer, m) for m in (2, 3)]
        others = [pressure(a, given.inner, given.outer, m, neoHookeSlope) for m in (2, 3)]
        print(f"{a / given.inner:>6.2f}" + "".join(
            f"{G * p:>20.6g} {p / q if q else 1:>13.4f}" for p, q in zip(ours, others)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
