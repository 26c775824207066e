#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs LAMMPS's own tests of granular styles: its YAML files, with its styles and with ours in their place.

usage: lammps_yaml.py [--keep] [TEST ...]

A file of unittest/granular/tests in LAMMPS's sources has the commands of a script and what LAMMPS saw after each of its runs: places, velocities, spins and
torques. Many name a closed form, too. tests/lammps/hosts/build_host.sh keeps the files beside the LAMMPS 4Jul2026 that it builds; LSDCD_HOST names its folder.
With LSDCD_ON_HOST=1 and LSDCD_HOST_PLUGIN, as lmp.py reads them, that LAMMPS runs each script with its own styles and with ours; else lmp-lsdcd runs it with
ours alone. --keep puts the rows into doc/data, and the table into doc/validation.md.
"""
import csv
import dataclasses
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
if __name__ == "__main__":
    sys.path[:0] = [str(HERE.parent), str(HERE.parent / "lammps"), str(HERE.parent.parent / "bench")]

import lmp
import stl
from suite import AT_WALLS, BETWEEN_GRAINS, DATA, PLANE, TWO, slivers

KEPT = DATA / "validation_lammps_yaml.tsv"
FILES = pathlib.Path(os.environ.get("LSDCD_HOST") or "none") / "unittest" / "granular" / "tests"
NEWTON = ("on", "off")

# Whether ours passes: all numbers within the file's tolerance; all but those that differ by a rounding(); not; a test of GROWS, nearer than LAMMPS's own
# with its last digit changed; nothing of ours; a file without numbers.
YES, ROUNDING, NO, GROWTH, NOT_RUN, FORM_ALONE = "yes", "but for rounding", "no", "nearer than LAMMPS's own", "not run", "its closed form"
# What tests nothing of ours, and why.
NOTHING_OF_OURS = {
    "dem05-superellipsoid-3d": "two superellipsoids without a wall, and granular/lsdcd is a law of spheres",
    "dem06-nonlinear-3d": "drag of a fluid alone, no contact",
    "dem06-viscous-linear-3d": "drag of a fluid alone, no contact",
    "test_dem01_hooke": "none of LAMMPS's programs reads it, and the script that it names is not there",
}
# Whose motion grows rounding beyond the tolerance: a length of the script, whose last digit is changed for a run of LAMMPS's own styles to compare with.
GROWS = {"dem10-clump-3d": "1.8"}
# LAMMPS without its package MOLECULE gives grains the number of their body by a fix.
WITHOUT_MOLECULE = ("atom_style hybrid sphere molecular\n", "atom_style sphere\natom_modify map array\n"), ("create_box 1 box\n", "create_box 1 box\nfix body all property/atom mol ghost yes\n")


# ---- files -------------------------------------------------------------------------------

def read_yaml(path):
    """Reads one of these files as {key: text}: a key begins a line, and the lines of a block behind it are indented."""
    keys, block = {}, None
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith((" ", "\t")) and block is not None:
            keys[block] += line.strip() + "\n"
        elif found := re.match(r"(\w+): *(.*)$", line):
            name, value = found.groups()
            block = name if value.startswith("! |") else None
            keys[name] = "" if block or value == '! ""' else value.strip()
    return keys


@dataclasses.dataclass
class Test:
    """What a file has. `seen`: of each run, {atom: {column: number}}."""
    name: str
    keys: dict
    variables: dict
    steps: list
    seen: list

    @property
    def tolerance(self):
        return float(self.keys["epsilon"])

    @property
    def form(self):
        return self.keys["analytic_model"] if self.keys.get("analytic_enable") == "yes" else ""

    @property
    def has_wall(self):
        return "wall/gran" in self.keys["post_commands"]

    @property
    def has_pair(self):
        """Whether grains meet each other."""
        return int(self.keys["natoms"]) != 1

    @property
    def walls(self):
        """LAMMPS's own styles, and ours at one cut of the planes or at two."""
        return AT_WALLS if self.has_wall else BETWEEN_GRAINS


