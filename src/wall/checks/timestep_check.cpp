// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/timestep_check.h"

#include "base/input_words.h"
#include "law/contact_time.h"
#include "shape/superellipsoid.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

void TimestepCheck::set_mobility(int mesh, Real mobility)
{
  if (mobility == 0 && static_cast<std::size_t>(mesh) >= mobility_.size()) return;
  mobility_.resize(std::max(mobility_.size(), static_cast<std::size_t>(mesh) + 1));
  mobility_[mesh] = mobility;
}

// The mass that damping sees of a sphere and what it touches with a law of the table.
Real TimestepCheck::mass_of(Real sphere, std::size_t law) const
{
  if (mobility_.empty()) return sphere;
  const std::size_t mesh = law / static_cast<std::size_t>(laws_.kinds);
  const Real mobility = laws_.laws.size() == 1
                            ? *std::max_element(mobility_.begin(), mobility_.end())
                        : mesh < mobility_.size() ? mobility_[mesh]
                                                  : 0;
  return 1 / (1 / sphere + mobility);
}

// Returns the square of the largest arm about one axis of a grain: exact for an ellipse, where the farthest point is a half-axis,
// and a bound for others. `across`, `along`: the half-axes of the grain's shadow along the axis.
static Real arm_squared(Real across, Real along, Real farthest)
{
  const Real least = std::min(across, along), most = std::max(across, along);
  if (farthest <= most) return (most - least) * (most - least);
  return farthest * farthest - least * least;
}

// Returns a mass below that with which any point of a grain that is no sphere meets a plane, at most 4 times less: 1/m and the
// turning by the largest arm about each axis, or that of the farthest point about the axis of the least inertia.
static Real least_mass(const GrainShape &shape, Real mass, Real radius)
{
  const auto &[a, b, c] = shape.half;
  const Vec3 &inertia = shape.inertia_over_mass;
  const auto farthest = [&shape](Real x, Real y, Real z) {
    return circumscribed_radius({x, y, z}, shape.n1, shape.n2);
  };
  const Real of_axes = arm_squared(b, c, farthest(0, b, c)) / inertia.x +
                       arm_squared(c, a, farthest(a, 0, c)) / inertia.y +
                       arm_squared(a, b, farthest(a, b, 0)) / inertia.z;
  const Real of_point = (radius * radius - std::pow(std::min({a, b, c}), Real(2))) /
                        std::min({inertia.x, inertia.y, inertia.z});
  return mass / (1 + std::min(of_axes, of_point));
}

// Returns the radius of a sphere whose hertz contact is as stiff as the stiffest of this grain, at an overlap of 1 % of its
// radius. A flat side's contact is as wide as the grain.
static Real stiffest_radius(const GrainShape &shape, Real radius)
{
  const Real least = std::min({shape.half.x, shape.half.y, shape.half.z});
  if (shape.n1 > 2 || shape.n2 > 2) return 10 * radius;
  return radius * std::min(std::sqrt(radius / least), Real(10));
}

// The shortest contact of sphere i with any mesh.
Real TimestepCheck::shortest_of(const Spheres &s, int i) const
{
  const SphereKinds kinds = {laws_.kinds > 1 ? s.type : nullptr, laws_.kind_of_type.data(),
                             static_cast<int>(laws_.kind_of_type.size()) - 1};
  Real shortest = INFINITY, mass = s.mass[i], radius = s.radius[i];
  if (s.shapes && !s.shapes[i].is_sphere()) {
    mass = least_mass(s.shapes[i], mass, radius);
    radius = stiffest_radius(s.shapes[i], radius);
  }
  for (std::size_t k = static_cast<std::size_t>(kinds[i]); k < laws_.laws.size();
       k += static_cast<std::size_t>(laws_.kinds))
    shortest =
        std::min(shortest, contact_time(laws_.laws[k], mass_of(mass, k), radius, velocity_unit_));
  return shortest;
}

void TimestepCheck::check(Real dt, const HostSpheres &s)
{
  Real shortest = INFINITY;
  for (int i = 0; i < s.n; i++)
    if (s.is_in_group(i)) shortest = std::min(shortest, shortest_of(s, i));
  shortest = -shortest;
  host_.max(&shortest, 1);
  shortest = -shortest;
  const Real ratio = dt / (shortest / kStepsPerContact);
  if (ratio <= worst_) return;
  worst_ = kWorse * ratio;
  host_.warn("timestep " + number_text(dt) + " is more than a tenth of the shortest contact time " +
             number_text(shortest) +
             (stiffens(laws_.laws.front()) ? " (at an overlap of 1 % of the radius)" : "") +
             (laws_.laws.front().rolling.is_on() ? " or that of a spring of rolling" : "") +
             ": contacts will not be resolved");
}

}    // namespace lsdcd
