# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What a wall is made of: contact laws, meshes with their motions, and the wall's own settings."""
from __future__ import annotations

import ctypes
import os
from typing import TYPE_CHECKING, Any, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._c import (DEVICES, _as_floats, _c_double, _c_int, _c_text, _check, _chosen, _flag, _instance, _instances, _Law, _lib, _list,
                 _Materials, _Motion, _noted, _numbers, _Override, _RigidBody, _Servo, _sized, _Spec, _SubModel, _text, _tuple, _TypeLaw,
                 _WallMesh, _WallSpec)
from ._sub_models import sub_models

if TYPE_CHECKING:
    from . import Mesh

_DERIVED = -1.0
_OF_RESTITUTION = ("tsuji", "coeff_restitution")    # dampings whose number is e; that of others is eta


class SubModel:
    """A formula of a contact law by its name, with its numbers by theirs: SubModel("mindlin", kt=None, xgammat=1, mu=0.5).
    None, or a number that is left out where that is possible, is derived from others. sub_models() lists names and units."""

    def __init__(self, name: str, **numbers: float | None) -> None:
        if not isinstance(name, str):
            raise TypeError(f"the name of a sub-model is {name!r}, not a text")
        self.name = name
        self.numbers = numbers

    def __repr__(self) -> str:
        return f"SubModel({', '.join([repr(self.name), *(f'{name}={value!r}' for name, value in self.numbers.items())])})"


class Law(_Spec):
    """The force between a sphere and a wall. One of the classic styles, with what may stand beside it,

        Law("hooke/history", kn=1e5, kt=3e4, gamman=50, gammat=None, xmu=0.5, dampflag=1, rolling=SubModel("cdt", MU=0.1))

    or Law.granular(). Numbers are in the caller's units: kn a force/length, gamman 1/time, and so on; None is derived.
    Raises ValueError for names of sub-models and numbers that there are not, TypeError for what is no number. What does
    not go together, or is out of its range, Wall() refuses. `report`: of from_material(), each number with its source."""
    report = ""

    @_noted
    def __init__(self, style: str, *, rolling: SubModel | None = None, cohesion: SubModel | None = None,
                 limit_damping: bool = False, **numbers: float | None) -> None:
        self._struct = _law_struct({"style": SubModel(style, **numbers), "rolling": rolling, "cohesion": cohesion},
                                   True, limit_damping)

    @classmethod
    @_noted
    def granular(cls, normal: SubModel, tangential: SubModel, damping: str | None = None, rolling: SubModel | None = None,
                 twisting: SubModel | None = None, heat: SubModel | None = None, cohesion: SubModel | None = None,
                 limit_damping: bool = False) -> Law:
        """A law of sub-models, as LAMMPS's pair style granular has them; `damping` None: viscoelastic. The number eta|e of
        `normal` is e, of restitution, beside tsuji and coeff_restitution, and eta beside the others.

            Law.granular(SubModel("hertz/material", E=5e6, e=0.5, nu=0.3), SubModel("mindlin", xgammat=1, mu=0.5), "tsuji")"""
        law = cls.__new__(cls)
        law._struct = _law_struct({"normal": normal, "tangential": tangential,
                                   "damping": SubModel(damping) if damping is not None else None, "rolling": rolling,
                                   "twisting": twisting, "heat": heat, "cohesion": cohesion}, False, limit_damping)
        return law


    @classmethod
    @_noted
    def from_material(cls, file: str | os.PathLike[str], particle: str, wall: str | None = None, *,
                      normal: str = "hertz/material", tangential: SubModel | None = None, damping: str | None = None,
                      rolling: SubModel | None = None, twisting: SubModel | None = None, heat: SubModel | None = None,
                      cohesion: SubModel | None = None, limit_damping: bool = False,
                      overrides: Mapping[str | tuple[str, str], float] | None = None, units: str = "si") -> Law:
        """A law with the numbers of two materials of a file, its path or the name of one that is installed: those of the spheres
        and of the `wall`, None: the same. `normal`: "hertz/material", "jkr" or "dmt". By default damping is by the restitution,
        and `tangential` "mindlin"; numbers of sub-models that are left out are the materials' where the file has such a property.
        `overrides`: numbers in place of the file's, {"restitution": 0.5, ("steel", "youngs_modulus"): 1e8}, in `units`, "si",
        "cgs", "micro" or "nano", as are those of the law.

            Law.from_material("glass.lsdcd", "glass", "aluminium", overrides={"restitution": 0.8})

        Raises Error for what the file lacks, and as Law() does."""
        law = cls.__new__(cls)
        law._struct = _law_struct({"tangential": tangential, "damping": SubModel(damping) if damping is not None else None,
                                   "rolling": rolling, "twisting": twisting, "heat": heat, "cohesion": cohesion}, False,
                                  limit_damping, True)
        law._struct.normal.name = _c_text(normal, "normal")
        rows = []
        for key, value in (overrides or {}).items():
            of, name = (None, key) if isinstance(key, str) else key
            rows.append(_Override(_c_text(of, "a material of overrides"), _c_text(name, "a property of overrides"),
                                  _c_double(value, f"{name} of overrides")))
        array = (_Override * len(rows))(*rows)
        given = _sized(_Materials, file=file, particle=particle, wall=wall, overrides=ctypes.addressof(array),
                       n_overrides=len(rows), units=units)
        report = ctypes.c_char_p()
        _check(_lib.lsdcd_law_from_material(ctypes.byref(given), ctypes.byref(law._struct), ctypes.byref(report)))
        law.report = _text(report.value or b"")
        return law


