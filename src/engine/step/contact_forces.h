// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Computes the force and torque on one sphere by its contacts.
#pragma once

#include "backend/atomic.h"
#include "contact/node_field.h"
#include "engine/results/result_columns.h"
#include "engine/results/step_results.h"
#include "engine/settings.h"
#include "engine/step/compiled_law.h"
#include "engine/step/narrow_phase.h"
#include "engine/step/strike.h"
#include "law/contact.h"
#include "law/submodels/normal.h"
#include "motion/pose.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lsdcd {

// The state of one sphere at the start of the step, in the frame of the mesh.
template <class Springs>
struct SphereStateWith {
  Vec3 x, v, omega;
  Real radius, mass;
  Springs springs;      // of the last step
  const Real *extra;    // n_stored(law) numbers for each spring
  int n_springs;
  Real temperature;    // read only if the law has heat
};
using SphereState = SphereStateWith<const Spring *>;

// Outputs of a sphere that only some laws have. Each is written if the law has it: history, numbers in addition to that, heat, contacts.
struct SphereSink {
  Spring *springs;          // one per contact
  Real *extra;              // n_stored(law) per contact
  Real *heat;               // power into the sphere
  StepContact *contacts;    // one per contact
};

// Sets of contacts of the last step: those that this step's contacts have taken over, and those that continue.
struct EnergyMarks {
  std::uint64_t taken[kMaxContacts / 64] = {}, goes_on[kMaxContacts / 64] = {};

  LSDCD_FN static void mark(std::uint64_t *set, int k)
  {
    set[k / 64] |= std::uint64_t(1) << k % 64;
  }
  LSDCD_FN static bool is_marked(const std::uint64_t *set, int k)
  {
    return set[k / 64] >> k % 64 & 1;
  }
};

// The sets of EnergyMarks, with the contacts of this step, to which the losses of the last step's contacts are added. `extra`:
// n_stored(law) numbers of each contact.
struct LossMarks : EnergyMarks {
  int sphere = 0;
  const Spring *springs = nullptr;
  Real *extra = nullptr;
  int n = 0;
};
template <class Law>
using MarksOf = std::conditional_t<Law::kLosses, LossMarks, EnergyMarks>;

// Computes the energy balance of the contacts of a sphere with one mesh in a step (contact_energy.h).
template <class Law>
struct EnergyBook;

// The lists to which kernels write energy records, in any order.
struct EnergyRecordList {
  EnergyRecord *at;    // null: none are wanted
  int *n;
  Real impact_speed;     // impacts that are faster are recorded; 0: none are
  Real velocity_unit;    // see EngineSettings
  // Contacts that have ended, if laws keep losses.
  EndedContact *ended;
  int *n_ended;
  const OkaWear *oka;    // what impacts wear off; null: nothing

  LSDCD_FN void put(const EnergyRecord &record) const
  {
    if (at && (record.dissipated != 0 || record.impact > 0)) at[fetch_add(n, 1)] = record;
  }
  LSDCD_FN void put(const EndedContact &contact) const { ended[fetch_add(n_ended, 1)] = contact; }
};

template <class Law>
struct BookingSink : SphereSink {
  EnergyBook<Law> *book;
  EnergyMarks *marks;
  EnergyRecordList records;
  bool *
      may_have_impacts;    // set if a contact may begin by an impact and the sphere may have other contacts
  Real friction_heat;
};
template <class Law>
using SinkOf = std::conditional_t<Law::kSetsUp, BookingSink<Law>, SphereSink>;

// A contact as the energy balance reads it: arguments and result of the law, what it keeps before and after, the parts of the force, and
// the weight of the contact.
template <class Law>
struct BookedContact {
  Contact c;
  FullForce f;
  const ContactMemory<Law::kExtra> &before, &memory;
  ForceParts parts;
  Real weight;
  Real distance,
      arm;    // of the centre from the wall, and of friction; of a grain the radius that the law reads, and the overlap
  FeatureCode feature;
  const NodeShares &nodes;    // in the closest point; read only if its nodes move
};

