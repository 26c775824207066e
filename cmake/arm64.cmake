# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# A toolchain file for 64-bit Arm, by Debian's cross compiler; what is built runs in qemu.
#   cmake --toolchain cmake/arm64.cmake -D LSDCD_ARM64_ROOT=FOLDER ...
#   LSDCD_ARM64_ROOT   a folder with Debian's arm64 libraries, as `./run test arm64` unpacks them
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

# CMake reads this file again for each of its trials, and hands them what it is told to.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LSDCD_ARM64_ROOT)
set(CMAKE_FIND_ROOT_PATH ${LSDCD_ARM64_ROOT} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
