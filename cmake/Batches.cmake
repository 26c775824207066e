# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Sources are compiled some at a time, as headers take most of the time to compile a source of some hundred lines.
set(LSDCD_BATCH 8 CACHE STRING "How many sources are compiled together, about, up to 8; 1: each alone, for who changes one often")
if(LSDCD_BATCH GREATER 8)    # sources of other modules have the same names for what is theirs alone
  message(FATAL_ERROR "LSDCD_BATCH is ${LSDCD_BATCH}: give 1 to 8")
endif()

# What runs seldom is compiled with little optimisation, which takes two thirds of the time.
set(LSDCD_COLD $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O1>)

# Under sanitizers what few tests run is compiled without optimisation, which takes a half to a third of the time. A release runs all of it.
set(LSDCD_SELDOM "")
if(LSDCD_SANITIZE AND NOT LSDCD_RELEASE)
  set(LSDCD_SELDOM -O0)
endif()

# lsdcd_seldom(TARGET NAME SOURCE): contact laws NAME that few tests run under sanitizers.
function(lsdcd_seldom target name source)
  if(LSDCD_SANITIZE AND name MATCHES "added|plastic|reaching|energy|impacts")
    set_property(SOURCE ${source} TARGET_DIRECTORY ${target} APPEND PROPERTY COMPILE_OPTIONS -O0)
  endif()
endfunction()

# lsdcd_batch(TARGET): its sources are compiled some at a time.
function(lsdcd_batch target)
  if(LSDCD_BATCH GREATER 1)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${LSDCD_BATCH})
  endif()
endfunction()

# lsdcd_batch_modules(TARGET COLD FOLDER...): its sources are compiled some at a time, those of one module or of small neighbours
# together, so that a new source changes the batches of its module alone. FOLDER: modules, and folders of modules, that are cold.
# Called where the target is made, with all its sources.
function(lsdcd_batch_modules target)
  cmake_parse_arguments(PARSE_ARGV 1 of "" "" "COLD")
  get_target_property(sources ${target} SOURCES)
  set(modules "")
  foreach(source ${sources})
    get_source_file_property(alone ${source} TARGET_DIRECTORY ${target} SKIP_UNITY_BUILD_INCLUSION)
    get_source_file_property(defined ${source} TARGET_DIRECTORY ${target} COMPILE_DEFINITIONS)
    if(alone OR defined OR NOT source MATCHES "[.]cpp$")
      continue()
    endif()
    file(RELATIVE_PATH folder ${CMAKE_CURRENT_SOURCE_DIR} ${source})
    get_filename_component(folder ${folder} DIRECTORY)
    string(REGEX REPLACE "/.*" "" module ${folder})
    set(is_cold OFF)
    if(module IN_LIST of_COLD OR folder IN_LIST of_COLD)
      set(is_cold ON)
      string(APPEND module _cold)
    endif()
    if(LSDCD_BATCH GREATER 1)
      list(APPEND modules ${module})
      list(APPEND sources_of_${module} ${source})
    elseif(is_cold)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS ${LSDCD_COLD})
    endif()
  endforeach()
  if(NOT LSDCD_BATCH GREATER 1)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  list(REMOVE_DUPLICATES modules)
  math(EXPR most "${LSDCD_BATCH} * 3 / 2")
  foreach(kind "" _cold)
    set(name "")
    set(batch "")
    foreach(module ${modules} end${kind})
      if((kind AND NOT module MATCHES "_cold$") OR (NOT kind AND module MATCHES "_cold$"))
        continue()
      endif()
      list(LENGTH batch n)
      list(LENGTH sources_of_${module} n_more)
      math(EXPR both "${n} + ${n_more}")
      if(batch AND (NOT n LESS LSDCD_BATCH OR both GREATER most OR module STREQUAL "end${kind}"))
        lsdcd_put_batches(${target} "${name}" "${batch}" "${kind}")
        set(batch "")
      endif()
      if(NOT batch)
        set(name ${module})
      endif()
      list(APPEND batch ${sources_of_${module}})
    endforeach()
  endforeach()
endfunction()

# Puts sources into batches of about the same size.
function(lsdcd_put_batches target name sources kind)
  list(LENGTH sources n)
  math(EXPR n_batches "(${n} + ${LSDCD_BATCH} / 2 - 1) / ${LSDCD_BATCH}")    # to the nearest
  if(n_batches EQUAL 0)
    set(n_batches 1)
  endif()
  foreach(k RANGE 1 ${n_batches})
    math(EXPR begin "(${k} - 1) * ${n} / ${n_batches}")
    math(EXPR size "${k} * ${n} / ${n_batches} - ${begin}")
    list(SUBLIST sources ${begin} ${size} batch)
    set_source_files_properties(${batch} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name}_${k})
    set(options "")
    if(kind)
      list(APPEND options ${LSDCD_COLD})
    endif()
    if(name MATCHES "^(box|clump|input|motion|output|query|wall)")    # not grids, steps, pairs and insertion, nor the meshes that all tests make
      list(APPEND options ${LSDCD_SELDOM})
    endif()
    if(options)
      set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/Unity/unity_${name}_${k}_cxx.cxx
        PROPERTIES COMPILE_OPTIONS "${options}")
    endif()
  endforeach()
endfunction()
