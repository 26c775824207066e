# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The pages: their links, and that all of their code runs. pages.py says what a block is.

links       files, anchors and images of links are there; messages of doc/troubleshooting.md are in the sources
code        Python of user pages runs, other code compiles; programs that say so print what the page has
commands    of user pages run in their order, as they stand; of others those of `lsdcd`, in a folder with the files that they read; in a
            form, or between words, their words are there
scripts     LAMMPS: whole scripts for 0 steps, other lines in a small scene
host        those of user pages that need a newer LAMMPS, in that of hosts/build_host.sh
recipes     doc/recipes.md and doc/choosing.md run as they stand, and print what the pages have
figures     tables and words that bench/pages.py makes of doc/data are in the pages, and no other time or comparison of settings beside them
log         README's script and commands run as they stand, and the log has the lines that doc/log.md explains
tutorial    every command of doc/tutorial.md in its order, and (paraview) the script that opens its result
"""
import base64
import importlib.util
import math
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile

import pytest

import command
import lmp
import stl
from facts import at_most, fact
from pages import ROOT, Page, all_pages, target_of
from test_commands import QUICK
from triangles import cube

COMPILERS = {"c": [os.environ.get("LSDCD_C", "cc"), "-std=c99"], "cpp": [os.environ.get("LSDCD_CXX", "c++"), "-std=c++17"]}
SHELL = {"sh", "bash"}
# A text is no code: a table, a drawing, what a program prints.
LANGUAGES = {"lammps", "python", "text", *SHELL, *COMPILERS}
IMAGES = (".png", ".gif", ".svg", ".webp", ".jpg")
TUTORIAL = ROOT / "examples" / "tutorial"


def top_of_sources(folder, *written):
    """Makes a folder like the top of the sources: build/bin and examples, of which a folder that is `written` to is a copy."""
    (folder / "build").mkdir(parents=True)
    (folder / "build" / "bin").symlink_to(pathlib.Path(lmp.LMP).parent)
    (folder / "examples").mkdir()
    for path in (ROOT / "examples").iterdir():
        if path.name in written:
            shutil.copytree(path, folder / "examples" / path.name)
        else:
            (folder / "examples" / path.name).symlink_to(path)


def shell(words, folder, **environment):
    return subprocess.run(words, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL, env=lmp.environment(**environment))


DEVELOPERS = {"doc/design.md", "doc/testing.md"}
# Blocks of user pages that no test runs as they stand, by their first words, and why.
COMPILES = "compiles this tree, as each test does before"
NEWER = "needs a newer LAMMPS: test_host runs it"
NOT_RUN = {
    ("README.md", "./run build"): COMPILES,
    ("doc/shaped_grains.rst", "units        si\nplugin"): NEWER,
    ("doc/fix_insert_lsdcd.rst", "molecule stones"): "needs headers of molecules; lammps.host.test_clump_insertion has such clumps",
    ("doc/install.md", "plugin load build-host"): NEWER,
    ("doc/install.md", "./run build"): COMPILES,
    ("doc/install.md", "./run package"): "compiles this tree; check_release.py looks into its packages",
    ("doc/install.md", "./run test"): COMPILES,
    ("doc/install.md", "cmake -S lammps/cmake -B lammps/build -D BUILD_MPI"): "downloads LAMMPS, which hosts/build_host.sh does",
    ("doc/install.md", "cmake -B build-host"): "tests/lammps/CMakeLists.txt compiles this plugin",
    ("doc/install.md", "cmake -B build-kokkos"): "tests/lammps/CMakeLists.txt compiles this plugin",
    ("doc/install.md", "cmake -S lammps/cmake -B lammps/build -D CMAKE_PROJECT"): "downloads LAMMPS, which hosts/build_host.sh package does",
    ("doc/install.md", "module load"): "needs a cluster",
    ("doc/library.md", "cmake --install"): "has a prefix to be chosen; test_install.py installs a build",
    ("doc/library.md", "find_package"): "is of a CMakeLists.txt; test_install.py builds with such lines",
    ("doc/other-walls.md", "/usr/bin/python3 examples/flat/differences.py"): "names a LAMMPS; lammps.wall_gran_differences runs it",
    ("doc/performance.md", "sed 's/ log brief//'"): "needs the meshes of examples/films, and half a minute",
    ("doc/recipes.md", "export LAMMPS_PLUGIN_PATH"): "needs a GPU",
    ("doc/recipes.md", "apt install gmsh"): "installs a program, and has a file of CAD",
    ("doc/recipes.md", "surfaceMeshExtract"): "needs OpenFOAM",
    ("doc/report.md", "lsdcd report"): "needs the folder of a run; test_report.py and test_report_of_runs.py make some",
    ("doc/report.md", "lsdcd film"): "needs the folder of a run; test_film.py makes some",
    ("doc/tool.md", "lsdcd check"): "starts what LAMMPS the machine has, and names one of the reader's; test_check.py runs it",
    ("doc/tool.md", "lsdcd report"): "needs the folder of a run; test_report.py and test_report_of_runs.py make some",
    ("doc/validation.md", "./run validate"): COMPILES,
    ("doc/tutorial.md", "paraview"): "opens a window; test_paraview runs its script",
}


def is_of_users(page):
    return page.path == "README.md" or re.fullmatch(r"doc/[\w-]+\.(md|rst)", page.path) and page.path not in DEVELOPERS


def why_not_run(block):
    """A reason, or an empty string."""
    return next((why for (path, words), why in NOT_RUN.items() if path == block.page.path and block.text.startswith(words)), "")


def blocks_of(*languages):
    """Those that run: of user pages all but those of NOT_RUN, of others those that are no forms."""
    found = [block for page in all_pages().values() for block in page.blocks if block.language in languages and not block.syntax
             and not (why_not_run(block) if is_of_users(page) else block.form)]
    fact(f"there are blocks of {languages[0]}", len(found) > 5)
    return found


# ---- links -------------------------------------------------------------------------------


def nothing(name, wrong):
    fact(name, not wrong, "; ".join(map(str, wrong)))


def test_links():
    pages, missing, used = all_pages(), [], set()
    for page in pages.values():
        for line, target in page.links + page.images:
            found = target_of(page, target)
            if not found:
                continue
            path, anchor = found
            used.add(path)
            if not (ROOT / path).exists() or anchor and (path not in pages or anchor not in pages[path].anchors):
                missing.append(f"{page.path}:{line}: {target}")
    nothing("links have their files and anchors", missing)
    nothing("images of doc/img are on pages", {os.path.relpath(path, ROOT) for path in (ROOT / "doc" / "img").rglob("*.*")} - used)
    index = pages["doc/index.md"]
    named = {target_of(index, target)[0] for _, target in index.links if target_of(index, target)} | {index.path}
    nothing("doc/index.md has the pages", [path for path in pages if re.match("doc/(?!data/)", path) and path not in named])
    nothing("code blocks have a language", [f"{page.path}:{line}" for page in pages.values() for line in page.indented] +
            [block for page in pages.values() for block in page.blocks if block.language not in LANGUAGES and not block.form])


def test_blocks_of_links():
    """Each block of code of a user page runs, or is in NOT_RUN, and no block is marked as a form without a reason."""
    blocks = [block for page in all_pages().values() if is_of_users(page) for block in page.blocks if not block.syntax]
    reasons = {key for block in blocks for key in NOT_RUN if key[0] == block.page.path and block.text.startswith(key[1])}
    nothing("reasons of NOT_RUN are of blocks", NOT_RUN.keys() - reasons)
    nothing("forms have a reason", [block for block in blocks if block.form and not why_not_run(block)])
    nothing("blocks are of languages that run", [block for block in blocks if block.language not in LANGUAGES and not why_not_run(block)])


def test_continued_lines_of_links():
    """LAMMPS ends a command at a comment behind &."""
    texts = [(str(block), block.text) for page in all_pages().values() for block in page.blocks if block.language == "lammps"]
    texts += [(path.relative_to(ROOT), path.read_text(encoding="utf-8")) for path in ROOT.glob("examples/**/in.*") if not path.name.endswith(".liggghts")]
    nothing("nothing stands behind &", [f"{where}: {line}" for where, text in texts for line in text.split("\n") if re.match(r"[^#]*&[ \t]*#", line)])


def test_messages_of_links():
    """Each message of doc/troubleshooting.md is in the sources."""
    text = "".join(path.read_text(encoding="utf-8") for folder in ("src", "kokkos")
                   for path in sorted((ROOT / folder).rglob("*")) if path.suffix in (".cpp", ".h", ".cu"))
    text = re.sub(r'"\s*\n\s*"', "", text)    # literals that a compiler joins
    # A host's names in messages: those of LAMMPS.
    names = dict(re.findall(r'names_\.(\w+) = "([^"]+)"', text))
    text = re.sub(r'"\)?\s*\+\s*host_\.names\(\)\.(\w+)\s*\+\s*"', lambda name: names[name[1]], text)
    rows = re.findall(r"^- `([^`]+)`:", Page("doc/troubleshooting.md").text, re.M)
    fact("messages are explained", len(rows) >= 20, len(rows))
    nothing("messages are in the sources", [row for row in rows for part in row.split("...") if part.strip()
                                            and not any(form in text for form in (part.strip(), part.strip(" ;:")))])


def test_paper_of_links():
    """What doc/paper.md names as the place of a formula, function or table of the paper is in that file, whose comment names the paper's."""
    named, missing, unnamed = set(), [], []
    for what, where in re.findall(r"^\| ([^|]+) \|[^|]*\| ([^|]*src/[^|]*) \|", Page("doc/paper.md").text, re.M):
        of_paper = re.match(r"(formula|function|table) (\d)", what)
        if of_paper:
            named.add(of_paper[0])
        for names, path in re.findall(r"((?:`\w+`[^`;[]*)+)\[[^]]*\]\(\.\./([^)]*)\)", where):
            text = (ROOT / path).read_text(encoding="utf-8")
            missing += [f"{path}: {name}" for name in re.findall(r"`(\w+)`", names) if not re.search(rf"\b{name}\b", text)]
            comments = " ".join(re.findall(r"// ?(.*)", text))
            if of_paper and not re.search(rf"{of_paper[1]} \({of_paper[2]}\)|{of_paper[1]} {of_paper[2]}\b", comments, re.I):
                unnamed.append(f"{path}: {of_paper[0]}")
    fact("doc/paper.md has a place for each formula, function and table", named == {
        *(f"formula {n}" for n in range(1, 8)), *(f"function {n}" for n in (1, 2, 3)), "table 1", "table 2"}, sorted(named))
    nothing("functions of doc/paper.md are in their files", missing)
    nothing("comments name what of the paper it is", unnamed)


