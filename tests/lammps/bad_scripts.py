# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Input scripts that must end with an error, for test_bad_scripts.py.

Each table has one script and a row per case: its name, the words that replace {} in the script, and the
parts that the message must have.
"""
import lmp

ONE_ATOM = "create_atoms    1 single 0.3 0.2 1.5 units box\n"
ONE_SPHERE = lmp.head("-3 3 -3 3 -1 5", modify="") + ONE_ATOM + "set             atom 1 diameter 1.0 density 2.0\n"
WALL = ONE_SPHERE + """\
pair_style      gran/hooke 1000 NULL 50 NULL 0.5 0
pair_coeff      * *
fix             move all nve/sphere
"""
FLOW = ONE_SPHERE + "pair_style      zero 1.0\npair_coeff      * *\n"
NO_RADIUS = lmp.head("-3 3 -3 3 -1 5", style="atomic", modify="") + ONE_ATOM + """\
pair_style      lj/cut 1.0
pair_coeff      * * 1 1
mass            1 1.0
fix             move all nve
"""
HOOKE = "fix             wall all wall/lsdcd hooke 1e4 NULL 5 NULL 0.5 1 "
RUN = "run             1\n"


def changed(script, *changes):
    for old, new in changes:
        assert script.count(old) == 1, old
        script = script.replace(old, new)
    return script


def atoms(*places):
    return "".join(f"create_atoms    1 single {place} units box\n" for place in places)


def body(made):
    """The script of a wall and a rigid body, whose atoms are made by the lines `made`."""
    return lmp.head("-3 3 -3 3 -1 5", modify="") + f"""\
{made}set             type 1 diameter 0.2 density 2.0
pair_style      zero 1.0
pair_coeff      * *
fix             move all nve
fix             wall all wall/lsdcd hooke 1e4 NULL 20 NULL 0.1 1 mesh floor.stl
"""


TWO_DIMENSIONS = changed(WALL, ("atom_style", "dimension       2\natom_style"), ("f f f", "f f p"),
                         ("-1 5", "-0.5 0.5"), ("0.3 0.2 1.5", "0.3 1.5 0"))
FOUR_ATOMS = atoms("0.3 0.2 1.5", "0.6 0.2 1.5", "0.3 0.6 1.5", "0.3 0.2 1.9")
MOLECULES = """\
fix             mol all property/atom mol
set             group all mol 1
set             atom 4 mol {}
"""

TABLES = [
    # Where the fix is made, without a run.
    (WALL + HOOKE + "mesh floor.stl {}\n", [
        ("limits_without_0", "body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint slider 0 0 1 limits 1 2",
         "Fix wall wall/lsdcd", "in 'body', the limits 1 2 do not contain 0, which is where the body begins"),
        ("flat_by_matrix", "matrix 1 2 3 0 2 4 6 0 0 0 1 0",
         "Fix wall wall/lsdcd", "in 'matrix', the determinant of the rows 1 2 3, 2 4 6, 0 0 1 is 0"),
    ]),
    # fix wall/lsdcd: the words after mesh.
    (WALL + HOOKE + "mesh {}\n" + RUN, [
        ("grid_over_budget", "floor.stl grid 0.01 memory 1",
         "grid 0.01 takes", "at least", "memory budget is 1 MB", "leave grid out"),
        ("law_of_no_type", "floor.stl law types 1*3 hooke 1e4 NULL 5 NULL 0.5 1",
         "Fix wall wall/lsdcd", "in 'types 1*3', there is no atom type 3: there are 1"),
        ("mesh_fields_of_two_fixes", "floor.stl mesh_fields a.vtp every 5\n"
         "fix             lid all wall/lsdcd hooke 1e4 NULL 5 NULL 0.5 1 mesh floor.stl move 0 0 3 "
         "mesh_fields a.vtp every 5",
         "Fix wall wall/lsdcd", "in 'mesh_fields', 'a.vtp' is the mesh_fields file that fix lid writes",
         "name another file"),
        ("mesh_stl_is_mesh", "floor.stl mesh_stl ./floor.stl every 5",
         "Fix wall wall/lsdcd", "in 'mesh_stl', './floor.stl' is 'floor.stl', the mesh file that this fix reads",
         "name another file"),
        ("mesh_stl_is_mesh_of_massflow", "lid.stl mesh_stl floor.stl every 5\n"
         "fix             count all massflow/lsdcd mesh floor.stl",
         "Fix wall wall/lsdcd", "in 'mesh_stl', 'floor.stl' is the mesh file that fix count reads",
         "name another file"),
        ("meshes_missing_file", "floor.stl mesh nowhere.stl", "Fix wall wall/lsdcd", "nowhere.stl"),
        ("meshes_outside_box", "floor.stl mesh floor.stl move 0 0 300",
         "Fix wall wall/lsdcd", "mesh 2 'floor.stl': the mesh is outside the box"),
        ("meshes_side_of_open", "floor.stl mesh floor.stl move 0 0 3 side in",
         "Fix wall wall/lsdcd", "side in and side out need a closed", "'floor.stl'"),
        ("missing_file", "no_such_file.stl", "no_such_file.stl"),
        ("missing_file_of_no_format", "wall.vtk",
         "wall.vtk", "its name does not end with one of .stl, .obj, .ply, .off"),
        ("motion_no_variable", "floor.stl motion variable NULL NULL v_u NULL NULL NULL",
         "Fix wall wall/lsdcd", "there is no variable 'u', which the wall reads"),
        ("precision_gone", "floor.stl precision mixed",
         "Fix wall wall/lsdcd", "precision", "all steps compute in double", "delete precision and its value"),
        ("motion_table_is_device", "floor.stl motion table /dev/zero",
         "cannot read the table '/dev/zero' of a motion: it is a device; give the path of a file of text"),
        ("motion_table_is_directory", "floor.stl motion table .", "cannot read the table '.' of a motion: it is a directory"),
        ("motion_table_missing", "floor.stl motion table no/such/table",
         "Fix wall wall/lsdcd", "cannot read the table 'no/such/table' of a motion"),
        ("motion_table_no_table", "floor.stl motion table floor.stl",
         "Fix wall wall/lsdcd", "table 'floor.stl' line 1: 'solid' is not a number; begin a line of text with #"),
        ("no_area", "line.stl", "line.stl", "its 1 facet has no area"),
        ("outside_box", "floor.stl move 0 0 100", "outside the box", "z from 100 to 100", "scale", "move"),
        ("rmax_too_small", "floor.stl rmax 0.4", "Fix wall wall/lsdcd: atom 1 has radius 0.5", "rmax 0.4"),
        ("side_of_double_sided_mesh", "both.stl side out", "side in and side out need facets of one winding; 4 of",
         "'both.stl' are there in both, as in a double-sided export", "lsdcd repair", "side both"),
        ("side_of_inverted_shell", "two.stl side in",
         "closed, oriented mesh", "4 facets of closed shells that are wound against the others", "lsdcd repair"),
        ("side_of_open_mesh", "floor.stl side in", "closed, oriented mesh", "4 open"),
        ("side_of_shell_that_cuts_itself", "knot.stl side in",
         "a mesh that does not meet itself", "'knot.stl'", "lsdcd inspect", "side both"),
        ("side_of_shells_that_cut", "cut.stl side in",
         "shells that are apart", "'cut.stl' cut or touch each other at", "pairs of facets", "side both"),
        ("truncated_mesh", "truncated.stl", "truncated.stl"),
        ("file_without_mesh", "floor.stl two.STL", "'two.STL' is not a keyword here: write mesh before the file"),
        ("joint_without_body", "floor.stl hinge 0 0 0 0 1 0", "'hinge' is not a keyword here: it goes with body"),
        ("period_below_0", "floor.stl motion rotate 0 0 0 0 0 1 -2",
         "the period = -2 is below 0: give a period above 0 and, to turn the other way, the axis with the other sign"),
        ("period_of_a_swing_below_0", "floor.stl motion wiggle 0 0 1 -2",
         "to begin the other way, the amplitude with the other sign"),
        ("unknown_keyword", "floor.stl sclae 2", "'sclae' is not a keyword", "'scale s | sx sy sz'"),
        ("continued_behind_a_comment", "floor.stl &  # the floor", "the command ends at '&'", "a comment", "only if '&' is its last character"),
        ("continued_without_a_space", "floor.stl scale 1&  # the floor", "the command ends at '&'", "a comment", "only if '&' is its last character"),
    ]),
    (changed(WALL, ("f f f", "p p f")) + HOOKE + "mesh {}\n" + RUN, [
        ("far_larger_than_a_periodic_box", "two.stl scale 1e4", "the mesh is far larger than the box", "add scale",
         "Its periodic images would lie over one another in x"),
        ("meshes_through_periodic", "floor.stl mesh floor.stl move 0 0 1 motion rotate 0 0 0 0 0 1 2",
         "Fix wall wall/lsdcd: mesh 2 'floor.stl': the moving mesh reaches the periodic face in x at step 0",
         "make the boundary fixed"),
        ("motion_through_periodic", "floor.stl motion rotate 0 0 0 0 0 1 2",
         "Fix wall wall/lsdcd: the moving mesh reaches the periodic face in x at step 0", "make the boundary fixed"),
    ]),
    (TWO_DIMENSIONS + HOOKE + "mesh {}\n" + RUN, [
        ("motion_out_of_plane", "floor.stl rotate 1 0 0 90 motion rotate 0 0 0 1 0 0 2",
         "Fix wall wall/lsdcd: in two dimensions a mesh must move in the plane z = 0 and turn about z",
         "'rotate 0 0 0 1 0 0 2'"),
        ("servo_out_of_plane", "floor.stl rotate 1 0 0 90 servo force z 1 vmax 1",
         "Fix wall wall/lsdcd",
         "in two dimensions a mesh must move in the plane z = 0 and turn about z, not by 'servo force z 1 vmax 1'"),
    ]),
    (changed(NO_RADIUS, ("atom_style      atomic", "atom_style      {}"), ("mass            1 1.0\nfix             move all nve\n", "")) +
     HOOKE + "mesh floor.stl\n" + RUN, [
        ("shapes_of_triangles", "hybrid sphere tri", "Fix wall wall/lsdcd: the atom style has triangles"),
    ]),
    (changed(NO_RADIUS, ("atom_style      atomic", "atom_style      ellipsoid"), ("mass            1 1.0\nfix             move all nve\n", "")) +
     "fix             wall all wall/lsdcd {} mesh floor.stl\n" + RUN, [
        ("ellipsoids_with_adhesion", "granular jkr 1e5 700 0.3 0.3 tangential mindlin NULL 0.6 0.4",
         "in 'law', adhesion: the wall has it for spheres alone"),
    ]),
    (NO_RADIUS + HOOKE + "mesh {}\n" + RUN, [
        ("no_radius", "floor.stl", "radius", "atom_style sphere"),
    ]),

    # fix wall/lsdcd: the words after its style. Then fix_modify.
    (WALL + "fix             wall all wall/lsdcd {}\n" + RUN, [
        ("adhesion_limited", "granular jkr 1e5 0.7 0.3 0.3 tangential mindlin NULL 0.6 0.4 limit_damping mesh floor.stl",
         "in 'granular limit_damping', the adhesive sub-model 'jkr' must be able to pull: leave limit_damping out"),
        ("limit_force", "hooke 1e4 NULL 5 NULL 0.5 1 limitForce on mesh floor.stl",
         "'limitForce' is not a keyword here: the word is limit_damping, which comes before mesh"),
        ("granular_heat_without",
         "granular hertz 1e5 3 tangential linear_nohistory 0 0 heat area 1 mesh floor.stl temperature 300",
         "the sub-model heat needs a " + ("LAMMPS with fix heat/flow" if lmp.version() < 20230802 else "temperature and a heat flow per atom")),
        ("material_units", "granular material glass.lsdcd glass mesh floor.stl",
         "the input script is in units lj", "'units si'"),
        ("negative_kn", "hooke -1e4 NULL 5 NULL 0.5 1 mesh floor.stl",
         "kn = -1e4 is out of range: it must be 0 or more"),
    ]),
    (changed(WALL, ("lj", "si")) + "fix             wall all wall/lsdcd {} mesh floor.stl\n" + RUN, [
        ("material_bad_file", "granular material bad.lsdcd glass",
         "bad.lsdcd line 3", "'soft' is not a number", "youngs_modulus VALUE Pa  # source"),
        ("material_and_law", "granular material glass.lsdcd glass mesh floor.stl material steel law granular hertz/material 1e9 0.9 0.3 "
         "tangential mindlin NULL 1 0.5", "mesh 'floor.stl' has 'material steel' and 'law', which both set its contact numbers: leave one out"),
        ("material_in_law", "granular material glass.lsdcd glass mesh floor.stl law types 2 granular material glass.lsdcd steel",
         "in 'law' of mesh 'floor.stl', numbers are expected, not a material", "'types I NAME'"),
        ("material_is_device", "granular material /dev/zero glass",
         "cannot read the material file '/dev/zero': it is a device; give the path of a file of text"),
        ("material_includes_device", "granular material endless.lsdcd glass",
         "endless.lsdcd line 2: the included file '/dev/zero' cannot be read: it is a device"),
        ("material_missing_file", "granular material glas.lsdcd glass",
         "'glas.lsdcd'", "LSDCD_POTENTIALS", "glass.lsdcd"),
        ("material_types_of_no_type", "granular material glass.lsdcd glass types 5 glass",
         "in 'types 5', there is no atom type 5: there are 1"),
    ]),
    (changed(WALL, ("lj", "metal")) + "fix             wall all wall/lsdcd {} mesh floor.stl\n" + RUN, [
        (f"restitution_in_metal_{name}", words, "Fix wall wall/lsdcd", says, "only in units in which a force of 1 gives a mass of 1 the acceleration 1",
         "in those that are used it gives 9648.53", remedy)
        for name, words, says, remedy in (
            ("tsuji", "granular hertz 1e5 0.5 tangential linear_nohistory 0 0 damping tsuji", "(tsuji or coeff_restitution) returns the restitution e", "another damping"),
            ("exact", "granular hooke 1e5 0.5 tangential linear_nohistory 0 0 damping coeff_restitution", "(tsuji or coeff_restitution)", "another damping"),
            ("of_mesh", "granular hooke 1e5 1 tangential linear_nohistory 0 0 damping coeff_restitution mesh floor.stl move 0 0 3 law granular hooke 1e5 0.5 "
             "tangential linear_nohistory 0 0 damping coeff_restitution", "(tsuji or coeff_restitution)", "another damping"),
            ("rolling", "hooke/history 1e4 NULL 5 NULL 0.5 1 rolling epsd 0.3 0.2", "(epsd or epsd3) is the part of the critical dashpot", "or 0 for it"))
    ]),
    (WALL + HOOKE + "mesh floor.stl mesh floor.stl move 0 0 3\nfix_modify wall {}\n", [
        ("change_continued_behind_a_comment", "mesh 2 motion linear 0 0 1 &  # up", "Fix wall wall/lsdcd", "the command ends at '&'", "a comment", "only if '&' is its last character"),
        ("modify_mesh_alone", "mesh 2",
         "Fix wall wall/lsdcd", "fix_modify mesh 2: motion ..., servo ..., body ... or names ... must follow ("),
        ("modify_mesh_other_word", "mesh 2 energy yes",
         "Fix wall wall/lsdcd", "fix_modify mesh 2: motion ..., servo ..., body ... or names ... must follow, not 'energy'"),
        ("modify_no_mesh", "mesh 3 motion linear 0 0 1",
         "Fix wall wall/lsdcd", "K is the number of a mesh, from 1 to 2, or its name, not '3'"),
        ("modify_which_mesh", "motion linear 0 0 1",
         "Fix wall wall/lsdcd", "fix_modify motion: which of the 2 meshes", "fix_modify ID mesh K motion"),
    ]),

    # fix massflow/lsdcd
    (FLOW + "fix             m all massflow/lsdcd mesh {}\n" + RUN, [
        ("massflow_continued_behind_a_comment", "floor.stl &  # the floor", "Fix m massflow/lsdcd", "the command ends at '&'", "a comment", "only if '&' is its last character"),
        ("massflow_missing_file", "nothere.stl", "Fix m massflow/lsdcd", "nothere.stl"),
        ("massflow_missing_file_of_no_format", "wall.vtk",
         "wall.vtk", "its name does not end with one of .stl, .obj, .ply, .off"),
        ("massflow_outside_box", "floor.stl move 0 0 100",
         "Fix m massflow/lsdcd", "the mesh is outside the box", "z from 100 to 100", "scale", "move"),
    ]),
    (changed(FLOW, ("sphere", "hybrid sphere bond"), ("set             atom 1 diameter 1.0 density 2.0\n", ""))
     + "fix             m all massflow/lsdcd mesh {}\n" + RUN, [
        ("massflow_delete_bonded", "floor.stl delete yes",
         "delete yes leaves bonds without their atoms", "an atom style without bonds"),
    ]),

    # fix insert/lsdcd
    (FLOW + "region          moved sphere 0 0 0 1 side out units box\n" +
     "variable        u equal 0.1\nregion          moves sphere 0 0 0 1 units box move v_u NULL NULL\n" +
     "fix             in all insert/lsdcd {}\n" + RUN, [
        ("insert_amount", "mesh floor.stl diam one 0.2 dens 1", "Fix in insert/lsdcd", "the amount is missing",
         "massrate, numberrate, mass or number"),
        ("insert_closed_face", "mesh two.stl diam one 0.2 dens 1 number 5", "Fix in insert/lsdcd", "two.stl: the triangles have no common side"),
        ("insert_mass_zero", "region box diam one 1e-110 dens 1 massrate 1", "Fix in insert/lsdcd",
         "diam and dens give the grains masses from 0 to 0: write both in the units of the script"),
        ("insert_mass_infinite", "region box diam range 1 1e110 dens 1 number 5", "masses from 0.523599 to inf"),
        ("insert_narrow_face", "mesh floor.stl diam one 50 dens 1 number 5",
         "Fix in insert/lsdcd", "floor.stl: no place on the face is 25, the largest radius, away from its edges"),
        ("insert_no_law", "mesh floor.stl dens 1 number 5", "Fix in insert/lsdcd", "diam, shape or mol is missing"),
        ("insert_no_place", "diam one 0.2 dens 1 number 5", "Fix in insert/lsdcd", "mesh FILE or region ID is missing"),
        ("insert_no_region", "region nowhere diam one 0.2 dens 1 number 5",
         "Fix in insert/lsdcd", "there is no region nowhere: define it before this fix"),
        ("insert_no_type", "region box diam one 0.2 dens 1 number 5 type 3", "in 'type', there is no atom type 3: there are 1"),
        ("insert_normal_of_region", "region box diam one 0.2 dens 1 number 5 vel normal 1", "vel normal needs a mesh"),
        ("insert_outside", "mesh floor.stl move 0 0 100 diam one 0.2 dens 1 number 5", "Fix in insert/lsdcd", "outside the box"),
        ("insert_region_of_no_bounds", "region moved diam one 0.2 dens 1 number 5",
         "Fix in insert/lsdcd", "region moved has no bounds, or changes with time: give a region that does neither, with side in"),
        ("insert_region_that_moves", "region moves diam one 0.2 dens 1 number 5",
         "Fix in insert/lsdcd", "region moves has no bounds, or changes with time"),
        ("insert_two_rates", "region box diam one 0.2 dens 1 massrate 1 numberrate 1", "'numberrate'", "massrate and numberrate are both given"),
        ("insert_unknown_keyword", "region box daim one 0.2", "Fix in insert/lsdcd", "'daim' is not a keyword", "diam one D"),
        ("insert_continued_behind_a_comment", "region box diam one 0.2 &  # small", "Fix in insert/lsdcd", "the command ends at '&'", "a comment", "only if '&' is its last character"),
        ("insert_wall_of_other_style", "region box diam one 0.2 dens 1 number 5 wall in",
         "in 'wall', fix in is of style insert/lsdcd: give the ID of a fix wall/lsdcd"),
        ("insert_wall_that_is_not", "region box diam one 0.2 dens 1 number 5 wall w",
         "in 'wall', there is no fix 'w': give the ID of a fix wall/lsdcd"),
    ]),
    (changed(NO_RADIUS, ("fix             move all nve\n", "")) + "fix             in all insert/lsdcd {}\n" + RUN, [
        ("insert_no_radius", "region box diam one 0.2 dens 1 number 5", "atoms need a radius and a mass each: use atom_style sphere"),
    ]),

    (changed(NO_RADIUS, ("atom_style      atomic", "atom_style      {}"), ("mass            1 1.0\nfix             move all nve\n", "")) +
     "fix             in all insert/lsdcd region box diam one 0.2 dens 1 number 5\n" + RUN, [
        ("insert_shapes", "hybrid sphere ellipsoid", "Fix in insert/lsdcd: the atom style has ellipsoids, and the spheres of 'diam' would have no shape",
         "give 'shape SX SY SZ', with three equal lengths for balls"),
    ]),

    # compute lsdcd/collide
    (body(FOUR_ATOMS) + "compute         c all lsdcd/collide {}\n" + RUN, [
        ("collide_atoms_differ", "wall mesh floor.stl atoms unit.txt", "is not a rigid copy of the atoms of file"),
        ("collide_atoms_file", "wall mesh floor.stl atoms floor.stl", "floor.stl: line 1 has 'solid'", "x y z"),
        ("collide_atoms_missing", "wall mesh floor.stl atoms nothere.txt", "cannot read file nothere.txt, there is no such file"),
        ("collide_atoms_are_endless", "wall mesh floor.stl atoms /dev/zero", "cannot read file /dev/zero, it is a device: give x y z of an atom a line"),
        ("collide_atoms_number", "wall mesh floor.stl atoms points.txt", "points.txt has 3 atoms", "has 4"),
        ("collide_fix_is_gone", "wall mesh floor.stl\n"
         "unfix           wall\n"
         "thermo_style    custom step c_c",
         "there is no fix 'wall'"),
        ("collide_lost_atoms", "wall mesh floor.stl\n"
         "region          top block 0.5 INF INF INF INF INF\n"
         "delete_atoms    region top\n"
         "thermo_style    custom step c_c",
         "at step 0", "has 3 of its 4 atoms left"),
        ("collide_missing_file", "wall mesh nothere.stl", "Compute c lsdcd/collide", "nothere.stl"),
        ("collide_nearest", "wall mesh floor.stl nearest 1.5", "N must be a whole number", "Syntax: nearest N"),
        ("collide_no_fix", "wal mesh floor.stl", "Compute c lsdcd/collide", "there is no fix 'wal'", "defined before"),
        ("collide_no_mesh", "wall grid 0.5", "mesh FILE is missing"),
        ("collide_no_molecules", "wall mesh floor.stl bodies molecule",
         "atoms with molecule IDs", "fix property/atom mol"),
        ("collide_no_words", "", "FIX_ID is missing", "Syntax: compute ID group lsdcd/collide FIX_ID mesh FILE"),
        ("collide_not_rigid", "wall mesh floor.stl\n"
         "velocity        all create 10 4711 loop geom\n"
         "thermo          1\n"
         "thermo_style    custom step c_c",
         "at step 1", "is not a rigid copy", "fix rigid"),
        ("collide_other_fix", "move mesh floor.stl", "fix move is of style nve", "give the ID of a fix wall/lsdcd"),
        ("collide_other_wall", "wall mesh floor.stl\n"
         "unfix           wall\n"
         "fix             wall all wall/lsdcd hooke 1e4 NULL 20 NULL 0.1 1 mesh floor.stl scale 2\n"
         "thermo_style    custom step c_c",
         "fix wall has different meshes than when the compute was defined"),
        ("collide_short_cells", "wall mesh floor.stl grid 1e-7", "cell"),
        ("collide_twice", "wall mesh floor.stl grid 1 grid 2", "the keyword 'grid' is given twice"),
        ("collide_unknown_keyword", "wall mesh floor.stl bodie one", "'bodie' is not a keyword", "bodies one"),
        ("collide_continued_behind_a_comment", "wall mesh floor.stl &  # one", "Compute c lsdcd/collide", "the command ends at '&'", "a comment", "only if '&' is its last character"),
    ]),
    # region mesh/lsdcd
    (WALL + "variable        turn equal step\nregion          r mesh/lsdcd {}\n" + RUN, [
        ("region_double_sided", "both.stl", "Region r mesh/lsdcd", "both.stl has no inside",
         "each of its facets is there in both windings", "lsdcd repair"),
        ("region_gap", "two.stl gap -1", "Region r mesh/lsdcd", "'gap'", "D = -1 is out of range"),
        ("region_mesh_twice", "two.stl mesh two.stl", "Region r mesh/lsdcd", "'mesh' is not a keyword"),
        ("region_missing_file", "nowhere.stl", "Region r mesh/lsdcd", "nowhere.stl"),
        ("region_move_twice", "two.stl move v_x NULL NULL move v_x NULL NULL",
         "Region r mesh/lsdcd", "'move' by a variable is given twice"),
        ("region_no_words", "", "Region r mesh/lsdcd", "FILE is missing", "Syntax: region ID mesh/lsdcd FILE"),
        ("region_open", "floor.stl", "Region r mesh/lsdcd", "floor.stl has no inside", "edges are open",
         "the first goes from", "lsdcd repair"),
        ("region_open_face", "two.stl open 1", "Region r mesh/lsdcd", "'open' is not a keyword"),
        ("region_continued_behind_a_comment", "two.stl &  # two", "Region r mesh/lsdcd", "the command ends at '&'", "a comment", "only if '&' is its last character"),
        ("region_rotate_short", "two.stl rotate v_turn 0 0 0", "Region r mesh/lsdcd", "'rotate' has too few values"),
        ("region_rotating_in_union", "two.stl rotate v_turn 0 0 0 0 0 1\n"
         "region u union 2 box r\ngroup g region u",
         "Region r mesh/lsdcd", "region u of style union has a part that rotates", "put the meshes into one file"),
        ("region_side", "two.stl side both", "Region r mesh/lsdcd", "'side'", "'both'"),
        ("region_wall", "two.stl scale 40 move -8 -8 -8\nfix w all wall/region r harmonic 1 1 0.5",
         "Region r mesh/lsdcd", "the region is no wall", "use fix wall/lsdcd"),
    ]),
    (body(FOUR_ATOMS) + "{}\n" + RUN, [
        ("collide_no_atoms", "group           none empty\n"
         "compute         c none lsdcd/collide wall mesh floor.stl",
         "the group has no atoms"),
    ]),
    (body("{}") + "compute         c all lsdcd/collide wall mesh floor.stl\n" + RUN, [
        ("collide_on_a_line", atoms("0 0 1", "1 0 1", "2 0 1"), "on a line"),
        ("collide_two_atoms", atoms("0.3 0.2 1.5", "0.6 0.2 1.5"), "2 atoms", "three or more"),
    ]),
    (body(FOUR_ATOMS + MOLECULES)
     + "compute         c all lsdcd/collide wall mesh floor.stl bodies molecule\n" + RUN, [
        ("collide_no_molecule", "0", "atom 4 of the group is in no molecule", "bodies one"),
        ("collide_sizes", "2",
         "the body of molecule 2 has 1 atoms, and the body of molecule 1 3", "a compute for each kind"),
    ]),
]

# name: (script, parts of the message)
CASES = {name: (script.replace("{}", words), message) for script, rows in TABLES for name, words, *message in rows}
assert len(CASES) == sum(len(rows) for _, rows in TABLES), "two cases have the same name"
