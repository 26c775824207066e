# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""fix massflow/lsdcd: number, mass and rate of what passes, against closed forms.

Spheres fall at speed 1 in steps of 1/128 from heights that are multiples of 1/4, over the nodes
and edges of a plate: all positions are exact in binary. On the surface counts as above, so that a
sphere from height z passes in step 128 z + 1.
"""

import random
import re

import pytest

import lmp
import stl
from facts import at_most, fact

STEPS_PER_LENGTH = 128
MASS = {1: 2.0, 2: 3.0}    # by type
HEIGHTS = (0.25, 0.5, 1.0)


def write_plate(path, half, cells):
    """A plate at z = 0 with its normal along z; `cells` squares to a side."""
    step = 2 * half / cells
    stl.write(path, stl.sheet(cells, lambda i, j: (-half + i * step, -half + j * step, 0)))


def spheres(n=5):
    """(type, x, y, z) on multiples of 1/2, n of these to either side."""
    return [(1 + (i + j) % 2, i / 2, j / 2, z) for z in HEIGHTS
            for i in range(-n, n + 1) for j in range(-n, n + 1)]


def write_data(path, some, box=3):
    with open(path, "w") as data:
        data.write(f"spheres\n\n{len(some)} atoms\n2 atom types\n" +
                   "".join(f"{-box} {box} {d}lo {d}hi\n" for d in "xyz") + "\nAtoms # sphere\n\n")
        for number, (kind, x, y, z) in enumerate(some, 1):
            # diameter 0: rmass is then the density column
            data.write(f"{number} {kind} 0 {MASS[kind]} {x} {y} {z}\n")


SETTINGS = lmp.head(modify="map array sort 20 1.5")


def begin(boundary="f f f", velocity="0 0 -1"):
    return SETTINGS.replace("f f f", boundary) + f"read_data spheres.data\nvelocity all set {velocity}\n"


def forces(words="", neigh="delay 0 every 1 check yes"):
    """The plate turned over, so that down is forward."""
    return lmp.pairs("zero 0.5", neigh=neigh) + f"""\
comm_modify     cutoff 1.0
fix             move all nve
timestep        {1 / STEPS_PER_LENGTH}
fix             m all massflow/lsdcd mesh plate.stl rotate 1 0 0 180 {words}
thermo          4
thermo_style    custom step atoms f_m[1] f_m[2] f_m[3] f_m[4] f_m[5] f_m[6] f_m[7] f_m[8] &
                f_m[1][1] f_m[1][2] f_m[1][3] f_m[2][1] f_m[2][2] f_m[2][3]
