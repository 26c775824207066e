# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# CPack gives a package with a library scripts that call ldconfig. Debian wants its trigger alone, which
# the package has, too. Run by CPack behind the making of packages.
find_program(DPKG_DEB dpkg-deb)
foreach(package ${CPACK_PACKAGE_FILES})
  if(NOT DPKG_DEB OR NOT package MATCHES "/liblsdcd[0-9]+_[^/]*[.]deb$")
    continue()
  endif()
  set(unpacked ${package}.unpacked)
  file(REMOVE_RECURSE ${unpacked})
  execute_process(COMMAND ${DPKG_DEB} -R ${package} ${unpacked} COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${unpacked}/DEBIAN/postinst ${unpacked}/DEBIAN/postrm)
  execute_process(COMMAND ${DPKG_DEB} --root-owner-group -b ${unpacked} ${package}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${unpacked})
endforeach()
