# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What a run leaves behind that is killed, or whose disk is full: older files whole, and a restart
that goes on bit for bit. LSDCD_QUICK=1 kills half as often, with a quarter of the triangles."""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import time

import lmp
import scene
import stl
import vtp
from facts import at_most, fact

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
MESH = ("mesh {1} motion wiggle 0 0 0.05 0.5 "
        "mesh_fields {0}k_*.vtp every 20 mesh_stl {0}now.stl every 5")
EVERY = 50    # steps between restarts
KILLS = 2 if lmp.QUICK else 4
GOES_ON = 100
ENDLESS = 1000000
NAMES = ("a.restart", "b.restart")


def text(begin, run, more="", to="", mesh="fine.stl"):
    restarts = "".join(" " + to + n for n in NAMES)
    return begin + scene.forces(LAW, mesh=MESH.format(to, mesh)) + f"restart {EVERY}{restarts}\n" + more + run


def descendants(pid):
    """A process with its children and theirs: mpirun's have groups of their own."""
    try:
        children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except FileNotFoundError:
        children = []
    return [pid] + [p for child in children for p in descendants(int(child))]


def killed(folder, ranks, wait):
    """Runs until both restart files are there and `wait` seconds more, then kills all at once."""
    (folder / "in.killed").write_text(text(scene.CREATE, f"run {ENDLESS}\n"))
    command = [lmp.LMP, "-in", "in.killed", "-log", "none", "-nocite"]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), "--oversubscribe", *command]
    with open(folder / "killed.out", "w") as out:
        run = subprocess.Popen(command, cwd=folder, env=lmp.environment(), stdout=out, stderr=out)
    end = time.time() + 120
    while not all((folder / n).exists() for n in NAMES) and run.poll() is None and time.time() < end:
        time.sleep(0.01)
    time.sleep(wait)
    ran = run.poll() is None and all((folder / n).exists() for n in NAMES)
    for pid in descendants(run.pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    run.wait()
    if not ran:
        raise AssertionError("the run to kill did not run:\n" + (folder / "killed.out").read_text()[-4000:])


def amiss(folder):
    """Reads every file of the fix to its end; what is wrong with one, as text."""
    try:
        for path in folder.glob("k_*.vtp"):
            vtp.read(path)
        stl.points(folder / "now.stl")
        gone = [f for _, f in vtp.listed(folder / "k_series.pvd") if not (folder / f).exists()]
    except Exception as error:    # of a parser: which, does not matter
        return repr(error)
    return f"listed and not there: {gone}" if gone else ""


def go_on(folder, mesh="fine.stl"):
    """Goes on from the newest restart file that can be read; its step. LAMMPS writes them in place,
    so that the newest may be cut off: the other is why there are two."""
    for name in sorted(NAMES, key=lambda n: -(folder / n).stat().st_mtime):
        shutil.copy(folder / name, folder / "last.restart")    # the run writes others over it
        done = lmp.run(text(scene.SETTINGS + "read_restart last.restart\n", f"run {GOES_ON}\n",
                            scene.dump("continued", 10), mesh=mesh), folder)
        if done.returncode == 0:
            return int(lmp.read_thermo(done.stdout)[0][0])
    raise AssertionError("neither restart file can be read:\n" + done.stdout[-4000:])


def prepare(folder):
    scene.write_floor(folder / "floor.stl")
    scene.write_floor(folder / "fine.stl", cells=40 if lmp.QUICK else 80)    # a run that writes files most of its time


def test_kills(folder):
    chance = random.Random(17)
    for k in range(KILLS):
        ranks, wait = 1 + k % 2, chance.uniform(0, 0.3)
        for path in [*folder.glob("k_*"), *(folder / n for n in NAMES)]:
            path.unlink(missing_ok=True)
        killed(folder, ranks, wait)
        at = f"killed on {ranks} rank{'s' * (ranks > 1)} after {wait:.3f} s"
        wrong = amiss(folder)
        fact(f"{at}: files are whole, and those listed are there", not wrong, wrong)
        step = go_on(folder)
        names = [f for _, f in vtp.listed(folder / "k_series.pvd")]
        fact(f"{at}: the list goes on from step {step}, each file once",
             names == [f"k_{s}.vtp" for s in range(20, step + GOES_ON + 1, 20)], str(names[-3:]))
        lmp.run_well(text(scene.CREATE, f"run {step}\n{scene.dump('unbroken', 10)}run {GOES_ON}\n"),
                     folder, ranks)
        at_most(f"{at}: continued as unbroken", lmp.largest_difference(
            lmp.read_dump(folder / "unbroken"), lmp.read_dump(folder / "continued")), 0)


def test_killed_in_a_write(folder):
    """In the middle of a file, by the signal that comes where a process's files may not grow further."""
    def run(limit):
        files = "mesh_fields same.vtp every 20 mesh_stl same.stl every 20"
        (folder / "in.limited").write_text(
            scene.CREATE + scene.forces(LAW, mesh="mesh floor.stl " + files) + "run 100\n")
        command = f"ulimit -c 0; ulimit -f {limit}; exec '{lmp.LMP}' -in in.limited -log none -nocite"
        # Open MPI 5 would begin with a file of its own that is larger than the limit, to talk to other processes.
        return subprocess.run(["sh", "-c", command], cwd=folder, env=lmp.environment(OMPI_MCA_btl="self"),
                              stdout=subprocess.DEVNULL).returncode

    fact("without a limit it runs", run("unlimited") == 0)
    before = [(folder / name).read_bytes() for name in ("same.vtp", "same.stl")]
    half = len(before[1]) // 2 // 512
    fact("killed in the middle of a file", run(half) == -signal.SIGXFSZ)
    fact("older files are as they were",
         before == [(folder / name).read_bytes() for name in ("same.vtp", "same.stl")])
    left = list(folder.glob("same.*.part-*"))
    fact("and what it had begun is beside them",
         len(left) == 1 and left[0].stat().st_size <= half * 512, str(left))


def small_disk(folder, kilobytes):
    """LAMMPS with a disk of this size in `full`; what was on it is kept in `kept`. None where
    nothing can be mounted."""
    mount = ["unshare", "--mount", "mount", "-t", "tmpfs", "none", folder]
    if os.geteuid() != 0 or not shutil.which("unshare"):
        return None
    if subprocess.run(mount, stderr=subprocess.DEVNULL).returncode:
        return None
    (folder / "full").mkdir()
    path = folder / "small_disk.sh"
    path.write_text(f"""#!/bin/sh
[ -n "$LSDCD_INSIDE" ] || LSDCD_INSIDE=1 exec unshare --mount "$0" "$@"
mount -t tmpfs -o size={kilobytes}k none full
'{lmp.LMP}' "$@"
status=$?
cp -r full kept
exit $status
""")
    path.chmod(0o755)
    return str(path)


def test_full_disk(folder):
    # Five .vtp of 140 kB, restart files of 16 kB and 8 bytes, an STL of 68 kB, which needs as much once more while it is
    # replaced. LAMMPS does not see that the last bytes of a file find no room, as these 8 would on 800 kB.
    program, usual = small_disk(folder, 796), lmp.LMP
    if not program:
        print("SKIP a full disk: only root can mount one")
        return
    lmp.LMP = program
    done = lmp.run(text(scene.CREATE, "run 300\n", to="full/", mesh="floor.stl"), folder)
    lmp.LMP = usual
    told = lmp.mesh_warnings(done.stdout)
    words = ("full/now.stl", "No space left", "no mesh_stl of this step", "Free disk space")
    fact("a full disk: one warning with file, reason, loss and remedy",
         len(told) == 1 and all(w in told[0] for w in words), str(told))
    kept = folder / "kept"
    wrong = amiss(kept)
    fact("every file there is whole, and listed ones are there", not wrong, wrong)
    fact("nothing half-written is beside them", not list(kept.glob("*.part*")))
    fact("LAMMPS stops where it cannot write a restart file", "while writing restart" in done.stdout)
    for name in NAMES:
        shutil.copy(kept / name, folder)
    step = go_on(folder, "floor.stl")
    fact("and the run goes on from the other one", step >= EVERY, f"step {step}")
