#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Makes doc/hard_cases.md from runs of the tests that know hard cases' answers.

usage: hard_cases.py [--build DIR] [--rows-only] [--commit NAME]

Runs every device test that includes tests/support/hard_case.h, on the CPU and, where
there is a GPU, with CUDA. CUDA rows are kept in doc/data/hard_cases_cuda.tsv, with
commit and device, so that the table has them on a machine without a GPU too.
"""
import argparse
import glob
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TABLE = os.path.join(ROOT, "doc", "hard_cases.md")
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


def natural(text):
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", text)]


def number(text):
    return f"{float(text):.7g}"


def ours(row):
    if row is None:
        return "not run"
    text = number(row["ours"])
    if row["relation"] == "=" and float(row["answer"]) != 0:
        off = float(row["ours"]) - float(row["answer"])
        text += " (exact)" if off == 0 else f" ({off:+.1e})"
    return text if row["holds"] == "holds" else f"**{text} FAILS**"


def cell(text):
    return text.replace("|", "\\|")


def table(rows):
    """Markdown: a heading, a table and its derivations for each theme."""
    backends = sorted({(r["backend"], r["precision"]) for r in rows},
                      key=lambda b: (b[0] != "cpu", b))
    themes = {}
    for r in rows:
        case = themes.setdefault(r["theme"], {}).setdefault((r["id"], r["what"]), {})
        case.setdefault((r["backend"], r["precision"]), r)
    text = []
    for theme, cases in themes.items():
        text += [f"## {theme}", ""]
        heads = ["", "case", "answer"] + [f"{b.upper()}, {p}" for b, p in backends]
        heads += ["tolerance", "why"]
        text += ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
        whys = {}
        for (ident, what), case in sorted(cases.items(), key=lambda c: natural(c[0][0])):
            any_row = next(iter(case.values()))
            exact = any_row["relation"] == "="
            why = whys.setdefault(any_row["derivation"], chr(ord("a") + len(whys) % 26) +
                                  (str(len(whys) // 26) if len(whys) >= 26 else ""))
            answer = number(any_row["answer"]) if exact else (
                "at most" if any_row["relation"] == "<=" else "at least")
            tolerance = f"{float(any_row['tolerance']):.1e}" if exact else number(any_row["answer"])
            if exact and float(any_row["tolerance"]) == 0:
                tolerance = "none"
            cells = [ident, what, answer] + [ours(case.get(b)) for b in backends]
            text.append("| " + " | ".join(cell(c) for c in cells + [tolerance, why]) + " |")
        text += [""] + [f"{name}. {cell(why)}.  " for why, name in whys.items()] + [""]
    return "\n".join(text)


INTRO = """# Hard cases

Where wall contacts go wrong, what the right answer is, and what comes out here. Every
row is a test: it fails where a number leaves its tolerance. Answers are closed forms or
references of their own in higher precision; each tolerance says what it is made of.
Numbers after an answer in brackets are ours less the answer.

Written by `./run bench hard-cases` from the runs; do not edit.

* {count} cases; {verdict}.
* CPU: commit {commit}, {cpu}.
* CUDA: {cuda}.
* A restart in mid-slide, and one against several MPI ranks (springs included, to the last
  bit), are input scripts: `tests/lammps/test_restart.py` and `tests/lammps/test_ranks.py`.
"""


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="DIR",
                        help="where bin/ is")
    parser.add_argument("--rows-only", action="store_true",
                        help="only run CUDA and write its rows (on a machine lent for that)")
    parser.add_argument("--commit", default=commit(), metavar="NAME",
                        help="what was built, where git does not know")
    args = parser.parse_args(arguments)

    cuda, failed = run(args.build, "cuda")
    if cuda is not None:
        lines = ["\t".join(r[c] for c in COLUMNS) for r in cuda]
        notes = [f"# commit {args.commit}, {gpu()}", "# " + "\t".join(COLUMNS)]
        write_whole(CUDA_ROWS, "\n".join(notes + lines) + "\n")
    if args.rows_only:
        if cuda is None:
            print("no CUDA device", file=sys.stderr)
            return 1
        return 1 if failed else 0

    rows, more = run(args.build, "cpu")
    failed += more
    kept, notes = read_rows(CUDA_ROWS)
    known = {(r["theme"], r["id"], r["what"]) for r in rows}
    rows += [r for r in kept if (r["theme"], r["id"], r["what"]) in known]
    bad = sum(r["holds"] != "holds" for r in rows)
    where = (("".join(notes[:1]) or "unknown commit") if kept else "not run yet") + (
        "" if cuda is not None or not kept else ", kept in `doc/data/hard_cases_cuda.tsv`")
    intro = INTRO.format(count=len(known), commit=args.commit, cpu=cpu(), cuda=where,
                         verdict="all hold" if not bad else f"**{bad} numbers fail**")
    write_whole(TABLE, intro + "\n" + table(rows))
    print(f"{TABLE}: {len(known)} cases, {bad} numbers fail")
    for name in failed:
        print(f"failed: {name}", file=sys.stderr)
    return 1 if failed or bad else 0


if __name__ == "__main__":
    sys.exit(main())
