// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/body_coat.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "law/contact_slope.h"
#include "mesh/surface_points.h"
#include "wall/mesh_name.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr std::size_t kMostCoatPoints = 1000000;

// A law without what only spheres have.
ContactLaw law_of_coat(ContactLaw law)
{
  law.heat = HeatModel::none;
  return law;
}

SymmetricMatrix turned(const SymmetricMatrix &m, const Pose &from, const Pose &to)
{
  Vec3 column[3];
  for (int k = 0; k < 3; k++) {
    Vec3 unit = {0, 0, 0};
    unit[k] = 1;
    column[k] = to.turn_to_mesh(from.turn_to_box(m * from.turn_to_mesh(to.turn_to_box(unit))));
  }
  return {column[0].x, column[1].y, column[2].z, column[0].y, column[0].z, column[1].z};
}

// The same, in the frame of another mesh.
Mobility turned(const Mobility &m, const Pose &from, const Pose &to)
{
  Mobility out;
  out.point = to.to_mesh(from.to_box(m.point));
  out.shifts = turned(m.shifts, from, to);
  out.turns = turned(m.turns, from, to);
  return out;
}

}    // namespace

BodyCoat::BodyCoat(Host &host, const WallSpec &wall, int mesh, const MeshGrid &grid,
                   EngineSettings engine, Real force) :
    host_(host),
    wall_(wall), mesh_(mesh), force_(force)
{
  constexpr Real kPartOfDiagonal = 1. / 30, kRadiusOfSpacing = 0.75;
  const MeshReport &r = grid.report();
  apart_ = spec().spacing > 0 ? spec().spacing : kPartOfDiagonal * norm(r.hi - r.lo);
  radius_ = spec().radius > 0 ? spec().radius : kRadiusOfSpacing * apart_;
  run_collectively(host, host.is_first(), [&] {
    points_ = surface_points(*grid.mesh(), apart_, kMostCoatPoints);
    if (points_.empty())
      throw InputError(named("a coat of points " + number_text(apart_) +
                             " apart would need more than " + std::to_string(kMostCoatPoints) +
                             " points: give a longer spacing"));
  });
  std::uint64_t n = points_.size();
  host.broadcast(&n, sizeof n, 0);
  points_.resize(n);
  host.broadcast(points_.data(), n * sizeof(Vec3), 0);

  for (std::vector<Vec3> *all : {&x_, &v_, &omega_, &force_on_, &torque_on_})
    all->assign(n, {0, 0, 0});
  radii_.assign(n, radius_);
  // On a mesh that is no body a point is so heavy that damping sees the mobility of this body alone.
  constexpr Real kHeavy = 1e9;
  heavy_ = kHeavy * body_mass();
  masses_.assign(n, heavy_);

  for (int k = 0; k < static_cast<int>(wall.meshes.size()); k++)
    if (k != mesh) others_.push_back(k);
  for (const int k : others_) laws_.push_back(law_of_coat(law_of_all_types(wall, k)));
  engine.laws = LawTable();
  engine.laws.laws = laws_;
  engine.meshes = static_cast<int>(others_.size());
  engine.surface = SurfaceMotion();
  for (const MeshSpec &m : wall.meshes)
    if (!engine.surface.moves()) engine.surface = m.surface;
  engine.moves = engine.records = engine.bodies = true;
  engine.wear = WearModel::none;
  engine.device = Device::cpu;
  engine_ = make_cpu_engine(engine);
}

std::string BodyCoat::named(const std::string &text) const
{
  return with_mesh_name(wall_, mesh_, text);
}

std::string BodyCoat::text() const
{
  const Real gap_sq = apart_ * apart_ / 3;
  const std::string n = std::to_string(points_.size());
  std::string t = n + " points at most " + number_text(apart_) + " apart, of radius " +
                  number_text(radius_) + ": other meshes feel the body " + number_text(radius_) +
                  " outside of its surface; ";
  if (radius_ * radius_ <= gap_sq)
    return t + "their edges and corners pass between the points, which are more than 1.73 radii "
               "apart";
  return t + "their edges and corners sink up to " +
         number_text(radius_ - std::sqrt(radius_ * radius_ - gap_sq)) +
         " deeper between the points";
}

