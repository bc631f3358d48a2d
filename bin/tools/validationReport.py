# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: validationReport.py folder root < plan.  Gathers what ispfValidate has run in `folder`, one line of the plan
"tutorial variant tier changes" each, into summary.csv and report.md.  Status 1 if anything is FAIL."""
import csv
import glob
import io
import os
import re
import sys

COLUMNS = ["case", "quantity", "reference", "value", "unit", "error", "tolerance", "status", "tier", "particles", "steps",
           "cpuSeconds"]

COLUMNS_SHOWN = 6  # errors in a table of costs
RUNS_SHOWN = 6  # in a line of expected errors


def cost(case):
    """Particles, steps and CPU seconds of the solver's logs, those of interrupted runs with them"""
    particles, steps, seconds = "", 0, 0.0
    for folder, _, files in os.walk(case):
        for name in files:
            if not name.startswith("log.ispfFsiFoam") and name != "solver.log" or ".old/" in folder + "/":
                continue
            last = 0.0
            with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as log:
                for line in log:
                    if line.startswith("Time = "):
                        steps += 1
                    elif line.startswith("ExecutionTime = "):
                        now = float(line.split()[2])
                        if now < last:  # another run has begun in the same log
                            seconds += last
                        last = now
                    elif (found := re.match(r"particles: (\d+) \(", line)) and not particles:
                        particles = found[1]
            seconds += last
    return [particles, str(steps), f"{seconds:.4g}"]


def lines(path):
    try:
        with open(path, encoding="utf-8") as file:
            return file.read().splitlines()
    except OSError:
        return []


def gather(folder, tutorial, variant, tier):
    """Rows of summary.csv, with the reasons of the tolerances"""
    state = os.path.join(folder, ".state", tutorial, variant)
    case = os.path.join(folder, tutorial, "" if variant == "study" else variant)
    name = tutorial.split("/")[-1] + "/" + variant
    paid = ["", "", ""] if variant == "study" else cost(case)
    rows = []
    complaint = lines(os.path.join(state, "complaints"))
    if complaint or not os.path.exists(os.path.join(state, "complaints")):
        reason = f"{complaint[0]} (all of it: {state}/complaints)" if complaint else "it was not run"
        rows.append(([name, "the run", "", "nan", "", "", "", "FAIL", tier] + paid, reason))
    for summary in compared(case, variant, "summary.csv"):
        with open(summary, newline="", encoding="utf-8") as file:
            text = file.read()
            ends = text.endswith("\n")  # in the last column nothing else shows it
            for row in csv.DictReader(io.StringIO(text)):
                if None in row.values() or not ends:
                    rows.append(([name, "the run", "", "nan", "", "", "", "FAIL", tier] + paid, f"{summary} is cut off"))
                    break
                kept = [row[k] for k in COLUMNS[1:8]]
                rows.append(([name] + kept + [row.get("tier") or tier] + paid, row["reason"]))
    if not rows and variant != "study":
        rows.append(([name, "the run", "", "nan", "", "", "", "FAIL", tier] + paid, "nothing was compared"))
    return rows


def compared(case, variant, ending):
    """Files of the comparison, also of an Allrun that makes folders of its own; a study's are above those of the runs"""
    return sorted(path for path in glob.glob(os.path.join(case, "comparison" if variant == "study" else "**/comparison",
                                                          "*" + ending), recursive=True) if ".old/" not in path)


def families(gathered):
    """Per tutorial its variants that were run, (name, rows), and the quantities that show their errors: those that
    several of them have, of many the ones that come closest to their tolerances"""
    found = {}
    for (tutorial, variant, _), rows in gathered:
        if variant != "study" and rows and rows[0][0][9]:
            found.setdefault(tutorial, []).append((variant, [row for row, _ in rows]))
    for tutorial, variants in found.items():
        judged = [row for _, rows in variants for row in rows if row[5] not in ("", "nan")]
        names = [row[1] for row in judged]
        close = {}  # largest error over tolerance
        for row in judged:
            if row[6] not in ("", "0"):
                close[row[1]] = max(close.get(row[1], 0.0), abs(float(row[5])) / float(row[6]))
        several = [q for q in close if names.count(q) > 1 or len(variants) == 1]
        closest = sorted(several, key=close.get, reverse=True)[:COLUMNS_SHOWN]
        if closest:
            yield tutorial.split("/")[-1], sorted(variants, key=lambda v: float(v[1][0][11] or 0)), closest


def rounded(number):
    return f"{float(number):.3g}" if number else ""


def withUnit(quantity, variants):
    """The errors of what would be 0 are absolute; the others are relative"""
    units = {row[4] for _, rows in variants for row in rows if row[1] == quantity and row[4] and row[2] == "0"}
    return quantity + (f" [{units.pop()}]" if units else "")


