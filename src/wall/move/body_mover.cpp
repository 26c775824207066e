// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/move/body_mover.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "base/vector_text.h"
#include "wall/spec/mesh_name.h"
#include "wall/sums/each_contact.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

MassProperties in_units(MassProperties p, Real force)
{
  p.mass /= force;
  p.inertia = 1 / force * p.inertia;
  return p;
}

// Other programs and machines may round the integrals of a mesh otherwise.
bool are_same(const MassProperties &a, const MassProperties &b)
{
  constexpr Real kRounding = 1e-12;
  const Real size = std::sqrt(a.inertia.trace() / a.mass);
  SymmetricMatrix off = a.inertia;
  off += -1 * b.inertia;
  const Vec3 diagonal = {off.xx, off.yy, off.zz}, others = {off.xy, off.xz, off.yz};
  return std::fabs(a.mass - b.mass) <= kRounding * a.mass &&
         norm(a.centre - b.centre) <= kRounding * (size + norm(a.centre)) &&
         norm(diagonal) + norm(others) <= kRounding * a.inertia.trace();
}

// n.K n is convex in the place, so that on a face it is largest at a corner.
Real largest_on_faces(const Mobility &m, const WeldedMesh &mesh)
{
  Real most = 0;
  for (const auto &face : mesh.faces) {
    const Vec3 &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]],
               &c = mesh.vertices[face[2]];
    const Vec3 normal = unit_vector(cross(b - a, c - a));
    for (const Vec3 &x : {a, b, c}) most = std::max(most, m.along(x, normal));
  }
  return most;
}

// An upper bound for any direction at any point of the box.
Real largest_in(const Mobility &m, const Box &box)
{
  const PrincipalAxes shifts = principal_axes(m.shifts), turns = principal_axes(m.turns);
  Real arm = 0;
  for_corners(box, [&](const Vec3 &x) { arm = std::max(arm, norm_sq(x - m.point)); });
  return *std::max_element(shifts.value, shifts.value + 3) +
         arm * *std::max_element(turns.value, turns.value + 3);
}

}    // namespace

BodyMover::BodyMover(Host &host, WallSpec &wall, const LawTable &laws, int mesh,
                     const MeshGrid &grid, Real force, MeshMotion &motion) :
    host_(host),
    wall_(wall), mesh_(mesh), motion_(motion), laws_(laws), grid_(grid), force_(force)
{
  BodySpec &s = spec().body;
  if (s.density > 0) {
    run_collectively(host, host.rank() == 0,
                     [&] { s.mass = mass_properties(*grid.mesh(), s.density); });
    host.broadcast(&s.mass, sizeof s.mass, 0);
  }
  RigidBody body(in_units(s.mass, force), s.joint);
  try {
    body.set_velocity(s.velocity, s.omega);
  } catch (const InputError &e) {
    throw InputError(named(e.what()));
  }
  spec().motion.begin_posed();
  check_spec(s);
  go_on(s, body);
  ask_about_degrees();
}

std::string BodyMover::named(const std::string &text) const
{
  return with_mesh_name(wall_, mesh_, text);
}

void BodyMover::check_spec(const BodySpec &to) const
{
  try {
    check_body(to);
  } catch (const InputError &e) {
    throw InputError(named(e.what()));
  }
}

void BodyMover::check_limits(const BodySpec &to, const RigidBody &as) const
{
  try {
    lsdcd::check_limits(to.drive, as.coordinate());
  } catch (const InputError &e) {
    throw InputError(named(e.what()));
  }
}

void BodyMover::go_on(const BodySpec &to, const RigidBody &as)
{
  spec().body = to;
  body_ = as;
  body_.drive = to.drive;
  const Real at = body_.coordinate();
  if (to.drive.lo <= at && at <= to.drive.hi) body_.hold_at_stop();
  mobility_ = body_.free_mobility();
  const MeshReport &r = grid_.report();
  bound_of_mobility_ = largest_in(mobility_, {r.lo, r.hi});
  most_mobility_ = grid_.mesh() ? largest_on_faces(mobility_, *grid_.mesh()) : 0;
  host_.max(&most_mobility_, 1);
  place();
  motion_.place();
}

void BodyMover::place()
{
  spec().motion.set_pose(body_.pose());
}

