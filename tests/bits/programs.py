# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The two programs: sources of a commit exported outside the tree and built there, and what is in a build folder."""

import contextlib
import fcntl
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "lsdcd"
# Where tests/lammps/hosts/build_host.sh leaves a LAMMPS with Kokkos.
HOSTS = pathlib.Path(os.environ.get("LSDCD_HOSTS") or CACHE / "hosts")
VERSION = "20260704"


def fail(text):
    sys.exit(f"compare.py: {text}")


def say(text):
    print(text, flush=True)


@contextlib.contextmanager
def alone(folder):
    """A second comparison waits until the first one has made what both want."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def git(*words, stdout=subprocess.PIPE):
    return subprocess.run(["git", "-C", str(ROOT), *words], stdout=stdout, stderr=subprocess.PIPE)


# ---- the commit --------------------------------------------------------------------------


def export(commit):
    """Sources of a commit, or of an archive of them, in a folder outside the tree; (folder, name)."""
    if os.path.isfile(commit):
        data = pathlib.Path(commit).read_bytes()
        name = "archive-" + hashlib.sha256(data).hexdigest()[:12]
    else:
        done = git("rev-parse", "--verify", "--quiet", f"{commit}^{{commit}}")
        if done.returncode:
            fail(f"'{commit}' is no commit here, no folder of a build and no archive of sources")
        name = done.stdout.decode().strip()[:12]
    folder = CACHE / "bits" / name
    with alone(folder):
        if not (folder / "source" / "CMakeLists.txt").exists():
            unpack(commit, name, folder)
    return folder, name


def unpack(commit, name, folder):
    """Beside its place, then renamed: it is there whole or not at all."""
    part = folder / "part"
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir()
    archive = folder / "sources.tar"
    if os.path.isfile(commit):
        shutil.copy(commit, archive)
    else:
        with open(archive, "wb") as out:
            if git("archive", name, stdout=out).returncode:
                fail(f"git archive {name} does not work")
    with tarfile.open(archive) as tar:
        tar.extractall(part)
    archive.unlink()
    inside = list(part.iterdir())
    (inside[0] if len(inside) == 1 else part).rename(folder / "source")
    shutil.rmtree(part, ignore_errors=True)


def build(source, folder, kokkos_host, o):
    """Only what is run: lmp-lsdcd and, with a host, the plugin for it. o: words of compare.py."""
    targets = (["lmp-lsdcd"] if "plain" in o.forms else []) + (["lsdcdkkplugin"] if kokkos_host else [])
    words = ["cmake", "-S", source, "-B", folder, "-D", "CMAKE_BUILD_TYPE=Release", "-D", "LSDCD_TESTS=OFF",
             "-D", f"LSDCD_CUDA={'ON' if o.cuda else 'OFF'}", "-D", f"LSDCD_KOKKOS_HOST={kokkos_host or ''}",
             *shlex.split(o.cmake)]
    if not (folder / "CMakeCache.txt").exists():
        words += ["-G", "Ninja"] if subprocess.run(["sh", "-c", "command -v ninja"],
                                                   stdout=subprocess.DEVNULL).returncode == 0 else []
    log = folder.parent / f"{folder.name}.log"
    environment = dict(os.environ, CCACHE_BASEDIR=str(source), CCACHE_NOHASHDIR="1")
    start = time.time()
    say(f"building {' and '.join(targets)} in {folder}")
    with open(log, "w") as out:
        for command in (words, ["cmake", "--build", folder, "-j", str(os.cpu_count()), "--target", *targets]):
            if subprocess.run(command, stdout=out, stderr=out, env=environment).returncode:
                tail = "\n".join(log.read_text().splitlines()[-30:])
                if "unknown target" in tail or "No rule to make target" in tail:
                    tail += "\nno such target: LAMMPS was not found (./run build installs what is missing)"
                fail(f"does not build; all of it is in {log}:\n{tail}")
    say(f"  built in {time.time() - start:.0f} s")


# ---- a program ---------------------------------------------------------------------------


def content(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()[:16] if path else ""


class Program:
    """What is run of one build folder: lmp-lsdcd, and the plugin for a LAMMPS with Kokkos. Either may be missing."""

    def __init__(self, name, folder, version):
        self.name, self.folder = name, pathlib.Path(folder).resolve()
        lmp = self.folder / "bin" / "lmp-lsdcd"
        self.lmp = lmp if lmp.exists() else None
        plugins = [self.folder / "lib" / f"lsdcdkkplugin{more}.so" for more in (f"-{version}", "")]
        self.plugin = next((p for p in plugins if p.exists()), None)
        self.of = {"plain": content(self.lmp), "host": content(self.plugin), "kk": content(self.plugin)}

    def bring_up_to_date(self):
        """Builds again what the sources have changed since."""
        targets = [path.stem for path in (self.lmp, self.plugin) if path]
        done = subprocess.run(["cmake", "--build", self.folder, "--target", *targets], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            fail(f"{self.folder} does not build:\n" + "\n".join(done.stdout.splitlines()[-30:]))


class Host:
    """A LAMMPS 4Jul2026 with Kokkos that loads the plugin of either program."""

    def __init__(self, lmp, flags):
        self.lmp, self.flags = pathlib.Path(lmp), flags
        shared = self.lmp.parent / "liblammps.so.0"
        self.of = content(self.lmp) + (content(shared) if shared.exists() else "")


def find_host(given):
    """(folder for LSDCD_KOKKOS_HOST, program), or nothing."""
    folder = pathlib.Path(given) if given else HOSTS / VERSION
    if (folder / "lmp").exists():
        return folder.resolve(), folder.resolve() / "lmp"
    if given:
        fail(f"there is no LAMMPS in {folder}: name a folder that tests/lammps/hosts/build_host.sh prints, or a build "
             "folder of LAMMPS with the packages KOKKOS, GRANULAR and PLUGIN")
    return None, None


def version_of(folder):
    """For the name of its plugin in a build with LSDCD_KOKKOS_HOSTS."""
    text = (folder / "host.cmake").read_text() if folder and (folder / "host.cmake").exists() else ""
    found = re.search(r"LSDCD_HOST_VERSION \"?(\d+)", text)
    return found.group(1) if found else VERSION
