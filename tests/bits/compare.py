#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs the same scripts with the program of a commit and with the one in build/, and compares all that they
write byte by byte: positions, forces, springs, totals, files, the log.

usage: compare.py COMMIT [--build FOLDER] [--only PATTERN] [--quick] [--ranks 1,2,4] [--jobs N] [--keep FOLDER]

  tests/bits/compare.py main                     all scripts, after a change that must change nothing
  tests/bits/compare.py HEAD --quick             a sample, in two minutes
  tests/bits/compare.py v0.1 --only 'jkr.*rotate|test_restart'
  tests/bits/compare.py main --list              names of the scripts

COMMIT is anything that git knows, an archive of its sources (git archive), or a folder in which it was
built. Its sources are exported to ~/.cache/lsdcd/bits/COMMIT and built there once; what it answers is kept
there as checksums, so that it runs once for each script. build/ has to be there, and is brought up to date:
  cmake --preset cuda -B build -D LSDCD_CUDA=OFF && cmake --build build --target lmp-lsdcd

Scripts are
  laws of contact   every sub-model on a folded mesh at rest, turning and wearing, and some laws with each
                    effect of a wall: motions, precisions, several meshes, servo, periodic boxes (laws.py)
  recorded runs     every run of LAMMPS that the scripts of tests/lammps start (record.py)
Forms are
  plain             lmp-lsdcd, on each number of processes
  host              LAMMPS 4Jul2026, for heat; kk: the same with Kokkos. Both need --host, or what
                    tests/lammps/hosts/build_host.sh built, and plugins built for it: -D LSDCD_KOKKOS_HOST=FOLDER
What cannot be run is skipped by name.