void BodyMover::set_body(const BodySpec &to)
{
  const BodySpec was = body_spec();
  BodySpec now = was;
  now.joint = to.joint;
  now.drive = to.drive;
  now.load = to.load;
  now.moment = to.moment;
  now.motor_input = to.motor_input;
  std::copy_n(to.load_input, 3, now.load_input);
  std::copy_n(to.moment_input, 3, now.moment_input);
  now.has_gravity = to.has_gravity;
  now.gravity = to.gravity;
  check_spec(now);
  check_keeps_plane(now.joint);
  RigidBody as = body_;
  if (!(now.joint == was.joint)) {
    as = RigidBody(body_.mass(), now.joint);
    as.begin_from(body_);
  }
  if (place_is_known_) check_limits(now, as);
  was_held_ = JointLoad{reaction(), stop_force()};
  go_on(now, as);
  if (now.drive.lo != was.drive.lo || now.drive.hi != was.drive.hi) ask_about_degrees();
}

// Degrees are mostly whole or half; a number of turns, as 62.83, is not.
void BodyMover::ask_about_degrees() const
{
  const Joint &joint = body_spec().joint;
  const Real lo = body_spec().drive.lo, hi = body_spec().drive.hi, turns = (hi - lo) / (2 * kPi);
  const auto may_be_degrees = [](Real limit) { return 2 * limit == std::floor(2 * limit); };
  if (joint.kind != JointKind::hinge || !std::isfinite(turns) || !(turns > 1) ||
      !may_be_degrees(lo) || !may_be_degrees(hi))
    return;
  host_.warn(named("the limits " + number_text(lo) + " " + number_text(hi) +
                   " of its hinge are in radians, " + number_text(turns) +
                   " turns apart: if degrees are meant, write " + number_text(lo * kPi / 180) +
                   " " + number_text(hi * kPi / 180)));
}

Real BodyMover::spring_and_kinetic_energy() const
{
  return body_.kinetic_energy() + body_.spring_energy();
}

// ---- a step ------------------------------------------------------------------------------

void BodyMover::check_start() const
{
  if (!place_is_known_) check_limits(body_spec(), body_);
}

void BodyMover::advance(const Step &to, const std::vector<Real> &inputs)
{
  check_start();
  place_is_known_ = true;
  was_held_.reset();
  motion_.advance(to, inputs);
  if (to.kind == Step::step) {
    body_.kick(to.dt / 2, load_);
    body_.drift(to.dt);
  }
  place();
}

Pose BodyMover::pose_in(Real later) const
{
  RigidBody next = body_;
  next.kick(later / 2, load_);
  next.drift(later);
  return next.pose();
}

void BodyMover::end(const Step &step, const StepResults *results)
{
  dt_ = step.kind == Step::step ? step.dt : 0;    // no time passes where a run is set up
  pending_ = true;
  if (asks_for_contacts_) sum_contacts(results);
}

Pose BodyMover::complete(const MeshTotals &contacts, const Vec3 &gravity)
{
  pending_ = false;
  const BodySpec &s = body_spec();
  body_.drive.motor = s.drive.motor;
  const Vec3 at_centre = s.load + s.mass.mass * (s.has_gravity ? s.gravity : gravity);
  load_.force = contacts.force + at_centre;
  load_.torque = contacts.torque_at_origin + cross(body_.centre(), at_centre) + s.moment;
  body_.kick(dt_ / 2, load_);
  return body_.pose();
}

// ---- the timestep ------------------------------------------------------------------------

ContactSum BodyMover::spring() const
{
  ContactSum sum;
  if (!body_.joint().has_coordinate()) return sum;
  const bool turns = body_.joint().kind == JointKind::hinge;
  const Vec3 none = {0, 0, 0}, axis = body_.axis_in_mesh();
  sum.add(turns ? none : axis, turns ? axis : none, body_.drive.stiffness);
  return sum;
}

// A bound: all contacts as stiff as any can be, where the body gives way most.
ModeRates BodyMover::of_spheres(const Touch &touch) const
{
  const MeshTotals &contacts = touch.contacts;
  const SphereRange &spheres = touch.spheres;
  ContactSlope one;
  for (int kind = 0; kind < laws_.kinds && contacts.contacts > 0; kind++) {
    const ContactSlope of =
        contact_slope(law_of(laws_, mesh_, kind), contacts.overlap * spheres.radius, spheres.radius,
                      spheres.mass);
    one = {std::max(one.stiffness, of.stiffness), std::max(one.damping, of.damping)};
  }
  const Real of_body = is_held() ? 0 : bound_of_mobility_,
             of_all = contacts.contacts * of_body +
                      (spheres.lightest > 0 ? 1 / (spheres.lightest / force_) : 0);
  return {of_all * one.stiffness, of_all * one.damping};
}

