#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks that each job of .github/workflows/tests.yml is a command that `./run help` names, on a Debian that has a name,
with a limit of minutes, and that the workflow runs the commands of its rows and nothing else.

usage: check_workflow.py [ROOT]

Prints one line per violation, and exits with 1 if there is one.
"""
import pathlib
import re
import subprocess
import sys

WORKFLOW = ".github/workflows/tests.yml"
# A value of a row ends at a comma or at the brace, unless it is in quotes.
VALUE = r'(?:"([^"]*)"|([^,}]*))'
NEEDED = {"name": r"\S.*", "container": r"debian:(?:bookworm|trixie)", "command": r"\./run\b.*", "minutes": r"[1-9]\d*"}
# The first two are what checks the sources out.
STEPS = (r"apt-get update && apt-get install [^|;&]*", r"git config --global --add safe\.directory .*", r"\|")


def rows(text):
    """The rows of the matrix, each as a dictionary of its words."""
    for line in re.findall(r"^ +- \{(.*)\}$", text, re.M):
        yield {key: quoted or plain.strip() for key, quoted, plain in re.findall(r"(\w+): " + VALUE, line)}


def violations(text, help_text):
    jobs = list(rows(text))
    if not jobs:
        yield f"{WORKFLOW}: has no rows"
    for job in jobs:
        name = job.get("name", "a row without a name")
        for key, form in NEEDED.items():
            if not re.fullmatch(form, job.get(key, "")):
                yield f"{WORKFLOW}: {name}: {key} is '{job.get(key, '')}'"
        # A word that ./run does not know would be taken for a pattern of tests: the help has it in full.
        command = job.get("command", "")
        if not re.search(rf"(?m)^  (?:.*, )?{re.escape(command)}(?=  | [a-z]|,|$)", help_text):
            yield f"{WORKFLOW}: {name}: ./run help does not name '{command}'"
    names = [job.get("name") for job in jobs]
    if len(set(names)) < len(names):
        yield f"{WORKFLOW}: two rows have one name"
    for step in re.findall(r"^ +(?:- )?run: (.*)$", text, re.M):
        if not any(re.fullmatch(form, step) for form in STEPS):
            yield f"{WORKFLOW}: a step runs '{step}', which is no row's command"
    if text.count("${{ matrix.command }}") != 2:    # its name, and itself
        yield f"{WORKFLOW}: no step runs the commands of the rows"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2])
    help_text = subprocess.run([root / "run", "help"], check=True, text=True, stdout=subprocess.PIPE).stdout
    found = list(violations((root / WORKFLOW).read_text(encoding="utf-8"), help_text))
    print("\n".join(found) if found else f"{WORKFLOW}: each job is a command of ./run")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
