# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""How a large vessel would be shared by many GPUs: `./run bench decomposition`. Computed, not run.

The vessel of examples/vessel, enlarged until it holds --grains of its grains (2.7 to 3.1 mm), is full of them to its rim. It is
cut for P processes, each with a GPU: by LAMMPS's bricks of equal size, or by `fix balance ... rcb`, so that all have as many
grains. Assumed are

* grains everywhere in the vessel, as dense as a poured bed, and near the wall one layer of them (DENSITY, layer());
* a step of PER_GRAIN on a GPU without a wall, and FIXED and PER_NEAR more with one: measured on an H200 (doc/notes/performance.md);
* each process's ghosts: the grains within REACH of its box, as if grains were on all sides. A step sends their places and
  velocities, BYTES a grain, at BANDWIDTH, and takes LATENCY for each neighbour;
* all processes wait for the slowest one. The wall sends nothing in a step in which no output asks for its sums.

Points stand for grains: --points in the vessel, and as many on its wall. It takes a minute.
"""
import math
import sys

import numpy as np

import lammps_runs
import rows

sys.path.insert(0, str(rows.ROOT / "examples" / "vessel"))
import make_vessel    # noqa: E402

DIAMETER = 2.9e-3             # m
DENSITY = 0.6                 # of a poured bed: share of the volume
REACH = 3.7e-3                # m: the largest diameter and the skin of examples/vessel/in.vessel
PER_GRAIN = 0.742e-9          # s: 1e6 grains, gran/hooke/history/kk
FIXED, PER_NEAR = 25e-6, 0.25e-9    # s
BYTES = 72                    # place, velocity and angular velocity
BANDWIDTH = 25e9              # bytes/s of one GPU to others
LATENCY = 10e-6               # s, of a message


# ---- the vessel ----------------------------------------------------------------------------

def profiles():
    """Corners (r, z) of the vessel's wall, from below, and of the beam pipe; metres, as large as in the example."""
    sys.argv = sys.argv[:1]
    a = make_vessel.arguments()
    return [np.array(p) * 1e-3 for p in make_vessel.profiles(a)]


def radius_at(profile, z):
    """0 where the profile does not reach."""
    return np.interp(z, profile[:, 1], profile[:, 0], left=0, right=0)


def volume(wall, pipe):
    z = np.linspace(wall[0, 1], wall[-1, 1], 200001)
    return np.trapz(np.pi * (radius_at(wall, z)**2 - radius_at(pipe, z)**2), z)


def inside(dice, n, wall, pipe):
    """Points anywhere between the wall and the pipe."""
    lo, hi, most = wall[0, 1], wall[-1, 1], wall[:, 0].max()
    found = []
    while sum(map(len, found)) < n:
        z, r, turn = (dice.uniform(a, b, n) for a, b in ((lo, hi), (0, 1), (-math.pi, math.pi)))
        r = most * np.sqrt(r)
        good = (r < radius_at(wall, z)) & (r > radius_at(pipe, z))
        found.append(np.column_stack([r * np.cos(turn), r * np.sin(turn), z])[good])
    return np.concatenate(found)[:n]


def on_walls(dice, n, both):
    """Points on the surfaces that the profiles sweep about z, and their area."""
    a = np.concatenate([p[:-1] for p in both])
    b = np.concatenate([p[1:] for p in both])
    area = math.pi * (a[:, 0] + b[:, 0]) * np.hypot(*(b - a).T)
    k = dice.choice(len(a), n, p=area / area.sum())
    r0, r1 = a[k, 0], b[k, 0]
    u = dice.uniform(0, 1, n)
    # A strip is as long as its radius is large: the share t of its width has the area r0 t + (r1 - r0) t^2/2.
    bend = r1 - r0
    flat = np.abs(bend) < 1e-12
    t = np.where(flat, u, (np.sqrt(r0**2 + u * (r1**2 - r0**2)) - r0) / np.where(flat, 1, bend))
    at, turn = a[k] + t[:, None] * (b[k] - a[k]), dice.uniform(-math.pi, math.pi, n)
    return np.column_stack([at[:, 0] * np.cos(turn), at[:, 0] * np.sin(turn), at[:, 1]]), area.sum()


def layer():
    """Grains at the wall for each area: those of the bed within a diameter, nearly the densest layer that there is."""
    return DENSITY / (math.pi / 6 * DIAMETER**3) * DIAMETER


# ---- who has what --------------------------------------------------------------------------

