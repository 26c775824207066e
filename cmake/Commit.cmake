# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# LSDCD_COMMIT: what is being built, for reports; as of the last configuring; empty: not known. `git archive` writes the
# commit of a source tarball here. A copy without .git has none, whatever checkout the folder around it is.
set(LSDCD_COMMIT "$Format:%H$")
if(LSDCD_COMMIT MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${LSDCD_COMMIT} 0 10 LSDCD_COMMIT)
  return()
endif()
set(LSDCD_COMMIT "")
if(EXISTS ${PROJECT_SOURCE_DIR}/.git)
  # A checkout of another user, as in a container, is built as any other.
  execute_process(COMMAND git -c safe.directory=${PROJECT_SOURCE_DIR} -C ${PROJECT_SOURCE_DIR} describe --always --dirty
    OUTPUT_VARIABLE LSDCD_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
