# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Distances from points to a triangle mesh, exact and many at once, for arrays of numpy, PyTorch, CuPy and JAX;
rigid bodies against a wall; and a wall that pushes spheres, step by step.

    import lsdcd
    grid = lsdcd.Mesh("wall.stl").grid(cutoff=0.01)
    answer = grid.query(points, "distance triangle side")    # points: (..., 3), float32 or float64
    answer.distance, answer.triangle, answer.side

    body = lsdcd.Body(lsdcd.Mesh("wall.stl"), lsdcd.Mesh("body.stl"))
    found = body.collide(position=(0, 0, 1), quaternion=(1, 0, 0, 0))
    found.collides, found.wall, found.body                    # triangles, pair by pair

    wall = lsdcd.Wall("hooke/history 1e5 3e4 50 NULL 0.5 1 mesh $drum motion caller", drum=lsdcd.Mesh("drum.stl"))
    wall.set_pose("drum", angular_velocity=(0, 1, 0))       # before each step
    wall.step(x, v, omega, radius, mass, force, torque, dt=1e-5)    # adds to force and torque, (n, 3)

Lengths are in the unit of the mesh; a wall's units are any that are consistent. A query lets other Python threads run,
and any number of threads may ask one grid at once. What is told about lsdcd.h holds here; its errors are lsdcd.Error
with a `code`. LSDCD_LIBRARY may name the shared library. How answers are found: doc/theory.md of the sources.
"""
from __future__ import annotations

import ctypes
import math
import os
import threading
from typing import Any, Callable, Iterable, Literal, Mapping, Protocol, Sequence, TypeAlias, cast, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _shapes
from ._c import DEVICES as DEVICES, ERRORS as ERRORS, Device as Device, Error as Error, Progress as Progress
from ._c import (_BodyFacts, _BodyOptions, _BodyState, _Broadcast, _Collision, _Contacts, _GridFacts, _GridOptions, _Host,
                 _MeshArrays, _MeshFacts, _Owner, _Query, _Record, _Reduce, _Show, _Spheres, _WallOptions, _WallStep,
                 _WallContacts, _WallImpacts, _WallTotals, _as_floats, _c_double, _c_int, _c_text, _check, _chosen, _facts, _flag, _in_use,
                 _int, _interrupts_held, _lib, _listened, _numbers, _real, _size, _sized, _text, _tuple)
from ._names import KeywordName as KeywordName, OutputName as OutputName
from ._shapes import (ShapeContacts as ShapeContacts, ShapeDistances as ShapeDistances, ShapeFacts as ShapeFacts,
                      shape_facts as shape_facts)
from ._sub_models import SubModelFacts as SubModelFacts, sub_models as sub_models
from ._words import KEYWORDS as KEYWORDS, Keyword as Keyword, Values as _Values, argument_hint as _argument_hint

__version__: str = _lib.lsdcd_version().decode()


def _all_outputs() -> dict[OutputName, tuple[str, str]]:
    found: dict[OutputName, tuple[str, str]] = {}
    name, unit, text = ctypes.c_char_p(), ctypes.c_char_p(), ctypes.c_char_p()
    while _lib.lsdcd_output_info(len(found), ctypes.byref(name), ctypes.byref(unit), ctypes.byref(text)) == 0:
        found[cast(OutputName, _text_of(name))] = _text_of(unit), _text_of(text)
    return found


def _text_of(value: ctypes.c_char_p) -> str:
    return (value.value or b"").decode()


# The numbers that Wall.outputs() may give: the kind of unit, and what they are.
OUTPUTS: dict[OutputName, tuple[str, str]] = _all_outputs()
FOUND, CERTIFIED, SIDE_ESTIMATED = 1, 2, 4
NONE = 0xffffffff
# What a query answers: how many dimensions beyond the points', and the type, None: that of the points.
ANSWERS: dict[str, tuple[int, Any]] = {
    "distance": (0, None), "closest": (1, None), "normal": (1, None), "triangle": (0, np.uint32), "feature": (0, np.uint32),
    "side": (0, np.int8), "status": (0, np.uint8), "winding": (0, None), "signed_distance": (0, None), "barycentric": (1, None)}
# And of each contact.
OF_CONTACTS: dict[str, tuple[int, Any]] = {
    "point": (1, None), "normal": (1, None), "distance": (0, None), "overlap": (0, None), "weight": (0, None),
    "triangle": (0, np.uint32), "feature": (0, np.uint32)}


class MeshFacts(_Record):
    """What lsdcd_mesh_facts says of a mesh."""
    triangles: int    # as given
    faces: int        # after welding, as are edges and vertices; faces without area are none
    edges: int
    vertices: int
    open_edges: int    # of one face
    closed: int
    oriented: int      # closed, windings agree, no shells meet, no triangle is there in both windings
    area: float        # length^2
    volume: float      # length^3, < 0 where normals point in
    lo: tuple[float, float, float]
    hi: tuple[float, float, float]
    meeting_pairs: int    # of triangles of different closed shells
    given_vertices: int    # those given with faces or numbered in a file; of STL and triangles three corners each


class MeshArrays(_Record):
    """The welded mesh: F faces, which have an area, E edges and V vertices, also those of other triangles."""
    vertices: NDArray[np.float64]    # (V, 3), length
    faces: NDArray[np.uint32]        # (F, 3), vertices in the order given
    face_edges: NDArray[np.uint32]   # (F, 3), edge k from vertex k to the next
    triangle: NDArray[np.uint32]     # (F,), the number as given, from 0
    edges: NDArray[np.uint32]        # (E, 2), the lower vertex first
    edge_first: NDArray[np.uint32]   # (E + 1,)
    edge_faces: NDArray[np.uint32]   # (3 F,), faces of edge e: edge_faces[edge_first[e]:edge_first[e + 1]]
    # (given_vertices,), of each vertex as given the one here that it was welded to; those of STL and of triangles are
    # their corners, in their order. NONE: a vertex of no face; of a file one at whose place no face has a corner.
    welded_vertex: NDArray[np.uint32]
    # (triangles,), of each triangle as given its face; one that has the corners of another, in either winding, has that
    # one's face. NONE: one without area, which is no face.
    welded_face: NDArray[np.uint32]


@runtime_checkable
class HasFaces(Protocol):
    """A mesh of another library."""
    vertices: Any    # (m, 3)
    faces: Any       # (n, 3), whole numbers from 0


class Mesh(_Owner):
    """From a file (STL, OBJ, PLY or OFF); from triangles, (n, 3, 3); from vertices, (m, 3), and faces, (n, 3), whole
    numbers from 0; or from what has both as `vertices` and `faces`, as meshes of trimesh have. Corners closer than `weld`, a length, become one; < 0: equal
    ones, and those on open edges within 1e-6 of the part that edges connect. Raises ValueError for another shape and a vertex that there is not, TypeError for faces that are not
    whole numbers, Error, a ValueError, too, for a file that cannot be read. Any number of threads may share it."""
    _free = _lib.lsdcd_mesh_free

    def __init__(self, source: str | bytes | os.PathLike[str] | ArrayLike | HasFaces, faces: ArrayLike | None = None,
                 weld: float = -1.0) -> None:
        super().__init__()
        given: Any = source
        if faces is None and isinstance(given, HasFaces):
            given, faces = given.vertices, given.faces
        weld = _c_double(weld, "weld")
        if isinstance(given, (str, bytes, os.PathLike)):
            _check(_lib.lsdcd_mesh_read(_c_text(given, "the file's name"), weld, ctypes.byref(self._handle)))
            return
        if faces is not None:
            vertices = np.ascontiguousarray(_as_floats(given, "vertices"))
            if vertices.ndim != 2 or vertices.shape[1] != 3:
                raise ValueError(f"vertices have the shape {vertices.shape}, not (m, 3)")
            numbers = _vertex_numbers(faces, len(vertices))
            _check(_lib.lsdcd_mesh_from_faces(vertices.ctypes.data, int(vertices.dtype == np.float32), len(vertices),
                                              numbers.ctypes.data, len(numbers), weld, ctypes.byref(self._handle)))
            return
        corners = np.ascontiguousarray(_as_floats(given, "triangles"), dtype=np.float64)
        if corners.ndim != 3 or corners.shape[1:] != (3, 3):
            raise ValueError(f"triangles have the shape {corners.shape}, not (n, 3, 3)")
        _check(_lib.lsdcd_mesh_from_corners(corners.ctypes.data, len(corners), weld,
                                            ctypes.byref(self._handle)))

    @property
    def facts(self) -> MeshFacts:
        return MeshFacts(**_facts(_MeshFacts, _lib.lsdcd_mesh_get_facts, self._handle))

    def __repr__(self) -> str:
        return f"<Mesh of {self.facts.triangles} triangles>" if self._handle else "<Mesh, closed>"

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(V, 3), length, of the welded mesh: arrays().vertices."""
        return self.arrays().vertices

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(F, 3), vertices of each face of the welded mesh: arrays().faces."""
        return self.arrays().faces

    def arrays(self) -> MeshArrays:
        """The welded mesh, whose numbers, from 0, features have."""
        facts = self.facts
        v, f, e = facts.vertices, facts.faces, facts.edges
        shapes = {"faces": (f, 3), "face_edges": (f, 3), "triangle": (f,), "edges": (e, 2), "edge_first": (e + 1,),
                  "edge_faces": (3 * f,), "welded_vertex": (facts.given_vertices,), "welded_face": (facts.triangles,)}
        made = MeshArrays(vertices=np.empty((v, 3)), **{k: np.empty(s, np.uint32) for k, s in shapes.items()})
        arrays = _sized(_MeshArrays, **{name: array.ctypes.data for name, array in vars(made).items()})
        _check(_lib.lsdcd_mesh_get_arrays(self._handle, ctypes.byref(arrays)))
        return made

    @property
    def report(self) -> str:
        """What `lsdcd inspect` says."""
        return _text(_lib.lsdcd_mesh_report(self._handle))

    def grid(self, cutoff: float | None = None, cell: float = 0.0, nearest: int = 0, precision: Literal["double", "float"] = "double",
             memory: float = 0.0, cache: str | os.PathLike[str] | None = None, threads: int = 0, device: Device = "cpu",
             progress: Progress | None = None) -> Grid:
        """A Grid for distances up to `cutoff`, a length, None: any. The words are those of lsdcd_grid_options: `cell`,
        the edge of a cell, 0: chosen; `nearest` 0: complete lists; `precision` "double" or "float"; `memory`, bytes, 0:
        chosen; `cache`, a file that keeps the cells; `device` "cpu" or "cuda", which builds them. `progress` is called
        some ten times a second with what is done and the share of it. Raises Error for settings that cannot be kept, and
        what `progress` raises."""
        if cutoff is not None and _c_double(cutoff, "cutoff") == 0:    # which is any of C
            raise ValueError("cutoff is 0; it is above 0, or None: any distance")
        options = _sized(_GridOptions, cutoff=0.0 if cutoff is None else cutoff, cell=cell, nearest=nearest,
                         precision=_chosen("precision", precision, ("double", "float")), memory=memory,
                         cache=cache or None, threads=threads,
                         device=_chosen("device", device, DEVICES))
        return Grid(self, options, progress)


class Contacts(_Record):
    """All contacts of n spheres, m in all; those of sphere i, in C order of the points' shape, are first[i]:first[i + 1],
    ascending in features. Numbers are of the points' type."""
    first: Any       # (n + 1,), uintp, int64 in PyTorch
    point: Any       # (m, 3), on the mesh
    normal: Any      # (m, 3), length 1, from the mesh to the centre
    distance: Any    # (m,), >= 0
    overlap: Any     # (m,), radius - distance > 0
    weight: Any      # (m,), the share of each by the corner rule, 0 to 1
    triangle: Any    # (m,), as those of an Answer
    feature: Any     # (m,)


