// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/orient_faces.h"

#include "geometry/primitive_distance.h"
#include "geometry/solid_angle.h"
#include "mesh/box.h"
#include "mesh/box_tree.h"
#include "mesh/face_plane.h"
#include "mesh/measure_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {

namespace {

struct Part {
  std::vector<int> faces;
  Box box;
  Real area = 0, turned_area = 0, volume = 0;    // volume: as it is turned, in units of the box
  bool closed = false, one_sided = false;

  bool is_shell() const { return closed && !one_sided; }
};

Real diagonal(const Box &box)
{
  return std::hypot(box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z);
}

bool holds(const Box &outer, const Box &inner)
{
  for (int k = 0; k < 3; k++)
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  return true;
}

constexpr int kNone = -1;

// Of the faces at an edge, the next one when `face` turns about the edge towards its back.
int next_behind(const WeldedMesh &mesh, int edge, int face)
{
  const Vec3 &at = mesh.vertices[mesh.edges[edge][0]];
  const auto corner = [&](int f, int k) -> const Vec3 & { return mesh.vertices[mesh.faces[f][k]]; };
  // The corner across the edge, from one of its ends; what that has along the edge does not count below.
  const auto across = [&](int f) {
    int k = 0;
    while (mesh.face_edges[f][k] != edge) ++k;
    return corner(f, (k + 2) % 3) - at;
  };
  const Vec3 along = mesh.vertices[mesh.edges[edge][1]] - at, axis = (1 / norm(along)) * along;
  const Vec3 behind = -face_plane(corner(face, 0), corner(face, 1), corner(face, 2)).normal;
  // Into the face, square to the edge.
  const Vec3 side = cross(axis, behind), into = dot(side, across(face)) < 0 ? -side : side;
  int next = kNone;
  Real least = 3 * kPi;
  for (int i = mesh.edge_first[edge]; i < mesh.edge_first[edge + 1]; i++) {
    const int f = mesh.edge_face[i];
    if (f == face) continue;
    Real angle = std::atan2(dot(across(f), behind), dot(across(f), into));
    if (angle <= 0) angle += 2 * kPi;
    if (angle >= least) continue;
    least = angle;
    next = f;
  }
  return next;
}

// The face with which a face goes on at an edge; kNone: that is not clear. Where solids touch along an edge it is the one
// across the solid behind it.
int neighbour(const WeldedMesh &mesh, int edge, int face)
{
  const int begin = mesh.edge_first[edge], n = mesh.edge_first[edge + 1] - begin;
  if (n == 2)
    return mesh.edge_face[begin] == face ? mesh.edge_face[begin + 1] : mesh.edge_face[begin];
  if (n % 2 == 1) return kNone;
  const int other = next_behind(mesh, edge, face);
  return next_behind(mesh, edge, other) == face ? other : kNone;
}

// Is each of these there an even number of times?
bool come_in_pairs(std::vector<int> edges)
{
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); i += 2)
    if (i + 1 == edges.size() || edges[i] != edges[i + 1]) return false;
  return true;
}

// The part that a face belongs to, turned as that face is.
Part gather(const WeldedMesh &mesh, int first, std::vector<char> &seen, std::vector<char> &turned)
{
  Part part;
  part.faces = {first};
  seen[first] = 1;
  std::vector<int> ends;    // where it is not clear how it goes on
  for (std::size_t i = 0; i < part.faces.size(); i++) {
    const int f = part.faces[i];
    for (const int e : mesh.face_edges[f]) {
      const int g = neighbour(mesh, e, f);
      if (g == kNone) {
        ends.push_back(e);
        continue;
      }
      const char wanted = turned[f] != (runs_along(mesh, f, e) == runs_along(mesh, g, e));
      if (!seen[g]) {
        seen[g] = 1;
        turned[g] = wanted;
        part.faces.push_back(g);
      } else if (turned[g] != wanted) {
        part.one_sided = true;
      }
    }
  }
  part.closed = come_in_pairs(std::move(ends));
  return part;
}

void measure(const WeldedMesh &mesh, const std::vector<char> &turned, Part &part)
{
  const auto corner = [&](int f, int k) -> const Vec3 & { return mesh.vertices[mesh.faces[f][k]]; };
  part.box = {corner(part.faces[0], 0), corner(part.faces[0], 0)};
  for (const int f : part.faces)
    for (int k = 0; k < 3; k++) extend(part.box, corner(f, k));
  const Real unit = 1 / diagonal(part.box);
  const Vec3 middle = 0.5 * part.box.lo + 0.5 * part.box.hi;
  for (const int f : part.faces) {
    const FacePlane plane = face_plane(corner(f, 0), corner(f, 1), corner(f, 2));
    const Real area = plane.area * unit * unit;
    part.area += area;
    if (turned[f]) part.turned_area += area;
    part.volume +=
        (turned[f] ? -area : area) * dot(plane.normal, unit * (corner(f, 0) - middle)) / 3;
  }
}

