# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# lsdcdkkplugin.so: the plugin for a LAMMPS with the KOKKOS package.
#   LSDCD_KOKKOS_HOST   the build folder of that LAMMPS, or a folder with a host.cmake as
#                       tests/lammps/hosts/build_host.sh leaves one

# Sets in the caller what a host.cmake sets, from the command that compiles a source of the package KOKKOS in a LAMMPS build.
function(lsdcd_read_lammps_build build)
  set(source src/KOKKOS/atom_kokkos.cpp)
  file(STRINGS ${build}/compile_commands.json lines REGEX "^ *\"(command|file)\": .*/${source}\"")
  list(TRANSFORM lines REPLACE ",$" "")
  list(JOIN lines "," entry)
  string(JSON command ERROR_VARIABLE none GET "{${entry}}" command)
  string(JSON file ERROR_VARIABLE none GET "{${entry}}" file)
  if(none)
    return()
  endif()
  separate_arguments(words UNIX_COMMAND "${command}")
  set(includes "")
  set(definitions "")
  set(before "")
  foreach(word ${words})
    if(before STREQUAL "-isystem")
      list(APPEND includes ${word})
    elseif(word MATCHES "^-I(.+)")
      list(APPEND includes ${CMAKE_MATCH_1})
    elseif(word MATCHES "^-D((LMP_KOKKOS|LAMMPS_(SMALL|BIG)|KOKKOS_).*)")
      list(APPEND definitions ${CMAKE_MATCH_1})
    endif()
    set(before ${word})
  endforeach()
  string(REPLACE /KOKKOS/atom_kokkos.cpp "" folder ${file})
  lsdcd_version_of(${folder}/version.h number)
  set(LSDCD_HOST_SOURCE ${folder} PARENT_SCOPE)
  set(LSDCD_HOST_VERSION ${number} PARENT_SCOPE)
  set(LSDCD_HOST_SIZES "" PARENT_SCOPE)    # among the definitions
  set(LSDCD_HOST_KOKKOS_INCLUDES ${includes} PARENT_SCOPE)
  set(LSDCD_HOST_KOKKOS_DEFINITIONS ${definitions} PARENT_SCOPE)
endfunction()

function(lsdcd_kokkos_plugin name folder)
  set(LSDCD_HOST_SIZES LAMMPS_SMALLBIG)
  set(LSDCD_HOST_SOURCE ${folder}/src)
  set(LSDCD_HOST_KOKKOS_STANDARD 17)
  if(EXISTS ${folder}/host.cmake)
    include(${folder}/host.cmake)
  elseif(EXISTS ${folder}/compile_commands.json)
    lsdcd_read_lammps_build(${folder})
  else()
    message(STATUS "Kokkos plugin ${name}: no (${folder} has neither host.cmake nor compile_commands.json, which "
      "cmake -D CMAKE_EXPORT_COMPILE_COMMANDS=ON ${folder} writes)")
    return()
  endif()
  unset(kokkos_headers)
  find_path(kokkos_headers KokkosCore_config.h PATHS ${LSDCD_HOST_KOKKOS_INCLUDES} NO_DEFAULT_PATH NO_CACHE)
  if(NOT kokkos_headers OR NOT EXISTS ${LSDCD_HOST_SOURCE}/KOKKOS/kokkos_type.h)
    message(STATUS "Kokkos plugin ${name}: no (no KOKKOS package or no Kokkos headers in ${folder})")
    return()
  endif()

  if(LSDCD_HOST_VERSION LESS 20230802)
    message(STATUS "Kokkos plugin ${name}: no (${folder} is LAMMPS ${LSDCD_HOST_VERSION}, and fixes for Kokkos need 2Aug2023 or later)")
    return()
  endif()

  set(kokkos ${PROJECT_SOURCE_DIR}/kokkos)
  set(sources ${kokkos}/lsdcdkkplugin.cpp ${kokkos}/fix_massflow_lsdcd_kokkos.cpp
    ${kokkos}/fix_wall_lsdcd_kokkos.cpp ${kokkos}/fix_wall_lsdcd_kokkos_exchange.cpp)
  file(STRINGS ${kokkos_headers}/KokkosCore_config.h facts REGEX
    "^#define KOKKOS_ENABLE_(OPENMP|CUDA|HIP|SYCL|OPENMPTARGET|OPENACC|CXX20)$")
  if(facts MATCHES "HIP|SYCL|OPENMPTARGET|OPENACC")
    message(STATUS "Kokkos plugin ${name}: no (its Kokkos is for a GPU that is not NVIDIA's)")
    return()
  endif()
  if(facts MATCHES "CXX20" AND LSDCD_HOST_KOKKOS_STANDARD LESS 20)
    set(LSDCD_HOST_KOKKOS_STANDARD 20)
  endif()
  # Each takes long by itself, and they compile side by side. g++ 12 warns of kernels: it loses count of Kokkos's shared
  # pointers.
  set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS
    "$<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>:-Wno-use-after-free>")
  set(language CXX)
  set(backend serial)    # in LAMMPS's words
  if(facts MATCHES "OPENMP(;|$)")
    set(backend openmp)
  endif()
  if(facts MATCHES "CUDA")
    if(NOT LSDCD_HAVE_CUDA)
      message(STATUS "Kokkos plugin ${name}: no (its Kokkos is for CUDA and no nvcc was found)")
      return()
    endif()
    set(language CUDA)
    set(backend cuda)
    set_source_files_properties(${sources} PROPERTIES LANGUAGE CUDA)
  endif()

  lsdcd_host_target(${name}_host ${LSDCD_HOST_SOURCE} ${LSDCD_HOST_VERSION} "${LSDCD_HOST_SIZES}")
  target_include_directories(${name}_host SYSTEM INTERFACE ${LSDCD_HOST_KOKKOS_INCLUDES})
  target_compile_definitions(${name}_host INTERFACE ${LSDCD_HOST_KOKKOS_DEFINITIONS})
  lsdcd_plugin(${name} ${name}_host ${sources})
  target_compile_definitions(${name} PRIVATE LSDCD_KOKKOS_BACKEND="${backend}")
  target_include_directories(${name}-styles PRIVATE ${PROJECT_SOURCE_DIR}/kokkos ${PROJECT_SOURCE_DIR}/src)
  set_target_properties(${name}-styles PROPERTIES ${language}_STANDARD ${LSDCD_HOST_KOKKOS_STANDARD}
    CXX_STANDARD ${LSDCD_HOST_KOKKOS_STANDARD} CUDA_RUNTIME_LIBRARY Static)
  message(STATUS "Kokkos plugin ${name}: yes, for version ${LSDCD_HOST_VERSION}, ${language}")
endfunction()
