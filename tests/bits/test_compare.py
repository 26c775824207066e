#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The bit harness itself: a changed byte is found and sized, equal folders pass, a missing file is an error."""

import base64
import os
import pathlib
import re
import struct
import sys
import tempfile

CACHE = tempfile.TemporaryDirectory(prefix="bits-test-")
os.environ["XDG_CACHE_HOME"] = CACHE.name    # before programs.py reads it
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "lammps")]

import compare    # noqa: E402
import lmp    # noqa: E402
import differ    # noqa: E402
import laws    # noqa: E402
import recorder    # noqa: E402
import replay    # noqa: E402

DUMP = """\
ITEM: TIMESTEP
60
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS ff ff ff
-5 5
-5 5
-5 5
ITEM: ATOMS id x fx
1 0.5 2.0000000000000004
2 1.5 -4
"""
OUTPUT = """\
Step Atoms f_wall f_wall[3]
0 150 0 0.25
20 150 1.5 0.5
Loop time of 0.0123 on 1 procs for 60 steps with 150 atoms

Performance: 12345.6 tau/day, 98.7 timesteps/s
99.8% CPU use with 1 MPI tasks x no OpenMP threads
Pair    | 0.0012     | 0.0012     | 0.0012     |   0.0 |  1.62
Fix wall wall/lsdcd: timing breakdown of the wall, 19.64 % of the loop time:
  Forces  | 0.0012     | 0.0012     | 0.0012     |   0.0 |  1.62
grid 0.2 (chosen), 12.3 kB, built in 0.004 s with 100 distance tests at most on CPU
WARNING: Fix wall: a sphere sank (src/lammps/fix_wall_lsdcd_checks.cpp:73)
"""


def one(a, b, name="dump"):
    """{quantity: difference} of two contents."""
    return {d.quantity: d for d in differ.compare({name: a}, {name: b})}


def contents(checks):
    same = {"dump": DUMP.encode(), "stdout": OUTPUT.encode(), "restart": bytes(range(256))}
    checks.fact("equal folders pass", differ.compare(same, dict(same)) == [])

    found = one(DUMP.encode(), DUMP.replace("2.0000000000000004", "2").replace("-4", "-4.5").encode())
    d = found.get("dump: fx")
    checks.fact("a column of a dump: two values, the largest difference",
                len(found) == 1 and d.values == 2 and d.absolute == 0.5 and abs(d.relative - 0.5 / 4.5) < 1e-15, str(found))
    found = one(DUMP.encode(), DUMP.replace("2.0000000000000004", "2").encode())
    checks.fact("the last bit of a value", found["dump: fx"].absolute == 2 ** -51, str(found))
    checks.fact("-0 for 0, nan for nan and another spelling are listed",
                list(one(b"0 1.0", b"-0 1.00")) == ["dump: numbers, as it is written"] and
                one(b"0 1.0", b"-0 1.00")["dump: numbers, as it is written"].values == 2)
    found = one(OUTPUT.encode(), OUTPUT.replace("150 1.5 0.5", "150 1.5 0.75").encode(), "stdout")
    checks.fact("a column of the thermo output", list(found) == ["stdout: thermo f_wall[3]"] and
                found["stdout: thermo f_wall[3]"].absolute == 0.25, str(found))
    found = one(OUTPUT.encode(), OUTPUT.replace("150 1.5 0.5", "150 1.5 0.75\nWARNING: new").encode(), "stdout")
    checks.fact("a new line is listed, and numbers all the same",
                set(found) == {"stdout: lines", "stdout: thermo f_wall[3]"}, str(found))
    found = one(DUMP.encode(), DUMP.replace("2 1.5 -4\n", "").encode())
    checks.fact("an atom that is missing", "dump: rows of numbers" in found, str(found))

    numbers = [1.5, -2.25, 1e-3, 7.0]
    data = b"head\0" + struct.pack("<4d", *numbers)
    numbers[2] *= 1 + 1e-9
    found = one(data, b"head\0" + struct.pack("<4d", *numbers), "restart")
    d = found.get("restart: numbers")
    checks.fact("a number in a binary file is found and sized", d and d.values == 1 and 0.9e-9 < d.relative < 1.1e-9,
                str(found))
    checks.fact("any changed byte is found", all(one(data, data[:k] + bytes([data[k] ^ 1]) + data[k + 1:], "b")
                                                 for k in range(len(data))))
    def vtp(*values):
        text = base64.b64encode(struct.pack(f"<Q{len(values)}d", 8 * len(values), *values)).decode()
        return f'<?xml version="1.0"?>\n<DataArray type="Float64" Name="wear" format="binary">{text}</DataArray>\n'.encode()

    found = one(vtp(1.0, 2.0), vtp(1.0, 2.5), "vtp")
    checks.fact("a number in a VTK file", list(found) == ["vtp: wear"] and found["vtp: wear"].absolute == 0.5, str(found))
    found = one(data, data + b"\0", "restart")
    checks.fact("another length", found["restart: length in bytes"].absolute == 1, str(found))
    found = {d.quantity: d for d in differ.compare({"a": b"1", "b": b"2"}, {"a": b"1"})}
    checks.fact("a missing file is a difference", list(found) == ["b: file"] and found["b: file"].absolute > 1e300)


