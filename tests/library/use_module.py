# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Arrays, layouts, threads and errors of the Python module, against a cube's closed form."""
import copy
import os
import pickle
import signal
import sys
import threading

import numpy as np

import lsdcd

sys.path.insert(0, __file__.rsplit("/", 1)[0])
from cube import CUBE_FACES    # noqa: E402

CUTOFF = 0.5
vertices = np.array([[1.0 if v >> k & 1 else -1.0 for k in range(3)] for v in range(8)])
faces = np.array(CUBE_FACES)
mesh = lsdcd.Mesh(vertices, faces)
grid = mesh.grid(cutoff=CUTOFF)


# The welded mesh is the cube that was given: 12 triangles, 18 edges of two, 8 corners.
welded = mesh.arrays()
assert welded.faces.shape == (12, 3) and welded.edges.shape == (18, 2) and welded.edge_first[-1] == 36
assert (welded.vertices[welded.faces] == vertices[faces[welded.triangle]]).all()
assert (np.sort(welded.vertices, axis=None) == np.sort(vertices, axis=None)).all()
# And back: each vertex and face as given has its number there; a vertex of no face and a face without area have none.
assert (welded.vertices[welded.welded_vertex] == vertices).all() and (welded.triangle[welded.welded_face] == np.arange(12)).all()
more = lsdcd.Mesh(np.vstack([vertices, [[9, 9, 9]]]), np.vstack([faces, faces[:1, ::-1], [[0, 0, 1]]]))
assert more.facts.given_vertices == 9 and more.arrays().welded_vertex[8] == lsdcd.NONE
assert more.arrays().welded_face.tolist() == [*range(12), 0, lsdcd.NONE]

# All contacts: three faces in a corner, none, and a vertex from outside.
for real, close in ((np.float64, 1e-15), (np.float32, 1e-7)):
    met = grid.contacts(np.array([[0.7, 0.8, 0.9], [0, 0, 0], [1.1, 1.1, 1.1]], dtype=real), 0.4)
    assert met.first.tolist() == [0, 3, 3, 4] and met.point.dtype == real and (met.weight == 1).all()
    assert np.allclose(np.sort(met.distance[:3]), [0.1, 0.2, 0.3], rtol=0, atol=close)
    assert np.allclose(met.overlap, real(0.4) - met.distance, rtol=0, atol=close)
    assert np.allclose(np.sort(met.normal[:3].sum(0)), [-1, -1, -1], rtol=0, atol=close)
    assert (met.feature >> 30).tolist() == [0, 0, 0, 2] and (met.point[3] == 1).all()
    # From outside an edge and a face; far; no number.
    out = grid.contacts(np.array([[1.1, 1.1, 0.3], [1.1, 0.5, 0.3], [5, 5, 5], [np.nan, 1, 1]], dtype=real), 0.4)
    assert out.first.tolist() == [0, 1, 2, 2, 2] and (out.feature >> 30).tolist() == [1, 0] and (out.weight == 1).all()

# Points of any shape and layout, and arrays of the caller.
centres = np.array([[[0.7, 0.8, 0.9], [0, 0, 0]], [[1.1, 1.1, 1.1], [9, 9, 9]], [[0.7, 0.8, 0.9], [0.9, 0, 0]]])
shaped, flat = grid.contacts(centres, 0.4), grid.contacts(centres.reshape(-1, 3), 0.4)
assert shaped == flat and shaped.first.tolist() == [0, 3, 3, 4, 4, 7, 8]
assert grid.contacts(np.asfortranarray(centres), 0.4) == flat and grid.contacts(centres[::-1][::-1].tolist(), [[0.4] * 2] * 3) == flat
assert grid.contacts(centres[0, 0], 0.4).first.tolist() == [0, 3] and grid.contacts(np.empty((2, 0, 3)), 0.4).first.tolist() == [0]
mine = {"first": np.zeros(7, np.uintp), "point": np.full((10, 3), 7.0), "feature": np.zeros(10, np.int32)}
found = grid.contacts(centres, 0.4, out=mine)
for word, value in vars(flat).items():
    assert (getattr(found, word).view(value.dtype) == value).all(), word
