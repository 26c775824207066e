// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What the fix adds up of a wall's loads and wear: of all processes, and in restart files.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

using namespace LAMMPS_NS;
using lsdcd::WallLoads;

// Of restart data: format, kind of the springs, time of the run and number of meshes; and of
// each mesh: how many numbers of its motion, these; then time of the average, facets, edges and
// vertices of the mesh, number of rows of loads, fingerprint of the mesh, these rows.
static constexpr int kHeader = 6;
static constexpr double kFormat = -6;

// What fits a double, exactly.
static double number_of(std::uint64_t fingerprint)
{
  return double(fingerprint >> 11);
}

// Of the last step; what setup computes has no duration.
void FixWallLsdcd::add_loads()
{
  if (update->setupflag) return;
  const bool any = cutoff() > 0;
  for (const MeshPart &m : parts)
    loads->add(m.index, any ? engine->records() : nullptr, any ? engine->n_records() : 0,
               update->dt, any ? m.wall.view().wall : lsdcd::WallFeaturesView());
}

// On the first process. Collective.
void FixWallLsdcd::add_restart_data(const MeshPart &m, std::vector<double> &data) const
{
  const WallLoads all = loads->gathered(m.index);
  if (comm->me != 0) return;
  const lsdcd::MeshReport &r = m.wall.report();
  const std::vector<double> rows = all.packed();
  const std::vector<double> motion = m.motion.state();
  data.push_back(double(motion.size()));
  data.insert(data.end(), motion.begin(), motion.end());
  data.insert(data.end(),
              {all.time(), double(r.facets), double(r.edges), double(r.vertices),
               double(rows.size() / WallLoads::kPackedLoad), number_of(m.wall.mesh_fingerprint())});
  data.insert(data.end(), rows.begin(), rows.end());
}

void FixWallLsdcd::write_restart(FILE *file)
{
  std::vector<double> data = {kFormat, double(settings.law.history_kind()), double(run_clock.now()),
                              double(parts.size())};
  for (const MeshPart &m : parts) add_restart_data(m, data);
  if (comm->me != 0) return;
  const int bytes = static_cast<int>(data.size() * sizeof(double));
  fwrite(&bytes, sizeof bytes, 1, file);
  fwrite(data.data(), sizeof(double), data.size(), file);
}

// LAMMPS hands the same bytes to every process; the first one keeps the loads.
void FixWallLsdcd::restart(char *buffer)
{
  continued = true;
  wall_files->continue_lists();
  const auto take = [&buffer](double count) {
    std::vector<double> numbers(static_cast<std::size_t>(count));
    std::memcpy(numbers.data(), buffer, numbers.size() * sizeof(double));
    buffer += numbers.size() * sizeof(double);
    return numbers;
  };
  if (take(1)[0] != kFormat)
    fatal("the restart file was written by another version of this fix, whose data it cannot read: "
          "go on with that version, or give the fix another ID to begin without springs, motion, "
          "loads and wear");
  history->set_kind_of_file(take(1)[0]);
  run_clock.base = take(1)[0];
  const std::size_t there = static_cast<std::size_t>(take(1)[0]);
  for (std::size_t k = 0; k < std::min(there, parts.size()); k++) {
    const std::vector<double> motion = take(take(1)[0]), header = take(kHeader),
                              rows = take(header[4] * WallLoads::kPackedLoad);
    restart_part(parts[k], motion, header, rows, several() || there > 1);
  }
  if (there == parts.size()) return;
  const auto meshes = [](std::size_t n) {
    return std::to_string(n) + (n == 1 ? " mesh" : " meshes");
  };
  warn("the restart file was written with " + meshes(there) + " and this fix has " +
       std::to_string(parts.size()) + ": " +
       (there > parts.size() ? "springs, motion, loads and wear of those after mesh " +
                                   std::to_string(parts.size()) + " are not carried over"
                             : "those after mesh " + std::to_string(there) +
                                   " begin anew, without springs, motion, loads and wear"));
}

// `one_of_many`: springs tell which mesh they are of by its number alone.
void FixWallLsdcd::restart_part(MeshPart &m, const std::vector<double> &motion,
                                const std::vector<double> &header, const std::vector<double> &rows,
                                bool one_of_many)
{
  const lsdcd::MeshReport &r = m.wall.report();
  const bool other = header[1] != double(r.facets) || header[2] != double(r.edges) ||
                     header[3] != double(r.vertices) ||
                     header[5] != number_of(m.wall.mesh_fingerprint());
  m.springs_are_foreign = other;
  if (other && one_of_many) {
    warn(of(m, "springs, motion, loads and wear begin anew: the restart file was written with "
               "another mesh in this place"));
    return;
  }
  try {
    m.motion.restore(motion, step_now());
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }
  motion_has_changed(m);
  if (!settings.has_loads(m.settings)) return;
  if (other) {
    warn("loads and wear begin at zero: the restart file was written with another mesh");
    return;
  }
  loads->restore(m.index, header[0], rows);
}