// How many times a closed part winds around a point; a half if the point is on it.
Real turns_round(const WeldedMesh &mesh, const Part &part, const std::vector<char> &turned,
                 const Vec3 &x)
{
  Real sum = 0;
  for (const int f : part.faces) {
    const auto &v = mesh.faces[f];
    const Triangle facet = {{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}};
    sum += (turned[f] ? -1 : 1) * half_solid_angle(facet, x).value();
  }
  return sum / (2 * kPi);
}

Real distance(const Triangle &t, const Vec3 &x)
{
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  Real least = std::numeric_limits<Real>::max();
  bool over = true;
  for (int k = 0; k < 3; k++) {
    const Vec3 &a = t[k], &b = t[(k + 1) % 3];
    over = over && dot(cross(normal, b - a), x - a) > 0;
    least = std::fmin(least, segment_distance(a, b, x));
  }
  return over ? std::fabs(dot(normal, x - t[0])) / norm(normal) : least;
}

// Is a point on a part, but for rounding of coordinates in single precision?
bool is_on(const WeldedMesh &mesh, const Part &part, const Vec3 &x)
{
  const Real near = 1e-6 * diagonal(part.box);
  return std::any_of(part.faces.begin(), part.faces.end(), [&](int f) {
    const auto &v = mesh.faces[f];
    return distance({{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}}, x) <= near;
  });
}

// Is one shell inside the other? A point of it that is not on the other decides.
bool is_inside(const WeldedMesh &mesh, const Part &inner, const Part &outer,
               const std::vector<char> &turned)
{
  if (!holds(outer.box, inner.box)) return false;
  // Shells that touch at so many facets, all over the shell, enclose nothing between them.
  const std::size_t n = inner.faces.size(), tries = std::min<std::size_t>(n, 16);
  for (std::size_t i = 0; i < tries; i++) {
    const auto &v = mesh.faces[inner.faces[i * n / tries]];
    const Vec3 x = (1.0 / 3) * (mesh.vertices[v[0]] + mesh.vertices[v[1]] + mesh.vertices[v[2]]);
    if (!is_on(mesh, outer, x)) return std::fabs(turns_round(mesh, outer, turned, x)) > 0.5;
  }
  return false;
}

std::vector<Part> parts_of(const WeldedMesh &mesh, std::vector<char> &turned)
{
  std::vector<char> seen(mesh.faces.size(), 0);
  std::vector<Part> parts;
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    if (!seen[f]) parts.push_back(gather(mesh, static_cast<int>(f), seen, turned));
  return parts;
}

// A volume that is only rounding has no inside.
bool has_volume(const Part &part)
{
  return part.is_shell() && std::fabs(part.volume) > 1e-12 * part.area;
}

// Does each part bound a cavity? It does if an odd number of others encloses it.
std::vector<char> find_cavities(const WeldedMesh &mesh, const std::vector<Part> &parts,
                                const std::vector<char> &turned)
{
  std::vector<std::size_t> solid;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < parts.size(); i++)
    if (has_volume(parts[i])) {
      solid.push_back(i);
      boxes.push_back(parts[i].box);
    }
  const BoxTree tree(boxes);
  std::vector<char> cavity(parts.size(), 0);
  for (const std::size_t i : solid)
    tree.visit([&](const Box &box) { return holds(box, parts[i].box); },
               [&](int j) {
                 if (solid[j] != i && is_inside(mesh, parts[i], parts[solid[j]], turned))
                   cavity[i] = !cavity[i];
               });
  return cavity;
}

}    // namespace

OrientedFaces orient_faces(const WeldedMesh &mesh)
{
  OrientedFaces out;
  out.turned.assign(mesh.faces.size(), 0);
  std::vector<Part> parts = parts_of(mesh, out.turned);
  for (Part &part : parts) measure(mesh, out.turned, part);
  const auto turn = [&](Part &part) {
    for (const int f : part.faces) out.turned[f] = !out.turned[f];
  };
  const std::vector<char> cavities = find_cavities(mesh, parts, out.turned);
  for (std::size_t i = 0; i < parts.size(); i++) {
    Part &part = parts[i];
    const bool cavity = cavities[i];
    out.shells += part.is_shell();
    out.cavities += cavity;
    out.one_sided += part.one_sided;
    if (has_volume(part) ? (part.volume > 0) == cavity : part.turned_area > 0.5 * part.area)
      turn(part);
  }
  for (const char t : out.turned) out.faces += t;
  return out;
}

ShellFaults faults_of_shells(const WeldedMesh &mesh)
{
  ShellFaults faults;
  std::vector<char> turned(mesh.faces.size(), 0);
  std::vector<Part> parts = parts_of(mesh, turned);
  if (parts.size() < 2) return faults;
  for (Part &part : parts) measure(mesh, turned, part);
  const std::vector<char> cavities = find_cavities(mesh, parts, turned);
  std::size_t out = 0, in = 0;
  for (std::size_t i = 0; i < parts.size(); i++)
    if (has_volume(parts[i]))
      ((parts[i].volume > 0) != bool(cavities[i]) ? out : in) += parts[i].faces.size();
  faults.inverted_faces = std::min(out, in);
  std::vector<std::vector<int>> shells;
  for (Part &part : parts) shells.push_back(std::move(part.faces));
  faults.meetings = shells_meet(mesh, shells);
  return faults;
}

}    // namespace lsdcd
