// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What the fix writes to the log.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
#include "base/version.h"
#include "effects/effects.h"

#include "comm.h"
#include "update.h"

using namespace LAMMPS_NS;
using lsdcd::number_text;

// In the columns of the mesh report.
void FixWallLsdcd::log_creation() const
{
  if (comm->me) return;
  if (settings.brief) {
    std::string meshes;
    for (const MeshPart &m : parts)
      meshes +=
          "mesh " + m.settings.file + " of " + std::to_string(m.wall.report().facets) + " facets, ";
    log(with_fix_id(meshes + settings.law_name + ", " + engine->backend()));
    return;
  }
  const lsdcd::ContactLaw &l = settings.law;
  std::string t;
  for (const MeshPart &m : parts) {
    t += (t.empty() ? "" : "\n") + m.wall.mesh_text();
    const struct {
      const char *label;
      std::string text;
    } lines[] = {{"placement   ", m.settings.placement_tokens},
                 {"motion      ", m.motion.text(m.bounds(0))},
                 {"servo       ", m.settings.servo_tokens}};
    for (const auto &line : lines)
      if (!line.text.empty()) t += "\n  " + (line.label + line.text);
  }
  t = with_fix_id(t);
  if (!material.empty()) t += "\n" + material;
  t += "\n  contact     " + settings.law_name;
  if (l.is_classic())
    t += ", kn " + number_text(l.k_normal) + ", kt " + number_text(l.k_tangent) + ", gamman " +
         number_text(l.eta) + ", gammat " + number_text(l.gamma_tangent) + ", xmu " +
         number_text(l.mu) + (l.limit_damping ? ", limit_damping" : "");
  std::string effects, kept;
  for (const lsdcd::Effect &e : lsdcd::effects_of(engine_settings())) {
    effects += (effects.empty() ? "" : ", ") + e.name;
    if (e.bytes_per_contact > 0)
      kept += ", " + std::to_string(e.bytes_per_contact) + " for " + e.name;
  }
  t += "\n  effects     " + effects;
  t += "\n  per atom    ";
  if (history->is_kept())
    t += "8 bytes, and per contact " + std::to_string(sizeof(lsdcd::Spring)) +
         " for its spring and place" + kept + ", which move and restart with the atom";
  else
    t += "nothing stored, exchanged or restarted";
  if (settings.contacts)
    t += "; " + std::to_string(size_peratom_cols * sizeof(double)) + " bytes for contacts";
  t += "\n  search      ";
  if (settings.nearest > 0)
    t += "nearest " + std::to_string(settings.nearest);
  else
    t += "all that can touch";
  const char *const precisions[] = {"double", "mixed", "single"};
  const char *const sides[] = {"both", "in", "out"};
  t += std::string(", precision ") + precisions[static_cast<int>(settings.precision)];
  t += std::string("\n  corners     ") +
       (settings.corner == lsdcd::Corner::blend ? "blend" : "sum") + ", side " +
       sides[static_cast<int>(settings.side)];
  t += "\n  device      " + engine->backend();
  std::string why;
  if (new_engine == lsdcd::make_engine && settings.device == lsdcd::Device::automatic &&
      !lsdcd::cuda_available(&why))
    t += " (no CUDA: " + why + ")";
  t += std::string("\n  version     ") + lsdcd::version();
  log(t);
}

// A line where a grid takes long, each ten seconds; log() writes those of the first process.
std::function<void(const std::string &)> FixWallLsdcd::build_progress(const MeshPart &m) const
{
  constexpr double kSeconds = 10;
  return [this, name = of(m, ""), last = MPI_Wtime()](const std::string &text) mutable {
    if (MPI_Wtime() - last < kSeconds) return;
    last = MPI_Wtime();
    log(with_fix_id(name + text));
  };
}

// `old`: the cutoff before, 0 at first.
void FixWallLsdcd::log_build(const MeshPart &m, double old) const
{
  const lsdcd::SharedWall &wall = m.wall;
  if (!wall.cache_warning().empty()) warn(of(m, wall.cache_warning()));
  if (settings.brief) return;
  const bool again = old > 0;
  std::string t = with_fix_id(of(m, ""));
  if (!again)
    t += "grid for radius " + number_text(wall.cutoff()) + "\n" + wall.grid_text();
  else if (wall.cutoff() > old)
    t += "larger particles, grid rebuilt for radius " + number_text(wall.cutoff());
  else
    t += "the box has changed, grid rebuilt at step " + std::to_string(update->ntimestep) +
         " (more of these in this run are counted at its end)";
  if (!again && wall.shared().node_size() > 1)
    t += wall.shared().is_shared() ? "\n  one copy per node" : "\n  one copy per process";
  if (!wall.cache_text().empty()) t += "\n  " + wall.cache_text();
  const bool one_of_many = again && wall.cutoff() == old && box_rebuilds > 1;
  if (!one_of_many) log(t);
}
