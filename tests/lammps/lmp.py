# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs input scripts under lmp-lsdcd and reads what they dump. Standard library only."""

import functools
import os
import pathlib
import re
import subprocess
import tempfile
import time

import pytest

from facts import fact

CXX = os.environ.get("LSDCD_CXX", "c++")
HERE = pathlib.Path(__file__).resolve().parent
LMP = os.environ.get("LSDCD_LMP", str(HERE.parent.parent / "build" / "bin" / "lmp-lsdcd"))
LIB = pathlib.Path(LMP).resolve().parent.parent / "lib"

# The small samples of ./run test.
QUICK = bool(os.environ.get("LSDCD_QUICK"))

# Another LAMMPS, the plugin for it (none where the styles are compiled in), and words of its command line: that of
# hosts/build_host.sh, one with Kokkos, with MPICH or without MPI. HOST is empty where there is none. With LSDCD_ON_HOST
# scripts run there. On a GPU the words are "-k on g 1 -sf kk -pk kokkos newton off neigh half".
HOST = os.environ.get("LSDCD_HOST", "") and os.environ["LSDCD_HOST"] + "/lmp"
PLUGIN = os.environ.get("LSDCD_HOST_PLUGIN", "")
FLAGS = tuple(os.environ.get("LSDCD_HOST_FLAGS", "").split())
ON_HOST = bool(os.environ.get("LSDCD_ON_HOST"))
ON_KOKKOS = ON_HOST and "-sf" in FLAGS
# Atoms are sorted and exchanged by Kokkos's kernels, as on a GPU, which fix wall/gran would not allow; on a host without one
# Kokkos leaves that to LAMMPS.
DEVICE_MOVES = "device" in FLAGS
ON_GPU = ON_KOKKOS and "g" in FLAGS
# What starts several processes of it, and how many at most: those of MPICH never give up a core while they wait.
MPIRUN = os.environ.get("LSDCD_MPIRUN", "mpirun --oversubscribe").split()
MOST_RANKS = int(os.environ.get("LSDCD_MOST_RANKS", "1000"))

# The test is of another LAMMPS, and there is none.
if ON_HOST and not HOST:
    pytest.skip("no LAMMPS 4Jul2026 of this kind (tests/lammps/hosts/build_all.sh)", allow_module_level=True)

of_host = pytest.mark.skipif(not ON_HOST, reason="no other LAMMPS (tests/lammps/hosts/build_host.sh)")
needs_host = pytest.mark.skipif(not HOST, reason="no other LAMMPS (tests/lammps/hosts/build_host.sh)")
of_kokkos = pytest.mark.skipif(not ON_KOKKOS, reason="no LAMMPS with Kokkos (tests/lammps/hosts/build_host.sh)")


def lines(**commands):
    """Lines of a script, each a command and its words; a command without words is left out."""
    return "".join(f"{name:15} {words}\n" for name, words in commands.items() if words)


def head(box="", boundary="f f f", style="sphere", modify="map array", newton="off", comm="vel yes", types=1, more="", units="lj"):
    """The first lines of a script, to where a box is made, if one is given: a block, or by nine numbers a prism. `more`: before that."""
    shape = "prism" if len(box.split()) == 9 else "block"
    return lines(units=units, atom_style=style, atom_modify=modify, boundary=boundary, newton=newton, comm_modify=comm) + more + \
        lines(region=box and f"box {shape} {box}", create_box=box and f"{types} box")


def pairs(style="zero 1.2", skin=0.3, neigh="delay 0 every 1 check yes", coeff=""):
    """Pairs of spheres, which feel nothing of each other if no other style is given, and the neighbour lists."""
    return lines(pair_style=style, pair_coeff=f"* * {coeff}".rstrip(), neighbor=f"{skin} bin", neigh_modify=neigh)


