// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the contacts of a sphere do with energy in a step. Only laws with kEnergy have these lines.
// A step goes from the last places to the present ones with the present velocities, while forces change from their old values
// to the present ones. Its work is therefore half of each: -dt/2 (F_old + F) v. For F a wall that turns is seen from where the
// sphere is now, and for F_old from where the sphere was, in the frame of that time. A contact keeps the forces of its step
// (KeptForces), and the next step of the sphere adds their second half to the energy balance, whether the contact goes on,
// transfers its spring or has ended. Causes are computed from the parts of a force, and not as the rest that is left over.
#pragma once

#include "engine/step/contact_forces.h"

namespace lsdcd {

// The motion of sphere and wall at a contact, in the frame of the mesh.
struct RelativeMotion {
  Vec3 wall, spin;    // of the wall's material, as if it reached to the sphere's centre
  Vec3 v, omega;      // of the sphere, less those of the wall

  // Returns the motion turned back to the frame of the mesh a step ago.
  LSDCD_FN RelativeMotion before(const Vec3 &angular, Real dt) const
  {
    const auto turned = [&](const Vec3 &a) { return a + dt * cross(angular, a); };
    return {turned(wall), turned(spin), turned(v), turned(omega)};
  }
  // Returns the velocity of the sphere's surface along the wall, as the law sees it.
  LSDCD_FN Vec3 slip(const Vec3 &n, Real distance, Real arm) const
  {
    return v - dot(v, n) * n + cross(spin, distance * n) - arm * cross(omega + spin, n);
  }
};

// Returns the motion of sphere and wall. `from_foot`: the vector from the contact point on the wall to the sphere's centre. `before`: the
// motion is taken a step ago, with the wall's velocity at the place, in the frame of the mesh, where the sphere was then.
template <class Springs>
LSDCD_FN RelativeMotion relative_motion(const ForceSettings &settings,
                                        const SphereStateWith<Springs> &s, const Vec3 &n,
                                        const Vec3 &from_foot, bool before)
{
  RelativeMotion m = {};
  if (settings.pose.placed) {
    const Vec3 turning = cross(settings.wall_angular, s.x);
    m.wall =
        settings.wall_velocity + turning - settings.back * cross(settings.wall_angular, turning);
    if (before) m.wall -= settings.dt * cross(settings.wall_angular, s.v - m.wall);
    m.spin = settings.wall_angular;
  }
  if (settings.surface_moves) {
    const SurfaceMotion &surface = settings.surface;
    m.wall += surface.along(s.x - from_foot, n, settings.back) + cross(surface.angular, from_foot);
    m.spin += surface.angular;
  }
  m.v = s.v - m.wall;
  m.omega = s.omega - m.spin;
  return m;
}

// The energy that a spring with dashpot and slider loses in a step.
struct SpringLoss {
  Real slider, dashpot, stiffness;
};

// Returns what a spring loses. `path`: how far the contact has slipped (or turned) in the step; `now`, `old`: the whole force (or torque)
// of the sub-model; `old_spring`, `old_k`: force and stiffness of its spring. If the limit cuts off a part of the path, the whole force
// is lost along that part, and what the dashpot does along the rest also counts for the slider.
LSDCD_FN SpringLoss spring_loss(const SpringPart &spring, bool slides, const Vec3 &path,
                                const Vec3 &now, const Vec3 &old, const Vec3 &old_spring,
                                Real old_k)
{
  Vec3 cut = {0, 0, 0};
  if (spring.k > 0)
    cut = spring.cut_off(path);
  else if (slides)
    cut = path;
  const bool is_cut = spring.is_cut(cut, path);
  const Real dashpot = -0.5 * dot(now - spring.force() + old - old_spring, path - cut);
  SpringLoss loss;
  loss.slider = -0.5 * dot(now + old, cut) + (is_cut ? dashpot : 0);
  loss.dashpot = is_cut ? 0 : dashpot;
  loss.stiffness = spring_energy(norm_sq(old_spring), old_k) -
                   0.5 * spring.k * dot(spring.ends, spring.begins) -
                   0.5 * dot(old_spring, spring.ends - spring.begins);
  return loss;
}
// Returns what a spring loses as its contact ends, so that its limit becomes 0.
LSDCD_FN SpringLoss spring_loss_at_end(const Vec3 &path, const Vec3 &old, const Vec3 &old_spring,
                                       Real old_k)
{
  const SpringPart spring = {
      old_k > 0 ? (-1 / old_k) * old_spring : Vec3{0, 0, 0}, {0, 0, 0}, old_k};
  return spring_loss(spring, true, path, {0, 0, 0}, old, old_spring, old_k);
}

// Returns what friction loses in a step between the forces `old` and `now`. `spring`, `limit`: of friction, times the weight of the
// contact; `path`: how far it has slipped.
LSDCD_FN SpringLoss sliding_loss(SpringPart spring, bool slides, Real limit, const Vec3 &path,
                                 const KeptForces &now, const KeptForces &old)
{
  if (now.is_slaved()) {    // all of the work is the slider's, and what the spring held when it was last a store
    SpringLoss loss = spring_loss({}, true, path, now.friction, old.friction, old.friction_spring,
                                  old.k_friction);
    return {loss.slider + loss.stiffness, loss.dashpot, 0};
  }
  if (!old.is_slaved())
    return spring_loss(spring, slides, path, now.friction, old.friction, old.friction_spring,
                       old.k_friction);
  // The spring is a store again. It begins with what the limit allows, which it gets by its stiffness.
  const Real pull = spring.k * norm(spring.begins);
  if (pull > limit) spring.begins = (limit / pull) * spring.begins;
  const Vec3 begins = -spring.k * spring.begins;
  SpringLoss loss = spring_loss(spring, slides, path, now.friction, begins, begins, spring.k);
  loss.slider -= 0.5 * dot(old.friction - begins, path);
  loss.stiffness -= spring_energy(norm_sq(begins), spring.k);
  return loss;
}

// Returns whether the spring of friction only makes up for a dashpot that is beyond the limit (KeptForces::kSlaved): from a step in which
// the limit cuts it, for as long as the dashpot is beyond. `old`: what the contact has taken over. In a setup nothing changes.
template <class C>
LSDCD_FN bool slaves_spring(const C &c, const ForceParts &parts, const KeptForces &old)
{
  if (!c.update) return old.is_slaved();
  if (!parts.dashpot_slides) return false;
  const Vec3 path = c.dt * c.v_tangent;
  return old.is_slaved() || parts.friction.is_cut(parts.friction.cut_off(path), path);
}

// Returns what a contact keeps whose force `f` has these parts, without `held`. `weight`: that of the contact; `slaved`: slaves_spring().
template <class Law>
LSDCD_FN KeptForces kept_of(const Law &, const Vec3 &n, const FullForce &f, const ForceParts &parts,
                            bool slaved, Real weight, Real distance, Real arm)
{
  KeptForces now = {};
  now.weight = weight;
  now.elastic = weight * parts.elastic;
  now.damping = weight * (f.normal - parts.elastic);
  now.distance = distance;
  now.arm = arm;
  now.friction = weight * f.tangential;
  now.friction_spring = slaved ? Vec3{0, 0, 0} : weight * parts.friction.force();
  now.k_friction = slaved ? KeptForces::kSlaved : weight * parts.friction.k;
  if constexpr (Law::kContactTorque) {
    const Real twisting = dot(f.contact_torque, n);
    now.rolling = weight * (f.contact_torque - twisting * n);
    now.rolling_spring = weight * parts.rolling.force();
    now.twisting = weight * twisting;
    now.twisting_spring = weight * dot(parts.twisting.force(), n);
    now.k_rolling = weight * parts.rolling.k;
    now.k_twisting = weight * parts.twisting.k;
  }
  return now;
}

// Returns the energy that the normal force of a contact would hold at this overlap, with what the contact keeps.
template <class Law, class C>
LSDCD_FN Real normal_energy_with(const Law &law, const C &c, Real overlap,
                                 [[maybe_unused]] const ContactMemory<Law::kExtra> &memory)
{
  if constexpr (Law::kYields)
    return law.normal_energy(c, overlap, memory);
  else
    return law.normal_energy(c, overlap);
}

// Returns the elastic energy that a contact holds. In a setup the limits of friction cut forces, but springs stay as they are. A spring
// that is no store holds none.
template <class Law, class C>
LSDCD_FN Real held_of(const Law &law, const C &c, const FullForce &f,
                      const ContactMemory<Law::kExtra> &memory, Real weight, const KeptForces &now)
{
  return c.update && !now.is_slaved()
             ? weight * f.energy
             : weight * normal_energy_with(law, c, c.overlap, memory) + springs_energy<Law>(now);
}

// Returns the overlap at which a contact begins: that of touch, unless the law pulls at what has not touched.
template <class Law, class C>
LSDCD_FN Real starts_at([[maybe_unused]] const Law &law, [[maybe_unused]] const C &c)
{
  if constexpr (Law::kReaches)
    if (!law.needs_touch()) return -law.gap(c);
  return 0;
}

// Add what sliding loses; the second function also adds what rolling and twisting lose.
LSDCD_FN void add_losses(const SpringLoss &sliding, EnergyRows &rows)
{
  rows[EnergyRow::slider] += sliding.slider;
  rows[EnergyRow::damping] += sliding.dashpot;
  rows[EnergyRow::stiffness] += sliding.stiffness;
}
LSDCD_FN void add_losses(SpringLoss sliding, const SpringLoss &rolling, const SpringLoss &twisting,
                         EnergyRows &rows)
{
  rows[EnergyRow::rolling] += rolling.slider + rolling.dashpot;
  rows[EnergyRow::twisting] += twisting.slider + twisting.dashpot;
  sliding.stiffness = sliding.stiffness + rolling.stiffness + twisting.stiffness;
  add_losses(sliding, rows);
}

// Returns the stored energy of springs with these forces, less the second half of their work in a step with these velocities.
template <class Law>
LSDCD_FN Real energy_left(const Law &, const KeptForces &old, const Vec3 &slip, const Vec3 &rolling,
                          Real twisting, Real dt)
{
  Real power = dot(old.friction, slip);
  if constexpr (Law::kContactTorque)
    power = power + dot(old.rolling, rolling) + old.twisting * twisting;
  return springs_energy<Law>(old) - 0.5 * dt * power;
}

// Adds the springs of a contact that has ended to the energy balance.
template <class Law>
LSDCD_FN void book_springs_at_end(const Law &, const KeptForces &old, const Vec3 &n,
                                  const Vec3 &slip, const Vec3 &rolling, Real twisting, Real dt,
                                  EnergyRows &rows)
{
  const SpringLoss sliding =
      spring_loss_at_end(dt * slip, old.friction, old.friction_spring, old.k_friction);
  if constexpr (Law::kContactTorque)
    add_losses(sliding,
               spring_loss_at_end(dt * rolling, old.rolling, old.rolling_spring, old.k_rolling),
               spring_loss_at_end((dt * twisting) * n, old.twisting * n, old.twisting_spring * n,
                                  old.k_twisting),
               rows);
  else
    add_losses(sliding, rows);
}

// Adds the springs of a contact that goes on across a gap, where they end.
template <class Law, class C>
LSDCD_FN void book_springs_across_gap(const Law &law, const C &c, const KeptForces &old,
                                      EnergyRows &rows)
{
  const Vec3 rolling = rolling_part(c.omega, c.normal);
  const Real twisting = dot(c.omega, c.normal);
  book_springs_at_end(law, old, c.normal, c.v_tangent, rolling, twisting, c.dt, rows);
  rows[EnergyRow::turned_springs] -= energy_left(law, old, c.v_tangent, rolling, twisting, c.dt);
}

// Adds the springs of a contact to the energy balance. `weight`: that of the contact; `old`: what it has taken over, in the plane of its
// normal.
template <class Law, class C>
LSDCD_FN void book_springs(const Law &law, const C &c, const ForceParts &parts, Real weight,
                           const KeptForces &now, const KeptForces &old, EnergyRows &rows)
{
  if constexpr (Law::kReaches)
    if (!(c.overlap > 0)) return book_springs_across_gap(law, c, old, rows);
  const auto weighted = [weight](SpringPart spring) {
    spring.k *= weight;
    return spring;
  };
  const SpringLoss sliding = sliding_loss(weighted(parts.friction), parts.slides,
                                          weight * parts.limit, c.dt * c.v_tangent, now, old);
  if constexpr (Law::kContactTorque) {
    const Vec3 &n = c.normal, rolling = rolling_part(c.omega, n);
    const Real twisting = dot(c.omega, n);
    add_losses(sliding,
               spring_loss(weighted(parts.rolling), false, c.dt * parts.rolls, now.rolling,
                           old.rolling, old.rolling_spring, old.k_rolling),
               spring_loss(weighted(parts.twisting), false, (c.dt * twisting) * n, now.twisting * n,
                           old.twisting * n, old.twisting_spring * n, old.k_twisting),
               rows);
    rows[EnergyRow::lever_arms] -=
        0.5 * c.dt * dot(now.rolling + old.rolling, rolling - parts.rolls);
    rows[EnergyRow::turned_springs] -= energy_left(law, old, c.v_tangent, rolling, twisting, c.dt);
  } else {
    add_losses(sliding, rows);
    rows[EnergyRow::turned_springs] -= energy_left(law, old, c.v_tangent, {0, 0, 0}, 0, c.dt);
  }
}

// The energy balance of a sphere at one mesh in a step. add() takes each contact of the step, and then close() takes those of the last
// one.
template <class Law>
struct EnergyBook {
  EnergyRows rows;

