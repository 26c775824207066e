// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/surface/mesh_nodes.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "engine/lists/feature_list.h"
#include "engine/results/step_counts.h"
#include "grid/build/moving_grid.h"
#include "mesh/face_pressure.h"
#include "mesh/mesh_features.h"
#include "wall/spec/mesh_name.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace lsdcd {

namespace {

// As shares of the cutoff: how far nodes may go before the grid is built again, and before lists of spheres are made
// again. More makes lists longer, less makes them more frequent. A cell has all that a list of a sphere in it
// may name, which are farther by the way of nodes and by that of the sphere, and by rounding.
constexpr Real kOfGrid = 0.15, kOfLists = 0.05,
               kAllowance = kOfGrid + kOfLists + kSkinFraction + 1e-3;

// Returns the node that has gone farthest, or the first that is at no place.
std::size_t farthest(const std::vector<Vec3> &from, const std::vector<Vec3> &to)
{
  std::size_t node = 0;
  Real most = -1;
  for (std::size_t i = 0; i < from.size(); i++) {
    const Real way = norm_sq(to[i] - from[i]);
    if (!(way >= 0)) return i;
    if (way <= most) continue;
    most = way;
    node = i;
  }
  return node;
}

}    // namespace

MeshNodes::MeshNodes(Host &host, const WallSpec &wall, int mesh, const WeldedMesh &welded) :
    host_(host), wall_(wall), index_(mesh), mesh_(welded),
    of_contacts_(3 * welded.vertices.size(), 0)
{
}

void MeshNodes::start(WallEngine &engine)
{
  engine_ = engine.nodes(index_);
  engine_->start(mesh_);
}

std::string MeshNodes::named(const std::string &text) const
{
  return with_mesh_name(wall_, index_, text);
}

// Names a node as the host does, or by its number.
std::string MeshNodes::node_text(std::size_t i) const
{
  if (names.empty())
    return "node " + std::to_string(rows.empty() ? i : static_cast<std::size_t>(rows[i])) +
           " (from 0)";
  return std::string(host_.names().sphere) + " " +
         std::to_string(static_cast<std::int64_t>(names[i])) + ", a node,";
}

// ---- where they are ----------------------------------------------------------------------

void MeshNodes::set(const Real *x, const Real *v)
{
  static_assert(sizeof(Vec3) == 3 * sizeof(Real), "a row of three numbers is a vector");
  engine_->give(reinterpret_cast<const Vec3 *>(x), reinterpret_cast<const Vec3 *>(v));
  are_set_ = true;
  are_set_in_place_ = are_restored_ = false;
}

void MeshNodes::set_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row)
{
  engine_->give_in_place(x, v, node_of_row);
  are_set_ = are_set_in_place_ = true;
  are_restored_ = false;
}

void MeshNodes::begin_step(const Step &step, Real cutoff)
{
  if (!are_set_) return;
  are_set_ = are_restored_ = false;
  const NodesGone gone = engine_->move(step.velocities_behind());
  try {
    check_range();
    check(gone, step, cutoff);
  } catch (...) {
    engine_->move_back();
    throw;
  }
  note(gone);
}

void MeshNodes::note(const NodesGone &gone)
{
  way_ += gone.most;
  way_of_grid_ = gone.since_grid;
  mesh_.report.lo = gone.lo;
  mesh_.report.hi = gone.hi;
  are_places_old_ = true;
}

void MeshNodes::check(const NodesGone &gone, const Step &step, Real cutoff) const
{
  const bool is_too_far = step.kind == Step::step && cutoff > 0 && gone.most > cutoff;
  if (is_too_far || !std::isfinite(gone.most + gone.speed)) {
    std::vector<Vec3> from(mesh_.vertices.size()), to(from.size()), v(from.size());
    engine_->fetch(NodesAt::before, from.data(), nullptr);
    engine_->fetch(NodesAt::now, to.data(), v.data());
    const std::size_t node = farthest(from, to);
    check_place(node, to[node]);
    if (is_too_far)
      throw InputError(
          named(passed_text(node_text(node), gone.most, step, "radius " + number_text(cutoff))));
    for (std::size_t i = 0; i < v.size(); i++) check_velocity(i, v[i]);
  }
  if (gone.without_area >= 0) throw_without_area(mesh_, gone.without_area);
}

