# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The page of runs of LAMMPS, and how browsers show it. LSDCD_LMP and LSDCD_TOOL name lmp-lsdcd and lsdcd. Without a browser (Debian: chromium,
firefox-esr) its tests are skipped; LSDCD_PICTURES names a folder for what they see."""
import os
import pathlib
import re
import subprocess

import numpy as np
import pytest

from browser import Chromium, Firefox
from facts import at_most, fact
from lsdcd import report
from runs import data_of, said_by

ROOT = pathlib.Path(__file__).resolve().parents[2]
LMP, TOOL = os.environ.get("LSDCD_LMP", ""), os.environ.get("LSDCD_TOOL", "")
pytestmark = pytest.mark.skipif(not os.path.exists(LMP) or not os.path.exists(TOOL), reason="no lmp-lsdcd and lsdcd (LSDCD_LMP, LSDCD_TOOL)")

MILL = """
units           si
atom_style      sphere
comm_modify     vel yes
boundary        f p f
newton          off
region          box block -0.16 0.16 0 0.06 -0.16 0.16
create_box      1 box
lattice         sc 0.02
region          inside cylinder y 0 0 0.117 EDGE EDGE units box
create_atoms    1 region inside
displace_atoms  all random 0.0015 0.0015 0.0015 4711 units box
set             group all diameter 0.016 density 7800
variable        law string "hooke 8e4 0.6 damping coeff_restitution tangential linear_history_slip 2.3e4 1 0.4 rolling sds 2.7e3 0 0.01"
pair_style      granular/lsdcd
pair_coeff      * * ${law}
neighbor        0.004 bin
neigh_modify    delay 0 every 1 check yes
timestep        3e-5
fix             gravity all gravity 9.81 vector 0 0 -1
fix             move all nve/sphere
fix             mill all wall/lsdcd granular ${law} mesh mill.stl scale 0.001 periodic motion rotate 0 0 0 0 1 0 1.2 energy impacts 0.02 &
                mesh_fields mill_*.vtp every 500 impact_spectrum spectrum_*.csv every 5000