  // Stores what the contact keeps in its numbers `to`, after those of the law.
  template <class Springs>
  LSDCD_FN void add(const Law &law, const MeshFeaturesView &wall, const ForceSettings &settings,
                    const SphereStateWith<Springs> &s, const BookedContact<Law> &b,
                    const Transfer &in, EnergyMarks &marks, Real *to)
  {
    const Contact &c = b.c;
    const Vec3 &n = c.normal;
    KeptForces old = {};
    if (in.from >= 0) old = handed_on(law, settings, s, in, n);
    KeptForces now =
        kept_of(law, n, b.f, b.parts, slaves_spring(c, b.parts, old), b.weight, b.distance, b.arm);
    now.held = held_of(law, c, b.f, b.memory, b.weight, now);
    memcpy(to + n_extra(law), &now, sizeof now);
    if constexpr (Law::kMayKeepAtNodes)
      if (law.keeps_at_nodes) {
        const Real *const share = b.nodes.share;
        const KeptAtNodes at = {n, {share[0], share[1], share[2]}};
        memcpy(to + n_extra(law) + kKeptForces, &at, sizeof at);
      }
    rows[EnergyRow::held] += now.held;
    const bool goes_on = in.from >= 0 && in.part == 1;
    if (in.from >= 0) EnergyMarks::mark(marks.taken, in.from);
    if (goes_on) EnergyMarks::mark(marks.goes_on, in.from);
    if (!settings.update) return;

    if (!goes_on) begin(law, s, b);
    RelativeMotion m = relative_motion(settings, s, n, b.distance * n, false);
    if constexpr (Law::kNodes)
      if (settings.nodes.velocity) add_nodes(settings.nodes, b.nodes, n, now, c.dt, m);
    add_half(m, n, now, c.dt);
    if (settings.receded) recede(wall, b.feature, s.x - b.distance * n, settings.receded, n, now);
    book_springs(law, c, b.parts, b.weight, now, old, rows);
    if constexpr (Law::kYields)
      rows[EnergyRow::plastic] += b.weight * law.plastic_loss(c, b.before, b.memory);
  }

