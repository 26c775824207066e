// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh of a wall whose nodes the caller moves, or whose vertices wear moves: lsdcd_wall_set_nodes,
// lsdcd_wall_get_nodes, lsdcd_wall_get_node_forces, lsdcd_wall_get_node_count.
#include "api/device_memory.h"
#include "api/refusals.h"
#include "api/wall_handle.h"
#include "base/input_words.h"
#include "mesh/weld_map.h"

#include <algorithm>
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
  if (part.nodes()) return part;
  throw ApiError(LSDCD_ERROR_ARGUMENT,
                 "mesh " + std::to_string(mesh) + ", '" + part.spec.name +
                     "', has no nodes that move: say nodes caller when the wall is made");
}

// Returns the mesh, which has nodes that move or is moved by wear; another one is an error.
const MeshPart &part_that_deforms(const lsdcd_wall &wall, int mesh)
{
  check_mesh(wall, mesh, 0);
  const MeshPart &part = wall.in->meshes()[static_cast<std::size_t>(mesh)];
  return part.surface->changes() ? part : part_with_nodes(wall, mesh);
}

// Of a mesh by its file, of which the program has no vertices, rows are those of the welded mesh. One of the program was welded once
// more by the wall.
NodeRows node_rows_of(const MeshPart &part)
{
  if (!part.spec.mesh) {
    NodeRows rows;
    rows.node.resize(part.grid.mesh()->vertices.size());
    std::iota(rows.node.begin(), rows.node.end(), 0);
    rows.first_row = rows.node;
    return rows;
  }
  std::vector<Vec3> places;
  for (const Vec3 &x : part.spec.mesh->vertices) places.push_back(part.spec.placement.apply(x));
  const std::vector<Vec3> &at = part.grid.mesh()->vertices;
  std::vector<int> numbers(at.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const std::vector<int> node_of_welded = vertices_at(places, at, numbers);
  std::vector<char> taken(at.size(), 0);
  for (std::size_t k = 0; k < node_of_welded.size(); k++)
    if (node_of_welded[k] == kNoVertex || taken[node_of_welded[k]]++)
      throw ApiError(LSDCD_ERROR_INPUT, "vertex " + std::to_string(k) + " of mesh '" +
                                            part.spec.name +
                                            "' is placed where another is: its placement shrinks "
                                            "them to one");
  NodeRows rows;
  rows.first_row.assign(at.size(), kNoVertex);
  for (const int welded : *part.spec.welded_vertex) {
    const int row = static_cast<int>(rows.node.size()),
              node = welded == kNoVertex ? kNoVertex : node_of_welded[welded];
    rows.node.push_back(node);
    if (node != kNoVertex && rows.first_row[node] == kNoVertex)
      rows.first_row[node] = row;
    else
      rows.are_one_each = false;
  }
  return rows;
}

const NodeRows &node_rows(const lsdcd_wall &wall, int mesh)
{
  part_that_deforms(wall, mesh);
  return wall.node_rows[static_cast<std::size_t>(mesh)];
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
const double *on_cpu(const lsdcd_wall &wall, const double *array, bool on_gpu, std::size_t n,
                     std::vector<double> &copy)
{
  if (!on_gpu) return array;
  copy.resize(n);
  wall.gpu->copy_out(array, copy.data(), n * sizeof(double));
  return copy.data();
}

// Of several vertices that were welded to one the first counts.
std::vector<Real> in_order_of_nodes(const double *given, const NodeRows &rows, const char *name)
{
  std::vector<Real> out(3 * rows.first_row.size());
  for (std::size_t row = 0; row < rows.node.size(); row++) {
    const int node = rows.node[row];
    if (node == kNoVertex) continue;
    for (int d = 0; d < 3; d++) {
      const double number = given[3 * row + d];
      if (!std::isfinite(number)) checked_number(number, element(name, 3 * row + d));    // throws
      if (rows.first_row[node] == static_cast<int>(row))
        out[3 * static_cast<std::size_t>(node) + d] = number;
    }
  }
  return out;
}

// Throws where vertices that were welded to one go apart, as a crack would open.
void check_welded(const double *given, const NodeRows &rows)
{
  if (rows.are_one_each) return;
  const auto at = [given](std::size_t row) {
    return Vec3{given[3 * row], given[3 * row + 1], given[3 * row + 2]};
  };
  Box box = {at(static_cast<std::size_t>(rows.first_row[0])),
             at(static_cast<std::size_t>(rows.first_row[0]))};
  for (const int row : rows.first_row) {
    const Vec3 x = at(static_cast<std::size_t>(row));
    box.lo = {std::min(box.lo.x, x.x), std::min(box.lo.y, x.y), std::min(box.lo.z, x.z)};
    box.hi = {std::max(box.hi.x, x.x), std::max(box.hi.y, x.y), std::max(box.hi.z, x.z)};
  }
  constexpr Real kOfExtents = 0.01;    // welds are much shorter
  for (std::size_t row = 0; row < rows.node.size(); row++) {
    if (rows.node[row] == kNoVertex) continue;
    const auto first = static_cast<std::size_t>(rows.first_row[rows.node[row]]);
    const Real apart = norm(at(row) - at(first));
    if (apart > kOfExtents * norm(box.hi - box.lo))
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "nodes " + std::to_string(first) + " and " + std::to_string(row) +
                         " (from 0) are one vertex of the mesh, and go " + number_text(apart) +
                         " apart: give both the same place, or make the mesh "
                         "with vertices that are not welded");
  }
}

// Places: vertices that were welded to one have the same, those of no triangle none. Forces: the first of them has it, so
// that their sum is that of the mesh; the others have 0.
enum class OfRows { places, forces };

void in_order_of_rows(const lsdcd_wall &wall, const Real *of_nodes, const NodeRows &rows,
                      OfRows what, double *to, bool on_gpu)
{
  std::vector<double> copy(on_gpu ? 3 * rows.node.size() : 0);
  double *out = on_gpu ? copy.data() : to;
  for (std::size_t row = 0; row < rows.node.size(); row++)
    for (int d = 0; d < 3; d++) {
      const int node = rows.node[row];
      double &number = out[3 * row + d];
      if (node == kNoVertex)
        number = what == OfRows::places ? NAN : 0;
      else if (what == OfRows::places || rows.first_row[node] == static_cast<int>(row))
        number = of_nodes[3 * static_cast<std::size_t>(node) + d];
      else
        number = 0;
    }
  if (on_gpu) wall.gpu->copy_in(out, to, copy.size() * sizeof(double));
}

}    // namespace

