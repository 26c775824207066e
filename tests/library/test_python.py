# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The Python package beside its answers (use_module.py has these): arrays of other libraries, types.

PYTHONPATH and LSDCD_LIBRARY name the package and its library. No GPU is needed: addresses of devices are read, not
followed (test_python_gpu.py follows them).
"""
import concurrent.futures
import contextlib
import copy
import ctypes
import gc
import importlib.util
import math
import multiprocessing
import os
import pathlib
import pickle
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import weakref

import numpy as np

import lsdcd
from facts import fact
from lsdcd import _arrays, _c

ROOT = pathlib.Path(__file__).resolve().parents[2]


def refused(name, says, call, kind=TypeError):
    try:
        call()
    except kind as error:
        fact(name, says in str(error), error)
        return
    fact(name, False, "not refused")


class OnlyDlpack:
    """An array of a library that numpy does not know, of the host, or said to be of another device."""

    def __init__(self, values, device=None):
        self.values, self.device_type = values, device

    def __dlpack__(self, **words):
        self.words = words
        return self.values.__dlpack__()

    def __dlpack_device__(self):
        return self.device_type or self.values.__dlpack_device__()


class OnCuda:
    """An array at an address of device 3 that is not there."""

    def __init__(self, shape, typestr="<f4", strides=None, read_only=False, **more):
        self.device = type("Device", (), {"id": 3})()
        self.__cuda_array_interface__ = {"shape": shape, "typestr": typestr, "data": (0x7f0000000000, read_only),
                                         "strides": strides, "version": 3, **more}


class OfHost(_arrays._Offered):
    """What DeviceArray hands on, over memory of numpy."""

    def __init__(self, values):
        self.values, self.address, self.shape, self.dtype = values, values.ctypes.data, values.shape, values.dtype

    def __dlpack_device__(self):
        return 1, 0


def test_reading():
    layouts = np.arange(48.0).reshape(2, 8, 3)
    for name, values, steps in (("packed", layouts, (3, 1)), ("every second", layouts[:, ::2], (6, 1)),
                                ("backwards", layouts[0, ::-1], (-3, 1)), ("columns apart", layouts[0].T.copy().T, (1, 8)),
                                ("transposed", layouts.transpose(1, 0, 2), None), ("one point", layouts[1, 1], (3, 1)),
                                ("repeated", np.broadcast_to(layouts[0, 0], (5, 3)), None)):
        read = _arrays.read(OnlyDlpack(values) if values.flags.writeable else values, "points")
        fact(f"DLPack: {name} is read in place", read.address == values.ctypes.data and read.shape == values.shape
             and (read.host() == values).all() and read.host().ctypes.data == values.ctypes.data)
        fact(f"steps: {name}", read.steps(1) == steps, read.steps(1))
    read = _arrays.read(OnlyDlpack(layouts), "points")
    read.host()[0, 0, 0] = 7
    fact("what is written there is the owner's", layouts[0, 0, 0] == 7)

    offered = OfHost(np.arange(12, dtype=np.float32).reshape(3, 4))
    taken = np.from_dlpack(offered)
    fact("numpy takes what we offer", (taken == offered.values).all() and taken.ctypes.data == offered.address)
    fact("it is kept as long as it is used", len(_arrays._handed_on) == 1)
    del taken
    capsule = offered.__dlpack__()    # nobody takes it
    read = _arrays.read(offered, "points")
    del capsule, read
    gc.collect()
    fact("and not longer", not _arrays._handed_on)

    read = _arrays.read(OnCuda((5, 3), stream=7), "points")
    fact("CUDA's interface is read", (read.device, read.shape, read.strides, read.dtype, read.stream, read.writable)
         == (3, (5, 3), (12, 4), np.float32, 7, True))
    fact("its stream is the array's, unless one is given",
         (_arrays.stream_of(read)[0], _arrays.stream_of(read, 9)[0]) == (7, 9))
    fact("read-only is seen", not _arrays.read(OnCuda((5, 3), read_only=True), "out").writable)
    fact("strides are seen", _arrays.read(OnCuda((2, 3), strides=(16, 4)), "points").steps(1) == (4, 1))
    fact("a stream may be an object", _arrays.stream_handle(type("Stream", (), {"ptr": 5})()) == 5
         and _arrays.stream_handle(type("Stream", (), {"__cuda_stream__": lambda self: (0, 6)})()) == 6)
    refused("a mask is refused", "fill it in", lambda: _arrays.read(OnCuda((5, 3), mask=1), "points"))
    refused("stream 0 is refused", "stream 0", lambda: _arrays.read(OnCuda((5, 3), stream=0), "points"),
            ValueError)
    refused("another device is refused", "type 10", lambda: _arrays.read(OnlyDlpack(layouts, (10, 0)), "points"))
    refused("what is no stream is refused", "stream is a str", lambda: _arrays.stream_handle("fast"))
    lent = OnlyDlpack(layouts, (2, 1))
    read = _arrays.read(lent, "points", stream=9)
    fact("DLPack is told the stream", lent.words == {"stream": 9} and (read.device, read.stream) == (1, 9), lent.words)
    _arrays.read(lent, "points")
    fact("and that the default one is 1", lent.words == {"stream": 1}, lent.words)


def test_queries():
    """Arrays of others, asked of a floor at z = 0."""
    grid = lsdcd.Mesh([[[-9, -9, 0], [9, -9, 0], [0, 9, 0]]]).grid(cutoff=2)
    z = np.arange(6, dtype=np.float32).reshape(2, 3) / 4
    points = np.stack([0 * z, 0 * z, z], axis=-1)
    answer = grid.query(OnlyDlpack(points), "distance triangle")
    fact("points come by DLPack", (answer.distance == z).all() and answer.distance.dtype == np.float32)
    distance = np.zeros((2, 3), np.float32)
    answer = grid.query(points, out={"distance": OnlyDlpack(distance)})
    fact("answers go where DLPack says", (distance == z).all() and isinstance(answer.distance, OnlyDlpack))
    fact("radii come by DLPack", (np.isfinite(grid.query(points, radius=OnlyDlpack(z + 0.25)).distance)).all())

    there = OnCuda((5, 3), stream=7)
    refused("points and answers are in one place", "distance is on the host, points are on CUDA device 3",
            lambda: grid.query(there, out={"distance": distance}))
    refused("points and radii, too", "radius is on CUDA device 3, points are on the host",
            lambda: grid.query(points, radius=OnCuda((2, 3))))
    refused("an answer on a device can be read-only", "cannot be written to",
            lambda: grid.query(there, out={"distance": OnCuda((5,), read_only=True)}), ValueError)
    rows = np.lib.stride_tricks.as_strided(np.zeros(9), (5, 3), (8, 8))
    refused("rows of answers that overlap are refused", "numbers of several points have one place with a row of 1 and a column of 1",
            lambda: grid.query(np.zeros((5, 3)), out={"closest": rows}), lsdcd.Error)
    refused("points on a device are not copied", "strides (48, 1), not one step",
            lambda: grid.query(OnCuda((5, 3), strides=(48, 1))), ValueError)
    refused("contacts of points on a device are refused", "are on CUDA device 3, and contacts are found on the host alone",
            lambda: grid.contacts(there, 1))
    met = grid.contacts(OnlyDlpack(points), 0.5, out={"distance": OnlyDlpack(np.zeros(9, np.float32))})
    fact("contacts come by DLPack", met.first.tolist() == [0, 1, 2, 2, 2, 2, 2] and met.overlap.dtype == np.float32)
    refused("nor converted", "of type int32: convert", lambda: grid.query(OnCuda((5, 3), "<i4")))
    refused("shapes on a device are named", "(5, 4), not (..., 3)", lambda: grid.query(OnCuda((5, 4))), ValueError)
    if not os.path.exists("/dev/nvidiactl"):
        refused("without a driver that is said", "no CUDA driver", lambda: grid.query(there))

    torch = importlib.util.find_spec("torch") and importlib.import_module("torch")
    if not torch:
        print("skipped: PyTorch (no torch)")
        return
    given = torch.from_numpy(points)
    answer = grid.query(given, "distance closest triangle status")
    fact("PyTorch's points have PyTorch's answers", all(isinstance(a, torch.Tensor) for a in vars(answer).values())
         and answer.triangle.dtype == torch.int32 and (answer.distance.numpy() == z).all())
    met, room = grid.contacts(given, 0.5), torch.zeros(9)
    fact("PyTorch's spheres have contacts of PyTorch's", all(isinstance(a, torch.Tensor) for a in vars(met).values())
         and (met.first.dtype, met.feature.dtype) == (torch.int64, torch.int32) and met.distance.tolist() == [0, 0.25])
    fact("in PyTorch's tensors", grid.contacts(given, 0.5, out={"overlap": room}).overlap.tolist() == [0.5, 0.25]
         and room[:2].tolist() == [0.5, 0.25])
    out = torch.zeros(2, 3)
    grid.query(given, out={"distance": out})
    fact("PyTorch's tensors are written", (out.numpy() == z).all())


class FakeDriver:
    """CUDA's driver where the memory of devices is the host's."""

    def __init__(self):
        self.memory, self.current, self.waited = {}, [], []

    def on(self, device):
        self.current.append(device)
        return contextlib.ExitStack()

    def wait(self, stream):
        self.waited.append(stream)

    def allocate(self, size):
        block = np.zeros(size, np.uint8)
        self.memory[block.ctypes.data] = block
        return block.ctypes.data

    def free(self, address):
        del self.memory[address]


def test_shapes():
    grid = lsdcd.Mesh(np.array([[[-9, -9, 0], [9, -9, 0], [0, 9, 0]]], float)).grid()
    turned = np.array([np.cos(np.pi / 4), 0, np.sin(np.pi / 4), 0])    # a quarter about y: the long axis is upright
    centres = np.array([[0, 0, 0.95], [1, 0, 1.9], [0, 0, 3]])
    found = grid.shape_contacts(centres, (2, 1, 1), quaternions=[[1, 0, 0, 0], 3 * turned, turned])
    fact("an ellipsoid on its side and one on its end touch a plane", np.array_equal(found.first, [0, 1, 2, 2])
         and np.allclose(found.overlap, [0.05, 0.1], rtol=0, atol=1e-14) and np.allclose(found.normal, [[0, 0, 1]] * 2)
         and np.allclose(found.point, [[0, 0, 0], [1, 0, 0]]) and np.allclose(found.of_grain, [[0, 0, -0.05], [1, 0, -0.1]])
         and found.triangle.dtype == np.uint32, found)
    far = grid.shape_distances(centres, (2, 1, 1), (2, 2), [[1, 0, 0, 0], turned, turned])
    fact("all have distances, below 0 where they touch", np.allclose(far.distance, [-0.05, -0.1, 1], rtol=0, atol=1e-14), far)
    fact("between a place of the wall and one of the grain", np.allclose(far.closest, [[0, 0, 0], [1, 0, 0], [0, 0, 0]], rtol=0, atol=1e-14) and
         np.allclose(far.of_grain, far.closest + far.distance[:, None] * [0, 0, 1], rtol=0, atol=1e-14), far)
    many, ways = np.tile(centres, (2000, 1)), np.tile([[1, 0, 0, 0], turned, turned], (2000, 1))    # more than a part of a listener
    for name, ask in (("contacts", grid.shape_contacts), ("distances", grid.shape_distances)):
        fact(f"{name} of grains are the same with a listener", ask(many, (2, 1, 1), quaternions=ways, progress=lambda what, done: None)
             == ask(many, (2, 1, 1), quaternions=ways), name)
    one = grid.shape_contacts((0, 0, 0.9), (1, 1, 1), (8, 8))
    fact("a box with rounded edges lies on its side", one.first.shape == (2,) and abs(one.overlap[0] - 0.1) < 1e-14, one)
    facts = lsdcd.shape_facts((3, 2, 1), (4, 8))
    fact("a shape has a volume and inertia", abs(facts.volume - 41.049289) < 5e-7 and abs(facts.inertia[1] - 2.925070) < 5e-7,
         facts)
    fact("a sphere meets a plane with its whole mass", lsdcd.shape_facts((2, 2, 2)).least_mass == 1, facts)
    # The plane cuts the triangle halfway up, along half its base.
    upright = lsdcd.Mesh(np.array([[[0, 0, -1], [2, 0, -1], [0, 0, 1]]], float))
    cut = lsdcd.Body(lsdcd.Mesh(np.array([[[-9, -9, 0], [9, -9, 0], [0, 9, 0]]], float)), upright).collide((1, 2, 0), segments=True)
    fact("a body's segment is where it cuts the plane", cut.segments.shape == (1, 2, 3) and
         np.allclose(sorted(cut.segments[0].tolist()), [[1, 2, 0], [2, 2, 0]], rtol=0, atol=1e-14), cut)
    refused("half-axes of two grains for three are refused", "half_axes has the shape (2, 3), not (3, 3)",
            lambda: grid.shape_contacts(centres, np.ones((2, 3))), ValueError)
    refused("quaternions of another number are refused", "quaternions has the shape (4,), not (3, 4)",
            lambda: grid.shape_contacts(centres, (1, 1, 1), quaternions=turned), ValueError)
    refused("an exponent below 2 is refused", "an exponent of a shape is 1.5", lambda: lsdcd.shape_facts((1, 1, 1), (1.5, 2)),
            lsdcd.Error)


def test_one_shape_and_one_of_each():
    """Half-axes and exponents are of all grains or of each, also the one of these and the other of those."""
    plate = lsdcd.Mesh(np.array([[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]], float), [[0, 1, 2], [0, 2, 3]]).grid()
    centres, half, exponents = [[0, 0, 0.9], [0, 0, 0.8]], (1, 1, 1), (4, 4)
    for name, ask in (("contacts", plate.shape_contacts), ("distances", plate.shape_distances)):
        each = ask(centres, [half] * 2, [(2, 2), exponents])
        fact(f"{name}: one half_axes with exponents of each", ask(centres, half, [(2, 2), exponents]) == each, each)
        each = ask(centres, [half, (1, 1, 0.95)], [exponents] * 2)
        fact(f"{name}: one exponents with half_axes of each", ask(centres, [half, (1, 1, 0.95)], exponents) == each, each)
        refused(f"{name}: exponents of others", "exponents has the shape (3, 2), not (2, 2), or (2,) for all grains",
                lambda ask=ask: ask(centres, half, [exponents] * 3), ValueError)


def test_shapes_at_walls():
    """An ellipsoid whose long axis is at 45 degrees to a plane, and a sphere beside it, each 0.01 deep."""
    plane = lsdcd.Mesh(np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], float), [[0, 1, 2], [0, 2, 3]])
    height = math.sqrt(2.5)    # of the support function
    x, still, mass = np.array([[0, 0, height - 0.01], [5, 0, 0.49]]), np.zeros((2, 3)), np.ones(2)
    shapes = {"half_axes": np.array([[2.0, 1, 1], [0, 0, 0]]), "inertia": np.array([[0.4, 1, 1], [0, 0, 0]]),
              "quaternions": np.array([[math.cos(math.pi / 8), 0, math.sin(math.pi / 8), 0], [1, 0, 0, 0]])}

    def step(wall, **more):
        force, torque = np.zeros((2, 3)), np.zeros((2, 3))
        wall.step(x, still, still, np.array([0, 0.5]), mass, force, torque, dt=1e-3, **more)
        return force, torque

    def wall_of(words):
        return lsdcd.Wall(f"hooke 1000 0 0 0 0 0 mesh $plane {words}", plane=plane)

    force, torque = step(wall_of("shapes"), **shapes)
    fact("a wall pushes an ellipsoid at its lowest point, and a sphere beside it", np.allclose(force, [[0, 0, 10]] * 2, rtol=0, atol=1e-11) and
         np.allclose(torque, [[0, -10 * 1.5 / height, 0], [0, 0, 0]], rtol=0, atol=1e-11), (force, torque))
    fact("exponents of 2 are those of an ellipsoid",
         np.array_equal(step(wall_of("shapes"), **shapes, exponents=np.full((2, 2), 2.0)), (force, torque)))
    boxes = {"half_axes": np.array([[2.0, 1, 1], [0.5, 0.6, 0.5]]), "exponents": np.array([[4.0, 6], [3, 2.5]]),
             "quaternions": np.array([[0.8, 0, 0.6, 0], [0.9, 0.3, 0.2, 0.1]]), "inertia": np.array([[0.4, 1, 1], [0.2, 0.1, 0.3]])}
    pushed = step(wall_of("shapes"), **boxes)
    for name, rows in boxes.items():
        columns = np.insert(rows, rows.shape[1], 7, axis=1)[:, :-1]
        fact(f"{name} in the first columns of a table are those of each grain",
             np.array_equal(step(wall_of("shapes"), **{**boxes, name: columns}), pushed))
    each = wall_of("shapes each_contact")
    step(each, **shapes)
    wrong = {"half_axes": np.array([[2.0, 1, 1], [-1, 1, 1]]), "quaternions": np.array([[1, 0, 0, 0]] * 2), "inertia": np.ones((2, 3))}
    refused("a wrong shape behind one that lies otherwise", "grain 1: a half-axis", lambda: step(each, **wrong), lsdcd.Error)
    found = each.contacts()
    # At 45 degrees the lowest point is (a^2 - c^2)/(2 h) beside the centre, for half-axes a and c.
    fact("contacts have the point of the plane under an ellipsoid's lowest, and its overlap, that of the last step",
         found.sphere.tolist() == [0, 1] and np.allclose(found.point, [[1.5 / height, 0, 0], [5, 0, 0]], rtol=0, atol=1e-14) and
         np.allclose(found.overlap, 0.01, rtol=0, atol=1e-14) and np.array_equal(found.force, force), found)
    refused("shapes at a wall without them", "`half_axes` to `inertia` are of a wall whose words have shapes",
            lambda: step(wall_of(""), **shapes), lsdcd.Error)
    refused("a wall of shapes whose step has none", "`half_axes` is null", lambda: step(wall_of("shapes")), lsdcd.Error)
    refused("a quaternion of 0", "quaternions[0] is 0 or no number",
            lambda: step(wall_of("shapes"), **{**shapes, "quaternions": np.zeros((2, 4))}), lsdcd.Error)
    refused("an inertia of 0", "inertia[0] is 0 0 0", lambda: step(wall_of("shapes"), **{**shapes, "inertia": np.zeros((2, 3))}), lsdcd.Error)
    refused("a half-axis below 0", "grain 0: a half-axis of a shape is -1",
            lambda: step(wall_of("shapes"), **{**shapes, "half_axes": np.array([[2.0, -1, 1], [0, 0, 0]])}), lsdcd.Error)
    refused("half-axes whose squares are 0", "grain 1: a half-axis of a shape is 1e-200",
            lambda: step(wall_of("shapes"), **{**shapes, "half_axes": np.array([[2.0, 1, 1], [1e-200] * 3])}), lsdcd.Error)
    refused("shapes with one side", "in 'side', ellipsoids have a wall with both sides alone", lambda: wall_of("shapes side out"), lsdcd.Error)


def test_device_path():
    """The way of a query to a device, whose functions answer here on the host."""
    lib, driver, opened, asked = lsdcd._lib, FakeDriver(), [], []
    real = lib.lsdcd_stream_open, lib.lsdcd_query_stream, _arrays.driver
    grid = lsdcd.Mesh([[[-9, -9, 0], [9, -9, 0], [0, 9, 0]]]).grid(cutoff=2)

    def answer(stream, query):
        asked.append(query)
        return lib.lsdcd_query_host(grid._handle, query)

    lib.lsdcd_stream_open = lambda grid, handle, made: opened.append(handle) or 0
    lib.lsdcd_query_stream, _arrays.driver = answer, lambda: driver
    try:
        rows = np.array([[0, 0, 0.5, 1], [0, 1, 1.5, 1]], np.float32)
        there = OnCuda((2, 3), strides=(16, 4), stream=7)
        there.__cuda_array_interface__["data"] = (rows.ctypes.data, True)
        answer = grid.query(there, "distance closest triangle")
        fact("answers of no library's points are a device's arrays", isinstance(answer.distance, _arrays.DeviceArray)
             and answer.closest.__dlpack_device__() == (2, 3) and answer.closest.__cuda_array_interface__["shape"] == (2, 3))
        numbers = _arrays.Array(None, answer.distance.address, (2,), None, np.dtype("f4")).host()
        fact("they are there", numbers.tolist() == [0.5, 1.5], numbers)
        fact("the stream is the array's, on its device, and is waited for", (opened, set(driver.current), driver.waited)
             == ([7], {3}, [7]), (opened, driver.current, driver.waited))
        radii = OnCuda((2,), strides=(16,))
        radii.__cuda_array_interface__["data"] = (rows.ctypes.data + 12, True)
        out = OnCuda((2,))
        found = np.zeros(2, np.float32)
        out.__cuda_array_interface__["data"] = (found.ctypes.data, False)
        fact("answers go to the caller's", grid.query(there, radius=radii, out={"distance": out}).distance is out
             and found.tolist() == [0.5, np.inf])
        for stream in range(20, 40):
            grid.query(there, stream=stream)
        fact("a grid keeps eight streams", len(opened) == 21 and len(grid._streams.__dict__) == 8, opened)
        grid.query(there, stream=39)
        fact("and opens none twice", len(opened) == 21)
        calls = len(asked)
        fact("no points ask nothing", grid.query(OnCuda((0, 3))).distance.shape == (0,) and len(asked) == calls)
        del answer, out
        gc.collect()
        fact("arrays of a device are freed", not driver.memory)
    finally:
        lib.lsdcd_stream_open, lib.lsdcd_query_stream, _arrays.driver = real


def write_floor(name):
    """A triangle at z = 0."""
    pathlib.Path(name).write_text("solid f\nfacet normal 0 0 1\nouter loop\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\n"
                                  "endloop\nendfacet\nendsolid f\n", encoding="ascii")


TRIANGLE = lsdcd.Mesh(np.array([[[-9.0, -9, 0], [9, -9, 0], [0, 9, 0]]]))
SQUARE = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], float)
FLOOR = lsdcd.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
HOOKE = "hooke/history 1000 300 20 NULL 0.5 1"
# Two spheres that touch a floor at z = 0.
X, RADIUS, MASS = np.array([[0.3, 0.2, 0.49], [1.5, -1, 0.48]]), np.full(2, 0.5), np.ones(2)
V, OMEGA = np.full((2, 3), 0.25), np.full((2, 3), 0.5)


def on_floor(law="hooke 1000 0 0 0 0 0", **more):
    """A wall of a triangle at z = 0."""
    return lsdcd.Wall(f"{law} mesh $floor", floor=TRIANGLE, **more)


def forces(wall, steps=5, **more):
    """What it adds to forces and torques of the two spheres in so many steps."""
    force, torque = np.zeros((2, 3)), np.zeros((2, 3))
    for _ in range(steps):
        wall.step(X, V, OMEGA, RADIUS, MASS, force, torque, dt=1e-3, **more)
    return np.concatenate([force, torque])


class Processes:
    """Two processes, threads here: what lsdcd.Host asks of one."""
    size = 2

    def __init__(self, rank, meeting, brought):
        self.rank, self.meeting, self.brought = rank, meeting, brought

    FORMATS = set()    # of the buffers; mpi4py 3 knows no "<d", as ctypes has it

    def meet(self, values):
        self.FORMATS.add(memoryview(values).format)
        self.brought[self.rank] = values.copy()
        self.meeting.wait()
        all_of = [values.copy() for values in self.brought]
        self.meeting.wait()    # nobody brings the next before all have read
        return all_of

    def sum(self, numbers):
        numbers[:] = sum(self.meet(numbers))

    def max(self, numbers):
        numbers[:] = np.maximum(*self.meet(numbers))

    def broadcast(self, data, source):
        data[:] = self.meet(data)[source]


def check_copied_arrays(wall, given):
    """What is not contiguous float64 is copied, and forces come to where they are asked for: 0.51 - 0.5 of overlap at z 0.49."""
    rows = np.zeros((2, 4, 3), np.float32)
    rows[0, 0, 2] = 0.484375    # exact in float32: the overlap is 0.015625
    force, torque = rows[1, :1], np.zeros((1, 6))[:, ::2]
    force[:] = 0.5
    wall.step(**{**given, "x": rows[0, :1], "v": np.zeros((1, 6))[:, ::2], "radius": np.full(2, 0.5)[::2], "mass": np.ones(1, int),
                 "force": force, "torque": torque})
    fact("columns and float32 are copied, and forces are added", (rows[1, 0] == (0.5, 0.5, 0.5 + 15.625)).all(), rows[1, 0])
    x = np.array([[0, 0, 0.49]])
    wall.step(**{**given, "x": x})
    x.resize((2, 3))
    fact("arrays of the last step can be resized", x.shape == (2, 3))


def test_meshes_of_walls():
    """A mesh has arrays, a wall's meshes have names, and `with` closes."""
    class Others:    # as trimesh has meshes
        vertices, faces = SQUARE, np.array([[0, 1, 2], [0, 2, 3]])

    taken = lsdcd.Mesh(Others())
    fact("a mesh is made of what has vertices and faces", (taken.vertices == FLOOR.vertices).all() and (taken.faces == FLOOR.faces).all())
    fact("vertices and faces are those of the welded mesh", FLOOR.vertices.shape == (4, 3) and FLOOR.faces.tolist() == [[0, 1, 2], [0, 2, 3]])
    fact("a mesh made of a mesh is the same", (lsdcd.Mesh(FLOOR).vertices == FLOOR.vertices).all())

    with lsdcd.Wall("hooke 1000 0 0 NULL 0 0 mesh $floor mesh $lid move 0 0 1 motion caller", floor=FLOOR, lid=FLOOR) as wall:
        wall.set_pose("lid", position=(0, 0, 2))
        wall.step(np.array([[0, 0, 0.49]]), np.zeros((1, 3)), np.zeros((1, 3)), np.full(1, 0.5), np.ones(1), np.zeros((1, 3)),
                  np.zeros((1, 3)), 1e-3)
        fact("meshes go by their names", (wall.pose("lid") == wall.pose(1)).all() and wall.pose("lid")[2, 3] == 2 and
             wall.totals("floor").contacts == 1 and wall.totals("lid").contacts == 0)
        refused("a name that there is not", "mesh is 'cover': no mesh is called 'cover': those are floor, lid",
                lambda: wall.pose("cover"), ValueError)
    refused("a wall after `with`", "this Wall is closed", lambda: wall.totals(), lsdcd.Error)
    with lsdcd.Mesh(SQUARE, [[0, 1, 2]]) as closed:
        pass
    refused("a mesh that has been closed", "floor: its Mesh has been closed", lambda: lsdcd.Wall(f"{HOOKE} mesh $floor", floor=closed), ValueError)