def grid_of(processes, size):
    """LAMMPS's: bricks with the least surface."""
    best = None
    for nx in range(1, processes + 1):
        for ny in (k for k in range(1, processes // nx + 1) if processes % (nx * k) == 0 and processes % nx == 0):
            n = (nx, ny, processes // nx // ny)
            a = [s / k for s, k in zip(size, n)]
            best = min(best or (math.inf, n), (a[0] * a[1] + a[1] * a[2] + a[0] * a[2], n))
    return best[1]


def bricks(processes, grains, near):
    """For each process how many grains and near ones are in its box, and the box."""
    lo, hi = grains.min(axis=0), grains.max(axis=0)
    n = grid_of(processes, hi - lo)

    def owner(points):
        k = np.clip(((points - lo) / (hi - lo) * n).astype(int), 0, np.array(n) - 1)
        return np.ravel_multi_index(tuple(k.T), n)

    boxes = np.array([[lo + (hi - lo) * (np.array(k) + side) / n for side in (0, 1)] for k in np.ndindex(*n)])
    return *(np.bincount(owner(p), minlength=processes) for p in (grains, near)), boxes


def rcb(processes, grains, near):
    """The same, cut again and again across the longest side, so that both sides have their share of the grains."""
    counts, touching, boxes = [], [], []

    def cut(p, a, b, box):
        if p == 1:
            counts.append(len(a))
            touching.append(len(b))
            boxes.append(box)
            return
        half = p // 2
        d = int(np.argmax(box[1] - box[0]))
        k = len(a) * half // p
        a = a[np.argpartition(a[:, d], k)]
        at = a[k, d]
        left, right = box.copy(), box.copy()
        left[1, d] = right[0, d] = at
        cut(half, a[:k], b[b[:, d] < at], left)
        cut(p - half, a[k:], b[b[:, d] >= at], right)

    cut(processes, grains, near, np.array([grains.min(axis=0), grains.max(axis=0)]))
    return np.array(counts), np.array(touching), np.array(boxes)


def neighbours(boxes):
    """How many other boxes are within REACH of each."""
    return np.array([(np.all((boxes[:, 0] < b[1] + REACH) & (boxes[:, 1] > b[0] - REACH), axis=1)).sum() - 1
                     for b in boxes])


def shared(counts, near, boxes):
    """What the slowest process takes, with the wall and without, and the rest of a row."""
    n = neighbours(boxes)
    sides = boxes[:, 1] - boxes[:, 0]
    ghosts = counts * (np.prod(1 + 2 * REACH / sides, axis=1) - 1)
    others = PER_GRAIN * counts + (n > 0) * (ghosts * BYTES / BANDWIDTH + LATENCY * n)
    wall = np.where(near > 0, FIXED + PER_NEAR * near, 0)
    return {"grains": counts, "near": near, "ghosts": ghosts, "neighbours": n, "without": others.max(),
            "with": (others + wall).max(), "wall": wall}


# ---- the table -----------------------------------------------------------------------------

HEADS = ("GPUs", "cut", "grains, mean", "most / mean", "near the wall, mean", "most near", "processes without any",
         "ghosts, mean", "neighbours, mean (most)", "step without the wall, ms", "with the wall, ms", "the wall adds, %",
         "the same if all had as many near, %")


def row(processes, how, s):
    even = (PER_NEAR * s["near"].mean() + FIXED) / s["without"]
    cells = (processes, how, f"{s['grains'].mean():.4g}", f"{s['grains'].max() / s['grains'].mean():.2f}",
             f"{s['near'].mean():.3g}", f"{s['near'].max():.3g}", f"{(s['near'] == 0).sum()}", f"{s['ghosts'].mean():.2g}",
             f"{s['neighbours'].mean():.0f} ({s['neighbours'].max()})", f"{1e3 * s['without']:.3f}",
             f"{1e3 * s['with']:.3f}", f"{100 * (s['with'] / s['without'] - 1):.1f}", f"{100 * even:.1f}")
    return dict(zip(HEADS, cells))


def main():
    p = lammps_runs.parser("decomposition", __doc__)
    p.add_argument("--grains", type=float, default=1e9, metavar="N", help="in all (default 1e9)")
    p.add_argument("--processes", type=int, nargs="+", default=[64, 256, 1024], metavar="P")
    p.add_argument("--points", type=int, default=4000000, metavar="N", help="that stand for them (default 4e6)")
    options = p.parse_args()
    if options.quick:
        options.points = 20000
    both = profiles()
    scale = (options.grains * math.pi / 6 * DIAMETER**3 / DENSITY / volume(*both))**(1 / 3)
    both = [scale * b for b in both]
    dice = np.random.default_rng(7)
    grains = inside(dice, options.points, *both)
    near, area = on_walls(dice, options.points, both)
    of_point, of_near = options.grains / len(grains), layer() * area / len(near)
    rows.say(f"the vessel is {scale:.1f} times as large, {2 * both[0][:, 0].max():.2f} m wide; {of_near * len(near):.3g} grains of "
             f"{options.grains:.3g} are near the wall")
    print(rows.as_csv([row(processes, how, shared(of_point * counts, of_near * touching, boxes))
                       for processes in options.processes for how, cut in (("bricks", bricks), ("rcb", rcb))
                       for counts, touching, boxes in [cut(processes, grains, near)]]), end="")


if __name__ == "__main__":
    main()
