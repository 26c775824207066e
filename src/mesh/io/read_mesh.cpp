// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/io/read_mesh.h"

#include "base/input_error.h"

#include <algorithm>

namespace lsdcd {

// The readers beside read_stl(), each in the file of its name. They throw InputError that names the
// file, the location in it, the value and the remedy.
ReadMesh read_obj(const std::string &path);
ReadMesh read_off(const std::string &path);
ReadMesh read_ply(const std::string &path);

namespace {

ReadMesh read_stl_mesh(const std::string &path)
{
  return {read_stl(path), 0, {}};
}

struct Format {
  const char *ending;
  ReadMesh (*read)(const std::string &path);
};

const Format kFormats[] = {
    {".stl", read_stl_mesh},
    {".obj", read_obj},
    {".ply", read_ply},
    {".off", read_off},
};

std::string all_endings()
{
  std::string all;
  for (const Format &f : kFormats) all += (all.empty() ? "" : ", ") + std::string(f.ending);
  return all;
}

}    // namespace

std::string name_ending(const std::string &path)
{
  std::string ending = path.substr(std::min(path.size(), path.rfind('.')));
  for (char &c : ending)
    if (c >= 'A' && c <= 'Z') c += 'a' - 'A';
  return ending;
}

ReadMesh read_mesh(const std::string &path)
{
  const std::string ending = name_ending(path);
  for (const Format &f : kFormats)
    if (ending == f.ending) return f.read(path);
  try {
    return read_stl_mesh(path);
  } catch (const InputError &e) {
    throw InputError(std::string(e.what()) +
                     " (it was read as STL, because its name does not end with one of " +
                     all_endings() + ")");
  }
}

}    // namespace lsdcd
