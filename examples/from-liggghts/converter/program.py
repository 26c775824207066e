# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A script as a program: its lines with those of include, its loops, jumps and variables."""
import collections
import re

from .formulas import expand
from .lines import commands_in, read_lines, words_of


class Program:
    """The lines of a script in the order in which they stand, those of include in place of it. Each line gets its scope: the style
    and values of each variable there, or None where a loop or an if may have changed it."""
    ONCE = {"index", "loop", "world", "universe", "uloop", "file", "atomfile"}    # a second definition has no effect

    def __init__(self, path, given):
        self.path, self.given = path, {name: ("index", [value]) for name, value in given}
        self.unread = False    # whether a file is named that was not read
        self.lines = self.with_includes(read_lines(path), 0)
        self.assigned = collections.Counter(name for line in self.lines for name in self.changed(line))
        for k, line in enumerate(self.lines):
            line.index = k
        self.loops, self.skips = self.jumps()
        for first, last in self.loops:
            for line in self.lines[first:last + 1]:
                line.loops.append((first, last))
        for skip in self.skips:
            for line in self.lines[skip[0]:skip[1] + 1]:
                line.skips |= {skip}
        self.give_scopes()

    def with_includes(self, lines, depth):
        found = []
        for line in lines:
            found.append(line)
            if line.words[:1] != ["include"] or len(line.words) < 2:
                self.unread = self.unread or self.reads_more(line) or any(
                    w[0] == "jump" and w[1:2] not in (["SELF"], [self.path.name]) for w in commands_in(line.words or [""]))
                continue
            # The name may be a variable that has one value.
            single = {name: values for name, values in self.given.items()}
            for w in (other.words for other in found):
                if w[:1] == ["variable"] and w[2:3] in (["index"], ["string"]) and len(w) == 4 and w[1] not in self.given:
                    single[w[1]] = None if w[1] in single else (w[2], [w[3].strip("\"'")])
            path = self.path.parent / expand(line.words[1], single)
            inner = read_lines(path) if path.is_file() and depth < 9 else []
            if inner and not any(c[0] in ("jump", "label") for other in inner for c in commands_in(other.words or [""])):
                line.included = True
                found += self.with_includes(inner, depth + 1)
            else:
                self.unread = True
        return found

    @staticmethod
    def reads_more(line):
        """Whether a command includes a file that was not read."""
        return not line.included and any(w[0] == "include" for w in commands_in(line.words or [""]))

    @staticmethod
    def changed(line):
        """Names of the variables that a command may give a value."""
        names = []
        for w in commands_in(line.words or [""]):
            names += w[1:2] if w[0] == "variable" else w[1:] if w[0] == "next" else []
        return names

    def jumps(self):
        """First and last lines of loops, and of what jumps may skip."""
        labels, loops, skips = {}, [], []
        for line in self.lines:
            if line.words[:1] == ["label"] and len(line.words) > 1:
                labels.setdefault(line.words[1], line.index)
        for line in self.lines:
            for w in commands_in(line.words or [""]):
                if w[0] != "jump" or w[1:2] not in (["SELF"], [self.path.name]):
                    continue
                to = [0] if len(w) < 3 else list(labels.values()) if "$" in w[2] else [labels[w[2]]] if w[2] in labels else []
                loops += [(first, line.index) for first in to if first <= line.index]
                skips += [(line.index + 1, label - 1) for label in to if label > line.index + 1]
        return loops, skips

    def give_scopes(self):
        scope, stage = dict(self.given), 0
        for line in self.lines:
            for first, last in self.loops:
                if first == line.index:
                    scope = self.unknown(scope, [x for x in self.lines[first:last + 1] if x.words[:1] != ["variable"] or
                                                 x.words[2:3] not in [[style] for style in self.ONCE]])
            for first, last in self.skips:
                if last + 1 == line.index:
                    scope = self.unknown(scope, self.lines[first:last + 1])
            stage += line.words[:1] == ["clear"]
            line.scope, line.stage = scope, stage
            self.give_words(line)
            scope = self.after(line, scope)

    def unknown(self, scope, lines):
        """The scope where what these lines give variables is not known."""
        names = {name for line in lines for name in self.changed(line)}
        if any(map(self.reads_more, lines)):
            names |= set(scope)
        return {**scope, **dict.fromkeys(names - set(self.given))}

    @staticmethod
    def give_words(line):
        """Gives a line the words that its variables stand for, as in model ${m}. Numbers stay ${x}, as a user may change them."""
        def new(m):
            style, values = line.scope.get(m[1]) or ("", [])
            return values[0] if style in ("index", "string") and len(values) == 1 and not re.match(r"[-+.\d$]", values[0]) else m[0]

        text = re.sub(r"\$\{(\w+)\}", new, line.text)
        if text != line.text and line.words[:1] != ["variable"]:
            line.words = words_of(text)

    def after(self, line, scope):
        """The scope behind a line."""
        w = line.words
        if w[:1] == ["variable"] and len(w) > 2:
            name, style, *values = w[1:]
            if name in self.given or (style in self.ONCE and name in scope):
                return scope
            # What stands in quotes is not replaced.
            values = [x[1:-1] if x[0] in "\"'" else expand(x, scope) for x in values]
            if style == "delete":
                return {other: value for other, value in scope.items() if other != name}
            if style == "loop" and all(x.isdigit() for x in values) and values and int(values[-1]) < 100000:
                values = [str(k) for k in range(int(values[0]) if len(values) > 1 else 1, int(values[-1]) + 1)]
                style = "index"
            return {**scope, name: (style, values) if style in ("index", "string", "equal") and values else None}
        if w[:1] == ["next"]:
            scope = dict(scope)
            for name in (x for x in w[1:] if x in scope):
                style, values = scope.pop(name) or ("", [])
                if style != "index":
                    scope[name] = None
                elif len(values) > 1:
                    scope[name] = (style, values[1:])
            return scope
        return self.unknown(scope, [line]) if self.changed(line) or self.reads_more(line) else scope
