// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/wall_answers.h"

#include "engine/step/narrow_phase.h"
#include "engine/step/step_job.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace lsdcd {

namespace {

// The sample as spheres at rest with mass 1.
struct AtRest {
  std::vector<Real> x, still, radius, mass, force, torque, zero, heat;
  Spheres spheres;

  explicit AtRest(const SphereSample &sample)
  {
    const std::size_t n = sample.n();
    for (const Vec3 &p : sample.x) x.insert(x.end(), {p.x, p.y, p.z});
    radius = sample.radius;
    still.assign(3 * n, 0);
    mass.assign(n, 1);
    force.assign(3 * n, 0);
    torque.assign(3 * n, 0);
    zero.assign(n, 0);
    heat.assign(n, 0);
    spheres.n = sample.n();
    spheres.x = x.data();
    spheres.v = spheres.omega = still.data();
    spheres.radius = radius.data();
    spheres.mass = mass.data();
    spheres.force = force.data();
    spheres.torque = torque.data();
    spheres.temperature = zero.data();
    spheres.heat_flow = heat.data();
  }
};

template <int kCapacity>
bool append_contacts(const GridView &grid, const SearchSettings &search, const Vec3 &x, Real radius,
                     std::vector<WallAnswers::Contact> &contacts, bool &certain)
{
  WeightedContacts<kCapacity> t;
  CornerRule<kCapacity> rule;
  narrow_phase<false, false>(rule, grid, search, {x, radius, radius, nullptr, 0}, nullptr, t);
  if (t.set.overflow) return false;
  certain = t.exact_within >= radius;
  for (int i = 0; i < t.set.n; i++)
    contacts.push_back({-t.set.distance[i] * t.set.normal[i], radius - t.set.distance[i],
                        t.weight[i] * (radius - t.set.distance[i]) >= kGrazing * radius});
  return true;
}

}    // namespace

WallAnswers evaluate_sample(const ViewOf<StepGrid> &grid, const EngineSettings &engine,
                            const SphereSample &sample)
{
  WallAnswers out;
  const SearchSettings search = {engine.corner, engine.side};
  out.first.push_back(0);
  for (int i = 0; i < sample.n(); i++) {
    bool certain = true;
    if (!append_contacts<64>(grid, search, sample.x[i], sample.radius[i], out.contacts, certain))
      append_contacts<kMaxContacts>(grid, search, sample.x[i], sample.radius[i], out.contacts,
                                    certain);
    out.uncertified += !certain;
    out.first.push_back(out.contacts.size());
  }

  EngineSettings on_cpu = engine;
  on_cpu.law() = ContactLaw();
  on_cpu.law().k_normal = engine.law().k_normal;
  on_cpu.device = Device::cpu;
  const auto cpu = make_engine(on_cpu);
  cpu->set_grid(grid);
  AtRest at_rest(sample);
  StepSettings step;
  step.update_history = false;
  step_once(*cpu, at_rest.spheres, step, nullptr);
  for (int i = 0; i < sample.n(); i++)
    out.force.push_back({at_rest.force[3 * i], at_rest.force[3 * i + 1], at_rest.force[3 * i + 2]});
  return out;
}

AnswerError compare(const WallAnswers &reference, const WallAnswers &trial,
                    const SphereSample &sample, Real stiffness)
{
  constexpr Real kSamePoint = 1e-3;    // of a radius
  AnswerError out;
  out.uncertified = trial.uncertified;
  std::vector<Real> errors;
  Real sum_errors = 0, sum_forces = 0;
  for (int i = 0; i < sample.n(); i++) {
    const Real radius = sample.radius[i];
    for (std::size_t k = reference.first[i]; k < reference.first[i + 1]; k++) {
      const WallAnswers::Contact &wanted = reference.contacts[k];
      if (!wanted.bears) continue;
      out.contacts++;
      out.missed += std::none_of(
          trial.contacts.begin() + trial.first[i], trial.contacts.begin() + trial.first[i + 1],
          [&](const auto &p) { return norm(p.closest - wanted.closest) <= kSamePoint * radius; });
    }
    const bool touches =
        reference.first[i] < reference.first[i + 1] || trial.first[i] < trial.first[i + 1];
    if (!touches) continue;
    const Real force = norm(reference.force[i]), error = norm(trial.force[i] - reference.force[i]);
    errors.push_back(error / std::fmax(force, stiffness * kUsualOverlap * radius));
    sum_errors += error;
    sum_forces += force;
  }
  if (errors.empty()) return out;
  const auto middle = errors.begin() + errors.size() / 2;
  std::nth_element(errors.begin(), middle, errors.end());
  out.median = *middle;
  out.largest = *std::max_element(errors.begin(), errors.end());
  out.mean = sum_forces > 0 ? sum_errors / sum_forces : 0;
  return out;
}

}    // namespace lsdcd