ModeRates BodyMover::rates(const Touch &touch, bool of_coat) const
{
  ModeRates all = of_spheres(touch);
  if (is_held()) return all;
  ContactSum stiffness = spring();
  if (!of_coat) {
    all.stiffness += stiffness.largest(mobility_);
    all += touch.coat.most;
    return all;
  }
  stiffness += touch.coat.stiffness;
  all += {stiffness.largest(mobility_), touch.coat.damping.largest(mobility_)};
  return all;
}

// Bounds first. A contact of two bodies, the squared rates of whose modes are a and b on their own, makes none faster
// than a + b: k (p + q)^2 <= k (1 + b/a) p^2 + k (1 + a/b) q^2 for the parts p and q of its overlap.
void BodyMover::check_step(const Touch &touch, const RatesOfOthers &of_others)
{
  const MeshTotals &contacts = touch.contacts;
  const CoatLoad &coat = touch.coat;
  const bool has_contacts = has_contacts_;
  has_contacts_ = asks_for_contacts_ = false;
  if (dt_ == 0) return;
  Real bound = 0;
  for (const bool of_coat : {false, true}) {
    ModeRates all = rates(touch, of_coat);
    all += of_others(of_coat);
    bound = longest_step(all);
    if (dt_ < bound) return;
  }
  // Contacts of grains that are no spheres do not tell their overlaps and normals: there is no better than the bound.
  const bool sums_contacts = contacts.contacts > 0 && !wall_.shapes;
  asks_for_contacts_ = sums_contacts;
  if (sums_contacts && !has_contacts) return;    // the next step brings them

  ContactSum sums[2];
  Real most_of_sphere[2] = {0, 0};
  if (sums_contacts) {
    constexpr int kNumbers = ContactSum::kNumbers;
    Real both[2 * kNumbers];
    std::copy_n(stiffness_.number, kNumbers, both);
    std::copy_n(damping_.number, kNumbers, both + kNumbers);
    std::copy_n(most_of_sphere_, 2, most_of_sphere);
    host_.sum_and_max(both, 2 * kNumbers, most_of_sphere, 2);
    for (int k = 0; k < 2; k++) std::copy_n(both + k * kNumbers, kNumbers, sums[k].number);
  }
  sums[0] += spring();
  sums[0] += coat.stiffness;
  sums[1] += coat.damping;
  const ModeRates others = of_others(true);
  const Mobility gives = is_held() ? Mobility() : mobility_;
  const Real longest =
      longest_step(sums[0].largest(gives) + std::max(most_of_sphere[0], others.stiffness),
                   sums[1].largest(gives) + std::max(most_of_sphere[1], others.damping));
  if (dt_ >= longest) fail_step(longest, contacts.contacts + coat.contacts);
  if (contacts.contacts > 0 && wall_.shapes) warn_of_step(bound, contacts.contacts);
}

void BodyMover::sum_contacts(const StepResults *results)
{
  has_contacts_ = true;
  stiffness_ = damping_ = ContactSum();
  most_of_sphere_[0] = most_of_sphere_[1] = 0;
  if (!results) return;
  const Pose pose = body_.pose();
  const Mobility mobility = body_.mobility();
  for_each_contact(*results, [&](const TouchingSphere &sphere, const StepContact &contact) {
    const Real distance = norm(contact.arm);
    // Where it is 0 the centre lies on the wall.
    if (contact.mesh != static_cast<std::uint32_t>(mesh_) || !(distance > 0)) return;
    const SphereKinds kinds = {laws_.kinds > 1 ? &sphere.type : nullptr, laws_.kind_of_type.data(),
                               static_cast<int>(laws_.kind_of_type.size()) - 1};
    const Real radius = sphere.radius, mass = sphere.mass / force_;
    const Vec3 normal = 1 / distance * contact.arm, at = pose.to_mesh(sphere.x) - contact.arm;
    const Real together = 1 / (1 / mass + mobility.along(at, normal));
    const ContactSlopes slopes =
        contact_slopes(law_of(laws_, mesh_, kinds[0]), std::max<Real>(0, radius - distance), radius,
                       together * force_);
    for_each_direction(normal, slopes, [&](const Vec3 &direction, const ContactSlope &of) {
      stiffness_.add(mobility_, at, direction, of.stiffness);
      damping_.add(mobility_, at, direction, of.damping);
      most_of_sphere_[0] = std::max(most_of_sphere_[0], of.stiffness / mass);
      most_of_sphere_[1] = std::max(most_of_sphere_[1], of.damping / mass);
    });
  });
}

