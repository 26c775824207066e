# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Commands of a script: their words, and where they stand."""
import copy
import re

from .errors import Left

MAKERS = ("fix", "compute", "variable", "dump")
KINDS = {name[0]: name for name in MAKERS}
ENDERS = {"unfix": "f", "fix_modify": "f", "uncompute": "c", "compute_modify": "c", "undump": "d", "dump_modify": "d"}


def is_yes(values, key, default):
    """The value of a word that takes yes or no."""
    value = values.get(key, [default])[0]
    if value not in ("yes", "no"):
        raise Left(f"{key} {value}", "yes or no in its place")
    return value == "yes"


def last_value(words, key):
    """The word behind the last one that is `key`, which counts in LIGGGHTS; None where there is none."""
    places = [k for k, x in enumerate(words) if x == key]
    return words[places[-1] + 1] if places else None


def needed_by(words):
    """Returns the fixes, computes, variables and dumps that a command needs: f_ID, c_ID, v_ID and d_ID."""
    needed = {m[0] or f"v_{m[1] or m[2]}" for m in re.findall(r"\b([fcv]_\w+)|\$\{(\w+)\}|\$([a-zA-Z])", " ".join(words))}
    return needed | {f"{ENDERS[words[0]]}_{words[1]}"} if words[0] in ENDERS and len(words) > 1 else needed


class Line:
    """A command, and what holds at it: its place in the whole program, the variables, the parts that a jump may skip, the loops
    around it, and the number of clear commands before it."""

    def __init__(self, number, text, file):
        self.number, self.text, self.file = number, text, file
        self.words = words_of(text)
        self.index, self.scope, self.skips, self.loops, self.stage = 0, {}, frozenset(), [], 0
        self.included = False    # of include: its lines follow

    def but(self, text):
        """The same command with another text."""
        other = copy.copy(self)
        other.text, other.words = text, words_of(text)
        return other


def words_of(text):
    """Words of a command, without its comment; quoted ones and $(...) in one piece."""
    found = re.findall(r'"[^"]*"|\'[^\']*\'|#.*|(?:\$\((?:[^()]|\([^()]*\))*\)|[^\s#"\'])+', text.replace("&\n", " "))
    return [w for w in found if not w.startswith("#")]


def nested(w):
    """The commands in the words of if and run."""
    if w[0] == "run":
        return [x for x in w[1:] if x[0] in "\"'" and " " in x]
    if w[0] == "if":
        return [x for k, x in enumerate(w) if k > 2 and x not in ("then", "elif", "else") and w[k - 1] != "elif"]
    return []


def unquoted(x):
    """A word of if or run without its quotes."""
    return x[1:-1] if x[:1] in ("\"", "'") and x[-1:] == x[0] else x


def commands_in(w):
    """Words of a command and of the commands in it."""
    return [w] + [inner for inner in (words_of(unquoted(x)) for x in nested(w)) if inner]


def read_lines(path):
    lines, begun, first = [], "", 1
    # Bytes that are no UTF-8, as in comments in Latin-1, are kept as they are.
    for number, text in enumerate(path.read_text(encoding="utf-8", errors="surrogateescape").split("\n"), 1):
        first = first if begun else number
        begun += text
        # A line goes on where it ends with &, also before a comment.
        if re.search(r"&\s*(#.*)?$", text):
            begun = re.sub(r"&\s*(#.*)?$", "&\n", begun)
            continue
        lines.append(Line(first, begun, path.name))
        begun = ""
    if lines and not lines[-1].text and not begun:
        lines.pop()    # the end of the last line
    return lines + ([Line(first, begun, path.name)] if begun else [])
