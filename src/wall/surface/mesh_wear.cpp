// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/surface/mesh_wear.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "mesh/meets_itself.h"
#include "wall/spec/mesh_name.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lsdcd {

namespace {

constexpr int kPerVertex = 4;    // numbers of pending_

// A face that has turned or shrunk so far in one move folds over, and one that has so little left of its first area
// has no normal soon.
constexpr Real kLeastOfMove = 0.5, kLeastOfFirst = 0.01;
// Normals around a vertex that cancel to less than this share of their areas give it no direction.
constexpr Real kLeastOfNormals = 0.1;

Vec3 normal_of(const WeldedMesh &mesh, const std::array<int, 3> &face)
{
  const Vec3 &a = mesh.vertices[face[0]];
  return cross(mesh.vertices[face[1]] - a, mesh.vertices[face[2]] - a);
}

// The volume between a surface and that with its vertices moved by u. On its way t from 0 to 1 a face with the edges e
// and f sweeps the mean of its u times
//
//   int_0^1 (e + t de) x (f + t df)/2 dt = (e x f + (e x df + de x f)/2 + de x df/3)/2.
//
// Each corner has its part with its sign. Where all signs are the same and the mesh is closed, the sum is exactly the
// difference of the volumes inside.
template <class Way>
long double swept(const WeldedMesh &mesh, const std::vector<Real> &sign, const Way &way)
{
  long double sum = 0;
  for (const auto &face : mesh.faces) {
    const Vec3 u[3] = {way(face[0]), way(face[1]), way(face[2])};
    if (norm_sq(u[0]) + norm_sq(u[1]) + norm_sq(u[2]) == 0) continue;
    const Vec3 &a = mesh.vertices[face[0]];
    const Vec3 e = mesh.vertices[face[1]] - a, f = mesh.vertices[face[2]] - a, de = u[1] - u[0],
               df = u[2] - u[0];
    const Vec3 area = Real(0.5) * (cross(e, f) + Real(0.5) * (cross(e, df) + cross(de, f)) +
                                   (1 / Real(3)) * cross(de, df));
    for (int k = 0; k < 3; k++)
      sum += static_cast<long double>(sign[face[k]]) * dot(u[k], area) / 3;
  }
  return sum;
}

}    // namespace

MeshWear::MeshWear(Host &host, const WallSpec &wall, int index, const MeshReport &report,
                   const WeldedMesh *mesh) :
    host_(host),
    wall_(wall), index_(index), pending_(kPerVertex * report.vertices, 0)
{
  if (report.misoriented_edges > 0 || report.two_sided_faces > 0)
    throw InputError(named(
        "wear cannot move this mesh, because neighbouring triangles are wound in opposite ways: "
        "its vertices have no side to move to; wind them alike with lsdcd repair"));
  run_collectively(host_, host_.is_first(), [&] {
    held_.assign(report.vertices, 0);
    // A hole would open between their corners.
    for (const auto &facet : facets_without_area(*mesh))
      for (const int v : facet) held_[v] = 1;
    for (const auto &face : mesh->faces) first_size_.push_back(norm(normal_of(*mesh, face)));
    meet_ = meeting_faces(*mesh);
  });
}

std::string MeshWear::named(const std::string &text) const
{
  return with_mesh_name(wall_, index_, text);
}

void MeshWear::add_at(int vertex, Real volume, const Vec3 &away)
{
  Real *at = pending_.data() + kPerVertex * static_cast<std::size_t>(vertex);
  at[0] += volume;
  for (int d = 0; d < 3; d++) at[1 + d] += volume * away[d];
}

// The corners of a face share what came off it evenly, and so do the ends of an edge.
void MeshWear::add(const std::vector<StepContact> &contacts, Real dt,
                   const MeshFeaturesView &features)
{
  const Real per_power = wall_.meshes[index_].wear_factor * wall_.wear.per_work * dt;
  for (const StepContact &r : contacts) {
    if (r.mesh != static_cast<std::uint32_t>(index_) || r.wear_power == 0) continue;
    const Real volume = per_power * r.wear_power, length = norm(r.arm);
    const Vec3 away = length > 0 ? (-1 / length) * r.arm : Vec3{0, 0, 0};
    const std::uint32_t k = feature_index(r.feature);
    if (feature_kind(r.feature) == FeatureKind::face)
      for (const std::int32_t v : features.face_vertex[k].v) add_at(v, volume / 3, away);
    else if (feature_kind(r.feature) == FeatureKind::edge)
      for (const std::int32_t v : features.edge_vertex[k].v) add_at(v, volume / 2, away);
    else
      add_at(static_cast<int>(k), volume, away);
  }
}

