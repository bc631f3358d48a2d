# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions for a tutorial's validation/compare and validation/study (Python's standard library alone): entries of the
case's dictionaries, the tables of function objects, and a report of quantities beside their references.

    from validation import entry, number, table, Report
    nu = number("constant/physicalProperties", "nu")
    report = Report()
    report.check("decay rate", reference=8*pi**2*nu, value=rate, unit="1/s", tolerance=0.01,
                 reason="first order in time")
    sys.exit(report.write())

RunFunctions puts this folder on PYTHONPATH and the programs on PATH."""
import cmath
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

COLUMNS = ["quantity", "reference", "value", "unit", "error", "tolerance", "status", "reason"]


def entry(file, key, default=None, form="-value"):
    """An entry as the programs read it, without quotes; the default if it, or its file, is not there.  SystemExit with the
    programs' words if they cannot read it.  form -SI: a number without its unit"""
    found = subprocess.run(["ispfDictionary", file] + (["-entry", key] if key else []) + [form], capture_output=True,
                           text=True, check=False)
    if found.returncode == 0:
        return found.stdout.strip().replace('"', "")
    if default is not None and re.search(r"^There is no entry|: No such file or directory", found.stderr, re.M):
        return default
    sys.exit(found.stderr or found.stdout)


def keys(file, key=None):
    """The keys of a dictionary, or of the file"""
    return entry(file, key, form="-keywords").split()


