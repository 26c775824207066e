// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh of a wall whose nodes the caller moves, or whose vertices wear moves: lsdcd_wall_set_nodes,
// lsdcd_wall_get_nodes, lsdcd_wall_get_node_forces, lsdcd_wall_get_node_count.
#include "api/device_memory.h"
#include "api/refusals.h"
#include "api/wall_handle.h"
#include "mesh/weld_map.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace lsdcd;

namespace {

const MeshPart &part_with_nodes(const lsdcd_wall &wall, int mesh)
{
  check_mesh(wall, mesh, 0);
  const MeshPart &part = wall.in->meshes()[static_cast<std::size_t>(mesh)];
  if (part.nodes) return part;
  throw ApiError(
      LSDCD_ERROR_ARGUMENT,
      "mesh " + std::to_string(mesh) + ", '" + part.spec.name +
          "', has no nodes that move: set nodes_by_caller in its lsdcd_wall_mesh when the "
          "wall is made");
}

// Likewise, or one that wear moves.
const MeshPart &part_that_deforms(const lsdcd_wall &wall, int mesh)
{
  check_mesh(wall, mesh, 0);
  const MeshPart &part = wall.in->meshes()[static_cast<std::size_t>(mesh)];
  return part.wear && part.spec.mesh ? part : part_with_nodes(wall, mesh);
}

// For each vertex of the caller's mesh, the node of the wall's mesh, which was welded once more.
const std::vector<int> &node_of_vertex(lsdcd_wall &wall, int mesh)
{
  std::vector<std::vector<int>> &all = wall.node_of_vertex;
  if (all.empty()) all.resize(wall.in->meshes().size());
  std::vector<int> &nodes = all[static_cast<std::size_t>(mesh)];
  if (!nodes.empty()) return nodes;
  const MeshPart &part = part_that_deforms(wall, mesh);
  std::vector<Vec3> places;
  for (const Vec3 &x : part.spec.mesh->vertices) places.push_back(part.spec.placement.apply(x));
  const std::vector<Vec3> &at = part.grid.mesh()->vertices;
  std::vector<int> numbers(at.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<int> found = vertices_at(places, at, numbers);
  std::vector<char> taken(at.size(), 0);
  for (std::size_t k = 0; k < found.size(); k++)
    if (found[k] == kNoVertex || taken[found[k]]++)
      throw ApiError(LSDCD_ERROR_INPUT, "vertex " + std::to_string(k) + " of mesh '" +
                                            part.spec.name +
                                            "' is placed where another is: its placement shrinks "
                                            "them to one");
  nodes = std::move(found);
  return nodes;
}

// Is an array, of three numbers a vertex, in the memory of a GPU alone? Throws where the wall computes elsewhere.
bool is_on_gpu(const lsdcd_wall &wall, const double *array, const char *name)
{
  need(array, name);
  if (!DeviceMemory().only_there(array)) return false;
  if (!wall.gpu)
    throw ApiError(LSDCD_ERROR_DEVICE, std::string("the array `") + name +
                                           "` is in a GPU's memory: make the wall with device "
                                           "LSDCD_CUDA, or copy it to the host");
  try {
    wall.gpu->check(array, name, "the wall");
  } catch (const InputError &e) {
    throw ApiError(LSDCD_ERROR_DEVICE,
                   std::string(e.what()) + ": nodes are where the arrays of spheres are");
  }
  return true;
}

// The first n numbers of an array, where a host reads them; `copy` has them if they are on a GPU.
const double *on_host(const lsdcd_wall &wall, const double *array, bool on_gpu, std::size_t n,
                      std::vector<double> &copy)
{
  if (!on_gpu) return array;
  copy.resize(n);
  wall.gpu->copy_out(array, copy.data(), n * sizeof(double));
  return copy.data();
}

std::vector<Real> in_order_of_nodes(const double *given, const std::vector<int> &nodes,
                                    const char *name)
{
  std::vector<Real> out(3 * nodes.size());
  for (std::size_t k = 0; k < nodes.size(); k++)
    for (int d = 0; d < 3; d++) {
      const double number = given[3 * k + d];
      if (!std::isfinite(number)) checked_number(number, element(name, 3 * k + d));    // throws
      out[3 * static_cast<std::size_t>(nodes[k]) + d] = number;
    }
  return out;
}

void in_order_of_vertices(const lsdcd_wall &wall, const Real *of_nodes,
                          const std::vector<int> &nodes, double *to, bool on_gpu)
{
  std::vector<double> copy(on_gpu ? 3 * nodes.size() : 0);
  double *out = on_gpu ? copy.data() : to;
  for (std::size_t k = 0; k < nodes.size(); k++)
    for (int d = 0; d < 3; d++)
      out[3 * k + d] = of_nodes[3 * static_cast<std::size_t>(nodes[k]) + d];
  if (on_gpu) wall.gpu->copy_in(out, to, copy.size() * sizeof(double));
}

}    // namespace

namespace lsdcd {

void note_vertices(lsdcd_wall &wall)
{
  for (const MeshPart &part : wall.in->meshes())
    if (part.wear && part.spec.mesh) node_of_vertex(wall, part.index);
}

}    // namespace lsdcd

extern "C" {

int lsdcd_wall_set_nodes(lsdcd_wall *wall, int mesh, const double *positions,
                         const double *velocities)
{
  return guard_wall(wall, [&] {
    part_with_nodes(*wall, mesh);
    const std::vector<int> &nodes = node_of_vertex(*wall, mesh);
    const bool on_gpu = is_on_gpu(*wall, positions, "positions");
    if (velocities && is_on_gpu(*wall, velocities, "velocities") != on_gpu)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "`positions` and `velocities` are in different memory: one is on the host, "
                     "the other on a GPU");
    const bool is_alone = wall->caller.is_alone();
    if (on_gpu && is_alone && wall->in->set_nodes_in_place(mesh, positions, velocities, nodes))
      return;
    std::vector<double> copies[2];
    const auto ordered = [&](const double *given, const char *name, std::vector<double> &copy) {
      return in_order_of_nodes(on_host(*wall, given, on_gpu, 3 * nodes.size(), copy), nodes, name);
    };
    const std::vector<Real> x = ordered(positions, "positions", copies[0]);
    std::vector<Real> v;
    if (velocities) v = ordered(velocities, "velocities", copies[1]);
    wall->in->set_nodes(mesh, x.data(), velocities ? v.data() : nullptr);
    if (is_alone) return;
    wall->poses.add(mesh, x);
    wall->poses.add(mesh, v);
  });
}

int lsdcd_wall_get_node_count(lsdcd_wall *wall, int mesh, size_t *count)
{
  return guard_wall(wall, [&] {
    need(count, "count");
    part_that_deforms(*wall, mesh);
    *count = node_of_vertex(*wall, mesh).size();
  });
}

int lsdcd_wall_get_nodes(lsdcd_wall *wall, int mesh, double *positions)
{
  return guard_wall(wall, [&] {
    const MeshPart &part = part_that_deforms(*wall, mesh);
    const bool on_gpu = is_on_gpu(*wall, positions, "positions");
    std::vector<Vec3> at = part.mesh()->vertices;
    if (!part.nodes)
      for (Vec3 &x : at) x = part.motion.pose().to_box(x);
    in_order_of_vertices(*wall, &at[0].x, node_of_vertex(*wall, mesh), positions, on_gpu);
  });
}

int lsdcd_wall_get_node_forces(lsdcd_wall *wall, int mesh, double *forces)
{
  return guard_wall(wall, [&] {
    part_with_nodes(*wall, mesh);
    const bool on_gpu = is_on_gpu(*wall, forces, "forces");
    const std::vector<int> &nodes = node_of_vertex(*wall, mesh);
    if (on_gpu && wall->caller.is_alone() && wall->in->put_node_forces(mesh, forces, nodes)) return;
    tell_late(*wall);
    in_order_of_vertices(*wall, wall->in->node_forces(mesh).data(), nodes, forces, on_gpu);
  });
}

}    // extern "C"
