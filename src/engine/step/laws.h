// From a contact law's parameters to the compiled law that has just its effects.
#pragma once

#include "engine/wall_engine.h"
#include "law/contact_model.h"

#include <type_traits>

namespace lsdcd {

// The classic styles, in numbers of type T: calls make(law).
template <class T, class Make>
auto with_classic_law(const ContactLaw &p, Make make)
{
  const T k = static_cast<T>(p.k_normal), mu = static_cast<T>(p.mu);
  const MassVelocityDamping<T> damping = {static_cast<T>(p.gamma_normal)};
  const T k_tangent = static_cast<T>(p.k_tangent), gamma_tangent = static_cast<T>(p.gamma_tangent);
  const LinearHistory<T> history = {k_tangent, gamma_tangent, mu};
  switch (p.style) {
    case LawStyle::hooke_history:
      return make(HookeHistoryLaw<T>{{k}, damping, history, p.limit_damping});
    case LawStyle::hertz_history:
      return make(HertzHistoryLaw<T>{{k}, damping, history, p.limit_damping});
    default:
      return make(
          HookeLaw<T>{{k}, damping, LinearNoHistory<T>{gamma_tangent, mu}, p.limit_damping});
  }
}

// A classic style with effects of LIGGGHTS beside it: calls make(law).
template <class Make>
auto with_added_law(const ContactLaw &p, const Make &make)
{
  const AddedEffects &a = p.added;
  return with_classic_law<Real>(p, [&](const auto &base) {
    using Base = std::decay_t<decltype(base)>;
    const LiggghtsRolling<Real> rolling = {a.rolling, a.mu_roll};
    if constexpr (!Base::kHistory)
      if (!p.has_history())
        return make(AddedModel<Base, false>{base, rolling, {a.cohesion}, p.k_tangent});
    return make(AddedModel<Base, true>{base, rolling, {a.cohesion}, p.k_tangent});
  });
}

// `granular` with one normal sub-model.
template <bool kHistory, bool kFull, class Normal>
GranularModel<Real, Normal, kHistory, kFull> granular_model(const ContactLaw &p,
                                                            const Normal &normal)
{
  const GranularLaw &g = p.granular;
  const TangentialModel t = g.tangential;
  const bool spring = t != TangentialModel::linear_nohistory,
             mindlin = t >= TangentialModel::mindlin;
  const bool of_force =
      t == TangentialModel::mindlin_force || t == TangentialModel::mindlin_rescale_force;
  const bool sized = g.damping == DampingModel::viscoelastic || mindlin ||
                     g.twisting == TwistingModel::marshall || g.heat != HeatModel::none;
  return {normal,
          {g.damping, g.eta},
          {spring ? g.k_tangent : 0, g.x_tangent, g.mu, spring, mindlin, of_force, p.has_rescale()},
          {g.rolling, g.k_roll, g.gamma_roll, g.mu_roll},
          {g.twisting, g.k_twist, g.gamma_twist, g.mu_twist},
          {g.heat, g.conductance},
          sized,
          p.limit_damping};
}

// `granular`: calls make(law) with the smallest law that has all that is asked for.
template <class Make>
auto with_granular_law(const ContactLaw &p, const Make &make)
{
  const GranularLaw &g = p.granular;
  if (g.normal == NormalModel::jkr)
    return make(granular_model<true, true>(p, JkrNormal<Real>(g.modulus, g.cohesion)));
  const Real pull =
      g.normal == NormalModel::dmt ? 4 * Real(3.14159265358979323846) * g.cohesion : 0;
  const TouchingNormal<Real> normal = {g.normal, g.k_normal, pull};
  const bool full = p.has_rolling() || p.has_twisting() || p.has_heat() || p.has_rescale();
  if (p.has_history())
    return full ? make(granular_model<true, true>(p, normal))
                : make(granular_model<true, false>(p, normal));
  return full ? make(granular_model<false, true>(p, normal))
              : make(granular_model<false, false>(p, normal));
}

}    // namespace lsdcd