def numbers(text):
    return [float(word) for word in re.findall(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", text)]


def number(file, key, default=None):
    """In SI"""
    return float(entry(file, key, None if default is None else str(default), form="-SI"))


def vector(file, key, default=None):
    """The numbers of a vector, or of a list of vectors, in SI.  SystemExit if it is anything else, e.g. a function of time"""
    text = entry(file, key, default)
    if isinstance(text, list):
        return text
    word = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    found = re.fullmatch(rf"(\((?:\s*(?:{word}|\((?:\s*{word})*\s*\)))*\s*\))\s*(.*)", text, re.S)
    if not found:
        sys.exit(f"{key} of {file} is no constant vector: the reference is known for (x y z) alone, not for\n{text}")
    factor, unit = 1.0, found[2].strip()
    if unit:
        with tempfile.NamedTemporaryFile("w", suffix=".dictionary") as one:
            one.write(f"one 1 {unit};\n")
            one.flush()
            factor = number(one.name, "one")
    return [factor * value for value in numbers(found[1])]


def velocity(file, key):
    """A constant velocity, (x y z) or { direction; speed }, in SI; (0 0 0) if it is not there.  SystemExit if it changes"""
    parent, name = key.rsplit(".", 1)
    if name not in keys(file, parent):
        return [0.0, 0.0, 0.0]
    if entry(file, key).startswith("("):
        return vector(file, key)
    direction, speed = vector(file, f"{key}.direction"), steady(file, f"{key}.speed")
    return [speed * d / math.hypot(*direction) for d in direction]


def steady(file, key, default=0.0):
    """A number that may be given as a function of time, but must be constant, in SI; the default if it is not there"""
    if entry(file, key, "none") == "none":
        return default
    function = sine(file, key)
    if function.amplitude:
        sys.exit(f"{key} of {file} changes in time: the reference is that of a constant")
    return function.level


def gravity():
    """The value of constant/g; zero without this file"""
    return vector("constant/g", "value", [0.0, 0.0, 0.0])


def largest(values):
    """Their maximum; nan if one of them is nan, or there is none"""
    values = list(values)
    return math.nan if not values or any(map(math.isnan, values)) else max(values)


def viscosity():
    """nu [m^2/s] and rho [kg/m^3] of constant/physicalProperties"""
    file = "constant/physicalProperties"
    rho = number(file, "rho")
    nu = number(file, "nu", math.nan)
    return (number(file, "mu") / rho if math.isnan(nu) else nu), rho


def table(path):
    """Rows of numbers of a table of a function object: columns as titled; vectors are three of them"""
    if not os.path.exists(path):
        sys.exit(f"there is no {path}: is its function object in system/controlDict?")
    with open(path, encoding="utf-8") as lines:
        return [[float(w) for w in re.sub(r"[(),]", " ", line).split()] for line in lines
                if line.strip() and not line.startswith("#")]


def history(name, file, whole=True):
    """All rows over time that a function object has written, a continued run's parts put together; SystemExit if they end
    before the run does, unless that is allowed"""
    rows = []
    for start in instants(f"postProcessing/{name}"):
        part = table(f"postProcessing/{name}/{start}/{file}")
        rows = [row for row in rows if not part or row[0] < part[0][0]] + part
    if not rows:
        sys.exit(f"postProcessing/{name}/*/{file} is empty: does functions.{name} of system/controlDict write within the run?")
    end = number("system/controlDict", "endTime")
    between = max([rows[0][0]] + [b[0] - a[0] for a, b in zip(rows, rows[1:])])
    if whole and len(rows) > 1 and rows[-1][0] < end - 1.5 * between:
        sys.exit(f"postProcessing/{name}/*/{file} ends at {rows[-1][0]:g} s of {end:g} s")
    return rows


def strongest(rows, column, about):
    """Frequency and amplitude of the strongest oscillation of a column of rows (time, ...), sought between half and twice
    `about`, ever closer, by Fourier integrals over the rows in a Hann window; the steps in time may differ"""
    times, values = [r[0] for r in rows], [r[column] for r in rows]
    begin, length = times[0], times[-1] - times[0]
    steps = [(b - a) / 2 for a, b in zip([begin] + times[:-1], times[1:] + [times[-1]])]
    mean = sum(v * s for v, s in zip(values, steps)) / length
    windowed = [(v - mean) * s * math.sin(math.pi * (t - begin) / length) ** 2 for t, v, s in zip(times, values, steps)]

    def strength(f):
        return 4 / length * abs(sum(w * cmath.exp(-2j * math.pi * f * t) for t, w in zip(times, windowed)))

    low, high = 0.5 * about, 2 * about
    while (high - low) > 1e-4 * about:
        best = max((low + (high - low) * k / 40 for k in range(41)), key=strength)
        low, high = best - (high - low) / 20, best + (high - low) / 20
    return best, strength(best)


def reference(path, textual=()):
    """Rows of a table of published values, a header and rows of numbers with commas between them, # before remarks:
    dictionaries, of floats but in the textual columns, None where there is nothing"""
    if not os.path.exists(path):
        sys.exit(f"there is no {path}: it has the published values")
    with open(path, encoding="utf-8") as file:
        rows = [(n, line.strip()) for n, line in enumerate(file, 1) if line.strip() and not line.startswith("#")]
    if len(rows) < 2:
        sys.exit(f"{path} has no values: a line of names and then one of values is the least")
    names, found = rows[0][1].split(","), []
    for n, line in rows[1:]:
        words = line.split(",")
        if len(words) != len(names):
            sys.exit(f"{path}, line {n}: {len(words)} columns where the header has {len(names)}: {line}")
        try:
            found.append({k: w if k in textual else float(w) if w else None for k, w in zip(names, words)})
        except ValueError:
            sys.exit(f"{path}, line {n}: no number where the header has {', '.join(k for k in names if k not in textual)}: {line}")
    return found


def explain(kind, error, trace):
    """In place of Python's own lines: where, what and what to look at"""
    while trace.tb_next and "/validation/" in trace.tb_next.tb_frame.f_code.co_filename:
        trace = trace.tb_next
    print(f"{trace.tb_frame.f_code.co_filename}, line {trace.tb_lineno}: {kind.__name__}: {error}. It has met an entry or a "
          "file that it does not expect: see that what it reads there is whole, and the entry one that the tutorial's "
          "README speaks of", file=sys.stderr)


sys.excepthook = explain


def instants(folder):
    """Names of the times that a function object has written, in their order"""
    if not os.path.isdir(folder):
        sys.exit(f"there is no {folder}: is its function object in system/controlDict?")
    return sorted((t for t in os.listdir(folder) if re.fullmatch(r"[\d.eE+-]+", t)), key=float)


def written():
    """Names of the times with particles, without that of the start"""
    return [t for t in instants(".") if float(t) > 0 and os.path.exists(os.path.join(t, "uniform"))]


def field(time, name):
    """A field of the particles at a time that was written with writeFormat ascii, e.g. positions, U, p: numbers, or lists of three"""
    text = ""
    if os.path.exists(os.path.join(time, name)):
        with open(os.path.join(time, name), encoding="utf-8") as file:
            text = file.read()
    if "format      ascii" not in text[:400]:
        sys.exit(f"{time}/{name} is no text: writeFormat in system/controlDict must be ascii")
    lines = text[text.index("\n(\n") + 3:text.rindex("\n)")].split("\n")
    return [[float(w) for w in line[1:-1].split()] if line.startswith("(") else float(line) for line in lines]


def wallSlip(errors, reach):
    """errors: (distance from a wall, difference of the velocity from the exact one).  Returns the difference at the
    wall, from the particles within `reach` along the line of least squares"""
    near = [(d, e) for d, e in errors if d < reach]
    ds, es = [d for d, _ in near], [e for _, e in near]
    return sum(es) / len(es) - slope(ds, es) * sum(ds) / len(ds)


def startUp(place, component, exact, walls, reach, since=0.0, final=0.0):
    """A flow along walls, all particles at all written times beside exact(s, t), s = place(position): the largest error
    ever from the time `since` on, that at the last time, and the largest slip at the walls, of which walls has functions
    from s to the distance.  Writes comparison/profiles.dat: s, ours, exact.  SystemExit unless the flow has come to half
    of its final speed: errors over that one say nothing before"""
    worst, last, slip, profiles, reached = [], math.nan, [], [], 0.0
    for name in written():
        t = float(name)
        rows = sorted((place(x), u[component]) for x, u in zip(field(name, "positions"), field(name, "U")))
        rows = [(s, u, exact(s, t)) for s, u in rows]
        last = largest(abs(u - known) for _, u, known in rows)
        reached = largest(abs(known) for _, _, known in rows)
        profiles.append((f"{t:g} s", rows))
        if t < since:
            continue
        slips = [abs(wallSlip([(distance(s), u - known) for s, u, known in rows], reach)) for distance in walls]
        worst.append(last), slip.append(largest(slips))
    if profiles and not worst and not os.environ.get("ISPF_STEPS"):
        sys.exit(f"no state has been written after {since:.3g} s, from which on the flow is judged: the last is of "
                 f"{profiles[-1][0]}; take a later endTime in system/controlDict, or write there")
    if not profiles:
        sys.exit("no state has been written after the start: endTime, writeInterval or writeTimes of system/controlDict")
    if not reached >= 0.5 * final and not os.environ.get("ISPF_STEPS"):
        sys.exit(f"at {profiles[-1][0]}, the last time written, the flow has {100 * reached / final:.2g} % of its final speed: "
                 "it is judged from half of it on; take a later endTime in system/controlDict, and write there")
    writeBlocks("comparison/profiles.dat", profiles)
    return largest(worst), last, largest(slip)


def interpolated(x, xs, ys):
    """Between the two points of a rising list that hold x; nan beyond them"""
    for a, b, ya, yb in zip(xs, xs[1:], ys, ys[1:]):
        if a <= x <= b:
            return ya if b == a else ya + (yb - ya) * (x - a) / (b - a)
    return math.nan


def slope(xs, ys):
    """Slope of the line of least squares"""
    n, mx, my = len(xs), sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


class sine:
    """A Function1 of type sine, all of whose entries are numbers, or a constant, whose amplitude is 0; SystemExit if it is
    of another type"""

    def __init__(self, file, key):
        kind = entry(file, f"{key}.type", "constant")
        self.omega = self.amplitude = self.t0 = 0.0
        if kind == "constant":
            self.level = number(file, f"{key}.value", math.nan)
            if math.isnan(self.level):  # short form: p 0
                self.level = number(file, key)
            return
        if kind != "sine":
            sys.exit(f"{key} of {file} is of type '{kind}': the reference is known for sine")
        self.omega = 2 * math.pi * number(file, f"{key}.frequency")
        if not self.omega > 0:
            sys.exit(f"{key}.frequency of {file} is {self.omega / (2 * math.pi):g}: what does not swing has no reference here; "
                     "give a frequency above 0, or a constant")
        self.amplitude = number(file, f"{key}.amplitude") * number(file, f"{key}.scale", 1)
        self.level, self.t0 = number(file, f"{key}.level", 0), number(file, f"{key}.t0", 0)

    def value(self, t):
        return self.level + self.amplitude * math.sin(self.omega * (t - self.t0))


def harmonic(times, values, omega):
    """Amplitude and phase [rad] of the A sin(omega t + phase) + B that fits best; nan of less than three values"""
    if len(times) < 3:
        return math.nan, math.nan
    normal, right = [[0.0] * 3 for _ in range(3)], [0.0] * 3
    for t, value in zip(times, values):
        basis = (math.sin(omega * t), math.cos(omega * t), 1.0)
        for i in range(3):
            right[i] += basis[i] * value
            for j in range(3):
                normal[i][j] += basis[i] * basis[j]
    det = lambda m: (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                     + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))
    # Cramer's rule; the matrix is symmetric
    a, b = (det([right if i == k else normal[i] for i in range(3)]) / det(normal) for k in range(2))
    return math.hypot(a, b), math.atan2(b, a)


def values(variants, quantity):
    """For a study: (dx, value) of a quantity in those of its variants that have been run"""
    found = []
    for variant in variants:
        path = os.path.join(variant, "comparison", "summary.csv")
        if variant in os.environ["VARIANTS"].split() and os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                found += [(number(f"{variant}/system/particleDict", "dx"), float(row["value"]))
                          for row in csv.DictReader(file) if row["quantity"] == quantity]
    return found


def order(points):
    """Order of convergence: slope of the errors over the spacings, both logarithmic"""
    return slope([math.log(dx) for dx, _ in points], [math.log(error) for _, error in points])


def writeBlocks(path, blocks):
    """For gnuplot: each (title, rows of numbers) a block that begins with its title"""
    with open(path, "w", encoding="utf-8") as out:
        out.write("\n\n".join(f'"{title}"\n' + "".join(" ".join(map(str, row)) + "\n" for row in rows)
                              for title, rows in blocks))


class Report:
    """Quantities beside their references, as a table on the terminal and in comparison/summary.csv.  A run that
    ispfRunTutorials has shortened is not judged; neither is one that is there for its cost (bin/tools/trade.py): its file
    validation/purpose has `judged no;`"""

    def __init__(self, folder="comparison"):
        self.rows, self.folder = [], folder
        self.without = "shortened" if os.environ.get("ISPF_STEPS") else ""
        if os.path.exists("validation/purpose") and entry("validation/purpose", "judged") == "no":
            self.without = self.without or "told"

    def check(self, quantity, reference, value, tolerance, reason, unit="", scale=None):
        """error: (value - reference)/scale, |reference| by default; it must not be larger than the tolerance, which
        has a reason"""
        scale = abs(reference) if scale is None else scale
        error = (value - reference) / scale if scale else math.nan
        status = "pass" if abs(error) <= tolerance else "FAIL"  # nan fails
        self._add(quantity, reference, value, unit, error, tolerance, status, reason)

    def below(self, quantity, value, limit, reason, unit=""):
        """A quantity that would be 0, judged by its size alone"""
        status = "pass" if abs(value) <= limit else "FAIL"
        self._add(quantity, 0.0, value, unit, value, limit, status, reason)

    def atLeast(self, quantity, value, limit, reason, unit=""):
        """An order of convergence: more is no error"""
        status = "pass" if value >= limit else "FAIL"
        self._add(quantity, limit, value, unit, math.nan if value >= limit else value - limit, 0.0, status, reason)

    def note(self, quantity, value, reason, unit="", reference=math.nan):
        """A quantity that is reported and not judged"""
        self._add(quantity, reference, value, unit, math.nan, math.nan, "told", reason)

    def _add(self, quantity, reference, value, unit, error, tolerance, status, reason):
        # it has no tolerance; but the cost of a run without a result is no number
        if self.without == "shortened" or self.without and not (status == "FAIL" and math.isnan(value)):
            tolerance, status = math.nan, self.without
        self.rows.append([quantity, reference, value, unit, error, tolerance, status, reason])

    def write(self):
        """1 if a quantity is outside its tolerance, else 0"""
        os.makedirs(self.folder, exist_ok=True)
        text = lambda v: "" if isinstance(v, float) and math.isnan(v) else f"{v:.6g}" if isinstance(v, float) else v
        with open(os.path.join(self.folder, "summary.csv"), "w", newline="", encoding="utf-8") as file:
            lines = csv.writer(file, lineterminator="\n")
            lines.writerow(COLUMNS)
            # a value that is not a number stays visible
            lines.writerows([[r[0], text(r[1]), f"{r[2]:.6g}"] + [text(v) for v in r[3:]] for r in self.rows])
        print(f"{'quantity':<44} {'reference':>12} {'ours':>12} {'unit':<8} {'error':>10} {'tolerance':>10}  status")
        for quantity, reference, value, unit, error, tolerance, status, _ in self.rows:
            print(f"{quantity:<44} {text(float(reference)):>12} {value:>12.6g} {unit:<8} {text(error):>10} "
                  f"{text(float(tolerance)):>10}  {status}")
        return int(any(r[6] == "FAIL" for r in self.rows))