void MeshNodes::check_place(std::size_t node, const Vec3 &x) const
{
  if (!std::isfinite(norm(x)))
    throw InputError(named(node_text(node) +
                           " has a position that is not finite: the motion of the nodes is "
                           "unstable, or a node was lost; use a shorter timestep or more damping"));
}

void MeshNodes::check_velocity(std::size_t node, const Vec3 &v) const
{
  for (int d = 0; d < 3; d++)
    if (!std::isfinite(v[d]))
      throw InputError(named("the velocity of " + node_text(node) + " is " + number_text(v[d]) +
                             ", which is not finite"));
}

void MeshNodes::check(const NodeState &was) const
{
  const auto *x = reinterpret_cast<const Vec3 *>(was.places.data());
  const auto *v = reinterpret_cast<const Vec3 *>(was.velocities.data());
  for (std::size_t i = 0; i < was.places.size() / 3; i++) check_place(i, x[i]);
  for (std::size_t i = 0; i < was.velocities.size() / 3; i++) check_velocity(i, v[i]);
  if (was.places.empty()) return;
  for (std::size_t f = 0; f < mesh_.faces.size(); f++) {
    const auto &corner = mesh_.faces[f];
    if (!has_area(x[corner[0]], x[corner[1]], x[corner[2]]))
      throw_without_area(mesh_, static_cast<int>(f));
  }
}

const WeldedMesh &MeshNodes::mesh() const
{
  if (are_places_old_) engine_->fetch(NodesAt::now, mesh_.vertices.data(), nullptr);
  are_places_old_ = false;
  return mesh_;
}

// ---- the grid ----------------------------------------------------------------------------

bool MeshNodes::needs_grid(Real cutoff) const
{
  return cutoff != cutoff_ || !(way_of_grid_ <= kOfGrid * cutoff);
}

bool MeshNodes::needs_choice(Real cutoff) const
{
  return !(way_ <= kOfLists * cutoff);
}

void MeshNodes::build_grid(Real cutoff)
{
  engine_->build_grid(
      {cutoff, kAllowance * cutoff, Real(mesh_.report.volume < 0 ? -1 : 1), bounds(), mesh_.source},
      kOfLists * cutoff);
  cutoff_ = cutoff;
  way_of_grid_ = 0;
}

// ---- saved states ------------------------------------------------------------------------

NodeState MeshNodes::save()
{
  NodeState all;
  all.names = names;
  std::vector<Vec3> at(mesh_.vertices.size()), velocity(at.size());
  const auto put = [](const std::vector<Vec3> &from, std::vector<Real> &to) {
    for (const Vec3 &x : from) to.insert(to.end(), {x.x, x.y, x.z});
  };
  engine_->fetch(NodesAt::now, at.data(), velocity.data());
  put(at, all.places);
  if (!names.empty()) return all;
  put(velocity, all.velocities);
  all.behind = engine_->velocities_behind();
  if (state_ != Forces::none) all.forces = forces(0);
  if (!are_set_) return all;
  engine_->fetch(NodesAt::next, at.data(), velocity.data());
  put(at, all.next);
  put(velocity, all.next_velocities);
  return all;
}

void MeshNodes::restore(const NodeState &was)
{
  names = was.names;
  if (!was.forces.empty()) {
    of_contacts_ = was.forces;
    state_ = Forces::restored;
  }
  if (are_restored_) are_set_ = are_restored_ = false;
  if (!was.next.empty() && !are_set_) {
    set(was.next.data(), was.next_velocities.data());
    are_restored_ = true;
  }
  if (was.places.empty()) return;
  std::vector<Real> velocities = was.velocities;
  velocities.resize(was.places.size(), 0);
  note(engine_->put(reinterpret_cast<const Vec3 *>(was.places.data()),
                    reinterpret_cast<const Vec3 *>(velocities.data()), was.behind));
}

