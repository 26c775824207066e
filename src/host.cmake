# Plugin and launcher; included from src/CMakeLists.txt where LAMMPS was found.

# The plugin for one host, with the sources of its entry point. LAMMPS itself is not
# linked: its symbols come from the host that loads the file. Only the entry point is
# exported. The file is never unmapped: threads that it started may outlive `plugin unload`.
function(lsdcd_plugin name host)
  set(sources plugin_styles.cpp fix_wall_lsdcd.cpp fix_wall_lsdcd_box.cpp fix_wall_lsdcd_checks.cpp
    fix_wall_lsdcd_exchange.cpp fix_wall_lsdcd_heat.cpp fix_wall_lsdcd_loads.cpp
    fix_wall_lsdcd_output.cpp
    fix_wall_lsdcd_tune.cpp node_wall.cpp node_wall_tune.cpp node_shared.cpp
    node_material.cpp)
  list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/src/)
  add_library(${name} MODULE ${sources} ${ARGN})
  target_link_libraries(${name} PRIVATE lsdcd_core ${host} ${CMAKE_DL_LIBS})
  target_link_options(${name} PRIVATE
    -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/plugin.map -Wl,-z,nodelete)
  set_target_properties(${name} PROPERTIES PREFIX ""
    LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/plugin.map)
endfunction()
lsdcd_plugin(lsdcdplugin lsdcd_host ${PROJECT_SOURCE_DIR}/src/lsdcdplugin.cpp)

include(KokkosHost)
set(LSDCD_KOKKOS_HOST "" CACHE PATH "Build folder of a LAMMPS with KOKKOS, for lsdcdkkplugin.so")
if(LSDCD_KOKKOS_HOST)
  lsdcd_kokkos_plugin(lsdcdkkplugin ${LSDCD_KOKKOS_HOST})
else()
  message(STATUS "Kokkos plugin: no (LSDCD_KOKKOS_HOST not set)")
endif()

if(LSDCD_HOST_LIBRARY)
  add_executable(lmp-lsdcd launcher/main.cpp launcher/plugins.cpp)
  target_link_libraries(lmp-lsdcd PRIVATE lsdcd_core lsdcd_host ${LSDCD_HOST_LIBRARY} ${CMAKE_DL_LIBS})
  # It replaces a function of the library, which must see it.
  set_target_properties(lmp-lsdcd PROPERTIES CXX_VISIBILITY_PRESET default ENABLE_EXPORTS ON)
  add_dependencies(lmp-lsdcd lsdcdplugin)
else()
  message(STATUS "Launcher lmp-lsdcd: no (liblammps not found)")
endif()
