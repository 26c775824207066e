# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Makes the wheel of the Python package: what pip calls for `pip install .` (PEP 517), by pyproject.toml.

LSDCD_BUILD   a build folder whose library is taken; without it the library is built in build/wheel
CMAKE_ARGS    more words for CMake there, as -D LSDCD_CUDA=OFF

The wheel has the library beside the package, and the material files where the library looks for them. It is for this
machine's kind and needs the shared libraries that the build found (zstd, xxHash).
"""
import base64
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sysconfig
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def version_of_project():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(lsdcd VERSION (\S+)", text, re.M)[1]


def metadata():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version_of_project()}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}",
             *(f"Requires-Dist: {wanted}" for wanted in project["dependencies"]),
             "Description-Content-Type: text/markdown", ""]
    return "\n".join(lines) + "\n" + (ROOT / project["readme"]).read_text(encoding="utf-8")


def check_build(build):
    """Ends where LSDCD_BUILD is no build folder of these sources that has the library."""
    cache = pathlib.Path(build) / "CMakeCache.txt"
    if not cache.is_file():
        raise SystemExit(f"LSDCD_BUILD={build} is no build folder, as it has no CMakeCache.txt: name one, or leave LSDCD_BUILD out")
    said = dict(re.findall(r"^(CMAKE_PROJECT_\w+):\w+=(.*)$", cache.read_text(encoding="utf-8"), re.M))
    made_of = f"{said.get('CMAKE_PROJECT_NAME')} {said.get('CMAKE_PROJECT_VERSION')}"
    if made_of != f"lsdcd {version_of_project()}":
        raise SystemExit(f"LSDCD_BUILD={build} is a build of {made_of}, and these are the sources of lsdcd {version_of_project()}")
    if not any(pathlib.Path(build).rglob("liblsdcd.so.0")):
        raise SystemExit(f"LSDCD_BUILD={build} has no library yet: cmake --build {build} --target lsdcd_api")


def library(folder):
    """The library, stripped, as CMake installs it below `folder`."""
    build = os.environ.get("LSDCD_BUILD")
    if build:
        check_build(build)
    else:
        build = ROOT / "build" / "wheel"
        ninja = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *ninja, "-D", "LSDCD_TESTS=OFF", "-D", "LSDCD_LAMMPS=OFF",
                        *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count() or 1), "--target", "lsdcd_api"], check=True)
    subprocess.run(["cmake", "--install", build, "--component", "library", "--strip", "--prefix", folder], check=True)
    return next(pathlib.Path(folder).rglob("liblsdcd.so.0"))


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """What pip asks before it builds."""
    info = f"lsdcd-{version_of_project()}.dist-info"
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "METADATA").write_text(metadata(), encoding="utf-8")
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = version_of_project()
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    tag, info = f"py3-none-{platform}", f"lsdcd-{version}.dist-info"
    package = ROOT / "src" / "api" / "lsdcd"
    files = {f"lsdcd/{path.name}": path.read_bytes() for path in sorted(package.iterdir())
             if path.suffix in (".py", ".html", ".js") or path.name == "py.typed"}
    files["lsdcd/lsdcd.h"] = (package.parent / "lsdcd.h").read_bytes()    # whose structs the module reads
    with tempfile.TemporaryDirectory() as folder:
        files["lsdcd/liblsdcd.so.0"] = library(folder).read_bytes()
    # share/lsdcd in the folder of the library, by shared_folder() of src/base/shared_files.cpp
    for path in sorted((ROOT / "potentials").iterdir()):
        files[f"lsdcd/share/lsdcd/potentials/{path.name}"] = path.read_bytes()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSES" / "BSD-3-Clause.txt").read_bytes()
    return write_wheel(wheel_directory, "lsdcd", version, tag, files, metadata())


def write_wheel(wheel_directory, name, version, tag, files, metadata_text):
    """Writes a wheel of `files` (contents by their paths in it) and returns the name of its file."""
    info = f"{name}-{version}.dist-info"
    files = files | {f"{info}/METADATA": metadata_text.encode(),
                     f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: lsdcd\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()}
    record = [f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
              for path, data in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,", ""]).encode()
    wheel = f"{name}-{version}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, (2026, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return wheel


class UnsupportedOperation(Exception):
    pass


def build_sdist(sdist_directory, config_settings=None):
    raise UnsupportedOperation("cmake/source_tarball.sh makes the source's tarball")
