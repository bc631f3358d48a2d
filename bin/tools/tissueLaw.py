#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of `material` in constant/structureProperties, independent of the solver: W(l1, l2, l3) of the principal stretches
along the radius, the circumference and the axis.  Fibres are helices about that axis."""
import math
import re
import sys
from validation import entry, number

FILE = "constant/structureProperties"


def numbers(key):
    return [float(x) for x in re.findall(r"[-+0-9.eE]+", entry(FILE, f"material.{key}"))]


def value(key, default=math.nan):
    return number(FILE, f"material.{key}", default)


def fibres():
    """Unit vectors of the families along radius, circumference and axis"""
    if entry(FILE, "material.fibres.type") != "helix":
        sys.exit("the law of a vessel is known for fibres of type helix about its axis")
    return [(0.0, math.cos(math.radians(a)), math.sin(math.radians(a))) for a in numbers("fibres.angles")]


def axes():
    """Orthonormal axes of the tissue: the first family, the part of the second across it, and across both.  A law with one family is
    alike in all directions across it: the radius then"""
    family = fibres()
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    first = family[0]
    second = family[1] if len(family) > 1 else (1.0, 0.0, 0.0)
    second = [b - dot(first, second) * a for a, b in zip(first, second)]
    second = [x / math.sqrt(dot(second, second)) for x in second]
    third = [first[1] * second[2] - first[2] * second[1], first[2] * second[0] - first[0] * second[2],
             first[0] * second[1] - first[1] * second[0]]
    return first, second, third


def strains(axesOf, stretches):
    """E_ij = a_i.(C - 1)/2 a_j"""
    return [[0.5 * sum((l * l - 1) * a[k] * b[k] for k, l in enumerate(stretches)) for b in axesOf] for a in axesOf]


def law():
    """W [Pa] of (l1, l2, l3)"""
    kind = entry(FILE, "material.type")
    I1 = lambda l: sum(x * x for x in l)
    if kind == "neoHookean":
        G = value("G") if value("G") == value("G") else value("E") / 3
        return lambda l: G / 2 * (I1(l) - 3)
    if kind == "MooneyRivlin":
        c1, c2 = value("c1"), value("c2")
        return lambda l: c1 * (I1(l) - 3) + c2 * (sum(x**-2 for x in l) - 3)
    if kind == "Yeoh":
        c = [value("c1"), value("c2", 0), value("c3", 0)]
        return lambda l: sum(c[k] * (I1(l) - 3) ** (k + 1) for k in range(3))
    if kind == "Ogden":
        terms = list(zip(numbers("mu"), numbers("alpha")))
        return lambda l: sum(m / a * (sum(x**a for x in l) - 3) for m, a in terms)
    if kind == "HolzapfelGasserOgden":
        G, k1, k2, kappa = value("G"), value("k1"), value("k2"), value("kappa", 0)
        families = fibres()

        def W(l):
            total = G / 2 * (I1(l) - 3)
            for a in families:
                E = kappa * (I1(l) - 3) + (1 - 3 * kappa) * (sum((x * y) ** 2 for x, y in zip(l, a)) - 1)
                if E > 0:
                    total += k1 / (2 * k2) * math.expm1(k2 * E * E)
            return total
        return W
    if kind == "Fung":
        c, b, s, A = value("c"), numbers("normal"), numbers("shear"), axes()

        def W(l):
            E = strains(A, l)
            Q = sum(b[i] * E[i][i] ** 2 for i in range(3))
            for i in range(3):
                j = (i + 1) % 3
                Q += 2 * b[3 + i] * E[i][i] * E[j][j] + s[i] * (2 * E[i][j]) ** 2
            return c / 2 * math.expm1(Q)
        return W
    if kind == "Guccione":
        C, bf, bt, bfs, A = value("C"), value("bf"), value("bt"), value("bfs"), axes()

        def W(l):
            E = strains(A, l)
            Q = bf * E[0][0] ** 2 + bt * (E[1][1] ** 2 + E[2][2] ** 2 + 2 * E[1][2] ** 2) + \
                2 * bfs * (E[0][1] ** 2 + E[0][2] ** 2)
            return C / 2 * math.expm1(Q)
        return W
    sys.exit(f"no law is known for the material {kind}")


def slope():
    """W'(l) [Pa] over the stretch l of the circumference, for m = 2 plane strain, 3 a sphere"""
    W = law()
    along = {2: lambda l: (1 / l, l, 1.0), 3: lambda l: (l**-2, l, l)}
    step = 1e-5
    return lambda l, m: (W(along[m](l + step)) - W(along[m](l - step))) / (2 * step)