class Answer(_Record):
    """What a query was asked for. Shapes are those of the points, (..., 3), with and without the last dimension. Where
    nothing is found distance is inf, closest the point, normal 0, triangle and feature NONE (-1 in int32)."""
    distance: Any    # (...), the points' type; in the unit of the mesh
    closest: Any     # (..., 3), the points' type
    normal: Any      # (..., 3), the points' type: length 1, from the mesh to the point
    triangle: Any    # (...), uint32, int32 in PyTorch: from 0 as given
    feature: Any     # (...), uint32, int32 in PyTorch: kind << 30 | number, kind 0 face, 1 edge, 2 vertex
    side: Any        # (...), int8: 1 outside and on the mesh, -1 inside, 0 not known
    status: Any      # (...), uint8: bits FOUND, CERTIFIED and SIDE_ESTIMATED
    winding: Any     # (...), the points' type: how often the mesh winds round the point, a whole number if it has sides
    # (...), the points' type: the distance, negative where side is -1, nan where it is 0: > 0 outside, < 0 inside, 0 on the
    # mesh; inf or -inf where nothing is found.
    signed_distance: Any
    # (..., 3), the points' type: shares of the triangle's welded corners, in the order given, in closest; >= 0, with the
    # sum 1. nan where there is no triangle.
    barycentric: Any


class GridFacts(_Record):
    """What lsdcd_grid_facts says of a grid."""
    cutoff: float    # length, inf: any
    cell: float      # length, 0: there are no cells yet
    bytes: int
    nearest: int
    has_sides: int
    from_cache: int


