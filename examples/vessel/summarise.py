#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Turn the log of in.vessel into a short table: summarise.py log.lammps"""
import re
import sys


def stage(log, name):
    """The part of the log from `stage NAME` to the next stage."""
    start = log.index(f"\nstage {name}")
    end = log.find("\nstage ", start + 1)
    return log[start:end if end > 0 else None]


def timing(text):
    """Seconds, steps, average seconds in Modify and processes of the run in `text`."""
    loop = re.search(r"Loop time of (\S+) on (\d+) procs for (\d+) steps", text)
    modify = re.search(r"^Modify +\|[^|]+\| *(\S+)", text, re.M)
    return float(loop[1]), int(loop[3]), float(modify[1]), int(loop[2])


def values(text, line):
    """`name value` pairs of the lines that begin with `line`."""
    words = " ".join(re.findall(rf"^{line} (.*)$", text, re.M)).split()
    return {k: float(v) for k, v in zip(words[::2], words[1::2])}


def outflow(text, dt):
    """Mass per time through the outlet in the second half of the drain, and seconds since it was opened: from, to."""
    lines = text.splitlines()
    head = next(k for k, line in enumerate(lines) if line.split()[:1] == ["Step"])
    mass = lines[head].split().index("v_out_backward_mass")
    rows = []
    for line in lines[head + 1:]:
        words = line.split()
        if not re.match(r" *\d", line) or len(words) != len(lines[head].split()):
            break
        rows.append((int(words[0]), float(words[mass])))
    half = (rows[0][0] + rows[-1][0]) / 2
    first = next(row for row in rows if row[0] >= half or row is rows[-2])
    times = [(row[0] - rows[0][0]) * dt for row in (first, rows[-1])]
    return (rows[-1][1] - first[1]) / (times[1] - times[0]), times


def main():
    log = open(sys.argv[1]).read()
    rest, drain, reference = (stage(log, s) for s in ("rest", "drain", "reference"))
    at_rest = values(rest, "rest")
    left = values(drain, "drain")["grains"]
    seconds, steps, modify, ranks = timing(rest)
    _, steps_0, modify_0, _ = timing(reference)
    # The other fixes cost the same whether a wall is there or not.
    others = modify_0 / steps_0
    wall = modify / steps - others
    lift = -(at_rest["force_on_vessel"] + at_rest["force_on_outlet"])
    weight = at_rest["weight"]
    steps_drain = timing(drain)[1]
    dt = float(re.search(r"^timestep\s+(\S+)", log, re.M)[1])

    flow, (since, till) = outflow(drain, dt)
    hours, minutes, last = map(int, re.search(r"^Total wall time: (\d+):(\d+):(\d+)", log, re.M).groups())
    print("Spallation-target vessel, fix wall/lsdcd\n")
    print(f"mass flow             {flow:.3g} kg/s through the outlet, {since:.2g} s to {till:.2g} s after it opened")
    print(f"share of the walls    {100 * wall * steps / seconds:.1f} % of a step at rest, {seconds / steps * 1e3:.3g} ms")
    print(f"time of the run       {3600 * hours + 60 * minutes + last} s on {ranks} processes\n")

    rows = [
        ("grains", f"{at_rest['grains']:.0f}"),
        ("time of the walls in a step", f"{1e3 * wall:.3f} ms"),
        ("contacts with the walls", f"{at_rest['contacts']:.0f}"),
        ("spheres not certified exact", f"{at_rest['uncertified']:.0f}"),
        ("largest overlap / radius", f"{at_rest['largest_overlap']:.4f}"),
        ("elastic energy in the vessel", f"{at_rest['energy']:.4g} J"),
        ("weight of the grains", f"{weight:.6f} N"),
        ("force on the meshes", f"{lift:.6f} N downwards"),
        ("  its difference", f"{abs(lift - weight) / weight:.1e} of the weight, which still moves grains:"),
        ("  less their mass times acceleration", f"{abs(lift - weight - at_rest['push']) / weight:.1e} of the weight"),
        (f"left through the outlet in {steps_drain * dt:.2g} s", f"{at_rest['grains'] - left:.0f} grains"),
    ]
    width = max(len(name) for name, _ in rows) + 2
    for name, value in rows:
        print(f"{name:{width}}{value}")
    print("\nThe walls' share is `Modify` of LAMMPS's timing at rest less what gravity and the"
          "\nintegrator take in it, measured in a run without the walls.")
    print("\nFrom the log:")
    fix = ""
    for line in log.splitlines():
        if line.startswith("Fix "):
            fix = line.split()[1]
        if fix == "wall" and re.match(r"Fix .*: mesh|  (facets|edges|area|box|device|grid|[\d.]+ .?B, built)", line):
            print(line.replace(sys.path[0] + "/", ""))


if __name__ == "__main__":
    main()