def masks(checks):
    later = OUTPUT.replace("0.0123", "0.0456").replace("12345.6", "9.9").replace("98.7", "1.1").replace(
        "99.8%", "12.5%").replace("19.64 %", "7.1 %").replace("0.0012", "0.0034").replace("0.004 s", "1.004 s").replace(
        "fix_wall_lsdcd_checks.cpp:73", "wall_checks.cpp:12")
    checks.fact("what depends on time, and lines of sources, are masked",
                differ.mask(OUTPUT) == differ.mask(later) and OUTPUT != later)
    smaller = OUTPUT.replace("12.3 kB", "1.2 MB")
    checks.fact("bytes of a grid are masked", differ.mask(OUTPUT) == differ.mask(smaller) and OUTPUT != smaller)
    released = OUTPUT.replace("\nLoop", "\n  version     0.9.0\nLoop")
    checks.fact("a line with the version is left out", differ.mask(OUTPUT) == differ.mask(released) and OUTPUT != released)
    cache = b"LSDCD grid cache" + struct.pack("<QQd", 2, 40, 0.125) + b"grid"
    checks.fact("a grid cache without its seconds", differ.mask_file(cache) == differ.mask_file(
        cache.replace(struct.pack("<d", 0.125), struct.pack("<d", 0.25))) != differ.mask_file(cache + b"!"))
    checks.fact("what was computed is not", differ.mask(OUTPUT) != differ.mask(later.replace("1.5", "1.6")))
    checks.fact("each mask has a name and a reason", all(name and reason for name, _, _, reason in differ.MASKS))


