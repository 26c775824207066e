# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Every file of mesh_corpus.py has the triangles that it means, to the last bit, or its error.

PYTHONPATH and LSDCD_LIBRARY name the package and its library.
"""

import numpy as np

import lsdcd
from facts import fact
from mesh_corpus import BESIDE, Error, Polygon, Solid, cases


def turned(triangles):
    """Sorted, each from its lowest corner on, so that the windings stay."""
    corners = [[tuple(map(float, x)) for x in t] for t in triangles]
    return sorted(tuple(t[t.index(min(t)):] + t[:t.index(min(t))]) for t in corners)


def area_vectors(triangles):
    t = np.asarray(triangles, float)
    return np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]) / 2


def is_polygon(triangles, polygon):
    """All triangles are wound as the polygon, their areas are exactly its own, and they have all its corners."""
    fan = [(polygon.corners[0], b, c) for b, c in zip(polygon.corners[1:], polygon.corners[2:])]
    whole, parts = area_vectors(fan).sum(axis=0), area_vectors(triangles)
    return (np.array_equal(parts.sum(axis=0), whole) and np.linalg.norm(whole) == polygon.area
            and np.linalg.norm(parts, axis=1).sum() == polygon.area
            and set(map(tuple, np.reshape(triangles, (-1, 3)))) == set(polygon.corners))


def wrong(path, meaning):
    """What is wrong with what the library reads; none: nothing."""
    try:
        mesh = lsdcd.Mesh(path, weld=0)
    except lsdcd.Error as error:
        words = [path.name, *meaning.words] if isinstance(meaning, Error) else [None]
        return None if all(w is not None and w in str(error) for w in words) else f"refused: {error}"
    facts, arrays = mesh.facts, mesh.arrays()
    triangles = arrays.vertices[arrays.faces]
    if isinstance(meaning, Polygon):
        right = is_polygon(triangles, meaning)
    elif isinstance(meaning, Solid):
        right = facts.oriented and facts.volume == meaning.volume and facts.area == meaning.area
    else:
        right = not isinstance(meaning, Error) and turned(triangles) == turned(meaning)
    return None if right else f"read as {triangles.tolist()}"


def test_corpus(folder):
    for name, data in BESIDE.items():
        (folder / name).write_bytes(data)
    for name, data, meaning in cases():
        (folder / name).write_bytes(data)
        said = wrong(folder / name, meaning)
        fact(name, said is None, said or "")
