# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The shared library of lsdcd.h through ctypes: its structs and errors, and numbers that fit them."""
from __future__ import annotations

import contextlib
import ctypes
import functools
import glob
import inspect
import operator
import os
import signal
import threading
from typing import Any, Callable, Iterator, Sequence, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays

_size, _step, _int, _real, _at = (ctypes.c_size_t, ctypes.c_ssize_t, ctypes.c_int, ctypes.c_double,
                                  ctypes.c_void_p)
ERRORS = ("ok", "argument", "input", "cutoff", "side", "device", "memory", "internal", "cancelled")
DEVICES = ("cpu", "cuda")


# A listener of a long call: what is done now, and how much of that, from 0 to 1. What it raises ends the call and is
# raised by it, as KeyboardInterrupt is; a true result ends it with an Error, "cancelled".
Progress = Callable[[str, float], object]
_Progress = ctypes.CFUNCTYPE(_int, _at, ctypes.c_char_p, _real)


def _struct(name: str, *fields: tuple[str, Any]) -> Any:
    return type(name, (ctypes.Structure,), {"_fields_": [("size", _size), *fields]})


_MeshFacts = _struct(
    "_MeshFacts", ("triangles", _size), ("faces", _size), ("edges", _size), ("vertices", _size),
    ("open_edges", _size), ("closed", _int), ("oriented", _int),
    ("area", _real), ("volume", _real), ("lo", _real * 3), ("hi", _real * 3), ("meeting_pairs", _size),
    ("given_vertices", _size))
_MeshArrays = _struct(
    "_MeshArrays", ("vertices", _at), ("faces", _at), ("face_edges", _at), ("triangle", _at), ("edges", _at),
    ("edge_first", _at), ("edge_faces", _at), ("welded_vertex", _at), ("welded_face", _at))
_GridOptions = _struct(
    "_GridOptions", ("cutoff", _real), ("cell", _real), ("nearest", _int), ("precision", _int),
    ("memory", _real), ("cache", ctypes.c_char_p), ("threads", _int), ("device", _int), ("progress", _Progress),
    ("data", _at))
_GridFacts = _struct(
    "_GridFacts", ("cutoff", _real), ("cell", _real), ("bytes", _size), ("nearest", _int),
    ("has_sides", _int), ("from_cache", _int))
_Query = _struct(
    "_Query", ("n", _size), ("type", _int), ("threads", _int), ("points", _at),
    ("points_row", _step), ("points_column", _step), ("radii", _at), ("radii_step", _step),
    ("radius", _real), ("distance", _at), ("distance_step", _step), ("closest", _at),
    ("closest_row", _step), ("closest_column", _step), ("normal", _at), ("normal_row", _step),
    ("normal_column", _step), ("triangle", _at), ("feature", _at), ("side", _at), ("status", _at),
    ("winding", _at), ("winding_step", _step), ("estimate_sides", _int), ("progress", _Progress), ("data", _at),
    ("signed_distance", _at), ("signed_distance_step", _step), ("barycentric", _at), ("barycentric_row", _step),
    ("barycentric_column", _step))
_Contacts = _struct(
    "_Contacts", ("n", _size), ("type", _int), ("threads", _int), ("points", _at), ("points_row", _step),
    ("points_column", _step), ("radii", _at), ("radii_step", _step), ("radius", _real), ("first", _at), ("room", _size),
    ("point", _at), ("distance", _at), ("overlap", _at), ("normal", _at), ("weight", _at), ("triangle", _at),
    ("feature", _at), ("contacts", _size), ("progress", _Progress), ("data", _at))
_BodyOptions = _struct(
    "_BodyOptions", ("cell", _real), ("nearest", _int), ("memory", _real), ("threads", _int),
    ("device", _int), ("same_wall", _at), ("progress", _Progress), ("data", _at))
_BodyFacts = _struct(
    "_BodyFacts", ("triangles", _size), ("pieces", _size), ("cell", _real), ("grid_bytes", _size),
    ("nearest", _int), ("device", _int))
_Collision = _struct(
    "_Collision", ("threads", _int), ("collides", _int), ("matrix", _at), ("position", _at),
    ("quaternion", _at), ("room", _size), ("wall_triangle", _at), ("body_triangle", _at),
    ("segment", _at), ("pairs", _size), ("uncertain", _size))

_SubModel = type("_SubModel", (ctypes.Structure,), {"_fields_": [("name", ctypes.c_char_p), ("numbers", _real * 8)]})
_Law = _struct(
    "_Law", ("style", _SubModel), ("normal", _SubModel), ("tangential", _SubModel), ("damping", _SubModel),
    ("rolling", _SubModel), ("twisting", _SubModel), ("heat", _SubModel), ("cohesion", _SubModel), ("limit_damping", _int))