// Those of the last step.
ContactHistory BodyCoat::springs(const FeatureName &name)
{
  const int n = static_cast<int>(points_.size());
  ContactHistory springs(laws_.front().n_extra());
  engine_->springs_to(springs, n);
  springs.grow(n);
  springs.rename_features([&](int mesh, FeatureCode f) { return name(others_[mesh], f); });
  return springs;
}

void BodyCoat::rename_features(const FeatureName &name)
{
  if (laws_.front().has_history())
    engine_->springs_from(springs(name), static_cast<int>(points_.size()));
}

void BodyCoat::set_grid(const MeshPart &m)
{
  const auto at = std::find(others_.begin(), others_.end(), m.index);
  if (at == others_.end()) return;
  engine_->set_grid(m.grid.view(), static_cast<int>(at - others_.begin()));
  is_stale_ = true;
}

// ---- a step ------------------------------------------------------------------------------

// Velocities are those of the time `back` before now, as the contact law takes those of meshes.
void BodyCoat::place(const Pose &pose, Real back)
{
  const Vec3 omega = pose.angular - back * pose.spin_up,
             velocity = pose.velocity - back * pose.acceleration;
  for (std::size_t i = 0; i < points_.size(); i++) {
    const Vec3 arm = pose.turn_to_box(points_[i]), turning = cross(omega, arm);
    x_[i] = arm + pose.shift;
    v_[i] = velocity + turning - back * cross(omega, turning);
    omega_[i] = omega;
    force_on_[i] = torque_on_[i] = {0, 0, 0};
  }
}

Spheres BodyCoat::spheres()
{
  Spheres s;
  s.n = static_cast<int>(points_.size());
  s.x = &x_[0].x;
  s.v = &v_[0].x;
  s.omega = &omega_[0].x;
  s.force = &force_on_[0].x;
  s.torque = &torque_on_[0].x;
  s.radius = radii_.data();
  s.mass = masses_.data();
  return s;
}

StepSettings BodyCoat::settings(const std::deque<MeshPart> &meshes, const Step &step)
{
  const MeshPart &own = meshes[mesh_];
  surfaces_.clear();
  mobilities_.clear();
  for (const int k : others_) {
    const MeshPart &m = meshes[k];
    surfaces_.push_back(m.motion.surface());
    mobilities_.push_back(turned(own.body->mobility(), own.motion.pose(), m.motion.pose()));
  }
  StepSettings s;
  s.dt = step.dt;
  s.update_history = step.kind == Step::step;
  s.per_sphere = s.records = true;
  s.surface = surfaces_.data();
  s.mobility = mobilities_.data();
  return s;
}

void BodyCoat::step(const std::deque<MeshPart> &meshes, const Step &step,
                    std::vector<CoatLoad> &loads)
{
  for (std::size_t k = 0; k < others_.size(); k++)
    engine_->set_pose(meshes[others_[k]].motion.pose(), static_cast<int>(k));
  const StepSettings want = settings(meshes, step);
  place(meshes[mesh_].motion.pose(), want.update_history ? step.dt / 2 : 0);
  const Spheres s = spheres();
  try {
    if (!restored_.empty()) take_restored(meshes);
    if (is_stale_ || engine_->has_moved(s)) engine_->choose(s, 0.5 * radius_, true);
    is_stale_ = false;
    take_masses(meshes, s, want);
    engine_->step(s, want);
    engine_->read_diagnostics();
  } catch (const std::exception &e) {
    throw InputError(named(std::string("in its coat, ") + e.what()));
  }
  add_loads(meshes, loads);
  add_stiffness(meshes, loads);
  check_depth();
}

// Do joints hold what touches along the normal? A free body gives way by 1/mass at least.
bool BodyCoat::is_held(Real gives_way) const
{
  constexpr Real kHeld = 0.1;
  return gives_way < kHeld / body_mass();
}

