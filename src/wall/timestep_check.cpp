// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/timestep_check.h"

#include "base/input_words.h"
#include "law/contact_time.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

// Of sphere i with any mesh.
Real TimestepCheck::shortest_of(const Spheres &s, int i) const
{
  const LawTable &laws = settings_.laws;
  const int *kind_of_type = laws.kind_of_type.data();
  const SphereKinds kinds = {laws.kinds > 1 ? s.type : nullptr, kind_of_type,
                             static_cast<int>(laws.kind_of_type.size()) - 1};
  const int kind = kinds[i], n = static_cast<int>(settings_.meshes.size());
  Real shortest = INFINITY;
  for (int mesh = 0; mesh < (laws.is_empty() ? 1 : n); mesh++)
    shortest = std::min(shortest,
                        contact_time(settings_.law_of(mesh, kind), s.mass[i], s.radius[i], ftm2v_));
  return shortest;
}

void TimestepCheck::check(Real dt)
{
  const Spheres s = host_.spheres_on_cpu();
  Real shortest = INFINITY;
  for (int i = 0; i < s.n; i++)
    if (is_in_group(s, i)) shortest = std::min(shortest, shortest_of(s, i));
  shortest = -shortest;
  host_.max(&shortest, 1);
  shortest = -shortest;
  const Real ratio = dt / (shortest / kStepsPerContact);
  if (ratio <= worst_) return;
  worst_ = kWorse * ratio;
  host_.warn("timestep " + number_text(dt) + " is more than a tenth of the shortest contact time " +
             number_text(shortest) +
             (is_hertzian(settings_.law) ? " (hertz, at an overlap of 1 % of the radius)" : "") +
             ": contacts will not be resolved");
}

}    // namespace lsdcd