def _law_struct(given: dict[str, SubModel | None], beside_style: bool, limit_damping: bool,
                has_materials: bool = False) -> Any:
    """An lsdcd_law, whose numbers lie in the order of their names. With materials, all may be left out: C says which may not."""
    law = _sized(_Law, limit_damping=_flag(limit_damping, "limit_damping"))
    damping = given.get("damping")
    for field, model in sorted(given.items(), key=lambda one: one[0] != "damping"):    # which others are judged beside
        if model is None:
            continue
        if not isinstance(model, SubModel):
            raise TypeError(f"{field} is {model!r}, not a SubModel")
        setattr(law, field, _sub_model_struct(field, model, beside_style, damping.name if damping else "viscoelastic",
                                               has_materials))
    return law


def _sub_model_struct(field: str, model: SubModel, beside_style: bool, damping: str, has_materials: bool) -> Any:
    rows = [row for row in sub_models() if row.field == field and (row.beside_style if beside_style else field != "style")]
    row = next((row for row in rows if row.name == model.name), None)
    if row is None:
        raise ValueError(f"{field} is {model.name!r}; {'a style' if beside_style else 'a normal sub-model'} goes with "
                         f"{', '.join(repr(row.name) for row in rows) or 'none'}")
    left, numbers = dict(model.numbers), []
    for name, may_be_derived in zip(row.numbers, row.may_be_derived):
        may_be_derived |= has_materials
        if name == "eta|e":
            name, other = ("e", "eta") if damping in _OF_RESTITUTION else ("eta", "e")
            if other in left:
                raise ValueError(f"{model.name} has no number {other} beside the damping {damping}: e goes with "
                                 f"{' and '.join(_OF_RESTITUTION)}, eta with the others; give {name}, or another damping")
        value = left.pop(name, None)
        if value is None and not may_be_derived:
            raise ValueError(f"{model.name} needs the number {name}; it has {', '.join(row.numbers)}")
        number = _DERIVED if value is None else _c_double(value, f"{name} of {model.name}")
        if value is not None and may_be_derived and number == _DERIVED:    # which C would derive
            raise ValueError(f"{name} of {model.name} is {value!r}; it is 0 or more, or None: derived")
        numbers.append(number)
    if left:
        raise ValueError(f"{model.name} has no number {next(iter(left))}; it has {', '.join(row.numbers) or 'none'}")
    return _SubModel(_c_text(model.name, field), (ctypes.c_double * 8)(*numbers))


