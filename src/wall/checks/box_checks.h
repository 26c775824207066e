// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Errors and warnings where a wall's meshes do not fit the box of the simulation.
#pragma once

#include "wall/part/mesh_part.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace lsdcd {

// `box` is that of the simulation in this step, `cutoff` (length) the largest distance of a contact.
// Errors are InputError, the same on all processes. Warnings of a mesh are shown once.
class BoxChecks {
 public:
  // All arguments must outlive this object.
  BoxChecks(Host &host, const WallSpec &settings, const std::deque<MeshPart> &meshes) :
      host_(host), settings_(settings), meshes_(meshes), warned_(settings.meshes.size())
  {
  }

  // The following functions are called before the first grid is built.

  // Warns of a mesh that is far larger than the box: its file is probably in different units.
  void check_scale(const MeshPart &m, const PeriodicBox &box) const;
  // Warns if periodic images act inside the box, for which the mesh may not have been drawn.
  void check_periodic(const MeshPart &m, const PeriodicBox &box) const;
  // Warns if the largest sphere, of this radius, is wider than the box; else of each mesh that is smaller than the sphere.
  void check_radius(const PeriodicBox &box, Real radius) const;
  // Throws if a mesh at rest is outside of the box.
  void check_outside(const MeshPart &m, const PeriodicBox &box, Real cutoff) const;

  // The following functions are called after a grid was built.

  // Throws if no sphere in the box can touch the mesh; if the box follows spheres, only warns of it.
  void check_within_cutoff(const MeshPart &m, const PeriodicBox &box);
  // Warns of ends of a mesh that do not meet across a periodic face. Throws if they met before the box changed.
  void check_ends(const MeshPart &m, bool box_changed);

  // The following functions are called in each step in which something moves, or the box may. `placed`: the meshes that move or were moved.

  // Throws if a mesh comes to a periodic face and its images would not move as it does. In the step that sets a run up this function looks
  // ahead over the longest period, and warns of a mesh that will turn out of the box through a fixed face. Collective.
  void check_moving(const std::vector<MeshPart *> &placed, const PeriodicBox &box, Real cutoff,
                    const Step &now);
  // Warns of a mesh that has moved out of the box.
  void check_gone(const std::vector<MeshPart *> &placed, const PeriodicBox &box, Real cutoff,
                  std::int64_t step);

 private:
  std::string named(const MeshPart &m, const std::string &text) const;
  void check_small(const MeshPart &m, const PeriodicBox &box, Real radius) const;
  void check_pose(const MeshPart &m, const Pose &at, const PeriodicBox &box, Real cutoff,
                  const std::string &when);
  bool is_still_clear(const MeshPart &m, const Pose &at, const PeriodicBox &box, int k,
                      Real depth) const;
  void look_ahead(const MeshPart &m, const PeriodicBox &box, Real cutoff);

  // A pose and a box in which all vertices of a mesh were farther than `depth` (fraction of the box) from both faces that edge k joins, by
  // `clear` (length) more.
  struct Clear {
    Pose at;
    PeriodicBox box;
    Real depth = 0, clear = 0;
  };

  // Checks that were made of a mesh.
  struct Warned {
    bool out_of_reach_warned = false, ends_warned = false;
    bool was_in_box = false, gone_warned = false, turning_out_warned = false;
    Clear clear[3];
  };

  Host &host_;
  const WallSpec &settings_;
  const std::deque<MeshPart> &meshes_;
  std::vector<Warned> warned_;
};

}    // namespace lsdcd
