# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The scripts of doc/recipes.md and doc/choosing.md run as they stand, and print what the pages have; and the log of README's script has
the lines that doc/log.md explains.

A block of LAMMPS whose first line is `# in.NAME` is that file. The commands of the shell run in their order; what they print has the
lines of the texts behind them. Beds of some hundred grains are chaotic: another compiler gives another bed, whose flow or torque may
differ by a tenth and the largest stress of a facet by more, so that numbers of them are compared to a half, and shares to ten
per cent of the whole; numbers of one grain to a hundredth. The small samples cut the runs of doc/recipes.md to a fiftieth of their
steps, and ask only that all commands end well.
"""
import base64
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys

import lmp
from facts import fact

sys.path.insert(0, str(lmp.HERE.parent / "tool"))
from pages import ROOT, Page    # noqa: E402

STEPS = re.compile(r"(^run +|every +)(\d+)", re.M)
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")


def words_of(line):
    return NUMBER.sub("#", line)


def compare(page, wanted, printed, within):
    """Lines with the same words, whose numbers are nearly the same."""
    lines = printed.split("\n")
    fact(f"{page.path} prints {len(wanted)} lines", [words_of(a) for a in wanted] ==
         [words_of(line) for line in lines if words_of(line) in {words_of(a) for a in wanted}], "" if set(map(words_of, wanted)) <= set(map(words_of, lines)) else printed[-1500:])
    rest = lines
    for line in wanted:
        found = next((other for other in rest if words_of(other) == words_of(line)), None)
        if found is None:
            continue
        rest = rest[rest.index(found) + 1:]
        near = [abs(float(a[0]) - float(b[0])) <= (10 if line[a.end():].startswith(" %") else within * abs(float(a[0])))
                for a, b in zip(NUMBER.finditer(line), NUMBER.finditer(found))]
        fact(f"{page.path}: {line}", all(near), found)


def run_page(folder, path, within=None):
    """Without `within` short runs, whose numbers are not compared."""
    page = Page(path)
    for block in page.blocks:
        name = re.match(r"# (in\.\w+)\n", block.text)
        if block.language == "lammps" and name:
            (folder / name[1]).write_text(block.text if within else STEPS.sub(
                lambda found: found[1] + str(math.ceil(int(found[2]) / 50)), block.text))
    shutil.copy(ROOT / "examples" / "tutorial" / "stress.py", folder)
    shell = "".join(block.text for block in page.blocks if block.language == "sh" and not block.form)
    environment = lmp.environment()
    environment["PATH"] = f"{pathlib.Path(lmp.LMP).parent}:{environment['PATH']}"
    done = subprocess.run(["bash", "-ec", shell], cwd=folder, env=environment, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    fact(f"every command of {path} ends well", done.returncode == 0, done.stdout[-1500:] if done.returncode else "")
    wanted = [line for block in page.blocks if block.language == "text" and NUMBER.search(block.text) and ":" in block.text
              for line in block.text.strip().split("\n")]
    if within:
        compare(page, wanted, done.stdout, within)


def test_recipes(folder):
    run_page(folder, "doc/recipes.md", None if lmp.QUICK else 0.5)


def test_choosing(folder):
    run_page(folder, "doc/choosing.md", 0.01)


def test_explain_log(folder):
    """The script of README in fewer steps: each line of the page is in its log, with other numbers."""
    readme, page = Page("README.md"), Page("doc/log.md")
    script = next(block.text for block in readme.blocks if block.language == "lammps" and block.text.startswith("units"))
    tool = re.search(r"`\S*(lsdcd generate [^`]*)`", readme.text)[1].split()
    subprocess.run([pathlib.Path(lmp.LMP).parent / tool[0], *tool[1:]], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    done = lmp.run(re.sub(r"^run .*", "run 8000", script, flags=re.M), folder, ranks=2)
    printed = {" ".join(words_of(line).split()) for line in done.stdout.split("\n")}
    for block in page.blocks:
        missing = [line for line in block.text.strip().split("\n") if " ".join(words_of(line).split()) not in printed]
        fact(f"{block}: the log has these lines", block.language == "text" and not missing, "; ".join(missing))


def test_stress(tmp_path):
    """stress.py tells of files that it cannot use, and of facets that no grain has touched."""

    def write(name, fields):
        (tmp_path / name).write_text("".join(
            f'<DataArray type="{kind}" Name="{field}">{base64.b64encode(struct.pack(form, 0, *values)).decode()}</DataArray>\n'
            for field, kind, form, values in fields))

    places = [("points", "Float64", "<q9d", [0, 0, 1, 1, 0, 1, 0, 1, 1]), ("connectivity", "Int64", "<q3q", [0, 1, 2])]
    write("a_10.vtp", [*places, ("normal_stress", "Float64", "<qd", [0])])
    write("bare.vtp", places)
    for words, code, told in ((["a_10.vtp"], 0, "a_10.vtp: 1 facets, all untouched\n"), (["a_10.vtp", "--below", "0.5"], 0, "a_10.vtp: no facet below 0.5\n"),
                              (["a_20.vtp"], 2, "a_20.vtp is not there; . has a_10.vtp, bare.vtp\n"), (["bare.vtp"], 2, "no file of mesh_fields\n")):
        done = subprocess.run([sys.executable, ROOT / "examples" / "tutorial" / "stress.py", *words], cwd=tmp_path, text=True, capture_output=True)
        fact(f"stress.py {' '.join(words)}", done.returncode == code and (done.stdout + done.stderr).endswith(told), done.stdout + done.stderr)