assert found.first is mine["first"] and np.shares_memory(found.point, mine["point"]) and (mine["point"][8:] == 7).all()
again = grid.contacts(centres[::-1], 0.4, out=shaped)    # as many contacts
assert again == grid.contacts(centres[::-1], 0.4) and again.first is shaped.first


def truth(points):
    """Distance from the cube's surface, and its side."""
    p = np.abs(np.asarray(points, dtype=float))
    outside = np.linalg.norm(np.maximum(p - 1, 0), axis=1)
    inside = (p < 1).all(axis=1)
    return np.where(inside, 1 - p.max(axis=1), outside), np.where(inside, -1, 1)


def expect_right(answer, points, tolerance):
    distance, side = truth(points)
    near = distance < CUTOFF - tolerance
    assert np.allclose(answer.distance[near], distance[near], rtol=0, atol=tolerance)
    assert np.isinf(answer.distance[distance > CUTOFF + tolerance]).all()
    assert (answer.side[near] == side[near]).all()
    assert np.allclose(answer.closest + answer.normal * np.where(near, answer.distance, 0)[:, None],
                       np.where(near[:, None], points, answer.closest), rtol=0, atol=4 * tolerance)
    assert (answer.triangle[near] < 12).all()


def refused(kind, says, call):
    try:
        call()
    except kind as e:
        assert says in str(e), e
        return e
    raise AssertionError("not refused: " + says)


assert mesh.facts.volume == 8 and mesh.facts.closed == 1 and mesh.facts.lo == (-1, -1, -1)
assert grid.facts.cutoff == CUTOFF and "cutoff 0.5" in grid.report and "facets" in mesh.report
points = np.random.default_rng(1).uniform(-1.6, 1.6, (20000, 3))
want = "distance closest normal triangle side status"
# Rounding of coordinates below 2: 16 units of each type.
expect_right(grid.query(points, want), points, 16 * 2.3e-16)
expect_right(grid.query(points.astype(np.float32), want), points.astype(np.float32), 16 * 1.2e-7)

# Any layout of the points.
base = grid.query(points).distance
for same in (np.asfortranarray(points), np.repeat(points, 2, axis=0)[::2], points[::-1][::-1].copy(),
             points.astype(points.dtype.newbyteorder()), points.tolist()):
    assert (grid.query(same).distance == base).all()
backwards = points[::-1]
assert (grid.query(backwards).distance == base[::-1]).all()
assert (grid.query(np.broadcast_to([0.9, 0, 0], (5, 3))).distance == grid.query([[0.9, 0, 0]]).distance).all()
assert grid.query(np.array([[0, 0, 1], [0, 1, 0]])).distance.tolist() == [0, 0]    # whole numbers
assert grid.query(np.empty((0, 3))).distance.shape == (0,)

# Without a cutoff, at any distance, with the same bits within it.
anywhere = mesh.grid()
assert anywhere.facts.cutoff == np.inf
far = anywhere.query(1000 * points, "distance side")
wanted = truth(1000 * points)
assert np.allclose(far.distance, wanted[0], rtol=1e-14, atol=1e-14) and (far.side == wanted[1]).all()
assert (anywhere.query(points).distance[np.isfinite(base)] == base[np.isfinite(base)]).all()

assert np.isinf(grid.query([[1.2, 0, 0]], radius=0.19).distance[0])
near = grid.query([[1.2, 0, 0]] * 2, "distance status", radius=[0.19, 0.21])
assert np.isfinite(near.distance).tolist() == [False, True]
assert near.status.tolist() == [lsdcd.CERTIFIED, lsdcd.CERTIFIED | lsdcd.FOUND]
assert (lsdcd.Mesh(vertices[faces]).grid(cutoff=CUTOFF).query(points).distance == base).all()

