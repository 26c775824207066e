// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/mesh_features.h"

#include "base/array_list.h"
#include "base/input_error.h"
#include "base/quad.h"
#include "mesh/moving_records.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace lsdcd {

namespace {

// Vectors in a wider type: unit normals of slivers lose one digit for each power
// of ten of their aspect ratio, and double has none to spare.
template <class T>
struct Wide {
  T x, y, z;
};
template <class T>
Wide<T> difference(const Vec3 &a, const Vec3 &b)
{
  return {T(a.x) - T(b.x), T(a.y) - T(b.y), T(a.z) - T(b.z)};
}
template <class T>
T dot(const Wide<T> &a, const Wide<T> &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Wide<T> cross(const Wide<T> &a, const Wide<T> &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T root(T a)
{
  T r = std::sqrt(static_cast<long double>(a));
  return r > 0 ? (r + a / r) / 2 : r;    // one Newton step takes 64 bits to 113
}
template <class T>
Wide<T> unit(const Wide<T> &a)
{
  // Scaled first, as squares of lengths near 1e-200 or 1e200 leave the range.
  T m = a.x < 0 ? -a.x : a.x;
  for (T c : {a.y, a.z}) {
    if (c < 0) c = -c;
    if (c > m) m = c;
  }
  const Wide<T> s = {a.x / m, a.y / m, a.z / m};
  const T n = root<T>(dot(s, s));
  return {s.x / n, s.y / n, s.z / n};
}
template <class T>
Vec3 narrow(const Wide<T> &a)
{
  return {static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z)};
}

template <class T>
FaceRecord face_record(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Wide<T> edge[3] = {difference<T>(b, a), difference<T>(c, b), difference<T>(a, c)};
  const Wide<T> normal = unit(cross(edge[0], edge[1]));
  FaceRecord f;
  f.anchor = a;
  f.normal = narrow(normal);
  Wide<T> inward[3];
  for (int k = 0; k < 3; k++) {
    inward[k] = cross(normal, unit(edge[k]));
    f.inward[k] = narrow(inward[k]);
  }
  f.height = static_cast<Real>(-dot(inward[1], edge[0]));
  return f;
}

// Thinner than this, long double's spare bits do not cover the loss.
constexpr Real kSliver = 1e-3;

// Vertices that hold no contact share this direction: no point is on the right side of it. Most
// vertices of a smooth mesh are such, and directions are most of the memory of a vertex.
constexpr Real kNoNumber = std::numeric_limits<Real>::quiet_NaN();
constexpr Vec3 kNoDirection = {kNoNumber, kNoNumber, kNoNumber};

// How many faces an edge has past the second.
std::size_t n_past_second(const WeldedMesh &mesh, std::size_t edge)
{
  const int n = mesh.edge_first[edge + 1] - mesh.edge_first[edge];
  return n > 2 ? static_cast<std::size_t>(n - 2) : 0;
}

// `others` gets the inward normals of faces past the second; `more` of the record is left to the caller.
EdgeRecord edge_record(const WeldedMesh &mesh, const std::vector<FaceRecord> &faces, std::size_t i,
                       Vec3 *others)
{
  const auto &ends = mesh.edges[i];
  EdgeRecord e = make_segment(mesh.vertices[ends[0]], mesh.vertices[ends[1]]);
  put_inward(topology_of(mesh), faces.data(), static_cast<std::uint32_t>(i), e, others);
  return e;
}

void put_outward_of_vertices(const WeldedMesh &mesh, MeshFeatures &out)
{
  out.vertex_out.assign(mesh.vertices.size(), Vec3{0, 0, 0});
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    for (int k = 0; k < 3; k++) {
      const auto &c = mesh.faces[f];
      const Real angle = corner_angle(mesh.vertices[c[k]], mesh.vertices[c[(k + 1) % 3]],
                                      mesh.vertices[c[(k + 2) % 3]]);
      out.vertex_out[c[k]] += angle * out.faces[f].normal;
    }
}

void add_primitives(const WeldedMesh &mesh, MeshFeatures &out)
{
  std::vector<bool> edge_acts(mesh.edges.size(), false), vertex_acts(mesh.vertices.size(), false),
      has_face(mesh.vertices.size(), false);
  for (FeatureCode code : out.contact_features) {
    if (feature_kind(code) == FeatureKind::edge) edge_acts[feature_index(code)] = true;
    if (feature_kind(code) == FeatureKind::vertex) vertex_acts[feature_index(code)] = true;
  }
  out.face_parts.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); f++) {
    out.face_parts.push_back(
        parts_of(topology_of(mesh), static_cast<std::uint32_t>(f), edge_acts, vertex_acts));
    for (const int vertex : mesh.faces[f]) has_face[vertex] = true;
  }
  for (FeatureCode code : out.contact_features) {
    const std::uint32_t i = feature_index(code);
    const FeatureKind kind = feature_kind(code);
    if (kind == FeatureKind::face || (kind == FeatureKind::edge && out.edges[i].n_faces == 0) ||
        (kind == FeatureKind::vertex && !has_face[i]))
      out.primitives.push_back(code);
  }
}