class Placement:
    """x -> M x + t, in the order of the calls: Placement().scale(0.001).rotate((0, 0, 1), 90).move(0, 0, 1). Each method
    changes it and returns it, and raises Error for a factor of 0, an axis 0 0 0 and what is not finite."""

    def __init__(self) -> None:
        self._numbers = (ctypes.c_double * 12)()

    def __repr__(self) -> str:
        return f"<Placement {self.matrix.tolist()}>"

    def scale(self, x: float, y: float | None = None, z: float | None = None) -> Placement:
        """By one factor, or by three."""
        if (y is None) != (z is None):
            raise ValueError("scale takes one factor or three")
        factors = [_c_double(f, "a factor") for f in (x, x if y is None else y, x if z is None else z)]
        _check(_lib.lsdcd_place_scale(self._numbers, *factors))
        return self

    def rotate(self, axis: ArrayLike, degrees: float) -> Placement:
        """About an axis, (3,), through the origin, right-handed."""
        _check(_lib.lsdcd_place_rotate(self._numbers, _three(axis, "axis"), _c_double(degrees, "degrees")))
        return self

    def move(self, x: float, y: float, z: float) -> Placement:
        """By a length along each axis."""
        _check(_lib.lsdcd_place_move(self._numbers, *(_c_double(v, "a length") for v in (x, y, z))))
        return self

    @property
    def matrix(self) -> NDArray[np.float64]:
        """(3, 4), rows of M, each with its t, a length, behind it; all 0: as the mesh is."""
        return np.array(self._numbers).reshape(3, 4)


class Motion(_Spec):
    """A motion of the time since the wall was made or set_motion() was called. Vectors are (3,)."""
    _struct: Any
    _kept: Any = None    # what the struct points to

    def __init__(self) -> None:
        raise TypeError("a Motion is made by Motion.linear(), wiggle(), cosine(), rotate(), transrot(), riggle() or table()")

    @classmethod
    def _made(cls, kind: int, **fields: ArrayLike) -> Motion:
        motion = cls.__new__(cls)
        motion._struct = _sized(_Motion, kind=kind)
        for name, value in fields.items():
            setattr(motion._struct, name, _c_double(value, name) if name in ("period", "angle") else _three(value, name))
        return motion

    @classmethod
    @_noted
    def linear(cls, velocity: ArrayLike) -> Motion:
        """At a velocity, length/time."""
        return cls._made(0, velocity=velocity)

    @classmethod
    @_noted
    def wiggle(cls, amplitude: ArrayLike, period: float) -> Motion:
        """By amplitude, a length, times sin(2 pi t / period)."""
        return cls._made(1, amplitude=amplitude, period=period)

    @classmethod
    @_noted
    def cosine(cls, amplitude: ArrayLike, period: float) -> Motion:
        """By amplitude, a length, times 1 - cos(2 pi t / period), which begins at rest."""
        return cls._made(2, amplitude=amplitude, period=period)

    @classmethod
    @_noted
    def rotate(cls, point: ArrayLike, axis: ArrayLike, period: float) -> Motion:
        """Right-handed about an axis through a point, once in a period."""
        return cls._made(3, point=point, axis=axis, period=period)

    @classmethod
    @_noted
    def transrot(cls, velocity: ArrayLike, point: ArrayLike, axis: ArrayLike, period: float) -> Motion:
        """Turns as rotate(), and goes at a velocity, length/time."""
        return cls._made(4, velocity=velocity, point=point, axis=axis, period=period)

    @classmethod
    @_noted
    def riggle(cls, point: ArrayLike, axis: ArrayLike, angle: float, period: float) -> Motion:
        """To and fro about an axis through a point, by angle, in radians, times sin(2 pi t / period)."""
        return cls._made(5, point=point, axis=axis, angle=angle, period=period)

    @classmethod
    @_noted
    def table(cls, rows: ArrayLike | str | os.PathLike[str], point: ArrayLike = (0, 0, 0), axis: ArrayLike | None = None,
              straight: bool = False, repeats: bool = False, degrees: bool = False) -> Motion:
        """A curve through `rows`, (n, k): times, which ascend, and then with k = 2 an angle about `axis`, with 4 a displacement
        x y z, with 5 both, with 7 a displacement and a rotation vector, with 8 a displacement and a quaternion w x y z.
        Angles are in radians, or with `degrees` in degrees. In place of rows, the name of a text file of them, of numbers between
        blanks or commas; # begins a comment. x goes to R (x - point) + point + displacement; before the first row and from the last one on it
        rests there. A cubic spline, or with `straight` straight between rows, at constant velocities. With `repeats` the last
        row, equal to the first but for whole turns, begins the next period."""
        motion = cls._made(6, point=point, axis=(0, 0, 0) if axis is None else axis)
        given = motion._struct
        given.straight, given.repeats = _flag(straight, "straight"), _flag(repeats, "repeats")
        given.degrees = _flag(degrees, "degrees")
        if isinstance(rows, (str, os.PathLike)):
            given.file = _c_text(rows, "rows")
            return motion
        numbers = np.array(_as_floats(rows, "rows"), dtype=np.float64, order="C")    # a copy: the caller may go on with rows
        if numbers.ndim != 2:
            raise ValueError(f"rows has the shape {numbers.shape}, not (n, 2), (n, 4), (n, 5), (n, 7) or (n, 8)")
        given.rows, given.n_rows, given.columns = numbers.ctypes.data, len(numbers), numbers.shape[1]
        motion._kept = numbers
        return motion