# Blocks of numbers, and the columns of a dump that they are.
BLOCKS = {"run_pos": ("x", "y", "z"), "run_vel": ("vx", "vy", "vz"), "run_omega": ("omegax", "omegay", "omegaz"), "run_torque": ("tqx", "tqy", "tqz")}
COLUMNS = [name for block in BLOCKS.values() for name in block] + ["fx", "fy", "fz", "radius", "mass"]


def read_test(path):
    keys = read_yaml(path)
    for old, new in WITHOUT_MOLECULE if "molecular" in keys["pre_commands"] else ():
        keys["pre_commands"] = keys["pre_commands"].replace(old, new)
    steps = [int(word) for word in keys["run_segments"].split()]
    seen = [{} for _ in steps]
    for block, columns in BLOCKS.items():
        for line in keys.get(block, "").splitlines():
            segment, atom, *numbers = line.split()
            seen[int(segment)].setdefault(int(atom), {}).update(zip(columns, map(float, numbers)))
    variables = dict(line.split(maxsplit=1) for line in keys.get("variables", "").splitlines())
    return Test(path.stem, keys, variables, steps, seen)


def names():
    """Of all files that are there."""
    return sorted(path.stem for path in FILES.glob("*.yaml"))


def with_variable(test, **values):
    """The test with other numbers in place of variables."""
    return dataclasses.replace(test, variables={**test.variables, **{name: repr(value) for name, value in values.items()}})


def nudged(test, towards):
    """The test with a length of GROWS changed in its last digit."""
    length = GROWS[test.name]
    lines = test.keys["pre_commands"].replace(f" {length} ", f" {math.nextafter(float(length), towards)!r} ")
    assert lines != test.keys["pre_commands"], f"{test.name} has no {length}"
    return dataclasses.replace(test, keys={**test.keys, "pre_commands": lines})


# ---- scripts -----------------------------------------------------------------------------

PLANES = re.compile(r"^(fix +\S+ +\S+ +)wall/gran( .*) ([xyz])plane (\S+) (\S+)$", re.M)


def square_across(axis, level, half, triangles):
    """The triangles of a square across z, of half side 1, across another axis, at this level and of this half side."""
    turn = {"x": lambda p: (level, half * p[0], half * p[1]), "y": lambda p: (half * p[1], level, half * p[0]), "z": lambda p: (half * p[0], half * p[1], level)}[axis]
    return [tuple(turn(p) for p in t) for t in triangles]


def ours(test, text, wall, folder):
    """Lines with our styles: a mesh for each plane, in as large a square as the grains need, and LSDCD's gravity."""
    places = [abs(atom[c]) for segment in test.seen for atom in segment.values() for c in "xyz"]
    diameter = float(test.variables.get("diam", 1.0))
    half = max(places, default=9.0) + diameter
    triangles = stl.square(1.0) if wall == TWO else slivers()

    def mesh(found):
        fix, law, axis, *levels = found.groups()
        meshes = ""
        for side, level in zip(("lo", "hi"), levels):
            if level != "NULL":
                level = float(re.sub(r"\$\{(\w+)\}", lambda v: test.variables[v[1]], level))
                stl.write(folder / f"{axis}{side}.stl", square_across(axis, level, half, triangles))
                meshes += f" mesh {axis}{side}.stl"
        return f"{fix}wall/lsdcd{law}{meshes}"
    return re.sub(r"^(fix +\S+ +\S+ +)gravity ", r"\1gravity/lsdcd ", PLANES.sub(mesh, text), flags=re.M)


def pair_lines(test, wall):
    """The law between grains; our pair style has a classic style behind the word law."""
    style, coeffs = test.keys["pair_style"], test.keys["pair_coeff"].splitlines()
    if wall != PLANE:
        name, _, numbers = style.partition(" ")
        classic = f" law {name.removeprefix('gran/')} {numbers}" if name.startswith("gran/") else ""
        style, coeffs = "granular/lsdcd", [c + classic for c in coeffs]
    return f"pair_style {style}\n" + "".join(f"pair_coeff {c}\n" for c in coeffs)


