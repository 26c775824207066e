// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sizes, densities and velocities of grains, by their numbers.
#pragma once

#include "base/vec3.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

struct Grain {
  std::int64_t number;    // from 0
  Real radius, density;

  Real mass() const { return 4.0 / 3 * kPi * radius * radius * radius * density; }
};

struct GrainRecipe {
  struct Size {
    Real diameter, share;    // of all grains by number; shares add up to 1
  };
  std::vector<Size> sizes;           // empty: uniform between the next two
  Real smallest = 0, largest = 0;    // diameters
  Real density_lo = 0, density_hi = 0;
  // Velocity: the largest change of each component, or its standard deviation.
  Vec3 jitter = {0, 0, 0};
  bool gaussian = false;

  // From shares of mass to those of number.
  void set_mass_shares(const std::vector<Size> &by_mass);

  Real mean_mass() const;
};

class GrainSource {
 public:
  GrainSource(const GrainRecipe &recipe, std::int64_t seed) : recipe_(recipe), seed_(seed) {}

  const GrainRecipe &recipe() const { return recipe_; }
  Real largest_radius() const { return recipe_.largest / 2; }

  // All that a grain depends on beside its number.
  std::vector<Real> numbers() const;

  // Return the grain of a number and the change of its velocity, which depend on the number and the seed alone.
  Grain grain(std::int64_t number) const;
  Vec3 velocity_jitter(std::int64_t number) const;

 private:
  Real diameter(Real at) const;

  GrainRecipe recipe_;
  std::int64_t seed_;
};

}    // namespace lsdcd