struct ForceSettings {
  SearchSettings search;
  std::uint32_t mesh;    // number in the wall
  Real dt;
  bool update;    // springs go on by dt; not in a setup or a snapshot
  bool
      stores;    // the step keeps what contacts have written: if it is an `update`, or a setup whose energy is recorded
  bool with_point;          // fill weighted_point and weight
  Real wall_temperature;    // read only if the law has heat
  SurfaceMotion surface;    // 0 if the surface does not move by itself
  bool surface_moves;       // by itself; else nothing is computed with its 0, which changes no bit
  Pose pose;                // read only by laws for walls that move
  // Velocities of spheres are those of half a step ago: `back` is dt / 2, and 0 in a setup (time). The velocity of a wall that turns is
  // taken at the same time; otherwise a sphere at rest on a turntable would seem to slip outward, and friction would pull it in.
  Real back;
  Vec3 wall_velocity, wall_angular;    // of the pose at that time, in the frame of the mesh
  WearModel wear;                      // of all steps of a contact; read only if contacts are kept
  bool gives_way;                      // the mesh is a rigid body; read only if contacts are kept
  Mobility mobility;                   // of the body
  NodeField nodes;                     // if its nodes move; read only by laws for these
  const Vec3 *receded;                 // see StepSettings, for each vertex; null: none has receded
};

// Returns the settings of one mesh.
inline ForceSettings force_settings(const EngineSettings &engine, const StepSettings &step,
                                    const Pose &pose, const NodeField &nodes, int mesh,
                                    const Vec3 *receded)
{
  ForceSettings s;
  s.mesh = static_cast<std::uint32_t>(mesh);
  s.dt = step.dt;
  s.update = step.update_history;
  const ContactLaw &law = engine.laws.laws.front();
  s.stores = s.update || ((law.keeps_forces || law.keeps_touch) && !step.looks);
  s.search = {engine.corner, engine.side};
  s.with_point = step.per_sphere;
  s.wall_temperature = step.mesh_temperature ? step.mesh_temperature[mesh] : step.wall_temperature;
  s.surface = step.surface ? step.surface[mesh] : engine.surface;
  s.surface_moves = s.surface.moves();
  s.pose = pose;
  s.back = s.update && !step.synchronous ? step.dt / 2 : 0;
  s.wall_velocity = pose.turn_to_mesh(pose.velocity - s.back * pose.acceleration);
  s.wall_angular = pose.turn_to_mesh(pose.angular - s.back * pose.spin_up);
  s.wear = engine.wears_by_impact() ? WearModel::none : engine.wear;
  s.mobility = step.mobility ? step.mobility[mesh] : Mobility();
  s.gives_way = s.mobility.any();
  s.nodes = nodes;
  s.receded = receded;
  return s;
}

// Returns whether force_settings() of two steps are equal, for the same mesh and engine.
inline bool are_alike(const StepSettings &a, const StepSettings &b)
{
  const auto is_of_wall = [](const StepSettings &s) {
    return !s.mesh_temperature && !s.surface && !s.mobility && !s.receded;
  };
  return is_of_wall(a) && is_of_wall(b) && a.dt == b.dt && a.update_history == b.update_history &&
         a.looks == b.looks && a.synchronous == b.synchronous && a.per_sphere == b.per_sphere &&
         a.wall_temperature == b.wall_temperature;
}

// A mesh as a step reads it.
struct MeshWork {
  GridView grid;
  ForceSettings settings;
};

// Returns the part of the k-th scalar of a contact that another one takes over with this part of its springs. How far a contact has yielded
// goes over whole, or not at all: not in a fold, unless it shrinks to what the overlap beside the fold allows.
template <class Law>
LSDCD_FN Real part_of_scalar([[maybe_unused]] const Law &law, [[maybe_unused]] int k,
                             const Transfer &in)
{
  if constexpr (Law::kYields)
    if (k >= Law::kScalars - Law::kOfNormal)
      return in.part > (law.elastic.heals() ? kMoved : kSameDirection) ? 1 : 0;
  return in.part;
}

