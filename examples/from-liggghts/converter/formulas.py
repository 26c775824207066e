# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Values of variables and formulas."""
import math
import re

LEVELS = {level: k for k, levels in enumerate((["||"], ["&&"], ["==", "!="], ["<", "<=", ">", ">="], ["+", "-"], ["*", "/", "%"], ["^"]))
          for level in levels}
TWO = {"||": lambda a, b: a != 0 or b != 0, "&&": lambda a, b: a != 0 and b != 0, "==": lambda a, b: a == b, "!=": lambda a, b: a != b,
       "<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
       "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a / b, "%": math.fmod, "^": math.pow}
FUNCTIONS = {"sqrt": math.sqrt, "exp": math.exp, "ln": math.log, "log": math.log10, "abs": abs, "sin": math.sin, "cos": math.cos,
             "tan": math.tan, "asin": math.asin, "acos": math.acos, "atan": math.atan, "atan2": math.atan2, "ceil": math.ceil,
             "floor": math.floor, "round": lambda x: math.floor(x + 0.5)}
TOKEN = re.compile(r"\s*((?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[A-Za-z_]\w*|\|\||&&|[=!<>]=|[-+*/%^<>!(),])")
VARIABLE = re.compile(r"\$\{(\w+)\}|\$(\w)|\$\(((?:[^()]|\([^()]*\))*)\)")


def formula(text, variable):
    """The value of a formula of LAMMPS, where variable(NAME) is that of v_NAME: an operator takes what is left of it first, and a
    sign is stronger than ^. ValueError for what is known in a run only."""
    tokens, end = [], 0
    for found in TOKEN.finditer(text):
        if found.start() != end:
            break
        tokens.append(found[1])
        end = found.end()
    if text[end:].strip():
        raise ValueError(text)

    def take(expected=None):
        if not tokens or (expected and tokens[0] != expected):
            raise ValueError(text)
        return tokens.pop(0)

    def operand():
        token = take()
        if token == "(":
            value = terms(0)
            take(")")
        elif token in "-!":
            value = -operand() if token == "-" else float(operand() == 0)
        elif token[0].isdigit() or token[0] == ".":
            value = float(token)
        elif token.startswith("v_"):
            value = variable(token[2:])
        elif token in FUNCTIONS:
            take("(")
            values = [terms(0)]
            while tokens[:1] == [","]:
                take()
                values.append(terms(0))
            take(")")
            value = FUNCTIONS[token](*values)
        elif token == "PI":
            value = math.pi
        else:
            raise ValueError(text)
        return float(value)

    def terms(level):
        value = operand()
        while tokens and LEVELS.get(tokens[0], -1) >= level:
            token = take()
            value = float(TWO[token](value, terms(LEVELS[token] + 1)))
        return value

    try:
        value = terms(0)
    except (TypeError, ArithmeticError) as error:
        raise ValueError(text) from error
    if tokens:
        raise ValueError(text)
    return value


def number_of(name, scope, depth=0):
    """The value of v_NAME in a scope; ValueError where it is not known."""
    style, values = scope.get(name) or ("", [""])
    if depth > 50:
        raise ValueError(f"{name} is a formula of itself")
    return formula(values[0], lambda other: number_of(other, scope, depth + 1)) if style == "equal" else float(values[0])


def text_of(name, scope):
    """The text that stands for ${NAME}, or None."""
    if not scope.get(name):
        return None
    style, values = scope[name]
    try:
        return f"{number_of(name, scope):.15g}" if style == "equal" else values[0]
    except ValueError:
        return None


def expand(text, scope):
    """A text with the values of its variables that are known."""
    def new(m):
        if m[3] is None:
            value = text_of(m[1] or m[2], scope)
            return m[0] if value is None else value
        inner, _, form = m[3].partition(":%")
        try:
            value = formula(inner, lambda name: number_of(name, scope))
            return f"%{form}" % value if form else f"{value:.17g}"
        except (ValueError, TypeError):
            return m[0]
    return VARIABLE.sub(new, text)
