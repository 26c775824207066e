# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What `lsdcd check` says of this machine, without other programs, and of a LAMMPS that fails, hangs, or has a wrong force."""
import json
import os
import pathlib
import subprocess
import time

import pytest

from command import TOOL, run
from facts import fact

LMP = os.environ.get("LSDCD_LMP", "")
LONG = 600    # seconds: a machine whose cores are busy is slow, not broken
# What LAMMPS prints of a grain whose stiffness times overlap is 1000 * 1e-4.
STARTED, RIGHT = "LAMMPS (29 Sep 2021)\\nFix wall wall/lsdcd: mesh\\n", "lsdcd check: force 0.1\\n"


def program(path, script):
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return path


def lines(folder, *words, code=0, **environment):
    """Of each name the state and the line, of a check that ends with this code."""
    done = run(folder, "check", "--json", *words, env={**os.environ, "OMP_NUM_THREADS": "1", **environment})
    fact(f"check {' '.join(map(str, words))[-60:]} ends with {code}", done.returncode == code, done.stdout[-2000:] + done.stderr)
    said = json.loads(done.stdout)
    fact("and works says the same", said["works"] == (code == 0), said)
    fact("each line has its keys", all(set(line) == {"name", "state", "tried", "gave", "remedy"} for line in said["checks"]), said)
    fact("what fails has a remedy", all(line["remedy"] for line in said["checks"] if line["state"] == "fails"), said)
    return {line["name"]: line for line in said["checks"]}


def alive_in(group):
    """States of the processes of a group that have not ended; an ended one may wait for its parent."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, its = stat.read_text().rsplit(") ", 1)[1].split()[:3]
        except OSError:    # it has just ended
            continue
        if int(its) == group and state not in "ZX":
            found.append(state)
    return found


def is_so(of, name, state, *words):
    line = of.get(name, {})
    fact(f"{name} {state}: {' '.join(words)}", line.get("state") == state and all(word in " ".join(line.values()) for word in words), of)


@pytest.mark.skipif(not os.path.exists(LMP), reason="no lmp-lsdcd (LSDCD_LMP)")
def test_this_machine(folder):
    yields = os.environ.get("LSDCD_PATIENT_YIELD", "")    # processes of one core sleep while they wait
    of = lines(folder, "--seconds", LONG, LD_PRELOAD=yields)
    for name in ("lsdcd", "CPU", "CPU step", "LAMMPS", "plugin"):
        is_so(of, name, "works")
    is_so(of, "LAMMPS", "works", str(pathlib.Path(TOOL).resolve().parent / "lmp-lsdcd"))
    fact("MPI works where mpirun is", of["MPI"]["state"] in ("works", "no"), of["MPI"])
    fact("about ten lines", 8 <= len(of) <= 11, of)


def test_without_other_programs(folder):
    """The program is elsewhere, and PATH is empty."""
    alone = folder / "alone"
    alone.mkdir()
    (alone / "lsdcd").write_bytes(pathlib.Path(TOOL).read_bytes())
    (alone / "lsdcd").chmod(0o755)
    done = subprocess.run([alone / "lsdcd", "check"], cwd=folder, env={"PATH": ""}, capture_output=True, text=True, check=False)
    said = {line[:9].strip(): line[10:] for line in done.stdout.splitlines()}
    fact("what is not there is no error", done.returncode == 0 and "All that is here works." in done.stdout, done.stdout + done.stderr)
    for name in ("LAMMPS", "MPI", "Kokkos"):
        fact(f"no {name}", said.get(name, "").startswith("no "), done.stdout)
    fact("the step is timed", "ns a contact" in said.get("CPU step", ""), done.stdout)


def test_lammps_that_fails(folder):
    bad = program(folder / "bad", "echo first; echo 'ERROR: no licence (main.cpp:1)'; echo 'Last command: x'; exit 3")
    of = lines(folder, "--lmp", bad, code=1)
    is_so(of, "LAMMPS", "fails", "ended with 3", "ERROR: no licence", "ldd")
    is_so(of, "Kokkos", "no", "not tried")
    unknown = program(folder / "unknown", f"printf '{STARTED[:20]}\\n'; echo \"ERROR: Unrecognized fix style 'wall/lsdcd'\"; exit 1")
    of = lines(folder, "--lmp", unknown, code=1)
    is_so(of, "LAMMPS", "works", "29 Sep 2021")
    is_so(of, "plugin", "fails", "Unrecognized fix style", "--plugin FILE")


def test_lammps_that_hangs(folder):
    """It is ended in time, with what it has started, and no file is left."""
    hangs = program(folder / "hangs", f"echo $$ > {folder}/pid; printf '{STARTED}'; sleep 1000; echo never")
    place = folder / "tmp"
    place.mkdir()
    start = time.monotonic()
    of = lines(folder, "--lmp", hangs, "--seconds", 0.5, code=1, TMPDIR=str(place))
    fact("within its time and some seconds", time.monotonic() - start < 300)
    is_so(of, "plugin", "fails", "did not end in 0.5 s", "--seconds")
    group = int((folder / "pid").read_text())
    fact("its processes are gone", not alive_in(group), group)
    fact("no temporary file is left", not list(place.iterdir()))


def test_wrong_force(folder):
    wrong = program(folder / "wrong", f"printf '{STARTED}{RIGHT[:-2]}0000002\\n'")
    is_so(lines(folder, "--lmp", wrong, code=1), "plugin", "fails", "0.10000002", "should be 0.1")


def test_mpi_and_kokkos(folder):
    """Imitations of LAMMPS and mpirun."""
    good = program(folder / "good", f"printf '{STARTED}  1 by 1 by 1 MPI processor grid\\n{RIGHT}KOKKOS package API: Serial\\n'")
    program(folder / "mpirun", "printf 'first\\nno slots\\n---\\n'; exit 1")
    of = lines(folder, "--lmp", good, code=1, PATH=f"{folder}:/usr/bin:/bin", LAMMPS_PLUGIN_PATH=str(folder))
    is_so(of, "MPI", "fails", "ended with 1: no slots", "mpirun -np 2")
    is_so(of, "Kokkos", "no", "--plugin FILE")
    program(folder / "mpirun", 'shift 2; "$@" && "$@"')
    (folder / "lsdcdkkplugin.so").write_text("")
    of = lines(folder, "--lmp", good, code=1, PATH=f"{folder}:/usr/bin:/bin", LAMMPS_PLUGIN_PATH=str(folder))
    is_so(of, "MPI", "fails", "two runs of one process", "mpirun of the MPI")
    is_so(of, "Kokkos", "works", "lsdcdkkplugin.so", "Serial")