void MeshWear::hold(int vertex, int face, const WeldedMesh &mesh, std::int64_t step)
{
  held_[vertex] = 1;
  if (is_reported_) return;
  is_reported_ = true;
  report_ =
      "wear has come so far at step " + std::to_string(step) + " that facet " +
      std::to_string(mesh.face_facet[face] + 1) +
      " would fold over or cut another: its corners stay from now on. The same will hold for other "
      "facets, without another message. The volume that wears off there is counted as held back";
}

// A vertex goes along the sum of the areas around it, away from the spheres, by its volume over a third of that sum. To
// first order in the way that is the volume it removes.
MeshWear::Move MeshWear::plan(const WeldedMesh &mesh, Real factor, std::int64_t step)
{
  const std::size_t n = mesh.vertices.size();
  std::vector<Vec3> area(n, Vec3{0, 0, 0});
  std::vector<Real> size(n, 0);
  std::vector<int> some_face(n, -1);
  for (std::size_t f = 0; f < mesh.faces.size(); f++) {
    const Vec3 third = (1 / Real(6)) * normal_of(mesh, mesh.faces[f]);
    for (const int v : mesh.faces[f]) {
      area[v] += third;
      size[v] += norm(third);
      if (some_face[v] < 0) some_face[v] = static_cast<int>(f);
    }
  }
  Move to;
  to.direction.assign(n, Vec3{0, 0, 0});
  to.way.assign(n, 0);
  to.sign.assign(n, 0);
  for (std::size_t v = 0; v < n; v++) {
    const Real *p = pending_.data() + kPerVertex * v;
    if (p[0] == 0 || held_[v]) continue;
    const Real a = norm(area[v]);
    if (some_face[v] < 0) {    // an edge or a point that a dropped facet left behind
      held_[v] = 1;
      continue;
    }
    if (!(a > kLeastOfNormals * size[v])) {
      hold(static_cast<int>(v), some_face[v], mesh, step);
      continue;
    }
    to.sign[v] = dot({p[1], p[2], p[3]}, area[v]) < 0 ? -1 : 1;
    to.direction[v] = (to.sign[v] / a) * area[v];
    to.way[v] = factor * p[0] / a;
  }
  return to;
}

// Holds the corners of faces that would fold over; returns whether there are any.
bool MeshWear::hold_folding(const WeldedMesh &mesh, const WeldedMesh &moved, std::int64_t step)
{
  bool any = false;
  for (std::size_t f = 0; f < mesh.faces.size(); f++) {
    const auto &face = mesh.faces[f];
    const Vec3 before = normal_of(mesh, face), after = normal_of(moved, face);
    if (dot(before, after) >= kLeastOfMove * norm_sq(before) &&
        norm(after) >= kLeastOfFirst * first_size_[f])
      continue;
    for (const int v : face) {
      if (mesh.vertices[v] == moved.vertices[v]) continue;
      hold(v, static_cast<int>(f), mesh, step);
      any = true;
    }
  }
  return any;
}

// Holds the corners of faces that would meet others and did not meet them at the beginning.
bool MeshWear::hold_meeting(const WeldedMesh &mesh, const WeldedMesh &moved, std::int64_t step)
{
  bool any = false;
  for (const auto &pair : meeting_faces(moved)) {
    if (std::binary_search(meet_.begin(), meet_.end(), pair)) continue;
    for (const int f : pair)
      for (const int v : mesh.faces[f]) {
        if (mesh.vertices[v] == moved.vertices[v]) continue;
        hold(v, f, mesh, step);
        any = true;
      }
  }
  return any;
}

// How many parts a move has, so that in each no vertex goes farther than a share of its shortest edge.
int MeshWear::parts(const WeldedMesh &mesh, std::int64_t step)
{
  const Move to = plan(mesh, wall_.wear_deform.factor, step);
  Real most = 0;
  for (const auto &edge : mesh.edges) {
    const Real length = norm(mesh.vertices[edge[1]] - mesh.vertices[edge[0]]);
    most = std::max(most, std::max(to.way[edge[0]], to.way[edge[1]]) / length);
  }
  constexpr Real kOfEdge = 0.1, kMostParts = 1000;
  if (!(most <= kMostParts * kOfEdge))
    throw InputError(named(
        "wear would move a corner in step " + std::to_string(step) + " by " + number_text(most) +
        " times the length of an edge there: give a smaller factor, or move the mesh more "
        "often (deform every N)"));
  return std::max(1, static_cast<int>(std::ceil(most / kOfEdge)));
}

