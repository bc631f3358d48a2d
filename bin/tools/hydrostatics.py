# SPDX-License-Identifier: GPL-3.0-or-later
"""Common functions of the comparisons of hydrostaticBox and hydrostaticVessel"""
import math
import sys
from validation import Report, entry, gravity, history, instants, keys, largest, number, table, vector, viscosity

particles, patches = "system/particleDict", "constant/boundary"
STEPS = 1000  # the fluid must be at rest after this number of steps


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def openFaces(g, rho):
    """p - rho g.x of each, and how deep it lies along g"""
    size = math.sqrt(dot(g, g))
    for name in keys(patches):
        if entry(patches, f"{name}.type") != "open":
            continue
        if entry(patches, f"{name}.surface", "triSurface") != "plane":
            sys.exit(f"{patches}: the reference is of open faces with surface plane; point and normal of {name} are not known")
        point, normal = (vector(patches, f"{name}.{key}") for key in ("point", "normal"))
        if abs(abs(dot(g, normal)) - size * math.sqrt(dot(normal, normal))) > 1e-9 * size:
            sys.exit(f"{patches}: fluid behind {name} is at rest only if gravity is along its normal, as p is the same all over it")
        yield number(patches, f"{name}.p") - rho * dot(g, point), dot(g, point) / size


def compare():
    """Fluid at rest: u = 0 and p = rho g.x + constant, exactly; the constant is free, or as open faces fix it"""
    _, rho = viscosity()
    g, dx = gravity(), number(particles, "dx")
    size = math.sqrt(dot(g, g))
    if len(g) != 3 or size == 0:
        sys.exit("constant/g: the reference is of a constant acceleration that is not zero, e.g. value (0 0 -9.81);")
    faces = list(openFaces(g, rho))
    if faces and max(level for level, _ in faces) - min(level for level, _ in faces) > 1e-12 * max(abs(l) for l, _ in faces):
        sys.exit(f"{patches}: the pressures of the open faces drive a flow")
    # Time, then value and position of min(U) max(U) min(p) max(p)
    rows = history("extremes", "minMax.dat")
    if not rows[-1][0] > 0:
        sys.exit("functions.extremes of system/controlDict has written no step, and what rests before the first one is no "
                 "result: a larger endTime, or writeControl timeStep of extremes, gives some to judge")
    profiles = [t for t in instants("postProcessing/depth") if float(t) > 0]  # p is computed by the steps
    if not profiles:
        sys.exit("functions.depth of system/controlDict has written no time after the first step, before which there is no p "
                 "to judge: writeControl onEnd writes it at the end of the run, whatever endTime is")
    for name, wanted in (("extremes", ["U", "p"]), ("depth", ["p"])):
        if entry("system/controlDict", f"functions.{name}.fields", "(U p)").strip("()").split() != wanted:
            sys.exit(f"functions.{name} of system/controlDict: its columns are read as those of fields ({' '.join(wanted)})")
    ends = [dot(rows[-1][k:k + 3], g) / size for k in (10, 14)]
    top, bottom = min(ends) - dx / 2, max(ends) + dx / 2
    for _, at in faces:  # particles beyond an open face do not count
        top, bottom = (max(top, at), bottom) if at < (top + bottom) / 2 else (top, min(bottom, at))
    depth = bottom - top
    fast = math.sqrt(size * depth)
    shapes = {entry(particles, f"zones.{zone}.shape", "file") for zone in keys(particles, "zones")}
    ordered = shapes == {"box"} and entry(particles, "placement", "lattice") == "lattice"

    line = table(f"postProcessing/depth/{profiles[-1]}/line.dat")  # distance, position, p
    points = len(line)
    while line and math.isnan(line[0][4]):  # beyond the fluid; nan inside is judged
        line.pop(0)
    while line and math.isnan(line[-1][4]):
        line.pop()
    if 2 * len(line) < points or len(line) < 2:
        sys.exit(f"functions.depth of system/controlDict: {len(line)} of the line's {points} points lie in the fluid, "
                 "where p is a number; it wants to be half of them or more, and two at least")
    hydrostatic = [rho * dot(row[1:4], g) for row in line]
    level = faces[0][0] if faces else sum(row[4] - p for row, p in zip(line, hydrostatic)) / len(line)
    worst = largest(abs(row[4] - p - level) for row, p in zip(line, hydrostatic))
    between = rows[-1][13] - rows[-1][9] - rho * (dot(rows[-1][14:17], g) - dot(rows[-1][10:13], g))
    with open("comparison/depth.dat", "w", encoding="utf-8") as out:
        out.writelines(f"{row[0]} {row[4]} {p + level}\n" for row, p in zip(line, hydrostatic))

    report = Report()
    steps = round(rows[-1][0] / number("system/controlDict", "deltaT"))
    limit = 1e-6 if ordered else 1e-3
    reason = f"asked for: 1e-6 on a lattice with plane walls, 1e-3 otherwise, after {STEPS} steps"
    if steps < STEPS:
        reason += f"; it is held after {steps} so far: a larger endTime of system/controlDict shows more"
    report.below("largest speed at the end over sqrt(g H)", rows[-1][5] / fast, limit, reason)
    report.below("largest error of p over rho g H", worst / (rho * size * depth), 1e-6,
                 "gravity is carried exactly; what is left is what the solvers' tolerance leaves")
    report.below("the same of the difference between least and largest p", between / (rho * size * depth), 1e-5,
                 "in all directions of g, not along one line alone; of two particles, not of means over their neighbours")
    report.note("largest speed at any time over sqrt(g H)", largest(row[5] for row in rows) / fast,
                "p comes from zero in the first step, to the solver's tolerance")
    report.note("steps", steps, "as asked for" if steps >= STEPS else "fewer than asked for: the speed may grow yet",
                reference=STEPS)
    return report.write()
