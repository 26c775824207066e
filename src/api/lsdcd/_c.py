# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The shared library of lsdcd.h through ctypes: its errors, and numbers that fit its structs."""
from __future__ import annotations

import contextlib
import ctypes
import glob
import operator
import os
import signal
import threading
from typing import Any, Callable, Iterator, Literal, Sequence, TypeVar, cast, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays
from ._header import Header

_size, _int, _real, _at = ctypes.c_size_t, ctypes.c_int, ctypes.c_double, ctypes.c_void_p
ERRORS = ("ok", "argument", "input", "cutoff", "side", "device", "memory", "internal", "cancelled")
Device = Literal["cpu", "cuda"]
DEVICES: tuple[Device, ...] = get_args(Device)


# A listener of a long call: what is done now, and how much of that, from 0 to 1. What it raises ends the call and is
# raised by it, as KeyboardInterrupt is; a true result ends it with an Error, "cancelled".
Progress = Callable[[str, float], object]
_Progress = ctypes.CFUNCTYPE(_int, _at, ctypes.c_char_p, _real)


_Show = ctypes.CFUNCTYPE(None, _at, _int, ctypes.c_char_p)
_Reduce = ctypes.CFUNCTYPE(_int, _at, ctypes.POINTER(_real), _int)
_Broadcast = ctypes.CFUNCTYPE(_int, _at, ctypes.POINTER(ctypes.c_uint8), _size, _int)

_HEADER = Header({"lsdcd_progress": _Progress, "lsdcd_message": _Show, "sum": _Reduce, "max": _Reduce, "broadcast": _Broadcast})
_structs: Any = _HEADER.structs
(_MeshFacts, _MeshArrays, _GridOptions, _GridFacts, _Query, _Contacts) = (_structs["lsdcd_" + name] for name in (
    "mesh_facts", "mesh_arrays", "grid_options", "grid_facts", "query", "contacts"))
_Shapes, _ShapeFacts = _structs["lsdcd_shapes"], _structs["lsdcd_shape_facts"]
(_BodyOptions, _BodyFacts, _Collision) = (_structs["lsdcd_" + name] for name in ("body_options", "body_facts", "collision"))
_SubModelFacts, _BodyState = _structs["lsdcd_sub_model_facts"], _structs["lsdcd_body_state"]
(_Host, _WallOptions, _Spheres, _WallStep, _WallTotals, _WallContacts, _WallImpacts) = (_structs["lsdcd_" + name] for name in (
    "host", "wall_options", "spheres", "wall_step", "wall_totals", "wall_contacts", "wall_impacts"))


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
    try:
        lib = ctypes.CDLL(name)
    except OSError as e:
        raise ImportError(f"lsdcd's shared library cannot be loaded: {e}. Build it (cmake --build build --target lsdcd_api) or install it, "
                          "or let LSDCD_LIBRARY name the file liblsdcd.so.0") from e
    for function, (result, arguments) in _HEADER.functions.items():
        made = getattr(lib, function)
        made.restype, made.argtypes = result, arguments
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


def _listened(call: Callable[[], Any], options: Any, listener: Progress | None, *objects: _Owner) -> None:
    """Makes a call of these objects, with these options, that tells the listener how far it is."""
    with _in_use(*objects):
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
        self._is_closed = False
        self._calls: list[None] = []    # one for each call that uses the memory; see _in_use()

    def __del__(self) -> None:
        self.close()

    def close(self) -> None:
        """Frees the memory now; every later call is an Error. `with` does it at its end. Raises Error while a call of the object has
        not returned, as in its callback or in another thread."""
        if not getattr(self, "_handle", None):
            return
        handle, self._handle = self._handle, _at()
        if self._calls:    # looked at when no further call can find the handle
            self._handle = handle
            raise Error(f"this {type(self).__name__} cannot be closed, as a call of it has not returned: close it behind that call, not in "
                        "its callback or in another thread", "argument")
        self._is_closed = True
        self._free(handle)

    def _check_open(self) -> None:
        if self._is_closed:
            raise Error(f"this {type(self).__name__} is closed: make another one", "argument")

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce_ex__(self, protocol: Any) -> Any:    # what copy, deepcopy and pickle ask for
        raise TypeError(f"a {type(self).__name__} holds memory of the library and is neither copied nor pickled; "
                        "share it, or make another one")


@contextlib.contextmanager
def _in_use(*objects: _Owner) -> Iterator[None]:
    """Meanwhile none of these objects can be closed: calls of C let other threads run, and may call Python back. Their handles are to be
    read within. Raises Error for one that is closed."""
    for one in objects:
        one._calls.append(None)
    try:
        for one in objects:
            one._check_open()
        yield
    finally:
        for one in objects:
            one._calls.pop()


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
