// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/move/mesh_motion.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "wall/spec/mesh_name.h"
#include "wall/spec/spec_text.h"

#include <algorithm>

namespace lsdcd {

namespace {

// Calls visit(input, value) for each input of a mesh.
template <class Visit>
void for_inputs(MeshSpec &mesh, SurfaceMotion &surface, const Visit &visit)
{
  const auto one = [&](int input, Real &value) {
    if (input != kNoInput) visit(input, value);
  };
  for (MotionTerm &m : mesh.motion.terms())
    for (int d = 0; d < 3; d++) {
      one(m.input[d], m.displacement[d]);
      one(m.input[3 + d], m.speed[d]);
    }
  Servo &servo = mesh.motion.servo();
  if (!servo.holds) one(servo.target_input, servo.target);
  one(mesh.body.motor_input, mesh.body.drive.motor);
  for (int d = 0; d < 3; d++) {
    one(mesh.body.load_input[d], mesh.body.load[d]);
    one(mesh.body.moment_input[d], mesh.body.moment[d]);
    one(mesh.surface_input[d], surface.velocity[d]);
    one(mesh.surface_input[3 + d], surface.angular[d]);
  }
}

}    // namespace

MeshMotion::MeshMotion(Host &host, WallSpec &wall, int mesh, const Step &now) :
    host_(host), wall_(wall), mesh_(mesh)
{
  surface_ = surface_now_ = spec().surface;
  read_tables(spec().motion.terms());
  begin(now);
}

std::string MeshMotion::named(const std::string &text) const
{
  return with_mesh_name(wall_, mesh_, text);
}

void MeshMotion::read_tables(std::vector<MotionTerm> &terms) const
{
  for (MotionTerm &m : terms) {
    if (m.kind != MotionKind::table || m.table) continue;
    TableRows rows;
    run_collectively(host_, host_.rank() == 0, [&] {
      try {
        m.table =
            std::make_shared<const MotionTable>(read_motion_table(m.table_file, m.table_options));
      } catch (const InputError &e) {
        throw InputError(named(e.what()));
      }
      rows = m.table->rows();
    });
    std::uint64_t counts[] = {static_cast<std::uint64_t>(rows.columns), rows.numbers.size()};
    host_.broadcast(counts, sizeof counts, 0);
    rows.options = m.table_options;
    rows.columns = static_cast<int>(counts[0]);
    rows.numbers.resize(counts[1]);
    host_.broadcast(rows.numbers.data(), rows.numbers.size() * sizeof(Real), 0);
    if (!m.table)
      m.table = std::make_shared<const MotionTable>(
          rows, [](std::size_t row) { return "row " + std::to_string(row + 1); });
  }
}

void MeshMotion::begin(const Step &now)
{
  clock_ = {0, now.number, now.number, now.dt};
  last_step_ = 0;
  place();
}

bool MeshMotion::moves_or_varies() const
{
  return spec().motion.any() || spec().surface_varies();
}

std::vector<int> MeshMotion::inputs() const
{
  std::vector<int> numbers;
  SurfaceMotion unused;
  for_inputs(spec(), unused, [&](int input, Real &) { numbers.push_back(input); });
  return numbers;
}

bool MeshMotion::has_inputs() const
{
  return !inputs().empty();
}

bool MeshMotion::takes_differences() const
{
  for (const MotionTerm &m : spec().motion.terms())
    for (int d = 0; d < 3; d++)
      if (m.takes_difference(d)) return true;
  return false;
}

bool MeshMotion::adds_up() const
{
  for (const MotionTerm &m : spec().motion.terms())
    for (int d = 0; d < 3; d++)
      if (m.adds_up(d)) return true;
  return false;
}

void MeshMotion::take_inputs(const std::vector<Real> &inputs)
{
  for_inputs(spec(), surface_now_,
             [&](int input, Real &value) { value = inputs.at(static_cast<std::size_t>(input)); });
  surface_ = surface_now_;
  has_values_ = true;
}

Real MeshMotion::advance(const Step &to, const std::vector<Real> &inputs)
{
  before_ = pose_;
  has_before_ = to.kind == Step::step;
  const Time before = clock_.now();
  clock_.advance(to);
  const Real passed = static_cast<Real>(clock_.now() - before);
  last_step_ = to.kind == Step::step ? passed : 0;
  std::vector<MotionTerm> &terms = spec().motion.terms();
  const std::vector<MotionTerm> was = terms;
  const SurfaceMotion surface_was = surface_now_;
  const bool knows_last = has_values_;    // else speeds count as even in this step
  take_inputs(inputs);
  for (std::size_t i = 0; i < terms.size() && passed > 0; i++) {
    MotionTerm &m = terms[i];
    for (int d = 0; d < 3; d++) {
      const Real shift = m.displacement[d] - was[i].displacement[d], before = was[i].speed[d];
      m.speeding_up[d] = 0;
      if (m.takes_difference(d)) {
        m.speed[d] = shift / passed;
      } else if (m.input[3 + d] != kNoInput) {
        Real mean = (before + m.speed[d]) / 2;
        if (m.adds_up(d))
          m.displacement[d] += passed * mean;
        else    // places may jump, as those of an angle by a whole turn: that is no speed
          mean = std::clamp(shift / passed, std::min(before, m.speed[d]),
                            std::max(before, m.speed[d]));
        if (knows_last) m.speeding_up[d] = 2 / passed * (m.speed[d] - mean);
      }
    }
  }
  // A surface goes on in a step by the mean of what inputs say before and after it.
  if (spec().surface_varies() && knows_last && passed > 0 && to.velocities_behind() > 0) {
    surface_.velocity = 0.5 * (surface_was.velocity + surface_now_.velocity);
    surface_.angular = 0.5 * (surface_was.angular + surface_now_.angular);
  }
  return passed;
}

void MeshMotion::place()
{
  pose_ = spec().motion.pose_at(clock_.now(), last_step_);
}

Pose MeshMotion::pose_in(Time later) const
{
  return spec().motion.pose_at(clock_.now() + later);
}

Pose MeshMotion::pose_without_servo() const
{
  return spec().motion.terms_at(clock_.now());
}

void MeshMotion::set(const RigidMotion &to, const Step &now)
{
  std::vector<MotionTerm> terms = to.terms();
  read_tables(terms);
  RigidMotion &motion = spec().motion;
  // Terms act before a servo: one that holds would turn them.
  const bool takes_servo = servo().holds && to.moves();
  const Pose placed = takes_servo ? pose_ : pose_without_servo();
  if (takes_servo) servo().position = 0;
  motion.stop();
  motion.begin_from(placed);
  for (const MotionTerm &term : terms) motion.add(term);
  begin(now);
}

void MeshMotion::set(const Servo &to)
{
  Servo &s = servo();
  if (!to.present) {
    s.holds = true;
    s.velocity = 0;
  } else if (s.has_line_of(to)) {
    check_limits(to, s.position);
    const Real position = s.position;
    s = to;
    s.position = position;
  } else {
    if (spec().motion.moves())
      throw InputError(named(std::string(s.present ? "a servo along another line" : "a servo") +
                             " cannot begin while the motion '" + own_text() +
                             "' moves the mesh: stop that motion first"));
    spec().motion.begin_from(pose_);
    s = to;
  }
  place();
}

// One outside of its limits would jump back inside in one step.
void MeshMotion::check_limits(const Servo &s, Real position) const
{
  if (position < s.lo || position > s.hi)
    throw InputError(named("the servo is at " + number_text(position) + ", outside the limits " +
                           number_text(s.lo) + " " + number_text(s.hi) +
                           ", which count from where it began: widen them"));
}

void MeshMotion::check_snapshot(const Step &at) const
{
  const std::string in_replay = std::string("in a ") + host_.names().replay + " ";
  if (servo().present && !servo().holds)
    throw InputError(
        named(in_replay +
              "the position of a servo is not known, because it follows from the loads of all "
              "steps before: leave servo out, and give its positions by motion variable"));
  if (takes_differences())
    throw InputError(named(in_replay +
                           "there is no step before, from which motion variable could take the "
                           "velocity as a difference: " +
                           host_.names().give_velocities));
  if (adds_up())
    throw InputError(named(in_replay +
                           "the displacement or angle is not known, because it is the sum of "
                           "velocities of variables over all steps before: " +
                           host_.names().give_displacements));
  StepClock there = clock_;
  there.advance(at);
  if (spec().motion.moves() && there.now() < 0)
    throw InputError(
        named(in_replay + "the snapshot of step " + std::to_string(at.number) + " is before step " +
              std::to_string(clock_.base_step) +
              ", in which the motion of the mesh begins: " + host_.names().begin_replay));
}

std::string MeshMotion::text(const Box &bounds) const
{
  const RigidMotion &motion = spec().motion;
  if (motion.is_posed()) return "by poses of the caller";
  if (!motion.moves()) return motion.start().placed ? "none; the mesh stays where it is" : "";
  constexpr int kSamples = 64;
  std::string text = own_text();
  if (takes_differences()) text += "; if no speed is given, velocities are differences over a step";
  if (adds_up())
    text += "; if only a speed is given, velocities are added up, with the mean of those before "
            "and after a step";
  std::vector<Real> times;
  for (int i = 0; i < kSamples; i++) times.push_back(motion.longest_period() * i / kSamples);
  for (const MotionTerm &m : motion.terms()) {
    if (!m.table) continue;
    text += "; " + std::to_string(m.table->rows().count()) + " rows from " +
            number_text(m.table->begin()) + " to " + number_text(m.table->end());
    for (const Real t : m.table->typical_times()) times.push_back(t);
  }
  if (has_inputs()) return text;
  Real most = 0;
  for (const Real t : times) most = std::max(most, fastest_in(motion.pose_at(t), bounds));
  return text + "; corners of its bounds move at up to " + number_text(most);
}

// The text of the terms that move it or, where none does, of those that were stopped.
std::string MeshMotion::own_text() const
{
  const RigidMotion &motion = spec().motion;
  return motion_text(motion.moves() ? motion.terms() : motion.stopped(), wall_.inputs);
}

MotionState MeshMotion::state() const
{
  const RigidMotion &motion = spec().motion;
  MotionState state;
  state.clock = clock_;
  state.start = motion.start();
  state.placed = pose_without_servo();
  state.last = pose_;
  state.servo = servo();
  state.terms = motion.moves() ? motion.terms() : motion.stopped();
  state.stopped = !motion.moves() && !state.terms.empty();
  if (motion.is_posed() && !spec().body.present) {
    const Pose given = pose_without_servo();
    state.velocity = given.velocity;
    state.angular = given.angular;
  }
  for (MotionTerm &m : state.terms)
    for (int &input : m.input)
      if (input != kNoInput)
        input = number_of_input(state.inputs, wall_.inputs[static_cast<std::size_t>(input)]);
  return state;
}

void MeshMotion::check(const MotionState &was) const
{
  if (servo().has_line_of(was.servo)) check_limits(servo(), was.servo.position);
}

// A servo goes on along the same line, whatever its target is now. A motion that was stopped stays so.
void MeshMotion::restore(const MotionState &was, const Step &now)
{
  check(was);
  RigidMotion &motion = spec().motion;
  if (motion.is_posed()) {    // it rests there until the caller poses it
    if (!spec().body.present && (was.moves() || was.servo.present))
      host_.warn(
          named("the " + std::string(host_.names().saved) +
                " was written with a motion or a servo of this mesh, and now poses move it: it "
                "rests where it was until it gets one"));
    // The last one that it got, in which it may not have been yet.
    Pose there = (was.was_posed() ? was.placed : was.last).still();
    there.placed = true;
    there.velocity = was.velocity;
    there.angular = was.angular;
    motion.set_pose(there);
    begin(now);
    pose_ = was.last;
    clock_ = was.clock;
    return;
  }
  const bool same_line = was.servo.position == 0 || servo().has_line_of(was.servo),
             same = same_line && (motion.moves() || !was.moves()) &&
                    are_same(motion.moves() ? motion.terms() : motion.stopped(), wall_.inputs,
                             was.terms, was.inputs);
  const std::string own = own_text(), its = motion_text(was.terms, was.inputs);
  motion.begin_from(same && was.moves() ? was.start : same_line ? was.placed : was.last);
  const std::string saved = host_.names().saved;
  const std::string so = " was stopped when the " + saved + " was written, and stays so: ";
  if (same && was.stopped) {
    motion.stop();
    host_.warn(named("the motion '" + its + "'" + so + host_.names().begin_motion));
  }
  if (servo().has_line_of(was.servo)) {
    servo().position = was.servo.position;
    servo().velocity = was.servo.velocity;
    servo().holds = was.servo.holds;
    if (servo().holds) host_.warn(named("the servo" + so + host_.names().begin_servo));
  }
  begin(now);
  if (same) {
    clock_ = was.clock;
    for (std::size_t i = 0; i < motion.terms().size(); i++) {
      motion.terms()[i].displacement = was.terms[i].displacement;
      motion.terms()[i].speed = was.terms[i].speed;
    }
    place();
  } else if (motion.moves() ? !was.terms.empty() : was.moves()) {
    host_.warn(named("the " + saved + " was written with the motion '" + its + "' and " +
                     host_.names().wall + " has " +
                     (motion.moves() ? "'" + own + "', which begins" : "none: the mesh stays") +
                     " where the mesh was; the phase is lost"));
  }
  if (!same_line)
    host_.warn(named("the " + saved + " was written with a servo along another line, or " +
                     host_.names().wall +
                     " has none: the mesh stays where that servo moved it, at position " +
                     number_text(was.servo.position) +
                     ", and no other servo takes over its position and speed"));
}

}    // namespace lsdcd