Each quantity that differs is listed with the number of its values and its largest absolute and relative
difference. The exit status is 0 where nothing differs but what accepted.txt allows, 1 where something does, 2 where
the comparison itself failed.
"""
import argparse
import concurrent.futures
import dataclasses
import fnmatch
import math
import os
import pathlib
import re
import shlex
import sys
import tempfile
import threading
import time

import differ
import laws
import programs
import record
import replay
from programs import CACHE, HERE, ROOT, say

BATCH = 40    # scripts of the catalogue in one process
FORMS = ("plain", "host", "kk")
KOKKOS_FLAGS = "-k on -sf kk"


# ---- scripts -----------------------------------------------------------------------------

def catalogue(folder, only, every):
    """Of laws.py, in batches that one process runs."""
    laws.write_files(folder)
    files = {path.name: path for path in folder.iterdir()}
    some = [one for one in laws.scripts(every) if not only or only.search(one[0])]
    batches = []
    for new in (False, True):
        mine = [one for one in some if one[2] == new]
        for k in range(0, len(mine), BATCH):
            part = mine[k:k + BATCH]
            batches.append(replay.Script(f"laws {part[0][0]} and {len(part) - 1} more", files=files, new=new,
                                         parts={name: text for name, text, _ in part}))
    return batches


def single(batch, name):
    """One script of a batch, by itself."""
    return dataclasses.replace(batch, name=name, parts={name: batch.parts[name]})


def from_record(name, one, store):
    return replay.Script(name, text=one["script"], words=one["words"], ranks=one["ranks"],
                         files={file: store / sha for file, sha in one["files"].items()},
                         environment=one["environment"])


# ---- comparing ---------------------------------------------------------------------------

class Job:
    """A script in a form on a number of processes."""

    def __init__(self, script, form, ranks):
        self.script, self.form, self.ranks = script, form, ranks
        self.seconds = 0.0
        self.found = []    # (script, Difference)
        self.error = None

    def title(self):
        return f"{self.script.name} ({self.form}, {self.ranks})"


class Comparison:
    """Runs jobs with both programs."""

    def __init__(self, reference, ours, host, answers, scratch, keep):
        self.reference, self.ours, self.host = reference, ours, host
        self.answers, self.scratch, self.keep = answers, scratch, keep
        self.harness = replay.source_of_harness()
        self.lock, self.count = threading.Lock(), 0
        self.without_kokkos = set()    # scripts of the catalogue that stop there with the reference
        self.stops = {}    # (script, form): whether it stops on one process

    def run(self, job, program, script=None):
        with self.lock:
            self.count += 1
            place = self.scratch / f"job{self.count}"
        return replay.run(script or job.script, job.ranks, job.form, program, self.host, place)

    def of_reference(self, job):
        """(status, sums, files or None); a script that only stops for what was added goes as it is."""
        script = job.script
        for _ in range(2):
            key = replay.key_of(script, job.ranks, job.form, self.reference, self.host, self.harness)
            answer = self.answers.get(key)
            files = None
            if answer is None:
                status, files, seconds = self.run(job, self.reference, script)
                answer = self.answers.put(key, status, files, seconds)
            if not answer["status"] or script.bare or script.parts:
                break
            # Where the script stops all the same, what was added has nothing to do with it.
            script = dataclasses.replace(script, bare=True)
        job.script = script
        return answer, files

    def compare(self, job):
        answer, files = self.of_reference(job)
        job.seconds = answer["seconds"]
        if answer["status"] == -1:
            job.error = f"takes more than {replay.LIMIT} s with the reference"
            return
        alone = len(job.script.parts) == 1 and job.form == "kk"    # not every command has a form for Kokkos
        if answer["status"] and job.script.parts and not alone:
            self.one_by_one(job, "the reference")
            return
        if answer["status"] and alone:
            self.without_kokkos.add(job.script.name)
        if job.ranks == 1:
            self.stops[(job.script.name, job.form)] = bool(answer["status"])
        status, ours, seconds = self.run(job, self.ours)
        job.seconds += seconds
        if status and not answer["status"] and len(job.script.parts) > 1:
            self.one_by_one(job, "ours")
            return
        if {name: replay.digest(data) for name, data in ours.items()} == answer["files"]:
            return
        again = self.run(job, self.reference)[1]
        unsteady = {name: replay.digest(data) for name, data in again.items()} != answer["files"]
        files = files or again
        self.list_differences(job, files, ours, unsteady)

    def one_by_one(self, job, whose):
        """A script of a batch stopped, which keeps the others from running."""
        if len(job.script.parts) == 1:
            words = self.run(job, self.reference)[1]["stdout"].decode().split("\n")
            job.error = f"stops with {whose}: " + next((line for line in words if line.startswith("ERROR")), words[0])
            return
        for name in job.script.parts:
            one = Job(single(job.script, name), job.form, job.ranks)
            self.compare(one)
            job.found += one.found
            if one.error:
                job.error = (job.error or "") + f"\n    {name} {one.error}"

    def list_differences(self, job, files, ours, unsteady):
        by_script = {}
        for name in sorted(files.keys() | ours.keys()):
            whole = replay.part_of(name, job.script.parts) if job.script.parts else job.script.name
            short = name[len(whole):].lstrip("._") if job.script.parts and name.startswith(whole) else name
            for of, where in ((files, 0), (ours, 1)):
                if name in of:
                    by_script.setdefault(whole, ({}, {}))[where][short] = of[name]
        for whole, (a, b) in by_script.items():
            found = differ.compare(a, b)
            if unsteady:
                found = [one._replace(note="(the reference differs from run to run) " + one.note) for one in found]
            job.found += [(whole, one) for one in found]
        if self.keep:
            folder = self.keep / re.sub(r"[^\w.-]+", "_", job.title())
            for where, of in (("reference", files), ("ours", ours)):
                for name, data in of.items():
                    path = folder / where / name
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_bytes(data)
            (folder / "in.script").write_text(replay.text_for(job.script, job.form, []))


# ---- what may differ ---------------------------------------------------------------------

def read_accepted(path):
    """[(script, quantity, bound, derivation)] of lines `script | quantity | bound | derivation`."""
    rows = []
    for number, line in enumerate(path.read_text().splitlines() if path.exists() else [], 1):
        if not line.strip() or line.startswith("#"):
            continue
        parts = [part.strip() for part in line.split("|")]
        bound = re.fullmatch(r"(relative|absolute) ([\d.e+-]+)|any", parts[2]) if len(parts) == 4 else None
        if not bound or not parts[3]:
            programs.fail(f"{path}:{number}: a line is 'script | quantity | bound | derivation', with the bound "
                          "'relative 1e-12', 'absolute 1e-12' or 'any'")
        rows.append((parts[0], parts[1], parts[2], parts[3]))
    return rows


def is_accepted(script, one, rows):
    for pattern, quantity, bound, _ in rows:
        if fnmatch.fnmatchcase(script, pattern) and fnmatch.fnmatchcase(one.quantity, quantity):
            kind, _, value = bound.partition(" ")
            if bound == "any" or (one.relative if kind == "relative" else one.absolute) <= float(value):
                return True
    return False


# ---- report ------------------------------------------------------------------------------

def size(x):
    return "not a number" if math.isinf(x) else f"{x:.3g}"


def write_table(rows, out):
    """rows: (script, form, ranks, Difference)."""
    out.write("script\tform\tprocesses\tquantity\tvalues\tlargest absolute\tlargest relative\tnote\n")
    for script_name, form, ranks, one in rows:
        out.write(f"{script_name}\t{form}\t{ranks}\t{one.quantity}\t{one.values}\t{size(one.absolute)}\t"
                  f"{size(one.relative)}\t{one.note}\n")


def apart(values, absolute, relative):
    many = f"{values} value{'s' * (values != 1)}"
    return many if math.isinf(absolute) else f"{many}, largest difference {size(absolute)}, relative {size(relative)}"


def list_rows(rows, most=40):
    """All where they are few; else each quantity over all scripts, then scripts."""
    if len(rows) <= most:
        for script_name, form, ranks, one in rows:
            say(f"  {script_name}, {form} on {ranks}: {one.quantity}: {apart(*one[1:4])}{one.note and ', ' + one.note}")
        return
    by_quantity, by_script = {}, {}
    for script_name, form, ranks, one in rows:
        known = by_quantity.setdefault(one.quantity, [set(), 0, 0.0, 0.0])
        known[0].add((script_name, form, ranks))
        known[1] += one.values
        known[2:] = max(known[2], one.absolute), max(known[3], one.relative)
        by_script.setdefault((script_name, form, ranks), []).append(one)
    for quantity, (scripts, *of) in sorted(by_quantity.items(), key=lambda q: -len(q[1][0]))[:most]:
        say(f"  {quantity}: in {len(scripts)} runs, {apart(*of)}")
    say("of which")
    for (script_name, form, ranks), ones in list(by_script.items())[:most]:
        worst = max(ones, key=lambda one: one.relative)
        say(f"  {script_name}, {form} on {ranks}: {len(ones)} quantities; {worst.quantity}: {apart(*worst[1:4])}"
            f"{worst.note and ', ' + worst.note}")
    if len(by_quantity) > most or len(by_script) > most:
        say(f"  ... of {len(by_quantity)} quantities and {len(by_script)} runs; --table FILE has all")


# ---- words -------------------------------------------------------------------------------

def read_words(words):
    p = argparse.ArgumentParser(prog="tests/bits/compare.py", description=__doc__, allow_abbrev=False,
                                formatter_class=argparse.RawDescriptionHelpFormatter, usage=argparse.SUPPRESS)
    p.add_argument("commit", metavar="COMMIT", help="the reference")
    p.add_argument("--build", default=str(ROOT / "build"), metavar="FOLDER", help="of the program to compare (build)")
    p.add_argument("--only", metavar="PATTERN", help="scripts whose name has a match of a regular expression")
    p.add_argument("--quick", action="store_true", help="a sample, on 1 and 2 processes, in two minutes")
    p.add_argument("--ranks", metavar="LIST", help="numbers of processes (1,2,4)")
    p.add_argument("--thorough", action="store_true", help="each script on each of them, not on them in turns")
    p.add_argument("--forms", default=",".join(FORMS), metavar="LIST", help="of plain, host, kk (all)")
    p.add_argument("--without-recorded", action="store_true", help="laws of contact only")
    p.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at once (one a core)")
    p.add_argument("--host", metavar="FOLDER", help="of a LAMMPS 4Jul2026 with KOKKOS and PLUGIN "
                   f"({programs.HOSTS / programs.VERSION})")
    p.add_argument("--kokkos-flags", default=KOKKOS_FLAGS, metavar="WORDS",
                   help="of that LAMMPS (%(default)s); on a GPU '-k on g 1 -sf kk -pk kokkos newton off neigh half'")
    p.add_argument("--cuda", action="store_true", help="build the commit with CUDA, as build/ is")
    p.add_argument("--cmake", default="", metavar="WORDS", help="further words of cmake for the commit's build")
    p.add_argument("--accepted", default=str(HERE / "accepted.txt"), metavar="FILE", help="what may differ")
    p.add_argument("--table", metavar="FILE", help="write all differences there, with tabs")
    p.add_argument("--keep", metavar="FOLDER", help="leave the scripts and files that differ there")
    p.add_argument("--as-built", action="store_true", help="take the program as it is; else it is built again")
    p.add_argument("--list", action="store_true", help="names of the scripts, and no more")
    o = p.parse_args(words)
    try:
        o.ranks = [int(word) for word in (o.ranks or ("1,2" if o.quick else "1,2,4")).split(",")]
        o.only = re.compile(o.only) if o.only else None
    except (ValueError, re.error) as error:
        p.error(str(error))
    o.forms = o.forms.split(",")
    if set(o.forms) - set(FORMS):
        p.error(f"--forms: there are {', '.join(FORMS)}")
    return o


def reference_of(o, kokkos_folder, version):
    """The program of the commit, built where it is not, its sources, and where its answers are kept."""
    if (pathlib.Path(o.commit) / "bin").is_dir():
        program = programs.Program(o.commit, o.commit, version)
        cache = (program.folder / "CMakeCache.txt")
        home = re.search(r"CMAKE_HOME_DIRECTORY:INTERNAL=(.*)", cache.read_text()) if cache.exists() else None
        return program, pathlib.Path(home.group(1)) if home else ROOT, CACHE / "bits" / "answers"
    folder, name = programs.export(o.commit)
    # Inside the sources, as ours is: ccache then knows what both have in common.
    build = folder / "source" / ("build-cuda" if o.cuda else "build")
    with programs.alone(folder):
        program = programs.Program(name, build, version)
        if ("plain" in o.forms and not program.lmp) or (kokkos_folder and not program.plugin):
            programs.build(folder / "source", build, kokkos_folder, o)
            program = programs.Program(name, build, version)
    return program, folder / "source", CACHE / "bits" / "answers"


def ranks_of(k, script, ranks, thorough):
    """Numbers of processes of script k. To start processes takes most of the time, so that laws are run on the
    first number and on the others in turns, and of recorded runs a third."""
    if thorough:
        return ranks
    first, *others = ranks
    turn = [others[k % len(others)]] if others and (script.parts or k % 3 == 0) else []
    return [n for n in ranks if n == first or n in turn or n == script.ranks]


def jobs_of(scripts, forms, ranks, thorough):
    """lmp-lsdcd runs all but what needs LAMMPS 4Jul2026, that runs the rest, and with Kokkos all again."""
    return [Job(script, form, n) for k, script in enumerate(scripts) for f, form in enumerate(forms)
            if not (script.new and form == "plain") and (script.new or form != "host")
            for n in ranks_of(k + f, script, ranks, thorough)]


def main(words=None):
    o = read_words(words)
    start = time.time()
    if o.keep:
        o.keep = pathlib.Path(o.keep).resolve()
        o.keep.mkdir(parents=True, exist_ok=True)
    kokkos_folder, host_lmp = programs.find_host(o.host) if set(o.forms) & {"host", "kk"} else (None, None)
    version = programs.version_of(kokkos_folder)
    reference, source, kept = reference_of(o, kokkos_folder, version)
    ours = programs.Program("this one", o.build, version)
    if not ours.lmp and not ours.plugin:
        programs.fail(f"{o.build} has neither bin/lmp-lsdcd nor a plugin for Kokkos; build it first: cmake --preset cuda "
                      f"-B {o.build} -D LSDCD_CUDA=OFF && cmake --build {o.build} --target lmp-lsdcd")
    if not o.as_built:
        ours.bring_up_to_date()
        ours = programs.Program("this one", o.build, version)
    host = programs.Host(host_lmp, shlex.split(o.kokkos_flags)) if host_lmp else None

    skipped, forms = [], []
    for form in o.forms:
        if form == "plain":
            lacks = [p.name for p in (reference, ours) if not p.lmp]
            why = f"no lmp-lsdcd of {' and of '.join(lacks)}" if lacks else None
        else:
            lacks = [p.name for p in (reference, ours) if not p.plugin]
            why = ("no LAMMPS 4Jul2026 with Kokkos (tests/lammps/hosts/build_host.sh, or --host)" if not host else
                   f"no lsdcdkkplugin of {' and of '.join(lacks)} (-D LSDCD_KOKKOS_HOST={kokkos_folder}, target "
                   "lsdcdkkplugin)" if lacks else None)
        forms += [] if why else [form]
        skipped += [f"form {form}: {why}"] if why else []

    with tempfile.TemporaryDirectory(prefix="bits-") as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "files").mkdir()
        scripts = catalogue(scratch / "files", o.only, 8 if o.quick else 1)
        if not o.without_recorded and "plain" in forms:
            wanted = record.FEW if o.quick else None
            with programs.alone(CACHE / "bits" / "recorded"):
                folder, runs = record.recorded(reference, source, wanted, o.jobs)
            scripts += [from_record(name, one, folder / "store") for name, one in runs
                        if not o.only or o.only.search(name)]
            skipped += [f"runs of {name}: {why}" for name, why in record.LEFT_OUT.items() if not o.quick]
        if o.list:
            for script in scripts:
                print("\n".join(script.parts or [script.name]))
            return 0
        jobs = jobs_of(scripts, forms, o.ranks, o.thorough)
        n_scripts = sum(len(s.parts) or 1 for s in scripts)
        say(f"{n_scripts} scripts, {len(jobs)} runs on {', '.join(map(str, o.ranks))} processes, {o.jobs} at once: "
            f"{reference.name} and {ours.folder}")
        comparison = Comparison(reference, ours, host, replay.Answers(kept), scratch, o.keep)
        failed, rows = compare_all(comparison, jobs, o.jobs)
        if comparison.without_kokkos:
            skipped.append(f"form kk: stop with the reference, too: {', '.join(sorted(comparison.without_kokkos))}")

    accepted = read_accepted(pathlib.Path(o.accepted))
    known = [row for row in rows if is_accepted(row[0], row[3], accepted)]
    rows = [row for row in rows if not is_accepted(row[0], row[3], accepted)]
    if o.table:
        with open(o.table, "w") as out:
            write_table(rows, out)
    for line in skipped:
        say(f"skipped  {line}")
    for job in failed:
        say(f"FAILED   {job.title()}: {job.error}")
    list_rows(rows)
    values = sum(row[3].values for row in rows)
    say(f"{len(jobs) - len(failed)} runs compared in {time.time() - start:.0f} s: " +
        (f"{values} values differ, in {len(rows)} quantities of {len({row[0] for row in rows})} scripts" if rows else
         "0 bytes differ") +
        (f"; {len(failed)} runs could not be compared" if failed else "") +
        (f"; {len(known)} quantities differ as {o.accepted} allows" if known else ""))
    if not jobs:
        say("no script has such a name")
    return 2 if failed or not jobs else 1 if rows else 0


def compare_all(comparison, jobs, at_once):
    """(jobs that could not be compared, rows of what differs)"""
    rows, failed, began, told = [], [], time.time(), time.time()
    done = 0

    def one(job):
        try:
            comparison.compare(job)
        except Exception as error:    # one job must not end the others
            job.error = f"{type(error).__name__}: {error}"
        return job

    # On one process first: what stops there is run on the number that it was recorded on, and on no other.
    for stage in ([j for j in jobs if j.ranks == 1], [j for j in jobs if j.ranks != 1]):
        stage = [j for j in stage if not (comparison.stops.get((j.script.name, j.form)) and j.ranks != j.script.ranks)]
        stage.sort(key=lambda j: -j.ranks * (len(j.script.parts) or 1))
        with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
            for job in concurrent.futures.as_completed([pool.submit(one, j) for j in stage]):
                job = job.result()
                done += 1
                if job.error:
                    failed.append(job)
                rows += [(script_name, job.form, job.ranks, found) for script_name, found in job.found]
                if time.time() - told > 20:
                    told = time.time()
                    say(f"  {done} runs in {told - began:.0f} s, {len(rows)} quantities differ, {len(failed)} failed")
    rows.sort(key=lambda row: (row[0], row[1], row[2], row[3].quantity))
    return failed, rows


if __name__ == "__main__":
    sys.exit(main())
