# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact sums over the links of a lattice of equal springs (cubic and square: all within the links' reach; lattice8:
diagonal ones half as stiff).  Cauchy & Born: in a homogeneous motion each link d becomes F d, so that

    W = 1/(2 V) sum k/2 (|F d| - |d|)^2        M. Born & K. Huang 1954, Dynamical Theory of Crystal Lattices, ch. 11

and in a slab of N layers a link across m of them is there (N - m)/N times."""
import itertools
import math
import sys
from validation import entry, number

SCHEMES, PROPERTIES = "system/sphSchemes", "constant/structureProperties"


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def times(M, v):
    return [dot(row, v) for row in M]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    return [x / math.sqrt(dot(v, v)) for x in v]


def outer(a, b):
    return [[x * y for y in b] for x in a]


class Lattice:
    """Lengths in spacings dx [m], volume 1 per particle: sums come in Pa"""

    def __init__(self, kind, dx):
        self.kind, self.dx, self.nDims = kind, dx, 3 if kind == "cubic" else 2
        self.fitted = entry(PROPERTIES, "k_e", "none") == "none"
        rule = entry(PROPERTIES, "links")
        # those at exactly the radius are in
        reach = number(PROPERTIES, "radius") * (1 + 1e-6) if rule == "radius" else math.sqrt(2) * 1.02
        stiffness = self._stiffness(rule)
        half = lambda d: 0.5 if rule == "lattice8" and dot(d, d) > 1.44 else 1.0
        self.links = [(d, p, stiffness * half(d)) for d, p in self._points(reach)]  # vector, layers apart, k

    def _stiffness(self, rule):
        """k/dx in space; k of a plane solid a metre thick [Pa]"""
        if not self.fitted:
            return number(PROPERTIES, "k_e") * number(SCHEMES, "hByDx", 1.3) * (1 if self.nDims == 3 else self.dx)
        if rule == "radius" or self.kind == "triangular":
            sys.exit("validation/compare knows equal springs: with links radius take k_e in constant/structureProperties")
        G = number(PROPERTIES, "G") if entry(PROPERTIES, "G", "none") != "none" else number(PROPERTIES, "E") / 3
        return G if rule == "lattice18" else 2 * G

    def _points(self, reach):
        n = math.ceil(1.2 * reach) + 1
        row = math.sqrt(math.sqrt(0.75))  # of triangles of area dx^2 each
        for p in itertools.product(range(-2 * n, 2 * n + 1), range(-n, n + 1), range(-n, n + 1) if self.nDims == 3 else [0]):
            d = [(p[0] + 0.5 * p[1]) / row, p[1] * row, 0.0] if self.kind == "triangular" else [float(i) for i in p]
            if 0 < math.sqrt(dot(d, d)) <= reach:
                yield d, abs(p[-1] if self.nDims == 3 else p[1])

    def share(self, apart, layers):
        return 1.0 if layers == 0 else max(0.0, 1 - apart / layers)

    def stress(self, motion, direction, stretch, layers):
        """Nominal stress [Pa], see homogeneousMotion.H"""
        F, rate = homogeneous(motion, direction, stretch, self.nDims)
        total = 0.0
        for d, apart, k in self.links:
            e = times(F, d)
            total += 0.5 * k * self.share(apart, layers) * (1 - math.sqrt(dot(d, d) / dot(e, e))) * dot(e, times(rate, e))
        return total

    def modulus(self, motion, direction, layers=0):
        """Slope of the stress at rest: 1/2 sum k (n.rate d)^2, per rate of the motion's amount"""
        F, rate = homogeneous(motion, direction, 1.0, self.nDims)
        per = 0.5 if motion == "equibiaxial" else 1.0  # the rate of the stress over that of lambda
        return sum(0.5 * k * self.share(apart, layers) * dot(d, times(rate, d))**2 / dot(d, d)
                   for d, apart, k in self.links) / per

    def bilinear(self, a, b, layers):
        """a : C : b of symmetric strains, C of the slab"""
        return sum(0.5 * k * self.share(apart, layers) * dot(d, times(a, d)) * dot(d, times(b, d)) / dot(d, d)
                   for d, apart, k in self.links)

    def shear(self):
        """G of the isotropic lattice with the same sum"""
        return sum(0.5 * k * dot(d, d) for d, _, k in self.links) / (15 if self.nDims == 3 else 8)

    def slabModulus(self, degrees, layers):
        """Tension of a free incompressible slab within its plane, over 3 G (4 G in two dimensions): the least energy of
        all strains with 1 along the tension"""
        angle = math.radians(degrees)
        a, b, c = [math.cos(angle), math.sin(angle), 0], [-math.sin(angle), math.cos(angle), 0], [0, 0, 1]
        aa, bb, cc = outer(a, a), outer(b, b), outer(c, c)
        minus = lambda A, B: [[x - y for x, y in zip(r, s)] for r, s in zip(A, B)]
        if self.nDims == 2:
            e = minus(aa, bb)
            return self.bilinear(e, e, layers) / (4 * self.shear())
        base, free = minus(aa, cc), [minus(bb, cc), [[x + y for x, y in zip(r, s)] for r, s in zip(outer(a, b), outer(b, a))]]
        C = [[self.bilinear(f, g, layers) for g in free] for f in free]
        r = [self.bilinear(base, f, layers) for f in free]
        det = C[0][0] * C[1][1] - C[0][1] * C[1][0]
        least = (r[0] * (C[1][1] * r[0] - C[0][1] * r[1]) + r[1] * (C[0][0] * r[1] - C[1][0] * r[0])) / det
        return (self.bilinear(base, base, layers) - least) / (3 * self.shear())

    def frequency2(self, K, e, rho):
        """omega^2 [1/s^2] of the wave across K [1/m], and by how much e is no eigenvector"""
        force = [0.0] * 3
        for d, _, k in self.links:
            turn = k * (1 - math.cos(self.dx * dot(K, d))) * dot(d, e) / dot(d, d)
            force = [f + turn * x for f, x in zip(force, d)]
        square = dot(force, e)
        return square / (rho * self.dx**2), math.sqrt(dot(force, force) / square**2 - 1) if square else math.nan


def homogeneous(motion, direction, stretch, nDims):
    """F and dF/d(amount) F^-1, see homogeneousMotion.H; the rate at rest for stretch 1"""
    a = unit(direction)
    near = [1, 0, 0] if abs(a[2]) > 1 - 1e-9 else [0, 0, 1]
    c = unit([n - dot(near, a) * x for n, x in zip(near, a)])
    b = cross(c, a)
    combined = lambda weights: [[sum(w * v[i] * v[j] for w, v in zip(weights, (a, b, c))) for j in range(3)] for i in range(3)]
    if motion == "shear":
        slide = outer(a, b)
        gamma = stretch - 1 / stretch
        return [[(i == j) + gamma * slide[i][j] for j in range(3)] for i in range(3)], slide
    if motion == "equibiaxial":
        powers, rates = (1, 1, -2), (0.5, 0.5, -1)
    elif nDims == 2:
        powers, rates = (1, -1, 0), (1, -1, 0)
    else:
        powers, rates = (1, -0.5, -0.5), (1, -0.5, -0.5)
    return combined([stretch**p for p in powers]), combined([r / stretch for r in rates])
