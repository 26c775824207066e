#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks what a release has to agree in; RELEASING.md says when.

    check_release.py                     the files: versions, CHANGELOG.md, doc/formats.md, styles of cmake/packaging
    check_release.py --build FOLDER      also the programs that were built there
    check_release.py --packages FOLDER   also the names of what ./run package made
    check_release.py --release           also that nothing is changed and not committed, and that the
                                         commits that pages and their data name are in the history, and that the
                                         tests of a GPU (gpu_record.py) ran on today's sources

Prints a line per fact; ends with 1 if one fails. The version is that of CMakeLists.txt.
"""
import argparse
import csv
import os
import pathlib
import re
import subprocess
import sys

import gpu_record

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("README.md", "doc/**/*.md", "doc/**/*.rst", "examples/*/*.md", "doc/data/*.csv", "doc/data/*.tsv")
failed = 0


def fact(name, true, detail=""):
    global failed
    failed += not true
    print(f"{'PASS' if true else 'FAIL'} {name}{'' if true else f': {detail}'}", flush=True)


def found(path, pattern):
    """What the groups of the pattern are in a file, joined by dots."""
    match = re.search(pattern, (ROOT / path).read_text(encoding="utf-8"), re.M)
    return ".".join(match.groups()) if match else None


def output_of(*words):
    ours = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_ess_singleton_isolated": "1",
            "OMPI_MCA_pml": "ob1", "OMP_NUM_THREADS": "1"}
    done = subprocess.run([str(word) for word in words], cwd=ROOT, env={**os.environ, **ours}, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def check_files(version):
    number = r"(\d+)[^\d]+?"
    for path, pattern in (
            ("CITATION.cff", r"^version: (\S+)$"),
            ("src/api/lsdcd.h", rf"_VERSION_MAJOR {number}_VERSION_MINOR {number}_VERSION_PATCH (\d+)$"),
            ("CHANGELOG.md", r"^## \[?(\d[\w.]*)")):
        there = found(path, pattern)
        fact(f"{path} has version {version}", there == version, there)


def check_formats():
    """doc/formats.md against the sources."""
    for row, path, pattern in (
            (r"grid cache [^|]*\| (\d+)", "src/grid/cache/cache_format.h", r"kFormat = (\d+);"),
            (r"restart data: the list of blocks \| (\d+)", "src/base/state_blocks.cpp", r"kFormat = (\d+);"),
            (r"VTK XML PolyData (\S+) ", "src/output/vtk_array.h", r'"PolyData\\" version=\\"([\d.]+)'),
            (r"VTK XML Collection (\S+) ", "src/output/file_series.cpp", r'"Collection\\" version=\\"([\d.]+)'),
            (r"symbols `(\w+)`", "src/api/lsdcd.map", r"^(\w+) {")):
        said, there = found("doc/formats.md", row), found(path, pattern)
        fact(f"doc/formats.md has the format of {path}", said and said == there, f"{said}, {there}")


def names_in(pattern, *paths):
    return {name for path in paths for name in re.findall(pattern, (ROOT / path).read_text(encoding="utf-8"))}


def check_packaging():
    of_plugin = names_in(r'"(?:fix|compute|region)", lmp, handle, regfunc,\s+"([\w/]+)"', "src/lammps/plugin_styles.cpp")
    of_package = names_in(r"(?:Fix|Compute|Region)Style\(([\w/]+),", *(ROOT / "cmake/packaging/lammps").glob("*.h"))
    fact("the package for LAMMPS has the styles of the plugin", of_plugin and of_plugin == of_package, of_plugin ^ of_package)


def check_programs(version, build):
    for words, wanted in ((("bin/lsdcd", "--version"), f"lsdcd {version}"),
                          (("bin/lmp-lsdcd", "-h"), f"lmp-lsdcd {version}:")):
        program = build / words[0]
        if program.exists():
            _, text = output_of(program, *words[1:])
            fact(f"{' '.join(words)} says {version}", wanted in text, text[:400])
    library = (build / "lib/liblsdcd.so").resolve().name
    fact(f"the library is of {version}", library == f"liblsdcd.so.{version}", library)


def check_packages(version, packages):
    names = sorted(path.name for path in packages.iterdir()) if packages.is_dir() else []
    fact("there is a source tarball", f"lsdcd-{version}.tar.gz" in names, names)
    debs = [name.split("_") for name in names if name.endswith(".deb")]
    fact(f"all packages are of {version}", debs and all(deb[1] == version for deb in debs), names)
    wanted = {"liblsdcd" + version.split(".")[0], "liblsdcd-dev", "python3-lsdcd", "lsdcd", "lsdcd-data", "lammps-lsdcd"}
    fact("there is a package of each part", {deb[0] for deb in debs} == wanted, names)


def check_tree():
    code, text = output_of("git", "status", "--porcelain")
    fact("all is committed", code == 0 and not text, text)


def commits_of(path):
    text = path.read_text(encoding="utf-8")
    if path.name.endswith("_published.csv"):    # points of others' papers, which name their source
        return []
    if path.suffix != ".csv":
        return re.findall(r"\b(?:at|commit) `?([0-9a-f]{7,40})\b", text)
    delimiter = ";" if ";" in text.split("\n")[0] else ","
    return [row["commit"] for row in csv.DictReader(text.splitlines(), delimiter=delimiter)]


def check_pages():
    """What was measured at a commit that is not in the history cannot be measured again."""
    named = {}
    for path in sorted(path for pattern in PAGES for path in ROOT.glob(pattern)):
        for commit in commits_of(path):
            named.setdefault(commit, path.relative_to(ROOT))
    fact("pages name commits", named)
    for commit, path in sorted(named.items()):
        code, _ = output_of("git", "merge-base", "--is-ancestor", commit, "HEAD")
        fact(f"commit {commit} of {path} is in the history", code == 0)


def check_gpu():
    said = gpu_record.faults()
    fact("the tests of a GPU passed on today's sources", not said, "; ".join(said))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--packages", type=pathlib.Path)
    parser.add_argument("--release", action="store_true")
    words = parser.parse_args()
    version = found("CMakeLists.txt", r"^project\(lsdcd VERSION (\S+)")
    fact("CMakeLists.txt has a version", version and re.fullmatch(r"\d+\.\d+\.\d+", version), version)
    check_files(version)
    check_formats()
    check_packaging()
    if words.build:
        check_programs(version, words.build.resolve())
    if words.packages:
        check_packages(version, words.packages)
    if words.release:
        check_tree()
        check_pages()
        check_gpu()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
