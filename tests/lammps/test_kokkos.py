# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""fix wall/lsdcd/kk against the plain fix, in one LAMMPS with Kokkos.

Sides and other walls of LAMMPS stay on the host (suffix off), so that only our fix, the
integrator and gravity differ. Their /kk forms round in another order: 1e-16 per
operation and step.
"""

import re
import subprocess

import pytest

import lmp
import scene
import stl
from facts import at_most, fact
import test_body

HISTORY = "hooke/history 1e4 NULL 120 NULL 0.4 1"
LAWS = {"hooke": "hooke 1e4 NULL 5 NULL 0.5 1",
        "hooke_limit_damping": "hooke 1e4 NULL 120 NULL 0.5 1 limit_damping",
        "hooke_history": "hooke/history 1e4 NULL 5 NULL 0.5 1",
        "hooke_history_sticking": "hooke/history 1e4 4e3 5 2 5.0 1",
        "hertz_history": "hertz/history 1e5 NULL 50 NULL 0.5 1",
        "hertz_history_epsd2": "hertz/history 1e5 NULL 50 NULL 0.5 1 rolling epsd2 0.1",
        "granular_dmt": "granular dmt 1e5 50 0.3 100 tangential mindlin NULL 1.0 0.5",
        "granular_jkr": scene.GRANULAR, "granular_eepa": scene.YIELDING}
PLAIN = ()    # flags: without Kokkos
TAKEN_OUT = """\
region          corner block -6 0 -6 0 INF INF
delete_atoms    region corner compress no
run             400
create_atoms    1 single -3 -3 2.2
create_atoms    2 single -3.2 -4 2.4
set             group all density 2.0
run             400
"""


pytestmark = lmp.needs_host
# These do not depend on how atoms move, and mix in fixes that move them over the host.
NOT_ON_DEVICE = pytest.mark.skipif(lmp.DEVICE_MOVES, reason="with fixes that move atoms over the host")


prepare = scene.bumpy_floor


def go(folder, flags, text, ranks=1, name="moves"):
    output = lmp.run_well(text, folder, ranks, host=True, flags=flags)
    return lmp.read_dump(folder / name), output


def plain_among_kokkos(text):
    """The other fixes are those of Kokkos, so that atoms are where Kokkos has them."""
    return re.sub(r"^(fix +wall .*)$", r"suffix off\n\1\nsuffix on", text,
                  flags=re.M)


def test_single_contacts(folder):
    lmp.flat_floor(folder, "flat.stl")
    path = lmp.HERE / "scripts" / "in.one_sphere"
    for name, law in LAWS.items():
        dumps = []
        for flags in (PLAIN, lmp.FLAGS):
            lmp.run_well(path, folder, host=True, flags=flags, unit="lj", kick=1, dt=1e-4,
                         steps=1000, style="verlet", wall=f"wall/lsdcd {law} mesh flat.stl",
                         out="one")
            dumps.append(lmp.read_dump(folder / "one"))
        touched = sum(abs(row[1][11]) > 0 for row in dumps[0].values())
        fact(f"{name}: the sphere touches the floor", touched > 20, f"{touched} steps")
        at_most(f"{name}: every step as the plain fix", lmp.largest_difference(*dumps), 1e-12)


@NOT_ON_DEVICE
def test_forms(folder):
    body = scene.CREATE + scene.forces(HISTORY) + scene.dump("moves", 100) + "run 1000\n"
    plain, _ = go(folder, PLAIN, body)
    touching = sum(row[9] > 0 for row in plain[1000].values())
    fact("spheres touch the floor", touching > 20, str(touching))
    by_name = body.replace("pair_style", "suffix off\npair_style")
    for style in ("kk", "kk/device", "kk/host"):
        named, _ = go(folder, lmp.FLAGS, by_name.replace("wall/lsdcd", f"wall/lsdcd/{style}"))
        at_most(f"wall/lsdcd/{style}, by name", lmp.largest_difference(plain, named), 1e-9)
    host, _ = go(folder, lmp.FLAGS, by_name)
    at_most("the plain fix beside Kokkos", lmp.largest_difference(plain, host), 1e-9)
    between, _ = go(folder, lmp.FLAGS, plain_among_kokkos(body))
    at_most("the plain fix among fixes of Kokkos", lmp.largest_difference(plain, between), 1e-9)


def test_lists(folder):
    body = scene.CREATE + scene.forces(HISTORY) + scene.dump("moves", 100) + "run 1000\n"
    rare = body.replace("neigh_modify    delay 0 every 1", "neigh_modify    delay 0 every 2")
    for name, text in (("every step checked", body), ("every other step checked", rare)):
        plain, plain_output = go(folder, PLAIN, text)
        kokkos, output = go(folder, lmp.FLAGS, text)
        at_most(f"{name}: as the plain fix", lmp.largest_difference(plain, kokkos), 1e-9)
        if lmp.DEVICE_MOVES:
            fact(f"{name}: atoms move on the device", "switching to legacy" not in output)
        for form, said in (("plain", plain_output), ("kk", output)):
            found = re.search(r": (\d+) steps and the setup: atoms near the wall searched for (\d+) times?(.*), "
                              r"wall neighbor lists made (\d+) times?, (\S+) mesh features each", said)
            steps, searched, made = (int(found.group(k)) for k in (1, 2, 4))
            fact(f"{name}, {form}: near atoms are kept from step to step",
                searched < steps / 5, found.group(0))
            fact(f"{name}, {form}: and so are lists of the wall",
                 0 < made < steps * 100, found.group(0))
            fact(f"{name}, {form}: the log says what would save checking all atoms",
                 ("check yes saves checking" in found.group(3)) == (text is rare),
                 found.group(0))


def test_forces_set_before(folder):
    """By a fix before the wall in the script: the wall's forces are not among those that it replaces."""
    body = scene.CREATE + scene.forces(HISTORY) + scene.dump("moves", 100) + "run 600\n"
    body = re.sub(r"(?=^fix +wall )", "fix pushes all setforce 0.0 0.0 -4.0\n", body, flags=re.M)
    plain, _ = go(folder, PLAIN, body)
    kokkos, _ = go(folder, lmp.FLAGS, body)
    pushed = sum(row[9] > 0 for row in plain[600].values())
    fact("spheres are pushed onto the floor", pushed > 20, str(pushed))
    at_most("forces set before the wall: as the plain fix", lmp.largest_difference(plain, kokkos),
            1e-9)


