#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Makes doc/hard_cases.md from runs of the tests that know hard cases' answers.

usage: hard_cases.py [--build DIR] [--rows-only | --write-only] [--commit NAME]

Runs every device test that includes tests/support/hard_case.h, on the CPU and, where
there is a GPU, with CUDA. Rows are kept in doc/data/hard_cases_DEVICE.tsv, with commit and
device, so that the page has those of a device on a machine without it too.
"""
import argparse
import glob
import math
import os
import re
import subprocess
import sys
import tempfile

import hard_cases_pictures

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE_FILE = os.path.join(ROOT, "doc", "hard_cases.md")
CPU_ROWS = os.path.join(ROOT, "doc", "data", "hard_cases_cpu.tsv")
CUDA_ROWS = os.path.join(ROOT, "doc", "data", "hard_cases_cuda.tsv")
COLUMNS = ["theme", "id", "what", "backend", "precision", "relation", "answer", "ours",
           "tolerance", "derivation", "holds"]
SKIPPED = 77    # exit code of a device test without its device


def programs():
    """Device tests with hard cases, in the order of the CMake files."""
    names, sources = [], []
    for room in ("physics", "unit"):
        folder = os.path.join(ROOT, "tests", room)
        for path in sorted(glob.glob(os.path.join(folder, "test_*.cpp"))):
            with open(path) as source:
                if "support/hard_case.h" in source.read():
                    sources.append(os.path.splitext(os.path.basename(path))[0])
        with open(os.path.join(folder, "CMakeLists.txt")) as f:
            names += re.findall(r"^\s*lsdcd_(?:cpu|device|engine)_test\((\w+)", f.read(), re.M)
    unknown = set(sources) - set(names)
    if unknown:
        raise SystemExit(f"{', '.join(unknown)}: has hard cases, but no CMake file has it as a test")
    return [name for name in names if name in sources]


def git(*words):
    done = subprocess.run(["git", "-C", ROOT, *words], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


def commit():
    name = git("rev-parse", "--short=10", "HEAD") or "unknown commit"
    return name + (" and changes" if git("status", "--porcelain", "--", "src", "tests") else "")


def gpu():
    try:
        done = subprocess.run(["nvidia-smi", "--query-gpu=name", "--format=csv,noheader"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return done.stdout.splitlines()[0].strip() if done.stdout else "a GPU"
    except OSError:
        return "a GPU"


def cpu():
    try:
        with open("/proc/cpuinfo") as f:
            return re.search(r"model name\s*:\s*(.*)", f.read()).group(1).strip()
    except (OSError, AttributeError):
        return "a CPU"


def read_rows(path):
    """Rows as dicts, and the comment lines before them."""
    rows, notes = [], []
    if os.path.exists(path):
        with open(path) as f:
            for line in f.read().splitlines():
                if line.startswith("# "):
                    notes.append(line[2:])
                elif line:
                    rows.append(dict(zip(COLUMNS, line.split("\t"))))
    return rows, notes


def write_whole(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path + ".part", "w") as f:
        f.write(text)
    os.replace(path + ".part", path)


def put_between(path, begin, end, text):
    """Puts text where a document has the marker lines begin and end, which text repeats."""
    with open(path) as f:
        old = f.read()
    before, _, rest = old.partition(begin)
    _, found, after = rest.partition(end)
    if not found:
        raise SystemExit(f"{path} has no markers {begin} and {end}")
    write_whole(path, before + text + after)


def run(build, backend):
    """Rows of one backend, the names of programs that failed; None without the device."""
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "rows.tsv")
        for name in programs():
            print(f"running {name} on {backend} ...", flush=True)
            program = os.path.join(build, "bin", name)
            env = dict(os.environ, LSDCD_TEST_DEVICE=backend, LSDCD_HARD_CASES=path)
            env.setdefault("OMP_NUM_THREADS", "2")
            done = subprocess.run([program], env=env, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            if done.returncode == SKIPPED:
                print(done.stdout.strip())
                return None, []
            if done.returncode != 0:
                failed.append(f"{name} on {backend}")
                print(done.stdout[-3000:], file=sys.stderr)
        return read_rows(path)[0], failed


# ---- the page ----------------------------------------------------------------------------

def used(row):
    """The share of its tolerance that a number takes; more than 1 fails."""
    ours, answer, tolerance = (float(row[k]) for k in ("ours", "answer", "tolerance"))
    if row["relation"] == "<=":
        return ours / answer
    if row["relation"] == ">=":
        return answer / ours
    off = abs(ours - answer)
    return off / tolerance if tolerance else (0 if off == 0 else math.inf)


def deviation(row):
    if row is None:
        return "not run"
    off = float(row["ours"])
    off = f"{abs(off - float(row['answer'])) if row['relation'] == '=' else off:.2g}"
    return off if row["holds"] == "holds" else f"**{off} FAILS**"


def tolerance(row):
    if row["relation"] == ">=":
        return f"at least {float(row['answer']):.2g}"
    return f"{float(row['tolerance' if row['relation'] == '=' else 'answer']):.2g}"


def group_of(row):
    """The line of the table that holds a number; what no pattern knows has one of its own."""
    for name, pattern in GROUPS.get(row["theme"], ()):
        if re.search(pattern, row["what"]) or re.search(pattern, row["relation"]):
            return name
    return row["what"].rsplit(": ", 1)[-1]


def table(rows):
    """A line for each kind of number: the one that is nearest to its tolerance."""
    lines = ["| case | number | of them | result | allowed |", "|" + " --- |" * 5]
    groups = {}
    for r in rows:
        at = groups.setdefault((r["theme"], group_of(r)), {})
        at.setdefault((r["id"], r["what"]), {}).setdefault(r["backend"], r)
    order, above = list(CASES), ""
    for (theme, name), cases in sorted(groups.items(), key=lambda g: order.index(g[0][0]) if g[0][0] in CASES else len(order)):
        worst = max(cases.values(), key=lambda case: max(used(r) for r in case.values()))
        on_cpu, on_cuda = deviation(worst.get("cpu")), deviation(worst.get("cuda"))
        result = on_cpu if on_cpu == on_cuda else f"{on_cpu} (CPU)" if on_cuda == "not run" else f"{on_cpu}; {on_cuda}"
        title = CASES[theme][0] if theme in CASES else theme
        cells = ["" if title == above else title, name, str(len(cases)), result, tolerance(next(iter(worst.values())))]
        above = title
        lines.append("| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |")
    return "\n".join(lines)


def values(rows):
    """The numbers that stand in the text, of the CPU."""
    def ours(theme, what, digits=2):
        found = [r for r in rows if r["backend"] == "cpu" and r["theme"] == theme and what in r["what"]]
        return f"{float(found[0]['ours']):.{digits}g}" if found else "?"

    billiard = [r for r in rows if r["backend"] == "cpu" and r["what"].startswith("billiard")]
    return {"rolled": ours("Drum", "1024 segments, k = 1000 (sunk 2.0e-02 R at rest): against the smooth"),
            "smooth": "{:.2g}".format(next((float(r["answer"]) for r in rows if "1024 segments, k = 1000 (sunk 2.0e-02 R at rest): "
                                            "against the smooth" in r["what"]), math.nan)),
            "summed": ours("Drum", "corner sum"), "growth": ours("Time step", "corner sum"),
            "grows": ours("Time step", "1.01 of it", 3),
            "billiard": f"{max((float(r['ours']) for r in billiard), default=math.nan):.1g}",
            "lost": ours("Fast and thin", "the same with side both", 3),
            "steps": "{:.2g}".format(next((float(m.group(1)) for r in rows for m in
                                           [re.match(r"(\S+) steps inside", r["what"])] if m), math.nan))}


def sections(rows):
    text, known = [], values(rows)
    themes = dict.fromkeys([*CASES, *(r["theme"] for r in rows)])
    for theme in themes:
        if theme not in CASES:
            text.append(f"## {theme}\n\nSee the table.\n")
            continue
        title, picture, wrong, here, test = CASES[theme]
        text.append(f"## {title}\n\n![{title}: wrong and right](img/hard_cases/{picture}.png)\n\n"
                    f"- **Wrong:** {wrong}\n- **LSDCD:** {here.format(**known)}\n- **Test:** {test}\n")
    return "\n".join(text)


# Theme: title, picture, what goes wrong elsewhere, what happens here, the test.
CASES = {
    "Seams of a plane": (
        "Seams of a plane", "seams",
        "A wall that adds up the forces of its triangles pushes twice on a seam. Its result depends on how the plane was cut.",
        "A plane of 2 to 199 712 triangles has the force of one plane, in any order and winding, with T-junctions and\n"
        "  duplicates. A gap or step of 1e-7 that was not welded changes the force only by the amount that geometry requires.",
        "[test_seams](../tests/physics/test_seams.cpp). The example [retriangulated](../examples/retriangulated) compares with\n"
        "  LIGGGHTS."),
    "Convex edges, corners and tips": (
        "Convex edges, corners and tips", "convex",
        "If n triangles meet at a corner, the corner pushes up to n times.",
        "A corner makes one contact, whether 3 or 2000 triangles meet there, in any order. A sphere that drops beside an edge or a\n"
        "  corner leaves in the mirrored direction.",
        "[test_convex](../tests/physics/test_convex.cpp)."),
    "Nearly flat": (
        "Shallow folds", "folds",
        "If the forces of both walls are added, a shallow fold is twice as stiff as one wall. If one of them is left out\n"
        "  instead, the force jumps at some angle.",
        "At folds of 1e-6 degrees and more the force changes with the position and with the angle as smoothly as that of one\n"
        "  wall. In corners of 90 degrees and less the forces add up, because there each side really pushes in another direction.",
        "[test_nearly_flat](../tests/physics/test_nearly_flat.cpp)."),
    "Funnels and cones": (
        "Funnels and cones", "funnels",
        "A sphere that lies in a funnel touches many sides. As it moves, some contacts appear and others vanish at once, and the\n"
        "  force jumps.",
        "In cones of 3 to 12 planes, equal or random and up to 85 degrees steep, the force of Hooke and of Hertz springs\n"
        "  follows the position without a jump. A sphere that bounces in a funnel keeps its energy. If 7 planes or more carry it,\n"
        "  the energy varies at random by about 0.2 % in each bounce.",
        "[test_funnels](../tests/physics/test_funnels.cpp)."),
    "Drum": (
        "A drum of flat segments", "drum",
        "A drum of flat segments is rough, so that a sphere hops at each fold and loses energy.",
        "The sphere loses exactly what the polygon takes, and no more. For example, in 4 s of rolling a drum of 1024 segments\n"
        "  takes {rolled} of its energy, and a smooth drum {smooth}. With `corner sum` the sphere loses {summed} more than in the\n"
        "  smooth drum.",
        "[test_drum](../tests/physics/test_drum.cpp)."),
    "History": (
        "Springs across seams", "springs",
        "The tangential spring is lost at a seam, so that a sphere creeps down a slope on which it should lie still.",
        "The spring is carried over seams, edges and corners without a jump. In a corner each side has a spring of its own. If you\n"
        "  stop a run in the middle of a slide and continue it from a restart file, you get the same bits.",
        "[test_slide](../tests/physics/test_slide.cpp), with restart files [test_restart](../tests/lammps/test_restart.py), and with\n"
        "  several processes [test_ranks](../tests/lammps/test_ranks.py)."),
    "Rolling": (
        "Rolling", "rolling",
        "A sphere lifts off at seams or drifts to the side.",
        "The sphere stays on the wall and rolls straight. Its accelerations down a slope and along a groove are those of the\n"
        "  closed forms, and so is the time at which slip becomes rolling. Over the tip of a cone it has one contact and loses no energy.",
        "[test_roll](../tests/physics/test_roll.cpp)."),
    "Bouncing": (
        "Bouncing", "bouncing",
        "A seam damps twice, so that the restitution coefficient depends on where a sphere hits.",
        "The restitution coefficient is the same on faces, edges, vertices, the corner of a cube, a thin plate and the tip of a cone.\n"
        "  In an oblique impact the sphere slips or sticks as the closed forms say.",
        "[test_bounce](../tests/physics/test_bounce.cpp)."),
    "Belt": (
        "A moving belt", "belt",
        "A seam drags twice, so that a moving surface carries grains at a wrong speed.",
        "A free sphere ends at 2/7 of the speed of the belt and rolls. A sphere that cannot turn ends at the speed of the belt.\n"
        "  Times and distances are those of the closed forms.",
        "[test_belt](../tests/physics/test_belt.cpp)."),
    "Energy": (
        "Energy", "energy",
        "A force that jumps at folds and corners adds energy, so that a bed never comes to rest.",
        "A sphere in a box of triangles keeps its energy to {billiard} in 1e6 steps. 30 spheres in an upright\n"
        "  drum come to rest and stay at rest, and the mesh carries their weight and its moment.",
        "[test_energy](../tests/physics/test_energy.cpp), [test_bed](../tests/physics/test_bed.cpp)."),
    "Time step": (
        "Time step", "timestep",
        "If the forces of two sides are added, the wall is stiffer there, and a timestep that is stable on a plane is not stable.",
        "The limit of the timestep is 2 / sqrt(k/m) on faces, vertices and folds alike. Just above this limit an oscillation grows\n"
        "  {grows} times a step, as it must. With `corner sum` it grows {growth} times a step already just below the limit.",
        "[test_energy](../tests/physics/test_energy.cpp)."),
    "Fast and thin": (
        "Fast spheres, thin walls", "fast",
        "The centre of a fast sphere crosses the wall, and the wall pushes it out on the other side.",
        "With `side both` this happens in LSDCD as well, from a speed of R sqrt(k/m) on. With `side in` or `side out` it happens\n"
        "  from twice that speed on. A sphere that moves by 2 R in one step can jump over a wall. For example, of 500 fast spheres\n"
        "  in a box `side in` loses none and `side both` loses {lost}.",
        "[test_fast](../tests/physics/test_fast.cpp)."),
    "Bad meshes, against exact arithmetic": (
        "Bad meshes", "bad_meshes",
        "Contacts are missed, or a force is not a number, at slivers, at triangles without an area or of 1e-6 to 1e6 radii, on\n"
        "  Moebius strips, and where walls cut each other.",
        "No contact is missed. Distances agree with exact arithmetic to round-off. Normals have length 1, even if a centre\n"
        "  lies on the wall.",
        "[test_bad_meshes](../tests/unit/test_bad_meshes.cpp)."),
    "Random meshes and spheres": (
        "Random meshes and spheres", "random",
        "The wall fails in a case that nobody thought of.",
        "The test makes random meshes, spheres and grids, and compares the result with trying every triangle. No contact is missed,\n"
        "  and none is counted twice. The same is true for the lists that each sphere near the wall keeps, over {steps} random steps.",
        "[test_properties](../tests/unit/test_properties.cpp)."),
}

# Theme: what its lines in the table are called, and which numbers they hold.
GROUPS = {
    "Seams of a plane": [("normal force, one plane", r"^(?!.*(1e-7|4e-7)).*F/F0 - 1"), ("force along it", r"^(?!.*(1e-7|4e-7)).*Ft"),
                         ("normal force, gaps and steps of 1e-7", r"F/F0 - 1"), ("force along it, the same", r"Ft")],
    "Convex edges, corners and tips": [("contacts", "contacts"), ("direction after a drop / speed", "mirrored"), ("force / F", "F/F0")],
    "Nearly flat": [("change of force / that of one wall", r"\|dF\|"), ("sum of two or three walls", r"F/")],
    "Funnels and cones": [("jump of the force / F", "of a step"), ("the same, a plane moved by 2e-12 R", "moved"),
                          ("energy, bouncing", "bounces")],
    "Drum": [("force / that of the polygon", "F_polygon"), ("roughness", "rms"), ("energy, sliding, 1/s", "sliding"),
             ("energy lost by rolling, beyond the polygon", "polygon's own"), ("beyond a smooth drum", "smooth cylinder's"),
             ("the same with `corner sum`", "corner sum")],
    "History": [("same bits after a break", "difference"), ("jump of the spring", "jump"),
                ("friction, round a drum of segments", "drum"), ("friction below its limit", "kt|two springs"),
                ("friction at its limit", "mu F_n")],
    "Rolling": [("lift and drift / R", "lift|drift aside"), ("contacts on a tip", "contacts"), ("energy over a tip", "energy"),
                ("slip to roll", "^slip"), ("acceleration", "acceleration")],
    "Bouncing": [("heights in a train", "height"), ("way to the side / R", "way"), ("slip", "^gross"), ("restitution, stick", "^(restit|stick)")],
    "Belt": [("speed", "speed over"), ("time, way", "time|way")],
    "Energy": [("energy, 1e6 steps", "billiard"), ("bed: energy, weight, moment", "drum")],
    "Time step": [("`corner sum`: growth", "corner sum"), ("swing below the limit", "excursion"), ("growth above it", "growth")],
    "Fast and thin": [("speed or step that passes", "goes through|unseen"), ("spheres lost, `side both`", ">="), ("spheres lost, `side in`", "lost"),
                      ("plate of 1e-3 R", "plate")],
    "Bad meshes, against exact arithmetic": [("missed", "missed"), ("contacts", "most"), ("distance / its tolerance, past tips", "tips"),
                                             ("distance, force / R", r"exact\||F - k d"), ("length of normals", r"\|n\|")],
    "Random meshes and spheres": [("distance / its tolerance", "/ tolerance"), ("missed, doubled, wrong", "=")],
}


PAGE = """<!-- SPDX-FileCopyrightText: 2026 LSDCD contributors -->
<!-- SPDX-License-Identifier: BSD-3-Clause -->

