# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Installs a build under a scratch prefix, moves that, and uses it as a stranger would.

From the environment: LSDCD_BUILD, the build folder; LSDCD_ROOT, the sources; LSDCD_C, LSDCD_CXX and
LSDCD_CMAKE, the compilers and cmake; LSDCD_CUDA, whether the build has CUDA. Prints a line per fact.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

from cube import CUBE_FACES
from facts import fact

ROOT, BUILD = os.environ["LSDCD_ROOT"], os.environ["LSDCD_BUILD"]
CUDA = os.environ["LSDCD_CUDA"] == "ON"
PYTHON = sys.executable

# A cube of side 2 about the origin. Of the example's points the first is its middle, 1 from all
# faces, where nothing is nearer than the cutoff 1; the second is 0.25 above its top.
WANTED = "inf 0.25\n"
# Two heights above a floor of one large triangle; then its four upright sides, of two triangles each, in it.
WANTED_PAIRS = "0 0 8 \n"
# The force of a spring of 2e4 at an overlap of 0.01, and the damping 20 times mass times speed, each 1.
WANTED_LID = "on the sphere -220, on the lid 220, about x -220\n"
FLOOR = "solid floor\nfacet normal 0 0 1\nouter loop\nvertex -20 -20 0\nvertex 20 -20 0\nvertex 0 30 0\nendloop\nendfacet\nendsolid\n"

PROJECT = """cmake_minimum_required(VERSION 3.22)
project(user LANGUAGES C CXX)
find_package(lsdcd 0.10 REQUIRED COMPONENTS {components})
add_executable(in_c distance.c)
target_link_libraries(in_c lsdcd::core)
add_executable(in_cpp distance.cpp)
set_target_properties(in_cpp PROPERTIES CXX_STANDARD 17)
target_link_libraries(in_cpp lsdcd::{last})
foreach(example collide lid)
  add_executable(${{example}} ${{example}}.cpp)
  set_target_properties(${{example}} PROPERTIES CXX_STANDARD 17)
  target_link_libraries(${{example}} lsdcd::{last})
endforeach()
"""

STATIC_PROJECT = """cmake_minimum_required(VERSION 3.22)
project(user LANGUAGES C)
find_package(lsdcd 0.10 REQUIRED COMPONENTS static)
add_executable(in_c {example})
target_link_libraries(in_c lsdcd::static)
"""

CUDA_PROJECT = """cmake_minimum_required(VERSION 3.22)
project(user LANGUAGES CXX CUDA)
find_package(lsdcd 0.10 REQUIRED COMPONENTS core cuda)
foreach(example distance fall wheel)
  add_executable(${example} ${example}.cu)
  set_target_properties(${example} PROPERTIES CUDA_STANDARD 17 CUDA_ARCHITECTURES OFF)
  target_link_libraries(${example} lsdcd::cuda)
endforeach()
"""


def run(*words, folder, **environment):
    done = subprocess.run([str(w) for w in words], cwd=folder, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={**os.environ, **environment})
    return done.returncode, done.stdout


def gives(name, wanted, *words, folder, **environment):
    code, text = run(*words, folder=folder, **environment)
    fact(name, code == 0 and wanted in text, f"exit {code}, {text}")


def write_cube(path):
    lines = ["solid cube"]
    for face in CUBE_FACES:
        lines.append("facet normal 0 0 0\nouter loop")
        lines += ["vertex " + " ".join("1" if v >> k & 1 else "-1" for k in range(3)) for v in face]
        lines.append("endloop\nendfacet")
    with open(path, "w", encoding="ascii") as f:
        f.write("\n".join(lines + ["endsolid cube\n"]))


def find(prefix, name):
    """The one folder below the prefix that has the file."""
    found = [folder for folder, _, files in os.walk(prefix) if name in files]
    fact(f"{name} is installed once", len(found) == 1, found)
    return found[0]


