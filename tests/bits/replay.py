# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Gives a script to a program and takes all that comes out: files, the log, what was added to the script."""

import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import differ
from programs import HERE, ROOT

sys.path.insert(0, str(ROOT / "tests" / "lammps"))
import lmp    # noqa: E402

LIMIT = 180    # seconds of a run
VERSION = "1"    # of what is added to scripts: answers that are kept are of one


@dataclasses.dataclass
class Script:
    name: str
    text: str = ""
    words: list = dataclasses.field(default_factory=list)
    files: dict = dataclasses.field(default_factory=dict)    # name: path of the contents
    environment: dict = dataclasses.field(default_factory=dict)
    ranks: int = 0         # that it was recorded on; 0: any
    new: bool = False      # needs LAMMPS 4Jul2026
    parts: dict = dataclasses.field(default_factory=dict)    # scripts of the catalogue for one process
    bare: bool = False     # as it is, nothing added

    def __post_init__(self):
        self.text = "".join(self.parts.values()) or self.text


# ---- what is added to a script -------------------------------------------------------------

ATOMS = "id type x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz"


def joined(text):
    """Lines of a script, those that go on with & as one."""
    return re.sub(r"&[ \t]*\n", " ", text).split("\n")


def added(text, variables):
    """The script with all digits of its thermo output and, after each run, a dump of all atoms and the
    wall's numbers; at its end a restart file."""
    lines, walls, out, number = joined(text), {}, [], 0
    runs = [k for k, line in enumerate(lines) if re.match(r"\s*(run|rerun)\s", line)]
    for k, line in enumerate(lines):
        words = re.sub(r"\$\{(\w+)\}", lambda m: str(variables.get(m.group(1), m.group(0))), line).split()
        if words[:1] == ["clear"]:
            walls = {}
        elif words[:1] == ["unfix"] and len(words) > 1:
            walls.pop(words[1], None)
        elif words[:1] == ["fix"] and len(words) > 3 and words[3].startswith("wall/lsdcd"):
            walls[words[1]] = words
        if k not in runs:
            out.append(line)
            continue
        number += 1
        out += ["thermo_modify format float %.17g", line]
        columns = [f"f_{name}[{n}]" for name, w in walls.items() if "contacts" in w
                   for n in range(1, 10 if "heat" in w else 9)]
        out.append(f"write_dump all custom bits.{number}.dump {ATOMS} {' '.join(columns)} modify format float %.17g "
                   "sort id")
        for name, w in walls.items():
            values = [f"f_{name}"] + [f"f_{name}[{n}]" for n in range(1, 15 if "servo" in w else 12)]
            out.append(f'print "bits {name} ' + " ".join(f"$({v}:%.17g)" for v in values) + '"')
            meshes = w.count("mesh")
            if meshes > 1:
                rows = [f"f_{name}[{m}][{n}]" for m in range(1, meshes + 1) for n in range(1, 12)]
                out.append(f'print "bits {name} meshes ' + " ".join(f"$({v}:%.17g)" for v in rows) + '"')
        # The last thing that a script does with the box, as it would be rebuilt.
        if k == runs[-1] and not any(re.match(r"\s*(clear|jump|next|write_restart|read_)", later) for later in lines[k:]):
            out.append("write_restart bits.restart")
    return "\n".join(out)


def variables_of(words):
    return {words[k + 1]: words[k + 2] for k in range(len(words) - 2) if words[k] == "-var"}


# ---- a run -------------------------------------------------------------------------------

def environment(more):
    env = {k: v for k, v in lmp.environment().items() if not (k.startswith("LSDCD_") or k == "LAMMPS_POTENTIALS")}
    env.update(OMPI_MCA_mpi_yield_when_idle="1")
    env.update(more)
    return env


def text_for(script, form, flags):
    """The script as a program of this form is given it."""
    text = script.text
    if not script.bare and not script.parts:
        text = added(text, variables_of(script.words))
    if form != "plain":
        lmp.KOKKOS_PLUGIN = "../plugin.so"
        text = lmp.for_host(text, flags if form == "kk" else ())
    if form == "kk":    # A column in an atom-style variable, and words that it refuses.
        text = re.sub(r"(variable\s+\S+\s+atom\s.*)\bF_", r"\1f_", text)
    return text