_Override: Any = type("_Override", (ctypes.Structure,), {"_fields_": [
    ("of", ctypes.c_char_p), ("key", ctypes.c_char_p), ("value", _real)]})
_Materials = _struct(
    "_Materials", ("file", ctypes.c_char_p), ("particle", ctypes.c_char_p), ("wall", ctypes.c_char_p), ("overrides", _at),
    ("n_overrides", _size), ("units", ctypes.c_char_p))
_SubModelFacts = _struct(
    "_SubModelFacts", ("field", ctypes.c_char_p), ("name", ctypes.c_char_p), ("source", ctypes.c_char_p),
    ("beside_style", _int), ("n", _int), ("number", ctypes.c_char_p * 8), ("unit", ctypes.c_char_p * 8),
    ("least", _real * 8), ("most", _real * 8), ("may_be_derived", _int * 8))
_TypeLaw = _struct("_TypeLaw", ("first_type", _int), ("last_type", _int), ("law", _at))
_Motion = _struct(
    "_Motion", ("kind", _int), ("velocity", _real * 3), ("amplitude", _real * 3), ("point", _real * 3), ("axis", _real * 3),
    ("period", _real), ("angle", _real), ("rows", _at), ("n_rows", _size), ("columns", _int), ("straight", _int),
    ("repeats", _int), ("degrees", _int), ("file", ctypes.c_char_p))
_Servo = _struct(
    "_Servo", ("turns", _int), ("axis", _real * 3), ("point", _real * 3), ("target", _real), ("max_speed", _real),
    ("max_gain", _real), ("lo", _real), ("hi", _real))
_RigidBody = _struct(
    "_RigidBody", ("density", _real), ("mass", _real), ("centre", _real * 3), ("inertia", _real * 6), ("joint", _int),
    ("point", _real * 3), ("axis", _real * 3), ("stiffness", _real), ("damping", _real), ("rest", _real), ("lo", _real),
    ("hi", _real), ("motor", _real), ("load", _real * 3), ("moment", _real * 3), ("velocity", _real * 3),
    ("angular_velocity", _real * 3), ("gravity", _real * 3), ("coat", _int), ("coat_spacing", _real), ("coat_radius", _real))
_BodyState = _struct(
    "_BodyState", ("centre", _real * 3), ("quaternion", _real * 4), ("velocity", _real * 3), ("angular_velocity", _real * 3),
    ("reaction_force", _real * 3), ("reaction_torque", _real * 3), ("coordinate", _real), ("energy", _real),
    ("stop_force", _real))
_WallMesh = _struct(
    "_WallMesh", ("mesh", _at), ("name", ctypes.c_char_p), ("placement", _real * 12), ("law", _at), ("type_laws", _at),
    ("n_type_laws", _size), ("posed_by_caller", _int), ("motions", _at), ("n_motions", _size), ("servo", _at),
    ("surface_velocity", _real * 3), ("surface_angular_velocity", _real * 3), ("surface_centre", _real * 3),
    ("temperature", _real), ("torque_about", _real * 3), ("torque_about_moves", _int), ("wear_factor", _real),
    ("cache", ctypes.c_char_p), ("fields", ctypes.c_char_p), ("stl", ctypes.c_char_p), ("fields_every", _int),
    ("stl_every", _int), ("nodes_by_caller", _int), ("pressure", _real), ("body", _at))
_WallSpec = _struct(
    "_WallSpec", ("law", _at), ("meshes", _at), ("n_meshes", _size), ("corner", _int), ("side", _int),
    ("nearest", _int), ("cell", _real), ("memory", _real), ("rmax", _real), ("device", _int), ("wear", _int),
    ("wear_coefficient", _real), ("hardness", _real), ("wear_deform_every", _int), ("wear_deform_factor", _real),
    ("periodic_ends", _int), ("brief", _int), ("average_every", _int), ("each_contact", _int))
_WallContacts = _struct(
    "_WallContacts", ("room", _size), ("sphere", _at), ("mesh", _at), ("force", _at), ("point", _at), ("overlap", _at),
    ("contacts", _size))

_Show = ctypes.CFUNCTYPE(None, _at, _int, ctypes.c_char_p)
_Reduce = ctypes.CFUNCTYPE(_int, _at, ctypes.POINTER(_real), _int)
_Broadcast = ctypes.CFUNCTYPE(_int, _at, ctypes.POINTER(ctypes.c_uint8), _size, _int)
_Host = _struct("_Host", ("rank", _int), ("processes", _int), ("node_rank", _int), ("data", _at), ("sum", _Reduce),
                ("max", _Reduce), ("broadcast", _Broadcast))
