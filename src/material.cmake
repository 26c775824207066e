# Material files and what reads them; included from src/CMakeLists.txt.
target_sources(lsdcd_core PRIVATE material/material_file.cpp material/find_material_file.cpp
  material/material_units.cpp material/contact_moduli.cpp material/material_command.cpp
  material/fill_material.cpp)
target_link_libraries(lsdcd_core PRIVATE ${CMAKE_DL_LIBS})

# Where programs and plugin look for them, from where they are.
file(GLOB potentials CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/potentials/*.lsdcd)
foreach(file ${potentials})
  get_filename_component(name ${file} NAME)
  configure_file(${file} ${PROJECT_BINARY_DIR}/share/lsdcd/potentials/${name} COPYONLY)
endforeach()
