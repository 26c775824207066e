// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "library_query.h"


#include <stdexcept>

namespace lsdcd {

namespace {

void check(int code)
{
  if (code != LSDCD_OK) throw std::runtime_error(lsdcd_last_error());
}

}    // namespace

LibraryQuery::LibraryQuery(const TriangleSoup &mesh, Real cutoff, bool in_floats)
{
  lsdcd_mesh *read = nullptr;
  check(lsdcd_mesh_from_corners(&mesh.corners[0].x, mesh.n_triangles(), -1, &read));
  lsdcd_grid_options options = {};
  options.size = sizeof options;
  options.cutoff = cutoff;
  options.precision = in_floats ? LSDCD_FLOAT : LSDCD_DOUBLE;
  if (in_floats) options.memory = 16e9;
  lsdcd_grid *grid = nullptr;
  const int code = lsdcd_grid_build(read, &options, &grid);
  lsdcd_mesh_free(read);
  check(code);
  grid_.reset(grid, lsdcd_grid_free);
  lsdcd_grid_facts facts = {};
  facts.size = sizeof facts;
  check(lsdcd_grid_get_facts(grid, &facts));
  cell_ = facts.cell;
  grid_bytes_ = static_cast<double>(facts.bytes);
}

Timing LibraryQuery::time(const Sphere *spheres, std::size_t n)
{
  return time_of(spheres, n, LSDCD_DOUBLE);
}
Timing LibraryQuery::time(const FloatSphere *spheres, std::size_t n)
{
  return time_of(spheres, n, LSDCD_FLOAT);
}

template <class T>
Timing LibraryQuery::time_of(const SphereOf<T> *spheres, std::size_t n, int type)
{
  std::vector<T> distance(n);
  status_.resize(n);
  lsdcd_query q = {};
  q.size = sizeof q;
  q.n = n;
  q.type = type;
  q.points = spheres;
  q.points_row = 4;
  q.points_column = 1;
  q.distance = distance.data();
  q.status = status_.data();
  const Timing time = time_it(1, [&] { check(lsdcd_query_host(grid_.get(), &q)); });
  distance_.assign(distance.begin(), distance.end());
  return time;
}

}    // namespace lsdcd