# ---- code --------------------------------------------------------------------------------


def source_of(block):
    """A file of its own. Statements become the body of a function. Definitions stand as they are: what a comment before them opens
    is closed."""
    lines = block.before + block.text.split("\n")
    includes = [line for line in lines if line.startswith("#include")]
    rest = "\n".join(line for line in lines if not line.startswith("#include"))
    if re.search(r"^(template|struct|class|int main|LSDCD_FN)", block.text, re.M):
        rest += "\n}" * (rest.count("{") - rest.count("}"))
    else:
        rest = "void page()\n{\n" + rest + "\n}"
    if block.page.path.startswith("doc/library"):
        includes.append("#include <lsdcd.h>" if block.language == "c" else "#include <lsdcd.hpp>")
    return "\n".join(includes) + "\n" + rest + "\n"


def problem_of(block, folder):
    if block.language == "python":
        try:
            compile("\n".join(block.before) + "\n" + block.text, str(block), "exec")
        except SyntaxError as error:
            return str(error)
        return ""
    path = folder / ("block." + block.language)
    path.write_text(source_of(block))
    return shell([*COMPILERS[block.language], "-fsyntax-only", "-Wall", "-Wno-unused", "-I", ROOT / "src", "-I", ROOT / "src" / "api", path],
                 folder).stdout[-1500:]