class Grid(_Owner):
    """Made by Mesh.grid(). Any number of threads may ask it at once."""
    _free = _lib.lsdcd_grid_free

    def __init__(self, mesh: Mesh, options: Any, progress: Progress | None = None) -> None:
        super().__init__()
        self._streams = threading.local()
        _listened(lambda: _lib.lsdcd_grid_build(mesh._handle, ctypes.byref(options), ctypes.byref(self._handle)), options,
                  progress, mesh)

    @property
    def facts(self) -> GridFacts:
        return GridFacts(**_facts(_GridFacts, _lib.lsdcd_grid_get_facts, self._handle))

    @property
    def report(self) -> str:
        """Its cells, its memory, and what became of the cache."""
        return _text(_lib.lsdcd_grid_report(self._handle))

    def query(self, points: Any, want: str | Iterable[str] | None = None, radius: Any = None, threads: int = 0, *,
              out: Mapping[str, Any] | Answer | None = None, stream: Any = None, estimate_sides: bool = False,
              progress: Progress | None = None) -> Answer:
        """Answers for points of shape (..., 3), in the unit of the mesh, as an Answer with what `want` names: distance
        (the default), closest, normal, triangle, feature, side, status, winding, signed_distance, barycentric.

        points: float32, or float64, which all else becomes; of any layout, on the host. Those of PyTorch, CuPy, JAX and
        others that have `__dlpack__` or `__cuda_array_interface__` are read in place, and PyTorch's and CuPy's answered
        by arrays of theirs. On a CUDA device they are float32 or float64, with one step from point to point.
        radius: > 0, one of all, or (...) in the points' type: nothing at it or farther is found. By default the cutoff,
        or any distance.
        threads: on the host; 0: OMP_NUM_THREADS, or one.
        out: arrays of the caller for some of the answers, by name, or an Answer of before; of the points' device, and
        of the type and shape that Answer says. Without `want` these are asked for.
        stream: of the device, on which points are ready and answers will be: one of PyTorch or CuPy, or a cudaStream_t
        as a number. By default that of the array's interface, or the current one of PyTorch or CuPy. The call returns
        when its work is in the stream, but waits for it where another library owns the points. The grid keeps what
        it needs for the stream, which must live as long; a number does not keep it alive.
        estimate_sides: where the mesh has no sides, because it is open or double-sided, or facets are wound against
        each other, `side` is -1 where the whole number nearest to `winding` is not 0, else 1, and `signed_distance` goes
        by it. These are not certified: status has SIDE_ESTIMATED. On the host, as winding is.
        progress: as of Mesh.grid(), on the host; answers of a call that it ended are of no use.

        Raises ValueError for values, words, shapes and strides that are wrong, TypeError for a wrong type or place, Error, a
        ValueError, too, for a radius beyond the cutoff, and for sides where there are none."""
        asked, kept, steps = _read_points(points, stream)
        given, shape, real = kept[-1], asked.shape[:-1], kept[-1].dtype
        query = _sized(_Query, n=math.prod(shape), type=int(real == np.float32), threads=threads,
                       estimate_sides=_flag(estimate_sides, "estimate_sides"), points=given.address, points_row=steps[0],
                       points_column=steps[1])
        if radius is not None:
            _set_radius(query, radius, given, shape, kept)
        handle, owner = (0, None) if given.on_host else _arrays.stream_of(asked, stream)
        outs: Mapping[str, Any] = {} if out is None else vars(out) if isinstance(out, Answer) else out
        words = want.split() if isinstance(want, str) else list(outs) or ["distance"] if want is None else list(want)
        unknown = sorted(map(str, set(words) - set(ANSWERS)))
        if unknown:
            raise ValueError(f"{', '.join(unknown)}: a query answers {', '.join(ANSWERS)}")
        left = sorted(set(outs) - set(words))
        if left:
            raise ValueError(f"out has {', '.join(left)}, which is not asked for")
        answer = Answer()
        for word in words:
            inner, dtype = ANSWERS[word]
            dtype = real if dtype is None else np.dtype(dtype)
            wanted = (*shape, 3) if inner else shape
            if word in outs:
                made, place = outs[word], _out(outs[word], word, wanted, inner, dtype, given, kept)
            else:
                made, place = _arrays.empty_like(asked, wanted, dtype, owner if stream is None else stream)
            kept.append(place)
            setattr(answer, word, made)
            setattr(query, word, place.address)
            to = place.steps(inner)
            if dtype == real and to is not None:
                for name, step in zip(("row", "column") if inner else ("step",), to):
                    setattr(query, f"{word}_{name}", step)
        if given.on_host:
            _listened(lambda: _lib.lsdcd_query_host(self._handle, ctypes.byref(query)), query, progress, self)
            return answer
        if query.n > 0:
            self._query_on(given.device or 0, handle, owner, query, any(map(_arrays.must_wait, kept)))
        return answer

    def contacts(self, points: Any, radius: Any, threads: int = 0, progress: Progress | None = None, *,
                 out: Mapping[str, Any] | Contacts | None = None) -> Contacts:
        """All contacts of spheres: each place of the mesh whose distance to a centre is a local minimum below the
        radius. The grid has a cutoff.

        points: centres, (..., 3), in the unit of the mesh, on the host, of what query() takes there; radius: one of all, or
        (...). Numbers are float32 if points are, else float64. progress: as of Mesh.grid().
        out: arrays of the caller for some of what Contacts has, by name, or Contacts of before: contiguous, of the types
        there; `first` of n + 1 numbers, all others with room for as many contacts. The Contacts returned have the parts
        of them that are used. With too little room a ValueError says how many contacts there are.

        Raises ValueError for wrong shapes and too little room, TypeError for a wrong type or place, Error, a ValueError, too,
        for a radius below 0 or beyond the cutoff, a grid without a cutoff, with `nearest` or in float, and more than 512
        contacts of a sphere."""
        asked, kept, steps = _read_points(points)
        given, shape, real = kept[-1], asked.shape[:-1], kept[-1].dtype
        if not asked.on_host:
            raise TypeError(f"points are {_place(asked)}, and contacts are found on the host alone: bring them there")
        n = math.prod(shape)
        given_radius = _arrays.read(radius, "radius")
        if given_radius.shape not in ((), shape):
            raise ValueError(f"radius has the shape {given_radius.shape}, not () or {shape}")
        _same_place(given_radius, given, "radius")
        radii = np.ascontiguousarray(np.broadcast_to(_as_floats(given_radius.host(), "radius").astype(real), shape))
        kept += [given_radius, _arrays.of_numpy(radii)]
        outs: dict[str, Any] = {} if out is None else dict(vars(out) if isinstance(out, Contacts) else out)
        unknown = sorted(map(str, set(outs) - {"first", *OF_CONTACTS}))
        if unknown:
            raise ValueError(f"out has {', '.join(unknown)}: contacts have first, {', '.join(OF_CONTACTS)}")

        def place(name: str, length: int | None, inner: int, dtype: Any) -> tuple[Any, _arrays.Array]:
            """An array and where it lies; `length` None: that of the caller's."""
            dtype = real if dtype is None else np.dtype(dtype)
            if name in outs:
                wanted = None if length is None else (length,)
                kept.append(_out(outs[name], name, wanted, inner, dtype, given, kept, packed=True))
                return outs[name], kept[-1]
            return _arrays.empty_like(asked, (length or 0, 3) if inner else (length or 0,), dtype)

        first, first_place = place("first", n + 1, 0, np.uintp)
        mine = {name: place(name, None, *OF_CONTACTS[name]) for name in OF_CONTACTS if name in outs}
        rooms = {name: at.shape[0] for name, (_, at) in mine.items()}
        if len(set(rooms.values())) > 1:
            raise ValueError(f"arrays of out have room for different numbers of contacts, {rooms}: give them one length")
        ask = _sized(_Contacts, n=n, type=int(real == np.float32), threads=threads, points=given.address,
                     points_row=steps[0], points_column=steps[1], radii=radii.ctypes.data, first=first_place.address,
                     contacts=next(iter(rooms.values()), n))
        while True:
            m = ask.room = ask.contacts
            made = {name: mine[name] if name in mine else place(name, m, *kind) for name, kind in OF_CONTACTS.items()}
            for name, (_, at) in made.items():
                setattr(ask, name, at.address)
            _listened(lambda: _lib.lsdcd_contacts_host(self._handle, ctypes.byref(ask)), ask, progress, self)
            if ask.contacts <= m:
                used = slice(ask.contacts)    # of arrays that have no slices, as numpy's
                return Contacts(first=first, **{name: array[used] if hasattr(array, "__getitem__") else at.host()[used]
                                                for name, (array, at) in made.items()})
            if mine:
                raise ValueError(f"there are {ask.contacts} contacts, and out has room for {m}: give longer arrays")

    def shape_contacts(self, centres: ArrayLike, half_axes: ArrayLike, exponents: ArrayLike | None = None,
                       quaternions: ArrayLike | None = None, threads: int = 0, progress: Progress | None = None) -> ShapeContacts:
        """All contacts of ellipsoids and superellipsoids: each place of the mesh whose signed distance from the grain is a local
        minimum below 0, however the mesh is cut into triangles.

        centres: (n, 3); half_axes: a b c, (n, 3), or (3,) for all; exponents: n1 n2 from 2 to 20, (n, 2), or (2,) for all, None:
        2, ellipsoids; quaternions: w i j k, (n, 4), that turn a grain's axes to where they are, None: not turned. One grain may
        be without the first dimension. progress: as of Mesh.grid().

        Raises ValueError for wrong shapes of arrays, and Error, a ValueError, too, for numbers that make no grain, and for a grid
        with `nearest` or in float."""
        return _shapes.contacts(self, centres, half_axes, exponents, quaternions, threads, progress)

    def shape_distances(self, centres: ArrayLike, half_axes: ArrayLike, exponents: ArrayLike | None = None,
                        quaternions: ArrayLike | None = None, threads: int = 0,
                        progress: Progress | None = None) -> ShapeDistances:
        """How far ellipsoids and superellipsoids are from the mesh, at any range, below 0 by the overlap. Arguments and errors are
        those of shape_contacts()."""
        return _shapes.distances(self, centres, half_axes, exponents, quaternions, threads, progress)

    def _query_on(self, device: int, handle: int, owner: Any, query: Any, wait: bool) -> None:
        """On a stream of a device; `owner` keeps the stream alive."""
        driver = _arrays.driver()
        with driver.on(device):
            streams: dict[Any, Any] = self._streams.__dict__    # of this thread
            known = streams.pop((device, handle), None) or _Stream(self, handle, owner)
            streams[device, handle] = known    # the last one used is the last one
            if len(streams) > _MOST_STREAMS:
                del streams[next(iter(streams))]
            _check(_lib.lsdcd_query_stream(known._handle, ctypes.byref(query)))
            if wait:
                driver.wait(handle)


class _Stream(_Owner):
    """A Grid on a stream of the device that is current. It keeps `owner`, whose stream ends after it."""
    _free = _lib.lsdcd_stream_free

    def __init__(self, grid: Grid, handle: int, owner: Any) -> None:
        super().__init__()
        self._stream_owner = owner
        _check(_lib.lsdcd_stream_open(grid._handle, handle, ctypes.byref(self._handle)))


_MOST_STREAMS = 8    # that a grid keeps for a thread: each has memory of its device


def _read_points(points: Any, stream: Any = None) -> tuple[_arrays.Array, list[_arrays.Array], tuple[int, ...]]:
    """The array that was given; all that the library reads, kept alive, the last one as floats of the machine; its steps."""
    asked = _arrays.read(points, "points", _arrays.stream_handle(stream))
    if asked.shape[-1:] != (3,):
        raise ValueError(f"points have the shape {asked.shape}, not (..., 3), as (n, 3) or (3,){_remedy(asked.shape)}")
    if asked.on_host and stream is not None:
        raise ValueError("stream is given, but points are on the host")
    kept = [asked]
    if asked.on_host:
        kept.append(_arrays.of_numpy(_as_floats(asked.host(), "points")))
    given = kept[-1]
    if given.dtype not in (np.float32, np.float64) or not given.dtype.isnative:
        raise TypeError(f"points on a device are of type {given.dtype}: convert them to float32 or float64")
    if given.steps(1) is None and given.on_host:
        kept.append(_arrays.of_numpy(given.host().copy()))
    steps = kept[-1].steps(1)
    if steps is None:
        raise ValueError(f"points on a device have the strides {given.strides}, not one step from point to point: "
                         "make them contiguous")
    return asked, kept, steps