def test_processes():
    """A sphere that slides on a floor at z = 0 goes to another process; the wall of each is in a thread."""
    slides = "hooke/history 1000 300 0 0 0.5 0"
    dt, speed, packed, told = 1e-3, 0.1, [], [None, None]
    meeting, brought = threading.Barrier(2), [None, None]

    def work(rank):
        wall = on_floor(slides, host=Processes(rank, meeting, brought))

        def step(n):
            x, v = np.tile([0.0, 1, 0.49], (n, 1)), np.tile([speed, 0, 0], (n, 1))
            force, torque = np.zeros((n, 3)), np.zeros((n, 3))
            wall.step(x, v, np.zeros((n, 3)), np.full(n, 0.5), np.ones(n), force, torque, dt)
            return force

        for _ in range(10):
            step(1 - rank)
        if rank == 0:
            packed.append(wall.pack([0]))
            wall.renumber([])
        meeting.wait()
        if rank == 1:
            wall.renumber([-1])
            wall.unpack([0], packed[0])
        force = step(rank)
        told[rank] = force, wall.totals()

    def work_or_end(rank):
        try:
            work(rank)
        except BaseException:
            meeting.abort()    # the other one would wait for ever
            raise

    threads = [threading.Thread(target=work_or_end, args=(rank,)) for rank in (0, 1)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    # Sums of a few numbers of order one: some roundings.
    fact("both processes end", None not in told, told)
    fact("what a contact keeps goes to another process",
         abs(told[1][0][0, 0] + 300 * 11 * speed * dt) < 1e-12, told)
    fact("totals are those of all processes",
         all(abs(t.force[2] + 10) < 1e-11 and t.contacts == 1 for _, t in told), told)

    class Breaks(Processes):
        def max(self, numbers):
            raise KeyError("no network")

    for no_host in (0, [], "x", np.zeros(2), object()):
        refused(f"{no_host!r} is no host", "without rank", lambda: on_floor(slides, host=no_host), TypeError)
    fact("a host's arrays have native types", Processes.FORMATS == {"d", "B"}, Processes.FORMATS)
    refused("what a host raises is raised", "no network", lambda: on_floor(slides, host=Breaks(0, None, None)), KeyError)


def test_walls():
    """A pose and totals in closed form, and what is refused. test_wall_against_lammps.py has walls against those of scripts."""
    def wall_of(words=""):
        return lsdcd.Wall(f"{HOOKE} mesh $floor {words}", floor=FLOOR)

    each = wall_of("device auto each_contact")
    fact("a wall that chooses where it computes, and keeps its contacts, has the bits of one that does not",
         forces(each).tobytes() == forces(wall_of()).tobytes())
    last, found = forces(each, 1)[:2], each.contacts()
    # Overlaps are differences of numbers of order one, and forces kn = 1000 times as much.
    fact("contacts have the places, overlaps and forces of the spheres", found.sphere.tolist() == [0, 1] and
         found.mesh.tolist() == [0, 0] and np.allclose(found.point, X * [1, 1, 0], rtol=0, atol=1e-15) and
         np.allclose(found.overlap, 0.5 - X[:, 2], rtol=0, atol=1e-15) and
         np.allclose(found.force, last, rtol=0, atol=1e-12), found)
    refused("contacts that a wall does not keep", "say each_contact when", wall_of().contacts, lsdcd.Error)
    hit = wall_of("impacts 0.1")
    high, down = np.array([[0.3, 0.2, 0.5005], [1.5, -1, 0.5005]]), np.array([[0, 0, -1.0], [0, 0, -2.0]])
    for k in range(2):
        hit.step(high + k * down * 1e-3, down, OMEGA * 0, RADIUS, MASS, *np.zeros((2, 2, 3)), dt=1e-3)
    bins, totals = hit.impacts(), hit.totals()
    fact("two impacts of m v^2/2 are in their bins", bins.impacts[[0, -1]].tolist() == [1, 1] and bins.impacts.sum() == 2 and
         np.allclose(bins.energy[[0, -1]], [0.5, 2], rtol=1e-12, atol=0) and (totals.impacts, round(totals.impact_energy, 11)) == (2, 2.5) and
         bins.begins[0] <= 0.5 < bins.ends[0] and bins.begins[-1] <= 2 < bins.ends[-1] and np.array_equal(bins.ends[:-1], bins.begins[1:]), bins)
    refused("impacts that a wall does not record", "say impacts V when", each.impacts, lsdcd.Error)
    rubs = "granular hooke 1000 20 tangential linear_history 500 1 0.4 damping mass_velocity heat radius 0 mesh $floor temperature 0"
    taken, lost = np.zeros(2), []
    for share in (0.25, 0):
        warm = lsdcd.Wall(f"{rubs} surface_vel 0.7 0 0 energy friction_heat {share}", floor=FLOOR)
        for k in range(200):
            heat = np.zeros(2)
            warm.step(X, V * 0, OMEGA * 0, RADIUS, MASS, *np.zeros((2, 2, 3)), dt=1e-3, temperature=np.full(2, 300.0), heat=heat)
            taken, lost = taken + 1e-3 * heat, warm.totals().dissipated
        press = 1000 * (0.5 - X[:, 2])
        fact(f"a share {share} of the power of friction, mu F v, is heat of the spheres",
             np.allclose(heat, share * 0.4 * press * 0.7, rtol=1e-12, atol=0), heat)
        if share:
            fact("and of its work in all", abs(taken.sum() - share * lost[1]) < 1e-12 * lost[1], (taken, lost))
    refused("heat of friction without books", "give the wall energy", lambda: lsdcd.Wall(f"{rubs} friction_heat 0.5", floor=FLOOR), lsdcd.Error)
    body = wall_of("body mass 1 com 0 0 0 inertia 1 1 1 0 0 0")
    refused("a body takes no pose", "a body moves by what acts on it", lambda: body.set_pose(0), lsdcd.Error)
    saved = wall_of().save()
    other = lsdcd.Wall("hooke/history 2000 300 20 NULL 0.5 1 mesh $floor", floor=FLOOR)
    refused("data of a wall with another law are refused", "the law is hooke/history with 2000 ", lambda: other.restore(saved),
            lsdcd.Error)
    other.restore(saved, what_fits=True)
    falls = wall_of("""body mass 2 com 0 0 0 inertia 1 1 2 0 0 0 joint slider 0 0 1 load 0 0 -3
                       limits -1 1 velocity 0 0 0.5""")
    forces(falls, 10)
    state = falls.body(0)
    fact("a body is asked for", state.centre.shape == (3,) and state.quaternion.tolist() == [1, 0, 0, 0] and
         state.velocity[2] < 0.5 and state.coordinate == state.centre[2] and state.energy > 0, state)
    falls.change("body joint ball 0 0 0 load 0 0 0")
    held = falls.body(0)
    fact("a body takes another joint where it is", held.velocity.tolist() == [0, 0, 0] and held.coordinate == 0 and
         (held.centre == state.centre).all(), held)
    falls.change("body joint slider 0 0 1 load 0 0 400")
    forces(falls, 1)
    fact("and another load", falls.body(0).velocity[2] > 0, falls.body(0))
    posed = wall_of("motion caller")
    posed.set_pose(0, position=(0, 0, 0.01), velocity=(0, 0, 0.5))
    force = forces(posed, 1)
    wanted = np.array([1000 * 0.02 + 20 * 0.25, 1000 * 0.03 + 20 * 0.25])    # kn overlap + gamman m v
    fact("a plate that is posed has the force in closed form", np.allclose(force[:2, 2], wanted, rtol=0, atol=1e-10), force)
    fact("and the pose", posed.pose(0)[2, 3] == 0.01, posed.pose(0))
    about = np.array([3, -2, 1])
    total, torque = posed.totals(about=about), (np.cross(X - about, force[:2]) + force[2:]).sum(axis=0)
    fact("force and torque are those of the spheres reversed", np.allclose(total.force, -force[:2].sum(axis=0), rtol=0, atol=1e-10) and
         np.allclose(total.torque, -torque, rtol=0, atol=1e-9), (total, torque))
    fact("it stays there, with its velocities", np.allclose(forces(posed, 1)[:2, 2], wanted, rtol=0, atol=1e-10))
    # The plane in two meshes that meet at x = 1, with a sphere on each.
    parts = [lsdcd.Mesh(np.clip(SQUARE, (lo, -5, 0), (hi, 5, 0)), [[0, 1, 2], [0, 2, 3]]) for lo, hi in ((-5, 1), (1, 5))]
    split = lsdcd.Wall(f"{HOOKE} mesh $left mesh $right", left=parts[0], right=parts[1])
    force = forces(split, 1)
    torque = np.cross(X - about, force[:2]) + force[2:]
    of_each, of_all = [split.totals(k, about=about) for k in (0, 1)], split.totals(about=about)
    fact("force and torque of one mesh are those of its sphere", all(
        t.contacts == 1 and np.allclose(t.force, -force[k], rtol=0, atol=1e-10) and np.allclose(t.torque, -torque[k], rtol=0, atol=1e-9)
        for k, t in enumerate(of_each)), (of_each, torque))
    fact("those of all are the sums", of_all.contacts == 2 and
         np.allclose(of_all.force, of_each[0].force + of_each[1].force, rtol=0, atol=1e-10) and
         np.allclose(of_all.torque, of_each[0].torque + of_each[1].torque, rtol=0, atol=1e-9), (of_all, of_each))

    lifted = wall_of("nodes caller")
    nodes = lifted.nodes(0)
    speed = np.zeros_like(nodes)
    speed[:, 2] = 0.5
    lifted.set_nodes(0, nodes + (0, 0, 0.01), speed)
    force = forces(lifted, 1)
    fact("a plate whose nodes are lifted has the force of one that is posed", np.allclose(force[:2, 2], wanted, rtol=0, atol=1e-10),
         force)
    fact("its nodes have the forces of the spheres", np.allclose(lifted.node_forces(0).sum(axis=0), -force[:2].sum(axis=0), rtol=0,
                                                                 atol=1e-10), lifted.node_forces(0))

    wears = wall_of("wear archard 1e-3 1 deform every 3 factor 2")
    forces(wears, 2)
    worn = wears.totals().worn_volume
    forces(wears, 1)
    total, sunk = wears.totals(), wears.nodes(0) - SQUARE
    # Both triangles have the area 50: the volume between is that times the mean of their corners.
    between = -50 / 3 * sum(sunk[[0, 1, 2, 0, 2, 3], 2])
    fact("wear moves the vertices by the factor times what has worn", worn > 0 and total.held_back_volume == 0 and
         abs(total.removed_volume - 2 * worn) < 1e-12 * worn and abs(between - 2 * worn) < 1e-11 * worn and not sunk[:, :2].any(),
         (worn, total.removed_volume, between))

    for says, call, kind in (
            ("in 'scale', the factor must not be zero", lambda: wall_of("scale 0"), lsdcd.Error),
            ("the z factor (give one factor or three) is missing", lambda: wall_of("scale 1 2"), lsdcd.Error),
            ("quaternion has the length 2", lambda: posed.set_pose(0, quaternion=(2, 0, 0, 0)), lsdcd.Error),
            ("position has the shape (2,), not (3,)", lambda: posed.set_pose(0, position=(0, 0)), ValueError),
            ("positions has the shape (1, 3)", lambda: lifted.set_nodes(0, [[0, 0, 0]]), ValueError),
            ("has no nodes that move", lambda: posed.nodes(0), lsdcd.Error)):
        refused(f"refused: {says}", says, call, kind)


def write_glass(folder):
    materials = folder / "some.lsdcd"
    materials.write_text("units si\nmaterial glass\nyoungs_modulus 5e4 Pa # Müller\npoissons_ratio 0.23 1\npair glass glass\n"
                         "restitution 0.9 1\nsliding_friction 0.1 1\n", encoding="latin-1")
    return materials


def test_materials(folder):
    """Numbers of a file of materials, beside the same ones in words."""
    materials, log = write_glass(folder), []

    def of_glass(words, **more):
        return lsdcd.Wall(f"granular material $file {words} mesh $floor", file=materials, floor=FLOOR, **more)

    def of_numbers(words):
        return lsdcd.Wall(f"granular {words} mesh $floor", floor=FLOOR)

    same = of_numbers("hertz/material 5e4 0.9 0.23 tangential mindlin NULL 1 0.1 damping coeff_restitution")
    glass = of_glass("glass", show=lambda text, warning: log.append(text))
    fact("materials have the bits of their numbers", forces(glass).tobytes() == forces(same).tobytes())
    fact("the log tells them", "restitution 0.9 (some.lsdcd line 6)" in "".join(log), log)
    fact("and a source that is no UTF-8, by its byte", "some.lsdcd line 3): M\\xfcller" in "".join(log), log)
    rough = of_glass("glass with restitution 0.5 glass youngs_modulus 1e4 tangential mindlin NULL 0.5 NULL damping tsuji")
    same = of_numbers("hertz/material 1e4 0.5 0.23 tangential mindlin NULL 0.5 0.1 damping tsuji")
    fact("with other sub-models and numbers", forces(rough).tobytes() == forces(same).tobytes())
    for says, words in (("'iron' is not a material of", "iron"), ("restitution = 2 is out of range", "glass with restitution 2"),
                        ("restitution must be a number, not 'a'", "glass with restitution a")):
        refused(says, says, lambda words=words: of_glass(words), lsdcd.Error)
    refused("a stiffness is no number of a material", "the normal model 'hooke' does not take material constants",
            lambda: lsdcd.Wall("granular hooke material $file glass mesh $floor", file=materials, floor=FLOOR), lsdcd.Error)


def test_sub_models():
    """The formulas of contact laws, with their numbers."""
    rows = {(row.family, row.name): row for row in lsdcd.sub_models()}
    fact("sub-models are listed", {("style", "hooke/history"), ("normal", "hertz"), ("tangential", "mindlin"), ("rolling", "cdt")} <= rows.keys(), rows)
    mindlin = rows["tangential", "mindlin"]
    fact("with their numbers, which NULL may stand for", mindlin.numbers == ("kt", "xgammat", "mu") and mindlin.may_be_derived[0] and
         mindlin.units[0] == "force/length^2" and mindlin.ranges[2][0] == 0 and not mindlin.beside_style, mindlin)


def test_wall_arrays():
    """Arrays of spheres of other libraries, and what a wall refuses of them."""
    wall = on_floor()
    given = {name: np.zeros((1, 3)) for name in ("x", "v", "omega", "force", "torque")}
    given |= {"radius": np.full(1, 0.5), "mass": np.ones(1), "dt": 1e-3}
    given["x"][0, 2] = 0.49
    wall.step(**{k: OnlyDlpack(v) if k != "dt" else v for k, v in given.items()})
    fact("a wall's arrays come by DLPack", abs(given["force"][0, 2] - 10) < 1e-11, given["force"])
    refused("an array on a device is refused", "on CUDA device 3, and the wall was made for arrays on the host",
            lambda: wall.step(**{**given, "x": OnCuda((1, 3), "<f8")}))
    refused("types in float64 are refused", "is not a contiguous ", lambda: wall.step(**given, type=np.ones(1)))
    check_copied_arrays(wall, given)
    fixed = np.zeros((1, 3))
    fixed.flags.writeable = False
    refused("a force that cannot be written is refused", "cannot be written", lambda: wall.step(**{**given, "force": fixed}),
            ValueError)
    for written, other in (("force", "torque"), ("force", "x"), ("torque", "omega"), ("torque", "v")):
        refused(f"{written} that is {other}, too, is refused", f"`{written}` and `{other}` share memory",
                lambda written=written, other=other: wall.step(**{**given, written: given[other]}), lsdcd.Error)
    single = np.zeros((1, 3), np.float32)    # which is copied
    for written, other in (("force", "torque"), ("force", "x"), ("torque", "v")):
        refused(f"{written} in float32 that is {other}, too, is refused", f"{written} shares memory with {other}",
                lambda written=written, other=other: wall.step(**{**given, written: single, other: single}), ValueError)
    check_memory_of_shapes()
    both = np.zeros(8)
    many = {k: np.repeat(v, 2, axis=0) if k != "dt" else v for k, v in given.items()}
    for name, kind in (("mass", 1), ("torque", 3)):
        at = both[6:8] if kind == 1 else both[2:8].reshape(2, 3)
        at[...] = 1
        shared = on_floor()
        if kind == 1:
            shared.step(**{**many, name: at, "force": both[:6].reshape(2, 3)})
            fact("arrays side by side in one are taken", abs(both[2] - 10) < 1e-11, both)
        refused(f"a force of which a part is {name} is refused", f"and `{name}` share memory",
                lambda: shared.step(**{**many, name: at, "force": both[1:7].reshape(2, 3)}), lsdcd.Error)
    wide = np.zeros((2, 6))
    on_floor().step(**{**many, "force": wide[:, :3], "torque": wide[:, 3:]})
    fact("columns side by side in one array are taken", abs(wide[0, 2] - 10) < 1e-11, wide)
    refused("columns that overlap are refused", "force shares memory with torque",
            lambda: on_floor().step(**{**many, "force": wide[:, :3], "torque": wide[:, 2:5]}), ValueError)
    refused("one row for all forces is refused", "force has the strides (0, 8)",
            lambda: on_floor().step(**{**many, "force": np.lib.stride_tricks.as_strided(both, (2, 3), (0, 8))}), ValueError)
    for strides in ((8, 8), (16, 8), (32, 16), (-8, 8), (20, 8)):
        rows = np.lib.stride_tricks.as_strided(np.zeros(12)[2:], (2, 3), strides)
        refused(f"rows of forces that overlap by {strides} are refused", "numbers share memory",
                lambda rows=rows: on_floor().step(**{**many, "force": rows}), ValueError)
    refused("a radius up to which nothing is found is refused", "is 1e+60, beyond 1e+36",
            lambda: on_floor().step(**{**given, "radius": np.full(1, 1e60)}), lsdcd.Error)
    large = {**given, "force": np.zeros((1, 3)), "radius": np.full(1, 1e30)}
    on_floor().step(**large)
    fact("the largest radii have their force", large["force"][0, 2] == 1e3 * 1e30, large["force"])
    if not lsdcd._lib.lsdcd_has_cuda():
        refused("a wall on a device needs one", "use LSDCD_CPU", lambda: on_floor(device="cuda"), lsdcd.Error)
    refused("a stream needs a device", "stream is given", lambda: on_floor(stream=7), lsdcd.Error)


def test_closed_in_a_callback():
    """What a call uses is not freed before it has returned."""
    says = "as a call of it has not returned"
    floor = np.array([[-9.0, -9, 0], [9, -9, 0], [0, 9, 0]])
    mesh = lsdcd.Mesh(floor, [[0, 1, 2]])
    points = np.random.default_rng(1).random((20000, 3))

    def closing(thing):
        return lambda what, done: thing.close()

    grid = mesh.grid(cutoff=1)
    for name, thing, call in (
            ("a grid in its query", grid, lambda told: grid.query(points, progress=told)),
            ("a grid in its search of contacts", grid, lambda told: grid.contacts(points, 1, progress=told)),
            ("a grid in its search of contacts of grains", grid, lambda told: grid.shape_contacts(points[:99], (1, 1, 1), progress=told)),
            ("a grid in its distances of grains", grid, lambda told: grid.shape_distances(points[:99], (1, 1, 1), progress=told)),
            ("a mesh that a grid is made of", mesh, lambda told: mesh.grid(cutoff=1, cell=0.5, progress=told)),
            ("a mesh that a body is made of", mesh, lambda told: lsdcd.Body(mesh, lsdcd.Mesh(floor, [[0, 1, 2]]), progress=told))):
        refused(f"{name} is not closed", says, lambda thing=thing, call=call: call(closing(thing)), lsdcd.Error)
        fact("and goes on", bool(thing._handle))
    fact("its answers are those of before", np.allclose(grid.query(points).distance, points[:, 2], rtol=0, atol=1e-15))
    for name, act in (("a wall in `show` is not closed", lambda: wall.close()), ("and makes no step there", lambda: wall.totals())):
        acts = []
        wall = lsdcd.Wall("hooke 1e3 0 0 0 0 0 mesh $floor", lo=(-1, -1, -1), hi=(1, 1, 1), show=lambda text, warning: [act() for act in acts],
                          floor=mesh)
        acts.append(act)
        spheres = [np.zeros((1, 3)) for _ in range(5)]
        spheres[0][0] = (0, 0, 9)    # outside of the box, which is warned of
        refused(name, "has not returned", lambda: wall.step(*spheres[:3], np.ones(1), np.ones(1), *spheres[3:], 1e-3), lsdcd.Error)
        acts.clear()
        fact("and is closed behind that", wall.close() is None and not wall._handle)
    grid.close()
    refused("a closed grid answers no more", "this Grid is closed", lambda: grid.query(points), lsdcd.Error)


def check_memory_of_shapes():
    """Forces are not added into what makes the grains."""
    for name, written, start in (("half_axes", "force", 0), ("inertia", "torque", 0), ("exponents", "force", 1), ("quaternions", "force", 1)):
        wall = lsdcd.Wall("hooke 2e3 0 0 0 0 0 mesh $floor shapes", floor=FLOOR)
        given = {key: np.zeros((3, 3)) for key in ("x", "v", "omega", "force", "torque")}
        given |= {"radius": np.ones(3), "mass": np.ones(3), "half_axes": np.full((3, 3), 0.5), "inertia": np.full((3, 3), 0.1),
                  "exponents": np.full((3, 2), 2.0), "quaternions": np.tile([1.0, 0, 0, 0], (3, 1))}
        given["x"][:, 2] = 0.45
        wall.step(**given, dt=1e-3)
        memory = np.zeros(12)
        before = given[name]
        given[name] = memory[:before.size].reshape(before.shape)
        given[name][...] = before
        given[written] = memory[start:start + 9].reshape(3, 3)
        refused(f"{written} in {name} is refused", f"`{written}` and `{name}` share memory", lambda: wall.step(**given, dt=1e-3), lsdcd.Error)
        fact(f"{name} stay", (given[name] == before).all(), given[name])


def test_given_values():
    """What is no number, no whole number or no text of C is refused, and never read as another one."""
    triangle = np.array([[[-9.0, -9, 0], [9, -9, 0], [0, 9, 0]]])
    vertices, faces, points = triangle[0], np.array([[0, 1, 2]]), np.array([[0, 0, 0.5]])
    mesh = lsdcd.Mesh(triangle)
    grid, near = mesh.grid(), mesh.grid(cutoff=2)
    body = lsdcd.Body(mesh, mesh)
    takers = {"points": grid.query, "centres": lambda given: near.contacts(given, 1.0), "triangles": lsdcd.Mesh,
              "vertices": lambda given: lsdcd.Mesh(given, faces), "faces": lambda given: lsdcd.Mesh(vertices, given),
              "radius": lambda given: grid.query(points, radius=given), "radii": lambda given: near.contacts(points, given),
              "position": lambda given: body.collide(position=given)}
    right = {"points": points, "centres": points, "triangles": triangle, "vertices": vertices, "faces": faces,
             "radius": np.array([1.0]), "radii": np.array([1.0]), "position": np.zeros(3)}
    for name, columns in (("half_axes", 3), ("exponents", 2), ("quaternions", 4)):
        right[name] = np.full((1, columns), 2.0)
        takers[name] = lambda given, name=name: grid.shape_distances(points, **{"half_axes": (2, 2, 2), name: given})
    takers |= {"centres of shapes": lambda given: grid.shape_contacts(given, (1, 1, 1)), "the shape": lambda given: lsdcd.shape_facts(given)}
    right |= {"centres of shapes": points, "the shape": np.ones(3)}
    for name, take in takers.items():
        take(right[name])
        take(np.ma.array(right[name], mask=False))
        for kind in (complex, bool, str):
            refused(f"{name} of {kind.__name__} are refused", "numbers", lambda: take(right[name].astype(kind)))
        refused(f"{name} with a mask are refused", "has masked values: fill them in",
                lambda: take(np.ma.array(right[name], mask=True)))
    refused("objects that are texts are refused", "object, not real", lambda: grid.query(points.astype(str).astype(object)))
    fact("objects that are numbers are taken", grid.query(points.astype(object)).distance.tolist() == [0.5])

    for name, take in (("query", lambda n: grid.query(points, threads=n)), ("grid", lambda n: mesh.grid(threads=n)),
                       ("contacts", lambda n: near.contacts(points, 1.0, threads=n)),
                       ("body", lambda n: lsdcd.Body(mesh, mesh, threads=n)),
                       ("collide", lambda n: body.collide((0, 0, 1), threads=n))):
        refused(f"{name}: 2**40 threads are refused", f"threads is {2**40}", lambda: take(2**40), ValueError)
        refused(f"{name}: half a thread is refused", "not a whole number", lambda: take(1.5))
        take(np.int64(1))
    refused("a mesh's number is not cut off", "mesh is", lambda: on_floor().totals(2**32), ValueError)
    for name, take in (("a file", lambda: lsdcd.Mesh("floor.stl\0x")), ("a cache", lambda: mesh.grid(cutoff=1, cache="a\0b"))):
        refused(f"a NUL in {name} is refused", "has a NUL", take, ValueError)

    wall = on_floor()
    given = {name: np.zeros((2, 3)) for name in ("v", "omega", "force", "torque")}
    given |= {"x": np.full((2, 3), 0.4), "radius": np.full(2, 0.5), "mass": np.ones(2), "dt": 1e-3}
    wall.step(**given)
    for source in ([0.2, 1], [True, False], ["0", "1"], np.ma.array([0, 1], mask=[0, 1])):
        refused(f"renumber {source} is refused", "", lambda: wall.renumber(source))
        refused(f"pack {source} is refused", "", lambda: wall.pack(source))
    refused("renumber takes one row", "has the shape (1, 2)", lambda: wall.renumber([[0, 1]]), ValueError)
    wall.renumber([1, 0])
    wall.step(**given)
    wall.renumber([])
    fact("answers are the same value by value", grid.query([[0, 0, 1.0], [0, 0, 2]], "closest distance")
         == grid.query([[0, 0, 1.0], [0, 0, 2]], "distance closest"))
    fact("and not where one differs", grid.query([[0, 0, 1.0], [0, 0, 2]]) != grid.query([[0, 0, 1.0], [0, 0, 3]]))
    fact("totals too", wall.totals() == wall.totals())


def test_values_that_c_reads_otherwise():
    """Numbers that stand for something else in C, texts as truth, and None as a number."""
    mesh = lsdcd.Mesh(np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float), [[0, 1, 2], [0, 2, 3]])
    refused("refused: cutoff is 0", "cutoff is 0", lambda: mesh.grid(cutoff=0), ValueError)
    body = lsdcd.Body(mesh, mesh)
    for name, call in (
            ("estimate_sides", lambda no: mesh.grid().query([0, 0, 1], estimate_sides=no)),
            ("segments", lambda no: body.collide((0, 0, 1), segments=no))):
        refused(f"{name} is no text", f"{name} is 'no', not True or False", lambda: call("no"))
        call(np.False_)
        call(0)
    refused("None is no coordinate", "not real numbers", lambda: mesh.grid().query([[None, 0, 0], [0, 0, 1]]))

    # One buffer for two motions, at 1 and 2: after 0.1 the meshes are at 0.1 and 0.2.
    rows, none = np.array([[0, 0, 0, 0], [1, 0, 0, 1.0]]), np.zeros((0, 3))
    moved = lsdcd.Wall("hooke/history 1e4 1 20 7 0.5 1 mesh $first motion table $rows linear mesh $second move 0 0 9",
                       first=mesh, second=mesh, rows=rows)
    rows[1] = 1, 0, 0, 2
    moved.change("mesh second motion table $rows linear", rows=rows)
    for _ in range(10):
        moved.step(none, none, none, np.zeros(0), np.zeros(0), none.copy(), none.copy(), 0.01)
    fact("a table of motion is a copy of its rows", abs(moved.pose(0)[2, 3] - 0.1) < 1e-14 and abs(moved.pose(1)[2, 3] - 0.2) < 1e-14,
         (moved.pose(0), moved.pose(1)))


