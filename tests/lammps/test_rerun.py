# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The command rerun: what follows from positions and time is as in the run that was dumped, what
adds up from step to step is refused or told of."""

import lmp
from facts import at_most, fact

SMOOTH = "hooke 1e3 NULL 0 0 0 0"    # forces follow from positions alone
HISTORY = "hooke/history 1e4 NULL 20 NULL 0.4 1"
MOVES = "motion wiggle 0 0 0.005 0.13 motion rotate 0 0 0 0 0 1 0.7 motion linear 0.1 0 0"
HEAD = lmp.SMALL_BOX.format(atoms="create_atoms 1 single 0.3 0.2 0.48 units box\n"
                                   "create_atoms 1 single -1 0.5 0.495 units box") + """\
neighbor        0.3 bin
neigh_modify    delay 0 every 1 check yes
"""
OUTPUT = """\
thermo          20
thermo_style    custom step f_w f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6] f_w[7] f_w[8] f_w[11]
thermo_modify   format float %.17g norm no
"""
DUMP = "dump d all custom 20 snapshots id type x y z vx vy vz\ndump_modify d format float %.17g sort id\n"
RERUN = "rerun snapshots {} dump x y z vx vy vz\n"


def text(words, law=SMOOTH, mesh="floor.stl"):
    # The timestep after the fix, whose clock begins before it.
    return HEAD + f"fix w all wall/lsdcd {law} mesh {mesh} {words}\ntimestep 0.001\n" + OUTPUT


def dumped(words, law=SMOOTH):
    return text(words, law) + "velocity all set 0.2 0.3 -0.5\n" + DUMP + "run 200\nundump d\n"


def rows_of(output):
    return {row[0]: row[1:] for row in lmp.read_thermo(output)}


def apart(a, b):
    """The largest difference of a vector's element in any of b's steps, of the element's size."""
    if not b or not b.keys() <= a.keys():
        return 1
    size = [max(abs(row[k]) for row in a.values()) for k in range(10)]
    return max(abs(a[step][k] - row[k]) / (size[k] or 1) for step, row in b.items() for k in range(10))


prepare = lmp.flat_floor


def test_same(folder):
    for name, words in (("at rest", ""), ("that moves", MOVES)):
        one = lmp.run_well(dumped(words), folder)
        run = rows_of(one)
        fact(f"a mesh {name}: touches", sum(row[7] > 0 for row in run.values()) > 3)
        for title, steps, number in (("a fresh script", "", 11), ("one snapshot", "first 120 last 120", 1),
                                     ("from the middle", "first 100", 6)):
            rows = rows_of(lmp.run_well(text(words) + RERUN.format(steps), folder))
            fact(f"a mesh {name}, {title}: {number} snapshots", len(rows) == number, str(len(rows)))
            at_most(f"a mesh {name}, {title}: as in the run", apart(run, rows), 1e-12)
        # The steps of the rerun are those of the run before it.
        rows = rows_of(lmp.run_well(dumped(words) + RERUN.format("first 0 last 200"), folder))
        at_most(f"a mesh {name}, rerun by the script that ran: as in the run", apart(run, rows), 1e-12)


def test_springs(folder):
    short = dumped("", HISTORY).replace("run 200", "run 20")    # they touch in its last step
    lmp.run_well(short, folder)
    fresh = lmp.run_well(text("", HISTORY) + RERUN.format(""), folder)
    still = "set group all omega 0 0 0\n"    # which no dump brings back
    after = lmp.run_well(short + still + RERUN.format(""), folder)
    fact("springs: told once", fresh.count("a rerun does not know the springs") == 1)
    at_most("springs: those of a run before it are not those of snapshots",
            apart(rows_of(fresh), rows_of(after)), 1e-12)
    fact("spins: told once", fresh.count("a rerun does not know how fast atoms spin") == 1)
    fact("spins: not told of where nothing rubs", "how fast atoms spin" not in lmp.run_well(text("") + RERUN.format(""), folder))
    fact("spins: told of where it only rolls", "how fast atoms spin" in
         lmp.run_well(text("rolling cdt 0.1") + RERUN.format(""), folder))
    fact("springs: not told of where there are none", "does not know the springs" not in
         lmp.run_well(text("") + RERUN.format(""), folder))


