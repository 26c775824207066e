// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/mesh_nodes.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "contact/history.h"
#include "engine/lists/feature_list.h"
#include "wall/mesh_name.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lsdcd {

namespace {

// As shares of the cutoff: how far nodes may go before the grid is built anew, and before lists of spheres are made
// anew. More makes lists longer, less makes them more frequent. A cell has all that a list of a sphere in it
// may name, which are farther by the way of nodes and by that of the sphere, and by rounding.
constexpr Real kOfGrid = 0.15, kOfLists = 0.05,
               kAllowance = kOfGrid + kOfLists + kSkinFraction + 1e-3;

Real farthest(const std::vector<Vec3> &from, const std::vector<Vec3> &to, std::size_t &node)
{
  Real most = -1;
  for (std::size_t i = 0; i < from.size(); i++) {
    const Real way = norm_sq(to[i] - from[i]);
    if (way <= most) continue;    // one that is no number is the farthest
    most = way;
    node = i;
    if (!(way >= 0)) return HUGE_VAL;
  }
  return std::sqrt(std::max(most, Real(0)));
}

// The rotation of a face: its normal by the smallest turn of its plane, and in the plane the turn that fits best
// (the polar decomposition of the plane map).
struct FaceTurn {
  Vec3 from[3], to[3];    // orthonormal frames
  bool is_none;

  FaceTurn(const Vec3 &a0, const Vec3 &b0, const Vec3 &c0, const Vec3 &a1, const Vec3 &b1,
           const Vec3 &c1)
  {
    const Vec3 e0 = b0 - a0, f0 = c0 - a0, e1 = b1 - a1, f1 = c1 - a1;
    is_none = e0 == e1 && f0 == f1;
    if (is_none) return;
    const Vec3 n0 = cross(e0, f0), n1 = cross(e1, f1);
    const Real length0 = norm(e0), length1 = norm(e1), area0 = norm(n0), area1 = norm(n1),
               of_length0 = 1 / length0, of_area0 = 1 / area0;
    from[0] = of_length0 * e0;
    from[2] = of_area0 * n0;
    from[1] = cross(from[2], from[0]);
    const Vec3 first = (1 / length1) * e1;
    to[2] = (1 / area1) * n1;
    const Vec3 second = cross(to[2], first);
    // The plane map in these frames is upper triangular, (p q; 0 r), with p = |e1|/|e0| and p r the ratio of areas. It
    // turns by the angle of (p + r, -q), here times p.
    const Real p = length1 * of_length0, c = p * p + area1 * of_area0,
               s = p * (p * dot(f0, from[0]) - dot(f1, first)) * (length0 * of_area0),
               over = 1 / std::sqrt(c * c + s * s), cosine = over * c, sine = over * s;
    to[0] = cosine * first + sine * second;
    to[1] = cosine * second - sine * first;
  }
  Vec3 of(const Vec3 &a) const
  {
    if (is_none) return a;
    return dot(from[0], a) * to[0] + dot(from[1], a) * to[1] + dot(from[2], a) * to[2];
  }
};

// How a feature turns: by the mean of the rotations of its faces, keeping lengths.
struct FeatureTurn {
  std::vector<FaceTurn> faces;

  void apply(Vec3 &a) const
  {
    if (faces.size() == 1) {
      a = faces.front().of(a);
      return;
    }
    Vec3 sum = {0, 0, 0};
    bool any = false;
    for (const FaceTurn &face : faces) {
      any |= !face.is_none;
      sum += face.of(a);
    }
    const Real length = norm(sum);
    if (any && length > 0) a = (norm(a) / length) * sum;
  }
};

}    // namespace

MeshNodes::MeshNodes(Host &host, const WallSpec &wall, int mesh, const WeldedMesh &welded) :
    host_(host), wall_(wall), index_(mesh), with_sides_(wall.side != Side::both),
    with_spins_(wall.law().rolling.is_on() || wall.law().twisting.is_on()), mesh_(welded),
    features_(make_moving_features(mesh_, with_sides_)), bounds_{mesh_.report.lo, mesh_.report.hi},
    velocity_(mesh_.vertices.size(), Vec3{0, 0, 0}), spin_(velocity_),
    of_contacts_(3 * velocity_.size(), 0)
{
}

std::string MeshNodes::named(const std::string &text) const
{
  return with_mesh_name(wall_, index_, text);
}

// ---- where they are ----------------------------------------------------------------------