  // Adds the second half of the last step's contacts with this mesh, and the rest of those that have ended.
  template <class Springs>
  LSDCD_FN void close(const Law &law, const MeshFeaturesView &wall, const ForceSettings &settings,
                      const SphereStateWith<Springs> &s, const MarksOf<Law> &marks,
                      [[maybe_unused]] const EnergyRecordList &records)
  {
    const Real dt = settings.dt;
    for (int k = 0; k < s.n_springs; k++) {
      if (!is_own(s.springs, k)) continue;
      const KeptForces old = kept(law, s, k);
      rows[EnergyRow::seen] += old.held;
      if (!settings.update) continue;
      [[maybe_unused]] std::conditional_t<Law::kLosses, EnergyRows, Real> before = {};
      if constexpr (Law::kLosses) before = rows;
      const FeatureCode feature = s.springs[k].feature;
      Vec3 n = s.springs[k].normal;
      RelativeMotion m = relative_motion(settings, s, n, old.distance * n, true);
      if (settings.pose.placed) m = m.before(settings.wall_angular, dt);
      Vec3 turn = m.omega;    // less the spin of nodes, as the law sees it
      if constexpr (Law::kNodes)
        if (settings.nodes.velocity) {
          const KeptAtNodes at = kept_at_nodes(law, s, k);
          n = at.normal;
          turn -= add_nodes(settings.nodes, shares_again(wall, feature, at.share), n, old, dt, m);
        }
      add_half(m, n, old, dt);
      if (settings.receded)
        recede(wall, feature, s.x - dt * m.v - old.distance * n, settings.receded, n, old);
      const Vec3 slip = m.slip(n, old.distance, old.arm), rolling = rolling_part(turn, n);
      const Real twisting = dot(turn, n);
      if (!EnergyMarks::is_marked(marks.goes_on, k)) {
        let_go(law, s, old);
        if constexpr (Law::kYields) part(law, s, k, old, dt * dot(m.v, n));
      }
      if (EnergyMarks::is_marked(marks.taken, k))
        rows[EnergyRow::turned_springs] += energy_left(law, old, slip, rolling, twisting, dt);
      else
        book_springs_at_end(law, old, n, slip, rolling, twisting, dt, rows);
      if constexpr (Law::kLosses)
        put_losses(law, settings, s, k, before, s.x - dt * m.v - old.distance * n, marks, records);
    }
  }

