// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/grain_source.h"

#include "insert/random_stream.h"

namespace lsdcd {

namespace {

// Parts of keys, so that streams differ.
enum : std::int64_t { kSize = 1, kVelocity = 2 };

Real cube(Real d)
{
  return d * d * d;
}

}    // namespace

// A grain of mass m is one of share / m grains.
void GrainRecipe::set_mass_shares(const std::vector<Size> &by_mass)
{
  sizes = by_mass;
  Real sum = 0;
  for (Size &size : sizes) sum += size.share /= cube(size.diameter);
  for (Size &size : sizes) size.share /= sum;
}

Real GrainRecipe::mean_mass() const
{
  Real volume = 0;    // of the cube around it
  for (const Size &size : sizes) volume += size.share * cube(size.diameter);
  if (sizes.empty())    // the mean of d^3
    volume = (smallest + largest) / 4 * (smallest * smallest + largest * largest);
  return kPi / 6 * volume * (density_lo + density_hi) / 2;
}

Real GrainSource::diameter(Real at) const
{
  if (recipe_.sizes.empty()) return recipe_.smallest + at * (recipe_.largest - recipe_.smallest);
  for (const GrainRecipe::Size &size : recipe_.sizes) {
    if (at < size.share) return size.diameter;
    at -= size.share;
  }
  return recipe_.sizes.back().diameter;    // shares add up to a little less than 1
}

std::vector<Real> GrainSource::numbers() const
{
  std::vector<Real> all = {static_cast<Real>(seed_), recipe_.smallest, recipe_.largest,
                           recipe_.density_lo, recipe_.density_hi};
  for (const GrainRecipe::Size &size : recipe_.sizes)
    all.insert(all.end(), {size.diameter, size.share});
  return all;
}

Grain GrainSource::grain(std::int64_t number) const
{
  RandomStream random({seed_, kSize, number});
  const Real radius = diameter(random.uniform()) / 2;
  return {number, radius, random.uniform(recipe_.density_lo, recipe_.density_hi)};
}

Vec3 GrainSource::velocity_jitter(std::int64_t number) const
{
  RandomStream random({seed_, kVelocity, number});
  Vec3 v;
  for (int k = 0; k < 3; k++)
    v[k] = recipe_.gaussian ? recipe_.jitter[k] * random.gaussian()
                            : random.uniform(-recipe_.jitter[k], recipe_.jitter[k]);
  return v;
}

}    // namespace lsdcd
