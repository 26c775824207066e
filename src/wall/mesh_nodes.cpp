// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/mesh_nodes.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "base/input_words.h"
#include "engine/lists/feature_list.h"
#include "engine/results/step_counts.h"
#include "grid/build/moving_grid.h"
#include "mesh/face_pressure.h"
#include "mesh/measure_mesh.h"
#include "mesh/node_spin.h"
#include "wall/mesh_name.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace lsdcd {

namespace {

// As shares of the cutoff: how far nodes may go before the grid is built again, and before lists of spheres are made
// again. More makes lists longer, less makes them more frequent. A cell has all that a list of a sphere in it
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

struct MeshNodes::CpuGrid : MovingGrid<CpuBackend> {};

MeshNodes::MeshNodes(Host &host, const WallSpec &wall, int mesh, const WeldedMesh &welded) :
    host_(host), wall_(wall), index_(mesh), with_sides_(wall.side != Side::both),
    with_spins_(wall.law().rolling.is_on() || wall.law().twisting.is_on()), mesh_(welded),
    features_(make_moving_features(mesh_, with_sides_)),
    velocity_(mesh_.vertices.size(), Vec3{0, 0, 0}), spin_(velocity_),
    of_contacts_(3 * velocity_.size(), 0)
{
}

MeshNodes::~MeshNodes() = default;

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
  const std::size_t n = mesh_.vertices.size();
  static_assert(sizeof(Vec3) == 3 * sizeof(Real), "a row of three numbers is a vector");
  next_.resize(n);
  next_velocity_.resize(n);
  std::memcpy(static_cast<void *>(next_.data()), x, n * sizeof(Vec3));
  if (v)
    std::memcpy(static_cast<void *>(next_velocity_.data()), v, n * sizeof(Vec3));
  else
    std::fill(next_velocity_.begin(), next_velocity_.end(), Vec3{0, 0, 0});
  are_given_there_ = false;
}

bool MeshNodes::set_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row)
{
  if (!engine_) return false;
  engine_->give_in_place(index_, x, v, node_of_row);
  are_given_there_ = true;
  next_.clear();
  return true;
}

void MeshNodes::begin_step(const Step &step, Real cutoff)
{
  if (next_.empty() && !are_given_there_) return;
  back_ = step.velocities_behind();
  if (engine_)
    move_in_place(step, cutoff);
  else
    move_here(step, cutoff);
  have_moved_ = true;
  next_.clear();
  are_given_there_ = false;
}

void MeshNodes::check_way(const Step &step, Real cutoff, Real most, const std::vector<Vec3> &from,
                          const std::vector<Vec3> &to) const
{
  const bool is_too_far = step.kind == Step::step && cutoff > 0 && most > cutoff;
  if (std::isfinite(most) && !is_too_far) return;
  std::size_t node = 0;
  farthest(from, to, node);
  if (!std::isfinite(most) && !std::isfinite(norm(to[node])))
    throw InputError(
        named(node_text(node) +
              " has a position that is not finite: the motion of the nodes is unstable, "
              "or a node was lost; use a shorter timestep or more damping"));
  if (is_too_far)
    throw InputError(named(node_text(node) + " has moved by " + number_text(most) + " in step " +
                           std::to_string(step.number) + ", more than the largest radius " +
                           number_text(cutoff) +
                           ": it may have passed through a sphere; use a shorter timestep"));
}

void MeshNodes::check_velocities(const std::vector<Vec3> &v) const
{
  for (std::size_t i = 0; i < v.size(); i++)
    for (int d = 0; d < 3; d++)
      if (!std::isfinite(v[i][d]))
        throw InputError(named("the velocity of " + node_text(i) + " is " + number_text(v[i][d]) +
                               ", which is not finite"));
}

void MeshNodes::move_here(const Step &step, Real cutoff)
{
  std::size_t node = 0;
  const Real most = farthest(mesh_.vertices, next_, node);
  check_way(step, cutoff, most, mesh_.vertices, next_);
  way_ += most;
  way_of_grid_ += most;
  mesh_.vertices.swap(next_);
  velocity_.swap(next_velocity_);
  set_bounds(mesh_);
  update_features(mesh_, next_, with_sides_, features_);
  if (with_spins_) find_spins();
  if (!have_moved_) turned_from_.swap(next_);
}

