# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The page of a run, lsdcd.report: names of all numbers as the pages have them, means as numpy makes them, what is read of damaged and
half-written files, and how large it is."""
import http.client
import pathlib
import random
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time

import numpy as np
import pytest

from facts import at_most, fact
from lsdcd import _run_files, report
from runs import TRIANGLE, data_of, dump_text, grains, log_text, said_by, unpacked, vtp_text, write_run

PAGES = pathlib.Path(__file__).resolve().parents[2] / "doc"
SI = {"force units": "N", "torque units": "N m", "": "", "volume units": "m³", "energy/time units": "W", "energy units": "J", "distance units": "m",
      "velocity units": "m/s", "radians": "rad", "radians/time": "rad/s", "mass": "kg", "mass/time": "kg/s", "energy/time": "W", "energy": "J"}


def elements_of_page(page):
    """[(element, name, what it is, unit)] of the first table on a page, read line by line; the scalar is element 0."""
    found = []
    for line in (PAGES / f"{page}.rst").read_text(encoding="utf-8").splitlines():
        row = re.match(r'   (scalar|\d+(?:-\d+)?), (?:"([^"]*)"|([^,]*)), (?:"([^"]*)"|([^,]*)),(?: (?:"([^"]*)"|([^,]*)))?(?:,|$)', line)
        if not row:
            if found:
                return found
            continue
        first = 0 if row[1] == "scalar" else int(row[1].split("-")[0])
        for k, name in enumerate((row[2] or row[3]).split(", ")):
            found.append((first + k if first else 0, name, row[4] or row[5], (row[6] or row[7] or "").strip()))
    return found


STYLES = [("f_w", "drum", "wall_output"), ("f_out", "out", "fix_massflow_lsdcd"), ("f_feed", "feed", "fix_insert_lsdcd"),
          ("c_balls", "balls", "compute_lsdcd_energy"), ("c_hits", "hits", "compute_lsdcd_impacts"),
          ("c_hit", "hit", "compute_lsdcd_collide")]


def numbers_with(folder, heads):
    (folder / "log.lammps").write_text(log_text(heads, [[k + 1.0 for k in range(len(heads))]] * 12), encoding="utf-8")
    return {row["head"]: row for row in data_of(folder)["numbers"]}


def fresh(folder, name):
    shutil.rmtree(folder / name, ignore_errors=True)
    (folder / name).mkdir()
    return folder / name


@pytest.mark.parametrize("reference, prefix, page", STYLES)
def test_names(folder, reference, prefix, page):
    """Each number of a style, by its element and by its variable, has the name, the meaning and the unit of its page."""
    table = elements_of_page(page)
    fact("the page has a table", len(table) > 1, len(table))
    of_element = {f"{reference}[{element}]" if element else reference: row for element, *row in table}
    of_name = {f"v_{prefix}_{name}": row for row in of_element.values() for name in row[:1]}
    wanted = {**of_element, **of_name}
    numbers = numbers_with(fresh(folder, prefix), list(wanted))
    for head, (name, meaning, unit) in wanted.items():
        row = numbers[head]
        plain = unit.split(";")[0]
        fact(f"{head} is {name}", (row["name"], row["meaning"], row["unit"]) == (name, meaning.replace("*", ""), SI.get(plain, plain.replace(" units", ""))),
             (row["name"], row["meaning"], row["unit"]))


def test_names_of_one_mesh(folder):
    table = [row for row in elements_of_page("wall_output") if row[0]]
    numbers = numbers_with(fresh(folder, "mesh"), [f"f_w[2][{row[0]}]" for row in table] + [f"v_lid_{row[1]}" for row in table])
    for element, name, *_ in table:
        fact(f"f_w[2][{element}] is of mesh 2", (numbers[f"f_w[2][{element}]"]["name"], numbers[f"f_w[2][{element}]"]["owner"]) == (name, "mesh 2 of fix w"))
        fact(f"v_lid_{name} is of mesh lid", (numbers[f"v_lid_{name}"]["name"], numbers[f"v_lid_{name}"]["owner"]) == (name, "mesh lid of fix w"))


def test_elements_that_there_are_not(folder):
    heads = ["f_w[78]", "f_w[0]", "f_out[9]", "f_out", "c_balls[25]", "c_hits[3]", "c_hits[2][1]", "f_none[1]", "v_drum_colour", "v_other"]
    numbers = numbers_with(fresh(folder, "none"), heads)
    for head in heads:
        fact(f"{head} has no name of LSDCD's", numbers[head]["owner"] == "", numbers[head])


def test_means_are_those_of_numpy(folder):
    """Means of the second half of the rows, to rounding, and two standard errors of ten blocks."""
    at = fresh(folder, "means")
    rows = np.random.default_rng(5).lognormal(sigma=5, size=(1237, 4)) - 2
    heads = ["v_drum_power", "f_w[3]", "KinEng", "v_other"]
    (at / "log.lammps").write_text(log_text(heads, rows), encoding="utf-8")
    half = rows[1237 // 2:]
    for number, column in zip(data_of(at)["numbers"], half.T):
        at_most(f"mean of {number['head']}", abs(number["mean"] - np.mean(column)) / abs(np.mean(column)), 1e-12)
        means = [statistics.fmean(block) for block in np.array_split(column, 10)]
        at_most(f"error of {number['head']}", abs(number["error"] / (2 * statistics.stdev(means) / 10 ** 0.5) - 1), 1e-12)
        fact(f"bounds of {number['head']}", (number["least"], number["most"], number["last"]) == (column.min(), column.max(), column[-1]))


def test_sums_have_a_rate(folder):
    at = fresh(folder, "sums")
    rows = np.cumsum(np.random.default_rng(6).random((201, 1)), axis=0)
    (at / "log.lammps").write_text(log_text(["v_drum_drive_work"], rows), encoding="utf-8")
    number = data_of(at)["numbers"][0]
    half = rows[100:, 0]
    at_most("how fast it rises", abs(number["rate"] / ((half[-1] - half[0]) / ((len(half) - 1) * 100 * 1e-4)) - 1), 1e-12)
    fact("in watts", number["rate_unit"] == "W")


def test_averages_of_a_run(folder):
    """Columns of fix ave/time are those of its file, and of the fix where thermo output has them."""
    at = fresh(folder, "averages")
    text = log_text(["f_mean[2]"], [[1.0]] * 12).replace("run  ", "fix mean all ave/time 10 20 200 v_drum_power f_w[3] file mean.txt\nrun  ")
    (at / "log.lammps").write_text(text, encoding="utf-8")
    (at / "mean.txt").write_text("# Time-averaged data for fix mean\n# TimeStep v_drum_power f_w[3]\n" + "".join(f"{200 * k} {k} {k * k}\n" for k in range(21)))
    numbers = data_of(at)["numbers"]
    fact("of thermo output", (numbers[0]["name"], numbers[0]["meaning"]) == ("force_z", "mean by fix mean of force on the mesh, x y z"), numbers[0])
    fact("of the file", [(n["name"], n["source"], n["mean"]) for n in numbers[1:]] == [
        ("power", "mean.txt", np.mean(np.arange(10, 21))), ("force_z", "mean.txt", np.mean(np.arange(10, 21) ** 2))], numbers[1:])


def test_runs_follow_one_another(folder):
    """The first row of a second run repeats the last step of the first one, and counts once."""
    at = fresh(folder, "runs")
    first = log_text(["KinEng"], [[1.0], [2.0], [3.0]], end=False)
    (at / "log.lammps").write_text(first + "Loop time of 1\nrun 100\nStep KinEng v_drum_power\n200 30 7\n300 4 8\nLoop time of 1\nTotal wall time: 0:00:01\n")
    table = _run_files.read_log(at / "log.lammps").table()
    fact("rows of both", table["KinEng"].tolist() == [1, 2, 30, 4], table)
    fact("a column of one", np.isnan(table["v_drum_power"][:2]).all() and table["v_drum_power"][2:].tolist() == [7, 8], table)


WARNED = "WARNING: Fix w wall/lsdcd: timestep 1e-4 is more than a tenth of the shortest contact time 5e-4: contacts will not be resolved (src/x.cpp:1)\n"
CHECKS = [    # lines of a log, the beginning of a check, what it is
    ("", "Overlap", "open"),
    ("Fix w wall/lsdcd: the deepest overlap of this run is 4.13 % of the radius of atom 1, at mesh 1 'drum.stl' in step 3\n", "Overlap: 4.13 %", "good"),
    ("Fix w wall/lsdcd: the deepest overlap of this run is 7.1 % of the radius of atom 1, at mesh 1 'drum.stl' in step 3\n", "Overlap: 7.1 %", "warn"),
    ("Fix w wall/lsdcd: the deepest overlap of this run is 15.8 % of the radius of atom 1, at mesh 1 'drum.stl' in step 3\n", "Overlap: 15.8 %", "bad"),
    (WARNED, "Timestep: a contact takes 5 steps", "bad"),
    ("", "Timestep: a contact with the wall takes ten", "good"),
    ("Pair style granular/lsdcd: the shortest contact, of types 1 and 1, lasts 0.005: the timestep should be at most 0.0005\n", "Timestep: a contact between grains takes 50 steps", "good"),
    ("WARNING: Lost atoms: original 100 current 97 (src/thermo.cpp:1)\n", "Grains: 3 of 100", "bad"),
    ("", "Grains: none was lost", "good"),
    ("", "Log: no warning", "good"),
    (WARNED, "Log: 1 warning,", "warn"),
    ("ERROR: out of range (src/x.cpp:1)\n", "The run has ended with an error", "bad"),
    ("Dangerous builds = 3\n", "Neighbor lists: 3", "warn"),
]


@pytest.mark.parametrize("line, said, kind", CHECKS)
def test_checks(folder, line, said, kind):
    at = fresh(folder, "checks")
    (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3).replace("Loop time", line + "Loop time"), encoding="utf-8")
    checks = data_of(at)["checks"]
    fact(said, any(words.startswith(said) and is_kind == kind for is_kind, words in checks), checks)


@pytest.mark.parametrize("missing, kind", ((1e-3, "good"), (5e-3, "warn"), (5e-2, "bad")))
def test_check_of_the_energy_balance(folder, missing, kind):
    at = fresh(folder, "balance")
    (at / "log.lammps").write_text(log_text(["v_drum_drive_work", "v_drum_remainder", "v_balls_remainder"], [[10.0, 4 * missing, 6 * missing]] * 4))
    check = next(check for check in data_of(at)["checks"] if check[1].startswith("Energy balance"))
    fact(f"it misses {missing:.2g}", check[0] == kind and f"misses {missing:.2g} of the work of the drive" in check[1], check)


# ---- the view ----------------------------------------------------------------------------


def test_grains_are_those_of_the_dump(folder):
    """Places to 16 bits, speeds to a part in 3000, kinds, in each snapshot, whatever the order of its rows."""
    at = fresh(folder, "grains")
    write_run(at)
    seen = data_of(at)["view"]["grains"]
    rows = {k: grains(200, k) for k in range(6)}
    low, high = (f([f(r[:, 2:5], axis=0) for r in rows.values()], axis=0) for f in (np.min, np.max))
    fact("as many snapshots", len(seen["frames"]) == 6)
    for k, frame in enumerate(seen["frames"]):
        codes = unpacked(frame["codes"], "<u2").reshape(6, -1).astype(float)
        r = rows[k][np.argsort(rows[k][:, 0])]
        at_most("places", np.abs(codes[:3].T / 65535 * (high - low) + low - r[:, 2:5]).max(), 1e-5)
        at_most("radii", np.abs(codes[3] / 65535 * seen["largest"] - r[:, 8]).max(), 1e-6)
        speed = np.sqrt((r[:, 5:8] ** 2).sum(axis=1))
        at_most("speeds", np.abs(seen["largest_speed"] * 1e9 ** ((codes[4] - 65535) / 65534) / speed - 1).max(), 3e-4)
        fact("kinds", np.array_equal(codes[5], r[:, 1]))


def test_bounds_are_those_of_all_frames(folder):
    at = fresh(folder, "bounds")
    write_run(at)
    (at / "wall_400.vtp").write_text(vtp_text([[9, 0, 0], [10, 0, 0], [9, 1, 0], [9, 0, -7]], TRIANGLE[1], {"normal_stress": [1, 1]}))
    view = data_of(at)["view"]
    fact("the farthest place of a mesh is within", view["high"][0] == 10 and view["low"][2] == -7, (view["low"], view["high"]))


def test_colours_end_at_the_quantile_of_a_mesh(folder):
    """98 % of the numbers that are not 0, of each mesh for itself."""
    at = fresh(folder, "quantile")
    (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3), encoding="utf-8")
    n = 400
    points, triangles = np.random.default_rng(1).random((3 * n, 3)), np.arange(3 * n).reshape(-1, 3)
    values = {name: np.random.default_rng(k).pareto(1, n) * 10 ** k for k, name in enumerate(("a", "b"))}
    for name, field in values.items():
        (at / f"{name}_100.vtp").write_text(vtp_text(points, triangles, {"worn_depth": field}))
        (at / f"{name}_series.pvd").write_text(f'<DataSet timestep="0.01" part="0" file="{name}_100.vtp"/>\n')
    for mesh in data_of(at)["view"]["meshes"]:
        field = mesh["fields"]["worn_depth"]
        at_most(mesh["name"], abs(field["top"] / np.quantile(values[mesh["name"]], 0.98) - 1), 1e-12)
        fact("the largest one is named", field["largest"] == values[mesh["name"]].max())
        codes = unpacked(field["codes"], "<u2").astype(float)
        at_most("numbers", np.abs(field["largest"] * 1e9 ** ((codes - 65535) / 65534) / values[mesh["name"]] - 1).max(), 3e-4)


def test_a_rigid_mesh_is_kept_once(folder):
    at = fresh(folder, "rigid")
    write_run(at)
    points = np.array(TRIANGLE[0], float)
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    (at / "wall_200.vtp").write_text(vtp_text(points @ turn.T + (1, 2, 3), TRIANGLE[1], {"normal_stress": [1, 1]}))
    (at / "wall_300.vtp").write_text(vtp_text(points * (1, 1, 2), TRIANGLE[1], {"normal_stress": [1, 1]}))
    frames = data_of(at)["view"]["meshes"][0]["frames"]
    at_most("rotation and shift", np.abs(np.array(frames[1]["pose"]) - [*turn.ravel(), 1, 2, 3]).max(), 1e-9)
    fact("one that is stretched has its own places", frames[2]["pose"] is None and frames[2]["points"])


def test_meshes_without_files_are_those_of_the_log(folder):
    """drum.stl has scale 0.001; a mesh that is not in the folder is named."""
    at = fresh(folder, "still")
    write_run(at)
    (at / "drum.stl").write_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2000 0 0\nvertex 0 1000 0\nendloop\nendfacet\nendsolid\n")
    data = data_of(at)
    mesh = next(m for m in data["view"]["meshes"] if m["name"] == "drum")
    fact("it is placed", np.allclose(np.array(mesh["low"]) + mesh["size"], (2, 1, 1)) and np.allclose(mesh["low"], 0), (mesh["low"], mesh["size"]))
    fact("that it stays is told", "drum is drawn where it began" in data["view"]["thinned"], data["view"]["thinned"])
    fact("another is named", any("mesh 'lid' is not drawn" in note and "lid.stl" in note for note in data["notes"]), data["notes"])


def test_large_meshes_have_fewer_frames(folder, monkeypatch):
    at = fresh(folder, "fewer")
    write_run(at)
    monkeypatch.setattr(report, "MESH_BYTES", 3 * (at / "wall_100.vtp").stat().st_size)
    data = data_of(at)
    fact("three of four", len(data["view"]["meshes"][0]["frames"]) == 3, len(data["view"]["meshes"][0]["frames"]))
    fact("it is told", "of the 4 large files of mesh 'wall' 3 are shown" in data["notes"], data["notes"])


def test_coarser_meshes():
    """Fewer triangles, on the same places to the width of a cell, and the largest number of each field stays."""
    n = 60
    points = np.array([[x, y, 0.3 * np.sin(x)] for x in np.linspace(0, 6, n) for y in np.linspace(0, 6, n)])
    corners = np.arange(n * n).reshape(n, n)
    triangles = np.concatenate([np.stack([corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:]], axis=-1).reshape(-1, 3),
                                np.stack([corners[:-1, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=-1).reshape(-1, 3)])
    values = np.random.default_rng(2).random(len(triangles))
    made = report.coarser(_run_files.Surface(points, triangles, {"worn_depth": values}), 20)
    fact("fewer", 400 < len(made.triangles) < 1200 < len(triangles), len(made.triangles))
    area = np.linalg.norm(np.cross(*(made.points[made.triangles[:, k]] - made.points[made.triangles[:, 0]] for k in (1, 2))), axis=1).sum() / 2
    whole = np.linalg.norm(np.cross(*(points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2))), axis=1).sum() / 2
    at_most("their area", abs(area / whole - 1), 0.05)
    far = np.abs(made.points[made.triangles].mean(axis=1)[:, None, :2] - points[None, ::7, :2]).max(axis=2).min(axis=1)
    at_most("their places", far.max(), 6 / 20 * 2)
    fact("numbers are some of those that there were", set(made.fields["worn_depth"]) <= set(values))
    fact("none is above the largest, which stays nearly", 0.99 * values.max() < made.fields["worn_depth"].max() <= values.max())


def test_placement():
    """scale, rotate, move and matrix, in their order, against products of matrices."""
    words = "drum.stl scale 2 3 4 rotate 0 0 2 90 move 1 0 0 matrix 0 1 0 5 1 0 0 6 0 0 1 7 motion rotate 0 0 0 0 1 0 3".split()
    mesh = _run_files.meshes_of(["mesh", *words])[0]
    p = np.array([[1.0, 2.0, 3.0]])
    q = p * (2, 3, 4)
    q = np.column_stack([-q[:, 1], q[:, 0], q[:, 2]]) + (1, 0, 0)
    q = np.column_stack([q[:, 1] + 5, q[:, 0] + 6, q[:, 2] + 7])
    at_most("all four", np.abs(_run_files.placed(p, mesh.placement) - q).max(), 1e-12)
    fact("what moves is known", mesh.moves)


# ---- files that are damaged, half-written or large ---------------------------------------


def test_random_cuts(folder):
    """Of 200 files that are cut anywhere each gives a page that a browser can read, or one error of a line."""
    at = fresh(folder, "cuts")
    write_run(at, 20)
    whole = {name: (at / name).read_bytes() for name in ("log.lammps", "grains.dump", "wall_400.vtp", "spectrum_4000.csv", "mean.txt", "out.txt", "wall_series.pvd")}
    chance, pages = random.Random(113), 0
    for k in range(200):
        name = list(whole)[k % len(whole)]
        n = chance.randrange(len(whole[name]))
        (at / name).write_bytes(whole[name][:n])
        try:
            pages += bool(data_of(at)["checks"])
        except report.InputError as error:
            fact(f"{name} cut at {n} gives one line", "\n" not in str(error) and "log" in str(error), error)
        (at / name).write_bytes(whole[name])
    fact("nearly all are pages", pages > 190, pages)


def test_random_bytes(folder):
    """The same with bytes that are others."""
    at = fresh(folder, "bytes")
    write_run(at, 20)
    chance, told = random.Random(114), 0
    for k in range(100):
        name = ("log.lammps", "grains.dump", "wall_400.vtp", "spectrum_4000.csv", "mean.txt", "out.txt", "wall_series.pvd")[k % 7]
        whole = (at / name).read_bytes()
        damaged = bytearray(whole)
        for _ in range(3):
            damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        (at / name).write_bytes(bytes(damaged))
        try:
            told += bool(data_of(at)["notes"])
        except report.InputError as error:
            fact(f"{name} gives one line", "\n" not in str(error), error)
        (at / name).write_bytes(whole)
    fact("what is left out is told", told > 10, told)


@pytest.mark.parametrize("name, text, said", (
    ("mean.txt", "# Time-averaged data for fix mean\n# TimeStep v_drum_power\n100 1\n200 zero\n", "mean.txt:4: '200 zero' is no row of 2 numbers"),
    ("spectrum_4000.csv", "energy_from,energy_to,impacts,energy\n1,2,3\n", "spectrum_4000.csv:2: '1,2,3' is no row of 4 numbers"),
    ("between_4000.csv", "type_i,type_j,energy_from,energy_to,impacts,energy,energy_i,energy_j\n1,2,3\n", "between_4000.csv:2: '1,2,3' is no row of 8 numbers"),
    ("out.txt", "# step time id type diameter x y z vx vy vz direction\n1 2\n", "out.txt:2: '1 2' is no row of 12 numbers"),
    ("wall_400.vtp", "<VTKFile>", "wall_400.vtp is not whole"),
    ("grains.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n1 0 0 0\n", "the snapshot of step 0 in grains.dump is not whole")))
def test_what_is_left_out_is_told(folder, name, text, said):
    """With its file, line and value."""
    at = fresh(folder, "told")
    write_run(at)
    (at / name).write_text(text)
    notes = data_of(at)["notes"]
    fact(said, any(said in note for note in notes), notes)


def test_impacts_between_grains(folder):
    """The last file of compute lsdcd/impacts has a spectrum for each pair of types, beside those of meshes."""
    at = fresh(folder, "between")
    write_run(at)
    head = "type_i,type_j,energy_from,energy_to,impacts,energy,energy_i,energy_j\n"
    (at / "between_100.csv").write_text(head + "1,1,1,1.25,3,3.3,1.65,1.65\n")
    (at / "between_900.csv").write_text(head + "1,1,1,1.25,4,4.4,2.2,2.2\n1,2,1.25,1.6,1,1.3,1,0.3\n1,2,1.6,2,2,3.5,2.5,1\n")
    found = {of["name"]: of["rows"] for of in data_of(at)["spectra"]}
    fact("of types 1 and 1", found.get("grains of types 1 and 1, to step 900") == [[1, 1.25, 4, 4.4]], found)
    fact("of types 1 and 2", found.get("grains of types 1 and 2, to step 900") == [[1.25, 1.6, 1, 1.3], [1.6, 2, 2, 3.5]], found)
    fact("those of the mesh are there, too", len(found) == 3, found)


def command(*words, cwd=None):
    return subprocess.run([sys.executable, "-m", "lsdcd.report", *map(str, words)], cwd=cwd, text=True, capture_output=True, check=False)


@pytest.mark.parametrize("words, code, said", (
    (["nowhere"], 1, "'nowhere' is no folder"),
    (["empty"], 1, "has no log of LAMMPS (log.lammps)"),
    (["run", "--log", "log.other"], 1, "there is no log 'log.other'"),
    (["run", "-o", "page.txt"], 1, "end the name in .html"),
    (["run", "-o", "nowhere/page.html"], 1, "cannot be written: No such file or directory"),
    (["none"], 1, "is no log of LAMMPS, or has no line yet"),
    (["run", "--megabytes", "0"], 2, "'0' is no number above 0"),
    (["run", "--follow", "soon"], 2, "'soon' is no number above 0"),
    (["run", "--serve", "80000"], 2, "'80000' is no port"),
    (["run", "--serve", "8000", "--follow", "5"], 2, "not allowed with"),
    ([], 2, "folder")))
def test_refused(folder, words, code, said):
    at = fresh(folder, "refused")
    for name in ("run", "empty", "none"):
        (at / name).mkdir()
    write_run(at / "run")
    (at / "none" / "log.lammps").write_bytes(bytes(range(256)) * 10)
    done = command(*words, cwd=at)
    fact(f"{' '.join(words)}: {said}", done.returncode == code and said in done.stderr and "Traceback" not in done.stderr, done.stderr[-300:])


def test_nothing_of_the_page_is_elsewhere(folder):
    """One file without an address, whatever texts the run has."""
    at = fresh(folder, "a & <b>")
    write_run(at)
    with open(at / "log.lammps", "a", encoding="utf-8") as log:
        log.write("WARNING: </script><script>alert(1)</script>\n")
    page = report.report(at)
    fact("no address", not re.search(r"(src|href)=[\"'](?!data:,)|url\(|https?://|import\s|fetch\(|XMLHttpRequest|WebSocket", page))
    fact("a text of the log ends no script", page.count("</script>") == 2 and said_by(page)["warnings"] == ["WARNING: </script><script>alert(1)</script>"])
    fact("the name of the folder is a text", "<title>a &amp; &lt;b&gt;: lsdcd report</title>" in page)


@pytest.mark.parametrize("megabytes", (0.95, 0.3, 0.12))
def test_size(folder, megabytes):
    """Grains, frames and triangles are left out, which the page tells, so that it is no larger than is asked for."""
    at = fresh(folder, "size")
    write_run(at)
    (at / "grains.dump").write_text(dump_text({100 * k: grains(3000, k) for k in range(20)}))
    n = 120
    points = np.array([[np.cos(a), np.sin(a), z] for z in np.linspace(0, 1, n) for a in np.linspace(0, 6.28, n)])
    corners = np.arange(n * n).reshape(n, n)
    triangles = np.concatenate([np.stack([corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:]], axis=-1).reshape(-1, 3),
                                np.stack([corners[:-1, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=-1).reshape(-1, 3)])
    for k in range(1, 5):
        (at / f"wall_{100 * k}.vtp").write_text(vtp_text(points, triangles, {"normal_stress": np.random.default_rng(k).random(len(triangles))}))
    page = report.report(at, megabytes)
    at_most("megabytes", len(page.encode()) / 1e6, megabytes)
    data = said_by(page)
    fact("fewer triangles are told", f"of its {len(triangles)} triangles" in data["view"]["thinned"], data["view"]["thinned"])
    fact("fewer grains are told", megabytes > 0.5 or "of 3000 grains" in data["view"]["thinned"], data["view"]["thinned"])
    fact("the same grains are in all frames", len({frame["n"] for frame in data["view"]["grains"]["frames"]}) == 1)


def test_dumps_are_streamed(folder):
    """Ten snapshots of 50 000 grains, 40 MB, in the memory of one of them beside that of Python."""
    at = fresh(folder, "large")
    (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3))
    text = dump_text({0: grains(50000)})
    with open(at / "grains.dump", "w", encoding="utf-8") as file:
        for k in range(10):
            file.write(text.replace("ITEM: TIMESTEP\n0\n", f"ITEM: TIMESTEP\n{100 * k}\n", 1))
    began = time.time()
    done = command(at)
    took = time.time() - began
    fact("a page", done.returncode == 0 and len(said_by((at / "report.html").read_text(encoding="utf-8"))["view"]["grains"]["frames"]) == 10, done.stderr)
    print(f"{took:.1f} s")
    at_most("megabytes of memory", resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024, 200)


# ---- while a run goes on -----------------------------------------------------------------


def test_a_running_run(folder):
    at = fresh(folder, "running")
    write_run(at)
    (at / "log.lammps").write_text(log_text(["v_drum_power"], [[1.0]] * 20, end=False) + "2000 3.5")
    data = data_of(at, follow=7)
    fact("the page loads itself again", data["follow"] == 7)
    fact("a row that is not whole is left out", data["step"] == 1900, data["step"])
    fact("the end is known", data["target"] == 100000 and data["state"] == "running or stopped", data["target"])
    with open(at / "log.lammps", "a", encoding="utf-8") as log:
        log.write("\nLoop time of 1\nTotal wall time: 0:00:01\n")
    data = data_of(at, follow=7)
    fact("a run that has ended is not followed", data["follow"] == 0 and data["done"] and data["step"] == 2000, data["follow"])


def test_follow(folder):
    """The file is written whole each time, and the command ends with the run."""
    at = fresh(folder, "follow")
    write_run(at)
    (at / "log.lammps").write_text(log_text(["v_drum_power"], [[1.0]] * 20, end=False))
    with subprocess.Popen([sys.executable, "-m", "lsdcd.report", at, "--follow", "0.2"], stdout=subprocess.PIPE, text=True) as follower:
        fact("it says what it writes", "report.html: " in follower.stdout.readline())
        with open(at / "log.lammps", "a", encoding="utf-8") as log:
            log.write("Loop time of 1\nTotal wall time: 0:00:01\n")
        fact("it ends", follower.wait(60) == 0)
    fact("the last page is of the end", said_by((at / "report.html").read_text(encoding="utf-8"))["done"])
    fact("nothing else is left", not list(at.glob("*.part-*")))


def test_serve(folder):
    """A browser on this computer is answered with a new page, and with 404 for all else."""
    at = fresh(folder, "serve")
    write_run(at)
    with subprocess.Popen([sys.executable, "-m", "lsdcd.report", at, "--serve", "18113"], stdout=subprocess.PIPE, text=True) as server:
        try:
            fact("it says where", server.stdout.readline().startswith("http://127.0.0.1:18113/"))
            ask = http.client.HTTPConnection("127.0.0.1", 18113, timeout=60)
            ask.request("GET", "/")
            answer = ask.getresponse()
            fact("the page", answer.status == 200 and said_by(answer.read().decode())["numbers"])
            ask = http.client.HTTPConnection("127.0.0.1", 18113, timeout=60)
            ask.request("GET", "/log.lammps")
            fact("no file of the folder", ask.getresponse().status == 404)
        finally:
            server.terminate()
