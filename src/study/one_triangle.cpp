// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/one_triangle.h"

#include "backend/backend_cpu.h"
#include "geometry/closest_point.h"
#include "geometry/primitive_distance.h"
#include "grid/lookup/locate.h"

#include <functional>

namespace lsdcd {

namespace {

// The nearest primitive of the cell that holds p; kNoFeature in cells away from the wall.
FeatureCode listed_at(const GridView &grid, const Vec3 &p)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, p, at, cell)) return kNoFeature;
  return cell.count == 1 ? cell.first : grid.lists.entries[cell.first].feature;
}

}    // namespace

std::vector<Guess> guess_one_triangle(AccuracyStudy &study, Real length)
{
  StudyLists lists;
  lists.nearest = 1;
  lists.length = length;
  const Real honest = study.measure(lists).accuracy;
  const GridView grid = study.grid().view();
  const std::uint32_t n_faces = static_cast<std::uint32_t>(study.mesh().faces.size());
  const Vec3 middle = 0.5 * (study.mesh().report.lo + study.mesh().report.hi);
  const std::vector<Sphere> &spheres = study.spheres();

  const auto to_primitive = [&](FeatureCode primitive, const Vec3 &q) {
    return primitive == kNoFeature ? kAnyDistance : primitive_distance(grid.wall, primitive, q);
  };
  const auto to_plane = [&](std::uint32_t face, const Vec3 &q) {
    return std::fabs(dot(grid.wall.faces[face].normal, q - grid.wall.faces[face].anchor));
  };
  const auto any_face = [&](std::size_t i) {
    return static_cast<std::uint32_t>(uniform(~std::uint64_t(0), i) * (n_faces - 1));
  };
  using Way = std::function<Real(std::size_t, const Vec3 &)>;
  const auto score = [&](const Way &distance) {
    std::vector<std::uint8_t> touching(spheres.size());
    CpuBackend().for_each(spheres.size(), [&](std::size_t i) {
      touching[i] = distance(i, spheres[i].centre()) < spheres[i].r;
    });
    return study.agreement(touching);
  };

  std::vector<Guess> out = {{"the nearest triangle, as the paper says", honest}};
  const auto guess = [&](const char *what, const Way &distance) {
    out.push_back({what, score(distance)});
  };
  guess("no contact is ever found", [&](std::size_t, const Vec3 &) { return kAnyDistance; });
  guess("the list of the next cell in x, y and z", [&](std::size_t, const Vec3 &q) {
    return to_primitive(listed_at(grid, q + Vec3{length, length, length}), q);
  });
  guess("x and z exchanged in the cell's number", [&](std::size_t, const Vec3 &q) {
    const Vec3 d = q - middle;
    return to_primitive(listed_at(grid, middle + Vec3{d.z, d.y, d.x}), q);
  });
  guess("the first triangle for every cell",
        [&](std::size_t, const Vec3 &q) { return to_primitive(0, q); });
  guess("the last triangle for every cell",
        [&](std::size_t, const Vec3 &q) { return to_primitive(n_faces - 1, q); });
  guess("a triangle at random",
        [&](std::size_t i, const Vec3 &q) { return to_primitive(any_face(i), q); });
  guess("the plane of a triangle at random",
        [&](std::size_t i, const Vec3 &q) { return to_plane(any_face(i), q); });
  guess("the plane of the first triangle",
        [&](std::size_t, const Vec3 &q) { return to_plane(0, q); });
  return out;
}

}    // namespace lsdcd