# Hard cases

A wall of triangles is easy to write, and easy to get wrong: at seams, folds and corners, and with bad meshes. **This page shows {themes} such
cases. The tests compare {count} numbers, and {verdict}.** The expected numbers come from closed forms, or from references that
share no code with LSDCD and compute in higher precision. *Wrong* says what a wall does that treats each triangle by itself. *LSDCD* says
what you get here, and *Test* names the file that checks it. [The table](#all-numbers) has the deviations.

{sections}
## All numbers

Each line of the table stands for several numbers of the same kind (*of them*), and shows the one that is nearest to its limit (*allowed*). The
*result* is its distance from the expected number, or the number itself if it should be small. It is the same on the CPU and with CUDA; if not,
both are given in this order. (CPU) means that the case was not run with CUDA. All numbers, with what was expected, the limit and its reason, are in
`doc/data/hard_cases_cpu.tsv` and `doc/data/hard_cases_cuda.tsv`.

{table}

`./run bench hard-cases` runs the tests and writes this page. These numbers are from {cpu}, for the CPU, and {cuda}, for CUDA.
"""


def write_page(rows, cpu_note, cuda_note):
    """Writes the page; how many numbers there are, and how many fail."""
    known = {(r["theme"], r["id"], r["what"]) for r in rows if r["backend"] == "cpu"}
    rows = [r for r in rows if (r["theme"], r["id"], r["what"]) in known]
    bad = sum(r["holds"] != "holds" for r in rows)
    themes = dict.fromkeys(r["theme"] for r in rows)
    write_whole(PAGE_FILE, PAGE.format(
        themes=len(themes), count=len(known), verdict="all of them hold" if not bad else f"{bad} fail", sections=sections(rows),
        table=table(rows), cpu=cpu_note, cuda=cuda_note))
    print(f"{PAGE_FILE}: {len(known)} numbers, {bad} fail")
    return bad


def keep(rows, path, note):
    lines = ["\t".join(r[c] for c in COLUMNS) for r in rows]
    write_whole(path, "\n".join(["# " + note, "# " + "\t".join(COLUMNS)] + lines) + "\n")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="DIR",
                        help="where bin/ is")
    parser.add_argument("--rows-only", action="store_true",
                        help="only run CUDA and write its rows (on a machine lent for that)")
    parser.add_argument("--write-only", action="store_true", help="run nothing; write from the rows in doc/data")
    parser.add_argument("--commit", default=commit(), metavar="NAME",
                        help="what was built, where git does not know")
    args = parser.parse_args(arguments)

    failed = []
    if not args.write_only:
        cuda, failed = run(args.build, "cuda")
        if cuda is not None:
            keep(cuda, CUDA_ROWS, f"commit {args.commit}, {gpu()}")
        if args.rows_only:
            if cuda is None:
                print("no CUDA device", file=sys.stderr)
                return 1
            return 1 if failed else 0
        rows, more = run(args.build, "cpu")
        failed += more
        keep(rows, CPU_ROWS, f"commit {args.commit}, {cpu()}")
    on_cpu, cpu_notes = read_rows(CPU_ROWS)
    on_cuda, cuda_notes = read_rows(CUDA_ROWS)
    bad = write_page(on_cpu + on_cuda, "".join(cpu_notes[:1]), "".join(cuda_notes[:1]) or "not run yet")
    for sketch in hard_cases_pictures.SKETCHES:
        hard_cases_pictures.draw(sketch)
    for name in failed:
        print(f"failed: {name}", file=sys.stderr)
    return 1 if failed or bad else 0


if __name__ == "__main__":
    sys.exit(main())
