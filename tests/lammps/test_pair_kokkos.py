# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""pair_style granular/lsdcd/kk beside the plain pair style, in one LAMMPS with Kokkos, with half lists and with full ones.

Both add the forces of a grain in an order of their own, and rounding doubles in some 40 steps of such a gas.
"""

import math
import random

import pytest

import lmp
import stl
from facts import at_most, fact
from test_pair_energy import CLOUD, CLOUD_HEAD, CLOUD_LAWS, OUTPUT, books, same
from test_pair_granular import ACROSS, COLUMNS, DT, FULL, GRANULAR, IN_A_SLICE, SIDE, SLICES, changed_by_fix_set, dump, grains, ours, script, settings

pytestmark = lmp.needs_host
PLAIN = ()    # flags: without Kokkos
LISTS = ("half", "full")
LAWS = ["hooke 1e4 30 tangential linear_nohistory 0.5 0.4 damping velocity", GRANULAR, FULL,
        "hertz/material 1e4 5 0.3 tangential mindlin/force NULL 0.5 0.4 twisting marshall heat area 0.3",
        "jkr 1e4 5 0.3 3 tangential mindlin_rescale/force 1e3 0.5 0.4 rolling sds 300 2 0.3",
        "hertz/material 1e4 0.7 0.3 tangential mindlin_liggghts NULL 0.5 0.4 damping coeff_restitution rolling epsd2 0.3 cohesion sjkr 200",
        "law hooke 1e4 NULL 30 NULL 0.4 1", "law hooke/history 1e4 NULL 30 NULL 0.4 1", "law hertz/history 1e4 NULL 30 NULL 0.4 1",
        "law hooke 1e4 NULL 20 NULL 0.4 1 rolling cdt 0.3", "law hertz/history 1e4 NULL 20 NULL 0.4 1 rolling epsd 0.3 0.2 cohesion sjkr 200",
        "hysteretic 1e4 0.6 tangential linear_history 3e3 0 0.4 rolling epsd2 0.3", "eepa 1e5 0.8 0.6 30 1.5 2.5 -0.1 tangential linear_history 3e3 0.5 0.4",
        "hysteretic 1e4 0.6 tangential linear_history 3e3 0 0.4 cohesion capillary 3 20 60 1e-4", "hooke 1e4 10 tangential linear_history 3e3 1 0.4 cohesion linear 50 0.02"]


def prepare(folder):
    grains(folder)
    grains(folder, 3, name="three.data")


def run_in_a_row(folder, texts, ranks=1, neigh="", name="out"):
    """With Kokkos where `neigh` says which lists; of each script the dump and what LAMMPS says."""
    before = f"package kokkos neigh {neigh}{' newton off' * (neigh == 'full')}\n" if neigh else ""
    names = [f"{name}{k}" for k in range(len(texts))]
    texts = [before + text.replace(f" {name} {COLUMNS[:4]}", f" {own} {COLUMNS[:4]}") for own, text in zip(names, texts)]
    every = lmp.run_in_a_row(texts, folder, ranks, host=True, flags=lmp.FLAGS if neigh else PLAIN)
    for said in every:
        fact(f"{neigh or 'plain'}: the pair style", ("granular/lsdcd/kk" in said or "granular/kk" in said) == bool(neigh), "")
    return [(lmp.read_dump(folder / own), said) for own, said in zip(names, every)]


def run(folder, text, ranks=1, neigh="", name="out"):
    return run_in_a_row(folder, [text], ranks, neigh, name)[0]


def all_as_plain(folder, texts, tolerance=1e-10, ranks=(1,), lists=LISTS, sizes=()):
    """{what: script}: positions to torques, and the energy and the pressure, are those of the plain pair style. `sizes`: of columns
    (lmp.largest_difference)."""
    plains = run_in_a_row(folder, texts.values())
    for neigh in lists:
        for n in ranks:
            for what, (plain, told), (own, said) in zip(texts, plains, run_in_a_row(folder, texts.values(), n, neigh)):
                where = f"{what}, {neigh} lists, {n} ranks"
                at_most(where, lmp.largest_difference(plain, own, sizes), tolerance)
                worst = max(abs(a - b) / max(abs(a), 1e-3) for p, q in zip(lmp.read_thermo(told), lmp.read_thermo(said)) for a, b in zip(p, q))
                at_most(f"{where}: energy and pressure", worst, 1e-9)
    return [plain for plain, _ in plains]


def as_plain(what, folder, text, **more):
    return all_as_plain(folder, {what: text}, **more)[0]


@pytest.mark.parametrize("law", LAWS)
def test_laws(folder, law):
    more = "thermo_modify format float %.15g\n"
    text = script(ours("* * " + law)).replace("run ", more + "run ")
    if "heat" in law:
        read = "fix prop all property/atom temperature heatflow ghost yes\nread_data grains.data fix prop NULL NULL\n"
        text = text.replace("read_data grains.data\n", read).replace("timestep ", """\
