# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Distances from points to a triangle mesh, exact and many at once, for numpy arrays; rigid bodies
against a wall; and a wall that pushes spheres, step by step.

    import lsdcd
    grid = lsdcd.Mesh("wall.stl").grid(cutoff=0.01)
    answer = grid.query(points, "distance triangle side")    # points: (n, 3), float32 or float64
    answer.distance, answer.triangle, answer.side

    body = lsdcd.Body(lsdcd.Mesh("wall.stl"), lsdcd.Mesh("body.stl"))
    found = body.collide(position=(0, 0, 1), quaternion=(1, 0, 0, 0))
    found.collides, found.wall, found.body                    # triangles, pair by pair

    wall = lsdcd.Wall("hooke/history 1e5 3e4 50 0 0.5 1 mesh drum.stl motion rotate 0 0 0 0 1 0 2")
    wall.step(x, v, omega, radius, mass, force, torque, dt=1e-5)    # adds to force and torque, (n, 3)

A query lets other Python threads run, and any number of threads may ask one grid at once. What is
told about lsdcd.h holds here; its errors are lsdcd.Error with a `code`. LSDCD_LIBRARY may name the
shared library.
"""
import ctypes
import glob
import os
from types import SimpleNamespace

import numpy as np

_size, _step, _int, _real, _at = (ctypes.c_size_t, ctypes.c_ssize_t, ctypes.c_int, ctypes.c_double,
                                  ctypes.c_void_p)
ERRORS = ("ok", "argument", "input", "cutoff", "side", "device", "memory", "internal")
DEVICES = ("cpu", "cuda")
FOUND, CERTIFIED = 1, 2
NONE = 0xffffffff


def _struct(name, *fields):
    return type(name, (ctypes.Structure,), {"_fields_": [("size", _size), *fields]})


_MeshFacts = _struct(
    "_MeshFacts", ("triangles", _size), ("faces", _size), ("edges", _size), ("vertices", _size),
    ("open_edges", _size), ("closed", _int), ("oriented", _int),
    ("area", _real), ("volume", _real), ("lo", _real * 3), ("hi", _real * 3), ("meeting_pairs", _size))
_GridOptions = _struct(
    "_GridOptions", ("cutoff", _real), ("cell", _real), ("nearest", _int), ("precision", _int),
    ("memory", _real), ("cache", ctypes.c_char_p), ("threads", _int), ("device", _int))
_GridFacts = _struct(
    "_GridFacts", ("cutoff", _real), ("cell", _real), ("bytes", _size), ("nearest", _int),
    ("has_sides", _int), ("from_cache", _int))
_Query = _struct(
    "_Query", ("n", _size), ("type", _int), ("threads", _int), ("points", _at),
    ("points_row", _step), ("points_column", _step), ("radii", _at), ("radii_step", _step),
    ("radius", _real), ("distance", _at), ("distance_step", _step), ("closest", _at),
    ("closest_row", _step), ("closest_column", _step), ("normal", _at), ("normal_row", _step),
    ("normal_column", _step), ("triangle", _at), ("feature", _at), ("side", _at), ("status", _at))
_BodyOptions = _struct(
    "_BodyOptions", ("cell", _real), ("nearest", _int), ("memory", _real), ("threads", _int),
    ("device", _int), ("same_wall", _at))
_BodyFacts = _struct(
    "_BodyFacts", ("triangles", _size), ("pieces", _size), ("cell", _real), ("grid_bytes", _size),
    ("nearest", _int), ("device", _int))
_Collision = _struct(
    "_Collision", ("threads", _int), ("collides", _int), ("matrix", _at), ("position", _at),
    ("quaternion", _at), ("room", _size), ("wall_triangle", _at), ("body_triangle", _at),
    ("segment", _at), ("pairs", _size), ("uncertain", _size))

_Show = ctypes.CFUNCTYPE(None, _at, _int, ctypes.c_char_p)
_WallOptions = _struct(
    "_WallOptions", ("lo", _real * 3), ("hi", _real * 3), ("periodic", _int * 3), ("margin", _real),
    ("time", _real), ("units", ctypes.c_char_p), ("show", _Show), ("data", _at), ("threads", _int))
_Spheres = _struct(
    "_Spheres", ("n", _size), ("row", _step), ("x", _at), ("v", _at), ("omega", _at), ("radius", _at),
    ("mass", _at), ("force", _at), ("torque", _at), ("temperature", _at), ("heat", _at), ("type", _at))
_WallStep = _struct("_WallStep", ("dt", _real), ("setup", _int), ("changed", _int), ("reach", _real))
_WallTotals = _struct(
    "_WallTotals", ("force", _real * 3), ("torque", _real * 3), ("contacts", _real), ("overlap", _real),
    ("uncertified", _real), ("power", _real), ("energy", _real), ("worn", _real), ("servo", _real * 3))


class Error(ValueError):
    """What the library refuses, and what to do; `code`: one of ERRORS."""

    def __init__(self, code):
        super().__init__(_lib.lsdcd_last_error().decode())
        self.code = ERRORS[code]


def _load():
    name = os.environ.get("LSDCD_LIBRARY")
    if not name:    # beside this file, in a lib/ above the package, or where the system looks
        here = os.path.dirname(os.path.abspath(__file__))
        near = [found for up in ("", "../../..", "../../../*")
                for found in sorted(glob.glob(os.path.join(here, up, "liblsdcd.so.0")))]
        name = near[0] if near else "liblsdcd.so.0"
    lib = ctypes.CDLL(name)
    for text in ("version", "last_error", "mesh_report", "grid_report"):
        getattr(lib, "lsdcd_" + text).restype = ctypes.c_char_p
    lib.lsdcd_mesh_report.argtypes = lib.lsdcd_grid_report.argtypes = [_at]
    for kind in ("mesh", "grid", "body", "wall"):
        free = getattr(lib, f"lsdcd_{kind}_free")
        free.argtypes, free.restype = [_at], None
    lib.lsdcd_mesh_read.argtypes = [ctypes.c_char_p, _real, _at]
    lib.lsdcd_mesh_from_corners.argtypes = [_at, _size, _real, _at]
    for call in ("mesh_get_facts", "grid_get_facts", "query_host", "body_get_facts", "collide"):
        getattr(lib, "lsdcd_" + call).argtypes = [_at, _at]
    lib.lsdcd_grid_build.argtypes = [_at, _at, _at]
    lib.lsdcd_body_make.argtypes = [_at, _at, _at, _at]
    lib.lsdcd_wall_make.argtypes = [_at, _size, _at, _at]
    lib.lsdcd_wall_step_spheres.argtypes = [_at, _at, _at]
    for call in ("renumber", "change"):
        getattr(lib, "lsdcd_wall_" + call).argtypes = [_at, _at, _size]
    for call in ("get_totals", "get_pose"):
        getattr(lib, "lsdcd_wall_" + call).argtypes = [_at, _int, _at]
    lib.lsdcd_wall_save.argtypes = [_at, _at, _size, _at]
    lib.lsdcd_wall_restore.argtypes = [_at, _at, _size]
    return lib


_lib = _load()
__version__ = _lib.lsdcd_version().decode()


def _check(code):
    if code != 0:
        raise Error(code)


def _sized(struct, **values):
    return struct(size=ctypes.sizeof(struct), **values)


def _facts(struct, call, handle):
    facts = _sized(struct)
    _check(call(handle, ctypes.byref(facts)))
    values = {name: getattr(facts, name) for name, _ in struct._fields_[1:]}
    return SimpleNamespace(**{k: tuple(v) if isinstance(v, ctypes.Array) else v for k, v in values.items()})


def _chosen(name, word, words):
    """The index of a word among those that there are."""
    if word not in words:
        raise ValueError(f"{name} is {word!r}; it is {' or '.join(map(repr, words))}")
    return words.index(word)


class _Owner:
    """Owns `_handle`, memory of the library, which `_free` frees: once, so that it has one owner."""

    def __init__(self):
        self._handle = _at()

    def __del__(self):
        if getattr(self, "_handle", None):
            self._free(self._handle)

    def __reduce_ex__(self, protocol):    # what copy, deepcopy and pickle ask for
        raise TypeError(f"a {type(self).__name__} holds memory of the library and is neither copied nor pickled; "
                        "share it, or make another one")


class Mesh(_Owner):
    """From a file (STL; built with assimp also OBJ, PLY and OFF); from triangles, (n, 3, 3); or from vertices,
    (m, 3), and faces, (n, 3)."""
    _free = _lib.lsdcd_mesh_free

    def __init__(self, source, faces=None, weld=-1.0):
        super().__init__()
        if isinstance(source, (str, bytes, os.PathLike)):
            _check(_lib.lsdcd_mesh_read(os.fsencode(source), weld, ctypes.byref(self._handle)))
            return
        corners = np.asarray(source, dtype=np.float64)
        if faces is not None:
            corners = corners[_vertex_numbers(faces, len(corners))]
        corners = np.ascontiguousarray(corners)
        if corners.ndim != 3 or corners.shape[1:] != (3, 3):
            raise TypeError(f"triangles have the shape {corners.shape}, not (n, 3, 3)")
        _check(_lib.lsdcd_mesh_from_corners(corners.ctypes.data, len(corners), weld,
                                            ctypes.byref(self._handle)))

    @property
    def facts(self):
        return _facts(_MeshFacts, _lib.lsdcd_mesh_get_facts, self._handle)

    @property
    def report(self):
        return _lib.lsdcd_mesh_report(self._handle).decode()

    def grid(self, cutoff=None, cell=0.0, nearest=0, precision="double", memory=0.0, cache=None,
             threads=0, device="cpu"):
        """A Grid for distances up to `cutoff`, None: any; the words are those of lsdcd_grid_options."""
        options = _sized(_GridOptions, cutoff=0.0 if cutoff is None else cutoff, cell=cell, nearest=nearest,
                         precision=_chosen("precision", precision, ("double", "float")), memory=memory,
                         cache=os.fsencode(cache) if cache else None, threads=threads,
                         device=_chosen("device", device, DEVICES))
        return Grid(self, options)


class Grid(_Owner):
    """Made by Mesh.grid()."""
    _free = _lib.lsdcd_grid_free

    def __init__(self, mesh, options):
        super().__init__()
        _check(_lib.lsdcd_grid_build(mesh._handle, ctypes.byref(options), ctypes.byref(self._handle)))

    @property
    def facts(self):
        return _facts(_GridFacts, _lib.lsdcd_grid_get_facts, self._handle)

    @property
    def report(self):
        return _lib.lsdcd_grid_report(self._handle).decode()

    def query(self, points, want="distance", radius=None, threads=0):
        """Answers for points, (n, 3), as arrays named by `want`: distance, closest, normal,
        triangle, feature, side, status. `radius`: one above 0, or (n,); by default the cutoff, or any distance without one. Of one
        point, (3,), the arrays have no first dimension."""
        points = np.asarray(points)
        if points.dtype not in (np.float32, np.float64):
            points = points.astype(np.float64)
        if points.ndim not in (1, 2) or points.shape[-1] != 3:
            raise TypeError(f"points have the shape {points.shape}, not (n, 3) or (3,)")
        shape, real = points.shape[:-1], points.dtype
        points = points.reshape(-1, 3)
        n = len(points)
        # The library takes steps of whole numbers, and 0 for packed.
        if any(s == 0 or s % real.itemsize for s in points.strides) or not real.isnative:
            points = np.ascontiguousarray(points, dtype=real.newbyteorder("="))
        query = _sized(_Query, n=n, type=int(real == np.float32), threads=threads,
                       points=points.ctypes.data, points_row=points.strides[0] // real.itemsize,
                       points_column=points.strides[1] // real.itemsize)
        if radius is not None and np.ndim(radius) == 0:
            if not float(radius) > 0:
                raise TypeError(f"radius is {radius}, not above 0")
            query.radius = float(radius)
        elif radius is not None:
            radius = np.ascontiguousarray(radius, dtype=real)
            if radius.shape != shape:
                raise TypeError(f"radius has the shape {radius.shape}, not {shape}")
            if not (radius > 0).all():
                raise TypeError(f"radius is {radius[~(radius > 0)][0]} at a point, not above 0")
            query.radii = radius.ctypes.data
        kinds = {"distance": (shape, real), "closest": ((*shape, 3), real), "normal": ((*shape, 3), real),
                 "triangle": (shape, np.uint32), "feature": (shape, np.uint32), "side": (shape, np.int8),
                 "status": (shape, np.uint8)}
        words = want.split() if isinstance(want, str) else list(want)
        unknown = sorted(set(words) - set(kinds))
        if unknown:
            raise TypeError(f"{', '.join(unknown)}: a query answers {', '.join(kinds)}")
        answer = SimpleNamespace(**{word: np.empty(*kinds[word]) for word in words})
        for word in words:
            setattr(query, word, getattr(answer, word).ctypes.data)
        _check(_lib.lsdcd_query_host(self._handle, ctypes.byref(query)))
        return answer


class Body(_Owner):
    """A rigid body's Mesh against a wall's Mesh, or against the wall of another Body, which both then
    share; the words are those of lsdcd_body_options. One thread at a time."""
    _free = _lib.lsdcd_body_free

    def __init__(self, wall, mesh, cell=0.0, nearest=0, memory=0.0, threads=0, device="cpu"):
        super().__init__()
        self._room = 1024
        options = _sized(_BodyOptions, cell=cell, nearest=nearest, memory=memory, threads=threads,
                         device=_chosen("device", device, DEVICES))
        if isinstance(wall, Body):
            options.same_wall = wall._handle
        _check(_lib.lsdcd_body_make(None if isinstance(wall, Body) else wall._handle, mesh._handle,
                                    ctypes.byref(options), ctypes.byref(self._handle)))

    @property
    def facts(self):
        return _facts(_BodyFacts, _lib.lsdcd_body_get_facts, self._handle)

    def collide(self, position=None, quaternion=None, matrix=None, segments=False, threads=0):
        """Of a pose, `position` (x, y, z), `quaternion` (w, x, y, z) or both, or `matrix`, (3, 4) or
        (4, 4): collides; wall and body, the triangles of each pair; where asked for segments,
        (n, 2, 3), from one point to another, nan where a pair lies in one plane; uncertain."""
        pose = {"position": _numbers(position, (3,), "position"),
                "quaternion": _numbers(quaternion, (4,), "quaternion"),
                "matrix": _numbers(matrix, (4, 4) if np.shape(matrix) == (4, 4) else (3, 4), "matrix")}
        if pose["matrix"] is not None and len(pose["matrix"]) == 4:
            if pose["matrix"][3].tolist() != [0, 0, 0, 1]:
                raise TypeError("the last row of matrix is not 0, 0, 0, 1")
        ask = _sized(_Collision, threads=threads, **{k: v.ctypes.data for k, v in pose.items() if v is not None})
        while True:
            ask.room = self._room
            wall, body = np.empty(ask.room, np.uint32), np.empty(ask.room, np.uint32)
            ask.wall_triangle, ask.body_triangle = wall.ctypes.data, body.ctypes.data
            if segments:
                found = np.empty((ask.room, 2, 3))
                ask.segment = found.ctypes.data
            _check(_lib.lsdcd_collide(self._handle, ctypes.byref(ask)))
            if ask.pairs <= ask.room:
                break
            self._room = ask.pairs
        answer = SimpleNamespace(collides=bool(ask.collides), wall=wall[:ask.pairs], body=body[:ask.pairs],
                                 uncertain=ask.uncertain)
        if segments:
            answer.segments = found[:ask.pairs]
        return answer


class Wall(_Owner):
    """The wall of fix wall/lsdcd. `words`: what follows its style in a script, a text or a list. `lo`, `hi`: the
    box of the spheres' centres, None: wherever they go; `periodic`: along x, y, z, with `margin`, how far past a
    face a sphere may go before the caller puts it back. `show(text, warning)` gets each line of the log. One
    thread at a time."""
    _free = _lib.lsdcd_wall_free

    def __init__(self, words, lo=None, hi=None, periodic=(False, False, False), margin=0.0, time=0.0, units="si",
                 show=None, threads=0):
        super().__init__()
        self._told = None    # what `show` raised, which C cannot pass on

        def tell(_, warning, text):
            try:
                show(text.decode(), bool(warning))
            except BaseException as e:
                self._told = e

        self._show = _Show(tell) if show else _Show()    # it must live as long as the wall
        options = _sized(_WallOptions, periodic=(_int * 3)(*map(bool, periodic)), margin=margin, time=time,
                         units=units.encode(), show=self._show, threads=threads)
        for name, corner in (("lo", lo), ("hi", hi)):
            if corner is not None:
                setattr(options, name, (_real * 3)(*_numbers(corner, (3,), name)))
        self._do(_lib.lsdcd_wall_make, *_words(words), ctypes.byref(options), ctypes.byref(self._handle))

    def _do(self, call, *arguments):
        code = call(*arguments)
        told, self._told = self._told, None
        if told is not None:
            raise told
        _check(code)

    def step(self, x, v, omega, radius, mass, force, torque, dt, setup=False, changed=False, reach=0.0,
             temperature=None, heat=None, type=None):
        """Adds to `force` and `torque`, (n, 3), and with a law of heat to `heat`, (n,), what the wall does in a
        step of `dt`. All arrays are contiguous float64. `setup`: the forces with which a run begins; `changed`:
        radii grew since the last step. New spheres are at the end. `type`: int32, for laws by type."""
        n = len(radius)
        arrays = {"x": (x, (n, 3)), "v": (v, (n, 3)), "omega": (omega, (n, 3)), "radius": (radius, (n,)),
                  "mass": (mass, (n,)), "force": (force, (n, 3)), "torque": (torque, (n, 3)),
                  "temperature": (temperature, (n,)), "heat": (heat, (n,)), "type": (type, (n,))}
        spheres = _sized(_Spheres, n=n)
        for name, (array, shape) in arrays.items():
            if array is None and name in ("temperature", "heat", "type"):
                continue
            kind = np.int32 if name == "type" else np.float64
            if not isinstance(array, np.ndarray) or array.dtype != kind or array.shape != shape \
                    or not array.flags.c_contiguous:
                raise TypeError(f"{name} is not a contiguous {kind.__name__} array of shape {shape}")
            if name in ("force", "torque", "heat") and not array.flags.writeable:
                raise TypeError(f"{name} cannot be written to")
            setattr(spheres, name, array.ctypes.data)
        step = _sized(_WallStep, dt=dt, setup=bool(setup), changed=bool(changed), reach=reach)
        self._do(_lib.lsdcd_wall_step_spheres, self._handle, ctypes.byref(spheres), ctypes.byref(step))

    def renumber(self, source):
        """Before the next step: sphere i is the one that was source[i], or with -1 a new one."""
        source = np.ascontiguousarray(source, dtype=np.intp)
        self._do(_lib.lsdcd_wall_renumber, self._handle, source.ctypes.data, source.size)

    def totals(self, mesh=None):
        """Of a mesh, from 0, or of all: force and torque on it, contacts, overlap, uncertified, power, energy,
        worn, servo (position, velocity, push)."""
        totals = _sized(_WallTotals)
        self._do(_lib.lsdcd_wall_get_totals, self._handle, -1 if mesh is None else mesh, ctypes.byref(totals))
        values = {name: getattr(totals, name) for name, _ in _WallTotals._fields_[1:]}
        return SimpleNamespace(**{k: np.array(v) if isinstance(v, ctypes.Array) else v for k, v in values.items()})

    def pose(self, mesh=0):
        """(3, 4): x in the box is R x + t, each row of R with its t behind it."""
        matrix = np.empty((3, 4))
        self._do(_lib.lsdcd_wall_get_pose, self._handle, mesh, matrix.ctypes.data)
        return matrix

    def change(self, words):
        """[mesh K] motion ... or [mesh K] servo ..., as fix_modify takes them, with K from 1."""
        self._do(_lib.lsdcd_wall_change, self._handle, *_words(words))

    def save(self):
        """What the wall and the contacts of its spheres keep, an array for restore()."""
        count = _size()
        self._do(_lib.lsdcd_wall_save, self._handle, None, 0, ctypes.byref(count))
        numbers = np.empty(count.value)
        self._do(_lib.lsdcd_wall_save, self._handle, numbers.ctypes.data, count, ctypes.byref(count))
        return numbers

    def restore(self, numbers):
        """Before the first step of a wall of the same words."""
        numbers = np.ascontiguousarray(numbers, dtype=np.float64)
        self._do(_lib.lsdcd_wall_restore, self._handle, numbers.ctypes.data, numbers.size)


def _words(words):
    """As an array of C strings, and how many."""
    words = words.split() if isinstance(words, str) else list(words)
    return (ctypes.c_char_p * len(words))(*map(os.fsencode, words)), len(words)


def _vertex_numbers(faces, n):
    """Faces as an array of numbers of n vertices."""
    faces = np.asarray(faces)
    if faces.size and faces.dtype.kind not in "iu":
        raise TypeError(f"faces are of type {faces.dtype}, not whole numbers")
    wrong = faces[(faces < 0) | (faces >= n)]
    if len(wrong):
        raise ValueError(f"a face has the vertex {wrong[0]}; there are {n}, numbered from 0")
    return faces


def _numbers(values, shape, name):
    if values is None:
        return None
    values = np.ascontiguousarray(values, dtype=np.float64)
    if values.shape != shape:
        raise TypeError(f"{name} has the shape {values.shape}, not {shape}")
    return values