def run(script, ranks, form, program, host, place):
    """(status, {file: contents}, seconds) of one run in the folder `place`/run."""
    folder = place / "run"
    shutil.rmtree(place, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, path in script.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, folder / name)
    flags = host.flags if host and form == "kk" else []
    text = text_for(script, form, flags).replace("@FOLDER@", str(folder))
    (folder / "in.script").write_text(text)
    if form != "plain":
        (place / "plugin.so").symlink_to(program.plugin)
    words = [word.replace("@FOLDER@", str(folder)) for word in script.words]
    more = {name: value.replace("@FOLDER@", str(folder)) for name, value in script.environment.items()}
    if "-log" not in words:
        words += ["-log", "none", "-nocite"]
    command = [str(program.lmp if form == "plain" else host.lmp), "-in", "in.script", *words, *flags]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), "--oversubscribe", *command]
    start = time.time()
    out = folder / "stdout"
    try:
        with open(out, "wb") as log:
            status = subprocess.run(command, cwd=folder, env=environment(more), stdin=subprocess.DEVNULL,
                                    stdout=log, stderr=subprocess.STDOUT, timeout=LIMIT).returncode
    except subprocess.TimeoutExpired:
        status = -1
    seconds = time.time() - start
    text = differ.mask(out.read_bytes().decode(errors="replace"), folder, program.folder)
    files = differ.read_folder(folder)
    for name in ("in.script", *script.files):
        if name == "in.script" or files.get(name) == differ.mask_file(pathlib.Path(script.files[name]).read_bytes()):
            files.pop(name, None)
    if status:
        # How far others came when one stopped depends on time.
        words = sorted(set(differ.STOPPED.findall(text)))
        files = {"stdout": "\n".join(words or ["(stops without a word)"]).encode()}
    else:
        files["stdout"] = text.encode()
        if script.parts:
            files.update(cut(files.pop("stdout").decode()))
    shutil.rmtree(place, ignore_errors=True)
    return status, files, seconds


def cut(text):
    """Output of a batch, at its marks: {name.stdout: its part}."""
    parts, name = {}, None
    for line in text.split("\n"):
        found = re.match(r"^== (\S+)$", line)
        if found:
            name = found.group(1) + ".stdout"
            parts[name] = []
        elif name:
            parts[name].append(line)
    return {name: "\n".join(lines).encode() for name, lines in parts.items()}


def part_of(file, parts):
    """The script of a batch that wrote a file: the longest name that it begins with."""
    return max((p for p in parts if file.startswith(p) and file[len(p):len(p) + 1] in (".", "_")), key=len,
               default=next(iter(parts)))


# ---- answers of the reference that are kept ----------------------------------------------

def digest(data):
    return hashlib.sha256(data).hexdigest()[:24]


def source_of_harness():
    return digest(b"".join((HERE / name).read_bytes() for name in ("replay.py", "differ.py")) + VERSION.encode())


def key_of(script, ranks, form, program, host, harness):
    inputs = [script.text, script.words, sorted((n, digest(pathlib.Path(p).read_bytes())) for n, p in script.files.items()),
              script.environment, script.bare, ranks, form, program.of[form], harness]
    if form != "plain":
        inputs += [host.of, host.flags]
    return digest(json.dumps(inputs).encode())


class Answers:
    """Sums of what the reference gave: it is not run again where the other program gives the same."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def get(self, key):
        path = self.folder / f"{key}.json"
        return json.loads(path.read_text()) if path.exists() else None

    def put(self, key, status, files, seconds):
        answer = {"status": status, "seconds": round(seconds, 3), "files": {n: digest(d) for n, d in files.items()}}
        part = self.folder / f".{key}-{os.getpid()}"
        part.write_text(json.dumps(answer))
        part.rename(self.folder / f"{key}.json")
        return answer