// Removes the part 1/n of what has worn; `mesh` is where that leaves it. All ways are multiplied by the number that makes the
// volume exact: it differs from 1 by the second order. Whatever would fold or meet is held, and all begins again without it.
bool MeshWear::move(WeldedMesh &mesh, int n, std::int64_t step)
{
  const Real factor = wall_.wear_deform.factor / n;
  WeldedMesh moved = mesh;
  for (;;) {
    const Move to = plan(mesh, factor, step);
    long double wanted = carried_;
    bool any = false;
    for (std::size_t v = 0; v < held_.size(); v++) {
      if (!(to.way[v] > 0)) continue;
      any = true;
      wanted += static_cast<long double>(factor) * pending_[kPerVertex * v];
    }
    if (!any) return false;
    if (!(wanted > 0)) {    // less than rounding
      carried_ = static_cast<Real>(wanted);
      return false;
    }

    Real scale = 1;
    constexpr int kMostRounds = 50;
    for (int i = 0; i < kMostRounds; i++) {
      const auto way = [&](int v) { return (scale * to.way[v]) * to.direction[v]; };
      const Real next = static_cast<Real>(scale * (wanted / swept(mesh, to.sign, way)));
      const bool is_done = std::fabs(next - scale) <= 1e-15 * scale;
      scale = next;
      if (is_done) break;
    }
    moved.vertices = mesh.vertices;
    for (std::size_t v = 0; v < held_.size(); v++)
      moved.vertices[v] += (scale * to.way[v]) * to.direction[v];
    if (hold_folding(mesh, moved, step) || hold_meeting(mesh, moved, step)) continue;

    // The volume of the places as they are rounded.
    const long double removed =
        swept(mesh, to.sign, [&](int v) { return moved.vertices[v] - mesh.vertices[v]; });
    carried_ = static_cast<Real>(wanted - removed);
    removed_ += static_cast<Real>(removed);
    mesh.vertices = std::move(moved.vertices);
    return true;
  }
}

bool MeshWear::recede(const WeldedMesh *mesh, std::int64_t step, std::vector<Vec3> &at)
{
  host_.sum(pending_.data(), static_cast<int>(pending_.size()));
  int moves = 0;
  run_collectively(host_, host_.is_first(), [&] {
    WeldedMesh now = *mesh;
    const int n = parts(now, step);
    for (int i = 0; i < n; i++) {
      moves |= static_cast<int>(move(now, n, step));
      for (std::size_t v = 0; v < held_.size(); v++)
        if (held_[v]) held_back_ += wall_.wear_deform.factor / n * pending_[kPerVertex * v];
    }
    at = std::move(now.vertices);
  });
  Real volumes[2] = {removed_, held_back_};
  host_.broadcast(&moves, sizeof moves, 0);
  host_.broadcast(volumes, sizeof volumes, 0);
  removed_ = volumes[0];
  held_back_ = volumes[1];
  std::fill(pending_.begin(), pending_.end(), 0);
  if (!report_.empty()) host_.warn(named(report_));    // the first process alone has one
  report_.clear();
  if (!moves) return false;
  at.resize(pending_.size() / kPerVertex);
  host_.broadcast(at.data(), at.size() * sizeof(Vec3), 0,
                  wall_.shapes ? Receivers::all : Receivers::that_fill_memory);
  if (wall_.energy) {
    receded_.resize(at.size());
    for (std::size_t v = 0; host_.is_first() && v < at.size(); v++)
      receded_[v] = at[v] - mesh->vertices[v];
    host_.broadcast(receded_.data(), at.size() * sizeof(Vec3), 0);
  }
  return true;
}

SurfaceState MeshWear::save(const WeldedMesh *mesh) const
{
  SurfaceState all;
  all.pending = pending_;
  host_.sum(all.pending.data(), static_cast<int>(all.pending.size()));
  if (!host_.is_first()) return all;
  for (const Vec3 &x : mesh->vertices) all.vertices.insert(all.vertices.end(), {x.x, x.y, x.z});
  all.held.assign(held_.begin(), held_.end());
  all.removed = removed_;
  all.held_back = held_back_;
  all.carried = carried_;
  return all;
}

void MeshWear::restore(const SurfaceState &was)
{
  removed_ = was.removed;
  held_back_ = was.held_back;
  std::fill(pending_.begin(), pending_.end(), 0);
  if (!host_.is_first()) return;
  pending_ = was.pending;
  carried_ = was.carried;
  is_reported_ = false;
  for (std::size_t v = 0; v < held_.size(); v++) {
    is_reported_ |= was.held[v] != 0 && !held_[v];
    held_[v] = was.held[v] != 0;
  }
}

std::size_t MeshWear::bytes() const
{
  return (pending_.size() + first_size_.size()) * sizeof(Real) + held_.size() +
         receded_.size() * sizeof(Vec3);
}

}    // namespace lsdcd
