# The grid cache, where its libraries are; included from src/CMakeLists.txt.

set(LSDCD_HAVE_CACHE OFF)
find_path(LSDCD_ZSTD_INCLUDE zstd.h DOC "zstd headers")
find_library(LSDCD_ZSTD_LIBRARY zstd DOC "zstd library")
find_path(LSDCD_XXHASH_INCLUDE xxhash.h DOC "xxHash headers, 0.8 or later")
find_library(LSDCD_XXHASH_LIBRARY xxhash DOC "xxHash library")
set(missing "")
if(NOT LSDCD_CACHE)
  list(APPEND missing "LSDCD_CACHE is OFF")
endif()
if(NOT LSDCD_ZSTD_INCLUDE OR NOT LSDCD_ZSTD_LIBRARY)
  list(APPEND missing "zstd not found, Debian: libzstd-dev")
endif()
if(NOT LSDCD_XXHASH_INCLUDE OR NOT LSDCD_XXHASH_LIBRARY)
  list(APPEND missing "xxHash not found, Debian: libxxhash-dev")
endif()
if(missing)
  list(JOIN missing "; " missing)
  message(STATUS "Grid cache: no (${missing}); 'cache FILE' will be refused")
  target_sources(lsdcd_core PRIVATE grid/no_grid_cache.cpp)
  return()
endif()

# Whatever a grid is made by.
file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
  base/*.h mesh/*.h mesh/*.cpp grid/*.h grid/*.cpp grid/*.cu contact/piece_distance.h engine/backend_*.h)
list(SORT sources)
list(JOIN sources "," listed)
set(header ${CMAKE_CURRENT_BINARY_DIR}/made/lsdcd_grid_sources.h)
add_custom_command(OUTPUT ${header}
  COMMAND ${CMAKE_COMMAND} -D ROOT=${CMAKE_CURRENT_SOURCE_DIR} -D SOURCES=${listed} -D OUT=${header}
    -P ${PROJECT_SOURCE_DIR}/cmake/HashSources.cmake
  DEPENDS ${sources} ${PROJECT_SOURCE_DIR}/cmake/HashSources.cmake VERBATIM)

target_sources(lsdcd_core PRIVATE grid/grid_cache.cpp grid/grid_key.cpp ${header})
target_include_directories(lsdcd_core PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/made
  ${LSDCD_ZSTD_INCLUDE} ${LSDCD_XXHASH_INCLUDE})
target_link_libraries(lsdcd_core PRIVATE ${LSDCD_ZSTD_LIBRARY} ${LSDCD_XXHASH_LIBRARY})
set(LSDCD_HAVE_CACHE ON)
set(LSDCD_HAVE_CACHE ON PARENT_SCOPE)    # the tests ask
message(STATUS "Grid cache: yes")