_WallOptions = _struct(
    "_WallOptions", ("lo", _real * 3), ("hi", _real * 3), ("periodic", _int * 3), ("margin", _real),
    ("time", _real), ("show", _Show), ("data", _at), ("threads", _int),
    ("host", _at), ("stream", _at), ("device", _int))
_Spheres = _struct(
    "_Spheres", ("n", _size), ("row", _step), ("x", _at), ("v", _at), ("omega", _at), ("radius", _at),
    ("mass", _at), ("force", _at), ("torque", _at), ("temperature", _at), ("heat", _at), ("type", _at))
_WallStep = _struct("_WallStep", ("dt", _real), ("setup", _int), ("changed", _int), ("reach", _real),
                    ("synchronous", _int))
_WallTotals = _struct(
    "_WallTotals", ("force", _real * 3), ("torque", _real * 3), ("contacts", _real), ("overlap", _real),
    ("uncertified", _real), ("power", _real), ("energy", _real), ("worn", _real), ("servo", _real * 3),
    ("removed", _real), ("held_back", _real), ("couple", _real * 3), ("mean_force", _real * 3), ("mean_torque", _real * 3))


class Error(ValueError):
    """What the library refuses, and what to do; `code`: one of ERRORS."""
    __module__ = "lsdcd"    # where users find it

    def __init__(self, text: str, code: str) -> None:
        super().__init__(text)
        self.code = code

    def __reduce__(self) -> Any:    # else pickle would make it of its text alone
        return type(self), (str(self), self.code), self.__dict__


def _load() -> Any:
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
    for kind in ("mesh", "grid", "stream", "body", "wall"):
        free = getattr(lib, f"lsdcd_{kind}_free")
        free.argtypes, free.restype = [_at], None
    lib.lsdcd_mesh_read.argtypes = [ctypes.c_char_p, _real, _at]
    lib.lsdcd_mesh_from_corners.argtypes = [_at, _size, _real, _at]
    lib.lsdcd_mesh_from_faces.argtypes = [_at, _int, _size, _at, _size, _real, _at]
    for call in ("mesh_get_facts", "mesh_get_arrays", "grid_get_facts", "query_host", "contacts_host", "body_get_facts", "collide"):
        getattr(lib, "lsdcd_" + call).argtypes = [_at, _at]
    lib.lsdcd_query_stream.argtypes = lib.lsdcd_wall_get_contacts.argtypes = [_at, _at]
    lib.lsdcd_grid_build.argtypes = lib.lsdcd_stream_open.argtypes = [_at, _at, _at]
    lib.lsdcd_body_make.argtypes = [_at, _at, _at, _at]
    lib.lsdcd_wall_step_spheres.argtypes = [_at, _at, _at]
    lib.lsdcd_wall_renumber.argtypes = [_at, _at, _size]
    for call in ("get_pose", "set_servo", "get_node_count", "get_nodes", "get_node_forces",
                 "get_body", "set_body"):
        getattr(lib, "lsdcd_wall_" + call).argtypes = [_at, _int, _at]
    lib.lsdcd_sub_model_get_facts.argtypes = [_size, _at]
    lib.lsdcd_law_from_material.argtypes = [_at, _at, _at]
    lib.lsdcd_place_scale.argtypes = lib.lsdcd_place_move.argtypes = [_at, _real, _real, _real]
    lib.lsdcd_place_rotate.argtypes = [_at, _at, _real]
    lib.lsdcd_wall_from_spec.argtypes = [_at, _at, _at]
    lib.lsdcd_wall_set_pose.argtypes = [_at, _int, _at, _at, _at, _at]
    lib.lsdcd_wall_set_nodes.argtypes = [_at, _int, _at, _at]
    lib.lsdcd_wall_get_totals.argtypes = [_at, _int, _at, _at]
    lib.lsdcd_wall_set_motion.argtypes = [_at, _int, _at, _size]
    lib.lsdcd_wall_save.argtypes = [_at, _at, _size, _at]
    lib.lsdcd_wall_restore.argtypes = lib.lsdcd_wall_restore_what_fits.argtypes = [_at, _at, _size]
    lib.lsdcd_wall_pack.argtypes = [_at, _at, _size, _at, _size, _at]
    lib.lsdcd_wall_unpack.argtypes = [_at, _at, _size, _at, _size]
    return lib


