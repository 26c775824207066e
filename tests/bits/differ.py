# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What two folders of output differ in: each quantity with the number of its values that differ and the
largest absolute and relative difference. Files are compared byte by byte; only those that differ are
looked into, as dumps (columns by name), thermo tables, other text, or binary files.
"""

import base64
import collections
import difflib
import itertools
import math
import pathlib
import re
import struct

# What depends on time or place and not on what was computed, and why. Each is (name, pattern, in its place, reason),
# None for a line that is left out;
# of the output of LAMMPS, line by line. Of files that scripts write only a grid cache
# has the like (mask_file).
MASKS = [(name, re.compile(pattern), instead, reason) for name, pattern, instead, reason in (
    ("memory", r"^Per MPI rank memory allocation .*", "Per MPI rank memory allocation", "bytes of the program, not an answer"),
    ("loop time", r"^Loop time of \S+ on", "Loop time of TIME on", "a duration"),
    ("performance", r"^(Performance:|[\d.]+% CPU use with ).*", "RATE", "a rate of the clock"),
    ("breakdown", r"^(Pair|Bond|Kspace|Neigh|Comm|Output|Modify|Rest|Other|Fix|Move|Rigid) *\|.*", r"\1 | TIME",
     "durations of the parts of a step"),
    ("breakdown of the wall", r"^  (Choice|Forces|Waiting|Grids|Files) *\|.*", r"  \1 | TIME",
     "durations of the parts of a step"),
    ("share of the loop", r"(breakdown of the wall), \S+ % of the loop time", r"\1, SHARE of the loop time",
     "durations"),
    ("cpu", r"\b(\w+) CPU = [\d.e+-]+ sec(ond)?s?", r"\1 CPU = TIME", "a duration"),
    ("wall time", r"^Total wall time: .*", "Total wall time: TIME", "a duration"),
    ("bytes of a grid", r"\b[\d.]+ (kB|MB)(?=, built in)", "BYTES", "memory of the program, not an answer"),
    ("grid built", r"built in [\d.]+ s\b", "built in TIME", "a duration"),
    ("cache", r"\bin \d+\.\d{3} s\b", "in TIME", "a duration"),
    ("source", r"\(\S*?([\w.]+\.(?:cpp|cu|h)):\d+\)", "(SOURCE)",
     "file and line that an error or a warning was raised in: moved code changes it"),
    ("version of the wall", r"^(Loaded .*lsdcd.*|.*lsdcdplugin.*|.*lsdcdkkplugin.*)$", "PLUGIN",
     "place and version of the plugin"),
    ("processes", r"\[[\w.-]+:\d+\]", "[PROCESS]", "name of the machine and number of the process"),
    ("version", r"^  version     \S+$", None, "the release"),
    ("wall/gran", r"^Fix \S+ wall/lsdcd: fix wall/gran of this LAMMPS gives other forces", None, "a fact of the LAMMPS that runs"),
    ("part of a file", r"\.part-[\w-]+", ".part-N", "a name that is made from the clock"),
)]
# Where a run stops, MPI's words and how much of its output comes through depend on time.
STOPPED = re.compile(r"^(ERROR.*|Last command.*)$", re.M)

Difference = collections.namedtuple("Difference", "quantity values absolute relative note")


def mask(text, folder=None, build=None):
    """Output of LAMMPS without what depends on time or place: that of the run, that of the program."""
    for path, name in ((folder, "FOLDER"), (build, "BUILD")):
        if path:
            text = text.replace(str(path), name)
    lines = []
    for line in text.split("\n"):
        if any(instead is None and pattern.search(line) for _, pattern, instead, _ in MASKS):
            continue
        for _, pattern, instead, _ in MASKS:
            line = pattern.sub(instead or "", line)
        lines.append(line)
    return "\n".join(lines)


class Sizes:
    """Of differences, by quantity."""

    def __init__(self):
        self.of = {}

    def add(self, quantity, a, b, note=""):
        """Two numbers, or two pieces of text."""
        count, absolute, relative, first = self.of.get(quantity, (0, 0.0, 0.0, ""))
        if isinstance(a, str):
            absolute = relative = math.inf
            first = first or f"'{a.strip()[:60]}' is now '{b.strip()[:60]}'"
        else:
            apart = abs(a - b)
            size = max(abs(a), abs(b))
            if not math.isfinite(apart):
                apart = math.inf
            absolute = max(absolute, apart)
            relative = max(relative, apart / size if 0 < size < math.inf else math.inf)
        self.of[quantity] = (count + 1, absolute, relative, first or note)

    def all(self):
        return [Difference(quantity, *of) for quantity, of in self.of.items()]


def number(word):
    """Of a word, or None. LAMMPS's integers are exact in double."""
    try:
        return float(word)
    except ValueError:
        return None


def text_quantities(lines):
    """For each line its name of quantities: columns of a dump or of a thermo table, else None."""
    columns, prefix = None, ""
    for line in lines:
        if line.startswith("ITEM:"):
            words = line.split()
            columns, prefix = (words[2:], "") if words[1] in ("ATOMS", "ENTRIES") else (None, "")
            yield None
        elif re.match(r"^\s*Step\b", line):
            columns, prefix = line.split(), "thermo "
            yield None
        else:
            words = line.split()
            if columns and len(words) == len(columns) and number(words[0]) is not None:
                yield [prefix + c for c in columns]
            else:
                if prefix:
                    columns = None
                yield None


def is_row(line):
    words = line.split()
    return bool(words) and all(number(w) is not None for w in words)


ARRAY = re.compile(r'<DataArray type="(Float64|Int64|Int32)" Name="(\w+)"[^>]*>([^<]+)<')
FORMATS = {"Float64": "d", "Int64": "q", "Int32": "i"}