def test_variables_of_atoms(folder):
    """A floor and a gravity that follow atoms in each step. Where others change atoms on a GPU LAMMPS evaluates the variables with old ones, also for forms
    with /kk/host, unless a fix brings them."""
    body = scene.CREATE + "variable follows equal 0.1*vz[7]\nvariable pull equal 8+2*z[11]\n" + scene.forces(
        HISTORY, "mesh floor.stl motion variable NULL NULL NULL NULL NULL v_follows") + scene.dump("moves", 100) + "run 600\n"
    body = body.replace("gravity 8.0", "gravity/lsdcd v_pull")
    plain, _ = go(folder, PLAIN, body)
    touching = sum(row[9] > 0 for row in plain[600].values())
    fact("spheres touch the floor", touching > 20, str(touching))
    for style in ("kk", "kk/host"):
        own, _ = go(folder, lmp.FLAGS, body.replace("/lsdcd", f"/lsdcd/{style}"))
        at_most(f"{style}: as the plain fixes", lmp.largest_difference(plain, own), 1e-9)


def test_atoms_that_come_and_go(folder):
    body = (scene.CREATE + scene.forces(HISTORY) + scene.dump("moves", 50) + "run 600\n" + TAKEN_OUT)
    for ranks in (1, 2):
        plain, _ = go(folder, PLAIN, body, ranks)
        kokkos, _ = go(folder, lmp.FLAGS, body, ranks)
        counts = {len(rows) for rows in plain.values()}
        fact(f"{ranks} ranks: atoms leave and come", len(counts) > 2, str(counts))
        at_most(f"{ranks} ranks: deleted and created atoms: as the plain fix",
                lmp.largest_difference(plain, kokkos), 1e-9)


