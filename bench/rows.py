# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Rows that benchmarks print: CSV, most in the format of bench.h."""
import csv
import io
import os
import pathlib
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DATA = ROOT / "doc" / "data"
COLUMNS = ("program", "case", "device", "commit", "compiler", "triangles", "spheres", "length", "order",
           "repeats", "median_ms", "min_ms", "max_ms", "bytes", "copy_gb_s", "floor_ms", "ratio", "facts")
KEY = ("program", "case", "triangles", "spheres", "length", "order")


# ---- where they are from -----------------------------------------------------------------

def git(*words):
    done = subprocess.run(["git", "-C", str(ROOT), *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


def commit():
    name = git("rev-parse", "--short=10", "HEAD") or "unknown"
    return name + ("+changes" if git("status", "--porcelain", "--", "src", "tests") else "")


def gpu():
    try:
        done = subprocess.run(["nvidia-smi", "--query-gpu=name", "--format=csv,noheader"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return done.stdout.splitlines()[0].strip() if done.stdout else "a GPU"
    except OSError:
        return "a GPU"


def cpu():
    try:
        return re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text()).group(1).strip()
    except (OSError, AttributeError):
        return "a CPU"


# ---- rows --------------------------------------------------------------------------------

def timed(program, case, named, triangles, spheres, order, ms, device=None, compiler="", **facts):
    """A row from times in ms, which may be differences; of a program on one core where no device is named."""
    r = dict.fromkeys(COLUMNS, "")
    r.update(program=program, case=case, device=device or f"CPU, 1 thread, {cpu()}", commit=named, compiler=compiler,
             triangles=triangles, spheres=spheres, length=0, order=order, repeats=len(ms),
             facts=" ".join(f"{k}={v}" for k, v in facts.items()))
    for name, value in (("median_ms", statistics.median), ("min_ms", min), ("max_ms", max)):
        r[name] = f"{value(ms):.5g}" if ms else ""
    say(", ".join(str(v) for v in list(r.values())[1:] if v != ""))
    return {k: str(v) for k, v in r.items()}


def say(text):
    """Progress: what a benchmark prints beside its rows."""
    print(text, file=sys.stderr, flush=True)


def facts(row):
    return dict(f.split("=", 1) for f in row["facts"].split())


def as_csv(rows, delimiter=","):
    text = io.StringIO()
    writer = csv.DictWriter(text, rows[0].keys(), lineterminator="\n", delimiter=delimiter)
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def parse(text, delimiter=","):
    return list(csv.DictReader(io.StringIO(text), delimiter=delimiter))


# ---- rows that are kept ------------------------------------------------------------------

def key(row):
    """Rows with the same key measure the same; those of other programs have a line each."""
    if "program" not in row:
        return tuple(row.values())
    of = facts(row)
    return (*(row[k] for k in KEY), *(of.get(k) for k in ("host", "ranks")))


def replaced(old, new):
    """Rows of old, each in place of what new has under its key, then what only new has."""
    fresh = {key(r): r for r in new}
    return [fresh.pop(key(r), r) for r in old] + list(fresh.values())


def read(folder, file, device="cpu"):
    path = pathlib.Path(folder, f"{file}_{device}.csv")
    return parse(path.read_text()) if path.exists() else []


def keep(folder, file, text, device):
    """Puts the rows that a program printed into FOLDER/FILE_DEVICE.csv, or with another ending that FILE has, by the device that a row names;
    the paths."""
    file, _, ending = file.partition(".")
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    heads = text.partition("\n")[0]
    if "program" not in heads.split(","):    # of one run, and all that there is
        made = {device: text}
    else:
        by_device = {}
        for row in parse(text):
            by_device.setdefault("cpu" if row["device"].startswith("CPU") else "cuda", []).append(row)
        made = {d: as_csv(replaced(read(folder, file, d), its)) for d, its in by_device.items()}
    paths = []
    for d, each in made.items():
        paths.append(folder / f"{file}_{d}.{ending or 'csv'}")
        part = paths[-1].with_name(paths[-1].name + ".part")
        part.write_text(each)
        os.replace(part, paths[-1])
    return paths
