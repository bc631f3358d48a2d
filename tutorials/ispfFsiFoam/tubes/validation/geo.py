# SPDX-License-Identifier: GPL-3.0-or-later
"""The lengths that a script of gmsh names: R0 L0 R1 L1 R2 L2 Rb, and angle"""
import ast
import math
import operator
import re
import sys

OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}


def value(node, known):
    """Value of sums, products and quotients of numbers and known names; KeyError of anything else"""
    if isinstance(node, ast.BinOp):
        return OPERATORS[type(node.op)](value(node.left, known), value(node.right, known))
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -value(node.operand, known)
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return float(node.value)
    return known[node.id if isinstance(node, ast.Name) else None]


class lengths(dict):
    """SystemExit where one is not known"""

    def __init__(self, file):
        super().__init__(Pi=math.pi)
        self.file = file
        with open(file, encoding="utf-8") as script:
            text = re.sub(r"//.*|/\*[\s\S]*?\*/", "", script.read())
        for name, formula in re.findall(r"(?<!\w)([A-Za-z_]\w*)\s*=\s*([^=;{}]+);", text):
            wanted = re.fullmatch(r"[RL]\d|Rb|angle", name)
            if wanted and name in self:
                sys.exit(f"{file} sets {name} twice: which of them the tube has is not known here; set it once")
            try:
                self[name] = value(ast.parse(formula.strip(), mode="eval").body, self)
            except (KeyError, SyntaxError, ZeroDivisionError):
                if wanted:
                    sys.exit(f"{file}: '{name} = {formula};' is not read here: give a number, or sums, products and "
                             "quotients of names that are set before")

    def __missing__(self, name):
        if name is None or not re.fullmatch(r"[RL]\d|Rb|angle", name):
            raise KeyError(name)
        sys.exit(f"{self.file} sets no {name}, e.g. '{name} = 20;': the law wants it")
