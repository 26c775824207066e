# Where things are installed: CMAKE_INSTALL_*DIR, below any prefix, and LSDCD_PYTHON_DIR.
if(CMAKE_LIBRARY_ARCHITECTURE AND EXISTS /etc/debian_version)
  # Debian looks here under /usr and /usr/local, CMake and pkg-config there under any prefix.
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Libraries")
endif()
include(GNUInstallDirs)
set(LSDCD_PYTHON_DIR lib/python3/dist-packages CACHE PATH "Python modules")
