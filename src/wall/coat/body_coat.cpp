// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/coat/body_coat.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "mesh/surface_points.h"
#include "wall/spec/mesh_name.h"
#include "wall/sums/each_contact.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr std::size_t kMostCoatPoints = 1000000;

// Overlaps over the radius: to warn of, and to stop at. A point that goes less than kBetweenLooks of its radius from one look
// to the next is seen where it goes through a mesh.
constexpr Real kDeep = 0.5, kThrough = 0.9, kBetweenLooks = 2 * (1 - kThrough);

std::vector<int> others_of(const WallSpec &wall, int mesh)
{
  std::vector<int> others;
  for (int k = 0; k < static_cast<int>(wall.meshes.size()); k++)
    if (k != mesh) others.push_back(k);
  return others;
}

// Returns the laws of a coat's points with these meshes. Points are spheres without heat whatever grains are.
std::vector<ContactLaw> laws_of(const WallSpec &wall, const std::vector<int> &meshes)
{
  std::vector<ContactLaw> laws;
  for (const int mesh : meshes) {
    ContactLaw &law = laws.emplace_back(law_of_all_types(wall, mesh));
    law.heat = HeatModel::none;
    law.for_shapes = law.keeps_touch = law.keeps_losses = false;
  }
  return laws;
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

// Returns the mobility of a body in the frame of another mesh, whose contacts have normals into the body.
Mobility turned(const Mobility &m, const Pose &from, const Pose &to)
{
  Mobility out;
  out.point = to.to_mesh(from.to_box(m.point));
  out.shifts = turned(m.shifts, from, to);
  out.turns = turned(m.turns, from, to);
  out.into_stop = to.turn_to_mesh(from.turn_to_box(-m.into_stop));
  out.turn_into_stop = to.turn_to_mesh(from.turn_to_box(-m.turn_into_stop));
  return out;
}

// The pose of a mesh in the frame of another one, at rest.
Pose seen_from(const Pose &other, const Pose &own)
{
  Pose pose;
  pose.placed = true;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++)
        pose.row[i][j] = (k == 0 ? 0 : pose.row[i][j]) + other.row[k][i] * own.row[k][j];
  pose.shift = other.to_mesh(own.shift);
  return pose;
}

// n.K n of a body at a place of the box, by the normal out of it.
Real gives_way(const MeshPart &m, const Mobility &mobility, const Vec3 &at, const Vec3 &normal)
{
  const Pose &pose = m.pose();
  return mobility.along(pose.to_mesh(at), pose.turn_to_mesh(normal));
}

// The velocities that pushes give a body, in the frame of the box.
struct Yield {
  Vec3 shift, turn, point;    // of `point`

  Yield(const CoatPushes::Push &push, const MeshPart &m, const Mobility &mobility)
  {
    const Pose &pose = m.pose();
    point = pose.to_box(mobility.point);
    const Vec3 force = pose.turn_to_mesh(push.force),
               torque = pose.turn_to_mesh(push.torque_at_origin - cross(point, push.force));
    const bool moves = !mobility.is_borne(force, torque);
    shift = moves ? pose.turn_to_box(mobility.shifts * force) : Vec3{0, 0, 0};
    turn = moves ? pose.turn_to_box(mobility.turns * torque) : Vec3{0, 0, 0};
  }
  Real along(const Vec3 &at, const Vec3 &normal) const
  {
    return dot(normal, shift + cross(turn, at - point));
  }
};

}    // namespace

BodyCoat::BodyCoat(Host &host, const WallSpec &wall, int mesh, const MeshGrid &grid,
                   EngineSettings engine, Real force) :
    host_(host),
    wall_(wall), mesh_(mesh), force_(force), others_(others_of(wall, mesh)),
    laws_(laws_of(wall, others_)), history_(host, laws_.front())
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

  engine.laws = LawTable();
  engine.laws.laws = laws_;
  engine.meshes = static_cast<int>(others_.size());
  engine.surface = SurfaceMotion();
  for (const MeshSpec &m : wall.meshes)
    if (!engine.surface.moves()) engine.surface = m.surface;
  engine.moves = engine.contacts = engine.bodies = true;
  engine.wear = WearModel::none;
  engine.energy_places &= wall.energy;
  engine.impact_speed = 0;
  engine.device = Device::cpu;
  engine_ = make_cpu_engine(engine);
  history_.set_engine(*engine_);
  history_.grow(static_cast<int>(n));
}

