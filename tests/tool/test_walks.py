#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What doc/walks.py and doc/lines.py count, on small sources, and that the names of the walks are there."""
import os
import subprocess
import sys

DOC = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "doc")
sys.path.insert(0, DOC)
sys.dont_write_bytecode = True
import lines
import walks

FILES = {
    "src/a/types.h": "struct Ball {\n  int n;\n};\nstruct Other {\n};\n",
    "src/a/first.cpp": "// second() in a comment\nint first(const Ball &b)\n{\n  Other o;\n  return second(b.n);\n}\n",
    "src/b/second.cpp": 'int second(int n)\n{\n  return n > 0 ? "}" : 0;\n}\nint third()\n{\n  return 3;\n}\n',
    "src/b/twice.h": "struct A {\n  int twice() const { return 1; }\n};\nstruct B : Base<A> {\n"
                     "  int twice() const override { return 2; }\n};\n",
    "src/b/also.h": "struct C {\n  int twice() const { return third(); }\n};\n",
}
failed = 0


def check(fact, found, wanted):
    global failed
    if found != wanted:
        failed += 1
        print(f"FAILED: {fact}: {found!r} is not {wanted!r}")


def error_of(names):
    try:
        walks.Sources(FILES).walk(names)
    except SystemExit as e:
        return str(e)
    return "none"


def walk_of(names):
    return sorted(walks.Sources(FILES).walk(names))


def has_commit():
    return subprocess.run(["git", "-C", walks.ROOT, "cat-file", "-e", walks.BEFORE + "^{commit}"],
                          stderr=subprocess.DEVNULL).returncode == 0


def main():
    check("a walk has the files of its functions and of the types in their heads", walk_of("first second"),
          ["src/a/first.cpp", "src/a/types.h", "src/b/second.cpp"])
    check("functions, files, changes of file, returns and functions of at most 2 lines are counted",
          walks.Sources(FILES).count("first second > B::twice > third A::twice"), (5, 3, 4, 2, 5))
    check("a line without anything but a bracket is none", walks.lines_of("\n  a;\n\n  if (b) {\n    c;\n  }\n"), 3)
    check("a function that none before it names is an error", error_of("first third"),
          "third is not called on the walk before it")
    check("but not behind >", walk_of("first > third"), ["src/a/first.cpp", "src/a/types.h", "src/b/second.cpp"])
    check("a name that is gone is an error", error_of("first fourth"), "fourth is defined in 0 files: ")
    check("a name of two files is an error", error_of("twice"), "twice is defined in 2 files: src/b/also.h src/b/twice.h")
    check("a class tells which is meant", walk_of("C::twice third"), ["src/b/also.h", "src/b/second.cpp"])
    check("a file tells which is meant", walk_of("twice.h:twice"), ["src/b/twice.h"])
    check("code that names something has it outside of comments", walks.naming(FILES, "second"), {"src/a/first.cpp",
                                                                                                "src/b/second.cpp"})
    check("a comment names nothing", walks.naming(FILES, "in a comment"), set())
    for when in [[], ["--before"]] if has_commit() else [[]]:
        run = subprocess.run([sys.executable, os.path.join(DOC, "walks.py"), *when], capture_output=True, text=True)
        check(f"the names of the walks are there {when}", (run.returncode, run.stderr), (0, ""))

    text = "// SPDX-" + "License-Identifier: x\n\nint a;\n// b\n"
    check("lines without those of a licence and without empty ones", lines.count([("src/mesh/io/a.h", text)]),
          {"src/mesh": 2})
    check("a room stands under its new name", lines.count([("src/deck/a.h", text), ("src/input/b.h", "x\n")]),
          {"src/input": 3})
    check("what is no source is not counted", lines.count([("tests/lammps/a.stl", "solid\n")]), {})
    check("rows and sums", lines.table({"src/a": 3, "tests/unit": 2}, {"src/a": 5}).split(),
          "lines before change src/a 3 5 -2 tests/unit 2 0 +2 all sources 3 5 -2 all tests 2 0 +2 "
          "all bench 0 0 +0".split())
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
