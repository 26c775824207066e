#!/usr/bin/env python3
"""Every deck in bad_decks/ ends with one clear error, on one rank and on two.

The first line of a deck gives words that the message must have, split by " | "
between bars; a bar inside a word is written with spaces around it.
"""

import concurrent.futures
import re

import deck

CRASHES = ("Segmentation", "signal", "Backtrace", "backtrace", "terminate called", "Aborted")


AT_ONCE = 3    # others are tested beside


def check(checks, path, ranks, done):
    expected = re.split(r"(?<! )\|(?! )", path.read_text().split("\n")[0].split(":", 1)[1].strip())
    name = f"{path.name[3:]} on {ranks} rank{'s' if ranks > 1 else ''}"
    errors = [line for line in done.stdout.split("\n") if line.startswith("ERROR")]
    message = errors[0] if errors else done.stdout[-500:]
    checks.fact(f"{name}: stops", done.returncode != 0)
    checks.fact(f"{name}: one error", len(errors) == 1, message)
    for words in expected:
        checks.fact(f"{name}: says '{words}'", words in message)
    for crash in CRASHES:
        if crash in done.stdout:
            checks.fact(f"{name}: does not crash", False, crash)


def tetrahedra(*shells):
    """Each from x on, by its winding."""
    text = "solid two\n"
    for x, turn in shells:
        p = [(x, 0, 0), (x + 1, 0, 0), (x, 1, 0), (x, 0, 1)]
        for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)):
            text += "facet normal 0 0 0\nouter loop\n"
            text += "".join("vertex %g %g %g\n" % p[k] for k in face[::turn]) + "endloop\nendfacet\n"
    return text + "endsolid two\n"


def knot():
    """A box whose first corner goes through the face across."""
    p = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    p[0] = (2, 0.5, 0.25)
    text = "solid knot\n"
    for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
        for face in ((a, b, c), (a, c, d)):
            text += "facet normal 0 0 0\nouter loop\n"
            text += "".join("vertex %g %g %g\n" % p[k] for k in face) + "endloop\nendfacet\n"
    return text + "endsolid knot\n"


def main():
    checks, folder = deck.Checks(), deck.scratch()
    floor = (deck.HERE / "decks" / "floor.stl").read_bytes()
    for name in ("floor.stl", "lid.stl"):
        (folder / name).write_bytes(floor)
    (folder / "bad.lsdcd").write_text("units si\nmaterial glass\n  youngs_modulus soft Pa\n")
    (folder / "points.txt").write_text("0 0 0\n1 0 0\n0 1 0\n")
    (folder / "unit.txt").write_text("0 0 0\n1 0 0\n0 1 0\n\n0 0 1\n")
    (folder / "truncated.stl").write_bytes(floor[:len(floor) // 2])
    (folder / "two.stl").write_text(tetrahedra((0, 1), (2, -1)))
    (folder / "cut.stl").write_text(tetrahedra((0, 1), (0.5, 1)))
    (folder / "knot.stl").write_text(knot())
    (folder / "line.stl").write_text("solid s\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                     "vertex 2 0 0\nendloop\nendfacet\nendsolid s\n")
    decks = [(path, ranks) for path in sorted((deck.HERE / "bad_decks").glob("in.*")) for ranks in (1, 2)]
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as some:
        runs = [some.submit(deck.run, path, folder, ranks=ranks, timeout=120) for path, ranks in decks]
        for (path, ranks), run in zip(decks, runs):
            check(checks, path, ranks, run.result())
    checks.done(folder)


if __name__ == "__main__":
    main()