_lib = _load()


def _text(given: bytes) -> str:
    """A text of the library. It may name a file in bytes that are no UTF-8, or quote some of a binary one: these are as \\xff."""
    return given.decode(errors="backslashreplace")


def _check(code: int) -> None:
    if code != 0:
        raise Error(_text(_lib.lsdcd_last_error()), ERRORS[code])


@contextlib.contextmanager
def _interrupts_held(raised: list[BaseException]) -> Iterator[None]:
    """Adds what the handler of Ctrl-C raises, KeyboardInterrupt, to `raised` while C calls Python: where it comes as a
    callback begins or ends, ctypes would print it and go on."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield
        return
    its_handler = handler

    def hold(number: int, frame: Any) -> None:
        try:
            its_handler(number, frame)
        except BaseException as error:
            raised.append(error)

    signal.signal(signal.SIGINT, hold)
    try:
        yield
    finally:
        if signal.getsignal(signal.SIGINT) is hold:    # else a callback has set another one
            signal.signal(signal.SIGINT, handler)


def _listened(call: Callable[[], Any], options: Any, listener: Progress | None) -> None:
    """Makes a call with these options that tells the listener how far it is."""
    if listener is None:
        return _check(call())
    progress: Progress = listener
    raised: list[BaseException] = []

    def tell(_: Any, what: bytes, done: float) -> int:
        try:
            return int(bool(progress(_text(what), done)) or bool(raised))
        except BaseException as error:    # none may pass through C
            raised.append(error)
            return 1

    options.progress = _Progress(tell)
    with _interrupts_held(raised):
        code = call()
    if raised:
        raise raised[0]
    _check(code)


def _sized(struct: Any, **values: Any) -> Any:
    """A struct with these values. ctypes would cut off what does not fit a field."""
    fits = {_int: _c_int, _real: _c_double, ctypes.c_char_p: _c_text}
    kinds = dict(struct._fields_)
    made = struct(size=ctypes.sizeof(struct))
    for name, value in values.items():
        setattr(made, name, fits[kinds[name]](value, name) if kinds[name] in fits else value)
    return made


def _c_int(value: Any, name: str) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, not a whole number") from None
    if not -2**31 <= number < 2**31:
        raise ValueError(f"{name} is {number}, and goes from {-2**31} to {2**31 - 1} at most")
    return number


def _flag(value: Any, name: str) -> bool:
    """bool() would make True of "no"."""
    if isinstance(value, (bool, int, np.bool_, np.integer)) and value in (0, 1):
        return bool(value)
    raise TypeError(f"{name} is {value!r}, not True or False")


def _c_double(value: Any, name: str) -> float:
    if isinstance(value, (str, bytes)) or np.iscomplexobj(value):
        raise TypeError(f"{name} is {value!r}, not a real number")
    try:
        return float(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, not a real number") from None
    except OverflowError:
        raise ValueError(f"{name} is beyond the range of float64") from None


def _c_text(text: str | bytes | os.PathLike[str] | None, name: str) -> bytes | None:
    if text is None:
        return None
    if not isinstance(text, (str, bytes, os.PathLike)):
        raise TypeError(f"{name} is {text!r}, not a text")
    encoded = os.fsencode(text)
    if b"\0" in encoded:    # C would read what is before it
        raise ValueError(f"{name} has a NUL in it: {encoded!r}")
    return encoded


def _tuple(value: Any, form: str, name: str) -> tuple[Any, ...]:
    """The values of what is written as `form`, "(lo, hi)"."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__len__") or not hasattr(value, "__iter__"):
        raise TypeError(f"{name} is {value!r}, not {form}")
    values = tuple(value)
    if len(values) != form.count(",") + 1:
        raise ValueError(f"{name} is {value!r}; it is {form}")
    return values


def _instance(value: Any, kind: Any, name: str) -> Any:
    if not isinstance(value, kind):
        raise TypeError(f"{name} is {value!r}, not a {kind.__name__}")
    return value


def _list(values: Any, name: str) -> list[Any]:
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise TypeError(f"{name} is {values!r}, not a list")
    return list(values)


def _instances(values: Any, kind: Any, name: str) -> list[Any]:
    return [_instance(value, kind, f"{name}[{k}]") for k, value in enumerate(_list(values, name))]


def _facts(struct: Any, call: Any, handle: Any) -> dict[str, Any]:
    facts = _sized(struct)
    _check(call(handle, ctypes.byref(facts)))
    values = {name: getattr(facts, name) for name, _ in struct._fields_[1:]}
    return {k: tuple(v) if isinstance(v, ctypes.Array) else v for k, v in values.items()}