def script_of(test, wall, newton, folder):
    """The commands in the order in which LAMMPS's program gives them; meshes go to the folder."""
    fixes = test.keys["post_commands"]
    script = f"newton {newton}\nvariable input_dir index {FILES}\n" + "".join(f"variable {name} index {value}\n" for name, value in test.variables.items()) + \
        test.keys["pre_commands"] + pair_lines(test, wall) + (fixes if wall == PLANE else ours(test, fixes, wall, folder)) + "run 0 post no\n"
    for i, steps in enumerate(test.steps):
        script += f"run {steps} post no\nwrite_dump all custom run{i}.dump id {' '.join(COLUMNS)} modify format float %.17g sort id\n"
    return script


def run_test(test, wall, newton, folder):
    """What the grains are after each run of steps: [{atom: {column: number}}]."""
    lmp.run_well(script_of(test, wall, newton, folder), folder)
    return [{atom: dict(zip(COLUMNS, row)) for atom, row in next(iter(lmp.read_dump(folder / f"run{i}.dump").values())).items()} for i in range(len(test.steps))]


# ---- what is compared ----------------------------------------------------------------------

def off(a, b):
    """How far two numbers are apart as LAMMPS's tests measure it: over the smaller of the two, and as such where one is 0."""
    return abs(a - b) / (min(abs(a), abs(b)) or 1.0)


def rounding(test, rows):
    """What one rounding of a place does to a grain in one step by a linear spring, to its place, speed, spin and torque: {column: number}. A grain at
    rest has such a speed, or a remainder of its settling that has become as small, which no two programs have alike."""
    step = math.ulp(max(abs(row[c]) for row in rows.values() for c in "xyz"))
    force = float(test.variables.get("knorm", 0)) * step
    dt, mass, radius = time_step(test), min(row["mass"] for row in rows.values()), max(row["radius"] for row in rows.values())
    of = {"run_pos": step, "run_vel": force * dt / mass, "run_omega": force * radius * dt / (0.4 * mass * radius ** 2), "run_torque": force * radius}
    return {c: of[block] for block, columns in BLOCKS.items() for c in columns}


@dataclasses.dataclass
class Apart:
    """The largest off() of what two runs have, where it is, and the largest of numbers which differ by more than a rounding()."""
    largest: float = 0.0
    where: str = ""
    real: float = 0.0

    def passes(self, tolerance):
        return YES if self.largest <= tolerance else ROUNDING if self.real <= tolerance else NO


def apart(test, states, others):
    found = Apart()
    for i, rows in enumerate(others):
        least = rounding(test, states[i])
        for atom, row in rows.items():
            for name in least.keys() & row.keys():
                a, b = states[i][atom][name], row[name]
                if off(a, b) > found.largest:
                    found.largest, found.where = off(a, b), f"{name} of {b:.1e} by {abs(a - b):.1e}"
                if abs(a - b) > least[name]:
                    found.real = max(found.real, off(a, b))
    return found


def worst(found):
    """One Apart of several."""
    return Apart(*max((f.largest, f.where) for f in found), max(f.real for f in found))


def relative(expected, seen):
    return abs(seen - expected) / abs(expected)


def size(row, *columns):
    return math.hypot(*(row[c] for c in columns))


def freefall(v, rows, t):
    return [relative(v["z0"] - v["grav"] * t * t / 2, rows[1]["z"]), relative(-v["grav"] * t, rows[1]["vz"])]


def bounce_height(v, rows, _):
    """The top of a bounce of hard grains, from place and speed on the way."""
    top = rows[1]["z"] + rows[1]["vz"] ** 2 / (2 * v["grav"])
    return [relative(v["radius"] + v["en"] ** (2 * v["bounce_k"]) * (v["h0"] - v["radius"]), top)]


