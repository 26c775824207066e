# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# The LAMMPS that the plugin and the launcher are built for.
#   LSDCD_HOST_INCLUDE   its headers (an installed include/lammps or a source tree's src)
#   LSDCD_HOST_LIBRARY   its shared library, for the launcher only
#   LSDCD_HOST_VERSION   its version as a number, 20210929 for 29 Sep 2021
#   LSDCD_HOST_SIZES     LAMMPS_SMALLBIG, LAMMPS_BIGBIG or LAMMPS_SMALLSMALL
#   LSDCD_HOST_MPI       OFF for one that was built without MPI (BUILD_MPI=off); its headers then are a source
#                        tree's src, whose folder STUBS has LAMMPS's stand-in for mpi.h
#   MPI_CXX_COMPILER     the mpicxx of its MPI, if it is not the one in PATH: mpicxx.mpich
# What is not given is found; LSDCD_HAVE_HOST tells whether the plugin can be built.
set(LSDCD_HAVE_HOST OFF)
if(NOT LSDCD_LAMMPS)
  message(STATUS "LAMMPS plugin: no (LSDCD_LAMMPS is OFF)")
  return()
endif()

find_path(LSDCD_HOST_INCLUDE lammps.h PATH_SUFFIXES lammps DOC "LAMMPS headers")
find_library(LSDCD_HOST_LIBRARY lammps DOC "LAMMPS shared library")
option(LSDCD_HOST_MPI "The LAMMPS was built with MPI" ON)
if(LSDCD_HOST_MPI)
  find_package(MPI QUIET COMPONENTS CXX)
endif()

include(LammpsStyles)

# An installed package has its version and integer sizes in its CMake files, a
# source tree has its version in version.h. They hold against what a build folder keeps of another host.
if(LSDCD_HOST_INCLUDE AND EXISTS ${LSDCD_HOST_INCLUDE}/version.h)
  lsdcd_version_of(${LSDCD_HOST_INCLUDE}/version.h version)
  if(version)
    set(LSDCD_HOST_VERSION ${version} CACHE STRING "LAMMPS version as a number" FORCE)
  endif()
elseif(LSDCD_HOST_INCLUDE)
  get_filename_component(prefix ${LSDCD_HOST_INCLUDE} DIRECTORY)
  get_filename_component(prefix ${prefix} DIRECTORY)
  file(GLOB config ${prefix}/lib/cmake/LAMMPS ${prefix}/lib/*/cmake/LAMMPS ${prefix}/lib64/cmake/LAMMPS)
  foreach(dir ${config})
    file(STRINGS ${dir}/LAMMPSConfigVersion.cmake version REGEX "^set\\(PACKAGE_VERSION ")
    if(version MATCHES "\"([0-9]+)\"")                             # 20210929
      set(LSDCD_HOST_VERSION ${CMAKE_MATCH_1} CACHE STRING "LAMMPS version as a number" FORCE)
    elseif(version MATCHES "\"([0-9]+)[.]([0-9]+)[.]([0-9]+)")    # 2026.7.4.0
      math(EXPR version "${CMAKE_MATCH_1} * 10000 + ${CMAKE_MATCH_2} * 100 + ${CMAKE_MATCH_3}")
      set(LSDCD_HOST_VERSION ${version} CACHE STRING "LAMMPS version as a number" FORCE)
    endif()
    file(STRINGS ${dir}/LAMMPS_Targets.cmake sizes REGEX "INTERFACE_COMPILE_DEFINITIONS")
    if(sizes MATCHES "(LAMMPS_(SMALLBIG|BIGBIG|SMALLSMALL))")
      set(LSDCD_HOST_SIZES ${CMAKE_MATCH_1} CACHE STRING "LAMMPS integer sizes" FORCE)
    endif()
  endforeach()
endif()
set(LSDCD_HOST_SIZES LAMMPS_SMALLBIG CACHE STRING "LAMMPS integer sizes")

if(NOT LSDCD_HOST_INCLUDE)
  message(STATUS "LAMMPS plugin: no (headers not found; Debian: liblammps-dev)")
  return()
elseif(NOT LSDCD_HOST_VERSION)
  message(STATUS "LAMMPS plugin: no (version of ${LSDCD_HOST_INCLUDE} unknown; set LSDCD_HOST_VERSION)")
  return()
elseif(NOT LSDCD_HOST_MPI AND NOT EXISTS ${LSDCD_HOST_INCLUDE}/STUBS/mpi.h)
  message(STATUS "LAMMPS plugin: no (LSDCD_HOST_MPI is OFF and ${LSDCD_HOST_INCLUDE}/STUBS has no mpi.h: "
    "set LSDCD_HOST_INCLUDE to src of LAMMPS's sources)")
  return()
elseif(LSDCD_HOST_MPI AND NOT MPI_CXX_FOUND)
  message(STATUS "LAMMPS plugin: no (MPI not found; Debian: libopenmpi-dev)")
  return()
endif()

# A target to compile against a host: its headers and those of MPI, the version and integer sizes, and shims
# only for what its own headers lack. It links nothing: LAMMPS and MPI are in the program that opens a plugin.
# What follows are the folders of mpi.h, where it is not that of LSDCD_HOST_MPI.
function(lsdcd_host_target name include version sizes)
  add_library(${name} INTERFACE)
  set(mpi ${ARGN})
  if(NOT mpi AND LSDCD_HOST_MPI)
    set(mpi $<TARGET_PROPERTY:MPI::MPI_CXX,INTERFACE_INCLUDE_DIRECTORIES>)
  elseif(NOT mpi)
    set(mpi ${include}/STUBS)
  endif()
  foreach(shim fmt/format.h command.h safe_pointers.h)
    if(NOT EXISTS ${include}/${shim})
      string(REGEX REPLACE "[/.].*" "" folder ${shim})
      target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR}/cmake/compat/no_${folder})
    endif()
  endforeach()
  target_include_directories(${name} SYSTEM INTERFACE ${include})
  target_compile_definitions(${name} INTERFACE
    ${sizes} LSDCD_HOST_VERSION=${version} OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_include_directories(${name} SYSTEM INTERFACE ${mpi})
endfunction()
lsdcd_host_target(lsdcd_host ${LSDCD_HOST_INCLUDE} ${LSDCD_HOST_VERSION} ${LSDCD_HOST_SIZES})

set(LSDCD_HAVE_HOST ON)
message(STATUS "LAMMPS plugin: yes, for version ${LSDCD_HOST_VERSION} (${LSDCD_HOST_INCLUDE})")
