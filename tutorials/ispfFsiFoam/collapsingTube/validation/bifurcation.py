# SPDX-License-Identifier: GPL-3.0-or-later
"""Buckling of a thick incompressible tube in plane strain under a pressure P around it, from the slope W'(l) of its wall's energy
over the stretch l of the circumference, and the shape of a ring that has buckled.

Critical pressure.  The circular tube goes from R to r, r^2 = R^2 + c, with the radial stress d sr/dr = l W'/r, sr = 0 inside
and -P outside.  It buckles where the second variation of the energy vanishes for an incompressible field
u = (f cos n t, g sin n t), f' + (f + n g)/r = 0 (R. W. Ogden 1984, Non-linear Elastic Deformations, ch. 6, for the moduli):

    int [(Wss - st - sr) f'^2 + Ar g'^2 + At k^2 + 2 (Ar - sr) g' k] r dr + P [f^2 + 2 n f g + g^2] at the outer surface

with k = - (n f + g)/r, Wss = l^2 W'' + l W', At = l^2 q, Ar = q/l^2, q = l W'/(l^2 - l^-2).  f is a polynomial.

Buckled ring.  A rod bends by k - k0 = C + P/(2 D) |x|^2 under the pressure P, x from its centre, without stretch; two conditions of symmetry
at the end of a quarter give C and the start.  D is such that it buckles at the critical pressure: P = 3 D/R^3."""
import math


def forms(a, A, B, slope, n=2, degree=7, nodes=60):
    """P, and the matrix of the second variation over the polynomials' coefficients"""
    b = math.sqrt(B * B + a * a - A * A)
    half, middle = (b - a) / 2, (a + b) / 2
    size = degree + 1
    def shapes(r):
        """f, f', g, g' of each power"""
        x = (r - middle) / half
        out = []
        for k in range(size):
            f = x**k
            d = k * x ** (k - 1) / half if k else 0.0
            dd = k * (k - 1) * x ** (k - 2) / half**2 if k > 1 else 0.0
            out.append((f, d, -(r * d + f) / n, -(r * dd + 2 * d) / n))
        return out
    M = [[0.0] * size for _ in range(size)]
    sr, step = 0.0, (b - a) / nodes
    for j in range(nodes):
        r = a + (j + 0.5) * step
        l = r / math.sqrt(r * r + A * A - a * a)
        w = lambda s: s * slope(s, 2)                       # l W'
        inside = w(l) / r
        sr += inside * step / 2
        Wss = l * (w(l * (1 + 1e-5)) - w(l * (1 - 1e-5))) / (2e-5 * l)
        q = w(l) / (l * l - l**-2) if abs(l - 1) > 1e-6 else Wss / 4
        At, Ar, st = l * l * q, q / (l * l), sr + w(l)
        basis = [(f, d, -(n * f + g) / r, dg) for f, d, g, dg in shapes(r)]
        for i, (_, d1, k1, g1) in enumerate(basis):
            for m, (_, d2, k2, g2) in enumerate(basis[:i + 1]):
                M[i][m] += r * step * ((Wss - st - sr) * d1 * d2 + Ar * g1 * g2 + At * k1 * k2
                                       + (Ar - sr) * (g1 * k2 + g2 * k1))
        sr += inside * step / 2
    P = -sr
    edge = shapes(b)
    for i, (f1, _, g1, _) in enumerate(edge):
        for m, (f2, _, g2, _) in enumerate(edge[:i + 1]):
            M[i][m] += P * (f1 * f2 + g1 * g2 + n * (f1 * g2 + f2 * g1))
    return P, M


def positive(M):
    """Cholesky's factor exists"""
    L = [[0.0] * len(M) for _ in M]
    for i in range(len(M)):
        for j in range(i + 1):
            s = M[i][j] - sum(L[i][k] * L[j][k] for k in range(j))
            if i == j:
                if s <= 0:
                    return False
                L[i][i] = math.sqrt(s)
            else:
                L[i][j] = s / L[j][j]
    return True


def critical(A, B, slope):
    """[Pa]"""
    low, high = 0.7, 1.0                                    # a/A: buckled, and not
    while high - low > 1e-7:
        mid = (low + high) / 2
        stable = positive(forms(mid * A, A, B, slope)[1])
        low, high = (low, mid) if stable else (mid, high)
    return forms(high * A, A, B, slope)[0]


def radius(P, A, B, slope):
    """Where the middle of the wall is in a round tube under P, over its radius at rest"""
    low, high, R = 0.7 * A, A, (A + B) / 2
    while high - low > 1e-9 * A:
        mid = (low + high) / 2
        low, high = (low, mid) if forms(mid, A, B, slope, degree=0)[0] < P else (mid, high)
    return math.sqrt(R * R + low * low - A * A) / R


def march(x0, P, C, e, n=100):
    """Quarter of a rod from (x0, 0) on, lengths over R, P over D/R^3, e the ellipse's amplitude at rest: x and direction at the end, y,
    and the area of the whole"""
    def rate(s, v):
        x, y, way, _ = v
        k = 1 + 3 * e * math.cos(2 * s) + C + P / 2 * (x * x + y * y)
        return (math.cos(way), math.sin(way), k, 2 * (x * math.sin(way) - y * math.cos(way)))
    v, d = (x0, 0.0, math.pi / 2, 0.0), math.pi / 2 / n
    add = lambda u, w, f: tuple(a + f * b for a, b in zip(u, w))
    for j in range(n):
        s = j * d
        k1 = rate(s, v)
        k2 = rate(s + d / 2, add(v, k1, d / 2))
        k3 = rate(s + d / 2, add(v, k2, d / 2))
        k4 = rate(s + d, add(v, k3, d))
        v = tuple(a + d / 6 * (b1 + 2 * b2 + 2 * b3 + b4) for a, b1, b2, b3, b4 in zip(v, k1, k2, k3, k4))
    return v[0], v[2] - math.pi, v[1], v[3]


def path(e, most=1.36, n=60):
    """(x0, y0, area over that of the circle, P R^3/D) of a rod as it buckles, x0 from the rest on"""
    P, C, rows = 1e-6, -5e-7, [(1 + e, 1 - e, 1.0, 0.0)]
    for j in range(n):
        # close together where P rises fast, towards the end as widely as can be
        x0 = 1 + e + (most - 1 - e) * ((j + 1) / n) ** 2
        for _ in range(30):             # Newton's method for P and C
            at = march(x0, P, C, e)
            a, b = march(x0, P + 1e-6, C, e), march(x0, P, C + 1e-6, e)
            (p, q), (r, t) = [((a[k] - at[k]) / 1e-6, (b[k] - at[k]) / 1e-6) for k in (0, 1)]
            det = p * t - q * r
            dP, dC = (q * at[1] - t * at[0]) / det, (r * at[0] - p * at[1]) / det
            P, C = P + dP, C + dC
            if abs(dP) + abs(dC) < 1e-10:
                break
        rows.append((x0, at[2], at[3] / math.pi, P))
    return rows
