// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "material/material_file.h"

#include "base/file_kind.h"
#include "base/input_error.h"
#include "base/shared_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace fs = std::filesystem;

namespace lsdcd {

namespace {

// "a.lsdcd, b.lsdcd"; empty where there is none.
std::string files_of(const fs::path &folder)
{
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto &entry : fs::directory_iterator(folder, failed))
    if (entry.path().extension() == ".lsdcd") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string &name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}    // namespace

std::string find_material_file(const std::string &file)
{
  std::error_code failed;
  if (fs::is_regular_file(file, failed)) return file;
  if (fs::exists(file, failed) && !fs::is_directory(file, failed))
    throw InputError("cannot read the material file '" + file + "': " + why_no_file(file) +
                     "; give the path of a file of text");
  std::string looked = "as given";
  if (fs::path(file).is_relative()) {
    for (const char *variable : {"LSDCD_POTENTIALS", "LAMMPS_POTENTIALS"}) {
      const char *folders = std::getenv(variable);
      if (!folders || !*folders) continue;
      looked += std::string(", in $") + variable;
      std::istringstream list(folders);
      for (std::string folder; std::getline(list, folder, ':');)
        if (!folder.empty() && fs::is_regular_file(fs::path(folder) / file, failed))
          return (fs::path(folder) / file).string();
    }
    fs::path folder = shared_folder();
    if (!folder.empty()) {
      folder /= "potentials";
      if (fs::is_regular_file(folder / file, failed)) return (folder / file).string();
      looked += ", in " + folder.string();
      const std::string files = files_of(folder);
      if (!files.empty()) looked += ", which has " + files;
    }
  }
  throw InputError("there is no material file '" + file + "' (looked " + looked +
                   "): give its path, or set LSDCD_POTENTIALS to its folder");
}

}    // namespace lsdcd