// Returns the memory of contact i at the start of the step: that of the last step, turned with the normal, and turned about the normal
// with a surface that turns.
template <class Law, class Set, class Springs>
LSDCD_FN auto memory_from_last_step(const Law &law, const ForceSettings &settings, const Set &set,
                                    int i, const SphereStateWith<Springs> &s, const Transfer &in)
{
  ContactMemory<Law::kExtra> memory = {};
  if constexpr (Law::kHistory) {
    if (in.from < 0) return memory;
    const auto turned = [&](const Vec3 &h) {
      const Vec3 &n = set.normal[i];
      Vec3 now = handed_on(h, in, s.springs, n);
      if constexpr (Law::kPosed)
        if (settings.update && settings.surface_moves)
          now = turn_about(n, settings.dt * dot(settings.surface.angular, n), now);
      return now;
    };
    // springs[] turns a spring of another mesh into the frame of this one; `extra` is as it was kept.
    memory.shear = turned(s.springs[in.from].shear);
    if constexpr (Law::kExtra > 0 && !Set::kHasArms) {
      const Real *old = s.extra + in.from * n_stored(law);
      for (int k = 0; k < Law::kVectors; k++)
        if (law.stores(k)) {
          memory.put(3 * k, turned(in_own_frame(s.springs, in.from, {old[0], old[1], old[2]})));
          old += 3;
        }
      for (int k = 0; k < Law::kScalars; k++)
        if (law.stores(Law::kVectors + k))
          memory.extra[3 * Law::kVectors + k] = part_of_scalar(law, k, in) * *old++;
    }
  }
  return memory;
}

// Returns whether a contact is on the feature, of this mesh of the wall, that had the spring which it takes over.
template <class Springs>
LSDCD_FN bool stays(const Springs &springs, const Transfer &in, FeatureCode feature,
                    std::uint32_t mesh)
{
  return in.from >= 0 && springs[in.from].feature == feature && springs[in.from].mesh == mesh;
}
// Returns whether a contact of a sphere is nearly aligned with that of the spring which it takes over. If that contact has ended, it has
// moved here: over a seam, over several triangles in one step, or to another mesh.
LSDCD_FN bool may_have_moved(const Transfer &in)
{
  return in.from >= 0 && in.part > kMoved;
}

// Returns, where the only contact of a sphere has come here from another feature, the part of the velocity along the normal of the last step,
// which begins no impact. `v`: velocity of the centre relative to the wall.
template <class Springs>
LSDCD_FN TakenAway taken_by_last_contact(const Transfer &in, const Springs &springs, const Vec3 &v,
                                         Real overlap)
{
  TakenAway taken;
  if (!may_have_moved(in)) return taken;
  const Vec3 was = springs[in.from].normal;
  taken.take({was, -dot(v, was), overlap});
  return taken;
}

// Returns whether a contact that begins does so by an impact of this speed, which is above `least`. A sphere that was put into contact
// overlaps by more than it can have moved in this step, and has no impact.
LSDCD_FN bool is_impact(const TakenAway &taken, const Strike &strike, Real speed, Real least,
                        Real dt)
{
  constexpr Real kSteps = 1.5;    // speeds change on the way, and are those of half of the step
  return speed > least && taken.overlap_left(strike) <= kSteps * dt * speed;
}

// Writes the energy and the speed of an impact to the record of a contact that begins.
LSDCD_FN void add_impact(const TakenAway &taken, const Strike &strike, Real mass, Real dt,
                         const EnergyRecordList &records, EnergyRecord &record)
{
  const Real speed = taken.speed_left(strike);
  if (!is_impact(taken, strike, speed, records.impact_speed, dt)) return;
  record.impact = 0.5 * mass * speed * speed / records.velocity_unit;
  record.speed = speed;
}

// Returns what oka wears off in an impact, over E90 and the duration of its step: the wearing power of a contact that begins. `along`: the
// speed of the centre along the wall; `mass`: of the sphere.
LSDCD_FN Real oka_power(const TakenAway &taken, const Strike &strike, Real along, Real mass,
                        Real diameter, Real dt, const OkaWear &oka)
{
  const Real speed = taken.speed_left(strike);
  if (!is_impact(taken, strike, speed, oka.least_speed, dt)) return 0;
  return mass * oka_share(oka, speed, along, diameter) / dt;
}

