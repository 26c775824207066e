// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/drift.h"

#include "contact/contact_history.h"
#include "contact/find_contacts.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kStiffness = 1000;    // mass pull / radius
constexpr Real kStep = 0.001;
constexpr Real kInertia = 0.4;    // of a sphere, in mass radius^2
constexpr Real kOff = 2;          // radii past the start: off the wall
constexpr Real kThrough = 0.5;    // of a radius from centre to wall; motions here stay above 0.9
constexpr int kLook = 20;         // steps

// Spheres of mass 1, each with its own pull. Lengths are in the mesh's units, times such that
// the pull is 1.
class Motion {
 public:
  Motion(const ViewOf<StepGrid> &grid, const EngineSettings &engine, const DriftStarts &starts,
         Real height) :
      engine_(make_engine(engine)),
      starts_(starts), wall_(starts.wall.view()), n_(starts.n()), springs_(engine.law().n_extra()),
      dt_(kStep * std::sqrt(starts.radius)), x_(3 * n_), v_(3 * n_), omega_(3 * n_), force_(3 * n_),
      torque_(3 * n_), radius_(n_, starts.radius), mass_(n_, 1), mask_(n_, 1),
      has_history_(engine.law().has_history())
  {
    engine_->set_grid(grid);
    springs_.grow(n_);
    for (int i = 0; i < n_; i++) put(x_, i, starts.point[i] + height * starts.normal[i]);
  }

  void set_speeds(int i, const Vec3 &v, const Vec3 &omega)
  {
    put(v_, i, v);
    put(omega_, i, omega);
  }

  // |energy gained or lost| / `of` of each sphere in `time`, or until it was off the wall; 1 for
  // those that went through it.
  std::vector<Real> changes(Real time, Real of)
  {
    std::vector<Real> before(n_), change(n_);
    std::vector<bool> ended(n_, false);
    for (int i = 0; i < n_; i++) before[i] = energy(i);
    const auto end = [&](int i, bool through) {
      ended[i] = true;
      change[i] = through ? 1 : std::fabs(energy(i) - before[i]) / of;
    };
    compute(true);
    int n_steps = 0;
    for (Real t = 0; t < time; t += kStep) {
      kick();
      for (int k = 0; k < 3 * n_; k++) x_[k] += dt_ * v_[k];
      compute(true);
      kick();
      if (++n_steps % kLook > 0) continue;
      for (int i = 0; i < n_; i++)
        if (!ended[i] && (is_through(i) || is_off(i))) end(i, is_through(i));
    }
    for (int i = 0; i < n_; i++)
      if (!ended[i]) end(i, false);
    return change;
  }

 private:
  static Vec3 at(const std::vector<Real> &a, int i)
  {
    return {a[3 * i], a[3 * i + 1], a[3 * i + 2]};
  }
  static void put(std::vector<Real> &a, int i, const Vec3 &value)
  {
    for (int k = 0; k < 3; k++) a[3 * i + k] = value[k];
  }
  Real fallen(int i, const Vec3 &x) const
  {
    return dot(starts_.normal[i], x - starts_.point[i]) - starts_.radius;
  }

  // The pull has taken it past its start. In free flight the wall stores no energy.
  bool is_off(int i) const { return fallen(i, at(x_, i)) < -kOff * starts_.radius; }
  // The centre is nearer to the wall than any contact allows. NaN counts as through, too.
  bool is_through(int i) const
  {
    const Vec3 x = at(x_, i);
    if (!std::isfinite(norm_sq(x))) return true;
    ContactSet<1> set;
    find_contacts(wall_, x, kThrough * starts_.radius, set);
    return set.n > 0;
  }

  // The energy of motion, pull and springs; forces stay as they are.
  Real energy(int i)
  {
    const std::vector<Real> force = force_, torque = torque_;
    std::fill(mask_.begin(), mask_.end(), 1);
    mask_[i] = 2;
    compute(false, 2);
    force_ = force;
    torque_ = torque;
    const Real inertia = kInertia * starts_.radius * starts_.radius;
    return engine_->results().totals().energy + Real(0.5) * norm_sq(at(v_, i)) +
           Real(0.5) * inertia * norm_sq(at(omega_, i)) + fallen(i, at(x_, i));
  }

  void compute(bool update, int group = 3)
  {
    std::fill(force_.begin(), force_.end(), 0);
    std::fill(torque_.begin(), torque_.end(), 0);
    Spheres s;
    s.n = n_;
    s.x = x_.data();
    s.v = v_.data();
    s.omega = omega_.data();
    s.radius = radius_.data();
    s.mass = mass_.data();
    s.mask = mask_.data();
    s.group_bit = group;
    s.force = force_.data();
    s.torque = torque_.data();
    StepSettings step;
    step.dt = dt_;
    step.update_history = update;
    step_once(*engine_, s, step, has_history_ ? &springs_ : nullptr);
  }