"""


STEP, ATOMS, FORWARD, MASS_FORWARD, BACKWARD, MASS_BACKWARD, NET, RATE, GONE, MASS_GONE = range(10)
FIRST_TYPE, SECOND_TYPE = 10, 13


def table(text, folder, ranks=1):
    """{step: row} of the last run."""
    return {int(row[STEP]): row for row in lmp.read_thermo(lmp.run_well(text, folder, ranks))}


def over_plate(some, half=2):
    """The rim belongs to the plate where it faces -x or -y: a centre on it counts as a hair
    further along +x, then +y."""
    return [s for s in some if -half <= s[1] < half and -half <= s[2] < half]


def passed(some, step):
    return [s for s in some if step > s[3] * STEPS_PER_LENGTH]


def mass_of(some):
    return sum(MASS[s[0]] for s in some)


def prepare(folder):
    write_plate(folder / "plate.stl", 2, 4)
    write_data(folder / "spheres.data", spheres())


@pytest.mark.parametrize("ranks", (1, 2, 4))
def test_closed_form(folder, ranks):
    rows = table(begin() + forces("every 32") + "run 160\n", folder, ranks)
    over = over_plate(spheres())
    wrong = []
    for step, row in rows.items():
        gone = passed(over, step)
        window = step // 32 * 32
        rate = (mass_of(passed(over, window)) - mass_of(passed(over, window - 32))) / (32 / STEPS_PER_LENGTH)
        by_type = [[s for s in gone if s[0] == kind] for kind in (1, 2)]
        expected = [len(gone), mass_of(gone), 0, 0, mass_of(gone), rate, 0, 0]
        for one in by_type:
            expected += [len(one), mass_of(one), 0]
        if row[FORWARD:] != expected:
            wrong.append((step, row[FORWARD:], expected))
    fact(f"number, mass and rate of spheres over nodes and edges, {ranks} ranks",
         not wrong and len(rows) == 41 and rows[160][FORWARD] == len(over), str(wrong[:1]))


def test_up(folder):
    """Upwards on the surface is above already: a sphere from -z passes in step 128 z."""
    write_data(folder / "spheres.data", [(k, x, y, -z) for k, x, y, z in spheres()])
    rows = table(begin(velocity="0 0 1") + forces() + "run 160\n", folder)
    over = over_plate(spheres())
    wrong = [step for step, row in rows.items()
             if row[BACKWARD] != len([s for s in over if step >= s[3] * STEPS_PER_LENGTH])
             or row[MASS_BACKWARD] != mass_of([s for s in over if step >= s[3] * STEPS_PER_LENGTH])
             or row[FORWARD] != 0 or row[NET] != -row[MASS_BACKWARD]]
    fact("what comes up counts backward, with its mass", not wrong and rows[160][BACKWARD] == len(over), str(wrong))
    write_data(folder / "spheres.data", spheres())


def test_periodic(folder):
    """The plate is as wide as the box, spheres drift through its sides and fall through its floor
    twice. Box and plate from -2.5: x = 2.5 is x = -2.5 of an image."""
    write_plate(folder / "plate.stl", 2.5, 5)
    some = spheres(4)
    write_data(folder / "spheres.data", some, 2.5)
    wrong = []
    often, seldom = "delay 0 every 1 check yes", "delay 0 every 8 check no"
    for ranks, neigh in (1, often), (2, seldom), (4, often):
        rows = table(begin("p p p", "0.5 -0.25 -1") + forces(neigh=neigh) + "run 800\n", folder, ranks)
        for step, row in rows.items():
            times = sum(len(passed([(k, x, y, z + 5 * lap)], step)) for k, x, y, z in some
                        for lap in range(2))
            if row[FORWARD] != times or row[BACKWARD] != 0:
                wrong.append((ranks, neigh, step, row[FORWARD], times))
    fact("periodic: each passes once in each lap, on 1, 2 and 4 ranks", not wrong, str(wrong[:1]))
    write_plate(folder / "plate.stl", 2, 4)
    write_data(folder / "spheres.data", spheres())


def test_restart(folder):
    """Cut in the middle of a window and between two layers; sums of small whole numbers are exact."""
    words = "every 32 count once"
    one = table(begin() + forces(words) + "run 160\n", folder)
    lmp.run_well(begin() + forces(words) + "run 44\nwrite_restart mid.restart\n", folder, 2)
    for ranks in (1, 2, 4):
        rest = table(SETTINGS + "read_restart mid.restart\n" + forces(words) + "run 116\n", folder, ranks)
        wrong = [step for step, row in rest.items() if row != one[step]]
        fact(f"continued on {ranks} ranks as unbroken", not wrong and len(rest) == 30, str(wrong))
    # It has passed, is counted, and comes back after the restart.
    up = "velocity all set 0 0 1\n"
    rest = table(SETTINGS + "read_restart mid.restart\n" + up + forces(words) + "run 160\n", folder)
    first = [s for s in over_plate(spheres()) if s[3] == 0.25]
    last = rest[204]
    fact("counted once, also through a restart",
         last[FORWARD] == len(first) and last[BACKWARD] == 0, str(last))


HEADER = "# step time id type diameter x y z vx vy vz direction"


def rows_of(path):
    """The rows of a file of passages, as numbers."""
    header, *rows = path.read_text().splitlines()
    assert header == HEADER
    return [[float(x) for x in row.split()] for row in rows]


def passing(some):
    """(step, sphere's row) of each, in the order of steps and IDs: down through the plate that is turned over."""
    rows = []
    for number, (kind, x, y, z) in enumerate(some, 1):
        if over_plate([(kind, x, y, z)]):
            step = int(STEPS_PER_LENGTH * z) + 1
            rows.append([step, step / STEPS_PER_LENGTH, number, kind, 0.25 if kind == 2 else 0, x, y, z - step / STEPS_PER_LENGTH, 0, 0, -1, 1])
    return sorted(rows, key=lambda row: (row[0], row[2]))


def test_rows(folder):
    """A row for each passage: where and when it was, whatever the processes."""
    wide, expected = "set type 2 diameter 0.25\n", passing(spheres())
    for ranks in (1, 2, 4):
        lmp.run_well(begin() + wide + forces("every 48 file rows.txt") + "run 100\nshell cp rows.txt first.txt\nrun 60\n", folder, ranks)
        fact(f"when a run has ended its rows are in the file, {ranks} ranks", rows_of(folder / "first.txt") == [row for row in expected if row[0] <= 100])
        fact(f"rows are those of the closed form, {ranks} ranks", rows_of(folder / "rows.txt") == expected, str(rows_of(folder / "rows.txt")[:2]))
    # A restart in the middle of a window, of a run that went on behind it: what it had written there comes again. In 29Sep2021 LAMMPS's
    # time begins anew then.
    text = begin() + wide + forces("file rows.txt") + "run 44\nwrite_restart mid.restart\nrun 60\n"
    lmp.run_well(text, folder, 2)
    lmp.run_well(SETTINGS + "read_restart mid.restart\n" + forces("file rows.txt") + "run 116\n", folder)
    fact("a restart goes on in the file", [row[:1] + row[2:] for row in rows_of(folder / "rows.txt")] == [row[:1] + row[2:] for row in expected])
    # From here on steps have other numbers, and a second restart comes before their first row.
    anew = SETTINGS + "read_restart {}.restart\nreset_timestep {}\n" + forces("file rows.txt")
    lmp.run_well(anew.format("mid", 0) + "run 8\nwrite_restart again.restart\nrun 92\n", folder)
    lmp.run_well(anew.format("again", 3) + "run 108\n", folder)
    fact("a restart keeps the rows of steps that LAMMPS counts anew since",
         [[row[0] - 49 * (row[0] > 44), *row[2:]] for row in expected] == [row[:1] + row[2:] for row in rows_of(folder / "rows.txt")],
         str([row[0] for row in rows_of(folder / "rows.txt")]))
    (folder / "rows.txt").unlink()
    said = lmp.run_well(SETTINGS + "read_restart mid.restart\n" + forces("file rows.txt") + "run 116\n", folder)
    before = sum(row[0] <= 44 for row in expected)
    fact("a restart tells of rows that the file has lost", before > 0 and f"rows.txt has 0 of the {before} rows" in " ".join(said.split()))
    lmp.run_well(begin() + wide + forces("file rows.txt") + "run 40\n", folder)
    fact("without a restart the file begins anew", rows_of(folder / "rows.txt") == [row for row in expected if row[0] <= 40])
    # Down, up through the plate, and down again; of several only the first pass counts.
    bounce = "run 40\nvelocity all set 0 0 1\nrun 20\nvelocity all set 0 0 -1\nrun 20\n"
    first = [row for row in expected if row[0] == 33]
    for words, ways in (("", [1, -1, 1]), ("count once", [1]), ("delete yes", [1])):
        out = lmp.run_well(begin() + wide + forces(f"{words} file rows.txt") + bounce, folder)
        rows = rows_of(folder / "rows.txt")
        fact(f"directions, {words or 'each'}", [row[-1] for row in rows] == [w for w in ways for _ in first] and
             [row[2] for row in rows] == [row[2] for row in first] * len(ways), out[-500:])
    lmp.refused("a folder that is not there", begin() + forces("file there/rows.txt") + "run 1\n", folder, "there/rows.txt: cannot be written")
    lmp.refused("one file for two", begin() + forces("file r.txt") + "fix n all massflow/lsdcd mesh plate.stl file r.txt\nrun 1\n", folder,
                "in 'file', 'r.txt' is the file that fix n writes: name another file")
    for name, words in (("another way to it", "mesh plate.stl file ../" + folder.name + "/r.txt"), ("the mesh of another", "mesh r.txt")):
        write_plate(folder / "r.txt", 2, 2)
        mesh = (folder / "r.txt").read_bytes()
        lmp.refused(f"a file that is {name}", begin() + forces("file r.txt") + f"fix n all massflow/lsdcd {words}\nrun 1\n", folder,
                    "in 'file', '", "name another file")
        fact(f"{name} stays", (folder / "r.txt").read_bytes() == mesh)
    lmp.refused("a file without a name", begin() + forces("file"), folder, "its name is missing")


def test_window(folder):
    """The rate after a restart with a shorter window, and with a timestep that changes."""
    lmp.run_well(begin() + forces("every 64") + "run 40\nwrite_restart mid.restart\n", folder)
    rows = table(SETTINGS + "read_restart mid.restart\n" + forces("every 8") + "run 8\n", folder)
    first = mass_of(passed(over_plate(spheres()), 40))
    # The window that was begun ends in the first step, the others each 8 steps after.
    at_most("a window that is more than full when a run goes on ends at once",
            abs(rows[44][RATE] * 41 / STEPS_PER_LENGTH / first - 1), 1e-6)

    # With the number of the step newer LAMMPS changes its time, too. Spheres pass in the 33rd step, which is in the third window.
    for to in (0, 1000):
        rows = table(begin() + forces("every 16") + f"run 34\nreset_timestep {to}\nrun 16 pre no\n", folder)
        first = mass_of(passed(over_plate(spheres()), 34))
        at_most(f"the rate where a run without setup begins at step {to}", abs(rows[to + 16][RATE] * 16 / STEPS_PER_LENGTH / first - 1), 1e-6)

    # Fix dt/reset acts before this fix or after it, more often than a window ends.
    wrong, rates = [], set()
    for place in ("fix             m ", "thermo          "):
        text = begin() + forces("every 16").replace(
            place, "fix g all gravity 1 vector 0 0 -1\nfix r all dt/reset 6 NULL NULL 0.0078125 units box\n" + place)
        text = text.replace("f_m[2][3]\n", "f_m[2][3] time\nthermo_modify format float %.17g\n")
        rows = table(text + "run 128\n", folder)
        for step in range(16, 129, 16):
            last, row = rows[step - 16], rows[step]
            rate = (row[NET] - last[NET]) / (row[-1] - last[-1])
            rates.add(rate)
            if abs(row[RATE] - rate) > 1e-9 * rate:
                wrong.append((place, step, row[RATE], rate))
    fact("where fix dt/reset changes the timestep the rate's time is that of its steps",
         not wrong and len(rates) > 2, str(wrong[:1]))


def test_delete(folder):
    over, every = over_plate(spheres()), spheres()
    wrong = []
    for ranks in (1, 2, 4):
        # Reneighboured in every 4th step.
        rows = table(begin() + forces("delete yes", "delay 0 every 4 check no") + "run 160\n", folder, ranks)
        for step, row in rows.items():
            gone = passed(over, step - 1) if step else []    # what passed before this step's look
            if (row[FORWARD] != len(passed(over, step)) or row[ATOMS] != len(every) - len(gone) or
                    row[GONE] != len(gone) or row[MASS_GONE] != mass_of(gone)):
                wrong.append((ranks, step, row))
    fact("what passed forward is deleted at the next reneighbouring", not wrong, str(wrong[:1]))

    # Written when spheres have passed that are not deleted yet.
    slow = "delay 0 every 24 check no"
    lmp.run_well(begin() + forces("delete yes", slow) + "run 38\nwrite_restart mid.restart\n", folder, 2)
    rows = table(SETTINGS + "read_restart mid.restart\n" + forces("delete yes", slow) + "run 30\n", folder, 2)
    gone = [s for s in over if s[3] == 0.25]
    fact("what was to be deleted is after a restart",
         rows[38][GONE] == 0 and rows[38][FORWARD] == len(gone) and rows[68][GONE] == len(gone),
         f"{rows[38]} {rows[68]}")


GRAINS = SETTINGS + "region box block -3 3 -3 3 -2 4\ncreate_box 2 box\n"


def test_springs(folder):
    """Grains that slide on a floor go on as if nothing was deleted around them."""
    def text(words):
        return GRAINS + f"""\
lattice         sc 1.0
region          low block -2.5 2.5 -2.5 2.5 -1.6 -1.5 units box
region          high block -2.5 2.5 -2.5 2.5 0.5 2.5 units box
lattice         sc 1.0 origin 0 0 0.45
create_atoms    1 region low
create_atoms    2 region high
set             group all diameter 0.9 density 1.0
group           low type 1
group           high type 2
velocity        low set 0.3 0.2 0
velocity        high set 0 0 -4
""" + lmp.pairs("zero 1.0") + f"""\
fix             move all nve/sphere
fix             pull low gravity 1.0 vector 0 0 -1
fix             floor low wall/lsdcd hooke/history 1e3 NULL 5 NULL 0.5 1 mesh plate.stl scale 1.5 1.5 1 move 0 0 -2
fix             bounce high wall/reflect zlo EDGE
fix             m high massflow/lsdcd mesh plate.stl rotate 1 0 0 180 {words}
timestep        0.002
thermo          100
thermo_style    custom step atoms f_m[7]
dump            d low custom 50 grains id x y z vx vy vz omegax omegay omegaz
dump_modify     d format float %.17g sort id
run             600
"""
    dumps = {}
    for ranks in (1, 2):
        for words in ("", "delete yes"):
            rows = lmp.read_thermo(lmp.run_well(text(words), folder, ranks))
            dumps[ranks, words] = lmp.read_dump(folder / "grains")
        fact(f"grains were deleted beside grains with springs, {ranks} ranks",
             rows[-1][2] == 32, str(rows[-1]))
        at_most(f"and these go on to the last bit, {ranks} ranks",
                lmp.largest_difference(dumps[ranks, ""], dumps[ranks, "delete yes"]), 0)
    turning = max(abs(w) for row in dumps[1, ""][600].values() for w in row[6:])
    fact("springs were at work", turning > 0.05, str(turning))


def test_order_of_pairs(folder):
    """Springs of LAMMPS's pairs would go to other atoms, where the fix that creates or deletes some stands before the pair style."""
    out, into = "massflow/lsdcd mesh plate.stl delete yes", "insert/lsdcd region in numberrate 100 diam one 0.3 dens 1"
    for fix in (out, into):
        for pairs in ("gran/hooke/history 1e4 NULL 5 NULL 0.5 1", "granular"):
            law = "hooke 1e4 5 tangential linear_history 1e4 1 0.5 damping mass_velocity" if pairs == "granular" else ""
            lmp.refused(f"{fix} before {pairs}", GRAINS + f"region in block -1 1 -1 1 1 2\nfix early all {fix}\npair_style {pairs}\npair_coeff * * {law}\n"
                        "create_atoms 1 single 0 0 0\nset group all diameter 0.3 density 1\nfix i all nve/sphere\nrun 0\n", folder,
                        # With Kokkos "granular" is ours, which says so itself.
                        "Pair style granular/lsdcd" if lmp.ON_KOKKOS and law else "Fix early", "write pair_style before th")
    counts, law = out.replace(" delete yes", ""), "hooke/history 1e4 NULL 5 NULL 0.5 1"
    for fix, pairs, words in ((out, "gran/hooke 1e4 NULL 5 NULL 0.5 1", ""), (counts, f"gran/{law}", ""), (counts, "granular/lsdcd", f"law {law}")):
        lmp.run_well(GRAINS + f"fix early all {fix}\npair_style {pairs}\npair_coeff * * {words}\ncreate_atoms 1 single 0 0 0\n"
                     "set group all diameter 0.3 density 1\nfix i all nve/sphere\nrun 0\n", folder)


def test_deposit(folder):
    """Spheres come in above and are deleted below: none is lost, none is counted twice."""
    text = GRAINS + lmp.pairs("zero 1.0") + """\
region          slot block -1.5 1.5 -1.5 1.5 2 3 units box
fix             move all nve/sphere
fix             in all deposit 100 1 10 4711 region slot near 0.1 vz -4 -2
fix             m all massflow/lsdcd mesh plate.stl rotate 1 0 0 180 delete yes
timestep        0.005
thermo          10
thermo_style    custom step atoms f_m[1] f_m[7]
run             1300
"""
    for ranks in (1, 4):
        rows = lmp.read_thermo(lmp.run_well(text, folder, ranks))
        inserted = [min(100, (int(row[0]) - 1) // 10 + 1) if row[0] else 0 for row in rows]
        fact(f"inserted = there + deleted, and all pass once, {ranks} ranks",
             all(row[1] + row[3] in (n, n - 1, n + 1) for row, n in zip(rows, inserted)) and
             rows[-1][1] + rows[-1][3] == 100 and rows[-1][2] == 100, str(rows[-1]))


def test_kick(folder):
    """A sphere far from the plate that is thrown past it in one step."""
    write_data(folder / "spheres.data", [(1, 0, 0, 20), (1, 0, 0, 10)], 50)
    kick = """\
variable        f equal -1e6*(step==30)
fix             kick all addforce 0 0 v_f
"""
    lmp.refused("a far sphere that moves by more than the skin in a step", begin() + forces() + kick + "run 60\n", folder,
                "moved by more than the skin 0.3 in one step")
    rows = table(begin() + forces(neigh="delay 0 every 1 check no") + kick + "run 31\n", folder)
    fact("where all are looked at in every step it is counted", rows[31][FORWARD] == 2, str(rows[31]))
    write_data(folder / "spheres.data", spheres())


def test_many(folder):
    """More spheres than a form of the fix makes room for pass in the first step, in which it looks at all, and as many in one in which it
    looks at those near the plate."""
    n, high = 80, 45 / 64
    wide = [(1, 2 * i / n, 2 * j / n, z) for z in (1 / 512, high) for i in range(-n, n) for j in range(-n, n)]
    some = [(k, x, y, z) for k, x, y, z in wide if abs(x) < 2 and abs(y) < 2][::4]
    write_data(folder / "spheres.data", some)
    later = int(high * STEPS_PER_LENGTH) + 1
    rows = table(begin() + forces().replace("thermo          4", "thermo 1") + f"run {later}\n", folder)
    over = over_plate(some)
    first = [s for s in over if s[3] < 0.1]
    counts = {step: row[FORWARD] for step, row in rows.items()}
    fact("all that pass in a step are counted in it", len(first) > 4096 and set(counts[step] for step in range(1, later)) == {len(first)} and
         counts[later] == len(over), f"{len(first)} {counts[1]} {counts[later - 1]} {counts[later]}")
    write_data(folder / "spheres.data", spheres())


def as_plain(folder, name, text):
    """The last row of a script with FLOWS in place of the fixes, which /kk must have as the form without it has."""
    flows = re.search(r"FLOWS(.*?)END", text, re.S).group(1)
    rows = [lmp.read_thermo(lmp.run_well(re.sub("FLOWS.*?END\n", lambda _: form, text, flags=re.S), folder))[-1]
            for form in (f"suffix off{flows}suffix on\n", flows)]
    fact(f"{name}: something passes", rows[0][2] > 0, str(rows[0]))
    fact(f"{name}: as the plain fix counts", rows[0] == rows[1], f"{rows}")


@lmp.of_kokkos
def test_two_that_delete(folder):
    """One deletes atoms while the other has candidates that it has not looked at."""
    write_plate(folder / "high.stl", 2.9, 1)
    write_plate(folder / "low.stl", 2.9, 1)
    places = random.Random(1)
    write_data(folder / "spheres.data", [(1, places.uniform(-2.8, 2.8), places.uniform(-2.8, 2.8), places.uniform(-0.4, 2.9)) for _ in range(400)])
    as_plain(folder, "two that delete", begin("p p f").replace("sort 20 1.5", "sort 0 0") + lmp.pairs("zero 0.5") + f"""\
comm_modify     cutoff 1.0
fix             move all nve
timestep        {1 / STEPS_PER_LENGTH}
FLOWS
fix             high all massflow/lsdcd mesh high.stl move 0 0 0.5 rotate 1 0 0 180 delete yes
fix             low all massflow/lsdcd mesh low.stl rotate 1 0 0 180 delete yes
END
thermo          250
thermo_style    custom step atoms f_high[1] f_high[2] f_high[7] f_low[1] f_low[2] f_low[7]
run             250
""")


@lmp.of_kokkos
def test_springs_of_pairs(folder):
    """Grains that take the places of deleted ones keep their springs."""
    stl.write(folder / "middle.stl", stl.sheet(1, lambda i, j: (0.2 + 0.6 * i, 0.2 + 0.6 * j, 0.5)))
    rows = [lmp.read_thermo(lmp.run_well(lmp.head("0 1 0 1 0 1", "p p p", modify="map array sort 0 0", units="si") + f"""\
lattice         sc 0.0495
create_atoms    1 random 4000 77 NULL overlap 0.047 maxtry 100
set             group all diameter 0.05 density 1000
velocity        all create 1e18 123
neighbor        0.005 bin
neigh_modify    delay 0 every 1 check yes
{form}
pair_style      granular/lsdcd
pair_coeff      * * hooke 1e4 5 tangential linear_history 7e3 1 0.5
fix             move all nve/sphere
fix             m all massflow/lsdcd mesh middle.stl delete yes
timestep        1e-4
thermo          100
thermo_style    custom step f_m[7] ke
thermo_modify   format float %.17g
run             100
""", folder))[-1] for form in ("suffix off", "")]
    fact("grains are deleted", rows[0][1] > 2, str(rows[0]))
    fact("as many", rows[0][1] == rows[1][1], str(rows))
    # Sums in another order, which 100 steps of a gas that hits let grow; without the springs of one grain it is 3e-5.
    at_most("kinetic energy as of the plain forms", abs(rows[0][2] / rows[1][2] - 1), 1e-9)


@lmp.of_kokkos
def test_memory(folder):
    """Deleted grains take the room of the contacts that they have, and not that of as many as a grain may have: 29 kB each, of two arrays on a GPU."""
    stl.write(folder / "floor.stl", stl.sheet(2, lambda i, j: (120 * i - 10, 120 * j - 10, -0.5)))
    stl.write(folder / "sheet.stl", stl.sheet(2, lambda i, j: (101 * i - 0.5, 101 * j - 0.5, 1)))
    used = []
    for law in ("hooke", "hooke/history"):
        output = lmp.run_well(lmp.head("0 100 0 100 -1 3", "p p f") + f"""\
lattice         sc 1.0
region          in block 0.2 99.8 0.2 99.8 1.4 2.1
create_atoms    1 region in
set             group all diameter 0.5 density 1
velocity        all set 0 0 -1
""" + lmp.pairs("zero 1.0") + f"""\
fix             move all nve/sphere
fix             wall all wall/lsdcd {law} 1e4 NULL 50 NULL 0.4 1 mesh floor.stl
fix             m all massflow/lsdcd mesh sheet.stl delete yes
timestep        0.02
thermo          120
thermo_style    custom step atoms f_m[7]
run             120
info            memory
""", folder)
        rows = lmp.read_thermo(output)
        fact(f"{law}: all are deleted", rows[-1][1:] == [0, rows[0][1]] and rows[0][1] > 9000, str(rows))
        used.append(float(re.search(r"Maximum resident set size: *([0-9.]+) Mbyte", output).group(1)))
    at_most("MB more than without springs", used[1] - used[0], 64)


@lmp.of_kokkos
def test_many_candidates(folder):
    """All grains of a bed are in the box of an oblique facet, more than there is room for at first."""
    stl.write(folder / "oblique.stl", stl.sheet(1, lambda i, j: (5.8 * i - 2.9, 5.8 * j - 2.9, 5.8 * i - 2.9)))
    as_plain(folder, "many candidates", SETTINGS + """\
region          box block -3 3 -3 3 -3 3
create_box      1 box
region          in block -2.8 2.8 -2.8 2.8 -2.8 2.8
create_atoms    1 random 80000 1234 in
set             group all diameter 0.001 density 1
velocity        all set 0 0 -0.1
""" + lmp.pairs("zero 0.05", skin=0.05) + """\
comm_modify     cutoff 0.2
fix             move all nve
timestep        0.001
FLOWS
fix             m all massflow/lsdcd mesh oblique.stl rotate 1 0 0 180
END
thermo          20
thermo_style    custom step atoms f_m[1] f_m[2] f_m[3] f_m[4]
run             20
""")


@lmp.of_kokkos
@pytest.mark.parametrize("words", ("", "count once delete yes"))
def test_kokkos(folder, words):
    """Beside the fixes without /kk in the same LAMMPS: grains of three sizes come in all the time, jump on a floor through the plate and
    back, and a restart is taken up by the other form."""
    text = GRAINS.replace("-2 4", "-2 6") + lmp.pairs("gran/hooke/history 1e4 NULL 50 NULL 0.4 1") + f"""\
region          top block -1.8 1.8 -1.8 1.8 3 5 units box
fix             move all nve/sphere
fix             pull all gravity 10 vector 0 0 -1
fix             sides all wall/reflect xlo EDGE xhi EDGE ylo EDGE yhi EDGE
fix             floor all wall/lsdcd hooke/history 1e4 NULL 20 NULL 0.4 1 mesh plate.stl scale 1.5 1.5 1 move 0 0 -0.9
PLACE
fix             in all insert/lsdcd region top numberrate 150 diam range 0.3 0.4 dens 1 type 2 vel 0.1 0 -4 jitter 0.3
fix             m all massflow/lsdcd mesh plate.stl rotate 1 0 0 180 file rows.txt every 90 {words}
suffix          on
timestep        1e-3
thermo          60
thermo_style    custom step atoms f_m[1] f_m[2] f_m[3] f_m[4] f_m[5] f_m[6] f_m[7] f_m[8] f_m[2][2]
thermo_modify   format float %.17g
"""
    again = re.sub("region +box.*\n.*", "read_restart mid.restart", text)
    seen = {}
    for ranks in (1, 2, 4):
        for place in ("suffix off", ""):
            rows = lmp.read_thermo(lmp.run_well(text.replace("PLACE", place) + "run 720\nwrite_restart mid.restart\n", folder, ranks))
            other = "" if place else "suffix off"
            rows += lmp.read_thermo(lmp.run_well(again.replace("PLACE", other) + "run 240\n", folder, ranks))
            seen[place] = rows, rows_of(folder / "rows.txt")
        one, two = seen["suffix off"], seen[""]
        last = two[0][-1]
        fact(f"grains pass both ways, {ranks} ranks", last[2] > 40 and (words or last[4] > 10), str(last))
        if lmp.DEVICE_MOVES or lmp.ON_GPU:    # atoms are in another order, or rounded otherwise, and neighbouring paths part
            fact(f"numbers as of the plain fixes, {ranks} ranks", len(one[1]) == len(two[1]), f"{one[0][-1]} {last}")
        else:
            fact(f"totals and rows as of the plain fixes, to the bit, {ranks} ranks", one == two, f"{one[0][-1]} {last}")


def test_deform(folder):
    """The box grows and tilts about a plate that stays. In a tilted box LAMMPS rounds positions
    whenever it reneighbours, so that none may be on an edge."""
    off = [(k, x + 0.01, y + 0.02, z + 0.004) for k, x, y, z in spheres()]
    write_data(folder / "spheres.data", off)
    over = over_plate(off)
    change = "change_box all triclinic\nfix grow all deform 1 x final -4 5 xy final 1.0 z final -4 5 remap none\n"
    rows = table(begin("p p p") + forces() + change + "run 160\n", folder, 2)
    wrong = [step for step, row in rows.items() if row[FORWARD] != len(passed(over, step))]
    fact("in a box that grows and tilts", not wrong and rows[160][FORWARD] == len(over), str(wrong))


def test_warnings(folder):
    """Each where it belongs, and none in a script without reason."""
    few = [(1, 0, 0, 1), (1, 0.5, 0, 1)]
    write_data(folder / "spheres.data", few)
    plain = lmp.run_well(begin() + forces("delete yes") + "run 0\n", folder)
    one, other = (folder / "plate.stl").read_text().split("endfacet", 1)
    lines = one.split("\n")
    lines[3], lines[4] = lines[4], lines[3]
    (folder / "turned.stl").write_text("\n".join(lines) + "endfacet" + other)
    turned = lmp.run_well(begin() + forces().replace("plate.stl", "turned.stl") + "run 0\n", folder)
    (folder / "both.stl").write_text(one + "endfacet" + "\n".join(["", *lines[1:]]) + "endfacet" + other)
    both = lmp.run_well(begin() + forces().replace("plate.stl", "both.stl") + "run 0\n", folder)
    long = lmp.run_well(begin("p p f") + forces("scale 2 1 1") + "run 0\n", folder)
    fact("no warning without reason", "massflow/lsdcd: delete" not in plain and
         "wound in opposite ways" not in plain and "both windings" not in plain and "longer than" not in plain)
    if not lmp.ON_KOKKOS:    # the hosts with Kokkos have no package RIGID
        rigid = forces("delete yes").replace("all nve", "all rigid single")
        fact("rigid bodies and delete", "delete yes removes atoms without telling fix move, whose rigid bodies" in
             lmp.run_well(begin() + rigid + "run 0\n", folder))
    fact("a facet wound the other way", "edges of the mesh join facets that are wound" in turned)
    fact("a facet in both windings", "facets of the mesh are there in both windings: forward" in both, both[-300:])
    fact("a mesh longer than the box",
         "longer than the periodic box in x, by 2:" in long and "box in y" not in long)
    write_data(folder / "spheres.data", spheres())
