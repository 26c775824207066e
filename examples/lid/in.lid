# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# A heavy lid sinks on a bed of grains until the bed carries it, and sinks farther under a load.
#
#   python3 make_lid.py && mpirun -np 2 lmp-lsdcd -in in.lid
#
# Lengths are in diameters of a grain, grains have density 1, and gravity is 1.

variable        dir index .             # where the meshes are
variable        density index 10.0      # of the lid
variable        load index 3.0          # what is put on it, in its weights
variable        damper index 1000.0     # that lowers it: a force over a speed
variable        steps index 12000       # half of what each part takes
variable        out index lid.txt
variable        picture index lid.png
variable        png index $(is_available(feature,png))

units           lj
atom_style      sphere
newton          off
comm_modify     vel yes
boundary        f p f
region          box block -6.5 6.5 0 6 -0.5 18
create_box      3 box                   # types 1 and 2 are grains, 3 colours the lid
lattice         sc $(1/1.2^3)           # 5 of them in the period
region          fill block -5.4 5.4 0 6 0.6 12.5 units box
create_atoms    1 region fill
set             group all type/fraction 2 0.5 4711
variable        size atom 0.8+0.3*random(0,1,7)
set             group all diameter v_size
set             group all density 1.0
velocity        all create 1.0 4711 loop geom

variable        law string "hertz/history 1e5 NULL 100 NULL 0.4 1"
pair_style      gran/${law}
pair_coeff      * *
neighbor        0.3 bin
neigh_modify    every 1 delay 0 check yes
timestep        0.001

# The lid slides along z. Its damper lowers it slowly, while the grains fall.
fix             fall all gravity 1.0 vector 0 0 -1
fix             move all nve/sphere
fix             wall all wall/lsdcd ${law} mesh ${dir}/box.stl name floor &
                mesh ${dir}/lid.stl name lid move 0 0 13 body density ${density} joint slider 0 0 1 spring 0 ${damper} &
                draw faces 3 log brief
fix_modify      wall names wall body_coordinate overlap
fix_modify      wall mesh lid names lid force_z
fix_modify      wall mesh floor names floor force_z

variable        lid equal 11.8*5.9*1.0*v_density        # its mass, and its weight
variable        height equal 13.0+v_wall_body_coordinate            # of its lower face
variable        borne equal v_lid_force_z           # what the grains carry
variable        floor equal v_floor_force_z
thermo_style    custom step atoms ke v_height v_borne v_floor v_wall_overlap
thermo_modify   norm no
thermo          2000
fix             curve all print 100 "$(time) $(v_height:%.6g) $(v_borne:%.6g)" file ${out} title "# time height borne" screen no
run             $(2*v_steps)
variable        height_then equal $(v_height)
variable        under_lid equal $(v_borne/v_lid)

fix_modify      wall mesh 2 body load 0 0 $(-v_load*v_lid)
run             $(2*v_steps)
variable        under_load equal v_borne/((1+v_load)*v_lid)
# Box and lid together: the floor and the walls have the weight of the grains, the lid, and the load.
variable        all equal -v_floor/(mass(all)+(1+v_load)*v_lid)

print           "lid weight ${lid} carried $(v_under_lid:%.8g) height $(v_height_then:%.5g) with_load $(v_under_load:%.8g) with_load_height $(v_height:%.5g) floor $(v_all:%.8g)"
if              "${png} != 0" then &
                "write_dump all image ${picture} type diameter view 80 -80 zoom 1.6 size 1200 1200 box no 0 fix wall type 1 0 modify backcolor white acolor 1 orange acolor 2 steelblue acolor 3 silver"
variable        off equal abs(v_under_lid-1)
if              "${off} > 0.001" then "print 'the grains do not carry the lid'" "quit 1"
variable        off equal abs(v_under_load-1)
if              "${off} > 0.001" then "print 'the grains do not carry lid and load'" "quit 1"
variable        off equal abs(v_all-1)
if              "${off} > 0.001" then "print 'the box does not carry grains, lid and load'" "quit 1"
