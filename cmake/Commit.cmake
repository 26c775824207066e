# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# LSDCD_COMMIT: what is being built, for reports; as of the last configuring. `git archive` writes the
# commit of a source tarball here.
set(LSDCD_COMMIT "$Format:%H$")
if(LSDCD_COMMIT MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${LSDCD_COMMIT} 0 10 LSDCD_COMMIT)
  return()
endif()
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} describe --always --dirty
  OUTPUT_VARIABLE LSDCD_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT LSDCD_COMMIT)
  set(LSDCD_COMMIT "unknown")
endif()