void check_numbers(const WeldedMesh &mesh)
{
  if (mesh.faces.size() > kMaxFeatures || mesh.edges.size() > kMaxFeatures ||
      mesh.vertices.size() > kMaxFeatures)
    throw InputError(mesh.source + ": " + std::to_string(mesh.edges.size()) +
                     " edges are more than the " + std::to_string(kMaxFeatures) +
                     " that can be used; use a coarser mesh");
}

}    // namespace

MeshTopologyView topology_of(const WeldedMesh &mesh)
{
  const auto first = [](const auto &rows) { return rows.empty() ? nullptr : rows[0].data(); };
  return {first(mesh.faces),
          first(mesh.face_edges),
          first(mesh.edges),
          mesh.edge_first.data(),
          mesh.edge_face.data(),
          mesh.vertex_first.data(),
          mesh.vertex_edge.data(),
          static_cast<std::uint32_t>(mesh.faces.size()),
          static_cast<std::uint32_t>(mesh.edges.size()),
          static_cast<std::uint32_t>(mesh.vertices.size())};
}

EdgeRecord make_segment(const Vec3 &a, const Vec3 &b)
{
  const Wide<long double> d = difference<long double>(b, a);
  EdgeRecord e = {};
  e.anchor = a;
  e.direction = narrow(unit(d));
  e.length = static_cast<Real>(root<long double>(dot(d, d)));
  return e;
}

FaceRecord make_face_record(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const FaceRecord f = face_record<long double>(a, b, c);
  const Real longest =
      std::sqrt(std::fmax(norm_sq(b - a), std::fmax(norm_sq(c - b), norm_sq(a - c))));
  const Real shortest_height = f.height * norm(c - b) / longest;
  if (shortest_height < kSliver * longest) return face_record<Quad>(a, b, c);
  return f;
}

MeshFeaturesView MeshFeatures::view() const
{
  MeshFeaturesView v = {};
  point_to(v, *this);
  v.images.n_faces = static_cast<std::uint32_t>(images.n_faces);
  v.images.n_edges = static_cast<std::uint32_t>(images.n_edges);
  v.images.n_vertices = static_cast<std::uint32_t>(images.n_vertices);
  return v;
}

MeshFeatures make_features(const WeldedMesh &mesh, bool with_sides, bool with_primitives)
{
  const std::size_t n_faces = mesh.faces.size(), n_edges = mesh.edges.size(),
                    n_vertices = mesh.vertices.size();
  check_numbers(mesh);
  const MeshTopologyView topology = topology_of(mesh);

  MeshFeatures out;
  out.images = mesh.images;
  out.faces.reserve(n_faces);
  out.face_vertex.reserve(n_faces);
  for (const auto &f : mesh.faces) {
    out.faces.push_back(
        make_face_record(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]));
    out.face_vertex.push_back({{f[0], f[1], f[2]}});
    out.contact_features.push_back(
        feature_code(FeatureKind::face, static_cast<std::uint32_t>(out.faces.size() - 1)));
  }

  out.edges.reserve(n_edges);
  out.edge_vertex.reserve(n_edges);
  if (with_sides) out.edge_out.reserve(n_edges);
  std::size_t n_used = 0;    // up to the last edge that can hold a contact
  for (std::size_t i = 0; i < n_edges; i++) {
    const auto k = static_cast<std::uint32_t>(i);
    const std::size_t more = out.edge_inward.size();
    out.edge_inward.resize(more + n_past_second(mesh, i));
    EdgeRecord e = edge_record(mesh, out.faces, i, out.edge_inward.data() + more);
    e.more = static_cast<std::uint32_t>(more);
    out.edges.push_back(e);
    out.edge_vertex.push_back({{mesh.edges[i][0], mesh.edges[i][1]}});
    if (with_sides) out.edge_out.push_back(outward_of_edge(topology, out.faces.data(), k));
    if (is_flat(e)) continue;
    out.contact_features.push_back(feature_code(FeatureKind::edge, static_cast<std::uint32_t>(i)));
    n_used = i + 1;
  }

  out.vertices.reserve(n_vertices);
  out.vertex_direction.push_back(kNoDirection);
  for (std::size_t i = 0; i < n_vertices; i++) {
    const auto k = static_cast<std::uint32_t>(i);
    VertexRecord v = {mesh.vertices[i], static_cast<std::uint32_t>(out.vertex_direction.size()),
                      n_edges_at(topology, k)};
    out.vertex_direction.resize(v.first + v.count);
    put_directions(topology, out.edges.data(), k, out.vertex_direction.data() + v.first);
    if (is_covered(topology, out.edges.data(), k, out.vertex_direction.data() + v.first)) {
      out.vertex_direction.resize(v.first);
      v.first = 0;
      v.count = 1;
    } else {
      out.contact_features.push_back(
          feature_code(FeatureKind::vertex, static_cast<std::uint32_t>(i)));
    }
    out.vertices.push_back(v);
  }
  out.edges.resize(n_used);
  out.edges.shrink_to_fit();
  if (with_sides) {
    out.edge_out.resize(n_used);
    put_outward_of_vertices(mesh, out);
  }
  if (with_primitives) add_primitives(mesh, out);
  return out;
}