// Damping takes 1/mass + n.K n, with K of this body. The mass of a point on another body is its 1/(n.K n), for the normal
// that a first look at the contacts gives: that of the strongest, where a point has several. Where joints hold both along
// the normal, damping takes the mass of this body: it is for what moves along the surface.
void BodyCoat::take_masses(const std::deque<MeshPart> &meshes, const Spheres &s,
                           const StepSettings &want)
{
  for (const int i : lighter_) masses_[i] = heavy_;
  lighter_.clear();
  const MeshPart &own = meshes[mesh_];
  const bool has_joint = own.body->body().joint().kind != JointKind::free,
             any_body = std::any_of(others_.begin(), others_.end(),
                                    [&](int k) { return meshes[k].body != nullptr; });
  if ((!any_body && !has_joint) || engine_->n_candidates() == 0) return;
  StepSettings look = want;
  look.update_history = false;
  engine_->step(s, look);
  const ContactRecord *record = engine_->records();
  for (int k = 0; k < engine_->n_touching(); k++) {
    const int i = engine_->touching()[k];
    Real strongest = -HUGE_VAL;
    for (int n = 0; n < static_cast<int>(engine_->sphere_output()[k].contacts); n++, record++) {
      const MeshPart &other = meshes[others_[record->mesh]];
      const Real distance = norm(record->arm);
      if (!(other.body || has_joint) || !(distance > 0) || !(record->normal > strongest)) continue;
      strongest = record->normal;
      const Vec3 at = other.motion.pose().to_mesh(x_[i]) - record->arm;
      const Real gives_way =
          other.body ? other.body->mobility().along(at, 1 / distance * record->arm) : 0;
      masses_[i] = other.body ? 1 / (1 / heavy_ + gives_way) : heavy_;
      if (!has_joint) continue;
      const Pose &there = other.motion.pose(), &here = own.motion.pose();
      const Real gives = own.body->mobility().along(
          here.to_mesh(there.to_box(at)),
          here.turn_to_mesh(there.turn_to_box(1 / distance * record->arm)));
      if (is_held(gives + gives_way)) masses_[i] = 1 / (1 / body_mass() - gives);
    }
    if (masses_[i] != heavy_) lighter_.push_back(i);
  }
}

void BodyCoat::add_loads(const std::deque<MeshPart> &meshes, std::vector<CoatLoad> &loads) const
{
  CoatLoad &own = loads[mesh_];
  for (std::size_t k = 0; k < others_.size(); k++) {
    const WallTotals t = engine_->mesh_totals(static_cast<int>(k));
    if (t.contacts == 0) continue;
    CoatLoad &other = loads[others_[k]];
    other.force += t.force;
    other.torque_at_origin += t.torque;
    other.energy += t.energy;
    own.force -= t.force;
    own.torque_at_origin -= t.torque;
    for (CoatLoad *load : {&own, &other}) {
      load->contacts += static_cast<Real>(t.contacts);
      load->overlap = std::max(load->overlap, t.largest_overlap_ratio);
      load->radius = std::max(load->radius, radius_);
    }
    if (!meshes[others_[k]].body) continue;
    own.bodies |= std::uint32_t(1) << others_[k];
    other.bodies |= std::uint32_t(1) << mesh_;
  }
}

// The stiffness of each contact, to both bodies.
void BodyCoat::add_stiffness(const std::deque<MeshPart> &meshes, std::vector<CoatLoad> &loads) const
{
  const MeshPart &own = meshes[mesh_];
  const Mobility &own_gives = own.body->mobility_to_forces();
  const ContactRecord *record = engine_->records();
  for (int k = 0; k < engine_->n_touching(); k++) {
    const int i = engine_->touching()[k];
    for (int n = 0; n < static_cast<int>(engine_->sphere_output()[k].contacts); n++, record++) {
      const MeshPart &other = meshes[others_[record->mesh]];
      const Real distance = norm(record->arm);
      if (!(distance > 0)) continue;    // the point lies on the mesh
      const Pose &pose = other.motion.pose();
      const Vec3 arm = pose.turn_to_box(record->arm), normal = 1 / distance * arm,
                 along = any_perpendicular(normal), at = x_[i] - arm;
      const auto gives = [&](const MeshPart &m, const Mobility &mobility, const Vec3 &direction) {
        const Pose &p = m.motion.pose();
        return mobility.along(p.to_mesh(at), p.turn_to_mesh(direction));
      };
      Real yields = gives(own, own_gives, normal);
      if (other.body) yields += gives(other, other.body->mobility_to_forces(), normal);
      const Real mass = is_held(yields / force_) ? body_mass() : 1 / (1 / heavy_ + yields / force_);
      const ContactSlopes slope =
          contact_slopes(laws_[record->mesh], std::max<Real>(0, radius_ - distance), radius_, mass);
      const auto add = [&](const MeshPart &m, const Vec3 &direction, const ContactSlope &of) {
        const Mobility &mobility = m.body->mobility_to_forces();
        const Pose &p = m.motion.pose();
        const Vec3 x = p.to_mesh(at), d = p.turn_to_mesh(direction);
        CoatLoad &load = loads[m.index];
        load.stiffness.add(mobility, x, d, of.stiffness);
        load.damping.add(mobility, x, d, of.damping);
        const Real gives_way = mobility.along(x, d);
        load.most += {of.stiffness * gives_way, of.damping * gives_way};
        load.mass = std::max(load.mass, mass);
      };
      for (const MeshPart *m : {&own, &other}) {
        if (!m->body) continue;
        add(*m, normal, slope.normal);
        add(*m, along, slope.tangential);
        add(*m, cross(normal, along), slope.tangential);
      }
    }
  }
}