def output_of(block, folder):
    """Of a program, linked to the library of LSDCD_LIBRARY; that of Python may end with an error."""
    library = os.environ["LSDCD_LIBRARY"]
    source = folder / f"run.{block.language}"
    source.write_text("\n".join(block.before + [block.text]))
    words = [sys.executable, source]
    if block.language != "python":
        words = [folder / "run"]
        done = shell([*COMPILERS[block.language], "-Wall", "-I", ROOT / "src" / "api", source, "-o", *words, library,
                      f"-Wl,-rpath,{os.path.dirname(library)}"], folder)
        if done.stdout:
            return done.stdout
    return shell(words, folder, PYTHONPATH=str(ROOT / "src" / "api"), LSDCD_POTENTIALS=str(ROOT / "potentials")).stdout


def test_code(folder):
    stl.write(folder / "wall.stl", cube(1))
    stl.write(folder / "body.stl", cube(1, size=0.5))
    for block in blocks_of("python", *COMPILERS):
        if block.run:
            page = block.page.blocks
            wanted = next(other.text for other in page[page.index(block):] if other.language == "text")
            printed = output_of(block, folder)
            fact(f"{block}: prints what the page has", printed == wanted, printed)
        elif block.language == "python" and is_of_users(block.page):
            printed = output_of(block, folder)
            fact(f"{block}: runs", "Traceback" not in printed, printed[-1500:])
        else:
            problem = problem_of(block, folder)
            fact(f"{block}: {block.language} compiles", not problem, problem)