def _remedy(shape: tuple[int, ...]) -> str:
    """How an array of another shape becomes points."""
    if shape[:1] == (3,) and len(shape) > 1:
        return ": coordinates come last, so give points.T" if len(shape) == 2 else ": coordinates come last, move that axis"
    if len(shape) == 1 and shape[0] % 3 == 0:
        return ": give points.reshape(-1, 3)"
    return ""


def _whole_numbers(given: ArrayLike, name: str) -> NDArray[Any]:
    """Integers of any size; an empty list has none that are not."""
    values = _arrays.plain(given, name)
    if values.size and values.dtype.kind not in "iu":
        raise TypeError(f"{name}: {values.dtype}, not whole numbers")
    return values


def _in_a_row(values: NDArray[Any], name: str, kind: Any) -> NDArray[Any]:
    if values.ndim != 1:
        raise ValueError(f"{name} has the shape {values.shape}, not (n,)")
    if kind is np.intp and values.size and values.max() > np.iinfo(np.intp).max:
        raise ValueError(f"{name} has {values.max()}, which is no sphere")
    return np.ascontiguousarray(values, dtype=kind)


def _set_radius(query: Any, radius: Any, points: _arrays.Array, shape: tuple[int, ...], kept: list[_arrays.Array]) -> None:
    radii = _arrays.read(radius, "radius")
    if radii.shape == ():
        query.radius = float(_as_floats(radii.host(), "radius") if radii.on_host else radius)
        if not query.radius > 0:
            raise ValueError(f"radius is {radius}, not above 0")
        return
    if radii.shape != shape:
        raise ValueError(f"radius has the shape {radii.shape}, not {shape}, that of points without the last dimension")
    _same_place(radii, points, "radius")
    if radii.on_host:
        values = np.ascontiguousarray(_as_floats(radii.host(), "radius"), dtype=points.dtype)
        if not (values > 0).all():
            raise ValueError(f"radius is {values[~(values > 0)][0]} at a point, not above 0")
        radii = _arrays.of_numpy(values)
    steps = radii.steps(0)
    if radii.dtype != points.dtype:
        raise TypeError(f"radius on a device is of type {radii.dtype}, points of type {points.dtype}: give them one type")
    if steps is None:
        raise ValueError(f"radius on a device has the strides {radii.strides}, not one step from point to point: make it "
                         "contiguous")
    kept.append(radii)
    query.radii, query.radii_step = radii.address, steps[0]


def _same_place(array: _arrays.Array, points: _arrays.Array, name: str) -> None:
    if array.device != points.device:
        raise TypeError(f"{name} is {_place(array)}, points are {_place(points)}: move one of them")


def _place(array: _arrays.Array) -> str:
    return "on the host" if array.on_host else f"on CUDA device {array.device}"


def _is_array(values: Any) -> bool:
    """Is it memory that can be read and written in place?"""
    return isinstance(values, np.ndarray) or hasattr(values, "__dlpack__") \
        or getattr(values, "__cuda_array_interface__", None) is not None


def _out(values: Any, word: str, shape: tuple[int, ...] | None, inner: int, dtype: np.dtype[Any], points: _arrays.Array,
         kept: list[_arrays.Array], packed: bool = False) -> _arrays.Array:
    """Where the caller wants an answer, of this shape with `inner` dimensions to a point, or of any length, None; refused
    if the library cannot write it there. `packed`: without steps between."""
    name = f"out: {word}"
    if not _is_array(values):
        raise TypeError(f"{name} is a {type(values).__name__}, not an array")
    place = _arrays.read(values, name)
    _same_place(place, points, name)
    signed = {np.dtype(np.uint32): np.int32, np.dtype(np.uintp): np.intp}.get(dtype, dtype)
    if place.dtype not in (dtype, signed):
        raise TypeError(f"{name} is of type {place.dtype}, not {dtype}: make it with dtype={dtype}")
    if shape is None:
        shape = (*place.shape[:1], 3) if inner else place.shape[:1] or (1,)
    if place.shape != shape:
        raise ValueError(f"{name} has the shape {place.shape}, not {shape}: make it of that shape")
    if not place.writable:
        raise ValueError(f"{name} cannot be written to: give a copy")
    steps = place.steps(inner)
    packed = packed or dtype != points.dtype    # those of numbers have steps
    if steps is None or packed and steps != ((3, 1) if inner else (1,)) and math.prod(shape) > 1:
        raise ValueError(f"{name} has the strides {place.strides}: make it contiguous")
    if place.on_host and any(a.on_host and np.shares_memory(a.host(), place.host()) for a in kept):
        raise ValueError(f"{name} shares memory with points, radius or another answer: give an array of its own")
    return place


class BodyFacts(_Record):
    """What lsdcd_body_facts says of a body."""
    triangles: int    # with an area
    pieces: int       # that they are cut into
    cell: float       # length
    grid_bytes: int
    nearest: int
    device: int       # of DEVICES


class Collision(_Record):
    """What a body meets in a pose. Pairs ascend by the body's triangle."""
    collides: bool
    wall: NDArray[np.uint32]    # (n,) triangle of the wall of each pair, from 0 as given; NONE: one without area
    body: NDArray[np.uint32]    # (n,) and of the body
    segments: NDArray[np.float64]    # (n, 2, 3) where asked for, lengths; nan where a pair lies in one plane
    uncertain: int    # with `nearest`: pieces where pairs may be missing; 0: exact


class Body(_Owner):
    """A rigid body's Mesh against a wall's Mesh, or against the wall of another Body, which both then
    share; the words are those of lsdcd_body_options: `cell`, a length, 0: chosen; `memory`, bytes. One thread at a
    time. `progress`: as of Mesh.grid(). Raises Error for settings that cannot be kept."""
    _free = _lib.lsdcd_body_free

    def __init__(self, wall: Mesh | Body, mesh: Mesh, cell: float = 0.0, nearest: int = 0, memory: float = 0.0,
                 threads: int = 0, device: str = "cpu", progress: Progress | None = None) -> None:
        super().__init__()
        for name, given, kinds in (("wall", wall, (Mesh, Body)), ("mesh", mesh, (Mesh,))):
            if not isinstance(given, kinds):
                raise TypeError(f"{name} is a {type(given).__name__}, not a {' or '.join(kind.__name__ for kind in kinds)}")
        self._room = 1024
        options = _sized(_BodyOptions, cell=cell, nearest=nearest, memory=memory, threads=threads,
                         device=_chosen("device", device, DEVICES))
        if isinstance(wall, Body):
            options.same_wall = wall._handle
        _listened(lambda: _lib.lsdcd_body_make(None if isinstance(wall, Body) else wall._handle, mesh._handle,
                                               ctypes.byref(options), ctypes.byref(self._handle)), options, progress, wall, mesh)

    @property
    def facts(self) -> BodyFacts:
        return BodyFacts(**_facts(_BodyFacts, _lib.lsdcd_body_get_facts, self._handle))

    def collide(self, position: ArrayLike | None = None, quaternion: ArrayLike | None = None, matrix: ArrayLike | None = None,
                segments: bool = False, threads: int = 0) -> Collision:
        """What meets in a pose: `position` (3,), lengths; `quaternion` (4,), w x y z, of length 1; or both; or `matrix`,
        (3, 4) or (4, 4). Raises ValueError for another shape, Error for no rigid motion."""
        rows = 4 if matrix is not None and np.shape(matrix) == (4, 4) else 3
        given = {"position": _numbers(position, (3,), "position"), "quaternion": _numbers(quaternion, (4,), "quaternion"),
                 "matrix": _numbers(matrix, (rows, 4), "matrix")}
        pose = {name: values for name, values in given.items() if values is not None}
        if len(pose.get("matrix", ())) == 4 and pose["matrix"][3].tolist() != [0, 0, 0, 1]:
            raise ValueError("the last row of matrix is not 0, 0, 0, 1")
        with_segments = _flag(segments, "segments")
        ask = _sized(_Collision, threads=threads, **{k: v.ctypes.data for k, v in pose.items()})
        while True:
            ask.room = self._room
            wall, body = np.empty(ask.room, np.uint32), np.empty(ask.room, np.uint32)
            ask.wall_triangle, ask.body_triangle = wall.ctypes.data, body.ctypes.data
            if with_segments:
                found = np.empty((ask.room, 2, 3))
                ask.segment = found.ctypes.data
            _check(_lib.lsdcd_collide(self._handle, ctypes.byref(ask)))
            if ask.pairs <= ask.room:
                break
            self._room = ask.pairs
        answer = Collision(collides=bool(ask.collides), wall=wall[:ask.pairs], body=body[:ask.pairs],
                           uncertain=ask.uncertain)
        if with_segments:
            answer.segments = found[:ask.pairs]
        return answer