def test_walls_are_freed():
    """What calls a program's functions does not keep a wall alive."""
    class Host:
        rank, size = 0, 1
        sum = max = staticmethod(lambda numbers: None)
        broadcast = staticmethod(lambda data, source: None)

    gc.collect()
    gc.disable()
    try:
        for words in ({}, {"show": lambda text, warning: None}, {"host": Host()}):
            wall = on_floor(**words)
            wall.totals()
            alive = weakref.ref(wall)
            del wall
            fact(f"a wall with {list(words) or 'nothing'} is freed with its name", alive() is None)
    finally:
        gc.enable()


def test_what_begins_wrongly():
    """Before anything is made: limits, tables, threads, the library itself."""
    def made(words, **values):
        return lsdcd.Wall(f"hooke 1e4 0 0 0 0 0 mesh $floor {words}", floor=FLOOR, **values)

    body, none, zero = "body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint slider 0 0 1 limits", np.zeros((0, 3)), np.zeros(0)
    for limits in ("1 2", "-2 -1"):
        says = f"in 'body', the limits {limits} do not contain 0, which is where the body begins"
        refused(f"limits {limits} do not hold where the body begins", says, lambda: made(f"{body} {limits}"), lsdcd.Error)
        refused("the check says so, too", says, lambda: lsdcd.Wall.check(f"hooke 1e4 0 0 0 0 0 mesh $floor {body} {limits}", floor=FLOOR), lsdcd.Error)
    wall = made(f"{body} -1 1")
    wall.change("body limits 1 2")    # for a state whose body is there
    refused("a body cannot begin outside of them", "the limits 1 2 do not contain 0", lambda: wall.step(
        none, none, none, zero, zero, none.copy(), none.copy(), 1e-3), lsdcd.Error)
    wall.change("body limits -1 1")
    wall.step(none, none, none, zero, zero, none.copy(), none.copy(), 1e-3)
    fact("and the wall goes on", wall.body(0).coordinate == 0)
    for name, what in (("/dev/zero", "a device"), ("/", "a directory")):
        refused(f"a table {name} is no file", f"it is {what}; give the path of a file of text",
                lambda: made("motion table $file", file=name), lsdcd.Error)

    def says(code, **environment):
        return subprocess.run([sys.executable, "-c", code], env={**os.environ, **environment}, text=True, capture_output=True).stderr

    told = says("import lsdcd; lsdcd.Mesh([[[0, 0, 0], [1, 0, 0], [0, 1, 0.]]]).grid().query([[0, 0, 1]])", OMP_NUM_THREADS="99999")
    fact("99 999 threads are refused", "lsdcd.Error: OMP_NUM_THREADS asks for 99999 threads; it is 4096 at most" in told, told)
    told = says("import lsdcd", LSDCD_LIBRARY="/nowhere/liblsdcd.so.0")
    fact("an import without the library says what to do", "ImportError: lsdcd's shared library cannot be loaded" in told
         and "/nowhere/liblsdcd.so.0" in told and "LSDCD_LIBRARY" in told, told)