def test_symbols(prefix, libraries):
    library = os.path.join(libraries, "liblsdcd.so.0")
    with open(os.path.join(prefix, "include", "lsdcd.h"), encoding="utf-8") as f:
        declared = set(re.findall(r"^LSDCD_API[^;]*?\b(lsdcd_\w+)\(", f.read(), re.M))
    _, text = run("nm", "-D", "--defined-only", library, folder=prefix)
    exported = {line.split()[-1] for line in text.splitlines()} - {"LSDCD_0"}
    fact("the library exports what its header declares, with a version, and nothing else",
         len(declared) > 10 and exported == {name + "@@LSDCD_0" for name in declared},
         sorted(exported ^ {name + "@@LSDCD_0" for name in declared}))
    _, text = run("readelf", "-d", library, folder=prefix)
    fact("its name is liblsdcd.so.0", "[liblsdcd.so.0]" in text, text)
    fact("it has no path of the build", "RUNPATH" not in text and "RPATH" not in text, text)


def test_builds(prefix, work, libraries):
    examples = os.path.join(ROOT, "examples", "library")
    there = {"LD_LIBRARY_PATH": libraries}
    compile_c = "{} -std=c99 -Wall -Wextra -Werror -pedantic {} -o c $(pkg-config --cflags --libs lsdcd)"
    code, text = run("sh", "-c", compile_c.format(os.environ["LSDCD_C"], examples + "/distance.c"), folder=work,
                     PKG_CONFIG_PATH=os.path.join(libraries, "pkgconfig"))
    fact("the example in C compiles by pkg-config", code == 0, text)
    gives("and gives the distances", WANTED, "./c", "cube.stl", folder=work, **there)

    compile_cpp = "{} -std=c++17 -Wall -Wextra -Wconversion -Wsign-conversion -Werror -pedantic -fsyntax-only {} $(pkg-config --cflags lsdcd)"
    for compiler in [os.environ["LSDCD_CXX"]] + [there for there in ["clang++"] if shutil.which(there)]:
        code, text = run("sh", "-c", compile_cpp.format(compiler, examples + "/distance.cpp"), folder=work,
                         PKG_CONFIG_PATH=os.path.join(libraries, "pkgconfig"))
        fact(f"{os.path.basename(compiler)} has no warning of conversions in lsdcd.hpp", code == 0, text)

    for example in ("distance.c", "distance.cpp", "collide.cpp", "lid.cpp"):
        os.symlink(os.path.join(examples, example), os.path.join(work, example))
    for components in (["core"], ["core", "cuda"]):
        build = os.path.join(work, "build_" + components[-1])
        with open(os.path.join(work, "CMakeLists.txt"), "w", encoding="utf-8") as f:
            f.write(PROJECT.format(components=" ".join(components), last=components[-1]))
        code, text = run(os.environ["LSDCD_CMAKE"], "-S", ".", "-B", build, "-D", "CMAKE_PREFIX_PATH=" + prefix,
                         "-D", "CMAKE_C_COMPILER=" + os.environ["LSDCD_C"],
                         "-D", "CMAKE_CXX_COMPILER=" + os.environ["LSDCD_CXX"],
                         "-D", "CMAKE_CXX_FLAGS=-Wall -Wextra -Werror", folder=work)
        if "cuda" in components and not CUDA:
            fact("the component cuda of a build without CUDA is refused with the reason",
                 code != 0 and "built without CUDA" in " ".join(text.split()), text)
            continue
        code, text = run(os.environ["LSDCD_CMAKE"], "--build", build, folder=work)
        fact(f"the examples in C and C++ build by find_package, {' and '.join(components)}", code == 0, text)
        for program in ("in_c", "in_cpp"):
            gives(f"and {program} gives the distances", WANTED, os.path.join(build, program), "cube.stl",
                  folder=work)
        gives("and collide the pairs", WANTED_PAIRS, os.path.join(build, "collide"), "floor.stl", "cube.stl", folder=work)
        gives("and lid the forces", WANTED_LID, os.path.join(build, "lid"), folder=work)
    code, text = run(os.path.join(work, "c"), "nowhere.stl", folder=work, **there)
    fact("an error has its text", code != 0 and "nowhere.stl" in text, text)