  // Stores what contact number `at` with this mesh has dissipated since the rows were `before`. Adds the sum of the contact of the last
  // step that continues in it, which is the one that it is the first to take over completely. `extra`: the numbers of all contacts with
  // this mesh.
  template <class Springs>
  LSDCD_FN void keep_losses(const Law &law, const ForceSettings &settings,
                            const SphereStateWith<Springs> &s, const Transfer &in,
                            const EnergyRows &before, Real *extra, int at) const
  {
    bool goes_on = in.from >= 0 && in.part == 1 && is_own(s.springs, in.from);
    for (int c = 0; c < at && goes_on; c++) goes_on = losses_of(law, extra, c).from != in.from;
    KeptLosses now = {};
    if (goes_on) now = losses_of(law, s.extra, in.from);
    now.from = goes_on ? in.from : -1;
    if (settings.update) {
      for (Real &power : now.power) power = 0;
      add_losses_since(before, settings.dt, now);
    }
    store(law, now, extra, at);
  }

  // The following functions are for add() and close(), and for those of grains that are no spheres (grain_energy.h).

  // Writes what contact k of the last step has lost since the rows were `before`: to the list of records, and to the contact of this step
  // in which it continues, or to the list of ended contacts. `point`: its place on the wall.
  template <class Springs>
  LSDCD_FN void put_losses(const Law &law, const ForceSettings &settings,
                           const SphereStateWith<Springs> &s, int k, const EnergyRows &before,
                           const Vec3 &point, const LossMarks &marks,
                           const EnergyRecordList &records) const
  {
    const EnergyRecord lost = {s.springs[k].feature, settings.mesh,
                               dissipated(rows) - dissipated(before), 0, 0};
    records.put(lost);
    if (!law.keeps_losses) return;
    for (int c = 0; c < marks.n; c++) {
      KeptLosses now = losses_of(law, marks.extra, c);
      if (now.from != k || marks.springs[c].mesh != settings.mesh) continue;
      add_losses_since(before, settings.dt, now);
      store(law, now, marks.extra, c);
      return;
    }
    EndedContact ended = {marks.sphere, k, settings.mesh, 0, point, losses_of(law, s.extra, k)};
    for (Real &power : ended.losses.power) power = 0;
    add_losses_since(before, settings.dt, ended.losses);
    records.put(ended);
  }