def missing_mesh(name):
    """Raises Error; in a process of its own, too."""
    lsdcd.Mesh(name)


def test_errors():
    """Errors that go to another process, that quote what is no UTF-8, and Ctrl-C as a callback begins."""
    try:
        missing_mesh("/nowhere.stl")
    except lsdcd.Error as error:
        for name, copied in (("pickled", pickle.loads(pickle.dumps(error))), ("copied", copy.copy(error))):
            fact(f"an Error is {name}", type(copied) is lsdcd.Error and copied.code == "input" and str(copied) == str(error), copied)
    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool:
        refused("an Error comes from another process", "/nowhere.stl", lambda: pool.submit(missing_mesh, "/nowhere.stl").result(30),
                lsdcd.Error)

    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(os.fsencode(folder), b"bad\xff.stl")
        write_floor(os.fsdecode(name))
        fact("a mesh has a name that is no UTF-8", lsdcd.Mesh(name).facts.faces > 0)
        binary = os.path.join(folder, "binary.obj")
        with open(binary, "wb") as file:
            file.write(b"v \xff\xfe 0 0\n")
        for what, says, call in (("a missing file", r"no\xff.stl", lambda: lsdcd.Mesh(os.path.join(os.fsencode(folder), b"no\xff.stl"))),
                                 ("bytes of a binary file", r"\xff\xfe", lambda: lsdcd.Mesh(binary))):
            refused(f"{what} in a message is no UTF-8", says, call, lsdcd.Error)
        log = []
        lsdcd.Wall("hooke 1 0 0 NULL 0 0 mesh $file name $name", show=lambda text, warning: log.append(text), file=os.fsdecode(name),
                   name=os.fsdecode(b"lid\xff"))
        fact("the log of a wall has a name that is no UTF-8", any(r"lid\xff" in text for text in log), log)

    def interrupt(frame, event, _):
        if event == "call" and frame.f_code.co_name in ("tell", "call"):    # of a progress, of a wall: before their first lines
            sys.setprofile(None)
            signal.raise_signal(signal.SIGINT)

    mesh, before, told = lsdcd.Mesh(square, [[0, 1, 2], [0, 2, 3]]), signal.getsignal(signal.SIGINT), []
    for name, call in (("a progress", lambda: mesh.grid(cutoff=1, progress=lambda what, done: told.append(done))),
                       ("a log", lambda: on_floor(show=lambda text, warning: None))):
        sys.setprofile(interrupt)
        try:
            refused(f"Ctrl-C as {name} begins is a KeyboardInterrupt", "", call, KeyboardInterrupt)
        finally:
            sys.setprofile(None)
    fact("and ends its call", len(told) == 1, told)
    fact("the handler is the old one", signal.getsignal(signal.SIGINT) is before)


