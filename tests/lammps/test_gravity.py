# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""fix gravity/lsdcd against LAMMPS's fix gravity: forces, energy, changing and disabled gravity, groups, processes, commands between runs."""

import re

import pytest

import lmp
from facts import at_most, fact

GRAINS = """\
units lj
atom_style sphere
boundary p p f
newton off
comm_modify vel yes
region box block -4 4 -4 4 -1 9 units box
create_box 2 box
lattice sc 1.0
region fill block -3.6 3.6 -3.6 3.6 0.4 6 units box
create_atoms 1 region fill
set group all type/fraction 2 0.4 4711
set type 1 diameter 0.9 density 2.5
set type 2 diameter 0.7 density 1.5
group some type 1
velocity all create 1.0 87287 dist gaussian
neighbor 0.3 bin
timestep 1e-3
variable g equal 5+step*0.01
variable z equal -1+step*0.002
fix move all nve/sphere
"""

SCENES = {"all": "fix down all gravity 9.81 vector 0 0 -1\n",
          "a group": "fix down some gravity 9.81 chute 20\n",
          "variables": "fix down all gravity v_g vector 1 0.5 v_z\n",
          "disabled": "fix down all gravity 9.81 vector 0 0 -1 disable\n"}    # which LAMMPS's form for Kokkos does not know
RUN = """\
fix_modify down energy yes
thermo 20
thermo_style custom step pe f_down
thermo_modify norm no format float %.17g
dump moves all custom 20 moves id x y z vx vy vz fx fy fz
dump_modify moves format float %.17g sort id
run 100
run 40
"""


LAW = "pair_style granular/lsdcd\npair_coeff * * hooke 1e4 20 tangential linear_nohistory 5 0.3 damping mass_velocity\n"


@pytest.mark.parametrize("scene", SCENES)
def test_as_fix_gravity(folder, scene):
    text = GRAINS + LAW + SCENES[scene]
    for ranks in (1, 2):
        energies, moves = [], []
        for style in ("gravity", "gravity/lsdcd"):
            script = text.replace("9.81", "0").replace(" disable", "") if style == "gravity" and scene == "disabled" else text
            output = lmp.run_well(script.replace(" gravity ", f" {style} ", 1) + RUN, folder, ranks)
            energies.append(lmp.read_thermo(output))
            moves.append(lmp.read_dump(folder / "moves"))
        # Of sums of 1e3 grains in another order.
        at_most(f"{scene}, {ranks} ranks: forces and ways", lmp.largest_difference(*moves), 1e-11)
        fact(f"{scene}, {ranks} ranks: has energy", scene == "disabled" or abs(energies[0][-1][2]) > 1, energies[0][-1])
        at_most(f"{scene}, {ranks} ranks: energy", max(abs(a - b) / max(1, abs(a)) for p, q in zip(*energies) for a, b in zip(p, q)), 1e-12)


def test_masses_change(folder):
    """The forces of grains that do not touch are their masses times gravity: in a run that is not set up, too, where LAMMPS's own form for a
    GPU misses masses that a command has changed."""
    free = re.sub("^velocity .*", "", GRAINS, flags=re.M) + LAW + SCENES["all"].replace(" gravity ", " gravity/lsdcd ")
    lmp.run_well(free + """dump masses all custom 40 masses id mass fz
dump_modify masses format float %.17g sort id
run 40
set type 2 density 3.0
run 40 pre no
set type 1 density 1.0
run 40
""", folder)
    rows = lmp.read_dump(folder / "masses")
    # The product is rounded once, and the sum with a force of 0 is not.
    at_most("forces that are not m g, in parts of them", max(abs(fz / (-9.81 * mass) - 1) for step, some in rows.items() if step > 0 for mass, fz in some.values()), 4e-16)
    fact("masses have changed", len({round(mass, 12) for some in rows.values() for mass, _ in some.values()}) == 4)


def test_before_a_run(folder):
    """No variable has been evaluated."""
    output = lmp.run_well(GRAINS + LAW + SCENES["variables"].replace(" gravity ", " gravity/lsdcd ") + 'print "before $(f_down:%.17g)"\nrun 0\n', folder)
    fact("no energy before a run", "\nbefore 0\n" in output or "\nbefore -0\n" in output, str(re.findall("before.*", output)))


@pytest.mark.skipif(not lmp.ON_KOKKOS, reason="of the form for Kokkos")
def test_refused(folder):
    lmp.refused("masses of types", "units lj\natom_style atomic\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\nmass 1 1\nfix down all gravity/lsdcd 1 vector 0 0 -1\n",
                folder, "atoms have no masses of their own", "use fix gravity")
