// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Feeds a reader, LSDCD_FUZZ_READ, and the welder any bytes at all. They may refuse with
// InputError; anything else, or a mesh that contradicts itself, is a failure.
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "mesh/welded_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace {

constexpr std::size_t kMaxFacets = 500;

void require(bool holds)
{
  if (!holds) std::abort();
}

const lsdcd::TriangleSoup &soup_of(const lsdcd::TriangleSoup &soup)
{
  return soup;
}

const lsdcd::TriangleSoup &soup_of(const lsdcd::ReadMesh &read)
{
  return read.soup;
}

void check_mesh(const lsdcd::WallMesh &mesh)
{
  const auto &report = mesh.report;
  require(report.facets == mesh.faces.size() + report.degenerate_facets + report.duplicate_facets);
  require(!mesh.vertices.empty() && mesh.vertices.size() <= report.corners);
  require(mesh.edge_first.size() == mesh.edges.size() + 1);
  require(mesh.edge_first.back() == static_cast<int>(3 * mesh.faces.size()));
  require(mesh.vertex_first.size() == mesh.vertices.size() + 1);
  require(mesh.vertex_first.back() == static_cast<int>(2 * mesh.edges.size()));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
      const auto &edge = mesh.edges.at(mesh.face_edges[f][k]);
      require(a != b && edge[0] == std::min(a, b) && edge[1] == std::max(a, b));
    }
  require(std::isfinite(report.area) && std::isfinite(report.volume));
  require(report.largest_fold >= 0 && report.largest_fold <= 180);
  if (mesh.vertices.size() > 100) return;
  for (const auto &a : mesh.vertices)
    for (const auto &b : mesh.vertices)
      require(&a == &b || std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) > report.weld_tolerance);
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  try {
    const auto read = lsdcd::LSDCD_FUZZ_READ(reinterpret_cast<const char *>(data), size, "fuzz");
    const lsdcd::TriangleSoup &soup = soup_of(read);
    require(!soup.corners.empty());
    if (soup.n_triangles() > kMaxFacets) return 0;
    for (const lsdcd::Real tolerance : {-1.0, 0.0, 0.25}) {
      try {
        const auto mesh = lsdcd::weld(soup, tolerance);
        check_mesh(mesh);
        require(!describe(mesh.report, mesh.source).empty());
      } catch (const lsdcd::InputError &) {
      }
    }
  } catch (const lsdcd::InputError &error) {
    require(std::string(error.what()).find("fuzz") == 0);
  }
  return 0;
}
