# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Every script of bad_scripts.py ends with one clear error, on one rank and on two; in the small samples on two only where the error is of
atoms or of a file, which one rank alone may see, and on one only elsewhere."""

import concurrent.futures

import bad_scripts
import lmp
import stl
from facts import fact

CRASHES = ("Segmentation", "signal", "Backtrace", "backtrace", "terminate called", "Aborted")

# Of one atom or its body, and one file of each kind, which the first rank reads.
SEEN_BY_ONE = ("collide_no_molecule", "collide_not_rigid", "collide_lost_atoms", "collide_sizes", "rmax_too_small", "material_bad_file",
               "missing_file", "motion_table_no_table", "collide_atoms_file", "massflow_missing_file", "truncated_mesh")
assert set(SEEN_BY_ONE) <= bad_scripts.CASES.keys()
AT_ONCE = 3    # others are tested beside


def check(case, ranks, done):
    name = f"{case} on {ranks} rank{'s' if ranks > 1 else ''}"
    errors = [line for line in done.stdout.split("\n") if line.startswith("ERROR")]
    message = errors[0] if errors else done.stdout[-500:]
    fact(f"{name}: stops", done.returncode != 0)
    fact(f"{name}: one error", len(errors) == 1, message)
    for words in bad_scripts.CASES[case][1]:
        fact(f"{name}: says '{words}'", words in message)
    for crash in CRASHES:
        if crash in done.stdout:
            fact(f"{name}: does not crash", False, crash)


def tetrahedra(*shells):
    """Each from x on, by its winding."""
    triangles = []
    for x, turn in shells:
        p = [(x, 0, 0), (x + 1, 0, 0), (x, 1, 0), (x, 0, 1)]
        triangles += [[p[k] for k in face[::turn]] for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))]
    return triangles


def knot():
    """A box whose first corner goes through the face across."""
    p = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    p[0] = (2, 0.5, 0.25)
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [t for face in faces for t in stl.quad(*(p[k] for k in face))]


def test_one_error(folder):
    floor = (lmp.HERE / "scripts" / "floor.stl").read_bytes()
    for name in ("floor.stl", "lid.stl"):
        (folder / name).write_bytes(floor)
    (folder / "bad.lsdcd").write_text("units si\nmaterial glass\n  youngs_modulus soft Pa\n")
    (folder / "endless.lsdcd").write_text("units si\ninclude /dev/zero\n")
    (folder / "points.txt").write_text("0 0 0\n1 0 0\n0 1 0\n")
    (folder / "unit.txt").write_text("0 0 0\n1 0 0\n0 1 0\n\n0 0 1\n")
    (folder / "truncated.stl").write_bytes(floor[:len(floor) // 2])
    stl.write(folder / "two.stl", tetrahedra((0, 1), (2, -1)))
    stl.write(folder / "both.stl", tetrahedra((0, 1), (0, -1)))
    stl.write(folder / "cut.stl", tetrahedra((0, 1), (0.5, 1)))
    stl.write(folder / "knot.stl", knot())
    stl.write(folder / "line.stl", [((0, 0, 0), (1, 0, 0), (2, 0, 0))])
    for case, (script, _) in bad_scripts.CASES.items():
        (folder / f"in.{case}").write_text(script)
    scripts = [(case, ranks) for case in sorted(bad_scripts.CASES) for ranks in (1, 2)
               if not lmp.QUICK or ranks == 1 + (case in SEEN_BY_ONE)]
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as some:
        runs = [some.submit(lmp.run, folder / f"in.{case}", folder, ranks=ranks, timeout=120)
                for case, ranks in scripts]
        for (case, ranks), run in zip(scripts, runs):
            check(case, ranks, run.result())
