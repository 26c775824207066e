// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_contacts_host
#include "api/c_border.h"
#include "api/call_progress.h"
#include "api/call_threads.h"
#include "api/device_memory.h"
#include "api/points_given.h"
#include "query/contact_query.h"

#include <algorithm>
#include <cstddef>

using namespace lsdcd;

namespace {

lsdcd_contacts checked_contacts(const ApiGrid &grid, const lsdcd_contacts *given)
{
  lsdcd_contacts c = checked(given, "lsdcd_contacts");
  check_points(c);
  need(c.first, "first");
  if (!grid.is_limited())
    throw ApiError(LSDCD_ERROR_CUTOFF,
                   "contacts are found up to a cutoff, and this grid has none: build one with a "
                   "cutoff of the largest radius");
  if (!grid.uses_tree())
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "contacts need complete lists in double: build a grid without `nearest`, with "
                   "`precision` LSDCD_DOUBLE");
  settle_radius(grid, c);
  const DeviceMemory device;
  const std::pair<const void *, const char *> arrays[] = {
      {c.points, "points"},     {c.radii, "radii"},     {c.first, "first"},   {c.point, "point"},
      {c.distance, "distance"}, {c.overlap, "overlap"}, {c.normal, "normal"}, {c.weight, "weight"},
      {c.triangle, "triangle"}, {c.feature, "feature"}};
  for (const auto &[array, name] : arrays)
    device.refuse_there(array, name, "contacts are found on the host alone");
  return c;
}

template <class T>
void write(const TriangleTable &names, const std::vector<SphereContact> &found,
           const lsdcd_contacts &to)
{
  const TriangleNames triangles = names.view();
  const auto put = [](void *array, std::size_t i, Real x) {
    if (array) static_cast<T *>(array)[i] = static_cast<T>(x);
  };
  const auto put_vector = [&](void *array, std::size_t i, const Vec3 &x) {
    for (int a = 0; a < 3; a++) put(array, 3 * i + static_cast<std::size_t>(a), x[a]);
  };
  for (std::size_t i = 0; i < found.size(); i++) {
    const SphereContact &f = found[i];
    put_vector(to.point, i, f.point);
    put_vector(to.normal, i, f.normal);
    put(to.distance, i, f.distance);
    put(to.overlap, i, f.overlap);
    put(to.weight, i, f.weight);
    if (to.triangle) to.triangle[i] = triangles.of(f.feature);
    if (to.feature) to.feature[i] = f.feature;
  }
}

template <class T>
std::size_t find(const ApiGrid &grid, const lsdcd_contacts &c)
{
  CallProgress progress(c.progress, c.data);
  const GridView &view = grid.cells(false, progress.listener()).grid.view;
  SphereView<T> spheres;
  spheres.centres = vectors(static_cast<const T *>(c.points), c.points_row, c.points_column);
  spheres.radii = numbers(static_cast<const T *>(c.radii), c.radii_step);
  spheres.radius = c.radius;
  std::vector<SphereContact> found;
  c.first[0] = 0;
  progress.in_parts("spheres", c.n, [&](std::size_t from, std::size_t n) {
    spheres.from = from;
    spheres.n = n;
    SphereContacts made = find_all_contacts(view, spheres);
    for (std::size_t i = 1; i <= n; i++) c.first[from + i] = found.size() + made.first[i];
    if (from == 0)
      found = std::move(made.found);
    else
      found.insert(found.end(), made.found.begin(), made.found.end());
  });
  if (found.size() <= c.room) write<T>(grid.names, found, c);
  return found.size();
}

}    // namespace

extern "C" {

int lsdcd_contacts_host(const lsdcd_grid *grid, lsdcd_contacts *contacts)
{
  return guard([&] {
    need(grid, "grid");
    const ApiGrid &g = *grid->in;
    const lsdcd_contacts c = checked_contacts(g, contacts);
    const CallThreads threads(c.threads);
    contacts->contacts = c.type == LSDCD_FLOAT ? find<float>(g, c) : find<double>(g, c);
  });
}

}    // extern "C"