class Servo(_Spec):
    """Moves a mesh along `axis`, (3,), so that it pushes the spheres along it with the force `target`; with `turns` it
    turns it about the axis through `point`, (3,), with a torque. `max_speed`, > 0: length/time or 1/time. `max_gain`:
    speed per push, > 0, None: the largest that is stable. `limits`: of its position, lo <= 0 <= hi, not both 0, None: none."""

    @_noted
    def __init__(self, axis: ArrayLike, target: float, max_speed: float, turns: bool = False, point: ArrayLike = (0, 0, 0),
                 max_gain: float | None = None, limits: tuple[float, float] | None = None) -> None:
        lo, hi = _limits(limits)
        gain = 0.0 if max_gain is None else _c_double(max_gain, "max_gain")
        if max_gain is not None and gain == 0:    # which C would choose
            raise ValueError("max_gain is 0; it is above 0, or None: the largest that is stable")
        self._struct = _sized(_Servo, turns=_flag(turns, "turns"), axis=_three(axis, "axis"), point=_three(point, "point"),
                              target=target, max_speed=max_speed, max_gain=gain, lo=lo, hi=hi)


class RigidBody(_Spec):
    """A mesh as a rigid body, which moves by what acts on it. It begins where the mesh is placed. Vectors are (3,), along
    the axes of the box.

    Either `density`, > 0, of a closed mesh, or `mass`, > 0, `centre`, a length, and `inertia`, (6,), about the centre: xx yy
    zz xy xz yz, mass length^2, where xy is minus the integral of x y. `joint`: "free", "hinge" about `axis` through `point`,
    "slider" along `axis`, "planar" with the normal `axis`, or "ball" about `point`. Of the coordinate of a hinge, an angle,
    right-handed, and of a slider, a length: `spring`, (stiffness, damping, rest), `limits`, lo <= 0 <= hi, not both 0, and
    `motor`, a torque or force. `load`: force at the centre; `moment`: torque; `gravity`: length/time^2. `velocity` of the centre and
    `angular_velocity` at the start. `coat`: points of its surface feel the other meshes of the wall; True, or (spacing,
    radius), lengths > 0.

    Raises TypeError and ValueError for what is no such value; Wall() and Wall.set_body() refuse what makes no sense."""

    @_noted
    def __init__(self, density: float = 0.0, *, mass: float = 0.0, centre: ArrayLike = (0, 0, 0),
                 inertia: ArrayLike = (0, 0, 0, 0, 0, 0), joint: str = "free", point: ArrayLike = (0, 0, 0),
                 axis: ArrayLike = (0, 0, 0), spring: tuple[float, float, float] = (0.0, 0.0, 0.0),
                 limits: tuple[float, float] | None = None, motor: float = 0.0, load: ArrayLike = (0, 0, 0),
                 moment: ArrayLike = (0, 0, 0), velocity: ArrayLike = (0, 0, 0), angular_velocity: ArrayLike = (0, 0, 0),
                 gravity: ArrayLike = (0, 0, 0), coat: bool | tuple[float, float] = False) -> None:
        lo, hi = _limits(limits)
        spacing, radius = (0.0, 0.0) if isinstance(coat, (bool, np.bool_)) else _tuple(coat, "(spacing, radius)", "coat")
        if not isinstance(coat, (bool, np.bool_)) and 0 in (spacing, radius):    # which C would choose
            raise ValueError(f"coat is {coat!r}; spacing and radius are above 0, or True: both are chosen")
        moments = _numbers(inertia, (6,), "inertia")
        if moments is None:
            raise TypeError("inertia is None, not six numbers")
        stiffness, damping, rest = _tuple(spring, "(stiffness, damping, rest)", "spring")
        self._struct = _sized(
            _RigidBody, density=density, mass=mass, centre=_three(centre, "centre"),
            inertia=(ctypes.c_double * 6)(*map(float, moments)),
            joint=_chosen("joint", joint, ("free", "hinge", "slider", "planar", "ball")), point=_three(point, "point"),
            axis=_three(axis, "axis"), stiffness=stiffness, damping=damping, rest=rest, lo=lo, hi=hi, motor=motor,
            load=_three(load, "load"), moment=_three(moment, "moment"), velocity=_three(velocity, "velocity"),
            angular_velocity=_three(angular_velocity, "angular_velocity"), gravity=_three(gravity, "gravity"),
            coat=bool(coat), coat_spacing=spacing, coat_radius=radius)