  LSDCD_FN static KeptLosses losses_of(const Law &law, const Real *extra, int k)
  {
    KeptLosses kept;
    memcpy(&kept, extra + (k + 1) * n_stored(law) - kKeptLosses, sizeof kept);
    return kept;
  }
  LSDCD_FN static void store(const Law &law, const KeptLosses &kept, Real *extra, int k)
  {
    memcpy(extra + (k + 1) * n_stored(law) - kKeptLosses, &kept, sizeof kept);
  }
  LSDCD_FN void add_losses_since(const EnergyRows &before, Real dt, KeptLosses &to) const
  {
    for (int cause = 0; cause < kLossCauses; cause++) {
      const int row = static_cast<int>(EnergyRow::damping) + cause;
      const Real lost = rows.of[row] - before.of[row];
      if (dt > 0) to.power[cause] += lost / dt;
      to.energy[cause] += lost;
    }
  }

  template <class Springs>
  LSDCD_FN static KeptForces kept(const Law &law, const SphereStateWith<Springs> &s, int k)
  {
    KeptForces kept;
    memcpy(&kept, s.extra + k * n_stored(law) + n_extra(law), sizeof kept);
    return kept;
  }

  template <class Springs>
  LSDCD_FN static KeptAtNodes kept_at_nodes(const Law &law, const SphereStateWith<Springs> &s,
                                            int k)
  {
    KeptAtNodes at;
    memcpy(&at, s.extra + k * n_stored(law) + n_extra(law) + kKeptForces, sizeof at);
    return at;
  }

