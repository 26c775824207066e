// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From the numbers of a law to the smallest contact model that has all effects asked for.
#pragma once

#include "law/contact_law.h"
#include "law/contact_model.h"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <type_traits>

namespace lsdcd {

// Calls make(law) with the law of a classic style.
template <class Make>
auto with_classic_law(const ContactLaw &p, Make make)
{
  const MassVelocityDamping damping = {p.eta};
  const LinearHistory history = {p.k_tangent, p.gamma_tangent, p.mu};
  if (p.is(NormalModel::hertz))
    return make(HertzHistoryLaw{{p.k_normal}, damping, history, p.limit_damping});
  if (p.tangential == TangentialModel::linear_history_classic)
    return make(HookeHistoryLaw{{p.k_normal}, damping, history, p.limit_damping});
  return make(
      HookeLaw{{p.k_normal}, damping, LinearNoHistory{p.gamma_tangent, p.mu}, p.limit_damping});
}

// Returns a rolling model with its numbers, among those of one kernel.
template <class Family, class Model>
Family family_of(const Chosen<Model> &chosen)
{
  Family family = {chosen.model, {}};
  for (std::size_t k = 0; k < std::size(family.numbers); k++) family.numbers[k] = chosen.numbers[k];
  if (chosen.is_on() && !family.is_on())
    throw std::logic_error("no compiled law has this rolling model: name it in rolling.h");
  return family;
}

// Calls make(law) with the law of a classic style that has rolling or cohesion beside it.
template <class Make>
auto with_added_law(const ContactLaw &p, const Make &make)
{
  return with_classic_law(p, [&](const auto &base) {
    using Base = std::decay_t<decltype(base)>;
    const auto rolling = family_of<AnyRolling>(p.rolling);
    const SjkrCohesion cohesion = {p.cohesion.numbers[0]};
    if constexpr (!Base::kHistory)
      if (!p.has_history())
        return make(AddedModel<Base, false>{base, rolling, cohesion, p.k_tangent});
    return make(AddedModel<Base, true>{base, rolling, cohesion, p.k_tangent});
  });
}

// Returns the friction of a law of `granular`.
inline GranularFriction granular_friction(const ContactLaw &p)
{
  const TangentialModel t = p.tangential;
  const bool spring = p.has_spring(), mindlin = t >= TangentialModel::mindlin;
  const bool of_force =
      t == TangentialModel::mindlin_force || t == TangentialModel::mindlin_rescale_force;
  const bool slip = t == TangentialModel::linear_history_slip || t == TangentialModel::mindlin_slip;
  return {spring ? p.k_tangent : 0, p.xgammat, p.mu, spring, mindlin, of_force, p.rescales(), slip,
          p.is_at_midpoint()};
}

// Returns the numbers of cohesion that acts beyond touch, as its formulas read them.
inline ReachingCohesion reaching_cohesion(const ContactLaw &p)
{
  const CohesionModel model = p.cohesion.model;
  const Real *const n = p.cohesion.numbers;
  if (model == CohesionModel::constant || model == CohesionModel::linear)
    return {model, n[0], 0, n[1], 0, 0};
  if (model == CohesionModel::constant_weight) return {model, n[0] * n[1], 0, n[2], 0, 0};
  // The force has the mean of the cosines of the two surfaces, and the rupture distance the mean of their angles: (1 + theta/2) (V^(1/3) +
  // V^(2/3)/(10 R')) (Willett et al. 2000, equation 15).
  const Real first = n[1] * kPi / 180, second = n[2] * kPi / 180;
  const Real pull = 4 * kPi * n[0] * 0.5 * (std::cos(first) + std::cos(second));
  const Real longer = 1 + 0.25 * (first + second), per_length = 1 / (20 * longer);
  const bool shares = model == CohesionModel::capillary_share;
  const Real volume = shares ? 4 * kPi / 3 * n[3] : n[3], length = longer * std::cbrt(volume);
  return {model,     pull, std::sqrt(0.5 / volume), shares ? 0 : length, shares ? length : 0,
          per_length};
}

// Returns the cohesion of a law, of the kind that its set has.
template <class Cohesion>
Cohesion cohesion_of(const ContactLaw &p)
{
  if constexpr (std::is_same_v<Cohesion, ReachingCohesion>)
    return reaching_cohesion(p);
  else
    return {p.cohesion.numbers[0]};
}

// Returns the model of a law of `granular` with its normal sub-model.
template <bool kHistory, GranularSet kSet, class Normal>
GranularModel<Normal, kHistory, kSet> granular_model(const ContactLaw &p, const Normal &normal)
{
  using Model = GranularModel<Normal, kHistory, kSet>;
  const GranularFriction friction = granular_friction(p);
  const bool uses_contact_radius = p.damping == DampingModel::viscoelastic || friction.by_radius ||
                                   p.twisting.model == TwistingModel::marshall || p.has_heat();
  const Real *const twisting = p.twisting.numbers;
  return {normal,
          {p.damping, p.eta},
          friction,
          family_of<typename Model::Rolls>(p.rolling),
          {p.twisting.model, twisting[0], twisting[1], twisting[2]},
          {p.heat.model, p.heat.numbers[0]},
          cohesion_of<typename Model::Cohesion>(p),
          uses_contact_radius,
          p.limit_damping};
}

// Returns a normal sub-model whose formulas are in TouchingNormal, with its numbers.
inline TouchingNormal touching_normal(const ContactLaw &p)
{
  if (p.is(NormalModel::jkr) || p.yields())
    throw std::logic_error("this normal sub-model acts beyond touch, or yields");
  return {p.normal, p.k_normal, p.is_adhesive() ? 4 * kPi * p.surface_energy : 0};
}

inline JkrNormal jkr_normal(const ContactLaw &p)
{
  return JkrNormal(p.modulus, p.surface_energy);
}

// Returns the normal sub-model of a law whose cohesion acts beyond touch, with its numbers.
inline ReachingNormal reaching_normal(const ContactLaw &p)
{
  if (!ReachingNormal::has(p.normal))
    throw std::logic_error(
        "no law that acts across a gap has this normal sub-model: name it in plastic.h");
  ReachingNormal normal = {p.normal, {}};
  if (p.yields()) {
    for (int k = 0; k < kPlasticNumbers; k++) normal.numbers[k] = p.plastic[k];
    return normal;
  }
  const TouchingNormal touching = touching_normal(p);
  normal.numbers[0] = touching.k;
  normal.numbers[1] = touching.pull;
  return normal;
}

// Returns a normal sub-model that yields, with its numbers.
inline PlasticNormal plastic_normal(const ContactLaw &p)
{
  if (!PlasticNormal::has(p.normal))
    throw std::logic_error("no compiled law has this normal sub-model: name it in plastic.h");
  PlasticNormal normal = {p.normal, {}};
  for (int k = 0; k < kPlasticNumbers; k++) normal.numbers[k] = p.plastic[k];
  return normal;
}

// Calls act(normal) with the normal sub-model of a law, with the numbers of `granular`.
template <class Act>
auto with_normal(const ContactLaw &p, const Act &act)
{
  if (p.yields()) return act(plastic_normal(p));
  return p.is(NormalModel::jkr) ? act(jkr_normal(p)) : act(touching_normal(p));
}

// Returns whether a law of `granular` has other sub-models than a normal one, its damping and friction that is not rescaled.
inline bool has_more(const ContactLaw &p)
{
  return p.rolling.is_on() || p.twisting.is_on() || p.has_heat() || p.rescales() ||
         p.cohesion.is_on();
}

// Calls make(law) with a law of `granular`: of the set kFew, or of kMore if has_more().
template <GranularSet kFew, GranularSet kMore, class Make>
auto with_granular_sets(const ContactLaw &p, const Make &make)
{
  if (p.is(NormalModel::jkr)) return make(granular_model<true, kMore>(p, jkr_normal(p)));
  const TouchingNormal normal = touching_normal(p);
  const bool more = has_more(p);
  if (p.has_history())
    return more ? make(granular_model<true, kMore>(p, normal))
                : make(granular_model<true, kFew>(p, normal));
  return more ? make(granular_model<false, kMore>(p, normal))
              : make(granular_model<false, kFew>(p, normal));
}

// Calls make(law) with the smallest law of `granular` that has all that is asked for, without sub-models of LIGGGHTS.
template <class Make>
auto with_granular_law(const ContactLaw &p, const Make &make)
{
  return with_granular_sets<GranularSet::few, GranularSet::full>(p, make);
}

// Calls make(law) with the smallest law of `granular` that has all that is asked for, with sub-models of LIGGGHTS: with its friction alone,
// if the law has neither its rolling nor its cohesion.
template <class Make>
auto with_granular_added_law(const ContactLaw &p, const Make &make)
{
  return with_granular_sets<GranularSet::midpoint, GranularSet::all>(p, make);
}

// Calls make(law) with the law of `granular` whose contacts yield. There is one, with all sub-models.
template <class Make>
auto with_plastic_law(const ContactLaw &p, const Make &make)
{
  return make(granular_model<true, GranularSet::all>(p, plastic_normal(p)));
}

// Calls make(law) with the law of `granular` whose cohesion acts beyond touch. There is one, with all sub-models.
template <class Make>
auto with_reaching_law(const ContactLaw &p, const Make &make)
{
  return make(granular_model<true, GranularSet::reaching>(p, reaching_normal(p)));
}

// Calls make(law) for any law that keeps_forces or keeps_touch. Few laws are compiled with energy balance and impacts: for `granular` one
// without the sub-models that few scenes use, and one that has all.
template <class Make>
auto with_energy_law(const ContactLaw &p, const Make &make)
{
  if (!p.is_classic()) {
    if (p.reaches()) return with_reaching_law(p, make);
    if (p.yields()) return with_plastic_law(p, make);
    if (p.is(NormalModel::jkr))
      return make(granular_model<true, GranularSet::all>(p, jkr_normal(p)));
    const TouchingNormal normal = touching_normal(p);
    return has_more(p) ? make(granular_model<true, GranularSet::all>(p, normal))
                       : make(granular_model<true, GranularSet::either>(p, normal));
  }
  return with_classic_law(p, [&](const auto &base) {
    return make(AddedModel<std::decay_t<decltype(base)>, true>{
        base, family_of<AnyRolling>(p.rolling), {p.cohesion.numbers[0]}, p.k_tangent});
  });
}

}    // namespace lsdcd