// Returns the velocity of a sphere's centre less that of the wall at a point of this feature. Sets the shares of the feature's nodes, if
// these move.
template <class Law, class Springs>
LSDCD_FN Vec3 velocity_against(const MeshFeaturesView &wall, const ForceSettings &settings,
                               const SphereStateWith<Springs> &s, FeatureCode feature,
                               const Vec3 &closest, [[maybe_unused]] NodeShares &nodes)
{
  Vec3 v = s.v;
  if constexpr (Law::kPosed)
    if (settings.pose.placed) {
      const Vec3 turning = cross(settings.wall_angular, closest);
      v -= settings.wall_velocity + turning - settings.back * cross(settings.wall_angular, turning);
    }
  if constexpr (Law::kNodes)
    if (settings.nodes.velocity) {
      nodes = node_shares(wall, feature, closest);
      v -= field_at(nodes, settings.nodes.velocity);
    }
  return v;
}
// Returns the mass that a contact moves: at a rigid body it is the reduced mass.
template <class Law>
LSDCD_FN Real mass_at(const ForceSettings &settings, Real mass, const Vec3 &closest, const Vec3 &n)
{
  if constexpr (Law::kKeepsContacts)
    if (settings.gives_way) return 1 / (1 / mass + settings.mobility.along(closest, n));
  return mass;
}

// The contacts of a sphere with one mesh, with the answers to add_contacts() that differ between spheres and other grains
// (GrainContactsInStep, shape_step.h). The arm of friction at a sphere is along the normal, and the normal force causes no torque.
struct SphereContacts : ContactsView {
  using Arm = Real;    // from the centre to where friction acts; length

  template <class Law, class Springs>
  LSDCD_FN Transfer transfer(const GridView &grid, const Law &, int i,
                             const SphereStateWith<Springs> &s) const
  {
    return transfer_of(grid.wall, view(), i, s.springs, s.n_springs);
  }
  // Returns the radius by which overlaps are reported.
  template <class Springs>
  LSDCD_FN Real reported_radius(const SphereStateWith<Springs> &s) const
  {
    return s.radius;
  }
  // Returns the radius that a law reads for contact i.
  template <class Law, class Springs>
  LSDCD_FN Real law_radius(const Law &, int, const SphereStateWith<Springs> &s) const
  {
    return s.radius;
  }
  // Sets the velocities at contact i from those of the centre, away from the wall and along it. Returns the arm of friction.
  template <class Law, class Springs>
  LSDCD_FN Arm add_spin(const Law &law, int, const SphereStateWith<Springs> &s, Real away,
                        const Vec3 &along, Contact &c) const
  {
    Real arm = s.radius;
    if constexpr (Law::kMidpoint)
      if (law.is_at_midpoint()) arm = s.radius - c.overlap / 2;
    c.v_normal = away;
    c.v_tangent = along - arm * cross(s.omega, c.normal);
    return arm;
  }
  LSDCD_FN static void add_torque(Arm arm, const Vec3 &n, const Vec3 &, const Vec3 &tangential,
                                  Vec3 &torque)
  {
    torque -= arm * cross(n, tangential);
  }
  LSDCD_FN Real booked_distance(int i, const Contact &) const { return distance[i]; }
  LSDCD_FN static Real booked_arm(Arm arm, const Contact &) { return arm; }
  template <class Law, class Springs>
  LSDCD_FN void book(EnergyBook<Law> &book, const Law &law, const MeshFeaturesView &wall,
                     const ForceSettings &settings, const SphereStateWith<Springs> &s, int,
                     const BookedContact<Law> &booked, const Transfer &in, EnergyMarks &marks,
                     Real *to) const
  {
    book.add(law, wall, settings, s, booked, in, marks, to);
  }