// A point that goes through the other mesh would be pushed out on its other side.
void BodyCoat::check_depth()
{
  constexpr Real kDeep = 0.5, kThrough = 0.9;    // of the radius
  Real deepest = 0;
  for (std::size_t k = 0; k < others_.size(); k++)
    deepest = std::max(deepest, engine_->mesh_totals(static_cast<int>(k)).largest_overlap_ratio);
  if (deepest < kDeep || (deepest < kThrough && deep_warned_)) return;
  const std::string text = named("its coat of radius " + number_text(radius_) +
                                 " is pressed in by " + number_text(deepest) +
                                 " of that, and at 1 it goes through the other mesh: give it a "
                                 "larger radius, a shorter spacing, or the contact more stiffness");
  if (deepest >= kThrough) throw InputError(text);
  deep_warned_ = true;
  host_.warn(text + ". Shown once");
}

// ---- restarts ----------------------------------------------------------------------------

// The kind of the springs, the number of points, and for each with springs its number and these, as ContactHistory
// packs them.
std::vector<Real> BodyCoat::save(const FeatureName &name)
{
  const ContactLaw &law = laws_.front();
  if (!law.has_history()) return {};
  if (!restored_.empty()) return restored_;    // no step was made since
  const int n = static_cast<int>(points_.size());
  const ContactHistory springs = this->springs(name);
  std::vector<Real> out = {static_cast<Real>(law.history_kind()), static_cast<Real>(n)};
  for (int i = 0; i < n; i++) {
    if (springs.count(i) == 0) continue;
    out.push_back(i);
    out.resize(out.size() + springs.packed_size(i));
    springs.pack(i, out.data() + out.size() - springs.packed_size(i));
  }
  return out;
}

void BodyCoat::restore(const std::vector<Real> &saved)
{
  restored_.clear();
  const ContactLaw &law = laws_.front();
  if (saved.size() < 2) return;
  if (law.has_history() && saved[0] == static_cast<Real>(law.history_kind()) &&
      saved[1] == static_cast<Real>(points_.size()))
    restored_ = saved;
  else
    host_.warn(named("the springs of its coat start from zero: the " +
                     std::string(host_.names().saved) +
                     " was written with another coat or contact law"));
}

void BodyCoat::take_restored(const std::deque<MeshPart> &meshes)
{
  const int n = static_cast<int>(points_.size());
  ContactHistory springs(laws_.front().n_extra());
  springs.grow(n);
  const Real *at = restored_.data() + 2, *const end = restored_.data() + restored_.size();
  bool lost = false;
  while (at < end) {
    const int i = static_cast<int>(*at++);
    const std::size_t size =
        at < end ? 1 + static_cast<std::size_t>(*at) * springs.doubles_per_spring() : 1;
    if (i < 0 || i >= n || static_cast<std::size_t>(end - at) < size) {
      lost = true;
      break;
    }
    springs.unpack(i, at);
    at += size;
    for (int k = 0; k < springs.count(i); k++) {
      const Spring &s = springs.of(i)[k];
      const bool is_there = s.mesh < others_.size() &&
                            !meshes[others_[s.mesh]].springs_are_foreign &&
                            meshes[others_[s.mesh]].grid.has(s.feature);
      if (is_there) continue;
      lost = true;
      springs.clear(i);
      break;
    }
  }
  restored_.clear();
  engine_->springs_from(springs, n);
  if (lost)
    host_.warn(named("points of its coat lose their springs: the " +
                     std::string(host_.names().saved) + " was written with another mesh"));
}

std::size_t BodyCoat::bytes() const
{
  return engine_->bytes() + points_.size() * (6 * sizeof(Vec3) + 2 * sizeof(Real));
}

}    // namespace lsdcd
