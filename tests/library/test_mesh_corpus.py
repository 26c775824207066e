# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Every file of mesh_corpus.py has the triangles that it means, to the last bit, or its error.

PYTHONPATH and LSDCD_LIBRARY name the package and its library.
"""

import numpy as np

import lsdcd
from facts import fact
from mesh_corpus import BESIDE, FORMS, LITTLE, P3, Alike, Error, Polygon, Solid, cases, ply


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
    elif isinstance(meaning, Alike):
        normals = area_vectors(triangles)
        right = len(normals) == facts.triangles == meaning.n and (normals[:, :2] == 0).all() and len(np.unique(np.sign(normals[:, 2]))) == 1
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


def refusal(path, data):
    path.write_bytes(data)
    try:
        lsdcd.Mesh(path)
    except lsdcd.Error as error:
        return str(error)
    return ""


def test_cut_ply(folder):
    """Every cut is an error, but inside the last number of a text and its line's end: such a file cannot be told from a whole one."""
    path = folder / "cut.ply"
    for form in FORMS:
        data = ply(form, P3, [(0, 1, 2)])
        head, size = data.index(b"end_header") + 11, len(data) - (3 if form == "ascii" else 0)
        whole = [n for n in range(size) if not (said := refusal(path, data[:n])) or n >= head and "truncated" not in said]
        fact(f"{form}: no cut file is whole", not whole, whole)


def test_huge_ply(folder):
    """A promise allocates nothing: to reserve room for as many would throw something else."""
    path = folder / "huge.ply"
    for form in FORMS:
        for element in (b"vertex 3", b"face 1"):
            data = ply(form, P3, [(0, 1, 2)]).replace(element, element + 18 * b"0")
            # A text of too few vertices has a line of a face for the next one.
            data = data[:data.rindex(b"3 0 1 2")] if form == "ascii" else data
            fact(f"{form}: {element.decode()} is too many", "truncated" in refusal(path, data), refusal(path, data))
    data = ply(LITTLE, [], [(1, 2, 3)], face="list uint int vertex_indices")
    fact("a list of 4e9", "byte " in refusal(path, data[:-16] + (4 * 10**9).to_bytes(4, "little") + data[-12:]))
    # Far larger than memory, though it takes no room on the disk.
    path.write_bytes(b"solid a\n")
    with open(path, "r+b") as file:
        file.truncate(1 << 42)
    try:
        lsdcd.Mesh(path)
        fact("a file of another kind is refused by its beginning", False)
    except lsdcd.Error as error:
        fact("a file of another kind is refused by its beginning", "huge.ply, line 1: 'solid' found where 'ply' is expected" in str(error), error)


def test_binary_ply_begins_with_any_byte(folder):
    """After any line end; the second and the third byte of the first vertex are line ends, too."""
    path, other = folder / "any.ply", []
    for end in (b"\n", b"\r\n", b"\r"):
        for first in range(256):
            data = ply(LITTLE, [(first, 10, 13), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], "uchar x y z")
            at = data.index(b"end_header") + 11
            path.write_bytes(data[:at].replace(b"\n", end) + data[at:])
            arrays = lsdcd.Mesh(path, weld=0).arrays()
            if turned(arrays.vertices[arrays.faces]) != turned([((first, 10, 13), (1, 0, 0), (0, 1, 0))]):
                other.append((end, first))
    fact("each is read", not other, other)
