// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mpi_mesh.h"

#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"
#include "mesh/soup_of.h"

#include <cstdint>

namespace lsdcd {

namespace {

// From the first process to all.
void send_corners(Host &host, TriangleSoup &soup)
{
  std::uint64_t corners = soup.corners.size();
  host.broadcast(&corners, sizeof corners, 0);
  run_collectively(host, true, [&] { soup.corners.resize(corners); });
  host.broadcast(soup.corners.data(), corners * sizeof(Vec3), 0);
  host.broadcast(&soup.rounding, sizeof soup.rounding, 0);
}

}    // namespace

WeldedMesh read_together(Host &host, const MeshSpec &settings)
{
  TriangleSoup soup;
  soup.source = settings.file;
  run_collectively(host, host.is_first(), [&] {
    soup = read_mesh(settings.file).soup;
    settings.placement.apply(soup);
  });
  send_corners(host, soup);
  WeldedMesh mesh;
  run_collectively(host, true, [&] {
    mesh = weld(soup, settings.weld);
    check_has_area(mesh);
  });
  const std::string doubt = weld_warning(mesh.report);
  if (!doubt.empty()) host.warn("mesh '" + settings.file + "': " + doubt);
  return mesh;
}

WeldedMesh copy_together(Host &host, const WeldedMesh *mesh)
{
  TriangleSoup soup;
  run_collectively(host, host.is_first(), [&] { soup = soup_of(*mesh); });
  send_corners(host, soup);
  WeldedMesh copy;
  run_collectively(host, true, [&] { copy = weld(soup, 0); });
  return copy;
}

}    // namespace lsdcd
