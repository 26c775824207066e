# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Ellipsoids and superellipsoids at a mesh: their contacts, distances and facts."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._c import Progress, _as_floats, _check, _lib, _listened, _Owner, _Record, _ShapeFacts, _Shapes, _sized


class ShapeContacts(_Record):
    """All contacts of n grains, m in all; those of grain i are first[i]:first[i + 1], ascending in features."""
    first: NDArray[np.uintp]        # (n + 1,)
    point: NDArray[np.float64]      # (m, 3), on the mesh
    of_grain: NDArray[np.float64]   # (m, 3), of the grain's surface: where a force acts
    normal: NDArray[np.float64]     # (m, 3), length 1, from the mesh into the grain
    overlap: NDArray[np.float64]    # (m,), > 0, from one to the other
    triangle: NDArray[np.uint32]    # (m,), as those of an Answer
    feature: NDArray[np.uint32]     # (m,)


class ShapeDistances(_Record):
    """How far n grains are from a mesh, and where. A grain whose centre is no number is infinitely far: triangle and feature
    are NONE there."""
    distance: NDArray[np.float64]    # (n,), from surface to surface; below 0 the overlap
    closest: NDArray[np.float64]     # (n, 3), on the mesh
    of_grain: NDArray[np.float64]    # (n, 3), of the grain's surface
    normal: NDArray[np.float64]      # (n, 3), length 1, from the mesh into the grain
    triangle: NDArray[np.uint32]     # (n,)
    feature: NDArray[np.uint32]      # (n,)


class ShapeFacts(_Record):
    """What lsdcd_shape_facts says of a shape."""
    volume: float
    inertia: tuple[float, float, float]    # about the axes, over the mass, at uniform density
    circumscribed: float    # radius of the smallest sphere about the centre that holds it
    inscribed: float        # radius of the largest one that it holds
    curvature_radius: float    # the least one: up to it all overlaps are exact
    least_mass: float       # with which a point of its surface meets a plane, over the mass


def _rows(given: ArrayLike, name: str, columns: int) -> NDArray[np.float64]:
    values = np.ascontiguousarray(_as_floats(given, name), dtype=np.float64)
    if values.shape[-1:] != (columns,) or values.ndim > 2:
        raise ValueError(f"{name} has the shape {values.shape}, not (n, {columns}) or ({columns},)")
    return values


def shape_facts(half_axes: ArrayLike, exponents: ArrayLike = (2, 2)) -> ShapeFacts:
    """Volume, inertia, radii and the least mass of the body (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1 with the half-axes (a, b, c) and the
    exponents (n1, n2), from 2 to 20. Raises Error for numbers that make no shape."""
    half, n = _rows(half_axes, "half_axes", 3), _rows(exponents, "exponents", 2)
    if half.ndim != 1 or n.ndim != 1:
        raise ValueError("shape_facts() takes one shape: half_axes (3,) and exponents (2,)")
    facts = _sized(_ShapeFacts)
    _check(_lib.lsdcd_shape_get_facts(half.ctypes.data, n.ctypes.data, ctypes.byref(facts)))
    return ShapeFacts(volume=facts.volume, inertia=tuple(facts.inertia), circumscribed=facts.circumscribed,
                      inscribed=facts.inscribed, curvature_radius=facts.curvature_radius, least_mass=facts.least_mass)


def _asked(centres: ArrayLike, half_axes: ArrayLike, exponents: ArrayLike | None, quaternions: ArrayLike | None,
           threads: int) -> tuple[Any, list[Any]]:
    """The struct of these grains, and what it points to."""
    x = _rows(centres, "centres", 3)
    n = 1 if x.ndim == 1 else len(x)
    shapes = {"half_axes": _rows(half_axes, "half_axes", 3)}
    if exponents is not None:
        shapes["exponents"] = _rows(exponents, "exponents", 2)
    for name, rows in shapes.items():
        if rows.ndim == 2 and len(rows) != n:
            raise ValueError(f"{name} has the shape {rows.shape}, not ({n}, {rows.shape[-1]}), or ({rows.shape[-1]},) for all grains")
    is_one = all(rows.ndim == 1 for rows in shapes.values())
    if not is_one:    # in C both are of all, or of each
        shapes = {name: np.ascontiguousarray(np.broadcast_to(rows, (n, rows.shape[-1]))) for name, rows in shapes.items()}
    ask = _sized(_Shapes, n=n, threads=threads, one_shape=int(is_one), centres=x.ctypes.data,
                 **{name: rows.ctypes.data for name, rows in shapes.items()})
    kept = [x, *shapes.values()]
    if quaternions is not None:
        turns = _rows(quaternions, "quaternions", 4)
        if turns.shape != (*x.shape[:-1], 4):
            raise ValueError(f"quaternions has the shape {turns.shape}, not {(*x.shape[:-1], 4)}: w i j k of each grain")
        ask.quaternions = turns.ctypes.data
        kept.append(turns)
    return ask, kept


def contacts(grid: _Owner, centres: ArrayLike, half_axes: ArrayLike, exponents: ArrayLike | None, quaternions: ArrayLike | None,
             threads: int, progress: Progress | None) -> ShapeContacts:
    ask, kept = _asked(centres, half_axes, exponents, quaternions, threads)
    first = np.empty(ask.n + 1, np.uintp)
    ask.first, ask.contacts = first.ctypes.data, ask.n
    while True:
        m = ask.room = ask.contacts
        made = {name: np.empty((m, 3)) for name in ("point", "of_grain", "normal")} | {"overlap": np.empty(m)} | {
            name: np.empty(m, np.uint32) for name in ("triangle", "feature")}
        for name, array in made.items():
            setattr(ask, name, array.ctypes.data)
        _listened(lambda: _lib.lsdcd_shapes_host(grid._handle, ctypes.byref(ask)), ask, progress, grid)
        if ask.contacts <= m:
            del kept
            return ShapeContacts(first=first, **{name: array[:ask.contacts] for name, array in made.items()})


def distances(grid: _Owner, centres: ArrayLike, half_axes: ArrayLike, exponents: ArrayLike | None, quaternions: ArrayLike | None,
              threads: int, progress: Progress | None) -> ShapeDistances:
    ask, kept = _asked(centres, half_axes, exponents, quaternions, threads)
    n = ask.n
    made = ShapeDistances(distance=np.empty(n), closest=np.empty((n, 3)), of_grain=np.empty((n, 3)), normal=np.empty((n, 3)),
                          triangle=np.empty(n, np.uint32), feature=np.empty(n, np.uint32))
    for name, array in vars(made).items():
        setattr(ask, name if name in ("distance", "closest") else "closest_" + name, array.ctypes.data)
    _listened(lambda: _lib.lsdcd_shapes_host(grid._handle, ctypes.byref(ask)), ask, progress, grid)
    del kept
    return made
