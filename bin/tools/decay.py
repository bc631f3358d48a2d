# SPDX-License-Identifier: GPL-3.0-or-later
"""Flows that keep their shape as they decay, exp(-rate t), in a box that repeats itself: what validation/compare of such a
tutorial has in common.  The case has the function objects `balance` (energy), `error` (errorNorm of U and p) and `middle`
(lineProfile of U)"""
import math
import sys
from validation import Report, entry, history, instants, largest, number, slope, table, vector, viscosity, writeBlocks

ASKED = "asked for: decay rate 1 % at Re 100 with 50 particles across, U 2 %, p 5 %"
INSTANTS = "; at the instants that functions.error writes"
LEFT = 0.45  # of the speed: the flow is judged down to this; p then has a fifth of its size, and later only noise


def wants(box):
    """SystemExit unless the fluid's box has these corners, in as many directions as are given"""
    low, high = (vector("system/particleDict", f"zones.fluid.{end}") for end in ("min", "max"))
    if (low[:len(box[0])], high[:len(box[1])]) != box:
        sys.exit(f"the formulas of system/particleDict and controlDict repeat themselves in the box from {box[0]} to {box[1]}: "
                 "zones.fluid must have these corners")


def shifted():
    file = "system/sphSolution"
    return entry(file, "shifting.type", "Xu") != "none" and number(file, "shifting.constant", 0.1) > 0


def wantsFormulas(errors, rate):
    """SystemExit unless functions.error has the flow's exact solution: what it begins with, and how fast it decays"""
    where = "functions.error of system/controlDict"
    start, U, _, exact = errors[0][:4]
    if not 0 < exact < math.inf or not U <= 1e-6 * exact:
        sys.exit(f"at {start} s U is not the exact solution that {where} has, or that is zero")
    # the mean over particles scatters with their places: 0.5 % of it, 2 % without shifting
    off = largest(abs(row[3] / exact / math.exp(-rate * (row[0] - start)) - 1) for row in errors)
    if not off < 0.03:
        sys.exit(f"the exact U of {where} does not decay with {rate:g} 1/s, but is up to {100 * off:.3g} % off it: the "
                 "reference is of vortices of wave number 2 pi alone, without a velocity common to all; take the "
                 "tutorial's formulas")


def judge(perNu, profile):
    """perNu [1/m2]: decay rate of the velocity over nu; profile: index of the component of U that is drawn, and its shape
    over x at time 0.  Writes comparison/{decay,errors,profiles}.dat and the report; its status"""
    nu, _ = viscosity()
    if nu == 0:
        sys.exit("constant/physicalProperties: without viscosity the flow does not decay; give nu or mu")
    rate, Re = perNu * nu, 1 / nu
    until = -math.log(LEFT) / rate
    energies = [(row[0], row[1]) for row in history("balance", "energy.dat") if row[0] <= until]
    errors = [row for row in history("error", "errorNorm.dat") if row[0] <= until]  # Time, L2 max exact of U, the same of p
    if len(energies) < 2 or len(errors) < 2:
        sys.exit(f"functions.balance and functions.error of system/controlDict have to write twice within {until:.3g} s, in "
                 f"which the flow loses {100 * (1 - LEFT):g} % of its speed: take a shorter writeInterval")
    wantsFormulas(errors, rate)
    found = -slope([t for t, _ in energies], [0.5 * math.log(e) for _, e in energies])
    errors = [(row[0], row[1] / row[3], row[4] / row[6]) for row in errors[1:]]
    U, p = (largest(row[k] for row in errors) for k in (1, 2))

    component, shape = profile
    writeBlocks("comparison/decay.dat", [("speed", [(t, math.sqrt(e / energies[0][1]), math.exp(-rate * t)) for t, e in energies])])
    writeBlocks("comparison/errors.dat", [("errors", errors)])
    writeBlocks("comparison/profiles.dat",
                [(f"{t} s", [(row[1], row[4 + component], shape(row[1]) * math.exp(-rate * float(t)))
                             for row in table(f"postProcessing/middle/{t}/line.dat")]) for t in instants("postProcessing/middle")])

    report = Report()
    if shifted():
        report.check("decay rate of the speed", rate, found, 0.01 if Re < 101 else 0.03,
                     ASKED if Re < 101 else "above Re 100 what the scheme itself damps shows: 3 % of the decay", unit="1/s")
        report.below("L2 error of U over L2 of U, largest", U, 0.02, ASKED + INSTANTS)
        report.below("L2 error of p over L2 of p, largest", p, 0.05, ASKED + INSTANTS)
    else:
        report.atLeast("L2 error of U over L2 of U, largest", U, 0.1, "without shifting it has to fail visibly")
        report.atLeast("L2 error of p over L2 of p, largest", p, 0.25, "without shifting it has to fail visibly")
    report.note("L2 error of U over L2 of U, last", errors[-1][1], "for the orders of convergence")
    report.note("L2 error of p over L2 of p, mean", sum(row[2] for row in errors) / len(errors), "over the written times")
    return report.write()
