// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/packing.h"

#include "shape/are_apart.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

Real distance_sq(const Box &box, const Vec3 &x)
{
  Real sum = 0;
  for (int k = 0; k < 3; k++) {
    const Real out = std::max({box.lo[k] - x[k], x[k] - box.hi[k], Real(0)});
    sum += out * out;
  }
  return sum;
}

PlacedGrain placed(const PackedSphere &grain)
{
  if (!grain.shape) return place_ball(grain.at, grain.radius);
  PlacedGrain at = grain.shape->grain;
  at.centre = grain.at;
  return at;
}

// Do two grains overlap of which the spheres do?
bool shapes_overlap(const PackedSphere &a, const PackedSphere &b)
{
  if (!a.shape && !b.shape) return true;
  const Real one = a.shape ? a.shape->touch : a.radius, two = b.shape ? b.shape->touch : b.radius;
  if (one > 0 && two > 0 && norm_sq(a.at - b.at) < (one + two) * (one + two)) return true;
  return !are_apart(placed(a), placed(b));
}

bool is_clump(const PackedSphere &grain)
{
  return grain.shape && !grain.shape->balls.empty();
}

// Calls act(sphere) with each sphere of a clump, and with a grain that is none, and returns whether a call did: it ends there.
template <class Act>
bool any_part(const PackedSphere &grain, const Act &act)
{
  if (!is_clump(grain)) return act(grain);
  for (const Ball &ball : grain.shape->balls)
    if (act(PackedSphere{grain.at + ball.centre, ball.radius})) return true;
  return false;
}

}    // namespace

std::vector<PackedSphere> images_in(const PackedSphere &sphere, const Box &zone, Real largest,
                                    const PeriodicBox &box)
{
  constexpr Real kRoom = 1e-9;    // for rounding
  const Real past = sphere.radius + largest;
  int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
  if (box.any_periodic()) {
    const Vec3 at = box.fraction(sphere.at);
    const Box there = in_fractions(zone, box);
    for (int k = 0; k < 3; k++) {
      if (!box.periodic[k]) continue;
      const Real room = past / box.width(k) + kRoom;
      first[k] = static_cast<int>(std::ceil(there.lo[k] - room - at[k]));
      last[k] = static_cast<int>(std::floor(there.hi[k] + room - at[k]));
    }
  }
  std::vector<PackedSphere> found;
  for (int i = first[0]; i <= last[0]; i++)
    for (int j = first[1]; j <= last[1]; j++)
      for (int k = first[2]; k <= last[2]; k++) {
        const Vec3 at =
            sphere.at + Real(i) * box.edge[0] + Real(j) * box.edge[1] + Real(k) * box.edge[2];
        if (distance_sq(zone, at) <= past * past * (1 + kRoom))
          found.push_back({at, sphere.radius, sphere.shape});
      }
  return found;
}

// Cells are as wide as two spheres can be apart and touch: those of a point and around it hold all that a
// grain there can overlap.
Packing::Packing(const std::vector<PackedSphere> &there, const Box &zone, Real largest,
                 const PeriodicBox &box, Real largest_sphere) :
    zone_(zone),
    largest_(largest), box_(box)
{
  const Real part = largest_sphere > 0 ? largest_sphere : largest;
  Real widest = part;
  for (const PackedSphere &sphere : there) widest = std::max(widest, sphere.radius);
  cell_ = 1.001 * (widest + part);
  for (const PackedSphere &sphere : there) list(sphere);
}

std::uint64_t Packing::cell(const Vec3 &x, int i, int j, int k) const
{
  const int shift[3] = {i, j, k};
  std::uint64_t key = 0;
  for (int d = 0; d < 3; d++) {
    const auto at = static_cast<std::int64_t>(std::floor((x[d] - zone_.lo[d]) / cell_)) + shift[d];
    key = (key << 21) | (static_cast<std::uint64_t>(at) & 0x1fffff);
  }
  return key;
}

void Packing::list(const PackedSphere &sphere)
{
  const int n = static_cast<int>(spheres_.size());
  spheres_.push_back(sphere);
  const auto [found, is_new] = first_.emplace(cell(sphere.at, 0, 0, 0), n);
  next_.push_back(is_new ? kNone : found->second);
  found->second = n;
}

void Packing::add(const PackedSphere &grain)
{
  any_part(grain, [this](const PackedSphere &part) {
    for (const PackedSphere &image : images_in(part, zone_, largest_, box_)) list(image);
    return false;
  });
}

bool Packing::overlaps(const PackedSphere &grain) const
{
  return any_part(grain, [this](const PackedSphere &part) { return meets(part); });
}

bool Packing::meets(const PackedSphere &grain) const
{
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++)
      for (int k = -1; k <= 1; k++) {
        const auto found = first_.find(cell(grain.at, i, j, k));
        for (int n = found == first_.end() ? kNone : found->second; n != kNone; n = next_[n]) {
          const Real sum = spheres_[n].radius + grain.radius;
          if (norm_sq(spheres_[n].at - grain.at) < sum * sum && shapes_overlap(spheres_[n], grain))
            return true;
        }
      }
  return false;
}

}    // namespace lsdcd