class WallTotals(_Record):
    """Sums of a wall's last step, in its units: what lsdcd_wall_totals says."""
    force: NDArray[np.float64]     # (3,) on the mesh
    torque: NDArray[np.float64]    # (3,) on the mesh, about the point asked for
    contacts: float
    overlap: float        # the largest, of the radius or least half-axis
    uncertified: float    # spheres whose answer is not certified; see `nearest`
    worn_volume: float    # so far
    power: float          # of the mesh on the spheres, by its motion; of nodes by velocities of half a step before
    servo_position: float    # 0 without a servo, as the next two
    servo_velocity: float
    servo_push: float
    removed_volume: float    # by which wear has moved the mesh, see `wear ... deform`
    held_back_volume: float  # likewise, worn at vertices that stay
    couple: NDArray[np.float64]    # (3,) on a mesh whose nodes you move, which no node gets: the torque is of their forces
    mean_force: NDArray[np.float64]     # (3,) over the steps of `average`
    mean_torque: NDArray[np.float64]    # (3,) likewise
    dissipated_power: NDArray[np.float64]    # (5,) of a wall with `energy`, in the step: damping, slider, rolling, twisting, adhesion
    dissipated: NDArray[np.float64]     # (5,) likewise energy since the first step
    lost: NDArray[np.float64]           # (4,) by lever arms, stiffness, turned springs, inserted and deleted contacts
    contact_work: float   # of spheres and mesh on their contacts
    drive_work: float     # of the mesh on the spheres
    held_energy: float    # elastic, after the step
    remainder: float      # contact_work less all that is held or lost
    impacts: float        # number since the first step, of a wall with `impacts`
    impact_energy: float  # sum of m v^2/2, with the speed along the normal
    lost_wear: float      # energy that contacts lose as wear moves the mesh, of a wall with `energy` and `wear ... deform`
    dissipated_power_plastic: float    # by yielding, of a wall with `energy` and a law that yields, in the step
    dissipated_plastic: float    # likewise energy since the first step
    elastic_energy: float    # of overlaps and tangential springs, by the forces of the step


class WallContacts(_Record):
    """Contacts of a wall's last step, in this process; those of a sphere come one after the other. With `energy` those that the step has
    ended are behind the others, without force and overlap. Causes are those of WallTotals, and all is 0 without `energy`."""
    sphere: NDArray[np.intp]       # (n,) its place in the arrays of the step, from 0
    mesh: NDArray[np.int32]        # (n,) from 0
    force: NDArray[np.float64]     # (n, 3) on the sphere
    point: NDArray[np.float64]     # (n, 3) of the mesh, the closest to the centre, or the deepest in an ellipsoid, when the step began
    overlap: NDArray[np.float64]   # (n,) length, then
    dissipated_power: NDArray[np.float64]   # (n, 5) by cause, in the last step
    dissipated: NDArray[np.float64]         # (n, 5) energy by cause, since the contact began
    has_ended: NDArray[np.int32]   # (n,) 1: the sphere touched there in the step before, and no more; `point` is where it was
    dissipated_power_plastic: NDArray[np.float64]    # (n,) by yielding, in the last step
    dissipated_plastic: NDArray[np.float64]          # (n,) by yielding, since the contact began


class WallImpacts(_Record):
    """The spectrum of the impacts on a mesh since the first step: bins of the energy of an impact, ten of which are a factor of ten,
    from the first to the last one with an impact."""
    begins: NDArray[np.float64]    # (n,) energy of an impact, 10^(k/10) with a whole k
    ends: NDArray[np.float64]      # (n,) likewise
    impacts: NDArray[np.float64]   # (n,) number
    energy: NDArray[np.float64]    # (n,) the sum of their m v^2/2


class Host(Protocol):
    """What a wall asks of a program of several processes, as lsdcd_host. Each function is called on all processes
    and changes the array in place. With mpi4py:

        class Mpi:
            rank, size = comm.rank, comm.size
            def sum(self, numbers): comm.Allreduce(MPI.IN_PLACE, numbers)
            def max(self, numbers): comm.Allreduce(MPI.IN_PLACE, numbers, MPI.MAX)
            def broadcast(self, data, source): comm.Bcast(data, source)

    A `node_rank`, from 0 on each computer, shares out its GPUs."""
    rank: int    # of this process, from 0
    size: int    # how many there are

    def sum(self, numbers: NDArray[np.float64]) -> None: ...
    def max(self, numbers: NDArray[np.float64]) -> None: ...
    def broadcast(self, data: NDArray[np.uint8], source: int) -> None: ...


class BodyState(_Record):
    """A rigid body after a step, with velocities of the whole step. Vectors are along the axes of the box."""
    centre: NDArray[np.float64]              # (3,), of mass, length
    quaternion: NDArray[np.float64]          # (4,), w x y z: from where the mesh was placed
    velocity: NDArray[np.float64]            # (3,), of the centre, length/time
    angular_velocity: NDArray[np.float64]    # (3,), 1/time
    reaction_force: NDArray[np.float64]      # (3,), of the joint on the body, without spring, motor and limits
    reaction_torque: NDArray[np.float64]     # (3,), about the joint's point, or the centre of mass
    coordinate: float                        # of a hinge (radians) or slider (length); else 0
    energy: float                            # kinetic, and of its spring
    stop_force: float                        # of a stop, along (about) the axis: holding the body, or taking its speed


class HasArray(Protocol):
    """What numpy makes an array of: numpy's numbers and arrays, and those of other libraries on the host."""

    def __array__(self) -> NDArray[Any]: ...


# A value of words, in which it stands as $NAME: a mesh, a text, a number (None: NULL), several, or rows of numbers. There is one Sequence, as mypy
# would take a list of int and float for a list of object if it could be of several.
Value: TypeAlias = Mesh | str | bytes | os.PathLike[str] | float | None | HasArray | Sequence[float | None | HasArray | Sequence[float]]
Units = Literal["si", "cgs", "micro", "nano"]    # of numbers from files of materials


