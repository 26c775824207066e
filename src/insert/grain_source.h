// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sizes, shapes, densities and velocities of grains, by their numbers.
#pragma once

#include "base/quaternion.h"
#include "base/vec3.h"
#include "clump/ball.h"
#include "insert/random_stream.h"
#include "shape/superellipsoid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

constexpr Real kBallVolume = 4.0 / 3 * kPi;    // over the cube of the radius

struct Grain {
  std::int64_t number;    // from 0
  // Of a grain with a shape and of a clump the radius is that of the sphere around it.
  Real radius, density;
  std::size_t kind = 0;       // index of GrainRecipe::kinds
  Real bulk = kBallVolume;    // volume over the cube of the radius

  Real mass() const { return bulk * radius * radius * radius * density; }
};

// Grains that are no spheres: of a shape, all of whose lengths are multiplied by a factor that is uniform between two, or clumps of
// spheres, which are all alike.
struct GrainKind {
  Superellipsoid shape;
  Real least = 1, most = 1;    // the factor
  Real share = 1;              // of all grains by number; shares add up to 1
  // Of a clump: its spheres about the centre of mass, and its mass. Empty: the kind has a shape.
  std::vector<Ball> balls = {};
  Real clump_mass = 0;

  bool is_clump() const { return !balls.empty(); }
  // Returns the radius of the sphere around a grain at the factor 1. That of a clump is about its centre of mass.
  Real farthest() const;
  // Returns mass over density of a grain at the factor 1: its volume, or the mass of a clump, whose density counts as 1.
  Real solid() const;
  // Returns the mean of solid() over its grains.
  Real mean_solid() const;
};

struct GrainRecipe {
  struct Size {
    Real diameter, share;    // of all grains by number; shares add up to 1
  };
  std::vector<Size> sizes;           // empty: uniform between the next two
  Real smallest = 0, largest = 0;    // diameters, of the spheres around grains with a shape
  // Empty: spheres of these sizes; else all have shapes, or all are clumps.
  std::vector<GrainKind> kinds;
  bool is_turned_at_random = true;    // grains of kinds; else they have the next turn
  Quaternion turn;                    // from the axes of a grain to the box
  Real density_lo = 0, density_hi = 0;
  // Velocity: the largest change of each component, or its standard deviation.
  Vec3 jitter = {0, 0, 0};
  bool gaussian = false;

  // From shares of mass to those of number.
  void set_mass_shares(const std::vector<Size> &by_mass);
  // Takes kinds whose shares are of the number of grains, or of their mass, and sets the diameters.
  void set_kinds(const std::vector<GrainKind> &of, bool is_by_mass);

  // Returns how many kinds grains have, 1 for spheres.
  std::size_t n_kinds() const { return kinds.empty() ? 1 : kinds.size(); }
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

  bool has_kinds() const { return !recipe_.kinds.empty(); }
  bool has_clumps() const { return has_kinds() && recipe_.kinds[0].is_clump(); }
  // Returns the largest radius of spheres by which grains are kept apart: those of clumps, or those around grains.
  Real largest_sphere() const;
  // Returns the shape of a grain, of a source that has shapes.
  Superellipsoid shape(const Grain &grain) const;
  // Returns the spheres of a clump about its centre of mass, turned.
  std::vector<Ball> balls(const Grain &grain, const Quaternion &turn) const;
  // Returns how a grain is turned: the same for all, or uniform among all rotations (Shoemake 1992).
  Quaternion turn(RandomStream &random) const;

 private:
  Real diameter(Real at) const;
  std::size_t kind(Real at) const;

  GrainRecipe recipe_;
  std::int64_t seed_;
};

}    // namespace lsdcd
