# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Triangles in numpy: distances to every one of them, one by one, and meshes to break."""
import itertools
import math

import numpy as np


def turn(axis, angle):
    """A matrix, by Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def closest_on_triangle(p, a, b, c):
    """Nearest of: the foot on the plane where it is inside, and the feet on the three edges."""
    n = np.cross(b - a, c - a)
    best, least = np.broadcast_to(a, p.shape), np.linalg.norm(p - a, axis=1)
    # The plane of a triangle that is a line is noise.
    if n @ n > (1e-12 * max((b - a) @ (b - a), (c - a) @ (c - a)))**2:
        foot = p - np.outer((p - a) @ n / (n @ n), n)
        inside = np.all([np.cross(v - u, foot - u) @ n >= 0 for u, v in ((a, b), (b, c), (c, a))], axis=0)
        best = np.where(inside[:, None], foot, best)
        least = np.where(inside, np.linalg.norm(p - foot, axis=1), least)
    for u, v in ((a, b), (b, c), (c, a)):
        length = (v - u) @ (v - u)
        t = np.clip((p - u) @ (v - u) / length, 0, 1) if length > 0 else np.zeros(len(p))
        q = u + np.outer(t, v - u)
        d = np.linalg.norm(p - q, axis=1)
        best, least = np.where((d < least)[:, None], q, best), np.minimum(d, least)
    return best, least


def samples(triangles, n):
    """Corners, and points between them: n + 1 along each side."""
    weights = np.array([(i, j, n - i - j) for i in range(n + 1) for j in range(n + 1 - i)]) / n
    return (weights @ np.asarray(triangles)).reshape(-1, 3)


def one_sided(triangles, others, n=3):
    """How far the points of some triangles are from others at most, of points that are sampled. Those that are among the others, too,
    however they are wound, are at no distance."""
    known = {frozenset(map(tuple, t)) for t in np.asarray(others).tolist()}
    rest = [t for t in np.asarray(triangles).tolist() if frozenset(map(tuple, t)) not in known]
    if not rest:
        return 0.
    points = samples(rest, n)
    least = np.full(len(points), np.inf)
    for t in others:
        near = np.flatnonzero(np.all((points > t.min(axis=0) - least[:, None]) &
                                     (points < t.max(axis=0) + least[:, None]), axis=1))
        if len(near):
            least[near] = np.minimum(least[near], closest_on_triangle(points[near], *t)[1])
    return least.max()


def edges_of(triangles):
    """Faces of each edge, as (face, direction), by the places of its ends."""
    edges = {}
    for f, t in enumerate(triangles):
        corners = [tuple(map(float, p)) for p in t]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges.setdefault((min(a, b), max(a, b)), []).append((f, a < b))
    return edges


def volume(triangles):
    t = np.asarray(triangles) - np.mean(triangles, axis=(0, 1))
    return np.einsum("ij,ij->", t[:, 0], np.cross(t[:, 1], t[:, 2])) / 6


def grid(n, m, place):
    """A net of 2 n m triangles; place(u, v) of u and v from 0 to 1, where equal numbers are equal points."""
    x = [[np.array(place(i / n, j / m), float) for j in range(m + 1)] for i in range(n + 1)]
    return np.array([t for i, j in itertools.product(range(n), range(m)) for t in (
        (x[i][j], x[i + 1][j], x[i + 1][j + 1]), (x[i][j], x[i + 1][j + 1], x[i][j + 1]))])


def cube(*cuts, at=(0, 0, 0), size=1.):
    """Each face a net of its own: of cuts[k] by cuts[k], in turn. Coordinates in eighths are exact."""
    faces = []
    for k, (axis, side) in enumerate(itertools.product(range(3), (0, 1))):
        def place(u, v):
            x = [0., 0., 0.]
            x[axis], x[(axis + 1) % 3], x[(axis + 2) % 3] = side, u, v
            return x
        n = cuts[k % len(cuts)] if cuts else 1
        net = grid(n, n, place)
        faces.append(net if side else net[:, ::-1])
    return np.concatenate(faces) * size + at


def sphere(n=8, radius=1., at=(0, 0, 0)):
    """A cube blown up."""
    t = cube(n) - 0.5
    return radius * t / np.linalg.norm(t, axis=2, keepdims=True) + at