def _chosen(name: str, word: str, words: Sequence[str]) -> int:
    """The index of a word among those that there are."""
    if not isinstance(word, str) or word not in words:
        raise ValueError(f"{name} is {word!r}; it is {' or '.join(map(repr, words))}")
    return words.index(word)


_Self = TypeVar("_Self", bound="_Owner")


class _Owner:
    """Owns `_handle`, memory of the library, which `_free` frees: once, so that it has one owner."""

    _free: Any

    def __init__(self) -> None:
        self._handle = _at()

    def __del__(self) -> None:
        self.close()

    def close(self) -> None:
        """Frees the memory now; every later call is an Error. `with` does it at its end."""
        if getattr(self, "_handle", None):
            self._free(self._handle)
            self._handle = _at()

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce_ex__(self, protocol: Any) -> Any:    # what copy, deepcopy and pickle ask for
        raise TypeError(f"a {type(self).__name__} holds memory of the library and is neither copied nor pickled; "
                        "share it, or make another one")


class _Spec:
    """Prints, and is pickled, as the call that made it. `_made_by`: the name of a class method, "" for the class itself, and the
    arguments by name."""
    _made_by: tuple[str, dict[str, Any]]

    def __repr__(self) -> str:
        method, given = self._made_by
        maker = type(self).__name__ + ("." + method if method else "")
        return f"{maker}({', '.join(f'{name}={value!r}' for name, value in given.items())})"

    def __reduce__(self) -> Any:
        return _make_again, (type(self), *self._made_by)


def _make_again(kind: Any, method: str, given: dict[str, Any]) -> Any:
    return getattr(kind, method)(**given) if method else kind(**given)


_Maker = TypeVar("_Maker", bound=Callable[..., Any])


def _noted(maker: _Maker) -> _Maker:
    """Notes for _Spec what an __init__ or a class method is called with. Arrays are copied: the caller may go on with them."""
    names = inspect.signature(maker)

    @functools.wraps(maker)
    def make(first: Any, *arguments: Any, **more: Any) -> Any:
        made = maker(first, *arguments, **more)
        given: dict[str, Any] = {}
        for name, value in list(names.bind(first, *arguments, **more).arguments.items())[1:]:
            by_name = value if names.parameters[name].kind is inspect.Parameter.VAR_KEYWORD else {name: value}
            given |= {key: np.array(one) if isinstance(one, np.ndarray) else one for key, one in by_name.items()}
        (first if made is None else made)._made_by = ("" if made is None else maker.__name__, given)
        return made
    return cast(_Maker, make)


class _Record:
    """Named values. types.SimpleNamespace would let a type checker pass any name."""

    def __init__(self, **values: Any) -> None:
        self.__dict__.update(values)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"

    def __eq__(self, other: object) -> bool:
        """Are all values the same, those of arrays one by one? What is no number is the same as another such."""
        if not isinstance(other, _Record):
            return NotImplemented
        mine, others = vars(self), vars(other)
        return mine.keys() == others.keys() and all(_are_same(mine[name], others[name]) for name in mine)


def _are_same(a: Any, b: Any) -> bool:
    if not (hasattr(a, "shape") and hasattr(b, "shape")) or a is b:
        return a is b or bool(a == b)
    if tuple(a.shape) != tuple(b.shape):
        return False
    equal = a == b
    return equal if isinstance(equal, bool) else bool((equal | ((a != a) & (b != b))).all())


def _as_floats(given: ArrayLike, name: str) -> NDArray[Any]:
    """float32 or float64, as what can be converted to it."""
    values = _arrays.plain(given, name)
    if values.dtype in (np.float32, np.float64):
        return values
    # An object may be a fraction. numpy would make a number of a text, and NaN of None.
    if values.size and values.dtype.kind not in "fiuO" or \
            values.dtype.kind == "O" and any(value is None or isinstance(value, (str, bytes, bool)) for value in values.flat):
        raise TypeError(f"{name}: {values.dtype}, not real numbers")
    try:
        return values.astype(np.float64)
    except OverflowError:
        raise ValueError(f"{name}: a number beyond the range of float64") from None


def _numbers(values: ArrayLike | None, shape: tuple[int, ...], name: str) -> NDArray[np.float64] | None:
    if values is None:
        return None
    numbers = np.ascontiguousarray(_as_floats(values, name), dtype=np.float64)
    if numbers.shape != shape:
        raise ValueError(f"{name} has the shape {numbers.shape}, not {shape}")
    return numbers