  // Returns what the old contact in.from transfers to the contact with this normal, in the same way as memory_from_last_step() transfers
  // springs.
  template <class Springs>
  LSDCD_FN static KeptForces handed_on(const Law &law, const ForceSettings &settings,
                                       const SphereStateWith<Springs> &s, const Transfer &in,
                                       const Vec3 &n)
  {
    KeptForces old = kept(law, s, in.from);
    Vec3 *const vectors[] = {&old.friction, &old.friction_spring, &old.rolling,
                             &old.rolling_spring};
    [[maybe_unused]] Vec3 was = {0, 0, 0};    // normal of the kept vectors, for a mesh with nodes
    if constexpr (Law::kNodes)
      if (settings.nodes.velocity && is_own(s.springs, in.from))
        was = kept_at_nodes(law, s, in.from).normal;
    for (int k = 0; k < (Law::kContactTorque ? 4 : 2); k++) {
      Vec3 *const h = vectors[k];
      if constexpr (Law::kNodes)
        if (!(was == Vec3{0, 0, 0}))
          *h = transport_unless_turned_round(*h, was, s.springs[in.from].normal);
      *h = lsdcd::handed_on(in_own_frame(s.springs, in.from, *h), in, s.springs, n);
      if (settings.surface_moves)
        *h = turn_about(n, settings.dt * dot(settings.surface.angular, n), *h);
    }
    old.twisting *= in.part;
    old.twisting_spring *= in.part;
    return old;
  }