 private:
  LSDCD_FN const ContactsView &view() const { return *this; }
};
LSDCD_FN SphereContacts contacts_in_step(const ContactsView &set)
{
  return {set};
}

// A contact before its law is evaluated: where it is and how it moves.
template <class Arm>
struct ContactMotion {
  Contact c;           // what the law reads
  Vec3 closest;        // point of the wall
  NodeShares nodes;    // in the closest point; set only if its nodes move
  Vec3 v;              // velocity of the centre less that of the wall
  Real away;           // its part along the normal, > 0 away from the wall
  Vec3 along;    // its part across the normal, less the velocity of a surface that moves by itself
  Arm arm;       // of friction
};

// Sets contact i, whose overlap is given, as the law reads it. A compiler keeps in registers what is set in place, and not what is copied.
template <class Law, class Springs, class Set>
LSDCD_FN void set_motion(const GridView &grid, const Law &law, const ForceSettings &settings,
                         const SphereStateWith<Springs> &s, const Set &set, int i, Real overlap,
                         ContactMotion<typename Set::Arm> &at)
{
  const Vec3 n = set.normal[i];
  at.closest = set.foot_of(i, s.x, n);
  at.nodes = {};
  at.v = velocity_against<Law>(grid.wall, settings, s, set.feature[i], at.closest, at.nodes);
  at.away = dot(at.v, n);
  Contact &c = at.c;
  c.normal = n;
  c.overlap = overlap;
  c.radius = set.law_radius(law, i, s);
  c.mass = mass_at<Law>(settings, s.mass, at.closest, n);
  at.along = at.v - at.away * n;
  if constexpr (Law::kPosed)
    if (settings.surface_moves) at.along -= settings.surface.along(at.closest, n, settings.back);
  at.arm = set.add_spin(law, i, s, at.away, at.along, c);
  c.dt = settings.dt;
  c.update = settings.update;
  if constexpr (Set::kHasArms) {
    c.omega = {0, 0, 0};    // nothing rolls or twists
  } else if constexpr (Law::kContactTorque) {
    // Rolling and twisting are relative to a wall that turns.
    Vec3 omega = s.omega;
    if constexpr (Law::kPosed) omega -= settings.wall_angular + settings.surface.angular;
    if constexpr (Law::kNodes)
      if (settings.nodes.velocity) omega -= field_at(at.nodes, settings.nodes.spin);
    c.omega = omega;
  }
  if constexpr (Law::kHeat)
    if (law.has_heat()) c.temperature_difference = settings.wall_temperature - s.temperature;
}

// A contact after its law was evaluated.
template <class Law, class Set>
struct EvaluatedContact {
  using Memory = ContactMemory<Law::kExtra>;
  using Force = decltype(std::declval<const Law &>().evaluate(std::declval<const Contact &>(),
                                                              std::declval<Memory &>()));
  int i;    // in the set
  FeatureCode feature;
  std::uint32_t mesh;    // number in the wall
  Real weight;
  ContactMotion<typename Set::Arm> motion;
  Transfer in;    // the contact of the last step that it takes over, and the part of its spring
  Memory before, memory;    // at the start and at the end of the step
  Force f;
};

// Evaluates the law for contact i, with what it takes over from the last step.
template <class Law, class Springs, class Set>
LSDCD_FN void evaluate(const GridView &grid, const Law &law, const ForceSettings &settings,
                       const SphereStateWith<Springs> &s, const Set &set, int i, Real overlap,
                       Real weight, EvaluatedContact<Law, Set> &at)
{
  at.i = i;
  at.feature = set.feature[i];
  at.mesh = Law::kPosed ? settings.mesh : 0;    // other laws are for a wall of one mesh
  at.weight = weight;
  set_motion(grid, law, settings, s, set, i, overlap, at.motion);
  at.in = {-1, 0};
  if constexpr (Law::kHistory) at.in = set.transfer(grid, law, i, s);
  at.memory = memory_from_last_step(law, settings, set, i, s, at.in);
  // The first vector that a grain keeps is its arm (ShapeLaw).
  if constexpr (Set::kHasArms && Law::kHistory) at.memory.put(0, at.motion.arm->arm);
  at.before = at.memory;
  at.f = law.evaluate(at.motion.c, at.memory);
  // Without `update` springs stay as they were. Laws without energy and records store nothing then.
  if constexpr (Law::kSetsUp)
    if (!settings.update) at.memory = at.before;
}

