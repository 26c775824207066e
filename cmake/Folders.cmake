# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Where things are installed: CMAKE_INSTALL_*DIR, below any prefix, and LSDCD_PYTHON_DIR.
if(CMAKE_LIBRARY_ARCHITECTURE AND EXISTS /etc/debian_version)
  # Debian looks here under /usr and /usr/local, CMake and pkg-config there under any prefix.
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Libraries")
endif()
include(GNUInstallDirs)
set(LSDCD_PYTHON_DIR lib/python3/dist-packages CACHE PATH "Python modules")

# lsdcd_gzip(FILE): made/FILE.gz in the build, with CMake's variables filled in; compressed as Debian wants
# man pages and changelogs.
function(lsdcd_gzip file)
  get_filename_component(name ${file} NAME)
  set(made ${PROJECT_BINARY_DIR}/made/${name})
  configure_file(${file} ${made} @ONLY)
  execute_process(COMMAND gzip -9nc ${made} OUTPUT_FILE ${made}.gz COMMAND_ERROR_IS_FATAL ANY)
endfunction()