namespace lsdcd {

void note_vertices(lsdcd_wall &wall)
{
  wall.node_rows.resize(wall.in->meshes().size());
  for (const MeshPart &part : wall.in->meshes()) {
    if (!part.surface->changes()) continue;
    NodeRows &rows = wall.node_rows[static_cast<std::size_t>(part.index)];
    rows = node_rows_of(part);
    if (part.nodes()) part.nodes()->rows = rows.first_row;
  }
}

}    // namespace lsdcd

extern "C" {

int lsdcd_wall_set_nodes(lsdcd_wall *wall, int mesh, const double *positions,
                         const double *velocities)
{
  return guard_wall(wall, [&] {
    part_with_nodes(*wall, mesh);
    const NodeRows &rows = node_rows(*wall, mesh);
    const bool on_gpu = is_on_gpu(*wall, positions, "positions");
    if (velocities && is_on_gpu(*wall, velocities, "velocities") != on_gpu)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "`positions` and `velocities` are in different memory: one is on the host, "
                     "the other on a GPU");
    const bool is_alone = wall->caller.is_alone();
    if (on_gpu && is_alone && rows.are_one_each) {
      wall->in->set_nodes_in_place(mesh, positions, velocities, rows.node);
      return;
    }
    std::vector<double> copies[2];
    const auto ordered = [&](const double *given, const char *name, std::vector<double> &copy) {
      return in_order_of_nodes(on_cpu(*wall, given, on_gpu, 3 * rows.node.size(), copy), rows,
                               name);
    };
    const std::vector<Real> x = ordered(positions, "positions", copies[0]);
    check_welded(on_gpu ? copies[0].data() : positions, rows);
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
    *count = node_rows(*wall, mesh).node.size();
  });
}

int lsdcd_wall_get_nodes(lsdcd_wall *wall, int mesh, double *positions)
{
  return guard_wall(wall, [&] {
    const MeshPart &part = part_that_deforms(*wall, mesh);
    const bool on_gpu = is_on_gpu(*wall, positions, "positions");
    std::vector<Vec3> at = part.mesh()->vertices;
    if (!part.nodes())
      for (Vec3 &x : at) x = part.pose().to_box(x);
    in_order_of_rows(*wall, &at[0].x, node_rows(*wall, mesh), OfRows::places, positions, on_gpu);
  });
}

int lsdcd_wall_get_node_forces(lsdcd_wall *wall, int mesh, double *forces)
{
  return guard_wall(wall, [&] {
    part_with_nodes(*wall, mesh);
    const bool on_gpu = is_on_gpu(*wall, forces, "forces");
    const NodeRows &rows = node_rows(*wall, mesh);
    if (on_gpu && wall->caller.is_alone() && rows.are_one_each &&
        wall->in->put_node_forces(mesh, forces, rows.node))
      return;
    tell_late(*wall);
    in_order_of_rows(*wall, wall->in->node_forces(mesh).data(), rows, OfRows::forces, forces,
                     on_gpu);
  });
}

}    // extern "C"
