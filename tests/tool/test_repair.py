# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""lsdcd repair of broken meshes: the file is clean or what is left is named, and no point of the old
surface is farther from the new one than it says, nor the other way round."""
import json

import numpy as np

import stl
from command import refused, run, told
from facts import fact
from triangles import cube, edges_of, grid, one_sided, sphere, volume

WELD = 1e-6    # of the diagonal of a part, as doc/tool.md has it
NOTHING = ("welded_corners", "degenerate_facets", "duplicate_facets", "split_facets", "turned_facets", "moved")
OPEN, MANY, AGAINST, MEET = ("open edges", "edges of more than two facets",
                             "edges along which windings disagree",
                             "pairs of facets that cut, overlap or touch")


def dice():
    return np.random.default_rng(5)


def turned(triangles, share=1.):
    t = np.array(triangles)
    which = dice().random(len(t)) < share
    t[which] = t[which][:, ::-1]
    return t


def diagonal(triangles):
    points = np.asarray(triangles).reshape(-1, 3)
    return np.linalg.norm(points.max(axis=0) - points.min(axis=0))


def triangles_of(path):
    """Of either kind of STL."""
    data = path.read_bytes()
    if not data.startswith(b"solid"):
        return np.array(stl.read(path))
    rows = [line.split()[1:] for line in data.decode().splitlines() if line.startswith("vertex")]
    return np.array(rows, float).reshape(-1, 3, 3)


def left_of(triangles):
    """The kinds that edges tell, by counting them here."""
    edges = list(edges_of(triangles).values())
    # Where solids touch along an edge half of its facets run each way.
    many = [e for e in edges if len(e) > 2 and 2 * sum(way for _, way in e) != len(e)]
    count = {OPEN: sum(len(e) == 1 for e in edges), MANY: len(many),
             AGAINST: sum(len(e) == 2 and e[0][1] == e[1][1] for e in edges)}
    return {kind: n for kind, n in count.items() if n}


def check(folder, name, triangles, did=(), left=None, within=1., enclosed=None, words=(), largest=None):
    """`did`: counts that are told, or those that are above 0, others of NOTHING being 0; `left`: kinds
    and counts, None of edges where edges tell them; `within`: moved by no more tolerances than that;
    `enclosed`: volume; `largest`: the largest part, if it is not all."""
    triangles = np.asarray(triangles, float)
    stl.write(folder / "in.stl", triangles)
    (folder / "out.stl").unlink(missing_ok=True)
    done = run(folder, "repair", "in.stl", "-o", "out.stl", "--json", *words)
    fact(f"{name}: written", done.returncode in (0, 3), done.stderr)
    said = json.loads(done.stdout)
    out = triangles_of(folder / "out.stl")
    did = did if isinstance(did, dict) else dict.fromkeys(did)
    counts = {k: said[k] for k in NOTHING if k != "moved"}
    fact(f"{name}: what it did", all(said[k] > 0 if n is None else said[k] == n for k, n in did.items()) and
         all(n == 0 or k in did for k, n in counts.items()), (did, counts))
    named = {u["what"]: u["count"] for u in said["left"]}
    by_edges = {k: n for k, n in named.items() if k != MEET}
    fact(f"{name}: what is left is named", by_edges == left_of(out) and (left is None or named == left), named)
    fact(f"{name}: its exit code", done.returncode == (0 if set(named) <= ({OPEN} if words else set()) else 3),
         done.returncode)
    seen = told(folder, "inspect", "out.stl")
    unclean = {MANY, AGAINST} | ({MEET} if seen["closed"] else set())    # open walls may touch themselves
    fact(f"{name}: clean, or it is said why not",
         seen["clean"] == (not unclean & set(named)) and seen["closed"] == (not {OPEN, MANY} & set(named)),
         (seen["problems"], named))
    # Points in plain doubles are off by the last digits of their coordinates, and the distance by a few
    # times that.
    rounding = 1e-14 * np.abs(triangles).max()
    there, back = one_sided(triangles, out), one_sided(out, triangles)
    fact(f"{name}: moved no farther than it says", max(there, back) <= said["moved"] + rounding,
         (there, back, said["moved"]))
    tolerance = WELD * diagonal(triangles if largest is None else np.asarray(largest, float))
    fact(f"{name}: nor farther than need be", said["moved"] <= within * tolerance + rounding and
         abs(said["tolerance"] - tolerance) <= 1e-12 * tolerance, (said["moved"], tolerance))
    old = {tuple(p) for p in triangles.reshape(-1, 3).tolist()}
    fact(f"{name}: corners are those of the old mesh", {tuple(p) for p in out.reshape(-1, 3).tolist()} <= old)
    if enclosed is not None:
        fact(f"{name}: volume", abs(volume(out) - enclosed) <= 1e-5 * abs(enclosed), (volume(out), enclosed))
    done = run(folder, "repair", "out.stl", "-o", "again.stl", "--json", *words)
    again = json.loads(done.stdout)
    if AGAINST in named:    # of a one-sided part, it may part other facets
        return said, out
    fact(f"{name}: again changes nothing", all(again[k] == 0 for k in NOTHING) and
         np.array_equal(triangles_of(folder / "again.stl"), out), {k: again[k] for k in NOTHING})
    return said, out


def moebius(n=24):
    def place(u, v):
        if u == 1:
            u, v = 0, 1 - v    # the ends meet
        a, w = 2 * np.pi * u, v - 0.5
        r = 1 + w * np.cos(a / 2) / 2
        return r * np.cos(a), r * np.sin(a), w * np.sin(a / 2) / 2
    return grid(n, 2, place)


def equal_pieces():
    """A piece of a facet that is cut equals another facet and goes; what was its neighbour is open again."""
    return [[(.24979, .50022, .99973), (.74977, .75021, .99995), (.24981, 1.00012, 1.00021)],
            [(.99981, 1.00002, 1.00005), (1.00018, .24968, .0001), (.75032, .24977, .99982)],
            [(.4997, .5, 1.00028), (.99999, .24968, -.0001), (.99973, .24987, -.00031)],
            [(.50006, .99969, 1.00025), (.99999, .74998, -.00004), (.25033, 1.00025, .99975)],
            [(.24992, .99995, 1.0001), (-.00025, .49976, .99988), (.99991, .2499, -.00029)],
            [(.4999, .49985, -.0002), (1.00014, .24967, -.00024), (.25023, 1.00008, 1.00013)],
            [(.00021, .24979, .99999), (.00032, .00005, .00004), (.2499, 1.00027, .99979)]]


def test_repair(folder):
    n = 5
    ball, box = sphere(n), cube()
    ball = ball.astype(np.float32).astype(float)
    solid = volume(ball)
    said, out = check(folder, "nothing to mend", ball, left={}, within=0, enclosed=solid)
    fact("it is the same to the last bit", np.array_equal(out, ball))
    fact("and binary, as all are floats", not (folder / "out.stl").read_bytes().startswith(b"solid"))
    said, out = check(folder, "doubles stay doubles", sphere(n) / 3, left={}, within=0)
    fact("in text", np.array_equal(out, sphere(n) / 3))

    far = ball + dice().uniform(-1, 1, ball.shape) * 0.2 * WELD * diagonal(ball)
    check(folder, "corners apart", far, {"welded_corners": 3 * len(ball) - (6 * n * n + 2)}, {}, enclosed=solid)
    bits = np.nextafter(ball.astype(np.float32), np.float32(9) * dice().choice([-1, 0, 1], ball.shape)).astype(float)
    check(folder, "float bits apart", bits, ["welded_corners"], {}, enclosed=solid)
    some = turned(ball, 0.3)
    flipped = int((some != ball).any(axis=(1, 2)).sum())
    check(folder, "some facets turned", some, {"turned_facets": flipped}, {}, 0, solid)
    check(folder, "most facets turned", turned(ball, 0.7),
          {"turned_facets": int((turned(ball, 0.7) != ball).any(axis=(1, 2)).sum())}, {}, 0, solid)
    check(folder, "inside out", turned(ball), {"turned_facets": len(ball)}, {}, 0, solid)
    twice = np.concatenate([ball, ball[:5], ball[5:9, [1, 2, 0]], ball[9:11, ::-1]])
    check(folder, "duplicates, turned and reversed", twice, {"duplicate_facets": 11}, {}, 0, solid)
    for name, one, to_turn in (("out", ball, 0), ("in", turned(ball), len(ball))):
        check(folder, f"each facet in both windings, first with its normal {name}", np.concatenate([one, turned(one)]),
              {"duplicate_facets": len(ball), "turned_facets": to_turn, "shells": 1}, {}, 0, solid)
    stl.write(folder / "in.stl", np.concatenate([box, turned(box)]))
    seen = run(folder, "inspect", "in.stl").stdout
    fact("inspect names them", "closed, but each facet is there in both windings, as in a double-sided export, so "
         "the mesh encloses nothing; lsdcd repair" in seen and "no: 12 duplicate facets, 12 facets in both" in seen, seen)
    flat = np.concatenate([box, [box[0, [0, 0, 1]], box[0, [0, 0, 0]],
                                 (box[0, 0], (box[0, 0] + box[0, 1]) / 2, box[0, 1])]])
    check(folder, "points and lines", flat, {"degenerate_facets": 3, "lost_facets": 0}, {}, 0, 1)

    # The bottom's two facets end at the middle of an edge by way of a facet without area.
    a, b, c = box[0]
    m = (a + b) / 2
    cap = np.concatenate([box[1:], [(a, m, c), (m, b, c), (a, b, m)]])
    check(folder, "a facet without area between", cap, {"degenerate_facets": 1, "lost_facets": 0, "split_facets": 1,
                                                "junctions": 1}, {}, 0, 1)
    check(folder, "a corner on an edge", cap[:-1], {"split_facets": 1, "junctions": 1}, {}, 0, 1)
    beside = np.cross(b - a, [1, 1, 1])
    beside *= 0.7 * WELD * diagonal(box) / np.linalg.norm(beside)
    off = np.where(np.all(cap[:-1] == m, axis=2, keepdims=True), m + beside, cap[:-1])
    said, _ = check(folder, "a corner beside an edge", off, {"split_facets": 1, "junctions": 1}, {}, 1, 1)
    fact("and by as much is moved", abs(said["moved"] / (0.7 * said["tolerance"]) - 1) < 1e-3, said["moved"])
    check(folder, "several corners on an edge", cube(1, 4, 1, 1, 1, 1), {"split_facets": 4, "junctions": 12}, {}, 0, 1)
    check(folder, "corners on all edges", cube(1, 2, 3, 5, 4, 8), ["split_facets"], {}, 1, 1)

    stl.write(folder / "in.stl", equal_pieces())
    done = run(folder, "repair", "in.stl", "-o", "out.stl", "--weld", 3.9266e-4, timeout=20)
    fact("no facet is cut twice, so that cutting ends", done.returncode == 3, done.stderr)

    check(folder, "a hole", box[1:], {"turned_facets": 0, "boundaries": 1}, {OPEN: 3}, 0)
    check(folder, "an open mesh that is meant to be", box[1:], {}, {OPEN: 3}, 0, words=["--open"])
    check(folder, "two holes", np.delete(ball, [0, 250], axis=0), {"boundaries": 2}, {OPEN: 6}, 0)
    wall = grid(6, 5, lambda u, v: (u, v, u * v))
    check(folder, "an open wall, some facets turned", turned(wall, 0.3),
          {"turned_facets": int((turned(wall, 0.3) != wall).any(axis=(1, 2)).sum())}, {OPEN: 22}, 0, words=["--open"])
    check(folder, "two cubes with a common edge", np.concatenate([box, cube(at=(1, 1, 0))]), {"shells": 2},
          {}, 0, 2)
    inner = [t for t in cube(at=(1, 0, 0)) if not np.all(t[:, 0] == 1)]
    check(folder, "a wall between two cubes", np.concatenate([box, inner]), {}, {MANY: 4}, 0)
    said, _ = check(folder, "a Moebius strip", turned(moebius(), 0.2), ["turned_facets"], None, 0)
    fact("its windings cannot agree", {OPEN, AGAINST} <= {u["what"] for u in said["left"]})

    apart = np.concatenate([box, turned(cube(at=(3, 0, 0)))])
    check(folder, "two bodies, one inside out", apart, {"turned_facets": 12, "shells": 2, "cavities": 0}, {}, 0, 2,
          largest=box)
    said, _ = check(folder, "two bodies that cut", np.concatenate([box, cube(at=(0.5, 0.25, 0.125))]), {"shells": 2},
                    None, 0, 2, largest=box)
    fact("they are named", [u["what"] for u in said["left"]] == [MEET])
    nested = np.concatenate([ball, sphere(2, 0.5), sphere(2, 0.25), sphere(2, 0.1, (0.6, 0, 0))])
    check(folder, "shells in shells", nested, {"turned_facets": 96, "shells": 4, "cavities": 2}, {}, 0)
    check(folder, "a facet folded onto its neighbour",
          [[(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(1, 0, 0), (0, 0, 0), (0.25, 0.5, 0)]], {}, {OPEN: 4, MEET: 1}, 0)
    in_it = m + 1e-9 * (c - m)
    thin = np.concatenate([box[1:], [(a, in_it, c), (in_it, b, c), (a, b, in_it)]])
    check(folder, "a thin facet is kept", thin, {}, {}, 0, 1)

    line = [(5., 0, 0), (6., 0, 0), (7., 0, 0)]
    said, _ = check(folder, "a line that stands alone", np.concatenate([box, [line]]),
                    {"degenerate_facets": 1, "lost_facets": 1}, {}, 1e7, 1, largest=[line])
    fact("is told with its distance", 6 <= said["dropping_moved"] <= 7, said["dropping_moved"])

    mixed = np.concatenate([turned(cube(2, 4, 8, 1, 2, 4), 0.4), cube(2, 4, 8, 1, 2, 4)[:7],
                            turned(cube(at=(4, 0, 0)))])
    mixed += dice().uniform(-1, 1, mixed.shape) * 0.1 * WELD * diagonal(mixed)
    mixed = np.concatenate([[box[0, [0, 0, 1]]], mixed])
    for name, by, shift in (("all of this", 1, 0), ("tiny", 1e-6, 0), ("huge", 1e6, 0), ("far away", 1, 1000)):
        check(folder, name, mixed * by + shift, [k for k in NOTHING if k != "moved"], {}, 3, 2 * by**3,
              largest=by * mixed[:-len(box)] + shift)

    done = run(folder, "repair", "in.stl", "-o", "out.stl")
    fact("people get a table", done.returncode == 0 and all(w in done.stdout for w in (
        "welded", "dropped", "cut", "turned", "moved", "left        nothing", "clean       yes")), done.stdout)
    fact("without --progress, and with no terminal, nothing is on stderr", done.stderr == "", done.stderr)
    done = run(folder, "repair", "in.stl", "-o", "out.stl", "--progress")
    fact("progress is on stderr", done.returncode == 0 and "welding corners\n" in done.stderr, done.stderr)
    refused(folder, "repair in.stl -o new.stl --weld 1e9".split(), "weld tolerance of 1e+09", "smaller")
    refused(folder, "repair in.stl -o new.step".split(), "new.step", ".stl")