variable T atom id*0.01
set group all temperature v_T
fix h all heat/flow constant 1.0
compute t all property/atom temperature heatflow
timestep """).replace(COLUMNS, COLUMNS + " c_t[1] c_t[2]")
        if lmp.ON_GPU:
            return lmp.refused(law, text, folder, "heat does not work for atoms on a GPU", host=True)
    first = as_plain(law, folder, text)
    last = first[max(first)]
    fact("grains touch", sum(abs(row[9]) > 1e-3 for row in last.values()) > 20, "")


@pytest.mark.parametrize("newton", ["off", "on"])
def test_inserted(folder, newton):
    """Grains come into a box that is empty, and soon touch: more each time than there were."""
    text = lmp.head(box="0 6 0 6 0 6", boundary="p p p", newton=newton) + f"""\
neighbor 0.1 bin
neigh_modify delay 0 every 1 check yes
{ours("* * " + FULL)}
region all block 0 6 0 6 0 6
fix in all insert/lsdcd region all numberrate 8000 number 200 diam one 0.9 dens 1 vel 0 0 0 jitter 10 every 20
fix i all nve/sphere
timestep {DT}
run 20
{dump("out", 50)}run 130
"""
    first = as_plain(f"newton {newton}", folder, text, lists=LISTS if newton == "off" else LISTS[:1])
    last = first[max(first)]
    fact("grains touch", sum(abs(row[9]) > 1e-3 for row in last.values()) > 20, str(len(last)))


def test_new_ids(folder):
    """Grains that get other IDs between runs keep their springs, also where they go into a restart file before the next run."""
    text = script(ours("* * " + FULL)) + "group gone id 3:200:9\ndelete_atoms group gone\n"
    as_plain("new IDs", folder, text + "run 100\n")
    as_plain("new IDs and a restart file", folder, text + "write_restart r\nrun 100\n")


@pytest.mark.parametrize("newton", ["off", "on"])
def test_ranks(folder, newton):
    """What pairs keep goes with the grains: lists are made anew in each tenth step, and grains go to other processes."""
    text = script(ours("* * " + FULL), steps=400, newton=newton)
    as_plain(f"newton {newton}", folder, text, ranks=(1, 2, 4), lists=LISTS if newton == "off" else LISTS[:1])


def test_many_laws(folder):
    """Laws of one compiled kind, and laws of several: what pairs keep has other lengths."""
    one = [f"{i} {i} {GRANULAR.replace('1e4', e)}" for i, e in ((1, "1e4"), (2, "2e4"), (3, "3e4"))]
    several = ["1 1 " + GRANULAR, "2 2 " + FULL, "3 3 law hooke 1e4 NULL 30 NULL 0.4 1", "1 2 law hooke/history 1e4 NULL 30 NULL 0.4 1",
               "1 3 jkr 1e4 5 0.3 3 tangential mindlin 1e3 0.5 0.4", "2 3 " + FULL]
    all_as_plain(folder, {name: script(ours(*laws), data="three.data") for name, laws in (("one kind", one), ("several kinds", several))}, ranks=(1, 2))


@pytest.mark.parametrize("slice", SLICES)
def test_narrow_box(folder, slice):
    """A grain that touches two images of another, or of itself, has two springs. Forces of its two contacts cancel, to what rounding
    leaves of k d, at least 1e4 times 0.029."""
    box, atoms = SLICES[slice]
    rest = IN_A_SLICE.format(pair=ours("* * law hooke/history 1e4 5e3 0 0 100 0"), atoms=atoms)
    for newton, lists in (("off", LISTS), ("on", LISTS[:1])):
        as_plain(f"{slice}, newton {newton}", folder, lmp.head(box, "p p p", newton=newton) + rest + dump("out", 500) + "run 1000\n", ranks=(1, 2), lists=lists, sizes={9: 290, 10: 290, 11: 290})


def test_types_change(folder):
    """Types change between runs and in a run, with new lists and without: contacts whose law keeps other numbers begin anew."""
    laws = ours("1 1 " + GRANULAR, "2 2 " + FULL, "3 3 law hooke/history 1e4 NULL 30 NULL 0.4 1", "1 2 law hooke 1e4 NULL 30 NULL 0.4 1", "1 3 " + FULL, "2 3 " + FULL)
    change = "variable type{0} atom 1+(id+floor(id/{0}))%3\nset group all type v_type{0}\n"
    between = change.format(5) + "run 20\n" + change.format(7) + "run 20 pre no\n"
    restart = "write_restart r\nclear\n" + settings() + "read_restart r\n" + laws + "\n" + change.format(7) + \
        f"fix i all nve/sphere\ntimestep {DT}\n" + dump("out", 20) + "run 20\n"
    texts = {"between runs": script(laws, data="three.data") + between,
             "after run 0": script(laws, data="three.data") + "run 0\n" + change.format(7) + "run 20 pre no\n",
             "after a restart": script(laws, data="three.data") + restart}
    for every in (1, 30):
        more = f"neigh_modify delay 0 every {every} check no\nneighbor 0.5 bin\nvariable type atom 1+((id+floor(step/20))%3)\nfix change all set 1 0 group all type v_type"
        texts[f"in a run, lists each {every}"] = script(laws, data="three.data", more=more)
    all_as_plain(folder, texts, ranks=(1, 2))


def test_fix_set(folder):
    """Radii and masses of grains on both sides of the face between processes are those of the plain pair style while fix set changes them."""
    for newton in ("off", "on"):
        all_as_plain(folder, {f"set each {every}, newton {newton}, rigid {rigid}": changed_by_fix_set(every, newton, rigid)
                              for every in (1, 5) for rigid in (False, True)}, ranks=(1, 2), lists=LISTS if newton == "off" else LISTS[:1])


@pytest.mark.parametrize("neigh", LISTS)
def test_growth(folder, neigh):
    """Grains that are larger than lists hold are an error: by fix set, and where the command set makes them so before a run without setup."""
    begin = f"package kokkos neigh {neigh} newton off\n" + settings() + ACROSS.format(1, 2.5, ours("* * hooke 1000 0 tangential linear_nohistory 0 0 damping velocity"))
    grow = "variable d atom 1+step*0.001\nfix grow all set 1 0 group all diameter v_d\nneigh_modify delay 0 every 1 check {}\nrun 700\n"
    for text in (begin + grow.format("yes"), begin + grow.format("no"), begin + "run 5\nset group all diameter 1.7\nrun 5 pre no\n"):
        lmp.refused("growth", text, folder, "contacts would be missed", host=True)


def test_restart(folder):
    """From the plain pair style to Kokkos and back: as a run of the plain one that is not interrupted. Lists are half, then full, so
    that these continue each other."""
    law, go_on = ours("* * " + FULL), f"fix i all nve/sphere\ntimestep {DT}\n"
    for newton in ("off", "on"):
        for ranks in (1, 2):
            plain, _ = run(folder, script(law, newton=newton, steps=200) + "write_restart r0\n" + 4 * "run 100\n", ranks)
            for k, neigh in enumerate(("half", "half" if newton == "on" else "full", "")):
                text = settings(newton) + f"read_restart r{k}\n{law}\n{go_on}" + dump("out", 100) + f"run 100\nwrite_restart r{k + 1}\nrun 100\n"
                own, _ = run(folder, text, ranks, neigh)
                at_most(f"newton {newton}, {ranks} ranks: part {k}",
                        max(lmp.largest_difference({s: plain[s]}, {s: own[s]}) for s in own if s > min(own)), 1e-9)


def test_large_among_small(folder):
    """A grain with hundreds of neighbours, more than a word has bits: the small ones lie on it side by side, and slide."""
    rng, small, rows, velocities = random.Random(2), 300, ["1 1 6.0 2 0 0 0"], ["1 0 0 0 0 0 0"]
    for k in range(small):    # on a spiral
        z = 1 - (2 * k + 1) / small
        p = [(1 - z * z)**0.5 * f(k * math.pi * (3 - 5**0.5)) for f in (math.cos, math.sin)] + [z]
        rows.append(f"{k + 2} 1 0.5 1 " + " ".join(repr(3.24 * a) for a in p))
        velocities.append(f"{k + 2} " + " ".join(str(rng.uniform(-1, 1) - a) for a in p) + " 0 0 0")
    (folder / "large.data").write_text(f"grains\n\n{len(rows)} atoms\n1 atom types\n\n" + "".join(f"-6 6 {a}lo {a}hi\n" for a in "xyz") +
                                       "\nAtoms # sphere\n\n" + "\n".join(rows) + "\n\nVelocities\n\n" + "\n".join(velocities) + "\n")
    law = "* * hertz/material 1e4 0.3 0.3 tangential mindlin NULL 0.5 0.4 damping coeff_restitution rolling sds 300 2 0.3"
    for ranks in (1, 2):
        plain = as_plain("a large grain", folder, script(ours(law), data="large.data", steps=300), ranks=(ranks,))
    fact("the large grain is pushed", max(abs(a) for a in plain[100][1][9:12]) > 0.1, str(plain[100][1]))


@pytest.mark.parametrize("what", ["freeze", "rigid"])
def test_masses(folder, what):
    """A frozen grain does not move; damping reads the mass of a rigid body."""
    group = "group some id <= 40\ngroup rest id > 40\nneigh_modify exclude group some some\n"
    integrate = group + ("fix b some freeze\nfix i all nve/sphere" if what == "freeze" else
                         "fix b some rigid/small custom v_body\nfix i rest nve/sphere")
    body = "variable body atom (id-1-(id-1)%2)/2+1\n" if what == "rigid" else ""
    as_plain(what, folder, script(ours("* * " + GRANULAR), integrate=body + integrate), ranks=(1, 2))


def test_sums_of_grains(folder):
    """Energy and stress of each grain, and each pair as compute pair/local sees it, are those of the plain pair style. pair/local reads
    velocities of another time of grains that are copies of others: no dashpots."""
    law = "* * hertz/material 1e4 0 0.3 tangential mindlin_rescale NULL 0 0.4 damping velocity rolling sds 300 0 0.3 twisting sds 30 0 0.3"
    more = """\
