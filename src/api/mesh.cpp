// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_mesh_*
#include "api/c_border.h"
#include "api/objects.h"
#include "mesh/io/read_mesh.h"

#include <cmath>
#include <limits>

using namespace lsdcd;

namespace {

lsdcd_mesh *welded(const TriangleSoup &soup, double weld_tolerance)
{
  if (std::isnan(weld_tolerance) || weld_tolerance > std::numeric_limits<double>::max())
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "`weld` is not finite: give a length, or -1 for the default");
  auto mesh = std::make_shared<ApiMesh>();
  mesh->mesh = weld(soup, weld_tolerance);
  mesh->report = describe(mesh->mesh.report, soup.source);
  return new lsdcd_mesh{std::move(mesh)};
}

TriangleSoup soup_of(const double *corners, std::size_t n)
{
  if (n == 0) throw ApiError(LSDCD_ERROR_ARGUMENT, "`n_triangles` is 0: a mesh has triangles");
  constexpr std::size_t kMax = std::numeric_limits<int>::max() / 3;
  if (n > kMax)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`n_triangles` is " + std::to_string(n) +
                                             "; a mesh has at most " + std::to_string(kMax));
  TriangleSoup soup;
  soup.source = "from corners";
  soup.corners.reserve(3 * n);
  for (std::size_t k = 0; k < 3 * n; k++) {
    const Vec3 p = {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError("triangle " + std::to_string(k / 3) + " (from 0): a corner is not finite");
    soup.corners.push_back(p);
  }
  return soup;
}

}    // namespace

extern "C" {

int lsdcd_mesh_read(const char *file, double weld, lsdcd_mesh **mesh)
{
  return guard([&] {
    need(mesh, "mesh");
    need(file, "file");
    *mesh = welded(read_mesh(file).soup, weld);
  });
}

int lsdcd_mesh_from_corners(const double *corners, size_t n_triangles, double weld,
                            lsdcd_mesh **mesh)
{
  return guard([&] {
    need(mesh, "mesh");
    need(corners, "corners");
    *mesh = welded(soup_of(corners, n_triangles), weld);
  });
}

int lsdcd_mesh_get_facts(const lsdcd_mesh *mesh, lsdcd_mesh_facts *facts)
{
  return guard([&] {
    need(mesh, "mesh");
    lsdcd_mesh_facts f = checked(facts, "lsdcd_mesh_facts");
    const WallMesh &m = mesh->in->mesh;
    f.triangles = m.report.facets;
    f.faces = m.faces.size();
    f.edges = m.edges.size();
    f.vertices = m.vertices.size();
    f.open_edges = m.report.open_edges;
    f.meeting_pairs = m.report.meeting_pairs;
    f.closed = m.report.closed;
    f.oriented = m.report.oriented;
    f.area = m.report.area;
    f.volume = m.report.volume;
    for (int k = 0; k < 3; k++) {
      f.lo[k] = m.report.lo[k];
      f.hi[k] = m.report.hi[k];
    }
    copy_out(f, facts);
  });
}

const char *lsdcd_mesh_report(const lsdcd_mesh *mesh)
{
  return mesh ? mesh->in->report.c_str() : "";
}

void lsdcd_mesh_free(lsdcd_mesh *mesh)
{
  delete mesh;
}

}    // extern "C"
