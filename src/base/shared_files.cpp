// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/shared_files.h"

#include <dlfcn.h>

namespace fs = std::filesystem;

namespace lsdcd {

namespace {

// The folder of the plugin or program with this code; empty: not known.
fs::path own_folder()
{
  Dl_info info;
  std::error_code failed;
  fs::path own;
  // A program's own name may be the word of the command line, without a folder.
  if (dladdr(reinterpret_cast<const void *>(&shared_folder), &info) && info.dli_fname)
    own = info.dli_fname;
  if (!own.has_parent_path()) own = "/proc/self/exe";
  own = fs::canonical(own, failed);
  return failed ? fs::path() : own.parent_path();
}

}    // namespace

fs::path shared_folder()
{
  const fs::path own = own_folder();
  std::error_code failed;
  for (fs::path above = own; above.has_relative_path(); above = above.parent_path())
    if (fs::is_directory(above / "share" / "lsdcd", failed)) return above / "share" / "lsdcd";
  return own.empty() ? own : own.parent_path() / "share" / "lsdcd";
}

}    // namespace lsdcd
