// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Warns of a timestep that does not resolve contacts.
#pragma once

#include "host/host.h"
#include "law/law_table.h"
#include "wall/spheres/host_spheres.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

class TimestepCheck {
 public:
  // Host and laws must outlive this object. `velocity_unit`: force times time over mass, in the host's unit of velocity.
  TimestepCheck(Host &host, const LawTable &laws, Real velocity_unit) :
      host_(host), laws_(laws), velocity_unit_(velocity_unit)
  {
  }

  // Sets the largest n.K n of Mobility of the mesh with this number, from 0; 0: the mesh does not give way.
  void set_mobility(int mesh, Real mobility);

  // Warns if `dt` (time) is more than a tenth of the shortest contact time of the spheres, and again if it is a tenth worse than what was
  // warned of. `s` is in memory of the CPU. Collective.
  void check(Real dt, const HostSpheres &s);

  // Returns the largest timestep warned of, over the longest that resolves a contact; 1: none.
  Real worst_ratio() const { return worst_ > 1 ? worst_ / kWorse : 1; }

 private:
  Real shortest_of(const Spheres &s, int i) const;
  Real mass_of(Real sphere, std::size_t law) const;

  Host &host_;
  const LawTable &laws_;
  Real velocity_unit_;
  std::vector<Real> mobility_;           // of meshes up to the last body
  static constexpr Real kWorse = 1.1;    // times a timestep that was warned of: warned of again
  Real worst_ = 1;                       // what is warned of next, over what it should be
};

}    // namespace lsdcd
