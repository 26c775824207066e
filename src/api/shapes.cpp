// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_shapes_host, lsdcd_shape_get_facts
#include "api/c_border.h"
#include "api/call_progress.h"
#include "api/call_threads.h"
#include "api/device_memory.h"
#include "api/objects.h"
#include "api/points_given.h"
#include "api/refusals.h"
#include "query/shape_query.h"
#include "shape/least_mass.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace lsdcd;

namespace {

bool wants_distances(const lsdcd_shapes &s)
{
  return s.distance || s.closest || s.closest_of_grain || s.closest_normal || s.closest_triangle ||
         s.closest_feature;
}

lsdcd_shapes checked_shapes(const ApiGrid &grid, const lsdcd_shapes *given)
{
  lsdcd_shapes s = checked(given, "lsdcd_shapes");
  check_threads(s.threads);
  checked_flag(s.one_shape, "one_shape");
  if (s.n > 0) {
    need(s.centres, "centres");
    need(s.half_axes, "half_axes");
  }
  if (!s.first && !wants_distances(s))
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "nothing is asked for: `first` and all arrays of distances are null");
  if (!grid.uses_tree())
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "grains of shape need complete lists in double: build a grid without `nearest`, "
                   "with `precision` LSDCD_DOUBLE");
  const DeviceMemory device;
  const std::pair<const void *, const char *> arrays[] = {{s.centres, "centres"},
                                                          {s.quaternions, "quaternions"},
                                                          {s.half_axes, "half_axes"},
                                                          {s.exponents, "exponents"},
                                                          {s.first, "first"},
                                                          {s.point, "point"},
                                                          {s.of_grain, "of_grain"},
                                                          {s.overlap, "overlap"},
                                                          {s.normal, "normal"},
                                                          {s.triangle, "triangle"},
                                                          {s.feature, "feature"},
                                                          {s.distance, "distance"},
                                                          {s.closest, "closest"},
                                                          {s.closest_of_grain, "closest_of_grain"},
                                                          {s.closest_normal, "closest_normal"},
                                                          {s.closest_triangle, "closest_triangle"},
                                                          {s.closest_feature, "closest_feature"}};
  for (const auto &[array, name] : arrays)
    device.refuse_there(array, name, "contacts of grains of shape are found on the host alone");
  return s;
}

void put(double *array, std::size_t i, const Vec3 &x)
{
  if (!array) return;
  for (int a = 0; a < 3; a++) array[3 * i + static_cast<std::size_t>(a)] = x[a];
}

void write_contacts(const TriangleNames &names, const std::vector<FoundGrainContact> &found,
                    const lsdcd_shapes &to)
{
  for (std::size_t i = 0; i < found.size(); i++) {
    const FoundGrainContact &f = found[i];
    put(to.point, i, f.point);
    put(to.of_grain, i, f.of_grain);
    put(to.normal, i, f.normal);
    if (to.overlap) to.overlap[i] = -f.distance;
    if (to.triangle) to.triangle[i] = names.of(f.feature);
    if (to.feature) to.feature[i] = f.feature;
  }
}

void write_distances(const TriangleNames &names, const std::vector<FoundGrainContact> &nearest,
                     std::size_t from, const lsdcd_shapes &to)
{
  for (std::size_t k = 0; k < nearest.size(); k++) {
    const FoundGrainContact &f = nearest[k];
    const std::size_t i = from + k;
    put(to.closest, i, f.point);
    put(to.closest_of_grain, i, f.of_grain);
    put(to.closest_normal, i, f.normal);
    if (to.distance) to.distance[i] = f.distance;
    const bool found = f.feature != kNoFeature;
    if (to.closest_triangle) to.closest_triangle[i] = found ? names.of(f.feature) : LSDCD_NONE;
    if (to.closest_feature) to.closest_feature[i] = found ? f.feature : LSDCD_NONE;
  }
}

std::size_t answer(const ApiGrid &grid, const lsdcd_shapes &s)
{
  CallProgress progress(s.progress, s.data);
  const TriangleTree &tree = grid.tree(progress.listener());
  const TriangleNames names = grid.names.view();
  ShapesGiven grains = {0, 0, s.centres, s.quaternions, s.half_axes, s.exponents, s.one_shape != 0};
  std::vector<FoundGrainContact> found, nearest;
  if (s.first) s.first[0] = 0;
  progress.in_parts("grains", s.n, [&](std::size_t from, std::size_t n) {
    grains.from = from;
    grains.n = n;
    if (s.first) {
      const FoundGrainContacts made = find_shape_contacts(tree, grains);
      for (std::size_t i = 1; i <= n; i++) s.first[from + i] = found.size() + made.first[i];
      found.insert(found.end(), made.found.begin(), made.found.end());
    }
    if (wants_distances(s)) {
      nearest.resize(n);
      find_shape_distances(tree, grains, nearest.data());
      write_distances(names, nearest, from, s);
    }
  });
  if (found.size() <= s.room) write_contacts(names, found, s);
  return found.size();
}

}    // namespace

extern "C" {

int lsdcd_shapes_host(const lsdcd_grid *grid, lsdcd_shapes *shapes)
{
  return guard([&] {
    need(grid, "grid");
    const ApiGrid &g = *grid->in;
    const lsdcd_shapes s = checked_shapes(g, shapes);
    const CallThreads threads(s.threads);
    shapes->contacts = answer(g, s);
  });
}

int lsdcd_shape_get_facts(const double *half_axes, const double *exponents,
                          lsdcd_shape_facts *facts)
{
  return guard([&] {
    need(half_axes, "half_axes");
    checked(facts, "lsdcd_shape_facts");
    const Superellipsoid s =
        make_superellipsoid({half_axes[0], half_axes[1], half_axes[2]},
                            exponents ? exponents[0] : 2, exponents ? exponents[1] : 2);
    const Vec3 inertia = inertia_over_mass(s);
    *facts = {facts->size,        volume(s), {inertia.x, inertia.y, inertia.z},
              s.farthest,         s.nearest, s.rho,
              least_mass_share(s)};
  });
}

}    // extern "C"
