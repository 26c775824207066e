// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "flow/flow_surface.h"

#include "geometry/primitive_distance.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

using Corners = std::array<Vec3, 3>;

std::vector<Box> boxes_of(const WeldedMesh &mesh)
{
  std::vector<Box> out;
  out.reserve(mesh.faces.size());
  for (const std::array<int, 3> &f : mesh.faces)
    out.push_back(box_around(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]));
  return out;
}

Real distance(const Box &box, const Vec3 &q)
{
  Real sum = 0;
  for (int d = 0; d < 3; d++) {
    const Real out = std::max({box.lo[d] - q[d], q[d] - box.hi[d], Real(0)});
    sum += out * out;
  }
  return std::sqrt(sum);
}

// It never exceeds the distance by more than rounding. A triangle too thin for a plane is near its own
// sides everywhere.
Real distance(const Corners &t, const Vec3 &q)
{
  constexpr Real kThin = 1e-6;
  const Real sides = std::min({segment_distance(t[0], t[1], q), segment_distance(t[1], t[2], q),
                               segment_distance(t[2], t[0], q)});
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const Real twice_area = norm(normal);
  const Real longest_sq =
      std::max({norm_sq(t[1] - t[0]), norm_sq(t[2] - t[1]), norm_sq(t[0] - t[2])});
  if (!(twice_area > kThin * longest_sq))
    return std::max(Real(0), sides - 2 * kThin * std::sqrt(longest_sq));
  for (int k = 0; k < 3; k++)
    if (dot(cross(normal, t[(k + 1) % 3] - t[k]), q - t[k]) < 0) return sides;
  return std::min(sides, std::fabs(dot(normal, q - t[0])) / twice_area);
}

}    // namespace

FlowBoxes::FlowBoxes(const BoxTreeView &view, const Box &of_all, const PeriodicBox &box) :
    tree(view), in_fractions(lsdcd::in_fractions(of_all, box)),
    faces(periodic_faces(box)), edge{box.edge[0], box.edge[1], box.edge[2]},
    any_periodic(box.any_periodic()), largest(0)
{
  for (int k = 0; k < 3; k++) {
    largest = std::max({largest, std::fabs(of_all.lo[k]), std::fabs(of_all.hi[k])});
    if (box.periodic[k]) largest = std::max(largest, norm(box.edge[k]));
  }
}

FlowSurface::FlowSurface(const WeldedMesh &mesh) :
    vertices_(mesh.vertices), faces_(mesh.faces), tree_(boxes_of(mesh))
{
}

std::array<Vec3, 3> FlowSurface::corners(int face) const
{
  const std::array<int, 3> &f = faces_[face];
  return {vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]};
}

Vec3 FlowSurface::cells_between(const Vec3 &from, const Vec3 &to, const PeriodicBox &box)
{
  Vec3 cells = {0, 0, 0};
  if (!box.any_periodic()) return cells;
  const Vec3 apart = box.fraction(to) - box.fraction(from);
  for (int k = 0; k < 3; k++)
    if (box.periodic[k]) cells[k] = std::nearbyint(apart[k]);
  return cells;
}

// Calls f with the cells by which the image is moved, for each image whose bounds may meet `near`.
template <class F>
void FlowSurface::for_images(const Box &near, const PeriodicBox &box, F &&f) const
{
  if (!box.any_periodic()) return f(Vec3{0, 0, 0});
  constexpr Real kRoom = 1e-9;    // for rounding; one more image does no harm
  const Box place = in_fractions(near, box), own = in_fractions(tree_.bounds(), box);
  Vec3 first = {0, 0, 0}, last = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k]) continue;
    first[k] = std::ceil(place.lo[k] - own.hi[k] - kRoom);
    last[k] = std::floor(place.hi[k] - own.lo[k] + kRoom);
  }
  Vec3 cells;
  for (cells.x = first.x; cells.x <= last.x; cells.x++)
    for (cells.y = first.y; cells.y <= last.y; cells.y++)
      for (cells.z = first.z; cells.z <= last.z; cells.z++) f(cells);
}

// The path is moved, not the surface.
Passes FlowSurface::passes(const WrappedPoint &from, const Vec3 &to, const PeriodicBox &box) const
{
  Passes passes;
  for_images(Path(from, {to}, box).bounds(), box, [&](const Vec3 &cells) {
    const Path path({from.at, from.cells - cells}, {to, -cells}, box);
    const Box near = path.bounds();
    tree_.visit([&](const Box &around) { return overlap(around, near); },
                [&](int i) {
                  const Corners t = corners(i);
                  const int through = path.crosses(t[0], t[1], t[2]);
                  passes.forward += through > 0;
                  passes.backward += through < 0;
                });
  });
  return passes;
}

Real FlowSurface::clearance(const Vec3 &x, const PeriodicBox &box, Real most) const
{
  constexpr Real kRoom = 1e-9;    // for rounding, of the largest number that comes in
  Real within = most, largest = 0;
  for (int k = 0; k < 3; k++) {
    if (box.periodic[k]) within = std::min(within, box.width(k) / 2);
    largest = std::max({largest, std::fabs(x[k]), std::fabs(tree_.bounds().lo[k]),
                        std::fabs(tree_.bounds().hi[k])});
    if (box.periodic[k]) largest = std::max(largest, norm(box.edge[k]));
  }
  const Vec3 all_round = {within, within, within};
  for_images({x - all_round, x + all_round}, box, [&](const Vec3 &cells) {
    Vec3 at = x;
    for (int k = 0; k < 3; k++) at += -cells[k] * box.edge[k];
    within = tree_.least(
        within, [&](const Box &around) { return distance(around, at); },
        [&](int i) { return distance(corners(i), at); });
  });
  return within - kRoom * largest;
}

// For a clearance, images are moved by at most two cells more than the distance of the surface.
Real FlowSurface::images_move(const PeriodicBox &before, const PeriodicBox &now) const
{
  const Box own = in_fractions(tree_.bounds(), now);
  Real most = 0;
  for (int k = 0; k < 3; k++) {
    if (now.periodic[k] != before.periodic[k]) return HUGE_VAL;
    const Real cells = 2 + std::max(std::fabs(own.lo[k]), std::fabs(own.hi[k]));
    if (now.periodic[k]) most += cells * norm(now.edge[k] - before.edge[k]);
  }
  return most;
}

}    // namespace lsdcd
