# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Types of the Python package: mypy (Debian: mypy) finds no error in the package, its examples and right uses, and those of wrong ones; the library
agrees with both. The tables that users look names up in are those of the words."""
import functools
import pathlib
import re
import runpy
import shutil
import subprocess
import tempfile
import typing

import pytest

import lsdcd
from facts import fact

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WRONG = HERE / "wrong_uses.py"
EXAMPLES = [path for path in sorted((ROOT / "examples/library").glob("*.py")) if path.name != "yade_drum.py"]    # which does not import Yade's names
FLOOR = lsdcd.Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
LAW = "hooke/history 1e4 5e3 20 NULL 0.5 1"

needs_mypy = pytest.mark.skipif(not shutil.which("mypy"), reason="no mypy (Debian: mypy)")


# Functions of the examples have no types of their own.
SETTINGS = f"""[mypy]
strict = True
mypy_path = {ROOT}/src/api
[mypy-matplotlib.*,PIL.*]
ignore_missing_imports = True
[mypy-{",".join(path.stem for path in EXAMPLES)}]
disallow_untyped_defs = False
disallow_untyped_calls = False
implicit_reexport = True
"""


@functools.lru_cache(maxsize=None)
def told_by_mypy():
    with tempfile.TemporaryDirectory() as folder:
        settings = pathlib.Path(folder) / "mypy.ini"
        settings.write_text(SETTINGS, encoding="utf-8")
        done = subprocess.run(["mypy", "--config-file", settings, "--cache-dir", folder, "--show-error-codes", "--no-error-summary", "src/api/lsdcd",
                               HERE / "right_uses.py", WRONG, *EXAMPLES], cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 1, done.stdout    # 2: mypy itself
    return done.stdout.splitlines()


def marked():
    """Lines of wrong_uses.py, and the codes of errors that they end with, "" for none."""
    for k, line in enumerate(WRONG.read_text(encoding="utf-8").splitlines(), 1):
        code = re.search(r"    # ([\w-]+)$", line)
        yield k, line, code[1] if code else ""


@needs_mypy
@pytest.mark.parametrize("where", ("src/api/lsdcd/", "tests/library/right_uses.py", "examples/library/"))
def test_right_uses_have_no_errors(where):
    told = [line for line in told_by_mypy() if where in line and ": error: " in line]
    fact("none", not told, told)


@needs_mypy
def test_wrong_uses_have_errors():
    found = [re.search(r"wrong_uses\.py:(\d+): error: .*\[([\w-]+)\]$", line) for line in told_by_mypy()]
    found = {(int(error[1]), error[2]) for error in found if error}
    wanted = {(k, code) for k, _, code in marked() if code}
    fact("those of their lines", found == wanted, sorted(found ^ wanted))


def test_right_uses_run():
    runpy.run_path(str(HERE / "right_uses.py"))


def test_wrong_uses_are_refused():
    names = {}
    exec("\n".join(line for _, line, code in marked() if not code), names)
    for k, line, code in marked():
        if not code:
            continue
        try:
            exec(line, dict(names))
            fact(f"line {k} is refused", False, line)
        except (TypeError, ValueError, KeyError, AttributeError) as error:
            fact(f"line {k} is refused", True, error)


# ---- tables ------------------------------------------------------------------------------

def refusal(words):
    with pytest.raises(lsdcd.Error) as refused:
        lsdcd.Wall.check(f"{LAW} mesh $floor {words}", floor=FLOOR)
    return str(refused.value)


def test_names_are_those_of_the_tables(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "src" / "api")
    import make_names
    fact("src/api/lsdcd/_names.py is that of the tables; cmake --build build --target python_names makes it anew",
         make_names.FILE.read_text(encoding="utf-8") == make_names.text())
    fact("src/api/lsdcd/_style_outputs.py is that of the pages", make_names.STYLES_FILE.read_text(encoding="utf-8") == make_names.styles_text())
    named = {name.split(" ")[0] for name in lsdcd.KEYWORDS}
    fact("keywords are those that a refusal lists", set(refusal("no_such_keyword").split("; those are ")[1].split(", ")) == named)
    fact("types of names have them", set(typing.get_args(lsdcd.KeywordName)) == named and
         set(typing.get_args(lsdcd.OutputName)) == set(lsdcd.OUTPUTS))
    fact("units are those that a refusal lists", ", ".join(typing.get_args(lsdcd.Units)[:-1]) + " or nano" in units_of_a_refusal())


def units_of_a_refusal():
    with pytest.raises(lsdcd.Error) as refused:
        lsdcd.Wall.check("granular material glass.lsdcd glass on aluminium mesh $floor", floor=FLOOR, units="imperial")
    return str(refused.value)


def test_keywords():
    for name, row in lsdcd.KEYWORDS.items():
        told = refusal(name if " " in row.syntax else f"{name} {name}")
        fact(f"{name} has the syntax of its refusal", told.split(" Syntax: ")[-1] == row.syntax, told)
        fact(f"{name} is told by the docstring of Wall", f"        {row.syntax}\n            {row.meaning} (" in lsdcd.Wall.__doc__)
        fact(f"{name} is off, has a default or is required", row.default or name == "mesh")
    facts = {name: (row.unit, row.range, row.default, row.of_mesh, row.repeats) for name, row in lsdcd.KEYWORDS.items()}
    fact("move repeats and is of a mesh", facts["move"] == ("length", "", "0 0 0", True, True), facts["move"])
    fact("corner is of the wall", facts["corner"] == ("", "", "blend", False, False), facts["corner"])
    fact("a program's own", lsdcd.KEYWORDS["nodes"].syntax == "nodes caller" and lsdcd.KEYWORDS["motion"].syntax.startswith("motion caller | linear")
         and lsdcd.KEYWORDS["device"].default == "cpu")