assert refused(lsdcd.Error, "cutoff", lambda: grid.query(points, radius=1)).code == "cutoff"
assert refused(lsdcd.Error, "nowhere", lambda: lsdcd.Mesh("/nowhere.stl")).code == "input"
open_grid = lsdcd.Mesh(vertices, [f for f in faces if not (vertices[f][:, 0] == vertices[:, 0].max()).all()]).grid()
middle = open_grid.query([[0, 0, 0], [5, 0, 0]], "winding side status", estimate_sides=True)
assert abs(middle.winding[0] - 5 / 6) < 1e-15 and middle.side.tolist() == [-1, 1] and (middle.status & lsdcd.SIDE_ESTIMATED).all()
assert refused(lsdcd.Error, "closed", lambda: lsdcd.Mesh(vertices, faces[1:]).grid(cutoff=1).query(points, "side")).code == "side"
refused(ValueError, "(n, 3)", lambda: grid.query(points[:, :2]))
refused(ValueError, "height", lambda: grid.query(points, "height"))
refused(ValueError, "radius", lambda: grid.query(points, radius=0))
refused(ValueError, "shape", lambda: grid.query(points, radius=[0.1]))
for bad in (0, -0.1, float("nan")):
    refused(ValueError, f"radius is {bad}", lambda: grid.query(points[:2], radius=[0.1, bad]))

# One point, as one of many.
single = grid.query([1.2, 0, 0], want, radius=0.3)
assert (single.distance.shape, single.closest.shape, single.triangle.shape) == ((), (3,), ()), single
many = grid.query([[1.2, 0, 0]], want, radius=0.3)
assert all((getattr(single, word) == getattr(many, word)[0]).all() for word in want.split())
refused(ValueError, "(3,)", lambda: grid.query([1.2, 0]))

# Shapes, (..., 3), and types.
block = points[:6].reshape(2, 1, 3, 3)
shaped = grid.query(block, want)
flat = grid.query(points[:6], want)
assert (shaped.distance.shape, shaped.closest.shape, shaped.side.shape) == ((2, 1, 3), (2, 1, 3, 3), (2, 1, 3))
assert all((getattr(shaped, word).reshape(getattr(flat, word).shape) == getattr(flat, word)).all() for word in want.split())
assert (grid.query(block.transpose(2, 1, 0, 3)).distance == shaped.distance.transpose(2, 1, 0)).all()
assert (grid.query(block[:, 0, ::2]).distance == shaped.distance[:, 0, ::2]).all()
assert np.isfinite(grid.query([[[1.2, 0, 0]] * 2], radius=[[0.19, 0.21]]).distance).tolist() == [[False, True]]
assert grid.query(np.empty((4, 0, 3)), want).closest.shape == (4, 0, 3)
for other in (np.float16, np.longdouble, np.int32, object):
    numbers = np.round(points[:50]).astype(other)
    assert (grid.query(numbers).distance == grid.query(numbers.astype(float)).distance).all()
unaligned = np.frombuffer(b"." + points[:9].tobytes(), np.float64, offset=1).reshape(9, 3)
assert (grid.query(unaligned).distance == base[:9]).all()
refused(ValueError, "shape (3, 8), not (..., 3), as (n, 3) or (3,): coordinates come last, so give points.T",
        lambda: grid.query(vertices.T))
refused(ValueError, "shape (24,), not (..., 3), as (n, 3) or (3,): give points.reshape(-1, 3)", lambda: grid.query(vertices.ravel()))
refused(TypeError, "complex128, not real numbers", lambda: grid.query(points.astype(complex)))
refused(ValueError, "points are on the host", lambda: grid.query(points, stream=1))