class Wall(_Owner):
    """A wall of meshes that pushes spheres, by the words that stand behind `wall/lsdcd` in a script. In words $NAME is a value of
    yours, given by its name, or in `values`: a Mesh, numbers (None: NULL), rows of a motion table, or a text. `mesh $NAME` is called NAME; `motion
    caller` has its poses by set_pose(), `nodes caller` its nodes by set_nodes(), v_NAME its value by set_input(); `shapes` says that grains may be no
    spheres; a body has no gravity where the words give none. `units`: of numbers from files of materials, "si", "cgs", "micro" or "nano".

    Where a method takes a mesh, it is its number, from 0, or its name. `lo`, `hi`: the
    box of the spheres' centres, None: wherever they go; `periodic`: along x, y, z, with `margin`, how far past a
    face a sphere may go before the caller puts it back. `show(text, warning)` gets each line of the log. One
    thread at a time: while a call runs, `show` and the functions of `host` cannot call the wall, nor close it.

    device: "cpu", for spheres in arrays of the host, or "cuda", for arrays on the CUDA device that is current when the
    wall is made, in the order of `stream`: one of PyTorch or CuPy, or a cudaStream_t as a number; None: the default
    one.

    With a `host` there are several processes: each makes a Wall of the same words, for spheres of its own, and
    all call its methods together, but for renumber(), pack(), unpack(), pose(), set_pose(), nodes() and set_nodes(). The errors of one are raised
    on all.

    Raises Error for words that make no wall, with the word and what to give; TypeError and ValueError for other
    arguments."""
    _free = _lib.lsdcd_wall_free

    def __init__(self, words: str, lo: ArrayLike | None = None, hi: ArrayLike | None = None,
                 periodic: Sequence[bool] = (False, False, False), margin: float = 0.0, time: float = 0.0,
                 show: Callable[[str, bool], object] | None = None, threads: int = 0, host: Host | None = None,
                 device: Device = "cpu", stream: Any = None, units: Units = "si", values: Mapping[str, Value] | None = None,
                 **named: Value) -> None:
        super().__init__()
        self._on_device = bool(_chosen("device", device, DEVICES))
        self._stream = stream    # which must live as long as the wall
        # What callbacks raised, which C cannot pass on. They know this list, not the wall, so that the wall is freed with its name.
        self._told: list[BaseException] = []
        told = self._told
        self._arrays: Any = None    # of the last step, whose errors the library may still have to tell

        def called(function: Callable[..., object]) -> Callable[..., int]:
            def call(_: Any, *arguments: Any) -> int:
                try:
                    function(*arguments)
                    return 0
                except BaseException as e:
                    told.append(e)
                    return 1
            return call

        def tell(warning: int, text: bytes) -> None:
            if show:
                show(_text(text), bool(warning))

        if (lo is None) != (hi is None):    # C reads 0 for what is not given
            raise ValueError("lo and hi are the two corners of the box: give both, or neither where spheres go anywhere")
        least, most = _numbers(lo, (3,), "lo"), _numbers(hi, (3,), "hi")
        if least is not None and most is not None and not (least < most).all():
            raise ValueError(f"lo is {least}, hi is {most}: lo is below hi along each axis")
        if show is not None and not callable(show):
            raise TypeError(f"show is {show!r}, not a function")
        along_axes = _tuple(periodic, "(x, y, z)", "periodic")
        self._show: Any = _Show(called(tell)) if show else _Show(0)    # it must live as long as the wall
        self._host = None if host is None else _host_struct(host, called)
        options = _sized(_WallOptions, periodic=(_int * 3)(*(_flag(along, "periodic") for along in along_axes)), margin=margin,
                         time=time, show=self._show, threads=threads,
                         host=ctypes.addressof(self._host) if self._host else None,
                         stream=_arrays.stream_handle(stream), device=int(self._on_device), units=units)
        for name, place in (("lo", least), ("hi", most)):
            if place is not None:
                setattr(options, name, (_real * 3)(*place))
        given = _Values({**(values or {}), **named}, Mesh)
        with _argument_hint(Wall):
            self._do(_lib.lsdcd_wall_create, _c_text(words, "words"), given.structs, given.n, ctypes.byref(options),
                     ctypes.byref(self._handle), meshes=given.meshes)

    @staticmethod
    def check(words: str, values: Mapping[str, Value] | None = None, units: Units = "si", **named: Value) -> None:
        """Raises Error for what Wall() would refuse of words and values, and makes nothing. It reads files of materials, and no mesh."""
        given = _Values({**(values or {}), **named}, Mesh)
        options = _sized(_WallOptions, units=units, show=_Show(0))
        with _in_use(*given.meshes), _argument_hint(Wall.check):
            _check(_lib.lsdcd_wall_check(_c_text(words, "words"), given.structs, given.n, ctypes.byref(options)))

    def change(self, words: str, values: Mapping[str, Value] | None = None, **named: Value) -> None:
        """Changes the wall by the words of fix_modify: "mesh lid motion ...", "motion none", "servo ...", "servo none" or "body ..." of what is to
        change, from where the mesh is. Raises Error for others, and the wall stays as it is."""
        given = _Values({**(values or {}), **named}, Mesh)
        with _argument_hint(Wall.change):
            self._do(_lib.lsdcd_wall_change, self._handle, _c_text(words, "words"), given.structs, given.n, meshes=given.meshes)

    def set_input(self, name: str, value: float) -> None:
        """The value of v_NAME in the words from the next step on, the same on all processes. Raises Error for a name that the words have not, and a
        value that is not finite."""
        self._do(_lib.lsdcd_wall_set_input, self._handle, _c_text(name, "name"), _c_double(value, "value"))

    def _do(self, call: Any, *arguments: Any, meshes: Sequence[Mesh] = ()) -> None:
        """Makes a call of the wall, which reads these meshes."""
        self._check_open()
        if self._host is None and not self._show:    # nothing that C calls
            return _check(call(*arguments))
        if self._calls:
            raise Error("a call of the wall has not returned, and a wall makes one at a time: call it behind that, not in `show`, in a "
                        "function of its host or in another thread", "argument")
        with _in_use(self, *meshes), _interrupts_held(self._told):
            code = call(*arguments)
        told = list(self._told)
        self._told.clear()
        if told:
            raise told[0]
        _check(code)

    def step(self, x: Any, v: Any, omega: Any, radius: Any, mass: Any, force: Any, torque: Any, dt: float,
             setup: bool = False, changed: bool = False, reach: float = 0.0, temperature: Any = None, heat: Any = None,
             type: Any = None, synchronous: bool = False, half_axes: Any = None, exponents: Any = None,
             quaternions: Any = None, inertia: Any = None) -> None:
        """Adds to `force` and `torque`, (n, 3), and with a law of heat to `heat`, (n,), what the wall does in a
        step of `dt`. Arrays are of numpy or with `__dlpack__` or `__cuda_array_interface__`, where the wall was made for. Contiguous
        float64 is used in place; on the host others, as columns of a larger array or float32, are copied. `setup`: the forces with which a run begins; `changed`: radii grew or types changed since the last
        step. New spheres are at the end. `type`: int32, for laws by type. `synchronous`: velocities of spheres, poses and nodes are of
        the time of their places; else of half a step before, as velocity Verlet has them when it asks for forces.

        Of a wall with shapes `half_axes`, (n, 3), `exponents`, (n, 2), None: all are 2, `quaternions`, (n, 4), w i j k from the axes of
        a grain to the box, and `inertia`, (n, 3), about its axes, make grains superellipsoids; one with half-axes of 0 is a sphere,
        and the radius of others is not read.

        On a device arrays are read, and forces are added, in the order of the wall's stream. There, and with a `host`,
        an error of a sphere is raised by the next call; until then the wall keeps the arrays.

        Raises TypeError for arrays of another type or place, ValueError for another shape, layout or what cannot be written, Error for
        what lsdcd_wall_step_spheres() refuses. Either of the two where force, torque or heat shares memory with another array."""
        n = _arrays.read(radius, "radius", _arrays.stream_handle(self._stream)).shape[:1]
        rows = _arrays.read(x, "x", _arrays.stream_handle(self._stream)).shape[:1] if _is_array(x) else n
        if len(rows) == len(n) == 1 and rows != n:
            raise ValueError(f"radius has {n[0]} and x {rows[0]}: both have one for each sphere, and x is not a contiguous float64 array of shape {(*n, 3)}")
        vectors = {"x": x, "v": v, "omega": omega, "force": force, "torque": torque}
        numbers = {"radius": radius, "mass": mass, "temperature": temperature, "heat": heat, "type": type}
        given = {name: (array, (*n, 3)) for name, array in vectors.items()}
        given |= {name: (array, n) for name, array in numbers.items()}
        given |= {"half_axes": (half_axes, (*n, 3)), "exponents": (exponents, (*n, 2)), "quaternions": (quaternions, (*n, 4)),
                  "inertia": (inertia, (*n, 3))}
        optional = ("temperature", "heat", "type", "half_axes", "exponents", "quaternions", "inertia")
        added: list[tuple[Any, Any]] = []    # arrays of the caller, and what comes to them
        arrays = {name: self._array(array, name, shape, added) for name, (array, shape) in given.items()
                  if array is not None or name not in optional}
        if added:    # of others the library looks
            _check_apart({name: _arrays.read(array, name).host() for name, (array, _) in given.items() if array is not None})
        spheres = _sized(_Spheres, n=math.prod(n), **{name: array.address for name, array in arrays.items()})
        step = _sized(_WallStep, dt=dt, setup=_flag(setup, "setup"), changed=_flag(changed, "changed"), reach=reach,
                      synchronous=_flag(synchronous, "synchronous"))
        # Errors of the last step may be told in this one, whose arrays are then still there.
        before, self._arrays = self._arrays, arrays if self._on_device or self._host else None
        self._do(_lib.lsdcd_wall_step_spheres, self._handle, ctypes.byref(spheres), ctypes.byref(step))
        for to, what in added:
            to += what
        del before

    def _mesh(self, mesh: int | str) -> int:
        """The number of a mesh that is given by its number or its name."""
        if not isinstance(mesh, str):
            return _c_int(mesh, "mesh")
        number = _int()
        try:
            self._do(_lib.lsdcd_wall_get_mesh, self._handle, _c_text(mesh, "mesh"), ctypes.byref(number))
        except Error as e:
            raise ValueError(f"mesh is {mesh!r}: {e}") from None
        return number.value

    def _mesh_or_all(self, mesh: int | str | None) -> int:
        """All of C is -1."""
        if mesh is None:
            return -1
        number = self._mesh(mesh)
        if number < 0:
            raise ValueError(f"mesh is {number}; meshes count from 0, and None is all of them")
        return number

    def _array(self, values: Any, name: str, shape: tuple[int, ...],
               added: list[tuple[Any, Any]] | None = None) -> _arrays.Array:
        """An array of spheres, in place. With `added` what cannot be used in place on the host is copied; what is added to it comes
        to a new array of zeros, and both are appended to `added`."""
        array = _arrays.read(values, name, _arrays.stream_handle(self._stream)) if _is_array(values) else None
        kind = np.dtype(np.int32 if name == "type" else np.float64)
        packed = (*shape[1:], 1)
        wrong_type = array is None or array.dtype != kind
        if array is None or wrong_type or array.shape != shape or array.steps(len(shape) - 1) != packed:
            if added is not None and not self._on_device and array is not None and array.on_host and array.shape == shape:
                copied = _copied(array, name, kind, added)
                if copied is not None:
                    return copied
            raise (TypeError if wrong_type else ValueError)(f"{name} is not a contiguous {kind.name} array of shape {shape}" +
                                                                   ("" if array is None else f", but {array.dtype} of shape {array.shape}"))
        if array.on_host == self._on_device:
            where, other = ("a CUDA device", "cpu") if self._on_device else ("the host", "cuda")
            raise TypeError(f"{name} is {_place(array)}, and the wall was made for arrays on {where}: make it with "
                            f"device=\"{other}\"")
        if name in ("force", "torque", "heat", "out") and not array.writable:
            raise ValueError(f"{name} cannot be written to")
        return array

    def renumber(self, source: ArrayLike) -> None:
        """Before the next step: sphere i is the one that was source[i], or with -1 a new one."""
        numbers = _in_a_row(_whole_numbers(source, "source"), "source", np.intp)
        self._do(_lib.lsdcd_wall_renumber, self._handle, numbers.ctypes.data, numbers.size)

    def pack(self, which: ArrayLike) -> NDArray[np.float64]:
        """What the contacts of these spheres keep, numbers from 0, and their names: for unpack() by another
        process, before renumber()."""
        spheres = _in_a_row(_whole_numbers(which, "which"), "which", np.intp)
        return self._numbers(_lib.lsdcd_wall_pack, spheres.ctypes.data, spheres.size)

    def unpack(self, to: ArrayLike, numbers: ArrayLike) -> None:
        """Spheres to[k] get what another process packed, after renumber(). Raises Error for other numbers, and where a sphere would be
        there twice."""
        spheres = _in_a_row(_whole_numbers(to, "to"), "to", np.intp)
        packed = _in_a_row(_as_floats(numbers, "numbers"), "numbers", np.float64)
        self._do(_lib.lsdcd_wall_unpack, self._handle, spheres.ctypes.data, spheres.size, packed.ctypes.data,
                 packed.size)

    def totals(self, mesh: int | str | None = None, about: ArrayLike | None = None) -> WallTotals:
        """Of a mesh, from 0, or of all, in the last step, over all processes. The torque is about the point `about`, (3,), of the box;
        None: about `torque_about` of each mesh."""
        totals, point = _sized(_WallTotals), _numbers(about, (3,), "about")
        self._do(_lib.lsdcd_wall_get_totals, self._handle, self._mesh_or_all(mesh), None if point is None else point.ctypes.data,
                 ctypes.byref(totals))
        values = {name: getattr(totals, name) for name, _ in _WallTotals._fields_[1:]}
        return WallTotals(**{k: np.array(v) if isinstance(v, ctypes.Array) else v for k, v in values.items()})

    def outputs(self, names: str | Iterable[OutputName], mesh: int | str | None = None) -> dict[str, float]:
        """Numbers of a mesh, from 0, or of all, after the last step by names, which are those of LAMMPS's scripts and keys of OUTPUTS: a list,
        of which type checkers know the names, or a text with blanks, "force_z power". Raises Error for a name that this wall does not have, with
        the keyword that it needs; a mesh without a part that another one has, as a servo, has 0 there."""
        wanted = names.split() if isinstance(names, str) else list(names)
        numbers = np.empty(len(wanted))
        self._do(_lib.lsdcd_wall_get_outputs, self._handle, self._mesh_or_all(mesh), _c_text(" ".join(wanted), "names"),
                 numbers.ctypes.data, numbers.size)
        return dict(zip(wanted, numbers.tolist()))

    def pose(self, mesh: int | str = 0) -> NDArray[np.float64]:
        """Where mesh number `mesh`, from 0, is after the last step, (3, 4): what was at x when the wall was made is at
        R x + t, each row of R with its t, a length, behind it. Raises Error for a mesh that there is not."""
        matrix = np.empty((3, 4))
        self._do(_lib.lsdcd_wall_get_pose, self._handle, self._mesh(mesh), matrix.ctypes.data)
        return matrix

    def set_pose(self, mesh: int | str = 0, position: ArrayLike | None = None, quaternion: ArrayLike | None = None,
                 velocity: ArrayLike | None = None, angular_velocity: ArrayLike | None = None) -> None:
        """Where mesh number `mesh`, from 0, which has `motion caller`, is in the next step and those after it: what was at
        x when the wall was made is at R x + position, and moves with velocity + angular_velocity x (R x).

        position: (3,), length. quaternion: (4,), w x y z of R, of length 1 to 1e-3. velocity: (3,), length/time, of the
        point at `position`. angular_velocity: (3,), 1/time, right-handed, along the axes of the box. Both are of the time
        of the spheres' velocities: with velocity Verlet half a step before the pose. So in a step, but not with `setup`, R x of
        the velocity is that of half a step before, too, unless it is `synchronous`. What is None is 0, or no rotation.
        The same on all processes. Raises Error for a mesh that there is not, that is a body or that is not posed by the
        caller, a number that is not finite and a quaternion of another length; ValueError for other shapes."""
        given = [_numbers(position, (3,), "position"), _numbers(quaternion, (4,), "quaternion"),
                 _numbers(velocity, (3,), "velocity"), _numbers(angular_velocity, (3,), "angular_velocity")]
        self._do(_lib.lsdcd_wall_set_pose, self._handle, self._mesh(mesh),
                 *(None if numbers is None else numbers.ctypes.data for numbers in given))

    def set_nodes(self, mesh: int | str, positions: ArrayLike, velocities: ArrayLike | None = None) -> None:
        """Where the vertices of mesh number `mesh`, from 0, which has `nodes caller`, are in the next step and those
        after it, and how fast they go. Between the nodes of a triangle both are linear.

        positions: (vertices, 3), length, in the order of your vertices: those that the mesh was made of or that its file
        numbers, of STL and triangles their corners. Of several that were welded to one the first counts, and the others are
        where it is; one of no face is not read. velocities: (vertices, 3), length/time, of the
        time of the spheres' velocities: with velocity Verlet half a step before the positions; None: all are 0. The same on
        all processes. With device="cuda" both may be contiguous float64 arrays on the device, which are read in the order of
        the wall's stream. Raises Error for a mesh that there is not or that has no such nodes and for a number that is not
        finite (on a device the next step may), ValueError for another shape, TypeError for an array of another type or place;
        the next step for a node that goes farther than the largest radius, or a triangle without area."""
        shape = (self._n_nodes(mesh), 3)
        arrays = {"positions": positions} | ({} if velocities is None else {"velocities": velocities})
        places: list[int | None]
        if any(self._is_on_device(values, name) for name, values in arrays.items()):
            given = [self._array(values, name, shape) for name, values in arrays.items()]
            self._nodes = given    # until they have been read
            places = [array.address for array in given]
        else:
            numbers = [_numbers(values, shape, name) for name, values in arrays.items()]
            places = [None if values is None else values.ctypes.data for values in numbers]
        self._do(_lib.lsdcd_wall_set_nodes, self._handle, self._mesh(mesh), *places, *[None] * (2 - len(places)))

    def impacts(self, mesh: int | str = 0) -> WallImpacts:
        """The spectrum of the impacts on mesh number `mesh`, from 0, over all processes, of a wall with `impacts`. Raises Error
        for another one, and for a mesh that there is not."""
        ask = _sized(_WallImpacts)
        self._do(_lib.lsdcd_wall_get_impacts, self._handle, self._mesh(mesh), ctypes.byref(ask))
        columns = {name: np.empty(ask.bins) for name in ("begins", "ends", "impacts", "energy")}
        ask.room = ask.bins
        for name, column in columns.items():
            setattr(ask, name, column.ctypes.data)
        self._do(_lib.lsdcd_wall_get_impacts, self._handle, self._mesh(mesh), ctypes.byref(ask))
        return WallImpacts(**columns)

    def contacts(self) -> WallContacts:
        """Contacts of this process in the last step, of a wall with `each_contact`. Raises Error for another one, and before the first
        step after restore()."""
        ask = _sized(_WallContacts)
        self._do(_lib.lsdcd_wall_get_contacts, self._handle, ctypes.byref(ask))
        n = ask.room = ask.contacts
        found = WallContacts(sphere=np.empty(n, np.intp), mesh=np.empty(n, np.int32), force=np.empty((n, 3)),
                             point=np.empty((n, 3)), overlap=np.empty(n), dissipated_power=np.empty((n, 5)),
                             dissipated=np.empty((n, 5)), has_ended=np.empty(n, np.int32),
                             dissipated_power_plastic=np.empty(n), dissipated_plastic=np.empty(n))
        for name, array in vars(found).items():
            setattr(ask, name, array.ctypes.data)
        self._do(_lib.lsdcd_wall_get_contacts, self._handle, ctypes.byref(ask))
        return found

    def nodes(self, mesh: int | str = 0) -> NDArray[np.float64]:
        """Where the vertices of a mesh with `nodes caller`, or of one that wear moves (`wear ... deform`), are after the last step,
        (vertices, 3), length, in your order; nan for a vertex of no face."""
        return self._of_nodes(_lib.lsdcd_wall_get_nodes, mesh)

    def node_forces(self, mesh: int | str = 0, out: Any = None) -> Any:
        """Forces on these vertices in the last step, (vertices, 3), over all processes: those of contacts, each shared among
        the nodes of its triangle or edge so that their sum and moment are those of the force at the closest point, and
        those of `pressure`. Of vertices that were welded to one the first has its force, the others 0. `out`: a contiguous float64 array of this shape, where the wall was made for, that they are written to
        and that is returned; on a device in the order of the wall's stream. Raises TypeError for an array of another type or place,
        ValueError for another shape or what cannot be written."""
        if out is None:
            return self._of_nodes(_lib.lsdcd_wall_get_node_forces, mesh)
        array = self._array(out, "out", (self._n_nodes(mesh), 3))
        self._do(_lib.lsdcd_wall_get_node_forces, self._handle, self._mesh(mesh), array.address)
        return out

    def _is_on_device(self, values: Any, name: str) -> bool:
        return _is_array(values) and not _arrays.read(values, name, _arrays.stream_handle(self._stream)).on_host

    def _n_nodes(self, mesh: int | str) -> int:
        count = _size()
        self._do(_lib.lsdcd_wall_get_node_count, self._handle, self._mesh(mesh), ctypes.byref(count))
        return count.value

    def _of_nodes(self, call: Any, mesh: int | str) -> NDArray[np.float64]:
        numbers = np.empty((self._n_nodes(mesh), 3))
        self._do(call, self._handle, self._mesh(mesh), numbers.ctypes.data)
        return numbers

    def body(self, mesh: int | str) -> BodyState:
        """The rigid body that mesh number `mesh`, from 0, is after the last step, with velocities of the whole step. Raises
        Error for a mesh that there is not or that is no body."""
        state = _sized(_BodyState)
        self._do(_lib.lsdcd_wall_get_body, self._handle, self._mesh(mesh), ctypes.byref(state))
        values = {name: getattr(state, name) for name, _ in _BodyState._fields_[1:]}
        return BodyState(**{k: np.array(v) if isinstance(v, ctypes.Array) else v for k, v in values.items()})

    def save(self) -> NDArray[np.float64]:
        """What the wall and the contacts of its spheres keep, an array for restore()."""
        return self._numbers(_lib.lsdcd_wall_save)

    def _numbers(self, call: Any, *arguments: Any) -> NDArray[np.float64]:
        """What a function of the library writes where there is room."""
        count = _size()
        self._do(call, self._handle, *arguments, None, 0, ctypes.byref(count))
        numbers = np.empty(count.value)
        self._do(call, self._handle, *arguments, numbers.ctypes.data, count, ctypes.byref(count))
        return numbers

    def restore(self, numbers: ArrayLike, what_fits: bool = False) -> None:
        """Before the first step of a wall of the same words, with the motion, servo or body that was set later. Raises Error for numbers of
        another wall, with what differs; with `what_fits` it takes of them what fits, and `show` is told what does not."""
        saved = _in_a_row(_as_floats(numbers, "numbers"), "numbers", np.float64)
        call = _lib.lsdcd_wall_restore_what_fits if _flag(what_fits, "what_fits") else _lib.lsdcd_wall_restore
        self._do(call, self._handle, saved.ctypes.data, saved.size)


