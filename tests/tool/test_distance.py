# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""lsdcd distance against every triangle, one by one, in numpy, and against the closed form of a box; the
same answers for points in CSV, .npy and LAMMPS dumps; and memory that does not grow with the points."""
import math
import os
import subprocess
import sys

import numpy as np

import stl
from command import TOOL, refused, run, told
from facts import fact
from triangles import closest_on_triangle

DIAGONAL = math.sqrt(14)
# Distances are right to 4e-13 of the cutoff and 4e-15 of the diagonal (doc/library-queries.md), and the
# oracle's own rounding is some 1e-15 of the diagonal.
RADIUS = 1.0
DISTANCE = 4e-13 * RADIUS + 8e-15 * DIAGONAL


def brute_force(points, triangles):
    each = [closest_on_triangle(points, *t) for t in triangles]
    return np.array([e[1] for e in each]), np.array([e[0] for e in each])


def box_distance(points, hi):
    """Signed: below 0 inside the box from the origin to hi."""
    q = np.abs(points - hi / 2) - hi / 2
    return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)


def write_csv(path, points, head=""):
    path.write_text(head + "".join(",".join(map(repr, map(float, p))) + "\n" for p in points))


def write_dump(path, points, columns="x y z", box="pp pp pp", bounds=3 * ["0 1"]):
    """In two snapshots."""
    text = ""
    for step, part in enumerate(np.array_split(points, 2)):
        text += f"ITEM: TIMESTEP\n{100 * step}\nITEM: NUMBER OF ATOMS\n{len(part)}\n"
        text += f"ITEM: BOX BOUNDS {box}\n" + "\n".join(bounds) + f"\nITEM: ATOMS type id {columns}\n"
        text += "".join(f"1 {7 + i} " + " ".join(repr(float(x)) for x in p) + "\n"
                        for i, p in enumerate(part))
    path.write_text(text)


def peak_memory(folder, *words):
    """In bytes, of the tool alone: a small process starts it, as what starts it counts until then."""
    starter = ("import resource, subprocess, sys; done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL);"
               "print(done.returncode, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)")
    done = subprocess.run([sys.executable, "-S", "-c", starter, TOOL, *map(str, words)], cwd=folder, text=True,
                          stdout=subprocess.PIPE, env={**os.environ, "OMP_NUM_THREADS": "1"})
    return map(int, done.stdout.split())


def test_distance(folder):
    dice = np.random.default_rng(1)
    told(folder, "generate", "box", "--width", 1, "--depth", 2, "--height", 3, "-o", "box.stl")
    hi = np.array([1., 2, 3])
    points = dice.uniform([-1, -1, -1], hi + 1, (4000, 3))
    np.save(folder / "points.npy", points)
    write_csv(folder / "points.csv", points)
    write_dump(folder / "points.dump", points)

    said = told(folder, "distance", "box.stl", "points.npy", "--radius", RADIUS, "-o", "out.npy",
                "--block", 1000)
    out = np.load(folder / "out.npy")
    signed = box_distance(points, hi)
    near = np.abs(signed) < RADIUS
    fact("all are answered", len(out) == len(points) == said["points"])
    fact("distances are the closed form's",
         np.abs(out["distance"] - np.abs(signed))[near].max() <= DISTANCE)
    fact("nothing farther is found", np.all(np.isinf(out["distance"][~near])) and (~near).sum() > 0
         and said["found"] == near.sum() and np.all(out["closest"][~near] == points[~near])
         and np.all(out["triangle"][~near] == -1) and np.all(out["feature"][~near] == -1))
    fact("sides are, near and far", np.array_equal(out["side"], np.sign(signed)) and
         said["inside"] == (out["side"] == -1).sum() > 0)
    fact("closest points are as far as they say", np.abs(
        np.linalg.norm(points - out["closest"], axis=1) - out["distance"])[near].max() <= DISTANCE)
    fact("and lie on the box", np.abs(box_distance(out["closest"][near], hi)).max() <= DISTANCE)

    # A heap of random triangles: no two share anything, so that features are the triangle's own.
    triangles = dice.uniform(0, 1, (40, 1, 3)) * hi + dice.uniform(-.4, .4, (40, 3, 3))
    stl.write(folder / "heap.stl", triangles)
    said = told(folder, "distance", "heap.stl", "points.csv", "--cutoff", RADIUS, "-o", "heap.npy")
    heap = np.load(folder / "heap.npy")
    each, feet = brute_force(points, triangles)
    least = each.min(axis=0)
    found = least < RADIUS
    fact("an open mesh has no sides", "side" not in heap.dtype.names and not said["sides"])
    said = told(folder, "distance", "heap.stl", "points.csv", "--estimate-sides", "-o", "guess.npy")
    guess = np.load(folder / "guess.npy")
    fact("unless they are estimated, by winding numbers",
         np.array_equal(guess["estimated_side"], np.where(np.abs(guess["winding"]) > .5, -1, 1)) and
         "side" not in guess.dtype.names and not said["sides"] and
         said["estimated_inside"] == (guess["estimated_side"] == -1).sum() > 0)
    done = run(folder, "distance", "heap.stl", "points.csv", "--estimate-sides", "-o", "guess.csv")
    fact("and said not to be certified", "estimated, not certified" in done.stdout and
         (folder / "guess.csv").read_text().splitlines()[0].endswith("index,estimated_side,winding"), done.stdout)
    fact("distances are those of the nearest of all triangles",
         np.array_equal(np.isfinite(heap["distance"]), found) and
         np.abs(heap["distance"] - least)[found].max() <= DISTANCE)
    fact("triangles are the nearest ones", np.array_equal(heap["triangle"][found],
                                                          each.argmin(axis=0)[found]))
    nearest = feet[each.argmin(axis=0), np.arange(len(points))]
    # The foot on a line goes by the angle of the line: it is as right as the square root of nothing, but
    # of these triangles none is thinner than a hundredth.
    fact("closest points are its", np.abs(heap["closest"] - nearest)[found].max() <= 100 * DISTANCE)
    on_corner = np.array([np.abs(triangles[t] - p).max(axis=1).min() <= DISTANCE
                          for t, p in zip(heap["triangle"], heap["closest"])])
    fact("features are faces, edges and vertices, these at corners",
         set(heap["feature"][found]) == {0, 1, 2} and
         np.array_equal(on_corner[found], heap["feature"][found] == 2))

    for file, columns in (("points.csv", 0), ("points.dump", 2)):
        told(folder, "distance", "box.stl", file, "--radius", RADIUS, "-o", "other.npy")
        other = np.load(folder / "other.npy")
        fact(f"{file}: the same answers as from .npy",
             all(np.array_equal(other[name], out[name]) for name in out.dtype.names) and
             len(other.dtype.names) == len(out.dtype.names) + columns)
    fact("a dump's steps and atoms are told", other["timestep"].tolist() == 2000 * [0] + 2000 * [100] and
         np.array_equal(other["id"], np.tile(np.arange(2000) + 7, 2)))
    told(folder, "distance", "box.stl", "points.npy", "--radius", RADIUS, "-o", "out.csv")
    lines = (folder / "out.csv").read_text().splitlines()
    rows = [line.split(",") for line in lines[1:]]
    kinds = {"face": 0, "edge": 1, "vertex": 2, "none": -1}
    columns = (("distance", 0, float), ("triangle", 4, int), ("index", 6, int), ("side", 7, int),
               ("feature", 5, kinds.get))
    fact("CSV has the same answers, in all digits", lines[0] == "distance,closest_x,closest_y,closest_z,"
         "triangle,feature,index,side" and
         all([take(r[k]) for r in rows] == out[name].tolist() for name, k, take in columns) and
         [[float(x) for x in r[1:4]] for r in rows] == out["closest"].tolist())

    # A file begins with a byte order mark where a program on Windows wrote it. What a caller has as
    # x, y and z, one after the other, numpy keeps in Fortran order: here in four blocks.
    (folder / "mark.csv").write_bytes(b"\xef\xbb\xbf" + (folder / "points.csv").read_bytes())
    (folder / "mark_named.csv").write_bytes(b"\xef\xbb\xbfx,y,z\n" + (folder / "points.csv").read_bytes())
    np.save(folder / "fortran.npy", np.array([points[:, 0], points[:, 1], points[:, 2]]).T)
    for file in ("mark.csv", "mark_named.csv", "fortran.npy"):
        done = run(folder, "distance", "box.stl", file, "--radius", RADIUS, "-o", "other.npy", "--block", 1000)
        fact(f"{file}: the same answers as without", done.returncode == 0 and
             np.array_equal(np.load(folder / "other.npy"), out), done.stderr)
    # Unsigned bytes that would be negative as signed ones; the others on both sides of 0.
    told(folder, "generate", "box", "--width", 200, "--depth", 200, "--height", 200, "-o", "large.stl")
    for kind in ("i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f4"):
        whole = dice.integers(*((0, 255) if kind[0] == "u" else (-128, 127)), (500, 3)).astype(kind)
        for order in "CF":
            np.save(folder / "whole.npy", np.array(whole, order=order))
            done = run(folder, "distance", "large.stl", "whole.npy", "--radius", 1000, "-o", "other.npy")
            got = np.load(folder / "other.npy")["distance"] if done.returncode == 0 else np.array([np.inf])
            # In whole numbers a box's distance has rounding in its square root alone.
            wanted = np.abs(box_distance(whole.astype(float), np.array([200., 200, 200])))
            fact(f"{kind}, order {order}: distances are the closed form's",
                 np.abs(got - wanted).max() <= 4e-13 * 1000 + 8e-15 * 350, done.stderr)

    np.save(folder / "floats.npy", points.astype(np.float32))
    told(folder, "distance", "box.stl", "floats.npy", "--radius", RADIUS, "-o", "floats_out.npy")
    exact = np.abs(box_distance(points.astype(np.float32).astype(float), hi))
    answered = np.load(folder / "floats_out.npy")["distance"]
    fact("floats are exact points", np.abs(answered - exact)[np.isfinite(answered)].max() <= DISTANCE)
    # A comment may name them, as numpy.savetxt has it; one that does not name each column is none.
    for file, names in (("named.csv", "id; z; y; x"), ("capitals.csv", "ID; Z; Y; X"), ("comment.csv", "# id z y x")):
        (folder / file).write_text(f"# grains\n{names}\n" + "".join(
            f"{i}; {z!r}; {y!r}; +{x!r}\n" for i, (x, y, z) in enumerate((abs(points)).tolist())))
    np.save(folder / "abs.npy", abs(points))
    answers = []
    (folder / "prose.txt").write_text("# z y x of all grains, in metres\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in abs(points).tolist()))
    for file in ("named.csv", "capitals.csv", "comment.csv", "prose.txt", "abs.npy"):
        told(folder, "distance", "box.stl", file, "--radius", RADIUS, "-o", "named.npy")
        answers.append((folder / "named.npy").read_bytes())
    fact("columns go by their names", len(set(answers)) == 1)
    # A name or a value of nothing keeps its column, and one may have blanks in it.
    for name, head, row in (("index", ",x,y,z", "{i},{x!r},{y!r},{z!r}"),
                            ("gaps", "id,name,x,y,z,r", "{i},,{x!r},{y!r},{z!r},"),
                            ("blanks", "particle id, x, y, z", "{i}, {x!r}, {y!r}, {z!r}")):
        (folder / "columns.csv").write_text(head + "\n" + "".join(
            row.format(i=i, x=x, y=y, z=z) + "\n" for i, (x, y, z) in enumerate(abs(points[:50]).tolist())))
        told(folder, "distance", "box.stl", "columns.csv", "--radius", RADIUS, "-o", "columns.npy")
        fact(f"columns stay in place: {name}",
             np.array_equal(np.load(folder / "columns.npy"), np.load(folder / "named.npy")[:50]))
    unit = (points - (-1)) / (hi + 2)
    write_dump(folder / "scaled.dump", unit, "xs ys zs", bounds=["-1 2", "-1 3", "-1 4"])
    told(folder, "distance", "box.stl", "scaled.dump", "--radius", RADIUS, "-o", "scaled.npy")
    answered = np.load(folder / "scaled.npy")["distance"]
    both = np.isfinite(answered) & near
    fact("scaled coordinates go by the box", both.sum() >= near.sum() - 1 and
         np.abs(answered - np.abs(signed))[both].max() <= DISTANCE)
    told(folder, "distance", "box.stl", "points.npy", "--radius", 2, "--scale", 2, "-o", "double.npy")
    fact("--scale is the mesh's", np.nanmax(np.abs(np.load(folder / "double.npy")["distance"] - np.where(
        np.abs(box_distance(points, 2 * hi)) < 2, np.abs(box_distance(points, 2 * hi)), np.nan)))
        <= 4e-13 * 2 + 16e-15 * DIAGONAL)

    # Twenty times the points, in the memory of a few blocks: 24 bytes of each would be 24 MB more.
    used = []
    for n in (50000, 1000000):
        np.save(folder / "many.npy", dice.uniform(0, 1, (n, 3)))
        status, peak = peak_memory(folder, "distance", "box.stl", "many.npy", "--radius", .1, "--block",
                                   20000, "--device", "cpu", "-o", "many_out.npy")
        used.append(peak)
    fact("memory does not grow with the points", status == 0 and used[1] - used[0] < 4e6, used)

    done = run(folder, "distance", "box.stl", "points.npy", "--radius", 1, "-o", "out.npy", "--progress",
               "--block", 100)
    fact("--progress is on stderr", "points, " in done.stderr and "million/s" in done.stderr and
         "points per second" in done.stdout, done.stderr)
    fact("without, and with no terminal, nothing is",
         run(folder, "distance", "box.stl", "points.npy", "--radius", 1, "-o", "out.npy").stderr == "")

    told(folder, "distance", "box.stl", "points.npy", "-o", "any.npy", "--device", "cpu")
    anywhere = np.load(folder / "any.npy")
    fact("without --radius all are found, with the same bits",
         np.abs(anywhere["distance"] - np.abs(signed)).max() <= DISTANCE and
         all(np.array_equal(anywhere[name][near], out[name][near]) for name in out.dtype.names))
    piped = subprocess.run([TOOL, "distance", "box.stl", "-", "--radius", str(RADIUS), "-o", "-"], cwd=folder,
                           input=(folder / "points.csv").read_bytes(), capture_output=True)
    told(folder, "distance", "box.stl", "points.csv", "--radius", RADIUS, "-o", "file.csv")
    fact("- is the standard input and output, with nothing else between the answers",
         piped.returncode == 0 and piped.stdout == (folder / "file.csv").read_bytes() and
         b"points per second" in piped.stderr, piped.stderr.decode())
    piped = subprocess.run([TOOL, "distance", "box.stl", "-", "-o", "-"], cwd=folder, input=b"1,two,3\n",
                           capture_output=True, text=False)
    fact("an error in the standard input names it", piped.returncode == 1 and
         b"the standard input: line 1" in piped.stderr, piped.stderr.decode())

    for path in folder.glob("*out*"):
        path.unlink()
    words = ["distance", "box.stl", "points.csv", "-o", "new.csv"]
    for wrong in ("+-0.5", "1e400"):
        (folder / "wrong.csv").write_text(f"0,0,0\n{wrong},0,0\n")
        refused(folder, ["distance", "box.stl", "wrong.csv", "-o", "new.csv"], "line 2", f"'{wrong}'", "not a number")
    for name, x in ("tiny", "-1e-400"), ("zero", "0"):
        (folder / f"{name}.csv").write_text(f"{x},0,0\n")
        told(folder, "distance", "box.stl", f"{name}.csv", "-o", f"{name}_far.csv")
    fact("a number nearer to 0 than any other is 0",
         (folder / "tiny_far.csv").read_text().replace("-0,", "0,") == (folder / "zero_far.csv").read_text())
    refused(folder, [*words[:-1], "no/new.csv", "--radius", 1], "no/new.csv")
    refused(folder, [*words, "--radius", 1, "--device", "tpu"], "--device", code=2)
    if said["device"].startswith("CPU"):    # where there is a GPU, it is what answers
        refused(folder, [*words, "--radius", 1, "--device", "cuda"], "--device cuda", "--device cpu")
    whole = (folder / "points.npy").read_bytes()
    np.save(folder / "flat.npy", np.zeros(9))
    by_columns = (folder / "fortran.npy").read_bytes()
    np.save(folder / "complex.npy", np.zeros((3, 3), complex))
    np.save(folder / "big_endian.npy", np.zeros((3, 3), ">f8"))
    dump = (folder / "points.dump").read_text()
    for name, content, expected in (
            ("short.npy", whole[:-5], ["point 3999 of 4000"]),
            ("flat.npy", None, ["(9,)", "(n, 3)"]), ("short_columns.npy", by_columns[:-5], ["point 3999 of 4000"]),
            ("many_columns.npy", by_columns.replace(b"(4000, 3)", b"(4" + 18 * b"0" + b", 3)"), ["is truncated"]),
            ("complex.npy", None, ["<c16", "float64"]), ("big_endian.npy", None, [">f8", "little-endian"]),
            ("head.npy", whole[:50], ["header"]),
            ("junk.npy", whole[:100] + b"x x x x " + whole[100:], ["header", "x x x x"]),
            ("twice.npy", whole.replace(b"'fortran_order'", b"'shape': (9, 3)", 1), ["header", "(9, 3)"]),
            ("later.npy", whole[:6] + b"\x04" + whole[7:], ["version 4.0"]),
            ("behind.npy", whole + b"12345678", ["goes on behind the 4000 points"]),
            ("behind_columns.npy", by_columns + b"12345678", ["goes on behind the 4000 points"]),
            ("word.csv", b"0,0,0\n1,two,3\n", ["line 2", "'two'", "column 2"]),
            ("few.csv", b"0,0,0\n\n1,2\n", ["line 3", "2 columns"]),
            ("joined.txt", b"0 0 0\n1 2 3 4 5 6\n7 8 9\n", ["line 2", "has 6 columns, and line 1 has 3"]),
            ("names.csv", b"a,b,c\n1,2,3\n", ["line 1", "x"]),
            ("hole.csv", b"x,y,z\n1,,3\n", ["line 2", "nothing in column 2"]),
            ("hole3.csv", b"1,,2,3\n", ["line 1", "nothing in column 2"]),
            ("wide.csv", b"x,y,z\n0,1,2,3\n", ["line 2", "has 4 columns", "line 1 names 3"]),
            ("spaced.txt", b"grain id x y z\n0 1 2 3\n", ["line 2", "has 4 columns", "line 1 names 5"]),
            ("decimal.csv", b"x;y;z\n0,1;0,2;0,3\n", ["line 2", "both ',' and ';'", "decimal commas as points"]),
            ("half.csv", b"0,001;2;3\n", ["line 1", "decimal commas as points"]),
            ("blank.csv", b"0,1 0,2 0,3\n", ["line 1", "'1 0' in column 2"]),
            ("zeros.csv", bytes(100), ["neither"]),
            ("cut.dump", dump[:len(dump) // 2].rsplit("\n", 1)[0].encode(), ["ends after line", "atom"]),
            ("none.dump", dump.replace(" x y z", " vx y z").encode(), ["line 9", "no column x"]),
            ("tilted.dump", dump.replace("S pp", "S xy xz yz pp").replace(" x y z", " xs ys zs").encode(),
             ["line 9", "tilted"]),
            ("general.dump", dump.replace("S pp", "S abc origin pp").replace("0 1\n", "1 0 0 0\n").replace(
                " x y z", " xs ys zs").encode(), ["line 9", "tilted"]),
            ("odd.dump", dump.replace("ITEM: NUMBER", "NUMBER").encode(), ["line 3", "not ITEM"])):
        if content is not None:
            (folder / name).write_bytes(content)
        refused(folder, ["distance", "box.stl", name, "-o", "new.csv", "--radius", 1], name, *expected)
    (folder / "empty.csv").write_text("x,y,z\n")
    refused(folder, ["distance", "box.stl", "empty.csv", "--radius", 1, "-o", "none.npy"], "empty.csv", "no point")
