# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against the CPU time that it costs, of a case's variants (Python's standard library alone).  In validation/study:

    from trade import Trade
    trade = Trade("L2 error of U over L2 of U, largest")        # a quantity of the variants' comparison/summary.csv
    trade.family("particles across", {"n25": "25", "n50": "50", "n100": "100"})     # variants, and what they differ in
    trade.family("deltaT [ms]", {"dt4": "4", "n50": "2", "dt1": "1"})
    trade.write()       # comparison/trade.csv with all runs, trade.dat and trade.png with the front
    variant, seconds = trade.cheapest(0.01)

A run that no other is both cheaper and better than is on the front; a single run is no family.  CPU time is the solver's ExecutionTime, interrupted
parts with it.  Variants that VARIANTS does not name are left out; one without its quantity is told as such."""
import csv
import math
import os
import subprocess
from validationReport import cost

TOOLS = os.path.dirname(os.path.abspath(__file__))
STYLES = os.path.join(TOOLS, "..", "..", "etc", "gnuplot")
COLUMNS = ["family", "choice", "variant", "particles", "steps", "cpuSeconds", "error", "status"]


def chosen():
    """Names of the variants that ispfValidate has run"""
    return os.environ.get("VARIANTS", "").split()


def valueOf(variant, quantity):
    """Of the variant's summary; nan if it has none"""
    try:
        with open(os.path.join(variant, "comparison", "summary.csv"), newline="", encoding="utf-8") as file:
            return next((float(row["value"]) for row in csv.DictReader(file) if row["quantity"] == quantity), math.nan)
    except OSError:
        return math.nan


def front(points):
    """Of points (cost, error, ...) those that no other is at most as dear and as wrong as, by rising cost; without
    those that have nan"""
    best, kept = math.inf, []
    for point in sorted(p for p in points if not any(math.isnan(x) for x in p[:2])):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


class Trade:
    def __init__(self, quantity):
        self.quantity, self.families, self.runs = quantity, [], {}

    def family(self, title, choices):
        """choices: variant -> what it is in this family, in words; the order in which they are joined"""
        names = chosen()
        rows = [(name, choice) for name, choice in choices.items() if name in names]
        for name, _ in rows:
            if name not in self.runs:
                particles, steps, seconds = cost(name)
                self.runs[name] = (particles, steps, float(seconds), abs(valueOf(name, self.quantity)))
        if len(rows) > 1:
            self.families.append((title, rows))

    def front(self):
        """(CPU seconds, error, variant) by rising cost"""
        return front([(seconds, error, name) for name, (_, _, seconds, error) in self.runs.items()])

    def cheapest(self, limit):
        """(variant, CPU seconds) of the cheapest run with an error of at most that, or (None, nan)"""
        return next(((name, seconds) for seconds, error, name in self.front() if error <= limit), (None, math.nan))

    def write(self, path="comparison/trade"):
        """path.csv with all runs, path.dat and path.png; nothing if no two variants of a family were to be run"""
        if not self.families:
            return
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        best = [name for _, _, name in self.front()]
        rows, blocks, named = [], [], set()
        for title, choices in self.families:
            points = []
            for name, choice in choices:
                particles, steps, seconds, error = self.runs[name]
                status = "did not end" if math.isnan(error) else "front" if name in best else "behind"
                rows.append([title, choice, name, particles, steps, f"{seconds:.4g}",
                             "" if math.isnan(error) else f"{error:.4g}", status])
                if not math.isnan(error):
                    points.append(f'{seconds} {error} "{"" if name in named else choice}"\n')
                    named.add(name)
            if points:
                blocks.append(f'"{title}"\n' + "".join(points))
        with open(path + ".csv", "w", newline="", encoding="utf-8") as file:
            lines = csv.writer(file, lineterminator="\n")
            lines.writerow(COLUMNS)
            lines.writerows(rows)
        if not blocks:
            return
        blocks.append('"front"\n' + "".join(f'{seconds} {error} ""\n' for seconds, error, _ in self.front()))
        with open(path + ".dat", "w", encoding="utf-8") as file:
            file.write("\n\n".join(blocks))
        subprocess.run(["gnuplot", "-e", f"common='{STYLES}/common.gp'; data='{path}.dat'; out='{path}.png'; "
                        f"quantity='{self.quantity}'", f"{STYLES}/trade.gp"], check=True)