std::string BodyCoat::named(const std::string &text) const
{
  return with_mesh_name(wall_, mesh_, text);
}

std::string BodyCoat::text() const
{
  const Real gap_sq = apart_ * apart_ / 3;
  std::string t = counted(points_.size(), "point") + " at most " + number_text(apart_) +
                  " apart, of radius " + number_text(radius_) + ": other meshes feel the body " +
                  number_text(radius_) + " outside of its surface; ";
  if (radius_ * radius_ <= gap_sq)
    return t + "their edges and corners pass between the points, which are more than 1.73 radii "
               "apart";
  return t + "their edges and corners sink up to " +
         number_text(radius_ - std::sqrt(radius_ * radius_ - gap_sq)) +
         " deeper between the points";
}

// The engine counts the other meshes from 0.
BodyCoat::FeatureName BodyCoat::of_others(const FeatureName &name) const
{
  return [&](int mesh, FeatureCode f) { return name(others_[mesh], f); };
}

void BodyCoat::rename_features(const FeatureName &name)
{
  history_.on_cpu();
  history_.rename_features(of_others(name));
}

void BodyCoat::set_grid(const MeshPart &m)
{
  const auto at = std::find(others_.begin(), others_.end(), m.index);
  if (at == others_.end()) return;
  engine_->set_grid(m.grid.view(), static_cast<int>(at - others_.begin()));
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

// The surface motion of the other mesh, in its frame, less that of the body. It is exact, but for the part of a velocity of
// half a step ago that is due to turning, where both surfaces turn.
SurfaceMotion BodyCoat::surface_against(const MeshPart &own, const MeshPart &other) const
{
  const SurfaceMotion &mine = own.mover.surface_motion();
  SurfaceMotion s = other.mover.surface_motion();
  if (!mine.moves()) return s;
  const Pose &from = own.pose(), &to = other.pose();
  const auto turned = [&](const Vec3 &a) { return to.turn_to_mesh(from.turn_to_box(a)); };
  const Vec3 angular = turned(mine.angular), centre = to.to_mesh(from.to_box(mine.centre));
  if (norm_sq(s.angular) == 0) s.centre = centre;
  s.velocity -= turned(mine.velocity) + cross(angular, s.centre - centre);
  s.angular -= angular;
  return s;
}

StepSettings BodyCoat::settings(const std::deque<MeshPart> &meshes, const Step &step)
{
  const MeshPart &own = meshes[mesh_];
  surfaces_.clear();
  mobilities_.clear();
  for (const int k : others_) {
    const MeshPart &m = meshes[k];
    surfaces_.push_back(surface_against(own, m));
    mobilities_.push_back(turned(own.mobility(), own.pose(), m.pose()));
  }
  StepSettings s;
  s.dt = step.dt;
  s.update_history = step.kind == Step::step;
  s.per_sphere = s.contacts = true;
  s.surface = surfaces_.data();
  s.mobility = mobilities_.data();
  return s;
}

void BodyCoat::add_receded(const Receded &receded, StepSettings &step)
{
  receded_.clear();
  for (const int k : others_) receded_.push_back(receded[static_cast<std::size_t>(k)]);
  step.receded = receded_.data();
}

// Puts all meshes where they are when this share of their way since the step before is done.
void BodyCoat::put(const std::deque<MeshPart> &meshes, Real share, Real back)
{
  const auto pose = [&](int mesh) {
    const Mover &m = meshes[mesh].mover;
    return share < 1 ? between(m.pose_before(), m.pose(), share) : m.pose();
  };
  for (std::size_t k = 0; k < others_.size(); k++)
    engine_->set_pose(pose(others_[k]), static_cast<int>(k));
  place(pose(mesh_), back);
}

void BodyCoat::choose(const std::deque<MeshPart> &meshes)
{
  const Spheres s = spheres();
  if (!restored_.empty()) take_restored(meshes);
  history_.to_engine(s.n);
  SphereDrift drift;
  drift.kind = SphereDrift::watched;
  drift.distance = 0.5 * radius_;
  engine_->choose_if_due(s, drift, {});
}

// Computes contacts without another effect.
void BodyCoat::look(StepSettings want)
{
  want.update_history = false;
  want.looks = true;
  engine_->step(spheres(), want);
  engine_->read_diagnostics();
}

void BodyCoat::begin(const std::deque<MeshPart> &meshes, const Step &step, CoatPushes &pushes)
{
  is_as_placed_ &= step.kind != Step::step;
  contacts_.clear();
  for (Real &mass : masses_) mass = heavy_;
  try {
    check_way(meshes, step);
    put(meshes, 1, step.kind == Step::step ? step.dt / 2 : 0);
    choose(meshes);
    if (engine_->n_candidates() == 0) return;
    look(settings(meshes, step));
  } catch (const std::exception &e) {
    throw InputError(named(std::string("in its coat, ") + e.what()));
  }
  find_contacts(meshes, pushes);
}

void BodyCoat::finish(const std::deque<MeshPart> &meshes, const Step &step,
                      const CoatPushes &pushes, const Receded &receded,
                      std::vector<CoatLoad> &loads, CoatEnergy &energy)
{
  take_masses(meshes, pushes);
  for (std::size_t i = 0; i < points_.size(); i++) force_on_[i] = torque_on_[i] = {0, 0, 0};
  try {
    StepSettings want = settings(meshes, step);
    if (!receded.empty()) add_receded(receded, want);
    engine_->step(spheres(), want);
    engine_->read_diagnostics();
  } catch (const std::exception &e) {
    throw InputError(named(std::string("in its coat, ") + e.what()));
  }
  add_loads(meshes, loads);
  add_stiffness(meshes, loads);
  if (wall_.energy) add_energy(energy);
  check_depth();
}

// Looks at the contacts on the way of a body that goes far in a step: at a step's end a point may be behind a mesh already.
void BodyCoat::check_way(const std::deque<MeshPart> &meshes, const Step &step)
{
  const MeshPart &own = meshes[mesh_];
  const Real longest = kBetweenLooks * radius_;
  Real way = 0;
  for (const int k : others_) {
    const MeshPart &other = meshes[k];
    const Pose before = seen_from(other.mover.pose_before(), own.mover.pose_before()),
               now = seen_from(other.pose(), own.pose());
    const Real far = farthest_between(before, now, own.bounds(0));
    if (far <= longest) continue;
    const Box swept = swept_bounds(before, now, own.bounds(radius_ + far));
    if (overlap(swept, other.bounds(0))) way = std::max(way, far);
  }
  constexpr Real kMostLooks = 1000;
  const std::string moves = "the body moves by " + number_text(way) + " in step " +
                            std::to_string(step.number) + ", " + number_text(way / radius_) +
                            " radii of its coat, ";
  if (way > kMostLooks * longest)
    throw InputError(moves + "and may pass through another mesh: use a shorter timestep");
  const int looks = static_cast<int>(std::ceil(way / longest));
  for (int i = 1; i < looks; i++) {
    put(meshes, static_cast<Real>(i) / looks, 0);
    choose(meshes);
    if (engine_->n_candidates() == 0) continue;
    look(settings(meshes, step));
    int other = 0;
    if (deepest(other) >= kThrough)
      throw InputError(moves + "and passes through mesh '" + wall_.meshes[other].name +
                       "': use a shorter timestep");
  }
}

// Do joints hold what touches along the normal? A free body gives way by 1/mass at least.
bool BodyCoat::is_held(Real gives_way) const
{
  constexpr Real kHeld = 0.1;
  return gives_way < kHeld / body_mass();
}

void BodyCoat::find_contacts(const std::deque<MeshPart> &meshes, CoatPushes &pushes)
{
  const StepContact *contact = engine_->results().contacts().data();
  for (const TouchingSphere &t : engine_->results().touching()) {
    const int i = t.sphere;
    const StepContact *strongest = nullptr;
    for (int n = 0; n < t.n_contacts; n++, contact++)
      if (norm_sq(contact->arm) > 0 && (!strongest || contact->normal > strongest->normal))
        strongest = contact;
    if (!strongest) continue;    // the point lies on the mesh
    const int other = others_[strongest->mesh];
    const Vec3 arm = meshes[other].pose().turn_to_box(strongest->arm);
    const PointContact c = {i, other, x_[i] - arm, 1 / norm(arm) * arm};
    contacts_.push_back(c);
    pushes.add(other, mesh_, c.at, c.normal);
  }
}

// Damping takes the mass 1/(n.K n) of both bodies at a contact that is alone. Of several, each takes the mass that it moves
// where all push alike: 1/(sum of n.K n' over these). N of them under the middle of a body of mass M damp as one of mass M
// and of N times the stiffness. A contact whose push others take back, as on the other side of the body, counts as alone.
// The engine adds n.K n of this body itself. Where joints hold both along the normal, damping takes the mass of this
// body, shared by the contacts: it is for what moves along the surface.
void BodyCoat::take_masses(const std::deque<MeshPart> &meshes, const CoatPushes &pushes)
{
  constexpr Real kRounding = 1e-9;
  if (contacts_.empty()) return;
  const int n = static_cast<int>(meshes.size());
  std::vector<Mobility> mobility(meshes.size());
  std::vector<std::vector<Yield>> yields(meshes.size());
  for (const MeshPart &m : meshes) {
    if (!m.body) continue;
    mobility[m.index] = m.mobility();
    for (int by = 0; by < n; by++)
      if (pushes.on(m.index, by).contacts > 0)
        yields[m.index].emplace_back(pushes.on(m.index, by), m, mobility[m.index]);
  }
  for (const PointContact &c : contacts_) {
    const auto alone = [&](int mesh, const Vec3 &out) {
      return meshes[mesh].body ? gives_way(meshes[mesh], mobility[mesh], c.at, out) : 0;
    };
    const auto together = [&](int mesh, const Vec3 &normal) {
      Real sum = 0;
      for (const Yield &of : yields[mesh]) sum += std::max<Real>(0, of.along(c.at, normal));
      return sum;
    };
    const Real own = alone(mesh_, -c.normal), other = alone(c.other, c.normal);
    if (is_held(own + other)) {
      masses_[c.point] = 1 / (pushes.on(mesh_, c.other).contacts / body_mass() - own);
      continue;
    }
    const Real all = together(mesh_, c.normal) + together(c.other, -c.normal);
    masses_[c.point] =
        1 / (1 / heavy_ + (all > (1 + kRounding) * (own + other) ? all - own : other));
  }
}

void BodyCoat::add_loads(const std::deque<MeshPart> &meshes, std::vector<CoatLoad> &loads) const
{
  CoatLoad &own = loads[mesh_];
  for (std::size_t k = 0; k < others_.size(); k++) {
    const WallTotals t = engine_->results().mesh_totals(static_cast<int>(k));
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

// A contact counts with the mesh that is touched. The work of the mesh is that of both: what the touched mesh has not done on the
// contacts, the body has lost.
void BodyCoat::add_energy(CoatEnergy &energy) const
{
  StepResults &left = engine_->results();
  for (std::size_t k = 0; k < others_.size(); k++) {
    const EnergyRows rows = left.energy(static_cast<int>(k));
    energy.rows[mesh_][EnergyRow::drive] += rows[EnergyRow::work] - rows[EnergyRow::drive];
    energy.rows[others_[k]].add(rows);
  }
  const EnergyRecords records = left.energy_records();
  for (int k = 0; k < records.n; k++) {
    EnergyRecord record = records.at[k];
    record.mesh = static_cast<std::uint32_t>(others_[record.mesh]);
    energy.records.push_back(record);
  }
}

// The stiffness of each contact, to both bodies.
void BodyCoat::add_stiffness(const std::deque<MeshPart> &meshes, std::vector<CoatLoad> &loads) const
{
  const MeshPart &own = meshes[mesh_];
  const Mobility own_gives = own.mobility();
  for_each_contact(engine_->results(), [&](const TouchingSphere &t, const StepContact &contact) {
    const MeshPart &other = meshes[others_[contact.mesh]];
    const Real distance = norm(contact.arm);
    if (!(distance > 0)) return;    // the point lies on the mesh
    const Vec3 arm = other.pose().turn_to_box(contact.arm), normal = 1 / distance * arm,
               at = x_[t.sphere] - arm;
    const Real mass = 1 / (1 / masses_[t.sphere] + gives_way(own, own_gives, at, -normal));
    const ContactSlopes slopes =
        contact_slopes(laws_[contact.mesh], std::max<Real>(0, radius_ - distance), radius_, mass);
    for (const MeshPart *m : {&own, &other}) {
      CoatLoad &load = loads[m->index];
      load.mass = std::max(load.mass, mass);
      if (!m->body) continue;
      const Mobility &mobility = m->body->mobility_to_forces();
      const Pose &pose = m->pose();
      const Vec3 x = pose.to_mesh(at);
      for_each_direction(normal, slopes, [&](const Vec3 &direction, const ContactSlope &of) {
        const Vec3 d = pose.turn_to_mesh(direction);
        load.stiffness.add(mobility, x, d, of.stiffness);
        load.damping.add(mobility, x, d, of.damping);
        const Real gives_way = mobility.along(x, d);
        load.most += {of.stiffness * gives_way, of.damping * gives_way};
      });
    }
  });
}

// The largest overlap over the radius, and the mesh that it is with.
Real BodyCoat::deepest(int &other) const
{
  Real most = 0;
  for (std::size_t k = 0; k < others_.size(); k++) {
    const Real ratio = engine_->results().mesh_totals(static_cast<int>(k)).largest_overlap_ratio;
    if (ratio > most) other = others_[k];
    most = std::max(most, ratio);
  }
  return most;
}

// A point that goes through the other mesh would be pushed out on its other side.
void BodyCoat::check_depth()
{
  int other = 0;
  const Real deep = deepest(other);
  if (deep < kDeep || (deep < kThrough && deep_warned_)) return;
  const std::string coat = "its coat of radius " + number_text(radius_),
                    text = named(is_as_placed_
                                     ? coat + " begins with a point that is pressed into mesh '" +
                                           wall_.meshes[other].name + "' by " + number_text(deep) +
                                           " of that: other meshes feel the body " +
                                           number_text(radius_) +
                                           " outside of its surface, so place it " +
                                           number_text(deep * radius_) + " farther from that mesh"
                                     : coat + " is pressed in by " + number_text(deep) +
                                           " of that, and at 1 it goes through the other mesh: "
                                           "give it a larger radius, a shorter spacing, or the "
                                           "contact more stiffness");
  if (deep >= kThrough) throw InputError(text);
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
  history_.on_cpu();
  std::vector<Real> out = {static_cast<Real>(law.history_kind()), static_cast<Real>(n)},
                    packed(history_.max_packed_size());
  for (int i = 0; i < n; i++) {
    const int size = history_.pack_saved(i, packed.data(), of_others(name));
    if (packed[0] == 0) continue;
    out.push_back(i);
    out.insert(out.end(), packed.begin(), packed.begin() + size);
  }
  return out;
}

void BodyCoat::restore(const std::vector<Real> &saved)
{
  restored_.clear();
  is_as_placed_ = false;
  const ContactLaw &law = laws_.front();
  if (saved.size() < 2) return;
  if (law.has_history() && saved[0] == static_cast<Real>(law.history_kind()) &&
      saved[1] == static_cast<Real>(points_.size()))
    restored_ = saved;
  else
    host_.warn(named("the springs of its coat start from zero: the " +
                     std::string(host_.names().saved) +
                     " was written with a different coat or contact law"));
}

void BodyCoat::take_restored(const std::deque<MeshPart> &meshes)
{
  const int n = static_cast<int>(points_.size());
  const Real *at = restored_.data() + 2, *const end = restored_.data() + restored_.size();
  bool lost = false;
  history_.clear();
  history_.set_kind_of_file(restored_.front());
  while (at < end) {
    const int i = static_cast<int>(*at++);
    const std::size_t size =
        at < end ? 1 + static_cast<std::size_t>(*at) * history_.numbers_per_contact() : 1;
    lost = i < 0 || i >= n || static_cast<std::size_t>(end - at) < size;
    if (lost) break;
    history_.unpack_saved(i, at, static_cast<int>(size));
    at += size;
  }
  restored_.clear();
  lost |= history_.drop_unknown(n, [&](const Spring &s) {
    return s.mesh < others_.size() && meshes[others_[s.mesh]].has(s.feature);
  }) > 0;
  if (lost)
    host_.warn(named("points of its coat lose their springs: the " +
                     std::string(host_.names().saved) + " was written with a different mesh"));
}

std::size_t BodyCoat::bytes() const
{
  return engine_->bytes() + history_.bytes() +
         points_.size() * (6 * sizeof(Vec3) + 2 * sizeof(Real));
}

}    // namespace lsdcd