  LSDCD_FN static Vec3 contact_torque([[maybe_unused]] const Vec3 &n,
                                      [[maybe_unused]] const KeptForces &by)
  {
    if constexpr (Law::kContactTorque)
      return by.rolling + by.twisting * n;
    else
      return {0, 0, 0};
  }
  // Adds half of the work that these forces do in a step.
  LSDCD_FN void add_half(const RelativeMotion &m, const Vec3 &n, const KeptForces &by, Real dt)
  {
    const Real half = 0.5 * dt;
    const Vec3 force = (by.elastic + by.damping) * n + by.friction;
    const Vec3 torque = contact_torque(n, by) - by.arm * cross(n, by.friction);
    rows[EnergyRow::work] -= half * (dot(force, m.v) + dot(torque, m.omega));
    rows[EnergyRow::drive] += half * (dot(force, m.wall) + dot(torque, m.spin));
    rows[EnergyRow::damping] -= half * by.damping * dot(m.v, n);
    rows[EnergyRow::lever_arms] -=
        half * (by.arm - by.distance) * dot(by.friction, cross(m.spin, n));
  }

  // Adds the motion of nodes to `m`, and returns their spin, relative to which the law sees a sphere roll. Nodes get only forces, so that
  // half of what the torques of rolling and twisting do by that spin is lost.
  LSDCD_FN Vec3 add_nodes(const NodeField &nodes, const NodeShares &at, const Vec3 &n,
                          const KeptForces &by, Real dt, RelativeMotion &m)
  {
    const Vec3 velocity = field_at(at, nodes.velocity), spin = field_at(at, nodes.spin);
    m.wall += velocity;
    m.v -= velocity;
    rows[EnergyRow::lever_arms] -= 0.5 * dt * dot(contact_torque(n, by), spin);
    return spin;
  }
  // Adds half of what these forces lose as wear moves the wall at a point of a feature.
  LSDCD_FN void recede(const MeshFeaturesView &wall, FeatureCode feature, const Vec3 &point,
                       const Vec3 *receded, const Vec3 &n, const KeptForces &by)
  {
    rows[EnergyRow::wear] -=
        0.5 * by.elastic * dot(n, field_at(node_shares(wall, feature, point), receded));
  }

  // Adds the energy with which a contact begins that takes over no other. Surfaces that adhere jump into contact when they touch.
  template <class Springs>
  LSDCD_FN void begin(const Law &law, const SphereStateWith<Springs> &s,
                      const BookedContact<Law> &b)
  {
    if constexpr (Law::kBeyondContact && !Law::kReaches) {
      rows[EnergyRow::adhesion] -= b.weight * law.normal_energy(b.c, 0);
    } else {
      // A sphere that touched nothing was outside a step ago, unless it was put into the wall.
      constexpr Real kOutside = 1e-9;
      const Real before = b.c.overlap + b.c.dt * b.c.v_normal, starts = starts_at(law, b.c);
      if (s.n_springs == 0 && before > starts + kOutside * b.c.radius)
        rows[EnergyRow::inserted] -= b.weight * law.normal_energy(b.c, before);
      else if constexpr (Law::kReaches)
        rows[EnergyRow::adhesion] -= b.weight * law.normal_energy(b.c, starts);
    }
  }
  // Adds what is lost as surfaces that adhere let go at the pull-off. Cohesion across a gap holds nothing where it ends.
  template <class Springs>
  LSDCD_FN void let_go(const Law &law, const SphereStateWith<Springs> &s, const KeptForces &old)
  {
    if constexpr (Law::kBeyondContact && !Law::kReaches) {
      Contact c = {};
      c.radius = s.radius;
      rows[EnergyRow::adhesion] +=
          old.weight * law.normal_energy(c, s.radius - (s.radius + law.gap(c)));
    }
  }
  // Adds what contact k of the last step, which had yielded, loses on its adhesive branch as the sphere moves away by `away` and parts.
  template <class Springs>
  LSDCD_FN void part(const Law &law, const SphereStateWith<Springs> &s, int k,
                     const KeptForces &old, Real away)
  {
    const Real before = s.radius - old.distance;
    if (before > away) return;    // it has ended beside others
    Contact c = {};
    c.radius = s.radius;
    ContactMemory<Law::kExtra> memory = {};
    read_extra(law, s.extra + k * n_stored(law), memory);
    rows[EnergyRow::plastic] += old.weight * law.plastic_loss_at_end(c, memory, before);
  }
};

}    // namespace lsdcd
