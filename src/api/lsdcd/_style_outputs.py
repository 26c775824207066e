# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The numbers of styles of LAMMPS beside fix wall/lsdcd, in their order: name, kind of unit, what they are. Written by make_names.py, from
the pages of the styles."""

# The last row of lsdcd/energy and lsdcd/collide is the scalar.
STYLE_OUTPUTS: dict[str, list[tuple[str, str, str]]] = {
    "massflow/lsdcd": [
        ("forward", "", "number of atoms that passed forward"),
        ("forward_mass", "mass", "their mass"),
        ("backward", "", "number of atoms that passed backward"),
        ("backward_mass", "mass", "their mass"),
        ("net_mass", "mass", "mass forward less mass backward"),
        ("mass_rate", "mass/time", "net mass per time, averaged over the last full window of *every* steps; 0 before the first window is full"),
        ("deleted", "", "number of atoms deleted"),
        ("deleted_mass", "mass", "their mass"),
    ],
    "insert/lsdcd": [
        ("inserted", "", "number of grains inserted"),
        ("inserted_mass", "mass", "their mass"),
        ("late", "", "number of grains that are due and have no place yet"),
        ("late_mass", "mass", "their mass"),
        ("refused_grain", "", "places that were refused because a grain was there, because a wall was there, or because they lay outside of the region or mesh"),
        ("refused_wall", "", "places that were refused because a grain was there, because a wall was there, or because they lay outside of the region or mesh"),
        ("refused_outside", "", "places that were refused because a grain was there, because a wall was there, or because they lay outside of the region or mesh"),
    ],
    "lsdcd/energy": [
        ("dissipated_power_damping", "energy/time", "power that contacts between grains dissipate in the step: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_power_slider", "energy/time", "power that contacts between grains dissipate in the step: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_power_rolling", "energy/time", "power that contacts between grains dissipate in the step: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_power_twisting", "energy/time", "power that contacts between grains dissipate in the step: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_power_adhesion", "energy/time", "power that contacts between grains dissipate in the step: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_damping", "energy", "energy that contacts between grains have dissipated since the beginning: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_slider", "energy", "energy that contacts between grains have dissipated since the beginning: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_rolling", "energy", "energy that contacts between grains have dissipated since the beginning: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_twisting", "energy", "energy that contacts between grains have dissipated since the beginning: damping, slider, rolling, twisting, adhesion"),
        ("dissipated_adhesion", "energy", "energy that contacts between grains have dissipated since the beginning: damping, slider, rolling, twisting, adhesion"),
        ("lost_lever_arms", "energy", "energy that is lost by lever arms, stiffness, turned springs, and with contacts that are inserted and deleted"),
        ("lost_stiffness", "energy", "energy that is lost by lever arms, stiffness, turned springs, and with contacts that are inserted and deleted"),
        ("lost_turned_springs", "energy", "energy that is lost by lever arms, stiffness, turned springs, and with contacts that are inserted and deleted"),
        ("lost_inserted", "energy", "energy that is lost by lever arms, stiffness, turned springs, and with contacts that are inserted and deleted"),
        ("contact_work", "energy", "work of grains on their contacts"),
        ("held_energy", "energy", "elastic energy of contacts"),
        ("remainder", "energy", "the remainder: work that contacts do not hold and no row has"),
        ("kinetic_energy", "energy", "kinetic energy of grains, with that of their rotation"),
        ("gravity_energy", "energy", "potential energy by fix gravity"),
        ("all_held_energy", "energy", "elastic energy of all contacts, those with walls included"),
        ("all_lost", "energy", "all that is lost: elements 6-14 and 24, and the same of walls"),
        ("drive_work", "energy", "work of the moving meshes and their surfaces on the grains"),
        ("dissipated_power_plastic", "energy/time", "power that contacts between grains dissipate by yielding"),
        ("dissipated_plastic", "energy", "energy that contacts between grains have dissipated since the beginning by yielding"),
        ("balance", "energy", "the scalar: 18 + 19 + 20 + 21 less 22, which keeps its value but for the remainders"),
    ],
    "lsdcd/impacts": [
        ("impacts", "", "number of impacts since the beginning"),
        ("impact_energy", "energy", "their energy, the sum of m v^2/2 with the reduced mass and the speed along the normal"),
    ],
    "lsdcd/collide": [
        ("pairs", "", "number of pairs, of all bodies"),
        ("bodies", "", "number of bodies"),
        ("uncertified", "", "number of pieces of bodies for which pairs may be missing; 0 unless you use *nearest* N"),
        ("meeting_bodies", "", "the scalar: number of bodies that meet the wall"),
    ],
}
