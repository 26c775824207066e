# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Forms of commands: the words that a command may have. A line is converted only where a form reads each of its words.

A form is a text: `bin|nsq` is one of two words, NUMBER a word of that kind, NAMES a number and as many names, `X?`, `X*` and `X+` are at most one, any number, and at
least one X, `( ... )` is a group for these, and `[word ...] [word ...]` at the end are options, which stand in any order. A command
has one form or a list of them. A word with a variable that is not known is any kind, but no word of a form.
"""
import functools
import re

from .errors import Left

SIGNED = r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?"
KINDS_OF_WORDS = {kind: re.compile(rf"(?:{text})\Z", re.S) for kind, text in {
    "NUMBER": SIGNED, "COUNT": r"[-+]?\d+", "VALUE": rf"{SIGNED}|v_\w+", "OR_NULL": rf"{SIGNED}|v_\w+|NULL", "EDGE": rf"{SIGNED}|INF|-INF|EDGE",
    "NAME": r"[\w./*:-]+", "FILE": r"\S+", "TEXT": r".*", "YES": "yes|no", "VARIABLE": r"v_\w+", "OUTPUT": r"[fcv]_\w+(\[\d+\]){0,2}",
    "TYPES": r"\d*\*?\d*", "GRID": r"\*|\d+", "SIDES": "[pfsm]{1,2}", "MAPPING": "cart|cart/reorder|xyz|xzy|yxz|yzx|zxy|zyx", "DIMENSIONS": r"(?!.*(.).*\1)[xyz]{1,3}", "RANGE": r"\d+(:\d+){0,2}",
}.items()}


def tokens_of(form):
    return re.findall(r"[()\[\]]|[?*+](?=\s|$|[)\]])|[^\s()\[\]]+?(?=[?*+](?:\s|$|[)\]])|[\s()\[\]]|$)", form)


@functools.lru_cache(maxsize=None)
def parsed(form):
    """A form as a list of parts and a list of options. A part is (words or parts, least number, most)."""
    tokens = tokens_of(form)

    def sequence(end):
        parts, options = [], []
        while tokens and tokens[0] != end:
            token = tokens.pop(0)
            if token == "[":
                options.append(sequence("]")[0])
                tokens.pop(0)
                continue
            part = token.split("|")
            if token == "(":
                part = sequence(")")
                tokens.pop(0)
            sign = tokens.pop(0) if tokens[:1] in (["?"], ["*"], ["+"]) else ""
            parts.append((part, int(sign in ("", "+")), 1 if sign in ("", "?") else 10**9))
        return parts, options

    return sequence(None)


def is_of(part, word):
    return any("$" in word or KINDS_OF_WORDS[x].match(word) if x in KINDS_OF_WORDS else x == word for x in part)


class Reader:
    """Reads words by a form. `end` is the first word that it could not read."""

    def __init__(self, words):
        self.words, self.end = words, 0

    def ends(self, parts, at):
        """The places to which parts can read from a place, the longest first."""
        if not parts:
            yield at
            return
        (part, least, most), rest = parts[0], parts[1:]
        places, reached = [at], [at] if least == 0 else []
        while places and most:
            most -= 1
            places = [end for place in places for end in self.once(part, place) if end > place]
            reached = places + reached if places else reached
        for place in reached:
            yield from self.ends(rest, place)

    def once(self, part, at):
        if isinstance(part, tuple):
            yield from self.whole(part, at)
        elif part == ["NAMES"]:
            yield from self.names(at)
        elif at < len(self.words) and is_of(part, self.words[at]):
            self.end = max(self.end, at + 1)
            yield at + 1

    def names(self, at):
        """As many names as a number says, or any number of them where it is not known."""
        count = self.words[at] if at < len(self.words) else ""
        if count.isdigit() and at + int(count) < len(self.words):
            self.end = max(self.end, at + 1 + int(count))
            yield at + 1 + int(count)
        elif "$" in count:
            yield from self.ends(parsed("TEXT NAME+")[0], at)

    def whole(self, form, at):
        """The places to which a form with its options can read."""
        parts, options = form
        for place in self.ends(parts, at):
            yield from self.with_options(options, place)

    def with_options(self, options, at):
        for option in options:
            for end in self.ends(option, at):
                yield from self.with_options(options, end)
        yield at


def first_unread(forms, words):
    """The place of the first word that no form reads; the number of words where they are too few; None where all are read."""
    furthest = 0
    for form in [forms] if isinstance(forms, str) else forms:
        reader = Reader(words)
        if any(end == len(words) for end in reader.whole(parsed(form), 0)):
            return None
        furthest = max(furthest, reader.end)
    return furthest


def read(name, forms, words):
    """Raises Left where no form reads all words of a command."""
    place = first_unread(forms, words)
    if place is None:
        return
    if place == len(words):
        raise Left(f"{name} with too few words", "the words that it has in the manual of LIGGGHTS")
    raise Left(f"the word {words[place]} of {name}", "a word that both programs have; give the value of a variable in it with --var NAME VALUE"
               if "$" in words[place] else "the line without it, or with what LAMMPS has in its place")


def pairs(words, known, of=""):
    """(word, its values) of the words of a command. `known` has the form, or the forms, of the values of each word, or why it is Left. A
    word that is not known ends the command: no word is ever looked for where an ID may stand."""
    words = list(words)
    while words:
        key = words.pop(0)
        if key not in known:
            raise Left(f"the keyword {key}{of}", "doc/from-liggghts.md has what you must decide, doc/fix_wall_lsdcd.rst all keywords; or write the line without it, if it does not matter")
        forms = known[key]
        if isinstance(forms, Left):
            raise forms
        ends = [end for form in ([forms] if isinstance(forms, str) else forms) for end in Reader(words).whole(parsed(form), 0)]
        if not ends:
            if not words:
                raise ValueError(key)
            raise Left(f"the word {words[0]} after {key}", "the values that the manual of LIGGGHTS names")
        yield key, words[:max(ends)]
        del words[:max(ends)]


def options(words, known, one_of=()):
    """{word: its values} in the order of the words, where each counts once: the last one. Of a group in `one_of`, whose words set the
    same number, the last one counts."""
    found = {}
    for key, values in pairs(words, known):
        for other in next((group for group in one_of if key in group), (key,)):
            found.pop(other, None)
        found[key] = values
    return found
