# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What lsdcd says to words that it does not know, and how a file that is no mesh is refused."""

import os
import pathlib
import re
import resource
import subprocess
import tempfile

from facts import fact

TOOL = os.environ["LSDCD_TOOL"]
MAN_PAGE = pathlib.Path(__file__).resolve().parents[2] / "src" / "tool" / "lsdcd.1"
FLOOR = str(pathlib.Path(__file__).resolve().parent.parent / "lammps" / "scripts" / "floor.stl")


# A sanitizer takes all addresses for itself.
SANITIZED = b"__asan_init" in pathlib.Path(TOOL).read_bytes()


def run(*words):
    def at_most_a_gigabyte():
        if not SANITIZED:
            resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))

    return subprocess.run([TOOL, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, preexec_fn=at_most_a_gigabyte)


def test_words():
    done = run("bogus", FLOOR)
    fact("an unknown command is named, and the known ones",
         done.returncode != 0 and "'bogus' is not a command" in done.stdout
         and "inspect" in done.stdout and "tradeoff" in done.stdout, done.stdout)
    done = run("--version")
    fact("--version is a number", done.returncode == 0
         and re.fullmatch(r"lsdcd \d+\.\d+\.\d+( \([^()]+\))?\n", done.stdout) is not None, done.stdout)
    commands = re.findall(r"^  (\w+) {3,}(.*)$", run("--help").stdout.split("Subcommands:")[1], re.M)
    fact("the man page has the commands with what they are for",
         len(commands) > 10 and re.findall(r"^\.TP\n\.B ([a-z]+)\n(\w.*)$", MAN_PAGE.read_text(), re.M) == commands)
    with tempfile.NamedTemporaryFile(suffix=".stl") as zeros:
        zeros.truncate(1 << 36)
        done = run("inspect", zeros.name)
        fact("64 GB of zeros are refused in less memory",
             done.returncode == 1 and "not an STL" in done.stdout, done.stdout[-200:])