def costs(gathered):
    """For each tutorial particles and CPU time of its runs, the cheapest first, beside their errors"""
    text = ["", "# Errors and costs", "",
            "CPU time is that of this machine, of all threads of a run together. Runs that are told only are in the tables and "
            "pictures of the studies."]
    for tutorial, variants, quantities in families(gathered):
        text += ["", f"**{tutorial}**", "",
                 "| variant | particles | steps | CPU [s] | " + " | ".join(withUnit(q, variants) for q in quantities) + " |",
                 "|---" * (4 + len(quantities)) + "|"]
        for variant, rows in variants:
            errors = {row[1]: rounded(row[5]) + ("" if row[7] == "pass" else " FAIL") for row in rows if row[7] != "told"}
            if any(q in errors for q in quantities):
                text.append(f"| {variant} | " + " | ".join(rows[0][9:12] + [errors.get(q, "") for q in quantities]) + " |")
    return text


def expectations(gathered):
    """One page: of each tutorial the errors closest to their tolerances, and what they cost"""
    text = ["", "# What to expect", "",
            "Each family of cases has two lines: the errors that are the hardest to keep within their tolerances. The cheapest run comes "
            f"first: *variant* error (particles, CPU seconds on this machine). A family with more than {RUNS_SHOWN} runs shows those that no "
            "cheaper run equals within a tenth, and behind a semicolon the run with the largest error. All runs: the tables before.", "",
            "| family | error | by resolution and cost |", "|---|---|---|"]
    shown = lambda error, variant, row: f"*{variant}* {error:.2g} ({row[9]}, {rounded(row[11])} s)"
    for tutorial, variants, quantities in families(gathered):
        for quantity in quantities[:2]:
            points = [(abs(float(row[5])), variant, row) for variant, rows in variants for row in rows
                      if row[1] == quantity and row[7] in ("pass", "FAIL") and row[5] not in ("", "nan")
                      and row[6] not in ("", "0")]
            front = []
            for point in points:
                if len(points) <= RUNS_SHOWN or not front or point[0] < 0.9 * front[-1][0]:
                    front.append(point)
            line = ", ".join(shown(*point) for point in front)
            if len(front) < len(points):
                line += "; " + shown(*max(points, key=lambda point: point[0]))
            text.append(f"| {tutorial} | {withUnit(quantity, variants)} | {line} |")
    return text


def pictures(folder, tutorial, variant):
    case = os.path.join(folder, tutorial, "" if variant == "study" else variant)
    return [os.path.relpath(path, folder) for path in compared(case, variant, ".png")]


def tables(folder, tutorial):
    """The tables of a study, beside its summary"""
    text = []
    for path in compared(os.path.join(folder, tutorial), "study", ".csv"):
        if os.path.basename(path) == "summary.csv":
            continue
        with open(path, newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        text += ["", f"`{os.path.relpath(path, folder)}`", "", "| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
        text += ["| " + " | ".join(row) + " |" for row in rows]
    return text


def main(folder, root):
    plan = [line.split(None, 3)[:3] for line in sys.stdin if line.strip()]
    order = []
    for tutorial, variant, tier in plan:
        order.append((tutorial, variant, tier))
    for tutorial in dict.fromkeys(t for t, _, _ in plan):
        if os.path.exists(os.path.join(folder, ".state", tutorial, "study")):
            order.append((tutorial, "study", lines(os.path.join(folder, ".state", tutorial, "study", "tier"))[0]))
    order.sort(key=lambda o: o[0])
    gathered = [(o, gather(folder, *o)) for o in order]
    rows = [row for _, found in gathered for row, _ in found]
    failed = sum(row[7] == "FAIL" for row in rows)

    with open(os.path.join(folder, "summary.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)

    text = ["# Validation", "",
            f"{len(rows)} quantities of {len(plan)} runs, {failed} FAIL. `summary.csv` has them in one table.", ""]
    tutorial = None
    for (this, variant, tier), found in gathered:
        if variant == "study" and not found and not pictures(folder, this, variant):
            continue  # too few variants
        if this != tutorial:
            tutorial = this
            title = lines(os.path.join(root, "tutorials", tutorial, "README.md"))
            text += ["", "## " + (title[0].lstrip("# ") if title else tutorial), ""]
        text += ["", f"### {variant} ({tier})", "",
                 "| quantity | reference | ours | unit | error | tolerance | status | reason of the tolerance |",
                 "|---|---|---|---|---|---|---|---|"]
        text += ["| " + " | ".join(row[1:8] + [reason]) + " |" for row, reason in found]
        if found and found[0][0][9]:
            text += ["", "{} particles, {} steps, {} s of CPU time.".format(*found[0][0][9:])]
        if variant == "study":
            text += tables(folder, tutorial)
        text += [""] + [f"![{variant}]({picture})" for picture in pictures(folder, tutorial, variant)]
    text += costs(gathered) + expectations(gathered)
    with open(os.path.join(folder, "report.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(text) + "\n")

    for row in rows:
        print(f"{row[0]:<40} {row[1]:<44} {row[3]:>12} {row[4]:<8} error {row[5]:>10} of {row[6]:>8}  {row[7]}")
    print(f"{len(rows)} quantities of {len(plan)} runs, {failed} FAIL: {folder}/report.md")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
