# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Warnings, ccache, sanitizers and the CUDA toolkit, found once for all targets.

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CUDA_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(lsdcd_options INTERFACE)
# No contraction: a fused multiply-add on one backend alone would let cell lists
# and forces differ between CPU and GPU in the last bits.
# A switch without a default has a case for each enumerator: where a new one is forgotten is an error.
target_compile_options(lsdcd_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Werror=switch -ffp-contract=off>)
# Tests of geometry are joined by & where a branch would cost more than the test; clang takes that for a slip.
target_compile_options(lsdcd_options INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-bitwise-instead-of-logical>)

# A null pointer ends the program under the address sanitizer, too: asking before each access would take a
# third of the compiler's time.
if(LSDCD_SANITIZE)
  target_compile_options(lsdcd_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=address,undefined
    -fno-sanitize=null -fno-sanitize-recover=all -fno-omit-frame-pointer>)
  target_link_options(lsdcd_options INTERFACE -fsanitize=address,undefined)
endif()

set(LSDCD_HAVE_CUDA OFF)
if(LSDCD_CUDA)
  include(CheckLanguage)
  if(NOT CMAKE_CUDA_COMPILER)
    find_program(NVCC nvcc HINTS $ENV{CUDA_HOME}/bin /usr/local/cuda/bin)
    if(NVCC)
      set(CMAKE_CUDA_COMPILER ${NVCC})
    endif()
  endif()
  # Code for the GPU that is here. Without one: code for compute capability 8.0 (A100), which 8.6 and 8.9
  # run, and PTX, of which the driver makes code for later ones at their first run.
  if(NOT CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
    file(GLOB gpus /dev/nvidia[0-9]*)
    if(gpus AND CMAKE_VERSION VERSION_GREATER_EQUAL 3.24)
      set(CMAKE_CUDA_ARCHITECTURES native)
    else()
      set(CMAKE_CUDA_ARCHITECTURES 80)
    endif()
  endif()
  check_language(CUDA)
  if(CMAKE_CUDA_COMPILER)
    enable_language(CUDA)
    set(CMAKE_CUDA_STANDARD 17)
    set(CMAKE_CUDA_STANDARD_REQUIRED ON)
    # CMake 3.25, that of Debian 12, does not know that nvcc has C++20, in which Kokkos 5 is written.
    if(NOT DEFINED CMAKE_CUDA20_STANDARD_COMPILE_OPTION AND CMAKE_CUDA_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
      set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION -std=c++20)
      set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION -std=c++20)
    endif()
    set(LSDCD_HAVE_CUDA ON)
    target_compile_options(lsdcd_options INTERFACE
      $<$<COMPILE_LANGUAGE:CUDA>:--fmad=false --extended-lambda -Xcompiler=-Wall,-Wextra,-ffp-contract=off>)
    # A test reads the sizes of kernels from the compiled files.
    if(LSDCD_TESTS AND CMAKE_CUDA_COMPILER_VERSION VERSION_GREATER_EQUAL 12.8)
      target_compile_options(lsdcd_options INTERFACE
        $<$<COMPILE_LANGUAGE:CUDA>:--compress-mode=none>)
    endif()
    message(STATUS "CUDA engine: yes, nvcc ${CMAKE_CUDA_COMPILER_VERSION}, code for ${CMAKE_CUDA_ARCHITECTURES}")
  endif()
endif()
if(NOT LSDCD_HAVE_CUDA)
  message(STATUS "CUDA engine: no (CPU only)")
endif()
