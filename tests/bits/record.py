# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Records every run of LAMMPS that tests/lammps starts, once, so that two programs can be given the same.

A recording belongs to the files of tests/lammps: commits with the same ones share it.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from programs import CACHE, HERE, say

# Debian's own, as `run` has it: it sees Debian's numpy.
PYTHON = "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else sys.executable

# Scripts whose runs are not repeated, and why.
LEFT_OUT = {
    "test_crashes": "kills its runs at times of the clock",
    "test_cache": "several runs at once share files",
    "test_launcher": "asks for help and preloads libraries",
    "test_device": "depends on the GPU that is there",
    "test_plugin_host": "runs another LAMMPS",
    "test_kokkos": "the form kk runs all other scripts with Kokkos",
    "test_kokkos_bench": "measures times",
    "test_section": "one long run of examples/vessel",
    "test_tutorial": "long runs of examples/tutorial",
}
# For --quick.
FEW = ("test_parity", "test_restart", "test_several_meshes", "test_two_dimensions", "test_rerun", "test_loads",
       "test_virial")


def scripts_of(tests):
    return [path.stem for path in sorted(tests.glob("*.py"))
            if (path.stem.startswith("test_") or path.stem == "run_bad_scripts") and path.stem not in LEFT_OUT]


def stamp(tests):
    """Of all that decides what is recorded."""
    sums = hashlib.sha256()
    for path in sorted(p for p in tests.rglob("*") if p.is_file() and "__pycache__" not in p.parts):
        sums.update(str(path.relative_to(tests)).encode() + b"\0" + path.read_bytes())
    sums.update((HERE / "recorder.py").read_bytes())
    return sums.hexdigest()[:16]


def stand_in(program, folder):
    """A folder that looks like the program's build, with the recorder as lmp-lsdcd."""
    (folder / "bin").mkdir(parents=True)
    shutil.copy(HERE / "recorder.py", folder / "bin" / "lmp-lsdcd")
    (folder / "bin" / "lmp-lsdcd").chmod(0o755)
    build = program.folder
    for name in ("lib", "share"):
        if (build / name).exists():
            (folder / name).symlink_to(build / name)
    if (build / "bin" / "lsdcd").exists():
        (folder / "bin" / "lsdcd").symlink_to(build / "bin" / "lsdcd")
    return folder / "bin" / "lmp-lsdcd"


def record_script(name, tests, into, lmp, program):
    """Runs one script to its end, whether it passes or not; its seconds."""
    start = time.time()
    part = into / f"{name}.part"
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    with tempfile.TemporaryDirectory(prefix="lsdcd-record-") as scratch:
        environment = {k: v for k, v in os.environ.items() if not k.startswith("LSDCD_")}
        environment.update(LSDCD_LMP=str(lmp), LSDCD_BITS_PROGRAM=str(program.lmp), LSDCD_BITS_RECORD=str(part),
                           LSDCD_QUICK="1", TMPDIR=scratch)
        with open(into / f"{name}.log", "w") as log:
            try:
                subprocess.run([PYTHON, tests / f"{name}.py"], env=environment, stdout=log, stderr=log,
                               timeout=900)
            except subprocess.TimeoutExpired:
                log.write("stopped after 900 s\n")
    part.rename(into / name)
    return time.time() - start


def recorded(program, source, wanted, jobs):
    """(folder, [(name, record)]) of the scripts named; records those that are not there yet."""
    tests = source / "tests" / "lammps"
    into = CACHE / "bits" / "recorded" / stamp(tests)
    into.mkdir(parents=True, exist_ok=True)
    names = [name for name in scripts_of(tests) if wanted is None or name in wanted]
    missing = [name for name in names if not (into / name).is_dir()]
    if missing:
        say(f"recording the runs of {len(missing)} scripts of {tests} once; they are kept in {into}")
        with tempfile.TemporaryDirectory(prefix="lsdcd-stand-in-") as place:
            lmp = stand_in(program, pathlib.Path(place) / "build")
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                runs = {pool.submit(record_script, name, tests, into, lmp, program): name for name in missing}
                for done in concurrent.futures.as_completed(runs):
                    count = len(list((into / runs[done]).glob("*.json")))
                    say(f"  {runs[done]}: {count} runs in {done.result():.0f} s")
    every = []
    for name in names:
        for path in sorted((into / name).glob("*.json")):
            every.append((f"{name}/{path.stem[:8]}", json.loads(path.read_text())))
    return into, every