if Wall.__doc__:    # which Python leaves out with -OO
    Wall.__doc__ += "\n\n    Keywords of words, with what holds without them (KEYWORDS has units and ranges, too):\n\n" + "".join(
        f"        {row.syntax}\n            {row.meaning} ({row.default or 'required'})\n" for row in KEYWORDS.values())


def _copied(array: _arrays.Array, name: str, kind: np.dtype[Any], added: list[tuple[Any, Any]]) -> _arrays.Array | None:
    """An array of spheres on the host as the library reads it; None: it has no such numbers. Of results zeros, which are
    appended to `added` beside the array that they come to."""
    is_result = name in ("force", "torque", "heat")
    if array.dtype.kind not in ("iu" if name == "type" else "f" if is_result else "fiu"):
        return None
    values = array.host()
    if is_result:
        if not array.writable:
            raise ValueError(f"{name} cannot be written to")
        made = np.zeros(array.shape)
        added.append((values, made))
        return _arrays.of_numpy(made)
    if name == "type" and values.size and not -2**31 <= values.min() <= values.max() < 2**31:
        raise ValueError(f"type goes from {values.min()} to {values.max()}, beyond int32")
    return _arrays.of_numpy(np.ascontiguousarray(values, dtype=kind))


def _check_apart(given: dict[str, NDArray[Any]]) -> None:
    """Raises ValueError where a result of a step shares memory with another of its arrays, or its elements with each other."""
    for result in ("force", "torque", "heat"):
        for name, array in given.items() if result in given else ():
            if name != result and np.shares_memory(given[result], array):
                raise ValueError(f"{result} shares memory with {name}: give an array of its own")
            if name == result and _overlaps_itself(array):
                raise ValueError(f"{name} has the strides {array.strides}, by which numbers share memory: make it contiguous")