def test_exchange_behind_restart_files(folder):
    """A restart file takes springs to the CPU. Those of grains that leave their process in the next step, whichever they are in LAMMPS's
    order, go with them."""
    text = scene.CREATE + scene.forces(HISTORY) + scene.dump("moves", 50) + "restart 1 r1 r2\nrun 600\n"
    for ranks in (2, 4):
        plain, _ = go(folder, PLAIN, text, ranks)
        kokkos, _ = go(folder, lmp.FLAGS, text, ranks)
        fact(f"grains touch the floor, {ranks} ranks", sum(row[9] > 0 for row in plain[600].values()) > 20)
        at_most(f"as the plain fix, {ranks} ranks", lmp.largest_difference(plain, kokkos), 1e-9)


@NOT_ON_DEVICE
def test_restart_into_the_other_form(folder):
    """A form takes up the springs of the other: else contacts would begin anew."""
    body = scene.CREATE + scene.forces(HISTORY) + scene.dump("moves", 100)
    again = re.sub(r"(?ms)^region +box.*?(?=^pair_style)", "read_restart mid.restart\n", body)
    forms = {"plain": plain_among_kokkos, "kk": str}

    def continued(first, then, ranks):
        go(folder, lmp.FLAGS, forms[first](body) + "run 600\nwrite_restart mid.restart\n", ranks)
        return go(folder, lmp.FLAGS, forms[then](again) + "run 400\n", ranks)

    own, _ = continued("kk", "kk", 1)
    fact("spheres touch the floor", sum(abs(row[9]) > 0 for row in own[600].values()) > 20)
    for first, then in ("plain", "kk"), ("kk", "plain"):
        for ranks in (1, 2):
            moves, said = continued(first, then, ranks)
            fact(f"{first} into {then}: all data are taken, {ranks} ranks", "Unused restart file" not in said)
            at_most(f"{first} into {then}: as from its own, {ranks} ranks", lmp.largest_difference(own, moves), 1e-9)


@NOT_ON_DEVICE
def test_bodies(folder):
    """A flap on a hinge and a free cube with a coat, which spheres push: they move as with the plain fix."""
    stl.write(folder / "flap.stl", stl.box((2.0, -4.0, 0.4), (2.2, 4.0, 3.0), 3))
    stl.write(folder / "cube.stl", stl.box((-3.0, -3.0, 0.6), (-2.0, -2.0, 1.6)))
    mesh = ("mesh floor.stl mesh flap.stl body density 0.5 joint hinge 2.1 0 3 0 1 0 spring 20 1 "
            "mesh cube.stl body density 0.5 coat 0.4 0.15")
    shown = " ".join(f"$(f_wall[{m}][{c}]:%.17g)" for m in (2, 3) for c in range(1, test_body.ENERGY + 1))
    text = (scene.CREATE + scene.forces(HISTORY, mesh) + scene.dump("moves", 100) +
            f'fix out all print 100 "$(step) {shown}" file out.txt screen no\nrun 1000\n')
    for ranks in (1, 2):
        moves, rows = [], []
        for flags, script in ((lmp.FLAGS, plain_among_kokkos(text)), (lmp.FLAGS, text)):
            moves.append(go(folder, flags, script, ranks)[0])
            rows.append(lmp.read_rows(folder / "out.txt"))
        at_most(f"bodies, {ranks} ranks: spheres as with the plain fix", lmp.largest_difference(*moves), 1e-9)
        # Components that are 0 by symmetry have the rounding of the others, which are of order 1; a GPU rounds in its own way.
        sizes = [max(1e-3, *(abs(r[k]) for r in rows[0])) for k in range(len(rows[0][0]))]
        at_most(f"bodies, {ranks} ranks: bodies as with the plain fix",
                max(abs(a - b) / s for p, q in zip(*rows) for a, b, s in zip(p, q, sizes)), 1e-9)
        last, n = rows[0][-1], test_body.ENERGY
        fact(f"bodies, {ranks} ranks: the flap swings and the cube turns",
             abs(last[test_body.COORDINATE]) > 0.01 and abs(last[n + test_body.OMEGA]) > 1e-3,
             f"{last[test_body.COORDINATE]} {last[n + test_body.OMEGA]}")


