#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs the same scripts with the program of a commit and with the one in build/, and compares all that they write byte by
byte: positions, forces, springs, totals, files, the log.

  tests/bits/compare.py main                     all scripts, after a change that must change nothing
  tests/bits/compare.py HEAD --quick             a sample, in a minute
  tests/bits/compare.py v0.1 --only 'jkr.*rotate|hopper'

COMMIT is anything that git knows, an archive of its sources (git archive), or a folder in which it was built. Its sources
are built once in ~/.cache/lsdcd/bits/COMMIT. build/ has to be there, and is brought up to date.

Scripts are every contact law on a folded mesh at rest, turning and wearing, some laws with each effect of a wall (laws.py),
and short runs of examples: bodies, servos, grains that come and go, nodes. Forms are plain (lmp-lsdcd), host (LAMMPS
4Jul2026, for heat) and kk (the same with Kokkos); the last two need --host, or what tests/lammps/hosts/build_host.sh built,
and plugins for it: -D LSDCD_KOKKOS_HOST=FOLDER. The exit status is 0 where no byte differs, 1 where one does, 2 where the
comparison itself failed.
"""
import argparse
import concurrent.futures
import itertools
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import tempfile

import laws

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "lsdcd"
HOSTS = pathlib.Path(os.environ.get("LSDCD_HOSTS") or CACHE / "hosts")
FORMS = ("plain", "host", "kk")
BATCH = 40    # scripts of laws.py in one process
LIMIT = 300    # seconds of a run
EXAMPLES = {"flap": "", "paddle": "", "screen": "", "belt": "", "insertion": "", "feed": "", "filling": "",
            "sagging-belt": "fill 3000 measure 2000", "wheel": "steps 3000", "piston": ""}
# Lines of a log that depend on time or place, and words of other lines.
LEFT_OUT = re.compile(r"^(Per MPI rank memory|Performance:|[\d.]+% CPU use|Pair|Bond|Neigh|Comm|Output|Modify|Rest|Other|Total wall time|"
                      r"  (Search|Choice|Forces|Waiting|Grids|Files) *\||.*lsdcd(kk)?plugin|  version  )|^Fix \S+ wall/lsdcd: fix wall/gran of this")
MASKED = ((r"^Loop time of \S+ on", "Loop time on"), (r"breakdown of the wall, \S+ %", "breakdown of the wall"),
          (r"CPU = [\d.e+-]+", "CPU"), (r"\b[\d.]+ (kB|MB), built in [\d.]+ s", "built"), (r"\bin \d+\.\d{3} s\b", ""),
          (r"\(\S*?([\w.]+\.(?:cpp|cu|h)):\d+\)", ""), (r"\.part-[\w-]+", ".part"))


def fail(text):
    print(f"compare.py: {text}", file=sys.stderr)
    sys.exit(2)


# ---- programs ----------------------------------------------------------------------------

def export(commit):
    """The folder of a commit's sources, or of an archive's; outside the tree."""
    if os.path.isfile(commit):
        name, archive = "archive-" + pathlib.Path(commit).stem, pathlib.Path(commit)
    else:
        done = subprocess.run(["git", "-C", ROOT, "rev-parse", "--verify", "--quiet", f"{commit}^{{commit}}"], stdout=subprocess.PIPE, text=True)
        name, archive = done.stdout.strip()[:12], None
        if done.returncode:
            fail(f"'{commit}' is no commit here, no folder of a build and no archive of sources")
    folder = CACHE / "bits" / name
    if not (folder / "source").exists():
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder) as part:
            if not archive:
                archive = pathlib.Path(part) / "sources.tar"
                subprocess.run(["git", "-C", ROOT, "archive", "-o", archive, name], check=True)
            with tarfile.open(archive) as tar:
                tar.extractall(pathlib.Path(part) / "source")
            inside = list((pathlib.Path(part) / "source").iterdir())
            (inside[0] if len(inside) == 1 else pathlib.Path(part) / "source").rename(folder / "source")
    return folder / "source"


def build(source, folder, targets, words):
    """Inside the sources, as ours is: ccache then knows what both have in common."""
    environment = dict(os.environ, CCACHE_BASEDIR=str(source), CCACHE_NOHASHDIR="1")
    configure = ["cmake", "-S", source, "-B", folder, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release", "-D", "LSDCD_TESTS=OFF", *words]
    for command in (configure, ["cmake", "--build", folder, "--target", *targets]):
        print(shlex.join(map(str, command)), flush=True)
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            fail("it does not build:\n" + done.stdout[-3000:])


def plugin_of(folder):
    """For a LAMMPS with Kokkos, or None."""
    return next((p for p in sorted((folder / "lib").glob("lsdcdkkplugin*.so")) if not p.stem.endswith("-styles")), None)


def command_of(form, folder, host, flags, script):
    """What runs a script, which is written, in a form: LAMMPS loads the plugin first."""
    if form == "plain":
        return [folder / "bin" / "lmp-lsdcd", "-in", script]
    script.with_name("in.host").write_text(f"plugin load {plugin_of(folder)}\ninclude {script}\n")
    return [host / "lmp", "-in", script.with_name("in.host"), *(flags if form == "kk" else [])]


# ---- scripts -----------------------------------------------------------------------------

class Script:
    """A name, words of the command line, and parts: scripts of laws.py that run one after the other."""

    def __init__(self, name, parts, words=(), of_laws=True):
        self.name, self.parts, self.words, self.of_laws = name, parts, words, of_laws


def scripts_of(form, only, quick):
    """Laws in batches, which take long to start one by one, and examples. Only `host` and `kk` know heat."""
    mine = [(name, text) for name, text, new in laws.scripts(8 if quick else 1)
            if (new if form == "host" else form == "kk" or not new) and (not only or only.search(name))]
    if form == "kk":    # an atom-style variable has another letter there
        mine = [(name, re.sub(r"(variable\s+\S+\s+atom\s.*)\bF_", r"\1f_", text)) for name, text in mine]
    found = [Script(f"{part[0][0]} and {len(part) - 1} more", part) for part in
             (mine[k:k + BATCH] for k in range(0, len(mine), BATCH))]
    if form == "plain":
        for name, words in EXAMPLES.items():
            if (not only or only.search(name)) and not (quick and name not in ("flap", "insertion")):
                path = ROOT / "examples" / name
                pairs = [*zip(words.split()[::2], words.split()[1::2]), ("dir", path), ("png", 0)]
                found.append(Script(name, [(name, (path / f"in.{name}").read_text())],
                                    [word for pair in pairs for word in ("-var", *map(str, pair))], of_laws=False))
    return found


# ---- a run, and what differs -------------------------------------------------------------

def masked(log, folder):
    """A log without what depends on time or place."""
    lines = [line for line in log.replace(str(folder), "FOLDER").split("\n") if not LEFT_OUT.search(line)]
    for pattern, instead in MASKED:
        lines = [re.sub(pattern, instead, line) for line in lines]
    return "\n".join(lines)


def run(script, command, ranks, folder, files):
    """{file: bytes} of all that a run leaves, and why it stopped, or "" where it did not."""
    shutil.copytree(files, folder, dirs_exist_ok=True) if script.of_laws else folder.mkdir(parents=True, exist_ok=True)
    given = {p.name for p in folder.iterdir()} | {"in.script", "in.host"}
    (folder / "in.script").write_text("".join(text for _, text in script.parts))
    words = [*map(str, command(folder / "in.script")), *script.words, "-log", "none", "-nocite"]
    words = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-np", str(ranks), *words] if ranks > 1 else words
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_mpi_yield_when_idle="1", OMPI_MCA_hwloc_base_binding_policy="none")
    if ranks > 1 and os.environ.get("LSDCD_PATIENT_YIELD"):    # tests/lammps/patient_yield.cpp
        environment["LD_PRELOAD"] = os.environ["LSDCD_PATIENT_YIELD"]
    done = subprocess.run(words, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=LIMIT)
    log = masked(done.stdout.decode(errors="replace"), folder)
    found = {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file() and p.name not in given}
    found["log"] = log.encode()
    why = re.search(r"^ERROR.*", log, re.M)
    return found, (why[0] if why else f"status {done.returncode}") if done.returncode else ""


def numbers(line):
    for word in re.split(r"[\s,]+", line):
        try:
            yield float(word)
        except ValueError:
            pass


def differences(a, b):
    """A line for each file that is not the same: how many lines differ, the first pair, the largest relative difference."""
    told = []
    for name in sorted(a.keys() | b.keys()):
        if name not in a or name not in b:
            told.append(f"{name}: of {'the commit' if name in a else 'this one'} only")
        elif a[name] != b[name]:
            if b"\0" in a[name]:
                told.append(f"{name}: {sum(x != y for x, y in itertools.zip_longest(a[name], b[name]))} bytes")
                continue
            pairs = [(x, y) for x, y in itertools.zip_longest(*(f[name].decode(errors="replace").split("\n") for f in (a, b)), fillvalue="")
                     if x != y]
            largest = max((abs(u - v) / max(abs(u), abs(v)) for x, y in pairs for u, v in zip(numbers(x), numbers(y)) if u != v), default=0)
            told.append(f"{name}: {len(pairs)} lines, largest relative difference {largest:.2g}: '{pairs[0][0].strip()[:60]}' is now "
                        f"'{pairs[0][1].strip()[:60]}'")
    return told


def compare(script, ranks, commands, place, files, keep):
    """What differs, as lines. A script that stops keeps its batch from going on: then they run one by one."""
    results = [run(script, command, ranks, place / name, files) for name, command in zip(("commit", "this"), commands)]
    (a, stopped), (b, ours) = results
    shutil.rmtree(place)
    if (stopped or ours) and len(script.parts) > 1:
        return [line for part in script.parts
                for line in compare(Script(part[0], [part], script.words), ranks, commands, place, files, keep)]
    told = [f"stops with '{stopped or 'no error'}', now with '{ours or 'no error'}'"] if stopped != ours else [] if stopped else differences(a, b)
    if told and keep:
        for name, each in (("commit", a), ("this", b)):
            for file, data in each.items():
                path = keep / f"{script.parts[0][0]}-{ranks}" / name / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
    return [f"{script.name} on {ranks}: {line}" for line in told]


# ---- words -------------------------------------------------------------------------------

def read_words():
    p = argparse.ArgumentParser(prog="tests/bits/compare.py", description=__doc__, allow_abbrev=False,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("commit", metavar="COMMIT", help="to compare with")
    p.add_argument("--build", type=pathlib.Path, default=ROOT / "build", metavar="FOLDER", help="of the program to compare (build)")
    p.add_argument("--only", type=re.compile, metavar="PATTERN", help="scripts whose name has a match of a regular expression")
    p.add_argument("--quick", action="store_true", help="a sample, in a minute")
    p.add_argument("--ranks", default="1,2", metavar="LIST", help="numbers of processes (1,2)")
    p.add_argument("--forms", default="plain", metavar="LIST", help="of plain, host, kk (plain)")
    p.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at once (one a core)")
    p.add_argument("--host", type=pathlib.Path, default=HOSTS / "20260704", metavar="FOLDER", help="of a LAMMPS 4Jul2026 with Kokkos (%(default)s)")
    p.add_argument("--kokkos-flags", default="-k on -sf kk", metavar="WORDS",
                   help="of that LAMMPS (%(default)s); on a GPU '-k on g 1 -sf kk -pk kokkos newton off neigh half'")
    p.add_argument("--cuda", action="store_true", help="build the commit with CUDA, as build/ is")
    p.add_argument("--cmake", default="", metavar="WORDS", help="further words of cmake for the commit's build")
    p.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="leave what differs there")
    p.add_argument("--as-built", action="store_true", help="take the program as it is; else it is built again")
    p.add_argument("--list", action="store_true", help="names of the scripts, and no more")
    return p.parse_args()


def main():
    o = read_words()
    forms = o.forms.split(",")
    if set(forms) - set(FORMS):
        fail(f"--forms: there are {', '.join(FORMS)}")
    if o.list:
        print("\n".join(name for form in forms for s in scripts_of(form, o.only, o.quick) for name, _ in s.parts))
        return 0
    targets = ["lmp-lsdcd"] * ("plain" in forms) + ["lsdcdkkplugin"] * bool({"host", "kk"} & set(forms))
    if (pathlib.Path(o.commit) / "bin").is_dir():
        reference = pathlib.Path(o.commit).resolve()
    else:
        source = export(o.commit)
        reference = source / ("build-cuda" if o.cuda else "build")
        if not ((reference / "bin" / "lmp-lsdcd").exists() and (plugin_of(reference) or len(targets) == 1)):
            host = [f"-DLSDCD_KOKKOS_HOST={o.host}"] if "lsdcdkkplugin" in targets else []
            build(source, reference, targets, [f"-DLSDCD_CUDA={'ON' if o.cuda else 'OFF'}", *host, *shlex.split(o.cmake)])
    if not o.as_built and subprocess.run(["cmake", "--build", o.build, "--target", *targets]).returncode:
        fail(f"{o.build} does not build")
    folders = (reference, o.build.resolve())
    for form, folder in itertools.product(forms, folders):
        missing = folder / "bin" / "lmp-lsdcd" if form == "plain" else plugin_of(folder) or folder / "lib" / "lsdcdkkplugin.so"
        for path in (missing, *((o.host / "lmp",) if form != "plain" else ())):
            if not path.exists():
                fail(f"form {form}: there is no {path}")

    told, count = [], 0
    with tempfile.TemporaryDirectory(prefix="bits-") as scratch, concurrent.futures.ThreadPoolExecutor(o.jobs) as pool:
        scratch = pathlib.Path(scratch)
        (scratch / "files").mkdir()
        laws.write_files(scratch / "files")
        jobs = []
        for form in forms:
            commands = [lambda script, form=form, folder=folder: command_of(form, folder, o.host.resolve(), shlex.split(o.kokkos_flags), script)
                        for folder in folders]
            for script, ranks in itertools.product(scripts_of(form, o.only, o.quick), map(int, o.ranks.split(","))):
                count += len(script.parts)
                jobs.append(pool.submit(compare, script, ranks, commands, scratch / f"job{len(jobs)}", scratch / "files", o.keep))
        for job in concurrent.futures.as_completed(jobs):
            told += job.result()
    print("\n".join(sorted(told)[:60]))
    print(f"{count} scripts compared: " + (f"{len(told)} files differ" if told else "0 bytes differ"))
    return 1 if told else 0 if count else 2


if __name__ == "__main__":
    sys.exit(main())