class WallMesh(_Spec):
    """A mesh of a wall, which may be in others, too. `name`: what messages call it. `placement`: a Placement, or (3, 4),
    rows of M, each with its t behind it; None: as the mesh is. `law`: the wall's sub-models with other numbers, None: the
    wall's. `type_laws`: (first, last, Law) of atom types from first to last, None: all from first on; of two with a type
    the last one counts. `posed_by_caller`: Wall.set_pose() moves it; else `motions` do, each acting on what the earlier
    ones placed, and `servo`, or the mesh is a rigid `body`. `surface_velocity`, length/time, `surface_angular_velocity`,
    1/time, `surface_centre`: the surface moves along itself while the mesh rests, as that of a belt or a roll. `temperature`: where the law has heat.
    `torque_about`: what the torque of Wall.totals() is about; with `torque_about_moves` that point moves with the mesh.
    `wear_factor`: it wears so many times as fast. `cache`: a file that keeps its grid. `fields`, (name, steps): a .vtp file
    of stress, contacts, wear, energy and impacts of each triangle, written every so many steps, with a * for the step in its name; `stl`
    likewise: the mesh where it is; `spectrum`: a .csv file of what Wall.impacts() returns. `nodes_by_caller`: Wall.set_nodes() moves each vertex, and nothing else moves the mesh;
    `pressure`, force/area, then pushes them to where normals point by the winding, out of a closed mesh.

    Raises TypeError and ValueError for what is no such value; Wall() refuses what makes no sense."""

    @_noted
    def __init__(self, mesh: Mesh, name: str = "", placement: Placement | ArrayLike | None = None, law: Law | None = None,
                 type_laws: Sequence[tuple[int, int | None, Law]] = (), posed_by_caller: bool = False,
                 motions: Sequence[Motion] = (), servo: Servo | None = None, surface_velocity: ArrayLike = (0, 0, 0),
                 surface_angular_velocity: ArrayLike = (0, 0, 0), surface_centre: ArrayLike = (0, 0, 0),
                 temperature: float = 0.0, torque_about: ArrayLike = (0, 0, 0), torque_about_moves: bool = False,
                 wear_factor: float = 1.0, cache: str | os.PathLike[str] | None = None,
                 fields: tuple[str | os.PathLike[str], int] | None = None,
                 stl: tuple[str | os.PathLike[str], int] | None = None, nodes_by_caller: bool = False,
                 pressure: float = 0.0, body: RigidBody | None = None,
                 spectrum: tuple[str | os.PathLike[str], int] | None = None) -> None:
        from . import Mesh    # which is made of this module, too
        matrix = placement.matrix if isinstance(placement, Placement) else _numbers(placement, (3, 4), "placement")
        if matrix is not None and not isinstance(placement, Placement) and not matrix.any():    # which is none in C
            raise ValueError("placement is all 0; it is a matrix that keeps the mesh three-dimensional, or None: as the mesh is")
        flat = np.zeros(12) if matrix is None else matrix.ravel()
        given = [_tuple(row, "(first, last, law)", f"type_laws[{k}]") for k, row in enumerate(_list(type_laws, "type_laws"))]
        laws = _instances([row[2] for row in given], Law, "laws of type_laws")
        if any(last is not None and last == 0 for _, last, _ in given):    # which is all of C
            raise ValueError("the last type of a row of type_laws is 0; types count from 1, and None is all from the first on")
        rows = [_sized(_TypeLaw, first_type=first, last_type=0 if last is None else last, law=ctypes.addressof(row._struct))
                for (first, last, _), row in zip(given, laws)]
        types, moved = (_TypeLaw * len(rows))(*rows), _motion_array(motions)
        factor = _c_double(wear_factor, "wear_factor")
        if factor < 0:    # -1 of C is never
            raise ValueError(f"wear_factor is {wear_factor!r}; it is above 0, or 0: the mesh does not wear")
        self._struct = _sized(
            _WallMesh, mesh=_instance(mesh, Mesh, "mesh")._handle, name=name or None, placement=(ctypes.c_double * 12)(*flat),
            law=_address(law, Law, "law"), type_laws=ctypes.addressof(types), n_type_laws=len(rows),
            posed_by_caller=_flag(posed_by_caller, "posed_by_caller"), motions=ctypes.addressof(moved), n_motions=len(moved),
            servo=_address(servo, Servo, "servo"), surface_velocity=_three(surface_velocity, "surface_velocity"),
            surface_angular_velocity=_three(surface_angular_velocity, "surface_angular_velocity"),
            surface_centre=_three(surface_centre, "surface_centre"), temperature=temperature,
            torque_about=_three(torque_about, "torque_about"),
            torque_about_moves=_flag(torque_about_moves, "torque_about_moves"),
            # C has 0 for once and -1 for never.
            wear_factor={0.0: -1.0, 1.0: 0.0}.get(factor, factor), cache=cache or None,
            **_file_every(fields, "fields"), **_file_every(stl, "stl"), **_file_every(spectrum, "spectrum"),
            nodes_by_caller=_flag(nodes_by_caller, "nodes_by_caller"), pressure=pressure,
            body=_address(body, RigidBody, "body"))
        self._name = name
        self._kept = (mesh, law, laws, types, tuple(motions), moved, servo, body)    # what the struct points to


