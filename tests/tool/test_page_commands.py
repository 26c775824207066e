# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Every command of the pages: that its program, words, options and files are there.

Commands of `lsdcd` in a block are run, in a folder with the files that they read; those of doc/tutorial.md are run
by tests/lammps/test_tutorial.py, and those of pages with whole scripts by tests/lammps/test_recipes.py. In a form, or between
words, only words are checked.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from pages import ROOT, all_pages
from test_commands import QUICK
import stl
from command import TOOL, run
from facts import fact
from triangles import cube

# Programs of the system, which are not ours to check.
OTHERS = {"apt", "c++", "cat", "cd", "clang-format", "cp", "ctest", "docker", "echo", "export", "git", "gmsh", "grep", "head",
          "mkdir", "module", "mpicxx", "nvidia-smi", "paraview", "pip", "pkg-config", "printf", "source", "sudo", "surfaceMeshExtract",
          "tail", "[", "reuse", "tar", "unzip", "nproc"}
LAMMPS_OPTIONS = {"-in", "-i", "-var", "-v", "-k", "-kokkos", "-sf", "-suffix", "-pk", "-log", "-h", "-nocite", "-screen"}
BUILD_FILES = "\n".join(path.read_text() for path in [
    ROOT / "CMakeLists.txt", ROOT / "CMakePresets.json", *ROOT.glob("cmake/*.cmake"),
    *(path for folder in ("src", "tests", "bench", "kokkos") for path in (ROOT / folder).rglob("CMakeLists.txt"))])
RUN_HELP = subprocess.run([ROOT / "run", "help"], stdout=subprocess.PIPE, text=True).stdout
BENCHMARKS = subprocess.run([sys.executable, ROOT / "bench" / "run.py", "--help"], stdout=subprocess.PIPE, text=True).stdout

problems, helps = [], {}


def options_of(words):
    """Options of a command of lsdcd, from its help; None where there is no such command."""
    key = tuple(words)
    if key not in helps:
        done = subprocess.run([TOOL, *words, "--help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        helps[key] = done.returncode == 0 and set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", done.stdout)) or None
    return helps[key]


def check_lsdcd(words):
    if not words or words[0] in ("--help", "--version", "COMMAND", "..."):
        return ""
    command = words[:1]
    if words[0] == "generate" and len(words) > 1 and re.fullmatch(r"[a-z]+", words[1]):
        command = words[:2]
    known = options_of(command)
    if known is None:
        return f"lsdcd {' '.join(command)}: there is no such command"
    bad = [word for word in words[len(command):] if re.match(r"--?[a-zA-Z]", word) and word not in known]
    return f"lsdcd {' '.join(command)} has no {' '.join(bad)}" if bad else ""


def check_run(words):
    if not words:
        return ""
    if not re.search(rf"^  \./run {re.escape(words[0])}\b", RUN_HELP, re.M) and words[0] != "help":
        return f"./run {words[0]}: not in ./run help"
    if words[0] == "bench" and len(words) > 1 and not re.match(r"-|[A-Z]+$", words[1]) and \
            not re.search(rf"^  {re.escape(words[1])} ", BENCHMARKS, re.M):
        return f"./run bench {words[1]}: not in ./run bench --help"
    text = RUN_HELP + (ROOT / "bench" / "run.py").read_text() + "".join(p.read_text() for p in (ROOT / "bench").glob("*.py"))
    bad = [word for word in words if word.startswith("--") and word.rstrip(",") not in text]
    return f"./run {words[0]} has no {' '.join(bad)}" if bad else ""


def check_script(page, program, words):
    """A script of ours: it is there, and has the options."""
    folder = (ROOT / page.path).parent
    name = re.sub(r"^(\.\./)+", "", program)
    there = [path for path in (folder / program, ROOT / name, ROOT / "examples" / "tutorial" / name) if path.is_file()]
    if not there:
        return f"{program}: there is no such file"
    text = "".join(path.read_text() for path in there[0].parent.glob("*.py")) + there[0].read_text() + \
        "".join(path.read_text() for path in (ROOT / "examples").glob("*.py"))
    bad = [word for word in words if word.startswith("--") and word not in text]
    return f"{program} has no {' '.join(bad)}" if bad else ""


def check_lammps(page, words):
    bad = [word for word in words if re.match(r"-[a-z]", word) and word not in LAMMPS_OPTIONS]
    if bad:
        return f"LAMMPS has no {' '.join(bad)}"
    if "-in" in words:
        name = words[words.index("-in") + 1]
        folders = [(ROOT / page.path).parent, ROOT, *(ROOT / "examples").iterdir()]
        in_page = any(block.language == "lammps" and re.match(rf"units|# {re.escape(name)}\n", block.text) for block in page.blocks)
        if not in_page and not any((folder / name).is_file() for folder in folders) and not name.isupper() and name != "in.script":
            return f"{name}: there is no such script"
    return ""


def check_cmake(words):
    for at, word in enumerate(words):
        after = words[at + 1] if at + 1 < len(words) else ""
        name = after.split("=")[0] if word == "-D" else word[2:].split("=")[0] if word.startswith("-DLSDCD") else ""
        if name.startswith("LSDCD_") and name not in BUILD_FILES:
            return f"there is no {name}"
        if word == "--preset" and f'"{after}"' not in BUILD_FILES:
            return f"there is no preset {after}"
        if word == "--target":
            for target in words[at + 1:]:
                if target.startswith("-"):
                    break
                room = re.fullmatch(r"(\w+)_tests", target)    # lsdcd_unit_test(ROOM NAME) makes ROOM_tests
                if not re.search(rf"\b{re.escape(target)}\b", BUILD_FILES) and \
                        not (room and re.search(rf"lsdcd_\w+\({room[1]} ", BUILD_FILES)):
                    return f"there is no target {target}"
    return ""


