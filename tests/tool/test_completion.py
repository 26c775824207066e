# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What bash completes of lsdcd's words, with the file that is installed."""
import pathlib
import subprocess

from command import TOOL
from facts import fact

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "src" / "tool" / "lsdcd.bash"


def completed(*words):
    """The last one of them."""
    script = ('source "$1"; program=$2; shift 2; COMP_WORDS=(lsdcd "$@"); COMP_CWORD=$#; '
              '_lsdcd "$program"; printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-c", script, "bash", SCRIPT, TOOL, *words], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.stdout.split()


def test_completion():
    fact("commands", {"inspect", "repair", "convert", "generate", "distance", "material"} <= set(completed("")),
         completed(""))
    fact("commands by their beginning", completed("dist") == ["distance"], completed("dist"))
    fact("shapes", {"box", "screw"} <= set(completed("generate", "")), completed("generate", ""))
    fact("a command's options", {"--radius", "--cutoff", "--json", "--output", "-o"} <=
         set(completed("distance", "wall.stl", "-")), completed("distance", "wall.stl", "-"))
    fact("poses of a body", completed("collide", "wall.stl", "body.stl", "--po") == ["--pose", "--poses"],
         completed("collide", "wall.stl", "body.stl", "--po"))
    fact("a shape's options", completed("generate", "screw", "--pi") == ["--pitch"],
         completed("generate", "screw", "--pi"))
    fact("devices", completed("distance", "a", "b", "--device", "cu") == ["cuda"])
    fact("units", completed("convert", "a", "--units", "m") == ["m", "mm"])
    fact("files are left to bash", completed("inspect", "wall") == [])