// Adds a contact to the energy balance of its mesh, and what its friction heats. `place`: its number among the contacts with this mesh
// that are stored, from 0; the arrays of the sink begin with these.
template <class Law, class Springs, class Set, class Sink>
LSDCD_FN void book_contact(const GridView &grid, const Law &law, const ForceSettings &settings,
                           const SphereStateWith<Springs> &s, const Set &set,
                           const EvaluatedContact<Law, Set> &at, const Sink &sink, int place)
{
  const Contact &c = at.motion.c;
  [[maybe_unused]] const Real slid_before = sink.book->rows[EnergyRow::slider];
  const BookedContact<Law> booked = {c,
                                     at.f,
                                     at.before,
                                     at.memory,
                                     law.parts(c, at.before, at.memory, at.f),
                                     at.weight,
                                     set.booked_distance(at.i, c),
                                     set.booked_arm(at.motion.arm, c),
                                     at.feature,
                                     at.motion.nodes};
  set.book(*sink.book, law, grid.wall, settings, s, at.i, booked, at.in, *sink.marks,
           sink.extra + place * n_stored(law));
  if constexpr (Law::kHeat)
    if (law.has_heat() && settings.update && sink.friction_heat > 0)
      *sink.heat += sink.friction_heat * (sink.book->rows[EnergyRow::slider] - slid_before) / c.dt;
}

// Rows of the energy balance before a contact was booked, in laws that write what each contact loses.
template <class Law>
using RowsBefore = std::conditional_t<Law::kLosses, EnergyRows, Real>;

// Writes the record of a contact that is stored: what it has lost since the rows of its mesh were `before`, and its impact and what that
// wears off, if it begins in this step. `is_only`: it is known that the sphere has no other contact. `place`: as in book_contact().
template <class Law, class Springs, class Set, class Sink>
LSDCD_FN void record_contact([[maybe_unused]] const Law &law, const ForceSettings &settings,
                             const SphereStateWith<Springs> &s,
                             const EvaluatedContact<Law, Set> &at,
                             [[maybe_unused]] const RowsBefore<Law> &before, bool is_only,
                             const Sink &sink, [[maybe_unused]] int place)
{
  EnergyRecord record = {at.feature, at.mesh, 0, 0, 0};
  if constexpr (Law::kLosses) {
    record.dissipated = dissipated(sink.book->rows) - dissipated(before);
    if (law.keeps_losses)
      sink.book->keep_losses(law, settings, s, at.in, before, sink.extra, place);
  }
  // Impacts are of spheres alone: an error refuses them with other grains.
  if constexpr (!Set::kHasArms)
    if (settings.update && (sink.records.impact_speed > 0 || sink.records.oka) &&
        !stays(s.springs, at.in, at.feature, at.mesh)) {
      const Contact &c = at.motion.c;
      // If there may be others, impacts follow when all contacts are known (impacts.h).
      if (is_only) {
        const TakenAway taken = taken_by_last_contact(at.in, s.springs, at.motion.v, c.overlap);
        const Strike strike = {c.normal, -at.motion.away, c.overlap};
        if (sink.records.impact_speed > 0)
          add_impact(taken, strike, c.mass, c.dt, sink.records, record);
        if constexpr (Law::kKeepsContacts)
          if (sink.records.oka)
            sink.contacts[place].wear_power =
                oka_power(taken, strike, norm(at.motion.along), s.mass, 2 * s.radius, c.dt,
                          *sink.records.oka);
      } else {
        *sink.may_have_impacts = true;
      }
    }
  sink.records.put(record);
}

