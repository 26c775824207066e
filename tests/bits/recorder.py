#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Stands in for lmp-lsdcd while tests run: keeps what a run is given, then becomes lmp-lsdcd itself.

record.py copies this file to a bin/lmp-lsdcd and sets LSDCD_BITS_RECORD, a folder, and LSDCD_BITS_PROGRAM.
Of runs that differ in numbers only the first one is kept.
"""
import fnmatch
import hashlib
import json
import os
import pathlib
import re
import sys

LARGEST = 30 << 20    # bytes of a file that is kept


def digest(data):
    return hashlib.sha256(data).hexdigest()[:20]


def words_of(text):
    return set(re.split(r"[\s\"'&]+", text))


def keep(folder, arguments):
    """A run's script, words, number of processes and the files of its folder that the script names."""
    here = pathlib.Path.cwd()
    at = arguments.index("-in")
    path = pathlib.Path(arguments[at + 1])
    text = path.read_text()
    rest = arguments[:at] + arguments[at + 2:]
    words = words_of(text) | {part for word in rest for part in words_of(word)}
    for other in re.findall(r"^\s*(?:include|jump)\s+(\S+)", text, re.M):
        if (here / other).is_file():
            words |= words_of((here / other).read_text())
    files, outside = {}, {}
    for each in sorted(p for p in here.rglob("*") if p.is_file() and p.stat().st_size < LARGEST):
        name = str(each.relative_to(here))
        if name in words or str(each) in words or any("*" in w and fnmatch.fnmatch(name, w) for w in words):
            files[name] = each.read_bytes()
    # Of other folders of this test.
    for n, word in enumerate(sorted(w for w in words if w.startswith("/tmp") or w.startswith("../"))):
        other = (here / word).resolve()
        if other.is_file() and here not in other.parents and other.stat().st_size < LARGEST:
            name = f"outside-{n}-{other.name}"
            files[name] = other.read_bytes()
            outside[word] = "@FOLDER@/" + name

    # Folders with material files.
    variables = {k: v for k, v in os.environ.items() if k in ("LSDCD_POTENTIALS", "LAMMPS_POTENTIALS")}
    for name, value in variables.items():
        for part in value.split(":"):
            if pathlib.Path(part).is_dir():
                for each in pathlib.Path(part).glob("*.lsdcd"):
                    files[f"outside-{name}/{each.name}"] = each.read_bytes()
                variables[name] = f"@FOLDER@/outside-{name}"

    def placed(words_):
        for word in sorted(outside, key=len, reverse=True):
            words_ = words_.replace(word, outside[word])
        return words_.replace(str(here), "@FOLDER@")

    text, rest = placed(text), [placed(word) for word in rest]
    meshes = sorted(digest(data) for name, data in files.items() if name.endswith(".stl"))
    like = digest(json.dumps([re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", w) for w in (text, *rest)] +
                             meshes).encode())
    folder.mkdir(parents=True, exist_ok=True)
    try:
        (folder / f".{like}").touch(exist_ok=False)
    except FileExistsError:
        return
    store = folder.parent / "store"
    store.mkdir(exist_ok=True)
    for data in files.values():
        kept = store / digest(data)
        if not kept.exists():
            part = store / f".{os.getpid()}"
            part.write_bytes(data)
            part.rename(kept)
    record = {"script": text, "words": rest, "ranks": int(os.environ.get("OMPI_COMM_WORLD_SIZE", 1)),
              "files": {name: digest(data) for name, data in files.items()},
              "environment": variables}
    (folder / f"{like}.json").write_text(json.dumps(record, indent=1))


def main():
    if (os.environ.get("OMPI_COMM_WORLD_RANK", "0") == "0" and "-in" in sys.argv and "LD_PRELOAD" not in os.environ):
        try:
            keep(pathlib.Path(os.environ["LSDCD_BITS_RECORD"]), sys.argv[1:])
        except (OSError, UnicodeDecodeError) as error:
            with open(os.environ["LSDCD_BITS_RECORD"] + ".errors", "a") as log:
                log.write(f"{error}\n")
    program = os.environ["LSDCD_BITS_PROGRAM"]
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()