def check(page, words):
    """What is wrong with one command; nothing where all is well."""
    while words and (re.match(r"[A-Z_]+=", words[0]) or words[0] == "do"):    # VARIABLE=value
        words = words[1:]
    if not words or words[0] in ("for", "done"):
        return ""
    if words[0] in ("mpirun", "time", "nice"):
        ours = [at for at, word in enumerate(words) if word.endswith("lmp-lsdcd") or word.endswith("/lmp") or word == "lmp"]
        return check(page, words[ours[0]:]) if ours else ""
    program, name = words[0], os.path.basename(words[0])
    if name == "lsdcd":
        return check_lsdcd(words[1:])
    if name == "run":
        return check_run(words[1:])
    if name in ("lmp-lsdcd", "lmp"):
        return check_lammps(page, words[1:])
    if name in ("python3", "python"):
        return "" if len(words) == 1 or words[1] in ("-c", "-m") else check_script(page, words[1], words[2:])
    if name == "yade":    # its own options come before the script
        at = next(k for k, word in enumerate(words) if word.endswith(".py"))
        return check_script(page, words[at], words[at + 1:])
    if name == "cmake":
        return check_cmake(words[1:])
    if name in OTHERS or re.match(r"build/(fuzz/)?bin/((test|bench|fuzz)_|\w+_tests$)", program) or program.startswith("$") or program in ("./distance", "./simbody_wheel", "./bullet_crates"):
        return ""
    if "/" in program or program.endswith((".py", ".sh")):
        return check_script(page, program, words[1:])
    return f"{program}: what is this?"


def commands_of(text):
    """Lists of words, of each command of a shell script."""
    text = re.sub(r"\\\n", " ", text)
    text = re.sub(r"(<<'?(\w+)'?.*)\n(?:.*\n)*?\2$", r"\1", text, flags=re.M)    # a file that is written here
    inner = re.findall(r"\$\(([^()]*)\)", text)
    text = re.sub(r"\$\([^()]*\)", "ANSWER", text)
    for line in inner + text.split("\n"):
        lexer = shlex.shlex(line, posix=True, punctuation_chars=";|&<>()")
        lexer.whitespace_split = True
        words, skip = [], False
        for word in lexer:
            if re.fullmatch(r"[;|&()]+", word):
                if words:
                    yield words
                words, skip = [], False
            elif re.fullmatch(r"[<>]+&?", word):
                skip = True
            elif skip:
                skip = False
            else:
                words.append(word)
        if words:
            yield words


def quick(words):
    """The command with options that make it quick, in place of the page's."""
    options = QUICK.get(words[0], "").split()
    for name, value in zip(options[::2], options[1::2]):
        if name in words:
            words[words.index(name) + 1] = value
        else:
            words += [name, value]
    return words


def prepare(folder):
    stl.write(folder / "wall.stl", cube(1))
    stl.write(folder / "body.stl", cube(1, size=0.5))
    run(folder, "convert", "wall.stl", "-o", "wall.obj")
    (folder / "points.csv").write_text("x,y,z\n0.5,0.5,1.05\n3,3,3\n")
    (folder / "path.txt").write_text("0.5 0.5 0.5\n3 0 0\n")


def test_page_commands():
    os.environ["LSDCD_POTENTIALS"] = str(ROOT / "potentials")
    inline = 0
    for page in all_pages().values():
        for block in page.blocks:
            if block.language not in ("sh", "bash"):
                continue
            found = list(commands_of(block.text))
            wrong = [why for words in found for why in [check(page, words)] if why]
            fact(f"{block}: {len(found)} commands have their words", not wrong, "; ".join(wrong))
            if block.form or page.path in ("doc/tutorial.md", "doc/recipes.md", "doc/choosing.md"):
                continue
            ours = [words[1:] for words in found if os.path.basename(words[0]) == "lsdcd"]
            with tempfile.TemporaryDirectory() as folder:
                if ours:
                    prepare(pathlib.Path(folder))
                for words in ours:
                    done = run(folder, *quick(words))
                    # repair ends with 3 where something is left, which is no error.
                    fact(f"{block}: lsdcd {' '.join(words)[:60]}", done.returncode in (0, 3), done.stderr[-300:])
        # Messages that begin with lsdcd.
        if page.path == "doc/troubleshooting.md":
            continue
        prose = re.sub(r"^```.*?^```", "", page.text, flags=re.M | re.S)
        wrong = []
        for code in re.findall(r"(?<!`)``?((?:\S*/)?(?:lsdcd|lmp-lsdcd) [^`\n]+|\./run [^`\n]+)``?", prose):
            inline += 1
            try:
                wrong += [f"{code}: {why}" for words in commands_of(code) for why in [check(page, words)] if why]
            except ValueError as error:
                wrong.append(f"{code}: {error}")
        if wrong:
            fact(f"{page.path}: commands between words", False, "; ".join(wrong))
    fact("commands between words have their words", inline > 20, inline)