void MeshNodes::set(const Real *x, const Real *v)
{
  const std::size_t n = mesh_.vertices.size();
  next_.resize(n);
  next_velocity_.assign(n, Vec3{0, 0, 0});
  for (std::size_t i = 0; i < n; i++) {
    next_[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
    if (v) next_velocity_[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  }
}

void MeshNodes::begin_step(const Step &step, Real cutoff)
{
  if (next_.empty()) return;
  std::size_t node = 0;
  const Real most = farthest(mesh_.vertices, next_, node);
  if (!std::isfinite(most) && !std::isfinite(norm(next_[node])))
    throw InputError(
        named("node " + std::to_string(node) +
              " (from 0) is at no finite place: the motion of the nodes is unstable, or "
              "one is lost"));
  if (step.kind == Step::step && cutoff > 0 && most > cutoff)
    throw InputError(named("node " + std::to_string(node) + " (from 0) has gone " +
                           number_text(most) + " in step " + std::to_string(step.number) +
                           ", more than the largest radius " + number_text(cutoff) +
                           ": it may have gone through a sphere; make the timestep shorter"));
  way_ += most;
  mesh_.vertices.swap(next_);
  velocity_.swap(next_velocity_);
  update_features(mesh_, next_, with_sides_, features_);
  next_.clear();
  bounds_ = {mesh_.vertices.front(), mesh_.vertices.front()};
  for (const Vec3 &x : mesh_.vertices) extend(bounds_, x);
  if (with_spins_) find_spins(step.kind == Step::step ? step.dt / 2 : 0);
}

// The spin of a face is that of its plane, n x dn/dt, and about its normal half the curl of the velocities. With
// the edges e, f from one corner, the velocities d, g of their ends relative to it, and N = e x f,
//
//   dN/dt = d x f + e x g,   n . curl = n . ((f x n) x d + (n x e) x g)/|N|.
//
// For a rigid motion that is the angular velocity. The edges are those of `back` ago (time), when the velocities are of;
// a turn by an angle a in a step has the spin to a^2/12. A node has the mean of its faces, weighted by area.
void MeshNodes::find_spins(Real back)
{
  std::fill(spin_.begin(), spin_.end(), Vec3{0, 0, 0});
  std::vector<Real> weight(spin_.size(), 0);
  for (const auto &face : mesh_.faces) {
    const Vec3 &a = mesh_.vertices[face[0]], &va = velocity_[face[0]];
    const Vec3 d = velocity_[face[1]] - va, g = velocity_[face[2]] - va,
               e = mesh_.vertices[face[1]] - a - back * d,
               f = mesh_.vertices[face[2]] - a - back * g;
    const Vec3 area = cross(e, f);
    const Real size = norm(area);
    const Vec3 n = (1 / size) * area, changes = (1 / size) * (cross(d, f) + cross(e, g));
    const Real curl = dot(n, cross(cross(f, n), d) + cross(cross(n, e), g)) / size;
    const Vec3 spin = cross(n, changes) + (Real(0.5) * curl) * n;
    for (const int v : face) {
      spin_[v] += size * spin;
      weight[v] += size;
    }
  }
  for (std::size_t i = 0; i < spin_.size(); i++)
    if (weight[i] > 0) spin_[i] = (1 / weight[i]) * spin_[i];
}

// ---- the grid ----------------------------------------------------------------------------

bool MeshNodes::needs_grid(Real cutoff) const
{
  if (!grid_.is_built() || cutoff != grid_.cutoff()) return true;
  std::size_t node = 0;
  return !(farthest(built_at_, mesh_.vertices, node) <= kOfGrid * cutoff);
}

bool MeshNodes::needs_choice(Real cutoff) const
{
  return !(way_ <= kOfLists * cutoff);
}

NodeField MeshNodes::field(Real cutoff) const
{
  return {velocity_.data(), spin_.data(), kOfLists * cutoff};
}

void MeshNodes::build_grid(Real cutoff)
{
  grid_.build(mesh_, features_, cutoff, kAllowance * cutoff);
  built_at_ = mesh_.vertices;
}

// ---- springs -----------------------------------------------------------------------------

void MeshNodes::turn_springs(WallEngine &engine, int n)
{
  FeatureTurn turn_of;
  const auto add_face = [&](int face) {
    const auto &c = mesh_.faces[face];
    turn_of.faces.emplace_back(turned_from_[c[0]], turned_from_[c[1]], turned_from_[c[2]],
                               mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]);
  };
  const auto add_faces_of = [&](int edge) {
    for (int k = mesh_.edge_first[edge]; k < mesh_.edge_first[edge + 1]; k++)
      add_face(mesh_.edge_face[k]);
  };
  const auto turn = [&](Spring &spring, Vec3 *vectors, int n_vectors) {
    const std::uint32_t i = feature_index(spring.feature);
    const FeatureKind kind = feature_kind(spring.feature);
    turn_of.faces.clear();
    if (kind == FeatureKind::face)
      add_face(static_cast<int>(i));
    else if (kind == FeatureKind::edge)
      add_faces_of(static_cast<int>(i));
    else
      for (int k = mesh_.vertex_first[i]; k < mesh_.vertex_first[i + 1]; k++)
        add_faces_of(mesh_.vertex_edge[k]);
    // An edge without a face turns by the smallest turn of its direction.
    const bool is_bare = turn_of.faces.empty() && kind == FeatureKind::edge;
    const auto direction = [&](const std::vector<Vec3> &at) {
      const auto &end = mesh_.edges[i];
      const Vec3 along = at[end[1]] - at[end[0]];
      return (1 / norm(along)) * along;
    };
    const auto turn_one = [&](Vec3 &a) {
      if (is_bare)
        a = transport(a, direction(turned_from_), direction(mesh_.vertices));
      else
        turn_of.apply(a);
    };
    if (kind == FeatureKind::face) {    // that of the face, to the last bit
      const Vec3 &now = features_.faces[i].normal;
      spring.normal = dot(turn_of.faces.front().of(spring.normal), now) < 0 ? -now : now;
    } else {
      turn_one(spring.normal);
    }
    turn_one(spring.shear);
    for (int k = 0; k < n_vectors; k++) turn_one(vectors[k]);
  };
  if (!turned_from_.empty()) engine.turn_springs(n, index_, turn);
  turned_from_ = mesh_.vertices;
}

// ---- forces ------------------------------------------------------------------------------

void MeshNodes::clear_forces()
{
  std::fill(of_contacts_.begin(), of_contacts_.end(), 0);
  power_ = 0;
  are_summed_ = true;
}

// Records are in the order of the spheres that touch, so that the sum is the same in each run.
void MeshNodes::sum_forces(const WallEngine &engine, const Spheres &spheres)
{
  clear_forces();
  are_summed_ = false;
  const MeshFeaturesView wall = features_.view();
  engine.visit_contacts([&](int sphere, const ContactRecord &record) {
    if (record.mesh != static_cast<std::uint32_t>(index_)) return;
    const NodeShares at = node_shares(wall, record.feature, spheres.x[sphere] - record.arm);
    for (int j = 0; j < at.n; j++)
      for (int d = 0; d < 3; d++) of_contacts_[3 * at.node[j] + d] += at.share[j] * record.force[d];
    power_ -= dot(record.force, field_at(at, velocity_.data()));
  });
}

// A pressure on a flat face is a third of p times its area on each corner: the moment of that is the pressure's own,
// and on a closed mesh both sums are 0.
const std::vector<Real> &MeshNodes::forces(Real pressure)
{
  if (!are_summed_) host_.sum(of_contacts_.data(), static_cast<int>(of_contacts_.size()));
  are_summed_ = true;
  if (pressure == 0) return of_contacts_;
  forces_ = of_contacts_;
  const bool is_inverted = mesh_.report.closed && mesh_.report.volume < 0;
  const Real part = (is_inverted ? -pressure : pressure) / 6;
  for (const auto &face : mesh_.faces) {
    const Vec3 &a = mesh_.vertices[face[0]];
    const Vec3 share = part * cross(mesh_.vertices[face[1]] - a, mesh_.vertices[face[2]] - a);
    for (const int v : face)
      for (int d = 0; d < 3; d++) forces_[3 * v + d] += share[d];
  }
  return forces_;
}

std::size_t MeshNodes::bytes() const
{
  std::size_t total = grid_.bytes() + (of_contacts_.size() + forces_.size()) * sizeof(Real);
  MeshFeaturesView::each_array(features_, [&](const auto &a) {
    total += a.size() * sizeof(typename std::decay_t<decltype(a)>::value_type);
  });
  for (const std::vector<Vec3> *a :
       {&mesh_.vertices, &velocity_, &spin_, &next_, &next_velocity_, &built_at_, &turned_from_})
    total += a->size() * sizeof(Vec3);
  return total;
}

}    // namespace lsdcd