void MeshNodes::move_in_place(const Step &step, Real cutoff)
{
  if (!are_given_there_) engine_->give(index_, next_.data(), next_velocity_.data());
  const NodesGone gone = engine_->move(index_, with_spins_, back_);
  are_records_old_ = true;
  const bool pushed_well = take_range();
  if (!pushed_well || !std::isfinite(gone.most + gone.speed) ||
      (cutoff > 0 && gone.most > cutoff)) {
    std::vector<Vec3> to(mesh_.vertices.size()), v(to.size());
    engine_->fetch(index_, NodesAt::now, to.data(), v.data());
    engine_->fetch(index_, NodesAt::before, mesh_.vertices.data(), velocity_.data());
    are_places_old_ = false;
    try {
      if (!pushed_well) fail_force();
      check_way(step, cutoff, gone.most, mesh_.vertices, to);
      check_velocities(v);
    } catch (...) {
      const NodesGone back = engine_->move_back(index_, with_spins_, back_);
      if (back.any_left) engine_->make_left(index_, mesh_);
      next_.clear();
      are_given_there_ = false;
      throw;
    }
  }
  way_ += gone.most;
  way_of_grid_ = gone.since_grid;
  mesh_.report.lo = gone.lo;
  mesh_.report.hi = gone.hi;
  are_places_old_ = are_given_there_;
  if (!are_given_there_) {
    mesh_.vertices.swap(next_);
    velocity_.swap(next_velocity_);
  }
  if (gone.any_left) engine_->make_left(index_, mesh());
}

NodesNow MeshNodes::now() const
{
  return {&mesh_, &features_.primitives, velocity_.data(), with_spins_, back_};
}

void MeshNodes::fetch_records()
{
  if (are_records_old_) {
    engine_->fetch_records(index_, features_);
    features_.all_parts_act = false;
  }
  are_records_old_ = false;
}

void MeshNodes::fetch_places() const
{
  if (are_places_old_)
    engine_->fetch(index_, NodesAt::now, mesh_.vertices.data(), velocity_.data());
  are_places_old_ = false;
}

void MeshNodes::leave_engine()
{
  cutoff_ = 0;
  fetch_forces();
  if (!engine_) return;
  fetch_records();
  fetch_places();
  if (are_given_there_) {
    next_.resize(mesh_.vertices.size());
    next_velocity_.resize(next_.size());
    engine_->fetch(index_, NodesAt::given, next_.data(), next_velocity_.data());
  }
  are_given_there_ = are_sums_there_ = false;
  records_ = FlatGrid();
  engine_ = nullptr;
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
  if (cutoff != cutoff_) return true;
  // None has gone farther than the farthest of each step.
  if (way_of_grid_ <= kOfGrid * cutoff) return false;
  if (engine_) return true;
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
  const MovingGridSettings settings = {
      cutoff, kAllowance * cutoff, Real(mesh_.report.volume < 0 ? -1 : 1), bounds(), mesh_.source};
  if (!engine_ && engine.nodes()->keeps_nodes()) give_nodes(engine);
  if (engine_) {
    engine_->build_grid(index_, settings);
    engine.expire_choice();
  } else {
    CpuBackend cpu;
    if (!grid_) grid_ = std::make_unique<CpuGrid>();
    grid_->build(cpu, features_.view(), {features_.primitives.data(), features_.primitives.size()},
                 settings);
    built_at_ = mesh_.vertices;
    engine.set_grid(grid_->view(features_.view()), index_);
  }
  cutoff_ = cutoff;
  way_of_grid_ = 0;
}

// It gets the records as a grid that has no cells yet.
void MeshNodes::give_nodes(WallEngine &engine)
{
  GridView view = {};
  view.wall = features_.view();
  view.list_kind = ListKind::every();
  records_ = FlatGrid(GridParts{features_, CellLists(), BrickRecords(), view});
  grid_.reset();
  engine.set_grid(records_.view(), index_);
  engine_ = engine.nodes();
  engine_->start(index_, now());
}

// ---- saved states ------------------------------------------------------------------------

NodeState MeshNodes::save() const
{
  NodeState all = {names, {}, {}};
  for (const Vec3 &x : mesh().vertices) all.places.insert(all.places.end(), {x.x, x.y, x.z});
  if (!names.empty()) return all;
  for (const Vec3 &v : velocity_) all.velocities.insert(all.velocities.end(), {v.x, v.y, v.z});
  return all;
}

void MeshNodes::restore(const NodeState &was)
{
  names = was.names;
  springs_are_new_ = was.places.empty();
  if (springs_are_new_) return;
  std::vector<Vec3> set = std::move(next_), set_velocity = std::move(next_velocity_);
  this->set(was.places.data(), was.velocities.empty() ? nullptr : was.velocities.data());
  move_here({0, 0, Step::setup}, 0);
  next_ = std::move(set);
  next_velocity_ = std::move(set_velocity);
}

// ---- springs -----------------------------------------------------------------------------