def test_static(prefix, work, libraries):
    """The example in C with the library in it: without the shared one it runs."""
    if CUDA:
        print("skipped: the static library (a build with CUDA has none)")
        return
    example = os.path.join(ROOT, "examples", "library", "distance.c")
    command = "{} -std=c99 {} -o in_static $(pkg-config --cflags --libs lsdcd-static)"
    code, text = run("sh", "-c", command.format(os.environ["LSDCD_C"], example), folder=work,
                     PKG_CONFIG_PATH=os.path.join(libraries, "pkgconfig"))
    fact("the example in C links to the static library by pkg-config", code == 0, text)
    gives("and gives the distances", WANTED, "./in_static", "cube.stl", folder=work)
    folder = os.path.join(work, "static")
    os.mkdir(folder)
    with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as f:
        f.write(STATIC_PROJECT.format(example=example))
    code, text = run(os.environ["LSDCD_CMAKE"], "-S", ".", "-B", "build", "-D", "CMAKE_PREFIX_PATH=" + prefix,
                     "-D", "CMAKE_C_COMPILER=" + os.environ["LSDCD_C"], folder=folder)
    if code == 0:
        code, text = run(os.environ["LSDCD_CMAKE"], "--build", "build", folder=folder)
    fact("and by find_package, the component static", code == 0, text)
    program = os.path.join(folder, "build", "in_c")
    gives("and gives the distances, too", WANTED, program, os.path.join(work, "cube.stl"), folder=work)
    _, text = run("readelf", "-d", program, folder=work)
    fact("and it does not need the shared one", "liblsdcd" not in text, text)


def test_cuda(prefix, work):
    if not CUDA:
        print("skipped: the examples in CUDA (this build has none)")
        return
    folder = os.path.join(work, "cuda")
    os.mkdir(folder)
    for name in ("distance.cu", "fall.cu", "wheel.cu", "grains.cuh"):
        os.symlink(os.path.join(ROOT, "examples", "library", name), os.path.join(folder, name))
    with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as f:
        f.write(CUDA_PROJECT)
    code, text = run(os.environ["LSDCD_CMAKE"], "-S", ".", "-B", "build", "-D", "CMAKE_PREFIX_PATH=" + prefix,
                     "-D", "CMAKE_CUDA_COMPILER=" + os.environ["LSDCD_NVCC"],
                     "-D", "CMAKE_CUDA_HOST_COMPILER=" + os.environ["LSDCD_CXX"], folder=folder)
    if code == 0:
        code, text = run(os.environ["LSDCD_CMAKE"], "--build", "build", folder=folder)
    fact("the examples in CUDA build by find_package", code == 0, text)
    programs, cube = os.path.join(folder, "build"), os.path.join(work, "cube.stl")
    if os.path.exists("/dev/nvidia0"):
        gives("and distance gives the distances", WANTED, os.path.join(programs, "distance"), cube, folder=work)
        gives("and fall keeps its grains", "inside after 3000 steps", os.path.join(programs, "fall"), cube, "3000", folder=work)
        make_wheel = os.path.join(ROOT, "examples", "wheel", "make_wheel.py")
        code, text = run(PYTHON, make_wheel, "--radius", "0.15", "--lug", "0.015", "--period", "0.12", folder=work)
        fact("the wheel's mesh is written", code == 0, text)
        gives("and wheel ends with its times", "real time /", os.path.join(programs, "wheel"), os.path.join(work, "wheel.stl"), "1000",
              "200", folder=work)
    else:
        print("skipped: running the examples in CUDA (no GPU)")


def test_python(prefix, work):
    path = os.path.dirname(find(prefix, "py.typed"))
    gives("the example in Python gives the distances", WANTED, PYTHON,
          os.path.join(ROOT, "examples", "library", "distance.py"), "cube.stl", folder=work, PYTHONPATH=path)
    gives("and the pairs", WANTED_PAIRS, PYTHON,
          os.path.join(ROOT, "examples", "library", "collide.py"), "floor.stl", "cube.stl", folder=work, PYTHONPATH=path)
    gives("the module's own test", "all good", PYTHON,
          os.path.join(ROOT, "tests", "library", "use_module.py"), folder=work, PYTHONPATH=path)