def _overlaps_itself(array: NDArray[Any]) -> bool:
    """Do two elements of an array of one or two dimensions share memory? They do where i steps along the one axis are as long as j along
    the other."""
    if array.size == 0:
        return False
    steps = [(n, abs(step)) for n, step in zip(array.shape, array.strides)]
    (few, short), (many, long) = sorted([(1, 0), *steps])[-2:]
    if many > 1 and long < array.itemsize:
        return True
    for j in range(1, few):
        i = min((2 * j * short + long) // (2 * long), many - 1) if many > 1 else 0
        if abs(i * long - j * short) < array.itemsize:
            return True
    return False


def _host_struct(host: Host, called: Callable[[Callable[..., object]], Callable[..., int]]) -> Any:
    """A host's functions as callbacks, which live as long as what this returns."""
    missing = [name for name in ("rank", "size", "sum", "max", "broadcast") if not hasattr(host, name)]
    if missing:
        raise TypeError(f"host is a {type(host).__name__} without {', '.join(missing)}, which lsdcd.Host has")

    def as_array(numbers: Any, shape: tuple[int, ...], kind: type = np.float64) -> NDArray[Any]:
        """In place. The view has the native type, where ctypes has one that names its byte order: mpi4py 3 does not know that."""
        return np.ctypeslib.as_array(numbers, shape).view(kind)

    return _sized(_Host, rank=host.rank, processes=host.size, node_rank=getattr(host, "node_rank", 0),
                  sum=_Reduce(called(lambda numbers, n: host.sum(as_array(numbers, (n,))))),
                  max=_Reduce(called(lambda numbers, n: host.max(as_array(numbers, (n,))))),
                  broadcast=_Broadcast(called(lambda data, n, source: host.broadcast(as_array(data, (n,), np.uint8), source))))


def _vertex_numbers(faces: ArrayLike, n: int) -> NDArray[np.uint32]:
    """Faces, (m, 3), as numbers of n vertices."""
    numbers = _whole_numbers(faces, "faces")
    if numbers.ndim != 2 or numbers.shape[1] != 3:
        raise ValueError(f"faces have the shape {numbers.shape}, not (n, 3)")
    wrong = numbers[(numbers < 0) | (numbers >= n)]
    if len(wrong):
        raise ValueError(f"a face has the vertex {wrong[0]}; there are {n}, numbered from 0")
    return np.ascontiguousarray(numbers, dtype=np.uint32)


