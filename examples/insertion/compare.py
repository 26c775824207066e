#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.insertion with a region that meets the pipe and with one that keeps off; print and plot how
deep grains were in the pipe: overlaps.png, insertion_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    a = runs.options(__doc__, HERE).parse_args()
    runs.make_meshes(HERE / "make_pipe.py", a.work)
    cases = {0: "across the pipe", 1: "keeps off"}
    rows = runs.run_scripts(a, HERE / "in.insertion",
                            [{"keep_off": k, "out": f"overlaps_{k}.txt",
                              "picture": f"insertion_{k}.png"} for k in cases])
    runs.print_table(["region of insertion", "largest overlap / radius", "fastest grain",
                      "in the pipe at the end", "out of the box"],
                     [[cases[r["keep_off"]], f"{r['overlap']:.3f}", f"{r['fastest']:.1f}",
                       f"{r['inside']:.0f}", f"{r['lost']:.0f}"] for r in rows])
    with runs.plot(a.work / "overlaps.png", "time", "largest overlap / radius") as axes:
        for k, name in cases.items():
            lines = [line.split() for line in (a.work / f"overlaps_{k}.txt").open() if line[0] != "#"]
            axes.plot([float(x[0]) for x in lines], [float(x[1]) for x in lines], ".", ms=3,
                      label=name)
        axes.legend()


if __name__ == "__main__":
    main()
