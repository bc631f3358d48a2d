# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against the CPU time that it costs, of a case's variants (Python's standard library alone).  In validation/study:

    from trade import Trade
    trade = Trade("L2 error of U over L2 of U, largest")        # a quantity of the variants' comparison/summary.csv
    trade.family("particles across", {"n25": "25", "n50": "50", "n100": "100"})     # variants, and what they differ in
    trade.family("deltaT [ms]", {"dt4": "4", "n50": "2", "dt1": "1"})
    trade.write()       # comparison/trade.csv with all runs, trade.dat and trade.png with the front
    variant, seconds = trade.cheapest(0.01)

A run that no other is both cheaper and better than is on the front; a single run is no family.  CPU time is the solver's
ExecutionTime, interrupted parts with it.  Variants that VARIANTS does not name are left out; one without its quantity is
told as such."""
import csv
import math
import os
import subprocess
import textwrap
from validationReport import cost

TOOLS = os.path.dirname(os.path.abspath(__file__))
STYLES = os.path.join(TOOLS, "..", "..", "etc", "gnuplot")
COLUMNS = ["family", "choice", "variant", "particles", "steps", "cpuSeconds", "error", "status"]


def chosen():
    """Names of the variants that ispfValidate has run"""
    return os.environ.get("VARIANTS", "").split()


def valueOf(variant, quantity):
    """The quantity in the variant's summary; nan if it has none"""
    try:
        with open(os.path.join(variant, "comparison", "summary.csv"), newline="", encoding="utf-8") as file:
            return next((float(row["value"]) for row in csv.DictReader(file) if row["quantity"] == quantity), math.nan)
    except OSError:
        return math.nan


def front(points):
    """The points (cost, error, ...) to which no other point has at most the same cost and error, by rising cost; without
    those that have nan"""
    best, kept = math.inf, []
    for point in sorted(p for p in points if not any(math.isnan(x) for x in p[:2])):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


class Canvas:
    """Where labels go beside points, both axes logarithmic: none on another, or on a point.  Pixels as in trade.gp"""
    WIDTH, HEIGHT, LETTER, LINE, POINT = 616.0, 600.0, 6.5, 13.0, 6.0

    def __init__(self, points):
        self.low, self.high = ([limit(p[k] for p in points) for k in range(2)] for limit in (min, max))
        self.low, self.high = [0.8 * v for v in self.low], [1.3 * v for v in self.high]
        self.taken = [self.around(self.pixel(p), self.POINT) for p in points]
        self.lines = []

    def around(self, place, size):
        return (place[0] - size, place[1] - size, place[0] + size, place[1] + size)

    def inside(self, box):
        return box[0] > 0 and box[2] < self.WIDTH and box[1] > 0 and box[3] < self.HEIGHT

    def overlap(self, one, other):
        return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]

    def join(self, points):
        """The curve through them, as small boxes"""
        for (x, y), (u, v) in zip(map(self.pixel, points), map(self.pixel, points[1:])):
            n = 1 + int(math.hypot(u - x, v - y) / 4)
            self.lines += [self.around((x + (u - x) * k / n, y + (v - y) * k / n), 2) for k in range(n)]

    def pixel(self, point):
        return [size * math.log(v / a) / math.log(b / a)
                for v, a, b, size in zip(point, self.low, self.high, (self.WIDTH, self.HEIGHT))]

    def place(self, point, text):
        """Left end of the label's middle in data; None if there is no room"""
        x, y = self.pixel(point)
        width = self.LETTER * len(text)
        for others in (self.taken + self.lines, self.taken):  # if there is no other place, on a line
            for left in (x + 9, x - 9 - width):
                for middle in (y + 8, y - 8, y):
                    box = (left, middle - self.LINE / 2, left + width, middle + self.LINE / 2)
                    if self.inside(box) and not any(self.overlap(box, other) for other in others):
                        self.taken.append(box)
                        return [a * (b / a) ** (v / size) for v, a, b, size
                                in zip((left, middle), self.low, self.high, (self.WIDTH, self.HEIGHT))]
        return None


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
        rows, drawn = [], []
        for title, choices in self.families:
            for name, choice in choices:
                particles, steps, seconds, error = self.runs[name]
                status = "did not end" if math.isnan(error) else "front" if name in best else "behind"
                rows.append([title, choice, name, particles, steps, f"{seconds:.4g}",
                             "" if math.isnan(error) else f"{error:.4g}", status])
                if error > 0 and seconds > 0:
                    drawn.append((title, name, choice))
        with open(path + ".csv", "w", newline="", encoding="utf-8") as file:
            lines = csv.writer(file, lineterminator="\n")
            lines.writerow(COLUMNS)
            lines.writerows(rows)
        if drawn:
            self._draw(path, drawn)

    def _draw(self, path, drawn):
        """drawn: (family, variant, choice).  Runs without room for a label are listed beside"""
        at = lambda name: (self.runs[name][2], self.runs[name][3])
        canvas = Canvas([at(name) for _, name, _ in drawn])
        blocks, named, crowd = [], set(), []
        for title in dict.fromkeys(row[0] for row in drawn):
            canvas.join([at(name) for family, name, _ in drawn if family == title])
        for title in dict.fromkeys(row[0] for row in drawn):
            lines, left = [], []
            for name, choice in (row[1:] for row in drawn if row[0] == title):
                place = None if name in named else canvas.place(at(name), choice)
                if not place and name not in named:
                    left.append(choice)
                named.add(name)
                label = [choice, *place] if place else ["", *at(name)]
                lines.append('{} {} "{}" {} {}\n'.format(*at(name), *label))
            blocks.append(f'"{title}"\n' + "".join(lines))
            if left:
                crowd += textwrap.wrap(f"{title}: {'; '.join(left)}", 50, subsequent_indent="    ")
        blocks.append('"front"\n' + "".join(f'{x} {y} "" {x} {y}\n' for x, y, _ in self.front() if x > 0 and y > 0))
        with open(path + ".dat", "w", encoding="utf-8") as file:
            file.write("\n\n".join(blocks))
        ranges = "".join(f"{axis}Low={low}; {axis}High={high}; " for axis, low, high in zip("xy", canvas.low, canvas.high))
        crowded = "\\n".join(["close together:"] + crowd) if crowd else ""
        subprocess.run(["gnuplot", "-e", f"common='{STYLES}/common.gp'; data='{path}.dat'; out='{path}.png'; {ranges}"
                        f"quantity='{self.quantity}'; crowd=\"{crowded}\"", f"{STYLES}/trade.gp"], check=True)
