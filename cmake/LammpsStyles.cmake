# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# What a plugin and a LAMMPS with the styles compiled in share.

# The sources of the styles, in src/lammps.
set(LSDCD_STYLE_SOURCES clump_templates.cpp compute_collide_lsdcd.cpp compute_collide_lsdcd_bodies.cpp compute_energy_lsdcd.cpp compute_impacts_lsdcd.cpp
  fix_insert_lsdcd.cpp
  fix_massflow_lsdcd.cpp fix_massflow_lsdcd_atoms.cpp fix_massflow_lsdcd_output.cpp fix_springs_lsdcd.cpp fix_wall_lsdcd.cpp fix_wall_lsdcd_exchange.cpp
  host_atoms.cpp host_box.cpp host_pairs.cpp
  shape_atoms.cpp
  lammps_host.cpp mpi_host.cpp mpi_mesh.cpp node_atoms.cpp other_fixes.cpp own_messages.cpp output_variables.cpp own_wall_gran.cpp pair_granular_lsdcd.cpp
  pair_granular_lsdcd_impacts.cpp region_mesh_lsdcd.cpp rerun_watch.cpp run_advice.cpp run_speed.cpp wall_clearance.cpp wall_picture.cpp)

# 20210929 for a version.h with "29 Sep 2021"; empty for none.
function(lsdcd_version_of header result)
  set(${result} "" PARENT_SCOPE)
  file(STRINGS ${header} line REGEX "LAMMPS_VERSION")
  if(line MATCHES "\"([0-9]+) ([A-Z][a-z][a-z])[a-z]* ([0-9]+)")
    set(day ${CMAKE_MATCH_1})
    set(year ${CMAKE_MATCH_3})
    string(FIND "JanFebMarAprMayJunJulAugSepOctNovDec" ${CMAKE_MATCH_2} month)
    math(EXPR version "${year} * 10000 + (${month} / 3 + 1) * 100 + ${day}")
    set(${result} ${version} PARENT_SCOPE)
  endif()
endfunction()