# Of all types, and values beyond their ranges.
NONSENSE = (None, "x", b"x", -1, 1.5, float("nan"), float("inf"), 2**40, -2**70, 10**400, [], [[1, 2], [3]], {}, {1}, object(), True, 1j,
            "\0", np.array([1, 2]), np.datetime64("2020-01-01"), np.ma.array([1.0, 2, 3], mask=[0, 1, 0]), np.array("a"), [None] * 3,
            np.array([[1, 2, 3]], object), np.full((1, 3), np.nan))


def test_nonsense():
    """What each argument of the package makes of it: an answer, a ValueError (Error is one) or a TypeError."""
    corners = np.array([[[-9.0, -9, 0], [9, -9, 0], [0, 9, 0]]])
    mesh = lsdcd.Mesh(corners)
    grid, body, points = mesh.grid(cutoff=0.5), lsdcd.Body(mesh, mesh), np.zeros((2, 3))
    vectors, numbers = ("x", "v", "omega", "force", "torque"), ("radius", "mass")
    spheres = {**{k: np.zeros((1, 3)) for k in vectors}, **{k: np.ones(1) for k in numbers}, "dt": 1e-3}
    wall = on_floor()
    calls = {"Mesh()": lsdcd.Mesh, "faces": lambda b: lsdcd.Mesh(corners[0], b), "vertices": lambda b: lsdcd.Mesh(b, [[0, 1, 2]]),
             "weld": lambda b: lsdcd.Mesh(corners, weld=b), "query()": grid.query, "contacts()": lambda b: grid.contacts(b, 0.1),
             "radius of contacts()": lambda b: grid.contacts(points, b), "Body()": lambda b: lsdcd.Body(b, mesh),
             "mesh of Body()": lambda b: lsdcd.Body(mesh, b), "Wall()": lsdcd.Wall,
             "about": lambda b: wall.totals(0, b),
             "out of query()": lambda b: grid.query(points, out={"distance": b}), "a word": lambda b: grid.query(points, [b]),
             "out of contacts()": lambda b: grid.contacts(points, 0.1, out={"point": b}),
             "to": lambda b: wall.unpack(b, [1.0]), "numbers": lambda b: wall.unpack([0], b), "check()": lsdcd.Wall.check, "change()": wall.change,
             "set_input()": lambda b: wall.set_input(b, 1)}
    for name, call, some in (
            ("grid", lambda **b: mesh.grid(**{"cutoff": 0.5, **b}),
             "cutoff cell nearest precision memory threads device progress"),
            ("query", lambda **b: grid.query(points, **b), "want radius threads out stream estimate_sides progress"),
            ("contacts", lambda **b: grid.contacts(points, 0.1, **b), "threads out progress"),
            ("Body", lambda **b: lsdcd.Body(mesh, mesh, **b), "cell nearest memory threads device progress"),
            ("collide", lambda **b: body.collide(**{"position": (0, 0, 0), **b}), "position quaternion matrix threads"),
            ("Wall", on_floor, "lo hi periodic margin time show threads device stream units values"),
            ("step", lambda **b: on_floor().step(**{**spheres, **b}),
             " ".join([*vectors, *numbers, "dt setup changed reach temperature heat type"]))):
        calls |= {f"{word} of {name}()": lambda b, call=call, word=word: call(**{word: b}) for word in some.split()}
    calls |= {f"{name}()": getattr(wall, name) for name in ("renumber", "pack", "totals", "pose", "restore")}
    for name, call in calls.items():
        other = []
        for nonsense in NONSENSE:
            try:
                call(nonsense)
            except (ValueError, TypeError):
                continue
            except Exception as error:
                other.append(f"{nonsense!r}: {error!r}")
        fact(f"{name}: nonsense is a ValueError or a TypeError", not other, other)