def test_wheel(work):
    """pip's wheel of the build, in a virtual environment that has numpy only."""
    code, text = run(PYTHON, "-c", "import pip, venv", folder=work)
    if code != 0:
        print("skipped: the wheel (no python3-pip or python3-venv)")
        return
    venv = os.path.join(work, "venv")
    python = os.path.join(venv, "bin", "python")
    run(PYTHON, "-m", "venv", "--system-site-packages", "--without-pip", venv, folder=work)
    code, text = run(python, "-m", "pip", "install", "--no-index", ROOT, folder=work, LSDCD_BUILD=BUILD,
                     PIP_DISABLE_PIP_VERSION_CHECK="1")
    fact("pip makes a wheel and installs it, without a network", code == 0, text)
    examples = os.path.join(ROOT, "examples", "library")
    alone = {"PYTHONPATH": "", "LSDCD_LIBRARY": ""}
    gives("its module is the environment's, its library beside it", "True True", python, "-c",
          "import lsdcd, sys; print(*(name.startswith(sys.prefix) for name in (lsdcd.__file__, lsdcd._lib._name)))",
          folder=work, **alone)
    gives("the example in Python gives the distances there", WANTED, python, os.path.join(examples, "distance.py"), "cube.stl",
          folder=work, **alone)
    gives("and the pairs", WANTED_PAIRS, python, os.path.join(examples, "collide.py"), "floor.stl", "cube.stl", folder=work, **alone)
    gives("a law finds the materials there", "made of glass", python, "-c",
          "import lsdcd; lsdcd.Wall.check('granular material glass.lsdcd glass mesh any.stl'); print('made of glass')", folder=work, LSDCD_POTENTIALS="",
          LAMMPS_POTENTIALS="", **alone)
    run(python, "-m", "pip", "uninstall", "--yes", "lsdcd", folder=work)
    left = [name for folder, _, names in os.walk(venv) for name in names
            if "lsdcd" in os.path.relpath(os.path.join(folder, name), venv)]
    fact("pip takes it away again, whole", not left, left)


def test_tool(prefix, work):
    tool = os.path.join(prefix, "bin", "lsdcd")
    if not os.path.exists(tool):
        print("skipped: the tool is not built")
        return
    gives("the tool finds materials from any folder", "material glass", tool, "material", "glass.lsdcd", folder=work)
    gives("and its plot's script", "plot in", tool, "tradeoff", "cube.stl", "--radius", "0.3", "--spheres", "50",
          "--moving", "2", "--repeats", "1", "--seconds", "2", "--device", "cpu", folder=work)
    launcher = os.path.join(prefix, "bin", "lmp-lsdcd")
    if not os.path.exists(launcher):
        print("skipped: lmp-lsdcd is not built")
        return
    with open(os.path.join(work, "in.script"), "w", encoding="ascii") as f:
        f.write("""units si
atom_style sphere
region box block -3 3 -3 3 -3 3
create_box 1 box
create_atoms 1 single 0 0 1.25
set type 1 diameter 0.5 density 2500
pair_style zero 0.6
pair_coeff * *
comm_modify vel yes
fix w all wall/lsdcd granular material glass.lsdcd glass on aluminium mesh cube.stl
run 0
print "wall built"
""")
    gives("lmp-lsdcd finds its plugin, and that the materials", "wall built", launcher, "-in", "in.script", "-log", "none",
          folder=work, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
          OMPI_MCA_ess_singleton_isolated="1", OMP_NUM_THREADS="1")


def test_documents(prefix):
    """Pages lie so that their links lead to what is installed."""
    sys.path.insert(0, os.path.join(ROOT, "tests", "tool"))
    import pages
    pages.ROOT = pathlib.Path(find(prefix, "CITATION.cff"))
    read = pages.all_pages()
    missing = {f"{page.path}:{line}: {target}" for page in read.values() for line, target in page.links + page.images
               if pages.target_of(page, target) and not (pages.ROOT / pages.target_of(page, target)[0]).exists()}
    fact("links of the installed pages lead to what is installed", len(read) > 20 and not missing, (len(read), sorted(missing)))


@pytest.fixture(scope="module")
def work(folder):
    """Where programs are made. The build is installed beside it, and moved."""
    work = folder / "work"
    work.mkdir()
    code, text = run(os.environ["LSDCD_CMAKE"], "--install", BUILD, "--prefix", folder / "at_first", folder=folder)
    assert code == 0, text
    (folder / "at_first").rename(folder / "prefix")
    write_cube(work / "cube.stl")
    (work / "floor.stl").write_text(FLOOR, encoding="ascii")
    return str(work)


@pytest.fixture(scope="module")
def prefix(folder, work):
    return str(folder / "prefix")


@pytest.fixture(scope="module")
def libraries(prefix):
    return find(prefix, "liblsdcd.so.0")


def test_files(prefix):
    for name in ("LICENSE", "CITATION.cff", "library.md", "distance.cpp"):
        find(prefix, name)
