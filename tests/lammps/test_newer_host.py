# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The styles compile for a LAMMPS whose Modify has no lists: 13Nov2026 removes nfix, fix, fmask, find_fix and those of computes.

No such LAMMPS could be had, so it is 4Jul2026 with a modify.h of its own, in which these members are private. LSDCD_HOST is the folder of
hosts/build_host.sh."""
import os
import pathlib
import re
import shutil
import subprocess

import lmp
from facts import fact

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MEMBERS = r"^ +(int nfix,|Fix \*\*fix;|int \*fmask;|int ncompute,|Compute \*\*compute;|int find_(fix|compute)\().*$"


@lmp.needs_host
def test_newer_host(tmp_path):
    host = pathlib.Path(os.environ["LSDCD_HOST"])
    text, members = re.subn(MEMBERS, r" private:\n\g<0>\n public:", (host / "src/modify.h").read_text(encoding="utf-8"), flags=re.M)
    fact("modify.h has the lists", members >= 7, members)
    (tmp_path / "modify.h").write_text(text, encoding="utf-8")
    mpi = subprocess.run(["mpicxx", "--showme:compile"], check=True, capture_output=True, text=True).stdout.split() if shutil.which("mpicxx") else []
    words = ["c++", "-fsyntax-only", "-std=c++20", "-I", ROOT / "src", "-I", ROOT / "kokkos", "-I", tmp_path, "-isystem", host / "src",
             *mpi, "-DLSDCD_HOST_VERSION=20260704", "-DLAMMPS_SMALLBIG", "-DOMPI_SKIP_MPICXX", "-DMPICH_SKIP_MPICXX"]
    kokkos = ["-isystem", host / "src/KOKKOS", "-isystem", host / "kokkos/include", "-DLMP_KOKKOS", "-DLMP_KOKKOS_LAYOUT_LEGACY",
              "-DLMP_KOKKOS_DOUBLE_DOUBLE"]
    folders = [(ROOT / "src/lammps", []), (ROOT / "kokkos", kokkos)]
    if not (host / "kokkos/include").exists():
        folders.pop()
    for folder, more in folders:
        sources = [path for path in sorted(folder.glob("*.cpp")) if "host_fixes.h" in path.read_text(encoding="utf-8")]
        fact(f"{folder.name}: fixes and computes are asked for", len(sources) > 1, sources)
        # As one file: LAMMPS's headers take most of the time.
        together = tmp_path / f"{folder.name}.cpp"
        together.write_text("".join(f'#include "{path}"\n' for path in sources), encoding="utf-8")
        done = subprocess.run([*words, *more, together], capture_output=True, text=True)
        fact(f"{folder.name}: {len(sources)} files compile", done.returncode == 0, done.stderr[-1500:])