compute e all pe/atom pair
compute s all stress/atom NULL pair
compute p all pair/local dist eng force p4 p8 p9 cutoff radius
compute b all reduce sum c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6] inputs local
"""
    columns = COLUMNS + " c_e " + " ".join(f"c_s[{k}]" for k in range(1, 7))
    for newton in ("off", "on"):
        text = script(ours(law), newton=newton, more=more).replace(COLUMNS, columns)
        text = text.replace("step ke pe press", "step ke pe press pxy " + " ".join(f"c_b[{k}]" for k in range(1, 7)))
        text = text.replace("run ", "thermo_modify format float %.15g\nrun ")
        as_plain(f"newton {newton}", folder, text, ranks=(1, 2), lists=LISTS if newton == "off" else LISTS[:1])


def test_lives(folder):
    """Runs with what users do between them, in an order that chance chooses."""
    for seed in range(3 if lmp.QUICK else 12):
        rng = random.Random(seed)
        law = rng.choice([GRANULAR, FULL, LAWS[4]])
        gone, parts = [], []
        for _ in range(6):
            act = rng.choice(["run", "pre no", "delete", "create", "sort", "restart", "law", "lists", "fast"])
            if act == "delete":
                some = [i for i in rng.sample(range(1, SIDE**3), 3) if i not in gone]
                gone += some
                parts.append(f"group gone id {' '.join(map(str, some))}\ndelete_atoms group gone compress no\ngroup gone delete\n")
            elif act == "create" and gone:    # where one was
                place = [(gone[-1] - 1) // SIDE**k % SIDE + 0.5 for k in range(3)]
                parts.append(f"create_atoms 1 single {place[0]} {place[1]} {place[2]}\ngroup new id > {SIDE**3}\nset group new diameter 0.9 density 2\n")
            elif act == "sort":
                parts.append("atom_modify sort 20 1.0\n")
            elif act == "restart":
                parts.append("write_restart part\n")
            elif act == "law":
                parts.append(f"pair_coeff * * {rng.choice(LAWS[:3])}\n")
            elif act == "lists":
                parts.append("neighbor 0.2 bin\n")
            elif act == "fast":
                parts.append("velocity all scale 2.0\n")
            parts.append(f"run {rng.choice([30, 45])}" + (" pre no post no" if act == "pre no" else "") + "\n")
        newton = rng.choice(["off", "on"])
        text = script(ours("* * " + law), steps=60, every=15, newton=newton)
        text += "".join(parts)
        as_plain(f"life {seed}", folder, text.replace("velocity all scale 2.0", "velocity all set NULL NULL 1.0 sum yes"),
                 tolerance=1e-9, ranks=(1, 2), lists=LISTS if newton == "off" else LISTS[:1])


@pytest.mark.skipif(lmp.DEVICE_MOVES, reason="once is enough")
def test_names(folder):
    """-sf kk takes the place of granular where LAMMPS has no granular/kk, and says so; hybrid styles have it, too."""
    plain, _ = run(folder, script(ours("* * " + GRANULAR)))
    granular, said = run(folder, script("pair_style granular\npair_coeff * * " + GRANULAR), neigh="half")
    at_most("as granular/lsdcd", lmp.largest_difference(plain, granular), 1e-10)
    fact("the log says which one runs", "stands for granular/kk" in said, said[-600:])
    for style in ("granular/lsdcd/kk/host", "granular/lsdcd/kk/device"):
        own, _ = run(folder, script(ours("* * " + GRANULAR, style=style)), neigh="half")
        at_most(style, lmp.largest_difference(plain, own), 1e-10)
    done = lmp.run(script(ours("* * " + GRANULAR, style="granular/lsdcd/kk")), folder, host=True, flags=PLAIN)
    fact("without -k on: an error that says so", done.returncode and "start it with -k on" in done.stdout, done.stdout[-400:])


@pytest.mark.parametrize("law", (CLOUD_LAWS[1], CLOUD_LAWS[3], CLOUD_LAWS[7]))
def test_books(folder, law):
    """compute lsdcd/energy has the numbers of the plain pair style, with half and full lists, on 1 and 2 processes, and after a restart of
    each form in the middle."""
    def told(neigh, newton="off", ranks=1, text=CLOUD_HEAD + CLOUD.format(law=law, dt=4e-5, run="run 300\nwrite_restart half.restart\nrun 300")):
        words = f"package kokkos neigh {neigh} newton {newton}\n" if neigh else ""
        said = lmp.run_well(words + text.replace("newton          off", f"newton          {newton}"), folder, ranks, host=True, flags=lmp.FLAGS if neigh else PLAIN)
        fact(f"{neigh or 'plain'}: the pair style", ("granular/lsdcd/kk" in said or "granular/kk" in said) == bool(neigh), "")
        return books(said)[-1]

    plain = told("")
    fact("there is something to compare", plain["slider"] > 0 and plain["held"] > 0, plain)
    again = "newton          off\nread_restart half.restart\ncomm_modify vel yes\n" + CLOUD[CLOUD.index("pair_style"):].format(law=law, dt=4e-5, run="run 300")
    for neigh, newton, ranks in (("half", "off", 1), ("half", "on", 2), ("full", "off", 1), ("full", "off", 2)):
        same(f"{neigh} lists, newton {newton}, {ranks} ranks", told(neigh, newton, ranks), plain, 1e-9)
        same(f"restarted from {neigh} lists", told("", text=again), plain, 1e-9)
    told("")
    for neigh in LISTS:
        same(f"restarted with {neigh} lists", told(neigh, text=again), plain, 1e-9)


@pytest.mark.skipif(lmp.DEVICE_MOVES, reason="once is enough")
def test_impacts(folder):
    """compute lsdcd/impacts is refused with what to write, which then serves."""
    text = CLOUD_HEAD + CLOUD.replace(OUTPUT, "compute hits all lsdcd/impacts 1e-9\n").format(law=CLOUD_LAWS[1], dt=4e-5, run="run 10")
    lmp.refused("impacts", text, folder, "write 'suffix off' before pair_style granular/lsdcd", host=True)
    lmp.run_well(text.replace("pair_style", "suffix off\npair_style"), folder, host=True)


@pytest.mark.parametrize("keeps", ("pairs", "wall"))
def test_many_leave_and_come(folder, keeps):
    """A box that shrinks to its grains as a run begins: the second of four processes gets more grains than it had room for behind those that
    leave it."""
    stl.write(folder / "floor.stl", stl.sheet(1, lambda i, j: (6 * i - 1, 3 * j - 1, 0.5)))
    law = {"pairs": "pair_style granular/lsdcd\npair_coeff * * hooke 1000 5 tangential linear_history 300 1 0.5\n",
           "wall": "pair_style zero 0.02\npair_coeff * *\nfix w all wall/lsdcd hooke/history 1000 NULL 5 NULL 0.5 1 mesh floor.stl\n"}[keeps]
    output = lmp.run_well(f"""\
units si
atom_style sphere
atom_modify map array
comm_modify vel yes
newton off
processors 4 1 1
boundary s p p
region b block 0 4 0 1 0 1 units box
create_box 1 b
region part block 0 3 0 1 0 1 units box
create_atoms 1 random 20000 1234 part overlap 0.0001 maxtry 200
set group all diameter 0.02 density 1000
neighbor 0.005 bin
neigh_modify delay 0 every 1 check yes
{law}fix 1 all nve/sphere
timestep 1e-5
thermo_style custom step atoms
run 20
""", folder, 4)
    fact(f"{keeps}: none is lost", lmp.read_thermo(output)[-1][1] == 20000, str(lmp.read_thermo(output)))
