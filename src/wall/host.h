// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall asks of the program that it is part of.
#pragma once

#include "engine/wall_engine.h"
#include "host/host.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

// The spheres that a wall acts on, as messages name them.
struct SphereGroup {
  std::string name;
  bool changes = false;    // spheres may join and leave it between steps
};

inline bool is_in_group(const Spheres &s, int i)
{
  return !s.mask || (s.mask[i] & s.group_bit);
}

class WallHost : public virtual Host {
 public:
  // Values of the program's variables with these names in this step, in this order: finite, and the
  // same on all processes. Throws InputError where there is no such variable or number.
  virtual std::vector<Real> variables(const std::vector<std::string> &names) = 0;
  // Throws InputError where a variable with one of these names is missing.
  virtual void check_variables(const std::vector<std::string> &names) = 0;

  // Of this process alone. Spheres are counted from 0, in the order of the last step.

  virtual SphereGroup group() const = 0;    // the same on all processes
  // The spheres of this process as they are now: places, radii, masses and group, in memory of the CPU.
  virtual Spheres spheres_on_cpu() = 0;
  // How far one of them is past a periodic face of the box, at most; length.
  virtual Real farthest_past(const PeriodicBox &box)
  {
    const Spheres s = spheres_on_cpu();
    const PeriodicFaces faces = periodic_faces(box);
    Real past = 0;
    for (int i = 0; i < s.n; i++)
      if (is_in_group(s, i)) past = std::max(past, faces.past(s.x[i]));
    return past;
  }
  virtual std::int64_t tag(int sphere) = 0;            // the ID of a sphere; 0: spheres have none
  virtual std::int64_t highest_tag() = 0;              // of its spheres; 0: none, or no IDs
  virtual Real radius_of_tag(std::int64_t tag) = 0;    // length; 0: this process has no such sphere
};

}    // namespace lsdcd