void MeshNodes::turn_springs(WallEngine &engine, int n)
{
  if (have_moved_ && !springs_are_new_)
    engine.nodes()->turn_springs(
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
  are_sums_there_ = are_forces_old_ = is_power_old_ = is_range_new_ = false;
}

void MeshNodes::have_no_forces()
{
  clear_forces();
  sums_.assign(of_contacts_.size(), 0);
  range_.shares = {0, kNotFinite};
  are_summed_ = false;
}

void MeshNodes::see_forces(WallEngine &engine)
{
  summing_ = engine.nodes();
  summing_->see_forces(index_, now(), features_.view());
  is_range_new_ = are_forces_old_ = is_power_old_ = true;
  are_summed_ = false;
  are_sums_there_ = engine_ != nullptr;
  const bool is_alone = host_.processes() == 1;
  if (is_alone) summing_->add_forces(index_, nullptr);
  // What is set in place is asked for there: nothing waits for it.
  if ((!is_alone || !are_places_old_) && !take_range()) fail_force();
}

void MeshNodes::add_forces(const SummandRange &of_all)
{
  range_.shares = of_all;
  summing_->add_forces(index_, &range_);
}

// Returns whether the forces of the last step are finite, the first time that it is called after one.
bool MeshNodes::take_range()
{
  if (!is_range_new_) return true;
  range_ = summing_->force_range(index_);
  is_range_new_ = false;
  return range_.not_finite == 0;
}

void MeshNodes::fail_force() const
{
  throw InputError(static_cast<int>(kNoSphere - range_.not_finite),
                   "pushes nodes of mesh '" + wall_.meshes[index_].name +
                       "' by a force that is not finite: the motion of the spheres or of the "
                       "nodes is unstable; use a shorter timestep or more damping");
}

void MeshNodes::fetch_forces()
{
  if (!are_forces_old_) return;
  if (!take_range()) fail_force();
  sums_.resize(of_contacts_.size());
  power_ = summing_->fetch_forces(index_, sums_.data());
  are_forces_old_ = is_power_old_ = false;
}

// Over all processes.
void MeshNodes::sum_forces()
{
  fetch_forces();
  if (are_summed_) return;
  sum_exactly(host_, sums_);
  const SumUnit unit(range_.shares);
  for (std::size_t k = 0; k < sums_.size(); k++) of_contacts_[k] = unit.value(sums_[k]);
  are_summed_ = true;
}

void MeshNodes::fetch_power() const
{
  if (is_power_old_) power_ = summing_->fetch_forces(index_, nullptr);
  is_power_old_ = false;
}

Real MeshNodes::sixth_of(Real pressure) const
{
  const bool is_inverted = mesh_.report.closed && mesh_.report.volume < 0;
  return (is_inverted ? -pressure : pressure) / 6;
}

const std::vector<Real> &MeshNodes::forces(Real pressure)
{
  sum_forces();
  if (pressure == 0) return of_contacts_;
  fetch_places();
  forces_ = of_contacts_;
  const Real sixth = sixth_of(pressure);
  for (const auto &face : mesh_.faces) {
    const Vec3 share = corner_share_of_pressure(face.data(), mesh_.vertices.data(), sixth);
    for (const int v : face)
      for (int d = 0; d < 3; d++) forces_[3 * v + d] += share[d];
  }
  return forces_;
}

Vec3 MeshNodes::moment()
{
  const std::vector<Real> &f = forces(0);
  fetch_places();
  Vec3 sum = {0, 0, 0};
  for (std::size_t i = 0; i < mesh_.vertices.size(); i++)
    sum += cross(mesh_.vertices[i], {f[3 * i], f[3 * i + 1], f[3 * i + 2]});
  return sum;
}

bool MeshNodes::put_forces(Real pressure, Real *to, const std::vector<int> &node_of_row)
{
  if (!are_sums_there_) return false;
  engine_->put_forces(index_, sixth_of(pressure), to, node_of_row);
  return true;
}

std::size_t MeshNodes::bytes() const
{
  std::size_t total = (grid_ ? grid_->bytes() : 0) + records_.bytes() +
                      (of_contacts_.size() + forces_.size()) * sizeof(Real);
  MeshFeaturesView::each_array(features_, [&](const auto &a) {
    total += a.size() * sizeof(typename std::decay_t<decltype(a)>::value_type);
  });
  const std::vector<Vec3> &x = mesh_.vertices, &v = velocity_;
  for (const std::vector<Vec3> *a :
       {&x, &v, &spin_, &next_, &next_velocity_, &built_at_, &turned_from_})
    total += a->size() * sizeof(Vec3);
  return total;
}

}    // namespace lsdcd