// Thinner than the rounding of its corners a face has no normal. Welding makes the same test.
bool has_area(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  Real most = 0;
  for (const Vec3 *x : {&a, &b, &c})
    for (int d = 0; d < 3; d++) most = std::fmax(most, std::fabs((*x)[d]));
  const Real longest =
      std::sqrt(std::fmax(norm_sq(b - a), std::fmax(norm_sq(c - b), norm_sq(a - c))));
  return norm(cross(b - a, c - a)) > std::fmax(8 * kRoundoff * most, 1e-14 * longest) * longest;
}

void throw_without_area(const WeldedMesh &mesh, int face)
{
  const auto &c = mesh.faces[face];
  throw InputError(
      "face " + std::to_string(face) + " of '" + mesh.source + "', with the nodes " +
      std::to_string(c[0]) + ", " + std::to_string(c[1]) + " and " + std::to_string(c[2]) +
      " (all from 0), has no area any more: its nodes lie in a line or are no numbers, "
      "and it has no normal; give the nodes more stiffness or damping, or a shorter "
      "timestep");
}

MeshFeatures make_moving_features(const WeldedMesh &mesh, bool with_sides)
{
  MeshFeatures out;
  const std::size_t n_faces = mesh.faces.size(), n_edges = mesh.edges.size(),
                    n_vertices = mesh.vertices.size();
  check_numbers(mesh);
  out.faces.resize(n_faces);
  out.edges.resize(n_edges);
  std::uint32_t more = 0;
  for (std::size_t i = 0; i < n_edges; i++) {
    const auto &ends = mesh.edges[i];
    out.edge_vertex.push_back({{ends[0], ends[1]}});
    out.edges[i] = make_segment(mesh.vertices[ends[0]], mesh.vertices[ends[1]]);
    out.edges[i].more = more;
    more += static_cast<std::uint32_t>(n_past_second(mesh, i));
  }
  out.edge_inward.resize(more);
  out.vertices.resize(n_vertices);
  out.vertex_direction.resize(mesh.vertex_edge.size());
  std::vector<bool> has_face(n_vertices, false);
  for (std::size_t f = 0; f < n_faces; f++) {
    const auto &c = mesh.faces[f];
    out.faces[f] = make_face_record(mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]);
    out.face_vertex.push_back({{c[0], c[1], c[2]}});
    out.primitives.push_back(feature_code(FeatureKind::face, static_cast<std::uint32_t>(f)));
    for (const int v : c) has_face[v] = true;
  }
  out.face_parts.resize(n_faces);
  if (with_sides) {
    out.edge_out.resize(n_edges);
    out.vertex_out.resize(n_vertices);
  }
  for (std::size_t i = 0; i < n_edges; i++)
    if (mesh.edge_first[i] == mesh.edge_first[i + 1])
      out.primitives.push_back(feature_code(FeatureKind::edge, static_cast<std::uint32_t>(i)));
  for (std::size_t i = 0; i < n_vertices; i++)
    if (!has_face[i])
      out.primitives.push_back(feature_code(FeatureKind::vertex, static_cast<std::uint32_t>(i)));
  // The rest as when nodes move, but here none does.
  std::vector<char> edge_acts(n_edges), vertex_acts(n_vertices);
  std::uint32_t n_parts = 0;
  const MovedMesh moved = {
      topology_of(mesh), moving_records(out.view(), edge_acts.data(), vertex_acts.data(), &n_parts),
      mesh.vertices.data(), mesh.vertices.data(), 0};
  for (std::uint32_t i = 0; i < n_edges; i++) move_edge(Warp<1>(), true, moved, i);
  for (std::uint32_t i = 0; i < n_vertices; i++) move_vertex(Warp<1>(), true, moved, i);
  for (std::uint32_t f = 0; f < n_faces; f++) put_parts(Warp<1>(), true, moved, f);
  return out;
}

MovingRecords moving_records(const MeshFeaturesView &of, char *edge_acts, char *vertex_acts,
                             std::uint32_t *n_parts)
{
  const auto own = [](const auto *records) {
    return const_cast<std::decay_t<decltype(*records)> *>(records);
  };
  return {own(of.faces),
          own(of.edges),
          own(of.vertices),
          own(of.edge_inward),
          own(of.vertex_direction),
          own(of.face_parts),
          own(of.edge_out),
          own(of.vertex_out),
          edge_acts,
          vertex_acts,
          n_parts};
}

}    // namespace lsdcd