// ---- forces ------------------------------------------------------------------------------

void MeshNodes::clear_forces()
{
  std::fill(of_contacts_.begin(), of_contacts_.end(), 0);
  power_ = 0;
  state_ = Forces::none;
}

void MeshNodes::have_no_forces()
{
  sums_.assign(of_contacts_.size(), 0);
  power_ = 0;
  range_.shares = {0, kNotFinite};
  state_ = Forces::fetched;
}

void MeshNodes::see_forces()
{
  engine_->see_forces();
  state_ = Forces::seen;
  const bool is_alone = host_.processes() == 1;
  if (is_alone) engine_->add_forces(nullptr);
  // What is set in place is asked for there: nothing waits for it.
  if (!is_alone || !are_set_in_place_) check_range();
}

void MeshNodes::add_forces(const SummandRange &of_all)
{
  range_.shares = of_all;
  engine_->add_forces(&range_);
}

// Throws where a force of the last step is not finite, the first time that it is called after one.
void MeshNodes::check_range()
{
  if (state_ != Forces::seen) return;
  range_ = engine_->force_range();
  state_ = Forces::added;
  if (range_.not_finite == 0) return;
  throw InputError(static_cast<int>(kNoSphere - range_.not_finite),
                   "pushes nodes of mesh '" + wall_.meshes[index_].name +
                       "' by a force that is not finite: the motion of the spheres or of the "
                       "nodes is unstable; use a shorter timestep or more damping");
}

void MeshNodes::fetch_forces()
{
  check_range();
  if (state_ != Forces::added) return;
  sums_.resize(of_contacts_.size());
  power_ = engine_->fetch_forces(sums_.data());
  state_ = Forces::fetched;
}

Real MeshNodes::power()
{
  fetch_forces();
  return power_;
}

Real MeshNodes::sixth_of(Real pressure) const
{
  const bool is_inverted = mesh_.report.closed && mesh_.report.volume < 0;
  return (is_inverted ? -pressure : pressure) / 6;
}

const std::vector<Real> &MeshNodes::forces(Real pressure)
{
  fetch_forces();
  if (state_ == Forces::fetched) {
    sum_exactly(host_, sums_);
    const SumUnit unit(range_.shares);
    for (std::size_t k = 0; k < sums_.size(); k++) of_contacts_[k] = unit.value(sums_[k]);
    state_ = Forces::of_all;
  }
  if (pressure == 0) return of_contacts_;
  forces_ = of_contacts_;
  const Real sixth = sixth_of(pressure);
  const std::vector<Vec3> &at = mesh().vertices;
  for (const auto &face : mesh_.faces) {
    const Vec3 share = corner_share_of_pressure(face.data(), at.data(), sixth);
    for (const int v : face)
      for (int d = 0; d < 3; d++) forces_[3 * v + d] += share[d];
  }
  return forces_;
}

Vec3 MeshNodes::moment()
{
  const std::vector<Real> &f = forces(0);
  const std::vector<Vec3> &at = mesh().vertices;
  Vec3 sum = {0, 0, 0};
  for (std::size_t i = 0; i < at.size(); i++)
    sum += cross(at[i], {f[3 * i], f[3 * i + 1], f[3 * i + 2]});
  return sum;
}

bool MeshNodes::put_forces(Real pressure, Real *to, const std::vector<int> &node_of_row)
{
  if (state_ == Forces::none || state_ == Forces::restored) return false;
  engine_->put_forces(sixth_of(pressure), to, node_of_row);
  return true;
}

std::size_t MeshNodes::bytes() const
{
  return (of_contacts_.size() + forces_.size()) * sizeof(Real) +
         sums_.size() * sizeof(std::int64_t) + mesh_.vertices.size() * sizeof(Vec3);
}

}    // namespace lsdcd
