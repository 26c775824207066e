# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Queries of the Python package with arrays of PyTorch, CuPy and JAX on a GPU, against heights over a floor; walls with
arrays of PyTorch and CuPy against arrays of numpy.

    PYTHONPATH=src/api LSDCD_LIBRARY=build/lib/liblsdcd.so.0 python3 -m pytest -c tests/pytest.ini tests/library/test_python_gpu.py

Needs a library built with CUDA, a GPU, and one of the three; what is missing is skipped by its name, and with all
missing all are skipped. Heights are multiples of 1/1024, so that distances in float32 and float64 are off by no
more than 3e-6 of the cutoff.
"""
import importlib

import numpy as np
import pytest

import lsdcd
import stl
from facts import fact
from lsdcd import _arrays

CUTOFF, N = 2.0, 200000
TETRAHEDRON = np.array([[0, 0, 0], [90, 0, 0], [0, 90, 0], [0, 0, 90]])[[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]]
WANT = "distance closest normal triangle status"


def refused(name, says, call):
    try:
        call()
    except (TypeError, ValueError) as error:
        fact(name, says in str(error), error)
        return
    fact(name, False, "not refused")


class Torch:
    """What the test needs of a library."""
    name = "PyTorch"

    def __init__(self):
        self.lib = importlib.import_module("torch")
        if not self.lib.cuda.is_available():
            raise ImportError("torch sees no GPU")
        self.kind, self.own = self.lib.Tensor, True

    def give(self, values):
        return self.lib.from_numpy(values).cuda()

    def take(self, values):
        return values.cpu().numpy()

    def empty(self, shape, dtype):
        return self.lib.empty(shape, dtype=getattr(self.lib, {"uint32": "int32"}.get(dtype, dtype)), device="cuda")

    def stream(self):
        return self.lib.cuda.Stream()

    def on(self, stream):
        return self.lib.cuda.stream(stream)

    def wait(self):
        self.lib.cuda.synchronize()


class Cupy:
    name = "CuPy"

    def __init__(self):
        self.lib = importlib.import_module("cupy")
        if self.lib.cuda.runtime.getDeviceCount() < 1:
            raise ImportError("cupy sees no GPU")
        self.kind, self.own = self.lib.ndarray, True

    def give(self, values):
        return self.lib.asarray(values)

    def take(self, values):
        return self.lib.asnumpy(values)

    def empty(self, shape, dtype):
        return self.lib.empty(shape, dtype)

    def stream(self):
        return self.lib.cuda.Stream(non_blocking=True)

    def on(self, stream):
        return stream

    def wait(self):
        self.lib.cuda.Device().synchronize()


class Jax:
    name = "JAX"

    def __init__(self):
        self.lib = importlib.import_module("jax")
        if self.lib.default_backend() != "gpu":
            raise ImportError("jax sees no GPU")
        self.lib.config.update("jax_enable_x64", True)
        self.kind, self.own = _arrays.DeviceArray, False

    def give(self, values):
        return self.lib.device_put(values)

    def take(self, values):
        return np.asarray(self.lib.dlpack.from_dlpack(values))


def heights(dtype):
    """Points above and below the floor, up to 1.5 of the cutoff, and how far they are."""
    random = np.random.default_rng(3)
    z = random.integers(-3072, 3073, N) / 1024
    xy = random.integers(-1024, 1025, (N, 2)) / 1024
    return np.column_stack([xy, z]).astype(dtype), np.where(abs(z) < CUTOFF, abs(z), np.inf)


def same(found, wanted):
    near = np.isfinite(wanted)
    return found.shape == wanted.shape and (np.isinf(found) == ~near).all() \
        and np.allclose(found[near], wanted[near], rtol=0, atol=3e-6 * CUTOFF)


def check(library, grid):
    say = lambda text: f"{library.name}: {text}"    # noqa: E731
    for dtype in ("float32", "float64"):
        points, distance = heights(dtype)
        answer = grid.query(library.give(points), WANT + " barycentric")
        fact(say(f"answers are its own, {dtype}"), all(isinstance(a, library.kind) for a in vars(answer).values()))
        fact(say(f"distances, {dtype}"), same(library.take(answer.distance), distance))
        host = grid.query(points, WANT + " barycentric")
        near = np.isfinite(distance)
        fact(say(f"closest points and triangles are the host's, {dtype}"),
             np.allclose(library.take(answer.closest), host.closest, rtol=0, atol=1e-5)
             and (library.take(answer.triangle)[near].astype(np.uint32) == host.triangle[near]).all()
             and (library.take(answer.status) == host.status).all())
        fact(say(f"barycentrics are the host's, {dtype}"),
             np.allclose(library.take(answer.barycentric), host.barycentric, rtol=0, atol=1e-5, equal_nan=True)
             and np.isnan(host.barycentric).any() and not np.isnan(host.barycentric).all())
        shaped = grid.query(library.give(points.reshape(-1, 2, 4, 3)), "distance closest")
        fact(say(f"shapes, {dtype}"), library.take(shaped.distance).shape == (N // 8, 2, 4)
             and same(library.take(shaped.distance).ravel(), distance) and tuple(shaped.closest.shape) == (N // 8, 2, 4, 3))
    none = grid.query(library.give(np.zeros((0, 3))), "distance closest")
    fact(say("no points"), tuple(none.distance.shape) == (0,) and tuple(none.closest.shape) == (0, 3))
    refused(say("whole numbers are refused"), "convert", lambda: grid.query(library.give(points.astype(np.int32))))
    # Without a cutoff a tree answers: one source for both, so the same numbers.
    tree = lsdcd.Mesh(TETRAHEDRON).grid()
    far = points * 100
    answer, host = tree.query(library.give(far), WANT + " side signed_distance barycentric"), tree.query(far, WANT + " side signed_distance barycentric")
    fact(say("at any distance as on the host"),
         all((library.take(getattr(answer, name)) == getattr(host, name)).all() for name in ("distance", "closest", "side", "signed_distance", "barycentric"))
         and (library.take(answer.triangle).astype(np.uint32) == host.triangle).all())
    refused(say("an answer on the host is refused"), "on the host", lambda: grid.query(library.give(points), out={"distance": distance}))
    if library.own:
        check_in_place(library, grid, say, *heights("float32"))


def check_in_place(library, grid, say, points, distance):
    rows = library.give(np.column_stack([points, np.full(N, 0.5, np.float32)]).astype(np.float32))
    found = library.take(grid.query(rows[:, :3], radius=rows[:, 3]).distance)
    fact(say("rows of x y z radius, in place"), same(found, np.where(distance < 0.5, distance, np.inf)))
    out = {"distance": library.empty((N,), "float32"), "triangle": library.empty((N,), "uint32")}
    answer = grid.query(rows[:, :3], out=out)
    fact(say("arrays of the caller for answers"), answer.distance is out["distance"] and same(library.take(out["distance"]), distance))

    # Points are made, asked and taken on one stream: much work before them, so that an answer out of order is seen.
    for given in (False, True):
        stream = library.stream()
        with library.on(stream):
            work = library.give(np.ones((2000, 2000), np.float32))
            moved = library.give(np.zeros_like(points))
            library.wait()
            for _ in range(30):
                work = (work @ work) * 0
            moved += rows[:, :3] + work[0, 0]
            answer = None if given else grid.query(moved).distance + 0
        if given:
            answer = grid.query(moved, stream=stream).distance
        library.wait()
        fact(say(f"the stream, {'given' if given else 'current'}, keeps the order"), same(library.take(answer), distance))
    streams = [library.stream() for _ in range(12)]
    answers = [grid.query(rows[:, :3], stream=stream).distance for stream in streams]
    library.wait()
    fact(say("more streams than are kept"), all(same(library.take(a), distance) for a in answers))
    handle = _arrays.stream_handle(streams[0])
    answer = grid.query(rows[:, :3], stream=handle).distance
    library.wait()
    fact(say("a stream by its number"), same(library.take(answer), distance))


def grains(n):
    """Places, speeds, turns, radii and masses of spheres that touch a floor at z = 0, or not."""
    random = np.random.default_rng(7)
    x = random.uniform(-1, 1, (n, 3))
    x[:, 2] = random.uniform(0.4, 0.6, n)
    return {"x": x, "v": random.uniform(-1, 1, (n, 3)), "omega": random.uniform(-1, 1, (n, 3)),
            "radius": np.full(n, 0.5), "mass": random.uniform(1, 2, n), "force": np.zeros((n, 3)), "torque": np.zeros((n, 3))}


def check_wall(library, floor):
    """A wall's arrays on a GPU against arrays of numpy: the same bits, as test_library_wall_gpu has them."""
    say = lambda text: f"{library.name}: {text}"    # noqa: E731
    words, dt = "hooke/history 1000 300 5 2 0.5 1 mesh $floor", 1e-3
    host, given = lsdcd.Wall(words, floor=floor), grains(1000)
    wall, there = lsdcd.Wall(words, floor=floor, device="cuda"), {k: library.give(v) for k, v in given.items()}
    for _ in range(5):
        host.step(**given, dt=dt)
        wall.step(**there, dt=dt)
    library.wait()
    for name in ("force", "torque"):
        fact(say(f"a wall's {name}"), (library.take(there[name]) == given[name]).all() and (given[name] != 0).any())
    fact(say("a wall's totals"), wall.totals().contacts == host.totals().contacts > 0)
    refused(say("arrays of numpy are refused by a wall on a device"), "x is on the host",
            lambda: wall.step(**{**there, "x": given["x"]}, dt=dt))
    refused(say("arrays on a device are refused by a wall on the host"), "make it with device=\"cuda\"",
            lambda: host.step(**{**given, "x": there["x"]}, dt=dt))
    refused(say("float32 is refused"), "not a contiguous float64",
            lambda: wall.step(**{**there, "mass": library.give(np.ones(1000, np.float32))}, dt=dt))

    walls = [lsdcd.Wall("hooke/history 1000 300 20 NULL 0.5 1 mesh $floor nodes caller", floor=floor, device=where) for where in ("cpu", "cuda")]
    nodes = walls[0].nodes()
    forces, given = library.give(np.zeros_like(nodes)), grains(1000)
    there = {k: library.give(v) for k, v in given.items()}
    for k in range(5):
        places, speeds = nodes + (0, 0, 1e-4 * k), np.full_like(nodes, 0.1)
        walls[0].set_nodes(0, places, speeds)
        walls[1].set_nodes(0, library.give(places), library.give(speeds))
        walls[0].step(**given, dt=dt)
        walls[1].step(**there, dt=dt)
        walls[1].node_forces(0, out=forces)
    library.wait()
    fact(say("nodes in arrays of the device, and the forces on them"), (library.take(forces) == walls[0].node_forces(0)).all()
         and (walls[1].nodes() == places).all() and (library.take(there["force"]) == given["force"]).all())
    refused(say("velocities of numpy beside positions on a device are refused"), "velocities is on the host",
            lambda: walls[1].set_nodes(0, library.give(places), speeds))
    refused(say("nodes on a device are refused by a wall on the host"), "make it with device=\"cuda\"",
            lambda: walls[0].set_nodes(0, library.give(places)))

    # The stream of the wall sets the force to 0 after much other work; then the wall adds to it.
    stream = library.stream()
    with library.on(stream):
        wall, again = lsdcd.Wall(words, floor=floor, device="cuda", stream=stream), {k: library.give(v) for k, v in grains(1000).items()}
        work = library.give(np.ones((2000, 2000), np.float32))
        again["force"] += 1
        library.wait()
        for _ in range(30):
            work = (work @ work) * 0
        again["force"] -= 1 + work[0, 0]
        wall.step(**again, dt=dt)
        found = library.take(again["force"])
    first = grains(1000)
    lsdcd.Wall(words, floor=floor).step(**first, dt=dt)
    fact(say("a wall keeps the order of its stream"), (found == first["force"]).all())


@pytest.mark.parametrize("kind", (Torch, Cupy, Jax), ids=lambda kind: kind.name)
def test_arrays(kind, folder):
    if not lsdcd._lib.lsdcd_has_cuda():
        pytest.skip(lsdcd._lib.lsdcd_last_error().decode())
    try:
        library = kind()
    except ImportError as error:
        pytest.skip(str(error))
    triangles = [[[-9, -9, 0], [9, -9, 0], [0, 9, 0]]]
    check(library, lsdcd.Mesh(triangles).grid(cutoff=CUTOFF))
    if library.own:
        stl.write(folder / "floor.stl", triangles)
        check_wall(library, lsdcd.Mesh(folder / "floor.stl"))