# Spheres of diameter 1 in a box of side 6: with nothing that moves them, and with it.
SMALL_BOX_AT_REST = head("-3 3 -3 3 -1 5") + """\
{atoms}
set             group all diameter 1.0 density 2.0
pair_style      zero 1.2
pair_coeff      * *
"""
SMALL_BOX = SMALL_BOX_AT_REST + "fix             move all nve/sphere\n"

MPI_FOLDER = tempfile.TemporaryDirectory(prefix="mpi")


def environment(**more):
    """That of LAMMPS, with `more` variables; what these preload comes first."""
    env = dict(os.environ, OMP_NUM_THREADS="1")
    # Open MPI refuses root, more ranks than cores, and binding in some containers.
    env.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
               OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none",
               OMPI_MCA_btl_vader_single_copy_mechanism="none")
    # A process alone needs no daemon, which would take longer than most scripts.
    env.update(OMPI_MCA_ess_singleton_isolated="1")
    # All processes are on one machine: looking for networks takes 0.2 s of each start.
    env.update(OMPI_MCA_pml="ob1", OMPI_MCA_btl="self,vader")
    # No test asks for the machine's cards and displays, whose search takes a quarter of each start.
    env.update(HWLOC_COMPONENTS="-pci,-linuxio", HWLOC_PLUGINS_PATH="/")
    # After an error it gives the others a second or two to end by themselves.
    env.update(OMPI_MCA_odls_base_sigkill_timeout="0")
    # All such processes give their folder the same name and remove it when they end. Each gets a
    # parent folder of its own, so that none removes the folder of another.
    env.update(OMPI_MCA_orte_tmpdir_base=tempfile.mkdtemp(dir=MPI_FOLDER.name))
    # Several processes sleep while they wait for each other (patient_yield.cpp).
    env.update({"OMPI_MCA_mpi_yield_when_idle": "1", **more})
    preloaded = [path for path in (env.get("LD_PRELOAD"), env.get("LSDCD_PATIENT_YIELD")) if path]
    if preloaded:
        env["LD_PRELOAD"] = ":".join(preloaded)
    return env


def set_in_run(every, first, last, **values):
    """Lines with a fix of ID change, by which atoms of these IDs get a type, diameter or density at the end of each so many steps: fix set, or where
    LAMMPS does not have it one that has Python write LAMMPS's arrays. Each value is a formula of id and step that both read."""
    if ON_HOST:
        return "".join(f"variable set_{name} atom {formula}\n" for name, formula in values.items()) + \
            f"fix change all set {every} 0 atom {first}*{last} " + " ".join(f"{name} v_set_{name}" for name in values) + "\n"
    write = {"type": "type[i] = int({})", "diameter": "radius[i] = 0.5 * ({})", "density": "rmass[i] = 4 / 3 * math.pi * radius[i]**3 * ({})"}
    return """python change here \"\"\"
def change(capsule):
    import ctypes, math
    library, pointer = ctypes.CDLL(None), ctypes.pythonapi.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    lammps = ctypes.c_void_p(pointer(capsule, None))
    library.lammps_extract_atom.restype = ctypes.c_void_p
    library.lammps_get_thermo.restype = ctypes.c_double
    def array(name, kind):
        return ctypes.cast(library.lammps_extract_atom(lammps, name), ctypes.POINTER(kind))
    ids, type = array(b"id", ctypes.c_int), array(b"type", ctypes.c_int)
    radius, rmass = array(b"radius", ctypes.c_double), array(b"rmass", ctypes.c_double)
    step = library.lammps_get_thermo(lammps, b"step")
    for i in range(library.lammps_extract_setting(lammps, b"nlocal")):
        id = ids[i]
        if FIRST <= id <= LAST:
            VALUES
\"\"\"
fix change all python/invoke EVERY end_of_step change
""".replace("FIRST", str(first)).replace("LAST", str(last)).replace("EVERY", str(every)).replace(
        "VALUES", "; ".join(write[name].format(formula) for name, formula in values.items()))


