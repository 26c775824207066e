#!/usr/bin/env python3
"""Run in.piston; plot the stress on the bed against its strain: stress.png, piston.png."""
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
    p.add_argument("--work", default=ROOT / "build/examples/piston", help="folder for the run")
    a = p.parse_args()
    work = pathlib.Path(a.work)
    work.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, HERE / "make_piston.py", "--out", work], check=True)
    env = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_ess_singleton_isolated="1")
    done = subprocess.run([pathlib.Path(a.lmp).resolve(), "-in", HERE / "in.piston", "-log", "none"],
                          cwd=work, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    line = re.search(r"^piston stress .*", done.stdout, re.M)
    if done.returncode or not line:
        sys.exit(done.stdout[-2000:])
    print(line[0])
    rows = [[float(x) for x in row.split()] for row in (work / "stress.txt").read_text().split("\n")
            if row and row[0] != "#"]

    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
    axes.plot([100 * r[0] for r in rows], [r[1] for r in rows])
    axes.set_xlabel("strain (%)")
    axes.set_ylabel("stress under the piston")
    figure.savefig(work / "stress.png", dpi=120)
    print(work / "stress.png")


if __name__ == "__main__":
    main()