# Arrays of the caller for answers: of any layout, and only where they fit.
rows = np.zeros((20000, 8))    # x y z distance, closest, -
rows[:, :3] = points
mine = {"distance": rows[:, 3], "closest": rows[:, 4:7], "triangle": np.zeros(20000, np.int32)}
written = grid.query(rows[:, :3], out=mine)
whole = grid.query(points, list(mine))
assert all(getattr(written, word) is mine[word] for word in mine) and sorted(vars(written)) == sorted(mine)
assert (rows[:, 3] == whole.distance).all() and (rows[:, 4:7] == whole.closest).all()
assert (mine["triangle"].view(np.uint32) == whole.triangle).all() and (rows[:, 7] == 0).all()
assert grid.query(points, "side distance", out={"distance": rows[:, 3]}).side.shape == (20000,)
every_second = np.full(40000, 7.0)
assert (grid.query(points, out={"distance": every_second[::-2]}).distance == base).all() and (every_second[::2] == 7).all()
again = grid.query(points[::-1], out=whole)
assert again.closest is whole.closest and (whole.closest[::-1] == rows[:, 4:7]).all()
for out, says, kind in (({"distance": np.zeros(9)}, "shape (9,), not (20000,)", ValueError),
                        ({"distance": np.zeros(20000, "f4")}, "float32, not float64", TypeError),
                        ({"distance": np.broadcast_to(0.0, 20000)}, "cannot be written to", ValueError),
                        ({"side": np.zeros(20000, "i1")}, "not asked for", ValueError),
                        ({"distance": points[:, 0]}, "shares memory", ValueError),
                        ({"distance": [0.0]}, "a list, not an array", TypeError)):
    refused(kind, says, lambda: grid.query(points, "distance", out=out))
refused(ValueError, "make it contiguous", lambda: grid.query(points, out={"triangle": np.zeros((20000, 2), "u4")[:, 0]}))

# Words and faces that there are not.
refused(ValueError, "device is 'gpu'; it is 'cpu' or 'cuda'", lambda: mesh.grid(cutoff=1, device="gpu"))
refused(ValueError, "device is 'gpu'", lambda: lsdcd.Body(mesh, mesh, device="gpu"))
refused(ValueError, "precision is 'half'", lambda: mesh.grid(cutoff=1, precision="half"))
refused(ValueError, "vertex -1; there are 8", lambda: lsdcd.Mesh(vertices, [[0, 1, -1]]))
refused(ValueError, "vertex 8; there are 8", lambda: lsdcd.Mesh(vertices, [[0, 1, 8]]))
refused(TypeError, "whole numbers", lambda: lsdcd.Mesh(vertices, [[0.0, 1, 2]]))
refused(ValueError, "faces have the shape (2, 4), not (n, 3)", lambda: lsdcd.Mesh(vertices, [[0, 1, 2, 3]] * 2))
refused(ValueError, "vertices have the shape (12, 2), not (m, 3)", lambda: lsdcd.Mesh(vertices.reshape(12, 2), faces))
refused(lsdcd.Error, "face 0 (from 0) has the vertex 1, whose y is nan",
        lambda: lsdcd.Mesh([[0, 0, 0], [1, np.nan, 0], [0, 1, 0]], [[0, 1, 2]]))
# Vertices in floats are those numbers.
short = np.array([[0.1, 0, 0], [1, 0.2, 0], [0, 1, 0.3]], np.float32)
assert (lsdcd.Mesh(short, [[0, 1, 2]]).arrays().vertices == short.astype(float)).all()

# Contacts and their arrays that do not fit.
refused(ValueError, "there are 8 contacts, and out has room for 5", lambda: grid.contacts(centres, 0.4, out={"point": np.zeros((5, 3))}))
for out, says, kind in (({"point": np.zeros((9, 3)), "distance": np.zeros(8)}, "{'point': 9, 'distance': 8}", ValueError),
                        ({"first": np.zeros(6, np.uintp)}, "shape (6,), not (7,)", ValueError),
                        ({"side": np.zeros(9)}, "out has side: contacts have first, point", ValueError),
                        ({"point": np.zeros(9)}, "shape (9,), not (9, 3)", ValueError),
                        ({"point": np.zeros((9, 6))[:, ::2]}, "make it contiguous", ValueError),
                        ({"weight": np.zeros(9, np.float32)}, "float32, not float64", TypeError),
                        ({"weight": [0.0] * 9}, "a list, not an array", TypeError)):
    refused(kind, says, lambda: grid.contacts(centres, 0.4, out=out))