def compare_arrays(name, a, b, sizes):
    """Numbers in VTK's XML are base64 of a length and of binary data; the text without them."""
    ours = {array: text for _, array, text in ARRAY.findall(b)}
    for kind, array, text in ARRAY.findall(a):
        other = ours.get(array, text)
        if text == other:
            continue
        u, v = ([each[0] for each in struct.iter_unpack("<" + FORMATS[kind], base64.b64decode(words)[8:])]
                for words in (text, other))
        if len(u) != len(v):
            sizes.add(f"{name}: {array}, length", float(len(u)), float(len(v)))
        for p, q in zip(u, v):
            if struct.pack("<d", p) != struct.pack("<d", q):
                sizes.add(f"{name}: {array}", float(p), float(q))
    return tuple(re.sub(ARRAY, r'<DataArray type="\1" Name="\2">NUMBERS<', text) for text in (a, b))


def compare_text(name, a, b, sizes):
    if a.startswith("<?xml") and "<DataArray" in a:
        before = len(sizes.of)
        a, b = compare_arrays(name, a, b, sizes)
        if a == b and len(sizes.of) > before:
            return
    one, two = a.split("\n"), b.split("\n")
    if len(one) != len(two):
        # Lines that came or went, then rows of numbers by themselves where these are as many.
        words, others = ([line for line in lines if not is_row(line)] for lines in (one, two))
        steps = difflib.SequenceMatcher(None, words, others, autojunk=False).get_opcodes()
        changed = [(words[i:j], others[k:n]) for what, i, j, k, n in steps if what != "equal"]
        for gone, come in changed:
            for u, v in itertools.zip_longest(gone, come, fillvalue="(nothing)"):
                sizes.add(f"{name}: lines", u, v)
        rows, others = ([line for line in lines if is_row(line)] for lines in (one, two))
        if len(rows) != len(others):
            sizes.add(f"{name}: rows of numbers", float(len(rows)), float(len(others)))
            return
        one, two = ([line for line in lines if is_row(line) or re.match(r"^\s*Step\b|^ITEM:", line)]
                    for lines in (one, two))
        if len(one) != len(two):
            one, two = rows, others
    before = len(sizes.of)
    for line, other, columns in zip(one, two, text_quantities(one)):
        if line == other:
            continue
        words, others = line.split(), other.split()
        if len(words) != len(others):
            sizes.add(f"{name}: text", line, other)
            continue
        for k, (u, v) in enumerate(zip(words, others)):
            if u == v:
                continue
            what = columns[k] if columns else None
            p, q = number(u), number(v)
            if p is None or q is None:
                sizes.add(f"{name}: {what or 'text'}", line if columns is None else u, other if columns is None else v)
            elif not (p == q or (math.isnan(p) and math.isnan(q))):
                sizes.add(f"{name}: {what or 'numbers'}", p, q, "" if what else line.strip()[:60])
            else:
                sizes.add(f"{name}: {what or 'numbers'}, as it is written", u, v)
    if len(sizes.of) == before:
        sizes.add(f"{name}: blanks", a[:0], b[:0])


def sane(x):
    return x == 0 or 1e-40 < abs(x) < 1e40


def compare_binary(name, a, b, sizes):
    """Numbers in a binary file lie at any place: of the doubles over a byte that differs those are
    taken which are least apart."""
    if len(a) != len(b):
        sizes.add(f"{name}: length in bytes", float(len(a)), float(len(b)))
        return
    at, end = 0, len(a)
    step = 1 << 12
    while at < end:
        if a[at:at + step] == b[at:at + step]:
            at += step
            continue
        first = next(i for i in range(at, min(at + step, end)) if a[i] != b[i])
        best = None
        for start in range(max(0, first - 7), min(first, end - 8) + 1):
            p, q = struct.unpack_from("<d", a, start)[0], struct.unpack_from("<d", b, start)[0]
            if sane(p) and sane(q) and p != q:
                apart = abs(p - q) / max(abs(p), abs(q))
                if best is None or apart < best[0]:
                    best = (apart, p, q, start)
        if best and best[0] < 0.5:
            sizes.add(f"{name}: numbers", best[1], best[2], f"first at byte {first}")
            at = max(first + 1, best[3] + 8)
        else:
            sizes.add(f"{name}: bytes", float(a[first]), float(b[first]), f"first at byte {first}")
            at = first + 1


def compare_bytes(name, a, b, sizes):
    """The contents of one file."""
    if a == b:
        return
    if b"\0" not in a and b"\0" not in b:
        try:
            return compare_text(name, a.decode(), b.decode(), sizes)
        except UnicodeDecodeError:
            pass
    compare_binary(name, a, b, sizes)


def mask_file(data):
    """A grid cache without its header, which has the seconds that the grid took, and a sum over these."""
    if data.startswith(b"LSDCD grid cache") and len(data) > 32:
        return data[:24] + data[struct.unpack_from("<Q", data, 24)[0]:]
    return data


def read_folder(folder):
    """{name: bytes} of all files under a folder, without what depends on time."""
    folder = pathlib.Path(folder)
    return {str(path.relative_to(folder)): mask_file(path.read_bytes()) for path in sorted(folder.rglob("*"))
            if path.is_file()}


def compare(a, b):
    """Differences of two {name: bytes}. A file that only one of them has is a difference."""
    sizes = Sizes()
    for name in sorted(a.keys() | b.keys()):
        if name not in b:
            sizes.add(f"{name}: file", "there", "missing")
        elif name not in a:
            sizes.add(f"{name}: file", "missing", "there")
        else:
            compare_bytes(name, a[name], b[name], sizes)
    return sizes.all()
