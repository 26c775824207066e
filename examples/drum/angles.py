#!/usr/bin/env python3
"""Run in.drum at several speeds; print and plot how steep the bed is: angles.png, drum.png.

The angle is that of the line from the axis to the grains' centre of mass, which is square to the
surface of a bed that is flat. Beside it: the torque on the drum, and what gravity's torque on the
grains is, which in the mean must be the same.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--lmp", default=ROOT / "build/bin/lmp-lsdcd")
    p.add_argument("--work", default=ROOT / "build/examples/drum", help="folder for the runs")
    p.add_argument("--speeds", type=float, nargs="+", default=[0.05, 0.1, 0.15, 0.2, 0.25])
    a = p.parse_args()
    work = pathlib.Path(a.work)
    work.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, HERE / "make_drum.py", "--out", work / "drum.stl"], check=True)
    env = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_ess_singleton_isolated="1")
    runs = [subprocess.Popen([pathlib.Path(a.lmp).resolve(), "-in", HERE / "in.drum", "-log", "none", "-var", "speed", str(w),
                              "-var", "picture", f"drum_{w:g}.png"], cwd=work, env=env, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT) for w in a.speeds]
    rows = []
    for run in runs:
        text = run.communicate()[0]
        line = re.search(r"^drum speed (\S+) angle (\S+) torque (\S+) weight_times_lean (\S+)", text, re.M)
        if run.returncode or not line:
            sys.exit(text[-2000:])
        rows.append([float(x) for x in line.groups()])
    print("| speed | Froude number | angle, degrees | torque on the drum | of gravity |")
    print("| --- | --- | --- | --- | --- |")
    for speed, angle, torque, weight in rows:
        print(f"| {speed:g} | {10 * speed**2:.3g} | {angle:.1f} | {torque:.0f} | {weight:.0f} |")

    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
    axes.plot([10 * r[0]**2 for r in rows], [r[1] for r in rows], "o-")
    axes.set_xlabel("Froude number, (angular speed)$^2$ x radius / gravity")
    axes.set_ylabel("angle of the bed (degrees)")
    figure.savefig(work / "angles.png", dpi=120)
    print(work / "angles.png")


if __name__ == "__main__":
    main()
