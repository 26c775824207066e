# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The launcher's command line and plugin command, and the plugin's version guard."""

import os
import pathlib
import re
import shutil
import subprocess

import lmp
import scene
from facts import fact

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = scene.CREATE + scene.forces("hooke 1e4 NULL 5 NULL 0.4 1") + "run 10\n"


def keywords():
    """The name of each keyword of the wall and its default, by the help."""
    shown = subprocess.run([lmp.LMP, "-h"], env=lmp.environment(), text=True, stdout=subprocess.PIPE, check=True).stdout
    lines = shown.split("\n  keywords\n")[1].split("\n\n")[0].splitlines()
    return [re.fullmatch(r"  (\w+) .*?(?:default ([^;]*)|(required))\)", line).groups("") for line in lines]


def test_page_has_the_keywords():
    """The syntax, the default and the meaning of each keyword."""
    page = (ROOT / "doc/fix_wall_lsdcd.rst").read_text(encoding="utf-8")
    syntax, rest = page.split("Examples\n\"\"\"", 1)
    body, defaults = rest.split("Default\n\"\"\"", 1)
    pages = body + "".join((ROOT / "doc" / name).read_text(encoding="utf-8") for name in (
        "moving_walls.rst", "bodies.rst", "contact_laws.rst", "wall_output.rst", "energy.md", "deforming_walls.md", "wear.md"))
    values = dict(re.findall(r"([a-z_]+)\s=\s([^,]+)", " ".join(defaults.split("\n.. _")[0].split())))
    for name, fallback, _ in keywords():
        fact(f"{name}: the page has its syntax", re.search(rf"^ *\*?{name}\*? ", syntax, re.MULTILINE) or f"{name} file" in syntax)
        fact(f"{name}: the pages have its meaning", re.search(rf"[*`]{name}\b", pages))
        if fallback in ("", "none", "off") or fallback.startswith("the wall's"):
            fact(f"{name}: the page has its default", name not in values or values[name] == fallback, values.get(name))
        else:
            usual = re.split(r":| beside| MB|[.]$", fallback)[0].strip()
            fact(f"{name}: the page has its default", values.get(name, "").startswith(usual), (fallback, values.get(name)))
    fact("the rest is off", "All other keywords are off." in defaults)


def test_launcher(folder):
    scene.write_floor(folder / "floor.stl", cells=4)

    shown = subprocess.run([lmp.LMP, "-h"], env=lmp.environment(), text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    fact("-h succeeds and shows the fix", shown.returncode == 0 and
         "wall/lsdcd" in shown.stdout and "corner blend | sum" in shown.stdout)
    for syntax in ("fix ID group massflow/lsdcd mesh FILE ", "fix ID group insert/lsdcd mesh FILE ", "fix ID group gravity/lsdcd ",
                   "compute ID group lsdcd/collide FIX_ID mesh FILE "):
        fact(f"-h shows {syntax}", "\n" + syntax in shown.stdout)
    fact("-h shows LAMMPS's own options", "-partition" in shown.stdout)

    text = lmp.run_well("plugin list\n" + SMALL + "clear\nplugin list\n" + SMALL, folder)
    fact("the style is there again after clear",
         text.count("fix style plugin wall/lsdcd") == 2)

    text = lmp.run_well("plugin load nofile\nplugin load lsdcdplugin.so\n", folder)
    fact("a file that is not there is named", "Open of file nofile failed" in text)
    fact("a second load is told", "Ignoring load of fix style wall/lsdcd" in text)

    done = lmp.run("plugin unload fix wall/lsdcd\nplugin list\n" + SMALL, folder)
    fact("an unloaded style is gone",
         done.returncode != 0 and "wall/lsdcd" in done.stdout.split("ERROR")[-1])
    text = lmp.run_well(SMALL + "plugin unload fix wall/lsdcd\nrun 1\n", folder)
    fact("unload deletes the fix in use", "Unloading fix style wall/lsdcd" in text)
    text = lmp.run_well("plugin clear\nplugin load lsdcdplugin.so\n" + SMALL, folder)
    fact("clear, then load by name", "Loading plugin: fix wall/lsdcd" in text)
    for gone in scene.WITHOUT_SPRINGS:
        text = lmp.run_well(scene.SPRINGS_OF_PAIRS + gone + "\nprint 'still here'\n", folder)
        fact(f"{gone.splitlines()[0]} after a run with springs", "\nstill here" in text, text[-400:])
    done = lmp.run("plugin frobnicate\n\n", folder)
    fact("a wrong word shows the syntax",
         done.returncode != 0 and "unload STYLE NAME" in done.stdout)

    (folder / "more").mkdir()
    (folder / "more" / "otherplugin.so").symlink_to(
        pathlib.Path(lmp.LMP).resolve().parent.parent / "lib" / "lsdcdplugin.so")
    text = lmp.run_well("plugin list\n\n", folder,
                        env={"LAMMPS_PLUGIN_PATH": f"nowhere:{folder}/more"})
    fact("LAMMPS_PLUGIN_PATH is searched", f"Loaded 1 plugins from {folder}/more" in text)

    (folder / "bin").mkdir()
    alone = shutil.copy(lmp.LMP, folder / "bin")
    for missing in ("its own plugin", "the other file of that"):
        done = subprocess.run([alone, "-in", "in.script", "-log", "none"], env=lmp.environment(), text=True, cwd=folder,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        fact(f"it does not go on without {missing}", done.returncode != 0 and
             "lmp-lsdcd needs its own plugin" in " ".join(done.stdout.split()))
        (folder / "lib").mkdir(exist_ok=True)
        shutil.copy(lmp.LIB / "lsdcdplugin.so", folder / "lib")

    # A host that says it is another version: its lammps_version() comes first.
    (folder / "other.c").write_text("int lammps_version(void *host) { (void) host; return 20380119; }\n")
    subprocess.run([os.environ.get("LSDCD_CXX", "c++"), "-shared", "-fPIC", "-x", "c", "other.c", "-o",
                    "other.so"], cwd=folder, check=True)
    for ranks in (1, 2):
        done = lmp.run(SMALL, folder, ranks, env={"LD_PRELOAD": str(folder / "other.so")})
        text = done.stdout
        fact(f"another version is refused once on {ranks} rank{'s' if ranks > 1 else ''}",
             text.count("lsdcd plugin not loaded: it was built for LAMMPS version") == 1 and
             "this is version 20380119" in text and done.returncode != 0)