refused(ValueError, "shape (3, 2), not (..., 3)", lambda: grid.contacts(centres[..., 0], 0.4))
refused(ValueError, "radius has the shape (3,), not () or (3, 2)", lambda: grid.contacts(centres, [0.4] * 3))
refused(TypeError, "complex128", lambda: grid.contacts(centres, 0.4j))

# Signed distances and barycentrics: negative inside, and shares of the corners as given.
answer = anywhere.query(points.reshape(100, 200, 3), "signed_distance distance side barycentric closest triangle feature")
assert (answer.signed_distance == answer.distance * answer.side).all()    # to the bit
distance, side = truth(points)
assert np.allclose(answer.signed_distance.ravel(), distance * side, rtol=0, atol=16 * 2.3e-16)
corners = vertices[faces[answer.triangle]]
assert answer.barycentric.shape == (100, 200, 3) and (answer.barycentric >= 0).all()
assert np.allclose((answer.barycentric[..., None] * corners).sum(-2), answer.closest, rtol=0, atol=16 * 2.3e-16)
for kind in (1, 2):    # an edge has two corners, a vertex is one
    shares = answer.barycentric[answer.feature >> 30 == kind]
    assert len(shares) > 50 and ((shares == 0).sum(-1) == kind).all() and (kind == 1 or (shares.max(-1) == 1).all())
# A line is no triangle.
line = lsdcd.Mesh(np.vstack([vertices, [[5, 0, 0], [6, 0, 0], [7, 0, 0]]]), np.vstack([faces, [[8, 9, 10]]]))
for of_line in (line.grid(), line.grid(cutoff=1)):
    none = of_line.query([[5.5, 0.1, 0], [np.nan, 0, 0]], "triangle barycentric")
    assert none.triangle.tolist() == [lsdcd.NONE] * 2 and np.isnan(none.barycentric).all()
mine = {"signed_distance": np.zeros((20000, 2), np.float32)[:, 0], "barycentric": np.zeros((3, 20000), np.float32).T}
anywhere.query(points.astype(np.float32), out=mine)
assert np.allclose(mine["signed_distance"], distance * side, rtol=0, atol=16 * 1.2e-7)
assert np.allclose(mine["barycentric"].sum(1), 1, rtol=0, atol=3 * 6e-8)
far = grid.query([[0, 0, 0], [9, 9, 9], [np.nan, 0, 0]], "signed_distance barycentric")
assert far.signed_distance[:2].tolist() == [-np.inf, np.inf] and np.isnan(far.signed_distance[2]) and np.isnan(far.barycentric).all()
assert refused(lsdcd.Error, "estimate_sides", lambda: open_grid.query(points, "signed_distance")).code == "side"
assert (open_grid.query([[0, 0, 0], [5, 0, 0]], "signed_distance", estimate_sides=True).signed_distance < 0).tolist() == [True, False]

# A grid keeps what it needs.
alone = lsdcd.Mesh(vertices, faces).grid(cutoff=CUTOFF)
wrong = []


def ask():
    for _ in range(5):
        if not (alone.query(points).distance == base).all():
            wrong.append(1)


threads = [threading.Thread(target=ask) for _ in range(8)]
for t in threads:
    t.start()
for t in threads:
    t.join()
assert not wrong

