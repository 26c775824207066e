# LSDCD_COMMIT: what is being built, for reports; as of the last configuring.
execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} describe --always --dirty
  OUTPUT_VARIABLE LSDCD_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT LSDCD_COMMIT)
  set(LSDCD_COMMIT "unknown")
endif()