  void kick()
  {
    const Real half = Real(0.5) * dt_, inertia = kInertia * starts_.radius * starts_.radius;
    for (int i = 0; i < n_; i++) {
      put(v_, i, at(v_, i) + half * (at(force_, i) - starts_.normal[i]));
      put(omega_, i, at(omega_, i) + (half / inertia) * at(torque_, i));
    }
  }

  std::unique_ptr<WallEngine> engine_;
  const DriftStarts &starts_;
  const GridView wall_;
  int n_;
  ContactHistory springs_;
  Real dt_;
  std::vector<Real> x_, v_, omega_, force_, torque_, radius_, mass_;
  std::vector<int> mask_;
  bool has_history_;
};

Real median(std::vector<Real> change)
{
  if (change.empty()) return 0;
  const auto middle = change.begin() + change.size() / 2;
  std::nth_element(change.begin(), middle, change.end());
  return *middle;
}

}    // namespace

DriftStarts drift_starts(const WeldedMesh &mesh, const GridView &grid, Real radius, int n,
                         Random &random, std::size_t memory_budget)
{
  DriftStarts starts;
  starts.radius = radius;
  StepGridSettings settings;
  settings.cutoff = kThrough * radius;
  settings.memory_budget = memory_budget;
  starts.wall = build_grid(mesh, settings);
  std::vector<Real> area_up_to;    // of the faces so far
  Real area = 0;
  const auto corner = [&](std::size_t f, int k) { return mesh.vertices[mesh.faces[f][k]]; };
  const auto normal_of = [&](std::size_t f) {
    return cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0));
  };
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    area_up_to.push_back(area += norm(normal_of(f)));
  if (!(area > 0)) return starts;
  for (int tries = 100 * n; tries > 0 && starts.n() < n; tries--) {
    const std::size_t f = std::min<std::size_t>(
        std::upper_bound(area_up_to.begin(), area_up_to.end(), area * uniform_below_one(random)) -
            area_up_to.begin(),
        mesh.faces.size() - 1);
    Real u = uniform_below_one(random), w = uniform_below_one(random);
    if (u + w > 1) u = 1 - u, w = 1 - w;
    const Vec3 point =
        corner(f, 0) + u * (corner(f, 1) - corner(f, 0)) + w * (corner(f, 2) - corner(f, 0));
    const Vec3 n_face = normal_of(f);
    if (!(norm(n_face) > 0)) continue;
    const Vec3 normal = ((random() & 1 ? 1 : -1) / norm(n_face)) * n_face;
    const Vec3 first = any_perpendicular(normal), second = cross(normal, first);
    const Real turn = 2 * kPi * uniform_below_one(random);
    ContactSet<8> set;
    find_contacts(grid, point + radius * normal, Real(0.999) * radius, set);
    if (set.n > 0) continue;
    starts.point.push_back(point);
    starts.normal.push_back(normal);
    starts.along.push_back(std::cos(turn) * first + std::sin(turn) * second);
  }
  return starts;
}

Real bounce_drift(const ViewOf<StepGrid> &grid, EngineSettings engine, const DriftStarts &starts)
{
  constexpr Real kDrop = 0.2, kSpeed = 0.3, kTime = 13.7;
  const Real radius = starts.radius;
  engine.device = Device::cpu;
  engine.law() = ContactLaw();
  engine.law().k_normal = kStiffness / radius;
  Motion motion(grid, engine, starts, (1 + kDrop) * radius);
  for (int i = 0; i < starts.n(); i++)
    motion.set_speeds(i, kSpeed * std::sqrt(radius) * starts.along[i], {0, 0, 0});
  return median(motion.changes(kTime, kDrop * radius));
}

Real roll_drift(const ViewOf<StepGrid> &grid, EngineSettings engine, const DriftStarts &starts)
{
  constexpr Real kSpeed = 0.5, kTime = 10;
  const Real radius = starts.radius, speed = kSpeed * std::sqrt(radius);
  engine.device = Device::cpu;
  engine.law() = ContactLaw();
  engine.law() = classic_law(NormalModel::hooke, true);
  engine.law().k_normal = kStiffness / radius;
  engine.law().k_tangent = engine.law().k_normal * 2 / 7;
  engine.law().mu = 10000;
  Motion motion(grid, engine, starts, radius - radius / kStiffness);
  for (int i = 0; i < starts.n(); i++)
    motion.set_speeds(i, speed * starts.along[i],
                      (speed / radius) * cross(starts.normal[i], starts.along[i]));
  return median(motion.changes(kTime, Real(0.5) * (1 + kInertia) * speed * speed));
}

}    // namespace lsdcd