def test_wheel():
    """What LSDCD_BUILD may name."""
    spec = importlib.util.spec_from_file_location("make_wheel", ROOT / "cmake" / "make_wheel.py")
    make_wheel = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make_wheel)
    version = make_wheel.version_of_project()
    with tempfile.TemporaryDirectory() as folder:
        cache = pathlib.Path(folder) / "CMakeCache.txt"
        refused("a wheel needs a build folder", "is no build folder", lambda: make_wheel.check_build(folder), SystemExit)
        for name, number in (("other", version), ("lsdcd", "0.1.0")):
            cache.write_text(f"CMAKE_PROJECT_NAME:STATIC={name}\nCMAKE_PROJECT_VERSION:STATIC={number}\n", encoding="ascii")
            refused(f"one of {name} {number} is refused", f"is a build of {name} {number}",
                    lambda: make_wheel.check_build(folder), SystemExit)
        cache.write_text(f"CMAKE_PROJECT_NAME:STATIC=lsdcd\nCMAKE_PROJECT_VERSION:STATIC={version}\n", encoding="ascii")
        refused("one without a library is refused", "has no library yet", lambda: make_wheel.check_build(folder), SystemExit)
        (pathlib.Path(folder) / "liblsdcd.so.0").touch()
        make_wheel.check_build(folder)


