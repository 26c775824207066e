// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/grain_source.h"

#include "clump/sphere_union.h"

#include <algorithm>

namespace lsdcd {

namespace {

// Parts of keys, so that streams differ.
enum : std::int64_t { kSize = 1, kVelocity = 2 };

Real cube(Real d)
{
  return d * d * d;
}

// Returns the mean of the cube of a number that is uniform between two.
Real mean_cube(Real least, Real most)
{
  return (least + most) / 4 * (least * least + most * most);
}

}    // namespace

Real GrainKind::farthest() const
{
  return is_clump() ? radius_around(balls, {0, 0, 0}) : shape.farthest;
}

Real GrainKind::solid() const
{
  return is_clump() ? clump_mass : volume(shape);
}

Real GrainKind::mean_solid() const
{
  return solid() * mean_cube(least, most);
}

// A grain of mass m is one of share / m grains.
void GrainRecipe::set_mass_shares(const std::vector<Size> &by_mass)
{
  sizes = by_mass;
  Real sum = 0;
  for (Size &size : sizes) sum += size.share /= cube(size.diameter);
  for (Size &size : sizes) size.share /= sum;
}

void GrainRecipe::set_kinds(const std::vector<GrainKind> &of, bool is_by_mass)
{
  kinds = of;
  sizes.clear();
  Real sum = 0;
  for (GrainKind &kind : kinds) sum += kind.share /= is_by_mass ? kind.mean_solid() : 1;
  smallest = largest = 2 * kinds[0].least * kinds[0].farthest();
  for (GrainKind &kind : kinds) {
    kind.share /= sum;
    smallest = std::min(smallest, 2 * kind.least * kind.farthest());
    largest = std::max(largest, 2 * kind.most * kind.farthest());
  }
}

Real GrainRecipe::mean_mass() const
{
  if (!kinds.empty()) {
    Real solid = 0;
    for (const GrainKind &kind : kinds) solid += kind.share * kind.mean_solid();
    return solid * (density_lo + density_hi) / 2;
  }
  Real volume = 0;    // of the cube around it
  for (const Size &size : sizes) volume += size.share * cube(size.diameter);
  if (sizes.empty()) volume = mean_cube(smallest, largest);
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

std::size_t GrainSource::kind(Real at) const
{
  std::size_t i = 0;
  for (; i + 1 < recipe_.kinds.size() && at >= recipe_.kinds[i].share; i++)
    at -= recipe_.kinds[i].share;
  return i;
}

std::vector<Real> GrainSource::numbers() const
{
  std::vector<Real> all = {static_cast<Real>(seed_), recipe_.smallest, recipe_.largest,
                           recipe_.density_lo, recipe_.density_hi};
  for (const GrainRecipe::Size &size : recipe_.sizes)
    all.insert(all.end(), {size.diameter, size.share});
  if (!has_kinds()) return all;
  const Quaternion &q = recipe_.turn;
  all.insert(all.end(), {Real(recipe_.is_turned_at_random), q.w, q.v.x, q.v.y, q.v.z});
  for (const GrainKind &k : recipe_.kinds) {
    if (k.is_clump()) {
      all.insert(all.end(), {k.clump_mass, k.share, static_cast<Real>(k.balls.size())});
      for (const Ball &ball : k.balls)
        all.insert(all.end(), {ball.centre.x, ball.centre.y, ball.centre.z, ball.radius});
      continue;
    }
    all.insert(all.end(), {k.shape.half.x, k.shape.half.y, k.shape.half.z, k.shape.n1, k.shape.n2,
                           k.least, k.most, k.share});
  }
  return all;
}

Grain GrainSource::grain(std::int64_t number) const
{
  RandomStream random({seed_, kSize, number});
  if (!has_kinds()) {
    const Real radius = diameter(random.uniform()) / 2;
    return {number, radius, random.uniform(recipe_.density_lo, recipe_.density_hi)};
  }
  const std::size_t i = kind(random.uniform());
  const GrainKind &of = recipe_.kinds[i];
  const Real farthest = of.farthest(), radius = random.uniform(of.least, of.most) * farthest;
  return {number, radius, random.uniform(recipe_.density_lo, recipe_.density_hi), i,
          of.solid() / cube(farthest)};
}

Real GrainSource::largest_sphere() const
{
  if (!has_clumps()) return largest_radius();
  Real most = 0;
  for (const GrainKind &kind : recipe_.kinds)
    for (const Ball &ball : kind.balls) most = std::max(most, ball.radius);
  return most;
}

std::vector<Ball> GrainSource::balls(const Grain &grain, const Quaternion &turn) const
{
  std::vector<Ball> turned = recipe_.kinds[grain.kind].balls;
  for (Ball &ball : turned) ball.centre = rotate(turn, ball.centre);
  return turned;
}

Superellipsoid GrainSource::shape(const Grain &grain) const
{
  const Superellipsoid &of = recipe_.kinds[grain.kind].shape;
  const Real factor = grain.radius / of.farthest;
  return {factor * of.half, of.n1, of.n2, factor * of.rho, grain.radius, factor * of.nearest};
}

Quaternion GrainSource::turn(RandomStream &random) const
{
  if (!recipe_.is_turned_at_random) return recipe_.turn;
  const Real share = random.uniform(), a = random.uniform(0, 2 * kPi),
             b = random.uniform(0, 2 * kPi);
  const Real one = std::sqrt(1 - share), two = std::sqrt(share);
  return {one * std::cos(a), {one * std::sin(a), two * std::cos(b), two * std::sin(b)}};
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
