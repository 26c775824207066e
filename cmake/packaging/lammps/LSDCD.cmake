# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# Compiles the styles of LSDCD into LAMMPS, as a package of its own. Use it for a LAMMPS without the package PLUGIN, and
# where one file without libraries beside it is wanted. LAMMPS's sources stay as they are:
#   cmake -S lammps/cmake -B lammps/build -D CMAKE_PROJECT_lammps_INCLUDE=LSDCD_FOLDER/cmake/packaging/lammps/LSDCD.cmake
# CMake reads this file where LAMMPS's project begins. LAMMPS writes its lists of styles from the headers beside it, and
# the sources join the target when all of LAMMPS is known. The form for Kokkos is a plugin only.
cmake_minimum_required(VERSION 3.22)
get_filename_component(LSDCD_FOLDER ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)

set_property(GLOBAL APPEND PROPERTY FIX ${CMAKE_CURRENT_LIST_DIR}/fix_lsdcd.h)
set_property(GLOBAL APPEND PROPERTY COMPUTE ${CMAKE_CURRENT_LIST_DIR}/compute_lsdcd.h)
set_property(GLOBAL APPEND PROPERTY PAIR ${CMAKE_CURRENT_LIST_DIR}/pair_lsdcd.h)
set_property(GLOBAL APPEND PROPERTY REGION ${CMAKE_CURRENT_LIST_DIR}/region_lsdcd.h)

function(lsdcd_add_core)
  set(LSDCD_LAMMPS OFF)    # neither plugin nor launcher
  set(LSDCD_TESTS OFF)
  add_subdirectory(${LSDCD_FOLDER} lsdcd EXCLUDE_FROM_ALL)
endfunction()

function(lsdcd_join_lammps)
  include(${LSDCD_FOLDER}/cmake/LammpsStyles.cmake)
  lsdcd_version_of(${LAMMPS_SOURCE_DIR}/version.h version)
  list(TRANSFORM LSDCD_STYLE_SOURCES PREPEND ${LSDCD_FOLDER}/src/lammps/)
  target_sources(lammps PRIVATE ${LSDCD_STYLE_SOURCES})
  set_source_files_properties(${LSDCD_STYLE_SOURCES} PROPERTIES COMPILE_DEFINITIONS
    "LSDCD_HOST_VERSION=${version};OMPI_SKIP_MPICXX;MPICH_SKIP_MPICXX")
  target_include_directories(lammps PRIVATE ${LSDCD_FOLDER}/cmake/packaging/lammps ${LSDCD_FOLDER}/src)
  target_link_libraries(lammps PRIVATE $<BUILD_INTERFACE:lsdcd_core>)
  get_target_property(standard lammps CXX_STANDARD)
  if(NOT standard OR standard LESS 17)
    set_target_properties(lammps PROPERTIES CXX_STANDARD 17)
  endif()
  message(STATUS "LSDCD is compiled into LAMMPS ${version}")
endfunction()

lsdcd_add_core()
cmake_language(DEFER CALL lsdcd_join_lammps)
