# SPDX-License-Identifier: GPL-3.0-or-later
"""States of writeFormat ascii, and what system/transformation does to them"""
import math
import os
import random
import re
import sys
from validation import entry, number, vector

SHUFFLE = 12345


class Transformation:
    """x' = R M x + drift (t - t0), u' = R M u + drift"""

    def __init__(self, case="."):
        file = os.path.join(case, "system/transformation")
        on = lambda key: entry(file, key) in ("yes", "on", "true")
        angle = math.radians(number(file, "angle"))
        flip = -1.0 if on("mirror") else 1.0
        self.R = [[flip * math.cos(angle), -math.sin(angle), 0.0], [flip * math.sin(angle), math.cos(angle), 0.0], [0.0, 0.0, 1.0]]
        self.drift = vector(file, "drift")
        self.shuffle, self.quarter, self.threads = on("shuffle"), on("quarter"), int(number(file, "threads"))
        self.turns = angle != 0 or flip < 0

    def isNone(self):
        return not (self.turns or self.shuffle or self.quarter or any(self.drift))

    def apply(self, v):
        return [sum(self.R[i][k] * v[k] for k in range(3)) for i in range(3)]

    def undo(self, v):
        return [sum(self.R[k][i] * v[k] for k in range(3)) for i in range(3)]


def times(case):
    """Times of the written states, in their order, without the start"""
    return sorted((t for t in os.listdir(case) if re.fullmatch(r"[\d.eE+-]+", t) and float(t) > 0
                   and os.path.exists(f"{case}/{t}/positions")), key=float)


def read(path):
    """Header and rows of a field, each a list of numbers as they are written"""
    if not os.path.exists(path):
        sys.exit(f"there is no {path}: writeFormat in system/controlDict must be ascii")
    with open(path, encoding="utf-8", errors="replace") as file:
        found = re.match(r"(.*?List<\w+>\s*)(\d+)\s*\n\((.*)\)\s*;\s*$", file.read(), re.S)
    lines = found[3].strip().splitlines() if found else []
    if not found or len(lines) != int(found[2]):
        sys.exit(f"{path} is cut off, or no list as text: remove its time folder and run again; writeFormat ascii is wanted")
    return found[1], [line.strip("() ").split() for line in lines]


def field(case, time, name):
    return [[float(v) for v in row] for row in read(f"{case}/{time}/{name}")[1]]


def byId(case, time):
    """{id: (x, u, p)}"""
    ids = [int(row[0]) for row in field(case, time, "id")]
    columns = (field(case, time, "positions"), field(case, time, "U"), field(case, time, "p"))
    return dict(zip(ids, zip(*columns)))


def cells(v):
    """A difference of positions, whole periods taken out"""
    return [x - round(x) if math.isfinite(x) else math.nan for x in v]


def order(case, time, how):
    """Rows in the order in which the transformed case has them: solids stay first"""
    count = len(field(case, time, "id"))
    rows = list(range(count))
    if how.quarter:
        x = field(case, time, "positions")
        rows = [i for i in rows if x[i][0] < 0.5 and x[i][1] < 0.5]
    if how.shuffle:
        zones = [row[0] for row in field(case, time, "zone")]
        draw = random.Random(SHUFFLE)
        blocks = {}
        for i in rows:
            blocks.setdefault(zones[i], []).append(i)
        for block in blocks.values():
            draw.shuffle(block)
        rows = [i for zone in dict.fromkeys(zones[i] for i in rows) for i in blocks[zone]]
    return rows