def stack_energy(v, rows, _):
    """Two grains between two walls on springs lose nothing."""
    def energy(low, high, v_low=0.0, v_high=0.0):
        r, s = rows[1]["radius"], rows[2]["radius"]
        overlaps = (r - (low - v["ylo"]), s - (v["yhi"] - high), r + s - (high - low))
        return rows[1]["mass"] * (v_low ** 2 / 2 + v["grav"] * low) + rows[2]["mass"] * (v_high ** 2 / 2 + v["grav"] * high) + \
            sum(v["knorm"] * max(d, 0) ** 2 / 2 for d in overlaps)
    return [relative(energy(v["y1"], v["y2"]), energy(rows[1]["y"], rows[2]["y"], rows[1]["vy"], rows[2]["vy"]))]


def slip_cessation(v, rows, _):
    return [relative(5 / 7 * v["u0"], rows[1]["vx"]), relative(5 / 7 * v["u0"] / v["radius"], rows[1]["omegay"])]


def oblique_impact(v, rows, _):
    slowed = v["xmu"] * (1 + v["en"]) * v["vz_in"]
    return [relative(v["en"] * v["vz_in"], rows[1]["vz"]), relative(v["vx_in"] - slowed, rows[1]["vx"]), relative(2.5 * slowed / v["radius"], rows[1]["omegay"])]


def energy_dissipation(v, rows, _):
    """What an impact gains, over what it had."""
    after = size(rows[1], "vx", "vy", "vz") ** 2 + 0.4 * (rows[1]["radius"] * size(rows[1], "omegax", "omegay", "omegaz")) ** 2
    return [after / (v["vx_in"] ** 2 + v["vz_in"] ** 2) - 1]


def rolling_decay(v, rows, t):
    return [relative(v["omega0"] - 2.5 * v["mur"] * v["grav"] / rows[1]["radius"] * t, rows[1]["omegay"])]


def collision_restitution(v, rows, _):
    momentum = rows[1]["mass"] * rows[1]["vx"] + rows[2]["mass"] * rows[2]["vx"]
    return [relative(v["en"], (rows[2]["vx"] - rows[1]["vx"]) / (2 * v["vin"])), abs(momentum) / ((rows[1]["mass"] + rows[2]["mass"]) * v["vin"])]


def spin_impact(v, rows, _):
    pushed = v["xmu"] * (1 + v["en"]) * v["vin"]
    return [relative(v["en"] * v["vin"], rows[1]["vz"]), relative(pushed, rows[1]["vx"]), relative(v["omega0"] - 2.5 * pushed / v["radius"], rows[1]["omegay"])]


def spin_no_friction(v, rows, _):
    return [relative(v["omega0"], rows[1]["omegay"]), abs(rows[1]["vx"]), abs(rows[1]["vy"])]


def pulloff_dmt(v, rows, _):
    """The pull without overlap; that of Hertz at the overlap of 1e-5 is 1.5e-5 of it."""
    return [relative(4 * math.pi * v["coh"] * v["reff"], size(rows[1], "fx", "fy", "fz"))]


def hertz_normal_impact(v, rows, _):
    """At the greatest overlap F d 2/5 is all that the impact had."""
    if 2 in rows:
        overlap = rows[1]["radius"] + rows[2]["radius"] - math.dist(*([rows[i][c] for c in "xyz"] for i in (1, 2)))
    else:
        overlap = rows[1]["radius"] - rows[1]["z"] + v["floor"]
    return [relative(v["mred_factor"] * rows[1]["mass"] * v["vrela"] ** 2 / 2, 0.4 * size(rows[1], "fx", "fy", "fz") * overlap)]


def angle_of_repose(v, rows, _):
    """How far the heap's angle is out of the band, in degrees."""
    x, y = (sum(row[c] for row in rows.values()) / len(rows) for c in "xy")
    reach = max(math.hypot(row["x"] - x, row["y"] - y) for row in rows.values())
    angle = math.degrees(math.atan2(max(row["z"] for row in rows.values()) - v["floor"], reach))
    return [max(v["aor_lo"] - angle, angle - v["aor_hi"], 0.0)]


FORMS = {f.__name__: f for f in (freefall, bounce_height, stack_energy, slip_cessation, oblique_impact, energy_dissipation, rolling_decay, collision_restitution,
                                 spin_impact, spin_no_friction, pulloff_dmt, hertz_normal_impact, angle_of_repose)}


