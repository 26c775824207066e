# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Every C, C++ and Python code block of the pages compiles, and programs that say so print what the page has;
tests/tool/pages.py says what a block is.

Statements become the body of a function. Definitions stand as they are: what a comment before them opens is closed.
"""
import os
import pathlib
import re
import subprocess
import sys

from facts import fact

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "tool"))
from pages import all_pages    # noqa: E402

COMPILERS = {"c": [os.environ.get("LSDCD_C", "cc"), "-std=c99"], "cpp": [os.environ.get("LSDCD_CXX", "c++"), "-std=c++17"]}


def source_of(block):
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
    path = pathlib.Path(folder) / ("block." + block.language)
    path.write_text(source_of(block))
    done = subprocess.run([*COMPILERS[block.language], "-fsyntax-only", "-Wall", "-Wno-unused", "-I", ROOT / "src", "-I",
                           ROOT / "src" / "api", path], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout[-1500:] if done.returncode or done.stdout else ""


def output_of(block, folder):
    """Of a program, linked to the library of LSDCD_LIBRARY."""
    library = os.environ["LSDCD_LIBRARY"]
    source, program = pathlib.Path(folder) / f"run.{block.language}", pathlib.Path(folder) / "run"
    source.write_text(block.text)
    words = [sys.executable, source]
    if block.language != "python":
        subprocess.run([*COMPILERS[block.language], "-I", ROOT / "src" / "api", source, "-o", program, library,
                        f"-Wl,-rpath,{os.path.dirname(library)}"], check=True)
        words = [program]
    done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "src" / "api")})
    return done.stdout


def wanted_of(block):
    """What the page says that it prints."""
    blocks = block.page.blocks
    return next(other.text for other in blocks[blocks.index(block):] if other.language == "text")


def test_blocks(folder):
    count = 0
    for page in all_pages().values():
        for block in page.blocks:
            if block.form or block.language not in ("python", *COMPILERS):
                continue
            count += 1
            problem = problem_of(block, folder)
            fact(f"{block}: {block.language} compiles", not problem, problem or "")
            if block.run:
                printed = output_of(block, folder)
                fact(f"{block}: prints what the page has", printed == wanted_of(block), printed)
    fact("there are blocks", count > 0)