def in_c():
    """A program in C that compiles where the structs and functions that the package has read in lsdcd.h are those of a
    compiler: each field by its kind, size and place, none more (GCC and Clang warn of an initialiser that is missing), and each argument."""
    kinds = {ctypes.c_int: "int", ctypes.c_double: "double", ctypes.c_size_t: "size_t", ctypes.c_ssize_t: "ptrdiff_t",
             ctypes.c_char_p: "const char *"}
    lines = ["#include <lsdcd.h>", "#include <stddef.h>"]
    for name, struct in _c._HEADER.structs.items():
        lines.append(f'_Static_assert(sizeof({name}) == {ctypes.sizeof(struct)}, "{name}");')
        for field, kind in struct._fields_:
            place, member = getattr(struct, field), f"(({name} *) 0)->{field}"
            lines.append(f'_Static_assert(offsetof({name}, {field}) == {place.offset} && sizeof({member}) == {place.size}, "{name}.{field}");')
            one = getattr(kind, "_type_", None) if issubclass(kind, ctypes.Array) else kind
            element = f"{member}[0]" if issubclass(kind, ctypes.Array) else member
            if one in kinds:
                lines.append(f'_Static_assert(_Generic({element}, {kinds[one]}: 1, default: 0), "{name}.{field}");')
        values = ", ".join("{0}" if issubclass(kind, ctypes.Array) else "0" for _, kind in struct._fields_)
        lines.append(f"const {name} made_{name} = {{{values}}};")
    results = {ctypes.c_int: "i = ", ctypes.c_char_p: "text = ", None: ""}
    given = {ctypes.c_int: "i", ctypes.c_double: "d", ctypes.c_size_t: "n", ctypes.c_char_p: "text", ctypes.c_void_p: "p"}
    lines.append("void call(int i, double d, size_t n, const char *text, void *p)\n{")
    for name, (result, arguments) in _c._HEADER.functions.items():
        lines.append(f"  {results[result]}{name}({', '.join(given[kind] for kind in arguments)});")
    return "\n".join([*lines, "  (void) i, (void) d, (void) n, (void) text, (void) p;", "}", ""])


def test_layouts():
    """Structs and functions of the package against the header, by a compiler."""
    compiler = os.environ.get("LSDCD_C")
    if not compiler or not os.path.exists(compiler):
        return print("SKIP layouts of structs: no C compiler (LSDCD_C)")

    def says(text):
        return subprocess.run([compiler, "-std=c11", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-I", ROOT / "src/api", "-x", "c", "-"],
                              input=text, text=True, capture_output=True).stderr

    program = in_c()
    fact("structs and functions are those of the header", says(program) == "", says(program)[:2000])
    for name, was, spoilt in (("a field more in C", r"(made_lsdcd_body_facts = \{.*), 0\};", r"\1};"),
                              ("a field of another kind", "_value \\*\\) 0\\)->kind, int", "_value *) 0)->kind, double"),
                              ("an argument less", "lsdcd_wall_get_pose\\(p, i, p\\)", "lsdcd_wall_get_pose(p, i)")):
        other = re.sub(was, spoilt, program)
        fact(f"{name} is found", other != program and says(other) != "", was)