def test_files(folder):
    words = MOVES + " mesh_fields f_*.vtp every 20 mesh_stl s_*.stl every 20"
    lmp.run_well(dumped(words), folder)
    before = {p.name: p.read_bytes() for p in folder.glob("[fs]_*")}
    for path in folder.glob("s_*.stl"):
        path.unlink()
    output = lmp.run_well(text(words) + RERUN.format("first 20"), folder)
    after = {p.name: p.read_bytes() for p in folder.glob("[fs]_*")}
    vtp, stl = ({k: v for k, v in before.items() if k.startswith(c)} for c in "fs")
    fact("mesh_fields of the run stay as they were", len(vtp) == 11 and
         all(after.get(k) == v for k, v in vtp.items()))
    fact("mesh_fields: told once", output.count("no mesh_fields are written") == 1)
    books = lmp.run_well(text("energy impacts 0.1") + RERUN.format("first 20"), folder)
    fact("energy and impacts: told once", books.count("loads, wear, energy and impacts add up: none of these") == 1)
    fact("mesh_stl: the mesh where it was", len(stl) == 10 and
         all(after.get(k) == v for k, v in stl.items()))
    lmp.run_well(text(words) + RERUN.format("first 20") + "run 20 pre no\n", folder)
    fact("mesh_fields of a run after a rerun are written", (folder / "f_220.vtp").exists())


def test_spectra(folder):
    words = MOVES + " impacts 1e-3 impact_spectrum i_*.csv every 20"
    lmp.run_well(dumped(words).replace("velocity all", "set group all z 0.52\nvelocity all"), folder)
    before = {p.name: p.read_bytes() for p in folder.glob("i_*")}
    lmp.run_well(text(words) + RERUN.format("first 20"), folder)
    fact("the run has impacts", len(before) == 10 and max(map(len, before.values())) > 50)
    fact("its spectra stay as they were", {p.name: p.read_bytes() for p in folder.glob("i_*")} == before)


def test_refused(folder):
    lmp.run_well(dumped(""), folder)
    lines = "variable dz equal -0.01*step*dt\n"
    for name, script_text, told in (
            ("means", text("average 20"), "a rerun has no steps between its dump's snapshots, over which average 20"),
            ("a servo", text("servo force z -10 vmax 0.1"), "in a rerun the position of a servo is not known"),
            ("velocities that are differences", lines + text("motion variable NULL NULL v_dz NULL NULL NULL"),
             "in a rerun there is no step before, from which motion variable"),
            ("velocities that are added up", lines + text("motion rotate 0 0 0 0 0 1 variable NULL v_dz"),
             "in a rerun the displacement or angle is not known"),
            ("a motion that begins later", text(MOVES).replace("fix w ", "reset_timestep 40\nfix w "),
             "the snapshot of step 0 is before step 40"),
            ("massflow", text("") + "fix m all massflow/lsdcd mesh floor.stl\n",
             "massflow/lsdcd: a rerun has no steps")):
        lmp.refused(name, script_text + RERUN.format(""), folder, told)
    rows = folder / "rows.txt"
    rows.write_text("of a run\n")
    lmp.refused("massflow with a file", text("") + f"fix m all massflow/lsdcd mesh floor.stl file {rows.name}\n" + RERUN.format(""), folder,
                "massflow/lsdcd: a rerun has no steps")
    fact("the file of a massflow that is refused stays", rows.read_text() == "of a run\n")


def test_no_rerun(folder):
    """Commands that initialise fixes between runs and within them."""
    servo = text("servo force z -10 vmax 0.1 mesh_fields f_*.vtp every 20") + \
        "fix m all massflow/lsdcd mesh floor.stl\n"
    output = lmp.run_well(servo + """\
run 0
velocity all set 0 0 0
run 0
run 40 every 20 "velocity all set 0 0 0"
delete_atoms overlap 0.1 all all
run 20
reset_timestep 0
run 20
minimize 0 0 2 2
run 20 pre no
run 0
run 20
""", folder)
    fact("no run is taken for a rerun", "rerun" not in output)