# A listener hears of a call, and ends it.
told = []
heard = mesh.grid(0.5, progress=lambda what, done: told.append((what, done)))
assert told and all(isinstance(what, str) and 0 <= done <= 1 for what, done in told)
for call in (lambda listen: mesh.grid(0.1, cell=0.1, progress=listen), lambda listen: heard.query(points, progress=listen),
             lambda listen: grid.contacts(points, 0.1, progress=listen), lambda listen: lsdcd.Body(mesh, mesh, progress=listen)):
    assert refused(lsdcd.Error, "cancelled", lambda: call(lambda what, done: True)).code == "cancelled"
    refused(ZeroDivisionError, "division", lambda: call(lambda what, done: 1 / 0))
    try:
        call(lambda what, done: os.kill(os.getpid(), signal.SIGINT))    # as Ctrl-C
        raise AssertionError("not interrupted")
    except KeyboardInterrupt:
        pass
assert (heard.query(points, progress=lambda what, done: None).distance == heard.query(points).distance).all()

# A body: the cube half through a floor of one large triangle, then above it. Its four upright sides
# meet the floor, two triangles each, in segments as long as the cube's perimeter, 8.
floor = lsdcd.Mesh([[[-20, -20, 0], [20, -20, 0], [0, 30, 0]]])
body = lsdcd.Body(floor, mesh, cell=0.5)
found = body.collide(position=(0, 0, 0.25), segments=True)
upright = [t for t, face in enumerate(CUBE_FACES) if len({v >> 2 for v in face}) == 2]
assert found.collides and found.wall.tolist() == [0] * 8 and found.body.tolist() == upright, found
assert abs(np.linalg.norm(found.segments[:, 1] - found.segments[:, 0], axis=1).sum() - 8) < 1e-14
assert found.uncertain == 0 and body.facts.triangles == 12 and body.facts.cell == 0.5
assert not body.collide((0, 0, 1.25)).collides and len(body.collide((0, 0, 1.25)).wall) == 0
turned = np.eye(4)
turned[:3] = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0.25]]    # about z, by 90 degrees
for matrix in (turned, turned[:3]):
    assert body.collide(matrix=matrix).body.tolist() == upright
assert body.collide((0, 0, 0.25), quaternion=[np.sqrt(.5), 0, 0, np.sqrt(.5)]).body.tolist() == upright
assert lsdcd.Body(body, mesh).collide((0, 0, 0.25)).body.tolist() == upright
blades = np.array([[[x, 0, -1], [x + .001, 0, -1], [x, 0, 1]] for x in np.linspace(-5, 5, 3000)])
assert lsdcd.Body(body, lsdcd.Mesh(blades)).collide((0, 0, 0)).body.tolist() == list(range(3000))
assert refused(lsdcd.Error, "pose", lambda: body.collide()).code == "argument"
assert refused(lsdcd.Error, "not a rotation", lambda: body.collide(matrix=2 * turned[:3])).code == "input"
assert refused(lsdcd.Error, "same_wall", lambda: lsdcd.Body(body, mesh, cell=1)).code == "argument"
refused(ValueError, "position has the shape", lambda: body.collide((0, 0)))
refused(ValueError, "last row", lambda: body.collide(matrix=np.ones((4, 4))))
c, s = np.cos(np.float32(0.7)), np.sin(np.float32(0.7))
rounded = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0.25]], dtype=np.float32)
assert body.collide(matrix=rounded).body.tolist() == upright

# An object of the library has one owner, and is freed once.
freed = []
for kind in (lsdcd.Mesh, lsdcd.Grid, lsdcd.Body):
    kind._free = staticmethod(lambda handle, free=kind._free: (freed.append(handle.value), free(handle)))
owners = [lsdcd.Mesh(vertices, faces)]
owners += [owners[0].grid(cutoff=CUTOFF), lsdcd.Body(floor, owners[0])]
handles = [owner._handle.value for owner in owners]
for owner in owners:
    for duplicate in (copy.copy, copy.deepcopy, pickle.dumps):
        refused(TypeError, f"a {type(owner).__name__} holds memory of the library", lambda: duplicate(owner))
assert not freed
del owner, owners
assert sorted(freed) == sorted(handles), (freed, handles)
print("all good")