def scripts(checks, folder):
    text = "fix w all wall/lsdcd hooke 1 &\n NULL 1 NULL 0 1 mesh a.stl contacts\nrun 5\nunfix w\nrun 5\n"
    more = replay.added(text, {})
    checks.fact("each run is followed by a dump", more.count("write_dump all custom bits.") == 2)
    checks.fact("with the wall's numbers while there is a wall", more.count("f_w[8]") == 2, more)
    checks.fact("and the last one by a restart file", more.rstrip().endswith("write_restart bits.restart"), more)

    some = laws.scripts()
    names = [name for name, _, _ in some]
    checks.fact("names of the catalogue differ", len(set(names)) == len(names), str(len(names)))
    checks.fact("and tell files apart", all(replay.part_of(n + more, names) == n for n in names[::50]
                                            for more in (".dump", ".read.dump", "_60.vtp", ".restart")))
    # A sub-model that the source has and the catalogue lacks would not be guarded.
    source = (HERE.parent.parent / "src" / "law" / "sub_models.cpp").read_text()
    rows = re.findall(r'\{F::(\w+), "([\w/]+)",', source)
    word = {"style": "wall/lsdcd", "normal": "granular"}
    every = "\n".join(text for _, text, _ in some)
    missing = [f"{family} {name}" for family, name in rows if name != "none" and
               not re.search(rf"\b{word.get(family, family)} {re.escape(name)}\b", every)]
    checks.fact("the catalogue has every sub-model", len(rows) > 25 and not missing, str(missing))

    os.chdir(folder)
    (folder / "a.stl").write_text("solid a")
    (folder / "old.dump").write_text("not an input")
    record = folder / "records" / "test_x"
    for number in (5, 6):
        (folder / "in.script").write_text(text.replace("run 5", f"run {number}"))
        recorder.keep(record, ["-in", "in.script", "-log", "none"])
    kept = list(record.glob("*.json"))
    checks.fact("a run is recorded once whatever its numbers are", len(kept) == 1)
    checks.fact("with the files that it names", '"a.stl"' in kept[0].read_text() and "old.dump" not in kept[0].read_text())


# Stands for LAMMPS: writes what the scripts of a batch ask for.
PROGRAM = """\
#!{python}
import re, sys
text = open(sys.argv[sys.argv.index("-in") + 1]).read()
for line in text.split("\\n"):
    mark = re.match(r'print "(== \\S+)"', line)
    if mark: print(mark.group(1))
    dump = re.match(r"write_dump all custom (\\S+)", line)
    if dump and not {missing}: open(dump.group(1), "w").write("ITEM: ATOMS id fx\\n1 {force}\\n")
    if {stops} and line.startswith("run"): print("ERROR: no"); sys.exit(1)
print("Total wall time: 0:00:0" + str(id(text) % 10))
"""


def whole(checks, folder):
    """compare.py on programs that write what they are told."""
    def program(name, force="0.5", missing=False, stops=False):
        path = folder / name / "bin" / "lmp-lsdcd"
        path.parent.mkdir(parents=True)
        path.write_text(PROGRAM.format(python=sys.executable, force=force, missing=missing, stops=stops))
        path.chmod(0o755)
        return str(folder / name)

    accepted = folder / "accepted.txt"
    table = folder / "table"

    def status(ours, reference=program("reference"), lines=""):
        accepted.write_text("# none\n" + lines)
        return compare.main([reference, "--build", ours, "--as-built", "--without-recorded", "--forms", "plain", "--ranks", "1",
                             "--only", r"^hooke(_history)?\.(rest|rotate)$", "--accepted", str(accepted),
                             "--table", str(table)])

    other = program("other", "0.5000001")
    checks.fact("equal programs: 0", status(program("same")) == 0)
    checks.fact("and again, with answers that were kept", status(str(folder / "same")) == 0)
    checks.fact("another force: 1", status(other) == 1)
    rows = table.read_text().split("\n")
    checks.fact("it is in the table with its size", len(rows) == 4 * 3 + 2 and "\t1e-07\t2e-07" in rows[1], rows[1])
    checks.fact("a bound that holds: 0", status(other, lines="hooke* | *dump: fx | relative 1e-6 | rounding\n") == 0)
    checks.fact("one that does not: 1", status(other, lines="hooke* | *dump: fx | relative 1e-8 | rounding\n") == 1)
    checks.fact("files that are missing: 1", status(program("without", missing=True)) == 1)
    checks.fact("a run that stops: 1", status(program("stops", stops=True)) == 1)
    checks.fact("a reference that stops: 2", status(str(folder / "same"), reference=str(folder / "stops")) == 2)


def main():
    checks = lmp.Checks()
    with tempfile.TemporaryDirectory(prefix="bits-test-") as folder:
        folder = pathlib.Path(folder).resolve()
        contents(checks)
        masks(checks)
        scripts(checks, folder)
        whole(checks, folder)
        os.chdir("/")
    checks.done()


if __name__ == "__main__":
    main()
