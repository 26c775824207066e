# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""LAMMPS's own tests of granular styles (lammps_yaml.py), with newton on and off: LAMMPS's styles see the numbers of its files, ours at two triangles and at
slivers the same within the file's tolerance, and the closed forms hold. doc/validation.md says which do not pass, and why; it has the same results."""

import pytest

import lammps_yaml as of
import lmp
from facts import at_most, fact
from suite import PLANE, SLIVERS, TWO

KEPT = {row["test"]: row for row in of.kept_rows()}
THERE = of.names()
NO_FILES = "no YAML files of LAMMPS 4Jul2026 (tests/lammps/hosts/build_host.sh)"


@pytest.mark.parametrize("name", KEPT)
def test_file(name, folder):
    if name not in THERE:
        pytest.skip(f"{name}: {NO_FILES}")
    kept = KEPT[name]
    if name in of.NOTHING_OF_OURS:
        fact("the page says why it is not run", (kept["passes"], kept["why"]) == (of.NOT_RUN, of.NOTHING_OF_OURS[name]), kept)
        return
    test = of.read_test(of.FILES / f"{name}.yaml")
    if lmp.ON_KOKKOS and "fix pour" in test.keys["prerequisites"]:
        pytest.skip(f"{name}: LAMMPS has no fix pour with Kokkos")
    states = of.run_all(test, folder)
    found = {run: of.apart(test, s, test.seen) for run, s in states.items()} if any(test.seen) else {}
    for (wall, newton), off in found.items():
        what = f"{wall}, newton {newton}: apart from LAMMPS's numbers"
        if wall == PLANE:
            at_most(what, off.largest, test.tolerance)
            continue
        fact("the page says whether it passes", off.passes(test.tolerance) == (of.NO if kept["passes"] == of.GROWTH else kept["passes"]), f"{off}, {kept['passes']}")
        at_most(what, off.real, float(kept["nudged"]) if name in of.GROWS else test.tolerance)
    for run, s in states.items():
        if test.form:
            at_most(f"{run[0]}, newton {run[1]}: {test.form}", of.off_form(test, s), float(kept["form_tolerance"]))
        if run[0] == SLIVERS and test.seen != [{}]:
            fact("the same bits at two triangles and at slivers", s == states[TWO, run[1]])
    if name in of.GROWS and of.own_styles_run():
        control = of.run_nudged(test, folder)
        at_most("ours is nearer than LAMMPS's own with a last digit changed", max(off.real for (wall, _), off in found.items() if wall != PLANE), control.real)
        at_most("the page's number of that", abs(float(kept["nudged"]) - control.real), 0.5 * control.real)
        softer = of.with_variable(test, gt=10.0)
        off = of.apart(softer, *(of.run_test(softer, wall, "on", folder) for wall in (TWO, PLANE)))
        at_most("with a fifth of the dashpot of friction ours is LAMMPS's own", off.real, 1e-11)


def test_scripts_have_our_styles(folder):
    if not THERE:
        pytest.skip(NO_FILES)
    for name in sorted(KEPT.keys() - of.NOTHING_OF_OURS.keys()):
        test = of.read_test(of.FILES / f"{name}.yaml")
        theirs, ours = (of.script_of(test, wall, "on", folder) for wall in (PLANE, TWO))
        fact(f"{name}: planes and pairs of LAMMPS are ours", "wall/gran" not in ours and ours.count("wall/lsdcd") == theirs.count("wall/gran") and
             ours.count("pair_style granular/lsdcd") == 1, ours)
    fact("the page has all files", THERE == list(KEPT), set(THERE) ^ set(KEPT))


@pytest.mark.parametrize("name, variable", [("dem01-granular-hooke-3d-si", "en"), ("dem05-mindlin-grazing-3d", "xmu"), ("dem07-rolling-3d-si", "mur"),
                                            ("dem08-jkr-twosphere-3d", "coh"), ("dem09-shear-3d", "kt")])
def test_sees_a_number_that_is_wrong(name, variable, folder):
    if name not in THERE:
        pytest.skip(f"{name}: {NO_FILES}")
    test = of.read_test(of.FILES / f"{name}.yaml")
    wrong = of.with_variable(test, **{variable: float(test.variables[variable]) * (1 + 1e-6)})
    off = of.apart(test, of.run_test(wrong, TWO, "on", folder), test.seen)
    fact(f"{variable} 1e-6 too high: seen", off.passes(test.tolerance) == of.NO, off)