class WallSpec(_Spec):
    """What a wall is made of: the `law` of its spheres, and its `meshes`, 1 at least.

    `corner`: "blend", contacts of a sphere at a corner share their overlap, or "sum", their forces add. `side`: "both",
    "in" or "out", where spheres belong; one side needs closed meshes whose triangles are wound alike. `nearest` 0: exact;
    N: only the N triangles nearest to a cell. `cell`, length, and `memory`, bytes of each mesh: of its grid, 0: chosen. `rmax`: the largest radius
    that there will be, 0: that of the spheres. `compute`: "cpu", "cuda" or, by how many spheres
    are near the wall, "auto", for spheres in arrays of the host. `wear`:
    None, ("archard", K, H) with the hardness H, a pressure, or ("finnie", K), 1/pressure. `wear_deform`: (steps, factor),
    every so many steps wear moves the vertices of the meshes, by a volume of so many times what has worn; None: they stay.
    `periodic_ends`: meshes are meant to end at periodic faces. `brief`: one line in the log. `average`: steps of the means of
    force and torque in Wall.totals(), 0: there are none. `each_contact`: Wall.contacts() will be called. `energy`:
    what contacts dissipate is booked, in Wall.totals(). `impact_speed`, length/time: faster impacts are recorded, in Wall.totals(),
    Wall.impacts() and the files of meshes; 0: none. `friction_heat`: the share, 0 to 1, of the heat of friction that goes into the
    spheres, with `energy` and a law with heat. `shapes`:
    grains may be no spheres, so that Wall.step() reads half_axes and the others."""

    @_noted
    def __init__(self, law: Law, meshes: Sequence[WallMesh], corner: str = "blend", side: str = "both",
                 nearest: int = 0, cell: float = 0.0, memory: float = 0.0, rmax: float = 0.0,
                 compute: str = "cpu", wear: tuple[str, float] | tuple[str, float, float] | None = None,
                 periodic_ends: bool = False, brief: bool = False, wear_deform: tuple[int, float] | None = None,
                 average: int = 0, each_contact: bool = False, shapes: bool = False,
                 energy: bool = False, impact_speed: float = 0.0, friction_heat: float = 0.0) -> None:
        parts = _instances(meshes, WallMesh, "meshes")
        array = (_WallMesh * len(parts))(*(part._struct for part in parts))
        model, coefficient, hardness = _wear(wear)
        every, factor = (0, 0.0) if wear_deform is None else _tuple(wear_deform, "(steps, factor)", "wear_deform")
        if wear_deform is not None and not (_c_int(every, "steps of wear_deform") > 0 and
                                            _c_double(factor, "factor of wear_deform") > 0):    # C has other meanings for 0
            raise ValueError(f"wear_deform is {wear_deform!r}; it is (steps, factor), both above 0, or None")
        self._struct = _sized(
            _WallSpec, law=_address(_instance(law, Law, "law"), Law, "law"), meshes=ctypes.addressof(array),
            n_meshes=len(parts), corner=_chosen("corner", corner, ("blend", "sum")),
            side=_chosen("side", side, ("both", "in", "out")),
            nearest=nearest, cell=cell, memory=memory,
            rmax=rmax, device=_chosen("compute", compute, (*DEVICES, "auto")), wear=model, wear_coefficient=coefficient,
            hardness=hardness, wear_deform_every=every, wear_deform_factor=factor,
            periodic_ends=_flag(periodic_ends, "periodic_ends"), brief=_flag(brief, "brief"), average_every=average,
            each_contact=_flag(each_contact, "each_contact"), energy=_flag(energy, "energy"), impact_speed=impact_speed, friction_heat=friction_heat,
            shapes=_flag(shapes, "shapes"))
        self._kept = (law, parts, array)    # what the struct points to

    def _meshes(self) -> list[Mesh]:
        return [part._kept[0] for part in self._kept[1]]

    def _names(self) -> list[str]:
        """What the wall calls its meshes. Raises ValueError where one of them has been closed."""
        for k, mesh in enumerate(self._meshes()):
            if not mesh._handle:
                raise ValueError(f"meshes[{k}]: its Mesh has been closed, so that no wall can be made of it")
        return [part._name or f"mesh {k + 1}" for k, part in enumerate(self._kept[1])]