def flat_walls(fixes):
    """Lines with LAMMPS's own flat walls. They have no suffix, as not every style of fix wall/gran has a form for Kokkos."""
    return ('if "$(is_active(package,kokkos))" then "suffix off"\n' + fixes.rstrip("\n") +
            '\nif "$(is_active(package,kokkos))" then "suffix on"\n')


@functools.lru_cache(maxsize=None)
def version(host=ON_HOST):
    """Of the LAMMPS, or of the other one: 20210929."""
    said = subprocess.run([HOST if host else LMP, "-h"], env=environment(), text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          stdin=subprocess.DEVNULL, check=False).stdout
    number, date = re.search(r"LAMMPS (\d{8}) with|Simulator - (\d+ \w{3} \d{4})", said).groups()
    return int(number or time.strftime("%Y%m%d", time.strptime(date, "%d %b %Y")))


def column():
    """The letter before the ID of a fix whose per-atom array an atom-style variable reads: F in 29Sep2021, f in later LAMMPS."""
    return "F" if version() < 20220101 else "f"


def has_wrong_walls(host=ON_HOST):
    """Whether fix wall/gran of the LAMMPS, or of the other one, computes hooke/history and hertz/history wrongly: from 28Mar2023 until May 2026."""
    return 20230328 <= version(host) < 20260501


CLASSIC = re.compile(r"(wall/gran(?:/region)?) +(hooke|hooke/history|hertz/history) +(\S+) (\S+) (\S+) (\S+) (\S+) ([01])(?: (limit_damping))?(?!\S)")


def right_walls(text, units="lj"):
    """The same, with the laws of LAMMPS's own walls in the words of granular, which is right where the older words are wrong: where
    has_wrong_walls() they pass numbers of hooke to the wrong places (to 17Apr2024), multiply kt of hooke/history by the contact
    radius, leave it out where a spring of hertz/history slips, and give nan without gamma_n (doc/other-walls.md)."""
    def granular(found):
        wall, law, kn, kt, gamma_n, gamma_t, mu, damped, limited = found.groups()
        unit = 68568.415 if units == "real" and law == "hertz/history" else 1    # force->nktv2p: granular takes no atmospheres
        kn, gamma_n = float(kn) / unit, float(gamma_n)
        kt = kn * 2 / 7 if kt == "NULL" else float(kt) / unit
        gamma_t = int(damped) * (gamma_n / 2 if gamma_t == "NULL" else float(gamma_t))
        # granular has gamma_t as a part of gamma_n.
        gamma_n = gamma_n or (1e-30 if gamma_t else 0)
        part = gamma_t / gamma_n if gamma_t else 0
        normal, tangential = {"hooke": ("hooke", "linear_nohistory"), "hooke/history": ("hooke", f"linear_history {kt!r}"),
                              "hertz/history": ("hertz", f"mindlin {kt!r}")}[law]
        return " ".join([f"{wall} granular {normal} {kn!r} {gamma_n!r} tangential {tangential} {part!r} {mu}",
                         f"damping {'mass_velocity' if normal == 'hooke' else 'viscoelastic'}"] + ([limited] if limited else []))

    return CLASSIC.sub(granular, text)


def run(script, folder, ranks=1, timeout=300, env=None, host=ON_HOST, flags=FLAGS, **variables):
    """Runs a script (a path, or text) in `folder`; returns the finished process. With `host` under that LAMMPS, which loads
    the plugin first, given `flags`."""
    script, folder = str(script), pathlib.Path(folder)
    if has_wrong_walls(host):
        variables = {name: right_walls(str(value), variables.get("unit")) for name, value in variables.items()}
        script = right_walls(script)
    if "\n" in script:
        (folder / "in.script").write_text(script)
        script = str(folder / "in.script")
    if host and PLUGIN:
        (folder / "in.host").write_text(f"plugin load {PLUGIN}\ninclude {script}\n")
        script = str(folder / "in.host")
    command = [HOST if host else LMP, "-in", script, "-log", "none", "-nocite"]
    command += flags if host else ()
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    if ranks > 1:
        command = [*MPIRUN, "-np", str(min(ranks, MOST_RANKS)), *command]
    return subprocess.run(command, cwd=folder, env=environment(**(env or {})), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout)