# ---- commands ----------------------------------------------------------------------------

helps = {}


def wrong_words(words):
    """What is wrong with a command of lsdcd by its help; an empty string: nothing."""
    if not words or words[0] in ("--help", "--version", "COMMAND", "..."):
        return ""
    at = 2 if words[0] == "generate" and len(words) > 1 and re.fullmatch(r"[a-z]+", words[1]) else 1
    key = tuple(words[:at])
    if key not in helps:
        done = command.run(ROOT, *key, "--help")
        helps[key] = done.returncode == 0 and set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", done.stdout)) or None
    if helps[key] is None:
        return f"there is no lsdcd {' '.join(key)}"
    bad = [word for word in words[at:] if re.match(r"--?[a-zA-Z]", word) and word not in helps[key]]
    return f"lsdcd {' '.join(key)} has no {' '.join(bad)}" if bad else ""


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


def of_tool(text):
    """Words behind `lsdcd` of the commands of a shell script."""
    return [words[1:] for words in commands_of(text) if os.path.basename(words[0]) == "lsdcd"]


def quick(words):
    """The command with options that make it quick, in place of the page's."""
    options = QUICK.get(words[0], "").split()
    for name, value in zip(options[::2], options[1::2]):
        if name in words:
            words[words.index(name) + 1] = value
        else:
            words += [name, value]
    return words


def test_commands(monkeypatch):
    monkeypatch.setenv("LSDCD_POTENTIALS", str(ROOT / "potentials"))
    for block in blocks_of(*SHELL):
        if is_of_users(block.page):    # they run below
            continue
        with tempfile.TemporaryDirectory() as name:
            place = pathlib.Path(name)
            stl.write(place / "wall.stl", cube(1))
            stl.write(place / "body.stl", cube(1, size=0.5))
            command.run(place, "convert", "wall.stl", "-o", "wall.obj")
            (place / "points.csv").write_text("x,y,z\n0.5,0.5,1.05\n3,3,3\n")
            (place / "path.txt").write_text("0.5 0.5 0.5\n3 0 0\n")
            for words in of_tool(block.text):
                done = command.run(place, *quick(words))
                # repair ends with 3 where something is left, which is no error.
                fact(f"{block}: lsdcd {' '.join(words)[:60]}", done.returncode in (0, 3), done.stderr[-300:])


ALONE = ("README.md", "doc/tutorial.md", "doc/recipes.md", "doc/choosing.md")    # whose commands other tests run


def test_commands_of_users(folder):
    """Each page in a folder of its own, which has the programs and the examples where the top of the sources has them."""
    chosen = {}
    for block in blocks_of(*SHELL):
        if is_of_users(block.page) and block.page.path not in ALONE:
            chosen.setdefault(block.page.path, []).append(block.text)
    fact("pages have commands", len(chosen) >= 3, " ".join(chosen))
    for path, texts in chosen.items():
        place = folder / pathlib.Path(path).stem
        top_of_sources(place)
        shutil.copy(ROOT / "examples" / "from-liggghts" / "in.conveyor.liggghts", place / "in.mine")
        shell([sys.executable, ROOT / "examples" / "from-liggghts" / "make_meshes.py"], place)
        text = "".join(texts)
        if lmp.QUICK:
            text = re.sub(r"^(lsdcd tradeoff .*) --seconds 20$", rf"\1 {QUICK['tradeoff']}", text, flags=re.M)
        done = shell(["bash", "-ec", text], place, PATH=f"{pathlib.Path(lmp.LMP).parent}:{os.environ['PATH']}",
                     LSDCD_POTENTIALS=str(ROOT / "potentials"))
        fact(f"every command of {path} ends well", done.returncode == 0, done.stdout[-1500:] if done.returncode else "")