def _motion_array(motions: Sequence[Motion]) -> Any:
    each = [motion._struct for motion in _instances(motions, Motion, "motions")]
    return (_Motion * len(each))(*each)


def _limits(limits: tuple[float, float] | None) -> tuple[float, float]:
    """As C has them: both 0 are none."""
    if limits is None:
        return 0.0, 0.0
    lo, hi = (_c_double(end, "an end of limits") for end in _tuple(limits, "(lo, hi)", "limits"))
    if lo == 0 == hi:
        raise ValueError("limits is (0, 0), between which nothing moves: give lo <= 0 <= hi, of which one is not 0, or None: none")
    return lo, hi


def _file_every(given: tuple[str | os.PathLike[str], int] | None, name: str) -> dict[str, Any]:
    """Fields of a file that is written every so many steps."""
    file, every = (None, 0) if given is None else _tuple(given, "(name, steps)", name)
    if given is not None and not file:
        raise ValueError(f"{name} is {given!r}; it is (name, steps), or None: no file")
    return {name: file, name + "_every": every}


def _wear(wear: tuple[Any, ...] | None) -> tuple[int, float, float]:
    """The model, K and H of C."""
    if wear is None:
        return 0, 0.0, 0.0
    forms = {"archard": '("archard", K, H)', "finnie": '("finnie", K)'}
    if isinstance(wear, (str, bytes)) or not hasattr(wear, "__len__") or not len(wear) or wear[0] not in forms:
        raise ValueError(f"wear is {wear!r}; it is {' or '.join(forms.values())}, or None")
    numbers = [_c_double(number, "a number of wear") for number in _tuple(wear, forms[wear[0]], "wear")[1:]]
    return 1 + list(forms).index(wear[0]), numbers[0], numbers[1] if len(numbers) == 2 else 0.0


def _three(values: ArrayLike, name: str) -> Any:
    numbers = _numbers(values, (3,), name)
    if numbers is None:
        raise TypeError(f"{name} is None, not three numbers")
    return (ctypes.c_double * 3)(*map(float, numbers))


def _address(value: Any, kind: Any, name: str) -> int | None:
    return None if value is None else ctypes.addressof(_instance(value, kind, name)._struct)