def run_well(*args, **kwargs):
    """The same; the script must succeed."""
    done = run(*args, **kwargs)
    if done.returncode:
        raise AssertionError(f"script failed with {done.returncode}:\n{done.stdout[-4000:]}")
    return done.stdout


def run_in_a_row(scripts, folder, ranks=1, **more):
    """What each of the scripts prints. One start of LAMMPS runs them all, each after a `clear`, as a start takes longer than a short run. LAMMPS keeps a
    plugin through a `clear`; files of theirs need names of their own."""
    end = "---- end of a script\n"
    said = run_well("clear\n".join(f'{script}print "{end.rstrip()}"\n' for script in scripts), folder, ranks, timeout=900, **more)
    return said.split(end)[:-1]


def flat_floor(folder, name="floor.stl"):
    (folder / name).write_bytes((HERE / "scripts" / "floor.stl").read_bytes())


def mesh_warnings(output):
    """Warnings of files of the mesh."""
    return [line for line in output.split("\n") if line.startswith("WARNING") and "mesh_" in line]


def read_dump(path):
    """{step: {atom: [numbers after the id]}} of a text dump whose first column is id."""
    steps, lines = {}, pathlib.Path(path).read_text().split("\n")
    at = 0
    while at < len(lines) and lines[at].startswith("ITEM: TIMESTEP"):
        step, count = int(lines[at + 1]), int(lines[at + 3])
        rows = [line.split() for line in lines[at + 9:at + 9 + count]]
        steps[step] = {int(row[0]): [float(word) for word in row[1:]] for row in rows}
        at += 9 + count
    return steps


def read_thermo(output):
    """Rows of numbers of the last thermo table."""
    rows = []
    for line in output.split("\n"):
        if re.match(r"^\s*Step\b", line):
            rows = []
        elif re.match(r"^\s*\d+(\s+[-+\d.einaf]+)+\s*$", line):
            rows.append([float(word) for word in line.split()])
    return rows


def read_rows(path):
    """Rows of numbers of what fix print or print wrote."""
    return [[float(word) for word in line.split()] for line in pathlib.Path(path).read_text().split("\n") if line and line[0] != "#"]


def refused(name, text, folder, *says, **more):
    """A fact: the script ends with an error that says all of this, wherever its lines break."""
    done = run(text, folder, **more)
    said = " ".join(done.stdout.split())
    fact(f"{name}: refused", done.returncode != 0 and all(words in said for words in says), said[-400:])


def largest_difference(a, b, sizes=()):
    """Of two dumps of the same steps and atoms, relative to the largest value of each column. `sizes`: of columns whose values may
    cancel to what rounding leaves, the size of what cancels, by place in a row."""
    if a.keys() != b.keys():
        raise AssertionError(f"steps differ: {sorted(a)[:3]}... and {sorted(b)[:3]}...")
    columns = len(next(iter(next(iter(a.values())).values())))
    size, apart = [0.0] * columns, [0.0] * columns
    for column, value in dict(sizes).items():
        size[column] = value
    for step in a:
        if a[step].keys() != b[step].keys():
            raise AssertionError(f"atoms differ at step {step}")
        for atom, row in a[step].items():
            for k, (u, v) in enumerate(zip(row, b[step][atom])):
                size[k] = max(size[k], abs(u))
                apart[k] = max(apart[k], abs(u - v))
    return max(d / s if s else d for d, s in zip(apart, size))


def sample(laws):
    """All laws of a table; in the small samples the last, for tests of walls, which are the same for each law."""
    return dict(list(laws.items())[-1:]) if QUICK else laws
