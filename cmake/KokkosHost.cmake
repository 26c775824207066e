# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# lsdcdkkplugin.so: the plugin for a LAMMPS with the KOKKOS package.
#   LSDCD_KOKKOS_HOST   the build folder of that LAMMPS, or a folder with a host.cmake as
#                       tests/lammps/hosts/build_host.sh leaves one

# Sets in the caller what a host.cmake sets, from what a LAMMPS build compiles with.
function(lsdcd_read_lammps_build build)
  if(EXISTS ${build}/build.ninja)
    file(STRINGS ${build}/build.ninja flags REGEX "^  (INCLUDES|DEFINES) = .*KOKKOS")
  else()
    file(STRINGS ${build}/CMakeFiles/lammps.dir/flags.make flags REGEX "^[A-Z]+_(INCLUDES|DEFINES) = .*KOKKOS")
  endif()
  set(includes "")
  set(definitions "")
  foreach(line ${flags})
    if(line MATCHES "INCLUDES = " AND NOT includes)
      string(REGEX MATCHALL "-(I|isystem )[^ ]+" includes "${line}")
      list(TRANSFORM includes REPLACE "^-(I|isystem )" "")
    elseif(line MATCHES "DEFINES = " AND NOT definitions)
      string(REGEX MATCHALL "-D[^ ]+" definitions "${line}")
      list(TRANSFORM definitions REPLACE "^-D" "")
      list(FILTER definitions INCLUDE REGEX "^(LMP_KOKKOS|LAMMPS_(SMALL|BIG)|KOKKOS_)")
    endif()
  endforeach()
  file(STRINGS ${build}/CMakeCache.txt cmake REGEX "^CMAKE_HOME_DIRECTORY:")
  string(REGEX REPLACE ".*=(.*)/[^/]*$" "\\1" lammps "${cmake}")
  lsdcd_version_of(${lammps}/src/version.h number)
  set(LSDCD_HOST_SOURCE ${lammps}/src PARENT_SCOPE)
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
  elseif(EXISTS ${folder}/CMakeCache.txt)
    lsdcd_read_lammps_build(${folder})
  else()
    message(STATUS "Kokkos plugin ${name}: no (${folder} has neither CMakeCache.txt nor host.cmake)")
    return()
  endif()
  unset(kokkos_headers)
  find_path(kokkos_headers KokkosCore_config.h PATHS ${LSDCD_HOST_KOKKOS_INCLUDES} NO_DEFAULT_PATH NO_CACHE)
  if(NOT kokkos_headers OR NOT EXISTS ${LSDCD_HOST_SOURCE}/KOKKOS/kokkos_type.h)
    message(STATUS "Kokkos plugin ${name}: no (no KOKKOS package or no Kokkos headers in ${folder})")
    return()
  endif()

  set(kokkos ${PROJECT_SOURCE_DIR}/kokkos)
  set(sources ${kokkos}/lsdcdkkplugin.cpp ${kokkos}/fix_wall_lsdcd_kokkos.cpp
    ${kokkos}/fix_wall_lsdcd_kokkos_exchange.cpp)
  file(STRINGS ${kokkos_headers}/KokkosCore_config.h facts REGEX
    "^#define KOKKOS_ENABLE_(OPENMP|CUDA|HIP|SYCL|OPENMPTARGET|OPENACC|CXX20)$")
  if(facts MATCHES "HIP|SYCL|OPENMPTARGET|OPENACC")
    message(STATUS "Kokkos plugin ${name}: no (its Kokkos is for a GPU that is not NVIDIA's)")
    return()
  endif()
  if(facts MATCHES "CXX20" AND LSDCD_HOST_KOKKOS_STANDARD LESS 20)
    set(LSDCD_HOST_KOKKOS_STANDARD 20)
  elseif(LSDCD_HOST_KOKKOS_STANDARD LESS 17)
    set(LSDCD_HOST_KOKKOS_STANDARD 17)
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
