# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Arrays of other libraries where they lie, on the host or on a CUDA device: `read()` takes what numpy takes,
`__dlpack__` (DLPack 0.x, as the array API standard has it) and `__cuda_array_interface__` (versions 2 and 3), and
copies nothing. `empty_like()` makes arrays of the same library for results.

PyTorch and CuPy are asked for their current stream and for memory where the caller has imported them; none is
imported here.
"""
from __future__ import annotations

import contextlib
import ctypes
import functools
import math
import sys
from typing import Any, Iterator

import numpy as np

_CPU, _CUDA, _CUDA_HOST, _CUDA_MANAGED = 1, 2, 3, 13    # DLDeviceType
_KINDS = {0: "i", 1: "u", 2: "f", 5: "c"}    # DLDataTypeCode


class _Tensor(ctypes.Structure):    # DLTensor
    _fields_ = [("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device_id", ctypes.c_int32),
                ("ndim", ctypes.c_int32), ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8), ("lanes", ctypes.c_uint16),
                ("shape", ctypes.POINTER(ctypes.c_int64)), ("strides", ctypes.POINTER(ctypes.c_int64)),
                ("byte_offset", ctypes.c_uint64)]


_Deleter = ctypes.CFUNCTYPE(None, ctypes.c_void_p)


class _Managed(ctypes.Structure):    # DLManagedTensor
    _fields_ = [("tensor", _Tensor), ("context", ctypes.c_void_p), ("deleter", _Deleter)]


_capsule_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_capsule_pointer.argtypes, _capsule_pointer.restype = [ctypes.py_object, ctypes.c_char_p], ctypes.c_void_p
_capsule_is = ctypes.pythonapi.PyCapsule_IsValid
_capsule_is.argtypes, _capsule_is.restype = [ctypes.py_object, ctypes.c_char_p], ctypes.c_int
_capsule_new = ctypes.pythonapi.PyCapsule_New
_capsule_new.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
_capsule_new.restype = ctypes.py_object
_NAME = b"dltensor"    # a capsule keeps the address of its name


def packed_strides(shape: tuple[int, ...], itemsize: int) -> tuple[int, ...]:
    """Strides, in bytes, of an array in C order."""
    strides = []
    for n in reversed(shape):
        strides.append(itemsize)
        itemsize *= max(n, 1)
    return tuple(reversed(strides))


class Array:
    """Memory of somebody else, kept alive by `source` and `keeper`: its address, its shape, its strides in bytes.
    `device` is the number of a CUDA device, None: the host's memory. `stream`: where its values are made, a
    cudaStream_t, None: not said."""

    def __init__(self, source: Any, address: int, shape: tuple[int, ...], strides: tuple[int, ...] | None, dtype: np.dtype[Any],
                 device: int | None = None, writable: bool = True, stream: int | None = None, keeper: Any = None) -> None:
        self.source, self.address, self.shape, self.dtype = source, address, shape, dtype
        self.strides = packed_strides(shape, dtype.itemsize) if strides is None else strides
        self.device, self.writable, self.stream, self.keeper = device, writable, stream, keeper

    @property
    def on_host(self) -> bool:
        return self.device is None

    @property
    def __array_interface__(self) -> dict[str, Any]:
        """For numpy, of memory of the host."""
        return {"version": 3, "shape": self.shape, "typestr": self.dtype.str, "strides": self.strides,
                "data": (self.address, not self.writable)}

    def host(self) -> np.ndarray[Any, Any]:
        """The same memory as numpy's."""
        return self.source if isinstance(self.source, np.ndarray) else np.asarray(self)

    def steps(self, inner: int) -> tuple[int, ...] | None:
        """Steps from one to the next, in elements: one step for all dimensions but the last `inner`, taken as one in
        C order, then one for each of these. None where there is no such step, or it is 0, or not aligned."""
        size, outer = self.dtype.itemsize, len(self.shape) - inner
        if 0 in self.shape:
            packed = packed_strides((1, *self.shape[outer:]), size)
            return tuple(step // size for step in packed)
        long = [(n, step) for n, step in zip(self.shape[:outer], self.strides) if n != 1]
        for (_, step), (n, next_step) in zip(long, long[1:]):
            if step != n * next_step:
                return None
        first = long[-1][1] if long else size * math.prod(self.shape[outer:])
        found = (first, *self.strides[outer:])
        if self.address % size or any(step == 0 or step % size for step in found):
            return None
        return tuple(step // size for step in found)


def read(values: Any, name: str, stream: int | None = None) -> Array:
    """What the caller gives as `name`, in place; lists and numbers become an array of numpy. `stream`, a
    cudaStream_t, is where a device's array will be used: an array that comes by DLPack is ready there.
    Raises TypeError for a type or place that cannot be read, and for a mask, ValueError for stream 0."""
    if isinstance(values, np.ndarray):
        return of_numpy(plain(values, name))
    interface = getattr(values, "__cuda_array_interface__", None)
    can_dlpack = hasattr(values, "__dlpack__") and hasattr(values, "__dlpack_device__")
    # An interface of version 2 does not say on which stream the values are made. PyTorch has its current stream.
    if interface is not None and ("stream" in interface or not can_dlpack or _is_torch(values)):
        return _of_interface(values, interface, name)
    if can_dlpack:
        return _of_dlpack(values, name, stream)
    return of_numpy(plain(values, name))


def plain(values: Any, name: str) -> np.ndarray[Any, Any]:
    """As numpy has it. Raises TypeError where a mask hides values: the library does not see masks."""
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise TypeError(f"{name} has masked values: fill them in, {name}.filled(...), or leave their rows out")
    return np.asarray(values)


def of_numpy(values: np.ndarray[Any, Any]) -> Array:
    return Array(values, values.ctypes.data, values.shape, values.strides, values.dtype,
                 writable=bool(values.flags.writeable))


def _of_interface(values: Any, interface: dict[str, Any], name: str) -> Array:
    if interface.get("mask") is not None:
        raise TypeError(f"{name} has a mask, which is not read: fill it in, and give an array without one")
    stream = interface.get("stream")
    if stream == 0:
        raise ValueError(f"{name}: stream 0 in __cuda_array_interface__ may be any; it is 1 (legacy), 2 (of the thread) or a stream")
    address, read_only = interface["data"]
    strides = interface.get("strides")
    return Array(values, address or 0, tuple(interface["shape"]), None if strides is None else tuple(strides),
                 np.dtype(interface["typestr"]), _device_of(address or 0, values), not read_only, stream)


def _of_dlpack(values: Any, name: str, stream: int | None) -> Array:
    kind, number = map(int, values.__dlpack_device__())
    if kind not in (_CPU, _CUDA, _CUDA_HOST, _CUDA_MANAGED):
        raise TypeError(f"{name} is on a device of DLPack's type {kind}; the library takes arrays of the host (1) and of "
                        "CUDA (2): copy it there first")
    on_device = kind in (_CUDA, _CUDA_MANAGED)
    # DLPack's 1 is the default stream, CUDA's null.
    capsule = values.__dlpack__(stream=stream or 1) if on_device else values.__dlpack__()
    if not _capsule_is(capsule, _NAME):
        raise TypeError(f"{name}: its __dlpack__ gives no capsule named dltensor")
    # The capsule is not renamed: it frees what it holds when it is collected itself.
    tensor = _Managed.from_address(_capsule_pointer(capsule, _NAME)).tensor
    if tensor.code not in _KINDS or tensor.lanes != 1 or tensor.bits % 8:
        raise TypeError(f"{name} is of DLPack's type {tensor.code} with {tensor.bits} bits, which numpy does not have: "
                        "convert it to float32 or float64")
    dtype = np.dtype(f"{_KINDS[tensor.code]}{tensor.bits // 8}")
    shape = tuple(tensor.shape[k] for k in range(tensor.ndim))
    strides = tuple(tensor.strides[k] * dtype.itemsize for k in range(tensor.ndim)) if tensor.strides else None
    return Array(values, (tensor.data or 0) + tensor.byte_offset, shape, strides, dtype, number if on_device else None,
                 stream=stream, keeper=capsule)


# ---- libraries that the caller has imported

def _is_torch(values: Any) -> bool:
    torch = sys.modules.get("torch")
    return torch is not None and isinstance(values, torch.Tensor)


def _is_cupy(values: Any) -> bool:
    cupy = sys.modules.get("cupy")
    return cupy is not None and isinstance(values, cupy.ndarray)


def stream_handle(stream: Any) -> int | None:
    """The cudaStream_t of a stream as a number: of PyTorch's and CuPy's streams, of what has `__cuda_stream__`, of a
    number; None: None. Raises TypeError for others."""
    if stream is None or isinstance(stream, int) and not isinstance(stream, bool):
        return stream
    for attribute in ("cuda_stream", "ptr"):
        if isinstance(getattr(stream, attribute, None), int):
            return int(getattr(stream, attribute))
    if hasattr(stream, "__cuda_stream__"):
        return int(stream.__cuda_stream__()[1])
    raise TypeError(f"stream is a {type(stream).__name__}, not a stream of PyTorch or CuPy, nor a cudaStream_t as a number")


def stream_of(array: Array, stream: Any = None) -> tuple[int, Any]:
    """The stream on which to use a device's array, and what keeps it alive: `stream` if it is given, or that of the
    array, or the current one of its library, or the default one, 0."""
    if stream is not None:
        return stream_handle(stream) or 0, stream
    if _is_torch(array.source):
        stream = sys.modules["torch"].cuda.current_stream(array.device)
        return stream.cuda_stream, stream
    if _is_cupy(array.source):
        stream = sys.modules["cupy"].cuda.get_current_stream()
        return stream.ptr, stream
    return array.stream or 0, None


def empty_like(array: Array, shape: tuple[int, ...], dtype: Any, stream: Any = None) -> tuple[Any, Array]:
    """An array for results, of the library and on the device of `array`, and where it lies: PyTorch's, CuPy's, of the
    host numpy's for all others, of a device a DeviceArray. PyTorch has int32 for uint32, int64 for uint64.
    `stream`: where it will be written, of a device's."""
    dtype = np.dtype(dtype)
    if _is_torch(array.source):
        torch = sys.modules["torch"]
        name = {"uint32": "int32", "uint64": "int64"}.get(dtype.name, dtype.name)
        with _torch_stream(torch, array, stream):
            made = torch.empty(shape, dtype=getattr(torch, name), device=array.source.device)
        return made, Array(made, made.data_ptr(), shape, None, dtype, array.device)
    if array.on_host:
        made = np.empty(shape, dtype)
        return made, of_numpy(made)
    if _is_cupy(array.source):
        cupy = sys.modules["cupy"]
        known = stream is None or isinstance(stream, int)
        with cupy.cuda.Device(array.device):
            external = cupy.cuda.ExternalStream(stream, array.device) if isinstance(stream, int) and stream > 2 else None
            with external or (contextlib.nullcontext() if known or not hasattr(stream, "__enter__") else stream):
                made = cupy.empty(shape, dtype)
        return made, Array(made, made.data.ptr, shape, None, dtype, array.device)
    made = DeviceArray(shape, dtype, array.device or 0)
    return made, Array(made, made.address, shape, None, dtype, array.device)


def _torch_stream(torch: Any, array: Array, stream: Any) -> Any:
    """Where PyTorch allocates: its memory is free again in the order of one stream."""
    if array.on_host or stream is None:
        return contextlib.nullcontext()
    handle = stream_handle(stream)
    if handle is None or handle <= 2:
        return contextlib.nullcontext()
    return torch.cuda.stream(torch.cuda.ExternalStream(handle, device=array.source.device))


def must_wait(array: Array) -> bool:
    """Does nothing but us keep this array of a device until a stream has used it? PyTorch and CuPy free memory in
    the order of their streams."""
    return not array.on_host and not _is_torch(array.source) and not _is_cupy(array.source)


# ---- CUDA, by its driver

class _Driver:
    """What is needed of libcuda: contexts, memory, streams."""

    def __init__(self) -> None:
        try:
            self._lib = ctypes.CDLL("libcuda.so.1")
        except OSError as error:
            raise TypeError(f"an array of a CUDA device, but there is no CUDA driver here: {error}") from None
        self._contexts: dict[int, ctypes.c_void_p] = {}
        self("cuInit", 0)

    def __call__(self, name: str, *arguments: Any) -> None:
        code = getattr(self._lib, name)(*arguments)
        if code != 0:
            text = ctypes.c_char_p()
            self._lib.cuGetErrorString(code, ctypes.byref(text))
            raise RuntimeError(f"{name}: {(text.value or b'?').decode()}")

    def device_of(self, address: int) -> int:
        found = ctypes.c_int(-1)
        self("cuPointerGetAttribute", ctypes.byref(found), 9, ctypes.c_uint64(address))    # the device's number
        return found.value

    @contextlib.contextmanager
    def on(self, device: int) -> Iterator[None]:
        """Makes a device current, as cudaSetDevice() does, and then the one that was."""
        if device not in self._contexts:
            number, context = ctypes.c_int(), ctypes.c_void_p()
            self("cuDeviceGet", ctypes.byref(number), device)
            self("cuDevicePrimaryCtxRetain", ctypes.byref(context), number)
            self._contexts[device] = context
        self("cuCtxPushCurrent_v2", self._contexts[device])
        try:
            yield
        finally:
            self("cuCtxPopCurrent_v2", ctypes.byref(ctypes.c_void_p()))

    def wait(self, stream: int) -> None:
        self("cuStreamSynchronize", ctypes.c_void_p(stream))

    def allocate(self, size: int) -> int:
        address = ctypes.c_uint64()
        self("cuMemAlloc_v2", ctypes.byref(address), ctypes.c_size_t(max(size, 1)))
        return address.value

    def free(self, address: int) -> None:
        self("cuMemFree_v2", ctypes.c_uint64(address))    # waits for the device


@functools.lru_cache(maxsize=None)
def driver() -> _Driver:
    """Raises TypeError where CUDA's driver is not installed."""
    return _Driver()


def _device_of(address: int, values: Any) -> int:
    """The device of an array that says only where it lies."""
    for name in ("id", "index"):    # CuPy's and PyTorch's devices
        number = getattr(getattr(values, "device", None), name, None)
        if isinstance(number, int):
            return number
    return driver().device_of(address) if address else 0


class _Offered:
    """An array in C order that `__dlpack__` hands on."""
    address: int
    shape: tuple[int, ...]
    dtype: np.dtype[Any]

    def __dlpack_device__(self) -> tuple[int, int]:
        raise NotImplementedError

    def __dlpack__(self, *, stream: int | None = None, **_: Any) -> Any:
        """A capsule for another library's from_dlpack(). What is written is finished: no stream has to wait."""
        ndim = len(self.shape)
        shape = (ctypes.c_int64 * ndim)(*self.shape)
        managed = _Managed()
        managed.tensor = _Tensor(self.address, *self.__dlpack_device__(), ndim, {"i": 0, "u": 1, "f": 2}[self.dtype.kind],
                                 8 * self.dtype.itemsize, 1, shape, None, 0)
        managed.deleter = _forget
        at = ctypes.addressof(managed)
        _handed_on[at] = (managed, shape, self)
        return _capsule_new(at, _NAME, _drop)


_handed_on: dict[int, Any] = {}    # what capsules hold, until their deleter is called


def _forget_tensor(at: int) -> None:
    _handed_on.pop(at, None)


def _drop_capsule(capsule: int) -> None:
    """A capsule that nobody has taken is collected; one that somebody took has another name."""
    if _raw_is(capsule, _NAME):
        _forget_tensor(_raw_pointer(capsule, _NAME))


_forget, _drop = _Deleter(_forget_tensor), _Deleter(_drop_capsule)
# The capsule is being collected: Python must not count references to it.
_raw_is = ctypes.PYFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p)(("PyCapsule_IsValid", ctypes.pythonapi))
_raw_pointer = ctypes.PYFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_char_p)(("PyCapsule_GetPointer", ctypes.pythonapi))


class DeviceArray(_Offered):
    """Results in the memory of a CUDA device, (shape) of dtype in C order, for any library: it offers `__dlpack__`
    (`jax.dlpack.from_dlpack(array)`) and `__cuda_array_interface__`. Freed with the last that uses it."""

    def __init__(self, shape: tuple[int, ...], dtype: np.dtype[Any], device: int) -> None:
        self.address = 0
        self.shape, self.dtype, self.device_number = shape, dtype, device
        with driver().on(device):
            self.address = driver().allocate(math.prod(shape) * dtype.itemsize)

    def __del__(self) -> None:
        if self.address:
            with contextlib.suppress(RuntimeError), driver().on(self.device_number):
                driver().free(self.address)

    def __dlpack_device__(self) -> tuple[int, int]:
        return _CUDA, self.device_number

    @property
    def __cuda_array_interface__(self) -> dict[str, Any]:
        return {"version": 3, "shape": self.shape, "typestr": self.dtype.str, "data": (self.address, False), "strides": None,
                "stream": None}
