# What effects cost; included from src/CMakeLists.txt.
target_sources(lsdcd_core PRIVATE effects/effect_cases.cpp effects/effects_of.cpp
  effects/kept_costs.cpp effects/measure_effects.cpp)
target_include_directories(lsdcd_core PRIVATE ${PROJECT_BINARY_DIR}/made)

# Costs measured on the CPU, as `lsdcd effects` and the fix's log show them.
set(kept ${PROJECT_SOURCE_DIR}/doc/data/effects_cpu.csv)
set(LSDCD_EFFECTS_MEASURED "")
if(EXISTS ${kept})
  file(READ ${kept} LSDCD_EFFECTS_MEASURED)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${kept})
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/made/effects_measured.h @ONLY CONTENT
"// Made from doc/data/effects_cpu.csv.
#pragma once
namespace lsdcd {
constexpr char kEffectsMeasured[] = R\"csv(@LSDCD_EFFECTS_MEASURED@)csv\";
}
")
