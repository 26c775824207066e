# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Documents and examples; and packages for Debian, which `./run package` makes. All else is installed
# by the folder that it lies in.
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE CONTRIBUTING.md RELEASING.md ROADMAP.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT data)
install(FILES .github/SUPPORT.md .github/SECURITY.md .github/CODE_OF_CONDUCT.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/.github COMPONENT data)
install(DIRECTORY LICENSES DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT data)
install(DIRECTORY doc/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/doc COMPONENT data
  FILES_MATCHING PATTERN *.md PATTERN *.rst PATTERN *.png PATTERN *.svg PATTERN *.gif PATTERN *.webp
  PATTERN data EXCLUDE PATTERN html EXCLUDE PATTERN __pycache__ EXCLUDE)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT data
  PATTERN __pycache__ EXCLUDE PATTERN "log.*" EXCLUDE PATTERN "*.dump" EXCLUDE)

# What the pages link to beside one another: sources that they name, the tests of the hard cases, and the materials.
set(linked "")
foreach(page design hard_cases paper)
  file(READ ${PROJECT_SOURCE_DIR}/doc/${page}.md text)
  string(REGEX MATCHALL "\\.\\./(src|tests)/[a-z_0-9/]+\\.(cpp|h|py)" names "${text}")
  list(APPEND linked ${names})
endforeach()
list(TRANSFORM linked REPLACE "^.*\\.\\./" "")
list(REMOVE_DUPLICATES linked)
foreach(file ${linked})
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT data)
endforeach()
file(RELATIVE_PATH materials ${CMAKE_INSTALL_FULL_DOCDIR} ${CMAKE_INSTALL_FULL_DATADIR}/lsdcd/potentials)
install(CODE "file(CREATE_LINK ${materials}
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/potentials\" SYMBOLIC)" COMPONENT data)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The LSDCD developers <lsdcd@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL library dev python data)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian/drop_ldconfig.cmake)
# Each package has its own summary, the first line of its text.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")

string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
lsdcd_gzip(cmake/debian/changelog)

# lsdcd_package(component name section depends summary text)
macro(lsdcd_package component name section depends summary text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${text}")
  # Debian asks for these in every package.
  install(FILES cmake/debian/copyright ${PROJECT_BINARY_DIR}/made/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()
lsdcd_package(library liblsdcd${PROJECT_VERSION_MAJOR} libs ""
  "Distances from points to a triangle mesh"
  "Distances, closest points and sides of many points at once, and\ncollisions of rigid bodies with a wall. This is the\nlibrary that programs run with.")
lsdcd_package(dev liblsdcd-dev libdevel "liblsdcd${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION})"
  "Distances from points to a triangle mesh: headers"
  "The headers for C and C++, the CMake package and the\npkg-config file of liblsdcd.")
lsdcd_package(python python3-lsdcd python
  "liblsdcd${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION}), python3, python3-numpy"
  "Distances from points to a triangle mesh: Python module"
  "The module lsdcd calls liblsdcd with arrays of numpy.")
lsdcd_package(data lsdcd-data science ""
  "Materials, documents and examples of lsdcd"
  "Material files with cited values, the manual, and input\nscripts for DEM walls from meshes.")
# Which package others need that are linked with the library; and that the linker's cache is renewed.
set(control ${PROJECT_BINARY_DIR}/made/debian)
file(WRITE ${control}/shlibs
  "liblsdcd ${PROJECT_VERSION_MAJOR} liblsdcd${PROJECT_VERSION_MAJOR} (>= ${PROJECT_VERSION})\n")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst
  ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
if(TARGET lsdcd_tool)
  list(APPEND CPACK_COMPONENTS_ALL tool)
  # Python runs the plot's script, and the modules that make reports and films.
  lsdcd_package(tool lsdcd science "lsdcd-data (= ${PROJECT_VERSION}), python3:any"
    "Looks at meshes, grids and materials of DEM walls"
    "Inspects, repairs, converts and generates triangle meshes, finds\ndistances and collisions, measures what settings of a DEM wall cost,\nand makes reports and films of runs.")
  set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS "python3-matplotlib, python3-lsdcd, python3-pil")
endif()
if(TARGET lsdcdplugin)
  list(APPEND CPACK_COMPONENTS_ALL lammps)
  # For the LAMMPS that it was built for, and no other.
  set(host "")
  find_program(DPKG_QUERY dpkg-query)
  if(DPKG_QUERY)
    execute_process(COMMAND ${DPKG_QUERY} -W -f "\${source:Upstream-Version}" liblammps0
      OUTPUT_VARIABLE version ERROR_QUIET)
    if(version)
      set(host ", liblammps0 (>= ${version}), liblammps0 (<< ${version}.0~)")
    endif()
  endif()
  # LAMMPS starts MPI also where it runs alone, and Open MPI then starts a program of mpi-default-bin, on which no library depends.
  lsdcd_package(lammps lammps-lsdcd science "lsdcd-data (= ${PROJECT_VERSION}), mpi-default-bin${host}"
    "DEM walls from triangle meshes for LAMMPS"
    "The plugin with fix wall/lsdcd, fix massflow/lsdcd, fix insert/lsdcd,\ncompute lsdcd/collide, compute lsdcd/energy and compute lsdcd/impacts,\nand lmp-lsdcd, a LAMMPS that has them built in.")
endif()
include(CPack)
