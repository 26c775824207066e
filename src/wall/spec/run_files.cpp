// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spec/run_files.h"

#include "base/input_error.h"
#include "output/file_series.h"

#include <cstddef>
#include <cstdlib>
#include <filesystem>

namespace lsdcd {

std::vector<RunFile> files_of(const WallSpec &settings)
{
  std::vector<RunFile> files;
  for (const MeshSpec &m : settings.meshes) {
    if (!m.file.empty()) files.push_back({"mesh", m.file});
    for (const MotionTerm &term : m.motion.terms())
      if (!term.table_file.empty()) files.push_back({"motion table", term.table_file});
    if (m.fields.every > 0) files.push_back({"mesh_fields", m.fields.name, m.fields.every, true});
    if (m.fields.every > 0 && m.fields.name.find('*') != std::string::npos)
      files.push_back({"list of mesh_fields", FileSeries(m.fields.name).path(), 0, true});
    if (m.spectrum.every > 0)
      files.push_back({"impact_spectrum", m.spectrum.name, m.spectrum.every, true});
    if (m.stl.every > 0) files.push_back({"mesh_stl", m.stl.name, m.stl.every, true});
    if (!m.cache_file.empty()) files.push_back({"cache", m.cache_file, 0, true});
  }
  return files;
}

namespace {

std::string with_plain_folder(const std::string &path)
{
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(path, failed),
                              folder =
                                  std::filesystem::weakly_canonical(whole.parent_path(), failed);
  return failed ? path : (folder / whole.filename()).string();
}

// Is `name` the file of a series in a later step?
bool will_be(const std::string &series, int every, const std::string &name, long long now)
{
  const std::size_t star = series.find('*');
  if (every == 0 || star == std::string::npos || name.size() < series.size()) return false;
  const std::size_t after = series.size() - star - 1, digits = name.size() - star - after;
  if (name.compare(0, star, series, 0, star) != 0 ||
      name.compare(star + digits, after, series, star + 1, after) != 0)
    return false;
  const std::string number = name.substr(star, digits);
  const long long step = std::strtoll(number.c_str(), nullptr, 10);
  return std::to_string(step) == number && step > now && step % every == 0;
}

}    // namespace

bool are_one_file(const RunFile &a, const RunFile &b, long long now)
{
  const std::string one = with_plain_folder(a.name), other = with_plain_folder(b.name);
  return one == other || will_be(one, a.every, other, now) || will_be(other, b.every, one, now);
}

void check_apart(const RunFile &file, const RunFile &other, const std::string &owner, long long now)
{
  if (!file.written || (file.what == "cache" && !other.written) || !are_one_file(file, other, now))
    return;
  throw InputError("in '" + file.what + "', '" + file.name + "' is " +
                   (file.name == other.name ? "" : "'" + other.name + "', ") + "the " +
                   (other.what == "file" ? "" : other.what + " ") + "file that " + owner +
                   (other.written ? " writes" : " reads") + ": name another file");
}

void check_apart(const std::vector<RunFile> &files, const std::string &owner, long long now)
{
  for (std::size_t i = 0; i < files.size(); i++)
    for (std::size_t k = 0; k < files.size(); k++)
      if (i != k) check_apart(files[i], files[k], owner, now);
}

}    // namespace lsdcd
