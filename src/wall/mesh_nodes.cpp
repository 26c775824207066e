// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/mesh_nodes.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "engine/lists/feature_list.h"
#include "mesh/node_spin.h"
#include "wall/mesh_name.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace lsdcd {

namespace {

// As shares of the cutoff: how far nodes may go before the grid is built anew, and before lists of spheres are made
// anew. More makes lists longer, less makes them more frequent. A cell has all that a list of a sphere in it
// may name, which are farther by the way of nodes and by that of the sphere, and by rounding.
constexpr Real kOfGrid = 0.15, kOfLists = 0.05,
               kAllowance = kOfGrid + kOfLists + kSkinFraction + 1e-3;

// How far the farthest has gone, and its number.
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
  static_assert(sizeof(Vec3) == 3 * sizeof(Real), "a row of three numbers is a vector");
  next_.resize(n);
  next_velocity_.resize(n);
  std::memcpy(static_cast<void *>(next_.data()), x, n * sizeof(Vec3));
  if (v)
    std::memcpy(static_cast<void *>(next_velocity_.data()), v, n * sizeof(Vec3));
  else
    std::fill(next_velocity_.begin(), next_velocity_.end(), Vec3{0, 0, 0});
}

void MeshNodes::begin_step(const Step &step, Real cutoff, WallEngine &engine)
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
  way_of_grid_ += most;
  mesh_.vertices.swap(next_);
  velocity_.swap(next_velocity_);
  bounds_ = {mesh_.vertices.front(), mesh_.vertices.front()};
  for (const Vec3 &x : mesh_.vertices) extend(bounds_, x);
  back_ = step.kind == Step::step ? step.dt / 2 : 0;
  if (engine.copies_records() && grid_.is_built()) {
    engine.move_nodes(index_, now());
    are_records_old_ = true;
  } else {
    update_features(mesh_, next_, with_sides_, features_);
    if (with_spins_ && !engine.copies_records()) find_spins();
  }
  if (!have_moved_) turned_from_.swap(next_);
  have_moved_ = true;
  next_.clear();
}

NodesNow MeshNodes::now() const
{
  Real far = 0;
  for (const Vec3 *x : {&bounds_.lo, &bounds_.hi})
    for (int d = 0; d < 3; d++) far = std::max(far, std::fabs((*x)[d]));
  return {&mesh_, velocity_.data(), far, with_spins_, back_};
}

void MeshNodes::fetch_records(WallEngine &engine)
{
  if (are_records_old_) engine.fetch_records(index_, features_);
  are_records_old_ = false;
}

void MeshNodes::find_spins()
{
  std::fill(spin_.begin(), spin_.end(), Vec3{0, 0, 0});
  std::vector<Real> weight(spin_.size(), 0);
  for (const auto &face : mesh_.faces) {
    const FaceSpin of = spin_of_face(face.data(), mesh_.vertices.data(), velocity_.data(), back_);
    for (const int v : face) {
      spin_[v] += of.size * of.spin;
      weight[v] += of.size;
    }
  }
  for (std::size_t i = 0; i < spin_.size(); i++)
    if (weight[i] > 0) spin_[i] = (1 / weight[i]) * spin_[i];
}

// ---- the grid ----------------------------------------------------------------------------

bool MeshNodes::needs_grid(Real cutoff)
{
  if (!grid_.is_built() || cutoff != grid_.cutoff()) return true;
  // None has gone farther than the farthest of each step.
  if (way_of_grid_ <= kOfGrid * cutoff) return false;
  std::size_t node = 0;
  way_of_grid_ = farthest(built_at_, mesh_.vertices, node);
  return !(way_of_grid_ <= kOfGrid * cutoff);
}

bool MeshNodes::needs_choice(Real cutoff) const
{
  return !(way_ <= kOfLists * cutoff);
}

NodeField MeshNodes::field(Real cutoff) const
{
  return {velocity_.data(), spin_.data(), kOfLists * cutoff};
}

void MeshNodes::build_grid(Real cutoff, WallEngine &engine)
{
  fetch_records(engine);
  grid_.build(mesh_, features_, cutoff, kAllowance * cutoff);
  built_at_ = mesh_.vertices;
  way_of_grid_ = 0;
  give_grid(engine);
}

void MeshNodes::give_grid(WallEngine &engine)
{
  if (engine.copies_records()) grid_.make_flat();
  engine.set_grid(grid_.view(), index_);
  engine.start_nodes(index_, now());
}

// ---- springs -----------------------------------------------------------------------------

void MeshNodes::turn_springs(WallEngine &engine, int n)
{
  if (have_moved_ && !springs_are_new_)
    engine.turn_springs(
        n, index_,
        {topology_of(mesh_), features_.faces.data(), turned_from_.data(), mesh_.vertices.data()});
  have_moved_ = springs_are_new_ = false;
}

// ---- forces ------------------------------------------------------------------------------

void MeshNodes::clear_forces()
{
  std::fill(of_contacts_.begin(), of_contacts_.end(), 0);
  power_ = 0;
  are_summed_ = true;
}

void MeshNodes::sum_forces(WallEngine &engine)
{
  clear_forces();
  are_summed_ = false;
  power_ = engine.add_node_forces(index_, now(), features_.view(), of_contacts_.data());
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