def numbers(words):
    out = {}
    for name, word in words.items():
        try:
            out[name] = float(word)
        except ValueError:
            pass
    return out


def time_step(test):
    return float(re.search(r"^timestep +(\S+)", test.keys["pre_commands"], re.M)[1])


def off_form(test, states):
    """How far the closed form is off, in the way of its tolerance; nothing without one."""
    if not test.form:
        return None
    run = int(test.keys["analytic_segment"])
    run = len(test.steps) - 1 if run < 0 else run
    return max(FORMS[test.form](numbers(test.variables), states[run], sum(test.steps[:run + 1]) * time_step(test)))


# ---- rows --------------------------------------------------------------------------------

ROW = ("test", "ours", "tolerance", *AT_WALLS, "passes", "form", "off_form", "form_tolerance", "nudged", "why")


def own_styles_run():
    """Whether LAMMPS's own styles are run, too: those of 29Sep2021 lack coeff_restitution, and with -sf kk they are others."""
    return lmp.ON_HOST and not lmp.ON_KOKKOS


def run_all(test, folder):
    """States at each wall with newton on and off: {(wall, newton): states}."""
    walls = [wall for wall in test.walls if wall != PLANE or own_styles_run()]
    return {(wall, newton): run_test(test, wall, newton, folder) for wall in walls for newton in NEWTON}


def run_nudged(test, folder):
    """How far LAMMPS's own styles come from the file when the last digit of a length is changed."""
    return worst([apart(test, run_test(nudged(test, towards), PLANE, newton, folder), test.seen) for towards in (math.inf, -math.inf) for newton in NEWTON])


def row_of(name, folder):
    """The row of a file."""
    row = dict.fromkeys(ROW, "")
    row["test"] = name
    if name in NOTHING_OF_OURS:
        return {**row, "passes": NOT_RUN, "why": NOTHING_OF_OURS[name]}
    test = read_test(FILES / f"{name}.yaml")
    row.update(ours=" and ".join(word for word, there in (("wall", test.has_wall), ("pair", test.has_pair)) if there), tolerance=f"{test.tolerance:g}")
    states = run_all(test, folder)
    forms = [off_form(test, s) for s in states.values()]
    if test.form:
        row.update(form=test.form, off_form=f"{max(forms):.2g}", form_tolerance=f"{float(test.keys['analytic_tol']):g}")
    if not any(test.seen):
        return {**row, "tolerance": "", "passes": FORM_ALONE}
    found = {wall: worst([apart(test, s, test.seen) for (w, _), s in states.items() if w == wall]) for wall in test.walls if (wall, "on") in states}
    row.update({wall: f"{f.largest:.2g}" for wall, f in found.items()})
    of_ours = worst([f for wall, f in found.items() if wall != PLANE])
    row.update(passes=of_ours.passes(test.tolerance), why="" if of_ours.passes(test.tolerance) == YES else of_ours.where)
    if name in GROWS and own_styles_run():
        control = run_nudged(test, folder)
        row.update(nudged=f"{control.real:.2g}", passes=GROWTH if of_ours.real <= control.real else NO)
    return row


def kept_rows():
    return list(csv.DictReader((line for line in KEPT.read_text().splitlines() if not line.startswith("#")), delimiter="\t"))


def main():
    keep, chosen = "--keep" in sys.argv[1:], [word for word in sys.argv[1:] if word != "--keep"] or names()
    if not chosen:
        raise SystemExit(f"no YAML files in {FILES}: LSDCD_HOST names the folder of tests/lammps/hosts/build_host.sh")
    lines = ["\t".join(ROW)]
    print(lines[0])
    for name in chosen:
        with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
            row = row_of(name, pathlib.Path(folder))
        lines.append("\t".join(row[column] for column in ROW))
        print(lines[-1], flush=True)
    if keep:
        import rows as bench_rows
        KEPT.write_text(f"# commit {bench_rows.commit()}, {bench_rows.cpu()}\n" + "\n".join(lines) + "\n")
        subprocess.run([sys.executable, str(HERE.parent.parent / "bench" / "pages.py")], check=True)


if __name__ == "__main__":
    main()
