#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The tables of doc/benchmark.md, and its figures silo.png, drum.png and impact.png, from a folder of results.

The folder has the logs of the decks as CASE_FILLING.log, where CASE is silo_large_m1, silo_small_m1, silo_large_m2, drum,
impact_25, impact_50, impact_100 or impact_loose100, and FILLING a number; cut_100, cut_even and cut_slivers are of a silo of 25 sides. What
is missing is left out, and a case without results has no figure. --others is a folder with the curves of LIGGGHTS and
MUSEN in silo.csv, drum.csv and impact.csv, which the figures show beside ours.
"""
import argparse
import re
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def read(path):
    """Columns by name, of CSV."""
    titles, *lines = (line.split(",") for line in path.read_text().splitlines())
    return dict(zip(titles, np.array([[float(x) if x else np.nan for x in line] for line in lines]).T))


def read_log(path):
    """Columns of LAMMPS's output by name, `above` for v_above, and t, the time. Runs that follow one another are joined. A last line that a
    run which was cut off has not finished is left out."""
    titles, rows = [], {}
    for line in path.read_text(errors="replace").splitlines(keepends=True):
        words = line.split()
        if words[:1] == ["Step"]:
            titles = [word.removeprefix("v_") for word in words]
        elif words and line.endswith("\n") and len(words) == len(titles) and all(re.match(r"[-+]?(\d|nan|inf)", word) for word in words):
            rows[words[0]] = [float(word) for word in words]
    columns = dict(zip(titles, np.array(list(rows.values())).reshape(len(rows), len(titles)).T))
    return {"t": columns.get("Time", np.empty(0)), **columns}


def fillings(folder, case, until=0.0):
    """Of each filling of a case, its columns, if it came to the time `until`, but for the last row that it would have written."""
    paths = sorted(p for p in folder.glob(f"{case}_*.log") if re.fullmatch(rf"{case}_\d+", p.stem))
    return [columns for columns in map(read_log, paths) if len(columns["t"]) > 1 and 2 * columns["t"][-1] - columns["t"][-2] >= until]


def rate(columns, name="above", first=0.5, last=3.5):
    """Grains that leave a silo, thousands a second: the slope between two times."""
    part = (columns["t"] >= first - 1e-6) & (columns["t"] <= last + 1e-6)
    return -np.polyfit(columns["t"][part], columns[name][part], 1)[0] / 1000


def said(values, digits):
    """Mean and standard error, or the value where there is one."""
    values = np.array(values)
    mean = f"{values.mean():.{digits}f}"
    return mean if len(values) < 2 else f"{mean} +- {values.std(ddof=1) / len(values)**0.5:.{digits}f} ({len(values)} fillings)"


def answers(folder, last, others):
    """Rows of the first table: what, LSDCD, the eight codes, LIGGGHTS and MUSEN run again. Rates of a silo are of 0.5 s to `last`."""
    rows, mean = [], {}
    curves = read(others / "silo.csv") if others else {}
    for case, what, eight, names in (("silo_large_m1", f"silo, large outlet, M1: 1000 grains a second, 0.5 to {last:g} s", "23.2 within 5 % (0.5 to 3.5 s)", ("large_liggghts", "large_musen")),
                                     ("silo_small_m1", "silo, small outlet, M1", "", ("small_musen",)),
                                     ("silo_large_m2", "silo, large outlet, M2", "", ())):
        rates = [rate(c, last=last) for c in fillings(folder, case, last)]
        if rates:
            mean[case] = np.mean(rates)
            again = ", ".join(f"{rate(curves, name, last=last):.2f}" for name in names if name in curves)
            rows.append([what, said(rates, 2), eight, again])
    if "silo_large_m1" in mean and "silo_small_m1" in mean:
        again = f"-, {rate(curves, 'large_musen', last=last) / rate(curves, 'small_musen', last=last):.2f}" if curves else ""
        rows.append(["silo: large over small", f"{mean['silo_large_m1'] / mean['silo_small_m1']:.2f}", "3.10 +- 0.06", again])
    for cut in ("100", "even", "slivers"):
        for c in [read_log(path) for path in folder.glob(f"cut_{cut}.log")]:
            parts = [rate(c, first=t / 10, last=t / 10 + 0.1) for t in range(3, 9)]
            rows.append([f"silo of 25 sides, {cut} triangles, 0.3 to 0.9 s", f"{rate(c, first=0.3, last=0.9):.2f} +- {np.std(parts, ddof=1) / 6**0.5:.2f} (parts of 0.1 s)", "", ""])
    for what, sign, first, end, again in (("drum: first maximum of M1 in zone 2, at s", 1, 0, 1, ("0.6, 0.6", "22 861, 23 064")),
                                          ("drum: its minimum, at s", -1, 1, 1.7, ("1.5, 1.5", "21, 22"))):
        peaks = []
        for c in fillings(folder, "drum", end):
            at = np.argmax(np.where((c["t"] > first) & (c["t"] < 2), sign * c["m1_two"], -np.inf))
            peaks.append((c["t"][at], c["m1_two"][at]))
        for k, (words, digits) in enumerate(((what, 2), ("... grains", 0))):
            if peaks:
                rows.append([words, said([p[k] for p in peaks], digits), "", again[k]])
    lowest = [c["z"].min() * 1000 for c in fillings(folder, "impact_25", 0.04)]
    if lowest:
        rows.append(["impact, 25 000: lowest place of the ball, mm, median",
                     f"{np.median(lowest):.2f} ({min(lowest):.2f} to {max(lowest):.2f}, {len(lowest)} fillings)", "-78.8 to -78.3", ""])
    for case, again in (("impact_50", "138.5, 138.9"), ("impact_100", "90.9, 90.5"), ("impact_loose100", "90.9, 90.5")):
        depths = [(c["z"][0] - c["z"].min()) * 1000 for c in fillings(folder, case, 0.09)]
        if depths:
            rows.append([f"impact, {case[7:].replace('loose', 'loose bed, ')} 000: way of the ball, mm", said(depths, 1), "", again])
    return rows


def times(folder):
    """Rows of the second table: of each log, its loop times together, and the mean of its atoms."""
    rows = []
    for path in sorted(folder.glob("*.log")):
        loops = re.findall(r"^Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", path.read_text(errors="replace"), re.M)
        seconds, steps = sum(float(x[0]) for x in loops), sum(int(x[2]) for x in loops)
        if steps:
            atoms = read_log(path).get("Atoms", [int(loops[0][3])])
            rows.append([path.stem, str(steps), f"{seconds:.1f}", f"{1000 * seconds / steps:.4f}", f"{np.mean(atoms) * steps / seconds / 1e6:.0f}"])
    return rows


def curve(axes, columns, name, label, style, scale=1.0, shift=0.0):
    axes.plot(columns["t"], (columns[name] - shift) * scale, style, label=label, lw=1, ms=3)


def draw(folder, out, others):
    of = {name: read(others / f"{name}.csv") if others else None for name in ("silo", "drum", "impact")}
    out.mkdir(parents=True, exist_ok=True)
    if any(folder.glob("silo_*.log")):
        with runs.plot(out / "silo.png", "time / s", "1000 grains above the lip") as axes:
            for case, label, style in (("silo_large_m1", "large, M1", "C0-"), ("silo_large_m2", "large, M2", "C2-"), ("silo_small_m1", "small, M1", "C1-")):
                for columns in fillings(folder, case)[:1]:
                    curve(axes, columns, "above", label, style, 1e-3)
            for name, label, style in (("large_liggghts", "LIGGGHTS", "k+"), ("large_musen", "MUSEN", "kx"), ("small_musen", "", "kx")):
                if of["silo"]:
                    curve(axes, of["silo"], name, label or None, style, 1e-3)
            axes.legend()
    if any(folder.glob("drum_*.log")):
        with runs.plot(out / "drum.png", "time / s", "grains in the zone") as axes:
            for k, (kind, zone) in enumerate((("m1", "two"), ("m1", "one"), ("m2", "two"), ("m2", "one"))):
                number = 1 if zone == "one" else 2
                for columns in fillings(folder, "drum")[:1]:
                    curve(axes, columns, f"{kind}_{zone}", f"{kind.upper()}, zone {number}", f"C{k}-")
                if of["drum"]:
                    curve(axes, of["drum"], f"z{number}_{kind}_liggghts", None if k else "LIGGGHTS", "k+")
            axes.legend()
    if any(folder.glob("impact_*.log")):
        with runs.plot(out / "impact.png", "time / s", "height of the ball less that at the start / mm") as axes:
            for n, style in (("25", "C0"), ("50", "C1"), ("100", "C2"), ("loose100", "C3")):
                for k, columns in enumerate(fillings(folder, f"impact_{n}")):
                    curve(axes, columns, "z", None if k else f"{n.replace('loose', 'loose bed, ')} 000", f"{style}-", 1e3, columns["z"][0])
                if of["impact"] and n.isdigit():
                    curve(axes, of["impact"], f"{n}k_liggghts", "LIGGGHTS" if n == "25" else None, "k+", 1e3)
            axes.legend()


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("results", type=Path)
    p.add_argument("--others", type=Path)
    p.add_argument("--last", type=float, default=3.5, metavar="S", help="end of the time of which rates of a silo are (default %(default)s)")
    p.add_argument("--out", type=Path, default=Path("."))
    a = p.parse_args()
    runs.print_table(["", "LSDCD", "eight codes", "LIGGGHTS, MUSEN of 2026"], answers(a.results, a.last, a.others))
    print()
    runs.print_table(["run", "steps", "s", "ms a step", "million grain-steps a second"], times(a.results))
    draw(a.results, a.out, a.others)


if __name__ == "__main__":
    main()