def test_words_of_commands():
    """Those of lsdcd, of ./run, and files of the repository, in blocks and between words."""
    told, count = shell([ROOT / "run", "help"], ROOT).stdout, 0
    for page in all_pages().values():
        shown = [(str(block), block.text) for block in page.blocks if block.language in SHELL]
        if page.path != "doc/troubleshooting.md":    # whose messages begin with lsdcd
            prose = re.sub(r"^```.*?^```", "", page.text, flags=re.M | re.S)
            inline = re.findall(r"(?<!`)``?((?:\S*/)?(?:lsdcd|lmp-lsdcd) [^`\n]+|\./run [^`\n]+)``?", prose)
            count += len(inline)
            shown += [(f"{page.path}: {text}", text) for text in inline]
        for where, text in shown:
            wrong = [wrong_words(words) for words in of_tool(text)]
            text = re.sub(r"#.*", "", text)
            wrong += [f"{word}: not in ./run help" for word in re.findall(r"\./run ([\w-]+)", text)
                      if word != "help" and f"  ./run {word} " not in told]
            wrong += [f"{path}: no such file" for path in re.findall(r"(?<![\w/.-])(?:\.\./)*((?:examples|tests|bench|cmake|doc|potentials)/[\w./-]*\w)", text)
                      if not (ROOT / path).exists()]
            if any(wrong):
                fact(where, False, "; ".join(filter(None, wrong)))
    fact("there are commands between words", count > 20, count)


# ---- figures -----------------------------------------------------------------------------

# What only rows of doc/data may say about settings: a time, or which is faster.
TIMED = re.compile(r"[\d.]+ (?:ns|µs|ms)\b|\b(?:fastest|faster|slower|quicker)\b|costs? no time", re.I)
MADE = re.compile(r"<!-- ([\w-]+):begin -->.*?<!-- \1:end -->", re.S)


