// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the contacts of a grain that is no sphere do with energy in a step, on a CPU; contact_energy.h has the same for spheres. The force
// acts at the grain's point, which is deeper than the foot by the overlap, and the torque of a contact also has a couple.
// KeptForces::rolling has the whole torque, because there is no rolling resistance; `arm` is the overlap, and `distance` the radius that
// the law reads.
#pragma once

#include "contact/grain_contacts.h"
#include "engine/step/mesh_step.h"
#include "engine/step/shape_law.h"

#include <cmath>

namespace lsdcd {

// Returns the metric of a grain in the frame of a mesh.
inline GrainMetric metric_of(const GrainShape &grain, const Pose &pose)
{
  GrainMetric metric;
  Vec3 row[3];
  rows_of(grain.turn, row);
  for (int k = 0; k < 3; k++) {
    const Vec3 axis = pose.turn_to_mesh({row[0][k], row[1][k], row[2][k]});
    for (int j = 0; j < 3; j++) metric.row[j][k] = axis[j];
    metric.scale[k] = std::sqrt(1 / grain.inertia_over_mass[k]);
  }
  return metric;
}

// Returns the angular velocity that a grain with the same angular momentum had in its orientation of a step ago. Without a torque it
// changes by -I^-1 (w x I w) per time.
inline Vec3 omega_before(const Vec3 &omega, const GrainMetric &metric, Real dt)
{
  const Vec3 w = metric.to_own(omega), scale = metric.scale;
  const Vec3 l = {w.x / (scale.x * scale.x), w.y / (scale.y * scale.y), w.z / (scale.z * scale.z)};
  const Vec3 c = cross(w, l);
  return omega + dt * metric.turned({scale.x * scale.x * c.x, scale.y * scale.y * c.y,
                                     scale.z * scale.z * c.z});
}

// Adds half of the work that these forces, and the whole torque `by.rolling`, do in a step. `slip`: the velocity of the grain's point less
// that of the wall at the foot.
inline void add_half_of_grain(const RelativeMotion &m, const Vec3 &slip, const Vec3 &n,
                              const KeptForces &by, Real dt, EnergyRows &rows)
{
  const Real half = 0.5 * dt;
  const Vec3 force = (by.elastic + by.damping) * n + by.friction;
  rows[EnergyRow::work] -= half * (dot(force, m.v) + dot(by.rolling, m.omega));
  rows[EnergyRow::drive] += half * (dot(force, m.wall) + dot(by.rolling, m.spin));
  rows[EnergyRow::damping] -= half * by.damping * dot(slip, n);
  rows[EnergyRow::lever_arms] -= half * by.arm * dot(by.friction, cross(m.spin, n));
}

// Returns the velocity of the grain's point less that of the wall at the foot. `arm`: the vector from the centre to that point.
inline Vec3 slip_at(const RelativeMotion &m, const Vec3 &arm, const Vec3 &from_foot)
{
  return m.v + cross(m.spin, from_foot) + cross(m.omega + m.spin, arm);
}

// Returns what a contact loses as the radius that its law reads changes to `c.radius`, because the contact moves over the grain's surface.
template <class Law>
Real loss_by_radius(const Law &law, const Contact &c, Real weight, const KeptForces &old)
{
  Contact was = c;
  was.radius = old.distance;
  const auto less = [&](Real overlap) {
    return law.normal_energy(was, overlap) - law.normal_energy(c, overlap);
  };
  return 0.5 * weight * (less(c.overlap) + less(old.arm));
}

// Adds contact `at` of a grain that is no sphere to the energy balance, as EnergyBook::add() adds one of a sphere.
template <class Law, class Springs>
void add_grain(EnergyBook<Law> &book, const Law &law, const MeshFeaturesView &wall,
               const ForceSettings &settings, const SphereStateWith<Springs> &s,
               const BookedContact<Law> &b, const GrainContact &at, const Transfer &in,
               EnergyMarks &marks, Real *to)
{
  const Contact &c = b.c;
  const Vec3 &n = c.normal;
  KeptForces old = {};
  if (in.from >= 0) old = EnergyBook<Law>::handed_on(law, settings, s, in, n);
  KeptForces now =
      kept_of(law, n, b.f, b.parts, slaves_spring(c, b.parts, old), b.weight, b.distance, b.arm);
  now.held = held_of(law, c, b.f, b.memory, b.weight, now);
  now.rolling = cross(at.arm, (now.elastic + now.damping) * n + now.friction) + at.couple;
  memcpy(to + n_extra(law), &now, sizeof now);
  book.rows[EnergyRow::held] += now.held;
  const bool goes_on = in.from >= 0 && in.part == 1;
  if (in.from >= 0) EnergyMarks::mark(marks.taken, in.from);
  if (goes_on) EnergyMarks::mark(marks.goes_on, in.from);
  if (!settings.update) return;

  if (!goes_on) book.begin(law, s, b);
  const Vec3 from_foot = s.x - at.foot;
  const RelativeMotion m = relative_motion(settings, s, n, from_foot, false);
  add_half_of_grain(m, slip_at(m, at.arm, from_foot), n, now, c.dt, book.rows);
  if (settings.receded) book.recede(wall, b.feature, at.foot, settings.receded, n, now);
  if (goes_on && law.reads_radius)
    book.rows[EnergyRow::stiffness] += loss_by_radius(law, c, b.weight, old);
  book_springs(law, c, b.parts, b.weight, now, old, book.rows);
}

// Closes the energy balance of grain i, as EnergyBook::close() does for a sphere. The grain may be a sphere.
template <class Law, class Springs>
void close_grain(const Law &law, const StepJob &job, const LawAtMesh<Law> &mesh, std::size_t i,
                 const SphereStateWith<Springs> &s, const MarksOf<Law> &marks,
                 EnergyBook<Law> &book)
{
  const ForceSettings &settings = mesh.settings;
  const MeshFeaturesView &wall = mesh.grid.wall;
  if (law.work->is_sphere(i)) {
    book.close(law, wall, settings, s, marks, job.records);
    return;
  }
  EnergyRows &rows = book.rows;
  const Real dt = settings.dt;
  auto was = s;
  was.omega = omega_before(s.omega, metric_of(law.work->rows[i], settings.pose), dt);
  for (int k = 0; k < s.n_springs; k++) {
    if (!is_own(s.springs, k)) continue;
    const KeptForces old = EnergyBook<Law>::kept(law, s, k);
    rows[EnergyRow::seen] += old.held;
    if (!settings.update) continue;
    [[maybe_unused]] std::conditional_t<Law::kLosses, EnergyRows, Real> before = {};
    if constexpr (Law::kLosses) before = rows;
    const FeatureCode feature = s.springs[k].feature;
    const Vec3 n = s.springs[k].normal;
    const Real *const at = s.extra + k * n_stored(law);
    const Vec3 arm = {at[0], at[1], at[2]}, from_foot = -(arm + old.arm * n);
    RelativeMotion m = relative_motion(settings, was, n, from_foot, true);
    if (settings.pose.placed) m = m.before(settings.wall_angular, dt);
    const Vec3 slip = slip_at(m, arm, from_foot), along = slip - dot(slip, n) * n;
    add_half_of_grain(m, slip, n, old, dt, rows);
    if (settings.receded)
      book.recede(wall, feature, s.x - dt * m.v - from_foot, settings.receded, n, old);
    if (EnergyMarks::is_marked(marks.taken, k))
      rows[EnergyRow::turned_springs] += energy_left(law, old, along, {0, 0, 0}, 0, dt);
    else
      book_springs_at_end(law, old, n, along, {0, 0, 0}, 0, dt, rows);
    if constexpr (Law::kLosses)
      book.put_losses(law, settings, s, k, before, s.x - dt * m.v - from_foot, marks, job.records);
  }
}

}    // namespace lsdcd