fix_modify      mill names mill all
compute         balls all lsdcd/energy names balls all
fix             mean all ave/time 10 10 100 v_mill_power f_mill[5] file mean.txt
dump            balls all custom 500 balls.dump id type x y z vx vy vz radius
thermo_style    custom step time atoms ke v_mill_power v_mill_overlap v_mill_drive_work v_mill_remainder v_balls_remainder v_mill_dissipated_slider f_mill[70] f_mean[1]
thermo_modify   norm no
thermo          100
run             10000
"""


def run_of(folder, script):
    (folder / "in.script").write_text(script, encoding="utf-8")
    done = subprocess.run([LMP, "-in", "in.script"], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])


def prepare(folder):
    """README's first script, of which 5000 steps are run, and a mill."""
    for name in ("first", "mill"):
        (folder / name).mkdir()
    subprocess.run([TOOL, *"generate drum --radius 100 --length 60 --lifters 8 -o drum.stl".split()], cwd=folder / "first", check=True, capture_output=True)
    subprocess.run([TOOL, *"generate drum --radius 150 --length 60 --lifters 8 --height 20 --thickness 15 -o mill.stl".split()], cwd=folder / "mill",
                   check=True, capture_output=True)
    first = re.search(r"```lammps\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)[1]
    run_of(folder / "first", first.replace("run             50000", "run 5000").replace("thermo          5000", "thermo 100").replace("every 5000", "every 1000"))
    run_of(folder / "mill", MILL)


def test_first_script(folder):
    """`lsdcd report .` behind README's first script."""
    page = report.report(folder / "first")
    at_most("megabytes", len(page.encode()) / 1e6, 1)
    data = said_by(page)
    fact("the drum is in the view", [(m["name"], len(m["frames"])) for m in data["view"]["meshes"]] == [("drum", 5)], [m["name"] for m in data["view"]["meshes"]])
    fact("its numbers have names and units", [(n["name"], n["unit"]) for n in data["numbers"]] == [
        ("Atoms", ""), ("force_z", "N"), ("torque_y", "N m"), ("power", "W")], [(n["name"], n["unit"]) for n in data["numbers"]])
    fact("the run is finished", data["state"] == "finished" and data["step"] == 5000)


def test_means_of_a_run(folder):
    """Numbers of thermo output and of fix ave/time against numpy on the files."""
    numbers = data_of(folder / "mill")["numbers"]
    lines = (folder / "mill" / "log.lammps").read_text().split("\nStep ")[1].split("\nLoop time")[0].splitlines()
    table = np.array([line.split() for line in lines[1:] if re.match(r" *\d+ ", line)], float)    # lines of LSDCD stand between rows and below them
    half = table[len(table) // 2:, 2:]
    of_log = [number for number in numbers if number["source"] == "log"]
    fact("all columns", len(of_log) == half.shape[1], (len(of_log), half.shape))
    for number, column in zip(of_log, half.T):
        at_most(f"{number['head']}: {number['name']}", abs(number["mean"] - np.mean(column)) / max(abs(np.mean(column)), 1e-300), 1e-12)
    rows = np.loadtxt(folder / "mill" / "mean.txt")
    for number, column in zip([number for number in numbers if number["source"] == "mean.txt"], rows[len(rows) // 2:, 1:].T):
        at_most(f"{number['head']} of mean.txt", abs(number["mean"] - np.mean(column)) / abs(np.mean(column)), 1e-12)


def test_page_of_a_mill(folder):
    data = data_of(folder / "mill")
    kinds = {words.split(":")[0]: kind for kind, words in data["checks"]}
    fact("the energy balance closes", kinds["Energy balance"] == "good", data["checks"])
    fact("the timestep is fine", kinds["Timestep"] == "good" and any("between grains takes 33.9 steps" in words for _, words in data["checks"]), data["checks"])
    fact("fields", {"normal_stress", "dissipated_energy", "impact_energy", "impacts"} <= set(data["view"]["meshes"][0]["fields"]), data["view"]["meshes"][0]["fields"].keys())
    fact("the mesh is kept once", all(frame["pose"] for frame in data["view"]["meshes"][0]["frames"]))
    fact("a spectrum", [spectrum["name"] for spectrum in data["spectra"]] == ["mill, to step 10000"], data["spectra"])
    names = {number["head"]: number["name"] for number in data["numbers"]}
    fact("elements have names", (names["f_mill[70]"], names["f_mean[1]"], names["v_mill_drive_work"]) == ("drive_work", "power", "drive_work"), names)
    fact("nothing is left out", data["notes"] == [], data["notes"])


# ---- browsers ----------------------------------------------------------------------------


def with_browser(kind):
    return pytest.param(kind, marks=pytest.mark.skipif(not kind.program, reason=f"no {kind.__name__} (Debian: chromium, firefox-esr)"), id=kind.__name__)


BROWSERS = [with_browser(Chromium), with_browser(Firefox)]
COLOURS = """(() => {
  const c = document.getElementById('view'), g = c.getContext('webgl2'), p = new Uint8Array(c.width * c.height * 4), seen = new Set();
  g.readPixels(0, 0, c.width, c.height, g.RGBA, g.UNSIGNED_BYTE, p);
  for (let i = 0; i < p.length; i += 4) seen.add((p[i] >> 4) << 8 | (p[i + 1] >> 4) << 4 | p[i + 2] >> 4);
  return seen.size;
})()"""
PICTURE = "document.getElementById('view').toDataURL()"
# A page that loads itself again has neither choices nor listeners until it is drawn.
DRAWN = "document.body.dataset.ready && "
SET = DRAWN + "(e => {{ e.{what} = {value}; e.dispatchEvent(new Event('{event}')); return true; }})(document.getElementById('{name}'))"


def set_input(browser, name, value, event="input", what="value"):
    browser.wait_for(SET.format(name=name, value=value, event=event, what=what), name)


@pytest.mark.parametrize("kind", BROWSERS)
def test_page_in_a_browser(folder, kind):
    """At 1400 px in light and at 400 px in dark colours: nothing is wider than the window, the slider, a drag and the choice of a field change the
    picture, and the console has no error."""
    page = folder / "mill" / "report.html"
    report.write(report.report(folder / "mill"), page)
    with kind(folder / f"profile-{kind.__name__}") as browser:
        for width, dark in ((1400, False), (400, True)):
            browser.look(width, dark)
            at = f"{width} px, {'dark' if dark else 'light'}"
            fact(f"{at}: it is drawn", browser.open(page) == "yes")
            wide, window = browser.run("[document.documentElement.scrollWidth, window.innerWidth]")
            fact(f"{at}: nothing is wider than the window", wide <= window, (wide, window))
            fact(f"{at}: all plots", browser.run("document.querySelectorAll('.plot').length") >= 8)
            if not browser.run("document.getElementById('view') !== null"):    # such as a Firefox without a driver of Mesa
                fact(f"{at}: a browser without WebGL 2 says so", "no WebGL 2" in browser.run("document.body.textContent"))
                continue
            fact(f"{at}: the view has colours", browser.run(COLOURS) > 20)
            before = browser.run("document.getElementById('now').textContent")
            set_input(browser, "time", 3)
            fact(f"{at}: the slider moves time", browser.run("document.getElementById('now').textContent") != before, before)
            seen = [browser.run(PICTURE)]    # a picture takes longer than what changes it
            for name, value, what in (("field", "'impact_energy'", "value"), ("colour", "'hidden'", "value"), ("log", "true", "checked")):
                set_input(browser, name, value, "change", what)
                seen.append(browser.run(PICTURE))
                fact(f"{at}: {name} changes the view", seen[-1] != seen[-2])
            browser.run("window.scrollTo(0, document.getElementById('view').getBoundingClientRect().top + window.scrollY)")
            left, top = browser.run("(b => [b.left, b.top])(document.getElementById('view').getBoundingClientRect())")
            browser.drag((int(left) + 100, int(top) + 100), (int(left) + 180, int(top) + 140))
            fact(f"{at}: a drag turns the view", browser.run(PICTURE) != seen[-1])
            browser.run("document.getElementById('home').click()")
            set_input(browser, "colour", "'speed'", "change")
            set_input(browser, "log", "false", "change", "checked")
            if os.environ.get("LSDCD_PICTURES"):
                (pathlib.Path(os.environ["LSDCD_PICTURES"]) / f"{kind.__name__}_{width}_{'dark' if dark else 'light'}.png").write_bytes(browser.picture())
            browser.run("sessionStorage.clear()")    # by which the next page would look as this one does
        fact("the console has no error", browser.errors() == [], browser.errors())
        fact("nothing is asked for beside the page", set(browser.requests()) == {page.resolve().as_uri()}, set(browser.requests()))


def as_it_was(mill, at, share):
    """The files of a run as they were when a share of it was done, the log and the dump half-written."""
    log = (mill / "log.lammps").read_text()
    begin, end = log.index("\nStep "), log.index("\nLoop time")
    (at / "log.lammps").write_text(log if share >= 1 else log[:begin + int(share * (end - begin))])
    for path in mill.glob("mill_[0-9]*.vtp"):
        if int(re.search(r"\d+", path.name)[0]) <= 10000 * share:
            (at / path.name).write_bytes(path.read_bytes())
    dump = (mill / "balls.dump").read_bytes()
    (at / "balls.dump").write_bytes(dump[:int(share * len(dump))])
    report.write(report.report(at, follow=1), at / "report.html")


@pytest.mark.parametrize("kind", BROWSERS)
def test_live_page_in_a_browser(folder, kind):
    """A page that is open loads itself again while the run goes on, keeps what was chosen, and stops when the run ends."""
    at = folder / f"live-{kind.__name__}"
    at.mkdir()
    as_it_was(folder / "mill", at, 0.33)
    with kind(folder / f"profile-live-{kind.__name__}") as browser:
        browser.look(1400, False)
        browser.open(at / "report.html")
        if not browser.run("document.getElementById('view') !== null"):
            pytest.skip(f"{kind.__name__} has no WebGL 2 here")
        first = browser.once("document.getElementById('state').textContent").split(" of ")[0]
        set_input(browser, "field", "'impact_energy'", "change")
        as_it_was(folder / "mill", at, 0.66)
        moved = f"{DRAWN}!document.getElementById('state').textContent.startsWith({first!r})"
        browser.wait_for(moved, "the next page")
        fact("the chosen field stays", browser.wait_for(DRAWN + "document.getElementById('field').value", "a field") == "impact_energy")
        fact("the slider is at the last frame", browser.wait_for(DRAWN + "(t => [t.value === t.max])(document.getElementById('time'))", "a slider") == [True])
        as_it_was(folder / "mill", at, 1)
        browser.wait_for(DRAWN + "document.getElementById('state').textContent.startsWith('finished')", "the end of the run")
        browser.run("window.stays = true")
        browser.wait_for("new Promise(done => setTimeout(() => done(window.stays), 2500))" if kind is Chromium else "window.stays", "the same page")
        fact("the console has no error", browser.errors() == [], browser.errors())