def bench_pages():
    """bench/pages.py, whose name is that of a module here, too."""
    spec = importlib.util.spec_from_file_location("bench_pages", ROOT / "bench" / "pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_figures():
    figures = bench_pages()
    made = figures.tables()
    text = {page: (figures.DOC / page).read_text() for page in made}
    stale = [f"{page}: {name}" for page, its in made.items() for name, each in its.items()
             if figures.replaced(text[page], name, each) != text[page]]
    fact("the pages hold what the rows of doc/data say", not stale, f"bench/pages.py writes {', '.join(stale)}" if stale else "")
    of_readme = next(line for line in text["../README.md"].split("\n") if line.startswith("|") and line.endswith("[accuracy](doc/accuracy.md) |"))
    for name, words in (("README's promise on accuracy", of_readme), ("doc/accuracy.md", text["accuracy.md"])):
        beside = TIMED.findall(MADE.sub("", words))
        fact(f"{name} speaks of time as its rows do", MADE.search(words) and not beside, str(beside))


# ---- scripts -----------------------------------------------------------------------------

# Two molecules of four atoms, each the other moved by 1 along x; no two molecules touch.
PLACES = [(-0.5, 0, 0), (-0.4, 0, 0), (-0.5, 0.1, 0), (-0.5, 0, 0.1)]
SCENE = """\
units           si
atom_style      sphere
atom_modify     map array
comm_modify     vel yes cutoff 0.5
boundary        f f f
newton          off
fix             molecules all property/atom mol ghost yes
region          box block -2 2 -2 2 -2 2
create_box      2 box
""" + "".join(f"create_atoms    1 single {x + move} {y} {z}\n" for move in (0, 1) for x, y, z in PLACES) + """\
set             group all diameter 0.08 density 2500
set             atom 1*4 mol 1
set             atom 5*8 mol 2
group           grains type 1
group           clumps type 1
group           tool molecule 1
pair_style      zero 0.1
pair_coeff      * *
timestep        1e-7
thermo_style    custom step
"""
FIX = "fix w all wall/lsdcd hertz/history 1e5 NULL 50 NULL 0.5 1 mesh floor.stl"
# A LAMMPS that is older than heat stops there, when all words of the line have been read; a newer one if atoms have no temperature.
NO_HEAT = "the sub-model heat needs a LAMMPS with fix heat/flow"
NO_TEMPERATURE = "the sub-model heat needs a temperature and a heat flow per atom"
WARM = "fix warm all property/atom temperature heatflow ghost yes\nset group all temperature 300\n"


def run_heat(script, folder):
    """Once more without the lines with heat, where these cannot run, or with temperatures, where these are missing."""
    env = {"LSDCD_POTENTIALS": str(ROOT / "potentials")}
    done = lmp.run(script, folder, env=env)
    if NO_HEAT in done.stdout:
        return run_heat(re.sub(r"^fix (\S+) .* heat (radius|area) .*$", r"fix \1 all viscous 0", script, flags=re.M), folder)
    if NO_TEMPERATURE in done.stdout:
        return lmp.run(re.sub(r"^(?=fix \S+ .* heat (?:radius|area) )", WARM, script, count=1, flags=re.M), folder, env=env)
    return done


def keywords():
    """First words of the keywords of fix wall/lsdcd, from its help."""
    shown = shell([lmp.LMP, "-h"], ROOT).stdout
    return set(re.findall(r"^  ([a-z_]+) ", shown.split("keywords\n")[1].split("\n\n")[0], re.M))


def with_meshes(line, folder):
    """The line with meshes that are there: one file for each scale."""
    def replace(match):
        scale = re.match(r"(?:(?!\bmesh\b).)*?\bscale (\S+)", line[match.end():])
        name = f"{match[2]}_{scale[1] if scale else 1}.stl"
        half = 0.3 if match[2] == "box" else 1.2    # a box is inside of the others
        half /= float(scale[1] if scale else 1)
        faces = stl.box((-half,) * 3, (half,) * 3)
        stl.write(folder / name, faces[:2] if "insert/lsdcd mesh" in line else faces)
        return f"mesh{match[1]} {name}"
    return re.sub(r"\bmesh(/lsdcd|) ([\w-]+)\.(?:stl|obj|ply|off)\b", replace, line)


def script_of(block, folder, known):
    """Of single lines."""
    text = re.sub(r"&\s*\n\s*", " ", block.text)
    lines, fixes, computes = block.before + [""], set(), set()
    named = tuple(f"{prefix}_" for prefix in re.findall(r"\bnames (\w+)", text))    # variables that a fix or compute makes
    for name in sorted(set(re.findall(r"\bv_(\w+)", text)) - set(re.findall(r"variable +(\w+)", text))):
        if not name.startswith(named):
            lines.append(f"variable {name} equal 0.1")
    text = [line.split("#")[0].strip() for line in text.split("\n")]
    for line in filter(None, text):
        words = line.split()
        if words[0] in known:
            line = f"{FIX} {line}"
            words = line.split()
        uses = "w" not in fixes and (words[:2] == ["fix_modify", "w"] or re.search(r"\b[fF]_w\b", line))
        if uses or (words[:2] == ["fix_modify", "w"] and not ("names" in words and "w" in fixes)):    # each with as many meshes as it names
            second = " mesh lid.stl name lid scale 0.9" + " body density 1000 joint slider 0 0 1" * (" body " in line)
            lines += ["unfix w"] * ("w" in fixes) + [with_meshes(FIX + second * ("mesh 2" in line or "mesh lid" in line), folder)]
            fixes.add("w")
        if words[0] == "fix":
            lines += [f"unfix {words[1]}"] * (words[1] in fixes)
            fixes.add(words[1])
        if words[0] == "compute":
            lines += ["thermo_style custom step", f"uncompute {words[1]}"] * (words[1] in computes)
            computes.add(words[1])
        lines.append(with_meshes(line, folder))
        if words[0].startswith("fix"):
            lines.append("run 0 post no")
    return SCENE + "\n".join(lines) + "\nrun 0 post no\n"


def whole_script(page, block, folder):
    """Meshes are made by the commands that the page names in its text."""
    for words in re.findall(r"`(\S*lsdcd generate [^`]*)`", page.text):
        fact(f"{page.path}: {words}", command.run(folder, *shlex.split(words)[1:]).returncode == 0)
    return re.sub(r"^run +\d+", "run 0", block.text, flags=re.M)


def test_scripts(folder):
    known = keywords()
    (folder / "grain_atoms.txt").write_text("".join("%g %g %g\n" % place for place in PLACES))
    (folder / "arm.txt").write_text("0 0 0 0 0 0 0\n0.25 0.1 0 0.05 0 0.3 0\n")
    (folder / "cam.csv").write_text("0, 0\n0.1, 12.5\n0.2, 0\n")
    for block in blocks_of("lammps"):
        if re.match(r"# in\.\w+\n", block.text) or block.page.path == "README.md":    # a file of a recipe, and test_log's
            continue
        whole = re.match(r"units\b", block.text)
        done = run_heat(whole_script(block.page, block, folder) if whole else script_of(block, folder, known), folder)
        error = re.search(r"^ERROR.*(?:\n.*)?", done.stdout, re.M)
        fact(f"{block} runs", done.returncode == 0, error[0] if error else "")


@lmp.needs_host
def test_host(folder):
    """What needs a newer LAMMPS, as it stands, but for 0 steps."""
    lib = folder / "build-host" / "lib"
    lib.mkdir(parents=True)
    plugin = pathlib.Path(lmp.PLUGIN)
    for file in (plugin, plugin.with_name(plugin.stem + "-styles.so")):
        (lib / file.name.replace(plugin.stem, "lsdcdplugin")).symlink_to(file)
    blocks = [block for page in all_pages().values() for block in page.blocks if why_not_run(block) == NEWER]
    fact("there are such blocks", len(blocks) == 2, len(blocks))
    for block in blocks:
        (folder / "in.host").write_text(whole_script(block.page, block, folder))
        done = shell([lmp.HOST, "-in", "in.host"], folder)
        fact(f"{block} runs", done.returncode == 0, done.stdout[-500:])


# ---- recipes, log, tutorial --------------------------------------------------------------

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
    """A block of LAMMPS whose first line is `# in.NAME` is that file. The commands of the shell run in their order; what they print
    has the lines of the texts behind them. Beds of some hundred grains are chaotic: another compiler gives another bed, whose flow or
    torque may differ by a tenth and the largest stress of a facet by more, so that numbers of them are compared to a half, and shares
    to ten per cent of the whole; numbers of one grain to a hundredth. Without `within` runs have a fiftieth of their steps, and all
    that is asked is that commands end well."""
    page = Page(path)
    for block in page.blocks:
        name = re.match(r"# (in\.\w+)\n", block.text)
        if block.language == "lammps" and name:
            (folder / name[1]).write_text(block.text if within else STEPS.sub(
                lambda found: found[1] + str(math.ceil(int(found[2]) / 50)), block.text))
    for file in ("tutorial/stress.py", "films/in.hopper", "clumps/rod.mol"):
        shutil.copy(ROOT / "examples" / file, folder)
    text = "".join(block.text for block in page.blocks if block.language == "sh" and not why_not_run(block))
    done = shell(["bash", "-ec", text], folder, PATH=f"{pathlib.Path(lmp.LMP).parent}:{os.environ['PATH']}")
    fact(f"every command of {path} ends well", done.returncode == 0, done.stdout[-1500:] if done.returncode else "")
    wanted = [line for block in page.blocks if block.language == "text" and NUMBER.search(block.text) and ":" in block.text
              for line in block.text.strip().split("\n")]
    if within:
        compare(page, wanted, done.stdout, within)
    return done.stdout


def test_recipes(folder):
    printed = run_page(folder, "doc/recipes.md", None if lmp.QUICK else 0.5)
    # The energy that a body brings goes into two springs; what the grain's own motion takes of it is below a hundredth of the radius.
    pinched = re.findall(r"deepest overlap of this run is (\S+) %.*\n(?:.*\n)*?pinched: at \S+ m/s the bound is (\S+) %", printed)
    for deepest, bound in [] if lmp.QUICK else pinched:
        at_most("a pinched grain is as deep as the page's bound", abs(float(deepest) - float(bound)), 1)
    fact("two grains are pinched", lmp.QUICK or len(pinched) == 2, str(pinched))


def test_choosing(folder):
    run_page(folder, "doc/choosing.md", 0.01)


def test_log(folder):
    """The script of README runs by its commands, and its log has each line of doc/log.md, with other numbers. In the small samples it
    has fewer steps; else the last line of its table is that of the page, as far as beds are alike."""
    readme, page = Page("README.md"), Page("doc/log.md")
    script, told = (next(block.text for block in readme.blocks if block.language == language) for language in ("lammps", "text"))
    commands = next(block.text for block in readme.blocks if block.language == "sh" and "in.first" in block.text)
    fact("examples/tutorial/in.first is the script", (TUTORIAL / "in.first").read_text().endswith("\n\n" + script))
    top_of_sources(folder, "tutorial")
    if lmp.QUICK:
        script = script.replace("run             50000", "run 1500").replace("every 5000", "every 500")
    (folder / "examples" / "tutorial" / "in.first").write_text(script)
    done = shell(["bash", "-ec", commands], folder)
    fact("the commands end well", done.returncode == 0, done.stdout[-1500:] if done.returncode else "")
    if not lmp.QUICK:
        # The drum carries the weight and the change of momentum of 2718 grains, of which a snapshot has a tenth; drive and power are means
        # of a bed that sloshes.
        found = re.search(rf"^ +50000 +2718 +(\S+) +(\S+) +(\S+) *$", done.stdout, re.M)
        for value, wanted, within in zip(found.groups(), told.split()[2:], (0.2, 0.5, 0.5)):
            at_most(f"{wanted} of the page", abs(float(value) / float(wanted) - 1), within)
    printed = {" ".join(words_of(line).split()) for line in done.stdout.split("\n")}
    for block in page.blocks:
        missing = [line for line in block.text.strip().split("\n") if " ".join(words_of(line).split()) not in printed]
        fact(f"{block}: the log has these lines", block.language == "text" and not missing, "; ".join(missing))


def test_stress_of_recipes(tmp_path):
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
        done = subprocess.run([sys.executable, TUTORIAL / "stress.py", *words], cwd=tmp_path, text=True, capture_output=True)
        fact(f"stress.py {' '.join(words)}", done.returncode == code and (done.stdout + done.stderr).endswith(told), done.stdout + done.stderr)


def test_tutorial(folder):
    top_of_sources(folder)
    blocks = re.findall(r"^```sh\n(.*?)^```", (ROOT / "doc" / "tutorial.md").read_text(), re.M | re.S)
    # One heap for each rolling friction is enough to see that the commands work.
    text = "".join(blocks)
    fact("the page asks for several heaps", text.count("--seeds 3") == 1)
    # Its 150 000 steps are short. A process that gives up its core whenever it waits gets it back after milliseconds, where another
    # test runs.
    done = shell(["bash", "-ec", "set -o pipefail\n" + text.replace("--seeds 3", "--seeds 1")], folder, OMPI_MCA_mpi_yield_when_idle="0")
    fact("every command ends well", done.returncode == 0, done.stdout[-1500:] if done.returncode else "")
    text = done.stdout
    fact("the part is not clean", "clean       no: 2 duplicate facets, 8 edges" in text)
    fact("repair mends what the page says", all(
        line in text for line in ("welded      12 corners", "dropped     0 degenerate facets, 2 duplicates",
                           "turned      3 facets", "left        48 open edges in 2 boundaries")))
    allowed = float(re.search(r"^timestep +(\S+)", text, re.M)[1])
    used = float(re.search(r"^timestep +(\S+)", (TUTORIAL / "in.hopper").read_text(), re.M)[1])
    fact("the script takes less than the timestep that is told", 0.5 * allowed < used <= allowed, f"{allowed}")
    weight, borne = map(float, re.search(r"weight (\S+) N, .* carry (\S+) N", text).groups())
    # What still moves of 3000 grains that fell: their mean acceleration is below a hundredth of gravity.
    at_most("wall and plate carry the weight", abs(borne / weight - 1), 0.01)
    # Beverloo: 0.58 bulk_density sqrt(g) (D - 1.4 d)^2.5, bulk density 0.6 x 2500, D = 24 mm, d = 4 mm. For
    # outlets of 6 diameters his constants vary by a third from one material to another.
    beverloo = 0.58 * 1500 * 9.81**0.5 * (0.024 - 1.4 * 0.004) ** 2.5
    flow = float(re.search(r"^flow: (\S+)", text, re.M)[1])
    at_most("the flow is like Beverloo's law", abs(flow / beverloo - 1), 1 / 3)
    angles = [float(x) for x in re.findall(r"^\| 0\.\d+ \| (\S+) \|", text, re.M)]
    fact("rolling friction makes heaps steeper", len(angles) == 4 and angles == sorted(angles), str(angles))
    fact("plots and fields are there", all((folder / "build" / "tutorial" / name).exists()
                                         for name in ("repose/repose.png", "hopper_70000.vtp")))


def test_paraview(folder):
    missing = [name for name in ("pvpython", "xvfb-run") if not shutil.which(name)]
    if missing:
        pytest.skip(f"{' and '.join(missing)} missing, install paraview, python3-paraview and xvfb")
    shell([sys.executable, TUTORIAL / "make_meshes.py"], folder)
    shutil.copy(folder / "part.stl", folder / "hopper.stl")
    done = shell([lmp.LMP, "-in", TUTORIAL / "in.hopper", "-var", "fill", "10000", "-var", "drain", "2"], folder)
    fact("the hopper runs", done.returncode == 0, done.stdout[-500:] if done.returncode else "")
    # ParaView opens a display twice. A server that resets in between may refuse the second time.
    display = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]
    done = shell([*display, "pvpython", TUTORIAL / "view.py"], folder)
    fact("paraview draws", done.returncode == 0 and (folder / "wall_stress.png").exists(), done.stdout[-500:])
