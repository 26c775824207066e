// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_make and lsdcd_wall_change: the words of a script. No other file of this room knows words.
#include "input/wall_command.h"

#include "api/wall_handle.h"
#include "input/wall_change.h"

#include <string>
#include <vector>

using namespace lsdcd;

namespace {

std::vector<std::string> words_of(const char *const *words, std::size_t n)
{
  if (n > 0) need(words, "words");
  std::vector<std::string> all;
  for (std::size_t i = 0; i < n; i++) {
    need(words[i], "words[i]");
    all.push_back(words[i]);
  }
  return all;
}

// A word too few would be read past the end.
void need_words(const std::vector<std::string> &words, const char *what)
{
  if (words.empty())
    throw ApiError(LSDCD_ERROR_ARGUMENT, std::string("there are no words: ") + what);
}

// Groups of atoms are LAMMPS's.
WallSpec without_groups(WallSpec wall)
{
  for (const MeshSpec &mesh : wall.meshes)
    if (mesh.has_nodes)
      throw InputError("nodes " + mesh.node_group +
                       ": a program has no groups of atoms; make the "
                       "wall by lsdcd_wall_from_spec(), set nodes_by_caller, and call "
                       "lsdcd_wall_set_nodes()");
  return wall;
}

}    // namespace

extern "C" {

int lsdcd_wall_make(const char *const *words, size_t n, const lsdcd_wall_options *options,
                    lsdcd_wall **wall)
{
  return guard([&] {
    need(wall, "wall");
    std::vector<std::string> all = words_of(words, n);
    need_words(all, "a contact style, its numbers and `mesh FILE` make a wall");
    *wall = new_wall(options, [&](lsdcd_wall &made, const lsdcd_wall_options &o) {
      std::string report;
      const auto laws = [&](const WallMaterials &materials,
                            const std::vector<MaterialPair> &pairs) {
        return read_laws(made.caller, materials, pairs, o.units ? o.units : "si", report);
      };
      return std::make_unique<Wall>(made.caller, without_groups(parse_wall(all, laws).wall),
                                    WallUnits(), backend_of(o, made), report,
                                    StepClock{o.time, 0, 0, 0});
    });
  });
}

int lsdcd_wall_change(lsdcd_wall *wall, const char *const *words, size_t n)
{
  return guard_wall(wall, [&] {
    const std::vector<std::string> all = words_of(words, n);
    need_words(all, "[mesh K] motion ..., [mesh K] servo ... or [mesh K] body ...");
    note_late(*wall);    // of an engine that another motion may replace
    const int taken = change_wall(*wall->in, all, {wall->number, wall->dt});
    if (static_cast<std::size_t>(taken) != all.size())
      throw ApiError(LSDCD_ERROR_ARGUMENT, "'" + all[taken] +
                                               "' is not a word of [mesh K] motion ..., [mesh K] "
                                               "servo ... or [mesh K] body ...");
  });
}
}