// Stores a contact: its springs for the next step, and its force and wear for whoever reads them. `place`: as in book_contact().
template <class Law, class Springs, class Set, class Sink>
LSDCD_FN void store_contact(const Law &law, const ForceSettings &settings,
                            const SphereStateWith<Springs> &s, const EvaluatedContact<Law, Set> &at,
                            const Vec3 &tangential, const Sink &sink, int place)
{
  [[maybe_unused]] const ContactMotion<typename Set::Arm> &motion = at.motion;
  [[maybe_unused]] const Vec3 &n = motion.c.normal;
  if constexpr (Law::kHistory) {
    sink.springs[place] = {at.memory.shear, n, at.feature, at.mesh};
    if constexpr (Law::kExtra > 0) write_extra(law, at.memory, sink.extra + place * n_stored(law));
  }
  if constexpr (Law::kKeepsContacts) {
    const Real normal = at.weight * at.f.normal, pressing = normal > 0 ? normal : Real(0);
    StepContact &kept = sink.contacts[place];
    kept = {at.feature,          at.mesh, normal, norm(tangential), 0, -normal * n - tangential,
            s.x - motion.closest};
    if (settings.wear != WearModel::none)
      kept.wear_power = settings.wear == WearModel::finnie
                            ? finnie_power(pressing, motion.away, norm(motion.along))
                            : pressing * slip_speed(law, motion.c, at.before, at.memory);
  }
}

// Adds a contact to the force, torque and energy of its sphere.
template <class Law, class Set, class Sink>
LSDCD_FN void add_to_result(const Law &law, const ForceSettings &settings,
                            const EvaluatedContact<Law, Set> &at, const Vec3 &tangential,
                            const Sink &sink, SphereResult &out)
{
  const Vec3 &n = at.motion.c.normal;
  const Vec3 force = (at.weight * at.f.normal) * n + tangential;
  out.force += force;
  Set::add_torque(at.motion.arm, n, force, tangential, out.torque);
  out.energy += at.weight * at.f.energy;
  if constexpr (Law::kContactTorque) out.torque += at.weight * at.f.contact_torque;
  if constexpr (Law::kHeat)
    if (law.has_heat()) *sink.heat += at.weight * at.f.heat;
  if (settings.with_point) {
    const Real w = at.weight * fabs(at.f.normal);
    out.weight += w;
    out.weighted_point += w * at.motion.closest;
  }
}

// Evaluates the law for each contact of a sphere with one mesh and adds its force, torque and energy to `out`. `weights` null: it is known
// that the sphere has one contact, which bears all (the fast path). With weights there may be one, too.
template <class Law, class Springs, class Set, class Sink>
LSDCD_FN void add_contacts(const GridView &grid, const Law &law, const ForceSettings &settings,
                           const SphereStateWith<Springs> &s, const Set &set, const Real *weights,
                           const Sink &sink, SphereResult &out)
{
  for (int i = 0; i < set.n; i++) {
    const Real weight = weights ? weights[i] : 1;
    const Real overlap = set.overlap_of(i, s.radius), ratio = overlap / set.reported_radius(s);
    if (ratio > out.overlap_ratio) out.overlap_ratio = ratio;
    // A contact that bears nothing, such as one on the far face of a thin plate, is not stored, though its overlap is told. It gets no
    // spring of its own: it takes over that of the contact that hides it when that one ends, and a spring of its own, cut to the friction
    // limit of its slight overlap, would be in the way.
    if (!(weight > 0)) continue;

    EvaluatedContact<Law, Set> at;
    evaluate(grid, law, settings, s, set, i, overlap, weight, at);
    const int place = out.n_contacts;
    [[maybe_unused]] RowsBefore<Law> rows_before = {};
    if constexpr (Law::kLosses) rows_before = sink.book->rows;
    if constexpr (Law::kEnergy) book_contact(grid, law, settings, s, set, at, sink, place);
    const Vec3 tangential = weight * at.f.tangential;
    store_contact(law, settings, s, at, tangential, sink, place);
    if constexpr (Law::kRecords)
      record_contact(law, settings, s, at, rows_before, !weights, sink, place);
    out.n_contacts++;
    add_to_result(law, settings, at, tangential, sink, out);
  }
}

}    // namespace lsdcd
