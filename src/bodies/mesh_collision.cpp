// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "bodies/mesh_collision.h"

#include "base/input_error.h"

namespace lsdcd {

namespace {

TriangleSoup faces_of(const WeldedMesh &mesh)
{
  TriangleSoup soup;
  soup.source = mesh.source;
  soup.corners.reserve(3 * mesh.faces.size());
  for (const auto &face : mesh.faces)
    for (const int v : face) soup.corners.push_back(mesh.vertices[v]);
  return soup;
}

}    // namespace

MeshCollision::MeshCollision(const WeldedMesh &wall, const WeldedMesh &body,
                             const MeshCollisionSettings &settings) :
    collision_(make_body_collision(settings.device)),
    wall_facet_(std::make_shared<std::vector<std::uint32_t>>(wall.face_facet.begin(),
                                                             wall.face_facet.end()))
{
  BodyGridSettings of_grid = collision_grid(faces_of(body), settings.cell, settings.nearest);
  of_grid.memory_budget = settings.memory;
  of_grid.length_name = settings.cell_name;
  of_grid.progress = settings.progress;
  const BodyGrid grid = build_grid(wall, of_grid, collision_->on_cuda());
  grid_ = grid.report;
  collision_->set_wall(grid);
  set_body(body);
}

MeshCollision::MeshCollision(const MeshCollision &same_wall, const WeldedMesh &body) :
    collision_(same_wall.collision_->with_same_wall()), wall_facet_(same_wall.wall_facet_),
    grid_(same_wall.grid_)
{
  set_body(body);
}

void MeshCollision::set_body(const WeldedMesh &body)
{
  body_facet_.assign(body.face_facet.begin(), body.face_facet.end());
  collision_->set_body(faces_of(body));
}

}    // namespace lsdcd