@NOT_ON_DEVICE
def test_a_bed(folder):
    """1000 spheres that touch each other, too: neighbouring paths part, whatever rounds."""
    start = re.sub(r"lattice .*", "lattice sc 1.9", scene.CREATE)
    start = re.sub(r"region +fill .*", "region fill block -5 5 -5 5 1.0 7.5 units box", start)
    start = start.replace("diameter 1.0", "diameter 0.8").replace("diameter 0.7", "diameter 0.56")
    # The order of create_atoms and the sums of velocity depend on the ranks.
    output = lmp.run_well(start + "write_data start.data\n", folder, host=True, flags=PLAIN)
    count = int(re.search(r"Created (\d+) atoms", output).group(1))
    body = (scene.SETTINGS + "read_data start.data\n" + scene.forces(HISTORY, pair=True) +
            scene.dump("moves", 50) + "run 600\n")
    fact("a bed of a thousand", count >= 1000, str(count))
    # Kokkos's integrator rounds in its own way: it moves the spheres of all three.
    one, _ = go(folder, lmp.FLAGS, plain_among_kokkos(body))
    two, _ = go(folder, lmp.FLAGS, plain_among_kokkos(body), 2)
    kokkos, _ = go(folder, lmp.FLAGS, body)
    apart = {}
    for name, other in (("ranks", two), ("kokkos", kokkos)):
        apart[name] = max(lmp.largest_difference({s: one[s]}, {s: other[s]}) for s in one)
    at_most("a bed parts from the plain fix's no faster than on 2 ranks",
            apart["kokkos"], 10 * max(apart["ranks"], 1e-12))


@NOT_ON_DEVICE
def test_refusals(folder):
    short = scene.CREATE + scene.forces(HISTORY) + "run 1\n"
    for name, flags, text, words in (
            ("without -k on", (), short.replace("wall/lsdcd", "wall/lsdcd/kk"), "start it with -k on"),
            ("keyword device", lmp.FLAGS, short.replace("contacts", "device cpu"),
             "the keyword device has no meaning")):
        done = lmp.run(text, folder, host=True, flags=flags)
        fact(f"{name}: an error that says so", done.returncode and words in done.stdout,
             "" if words in done.stdout else done.stdout[-400:])

    # A host that says its Kokkos is another: one whose library can be stood before.
    linked = subprocess.run(["ldd", lmp.HOST], stdout=subprocess.PIPE, text=True).stdout
    if "liblammps" not in linked:
        print("SKIPPED: hosts that say their Kokkos is another (this one has no liblammps.so)")
        return
    has_layouts = "using view layout" in done.stdout

    def not_loaded(name, code, words):
        source, other = folder / f"{name}.cpp", folder / f"{name}.so"
        source.write_text(code)
        subprocess.run([lmp.CXX, "-shared", "-fPIC", "-o", other, source], check=True)
        said = lmp.run(short, folder, host=True, env={"LD_PRELOAD": str(other)})
        fact(f"another {name} of Kokkos: not loaded, and says why", said.returncode and words in said.stdout,
             "" if words in said.stdout else said.stdout[:400])
        return said.stdout

    backend = "serial"    # of the plugin, which it says first
    for name, answers, words in (("precision", "", "this LAMMPS has no KOKKOS package in precision "),
                                 ("backend", "p", "this LAMMPS has no atoms on the Kokkos backend "),
                                 ("layout", "pa", "this LAMMPS has no view layout ")):
        if name == "layout" and not has_layouts:
            continue    # older LAMMPS have one only
        text = not_loaded(name, '#include <cstring>\nextern "C" int lammps_config_accelerator(const char *, const char *c, '
                          f'const char *s) {{ return std::strchr("{answers}", *c) && '
                          f'(*c != \'a\' || !std::strcmp(s, "{backend}")); }}\n', words)
        said = re.search(r"built for Kokkos with the backend (\w+)", text)
        backend = said.group(1) if said else backend
    if has_layouts:    # Kokkos says its version from 3.6 on
        not_loaded("version", '#include <ostream>\nnamespace Kokkos { void print_configuration(std::ostream &out, bool) '
                   '{ out << "  Kokkos Version: 4.3.2\\n"; } }\n', ", this LAMMPS has Kokkos 4.3.2. Rebuild it against this LAMMPS: ")