void BodyMover::fail_step(Real longest, Real contacts) const
{
  throw InputError(named("the timestep " + number_text(dt_) + " is not below " +
                         number_text(longest) + ", with which the body of mass " +
                         number_text(body_spec().mass.mass) + " on " + number_text(contacts) +
                         " contacts would be stable: make the timestep shorter, the body heavier, "
                         "or contacts and spring softer"));
}

void BodyMover::warn_of_step(Real longest, Real contacts)
{
  if (step_warned_) return;
  step_warned_ = true;
  host_.warn(named("the timestep " + number_text(dt_) + " may be too long for the body of mass " +
                   number_text(body_spec().mass.mass) + " on " + number_text(contacts) +
                   " contacts of ellipsoids: were all of them as stiff as any can be, " +
                   number_text(longest) +
                   " would be the longest; where body or grains rattle, make the timestep shorter, "
                   "the body heavier, or contacts softer. This warning is shown once"));
}

// ---- the log and restarts ----------------------------------------------------------------

std::string BodyMover::body_text() const
{
  const MassProperties &p = body_spec().mass;
  const SymmetricMatrix &i = p.inertia;
  const Joint &j = body_spec().joint;
  std::string t = "mass " + number_text(p.mass) + " com " + vector_text(p.centre) + " inertia " +
                  vector_text({i.xx, i.yy, i.zz}) + " " + vector_text({i.xy, i.xz, i.yz}) +
                  ", joint " + kJointNames[static_cast<int>(j.kind)];
  if (j.has_point()) t += " " + vector_text(j.point);
  if (j.kind != JointKind::free && j.kind != JointKind::ball) t += " " + vector_text(j.axis);
  return t;
}

void BodyMover::check_keeps_plane(const Joint &joint) const
{
  if (host_.box().dimension == 2 && !joint.keeps({0, 0, 1}))
    throw InputError(
        named("in two dimensions a body needs a joint that keeps it in the plane z = 0: "
              "hinge or planar along z, or slider in the plane"));
}

void BodyMover::check_snapshot() const
{
  throw InputError(
      named("in a " + std::string(host_.names().replay) +
            " the position of a body is not known, because it follows from the loads of all steps "
            "before: leave body out, and give its positions by motion variable"));
}

void BodyMover::save(MeshState &to) const
{
  to.body = {true,
             body_spec().mass,
             body_spec().joint,
             body_.state(),
             load_,
             {{reaction(), stop_force()}}};
}

RigidBody BodyMover::continued(const BodyState &was) const
{
  RigidBody body(body_.mass(), body_spec().joint);
  if (is_same(was)) {
    body.set_state(was.state);
    return body;
  }
  RigidBody before(in_units(was.mass, force_), was.joint);
  before.set_state(was.state);
  body.begin_from(before);
  return body;
}

void BodyMover::check(const MeshState &was) const
{
  if (was.body.present) check_limits(body_spec(), continued(was.body));
}

void BodyMover::restore(const BodyState &was)
{
  pending_ = false;
  was_held_.reset();
  const std::string saved = host_.names().saved;
  if (!was.present) {
    host_.warn(named("the " + saved +
                     " has no body for this mesh: the body starts at its initial position with its "
                     "initial velocity"));
    go_on(body_spec(), body_);
    return;
  }
  place_is_known_ = was.has_begun;
  go_on(body_spec(), continued(was));
  load_ = was.load;
  if (!was.of_joint.empty()) was_held_ = was.of_joint.front();
  if (!is_same(was))
    host_.warn(
        named("the " + saved +
              " was written with a different mass or joint of this body: the body continues "
              "from where it was, with the part of its velocity that its joint allows" +
              (was.joint == body_spec().joint ? "" : ", and its coordinate starts at 0 there")));
}

bool BodyMover::is_same(const BodyState &was) const
{
  return are_same(was.mass, body_spec().mass) && was.joint == body_spec().joint;
}

}    // namespace lsdcd
