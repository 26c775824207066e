// From a contact law's parameters to the compiled law that has just its effects.
#pragma once

#include "engine/wall_engine.h"
#include "model/contact_model.h"

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
    const auto with_cohesion = [&](const auto &rolling) {
      using Rolling = std::decay_t<decltype(rolling)>;
      if constexpr (Rolling::kOn)
        if (!(a.cohesion > 0))
          return make(AddedModel<Base, Rolling, NoCohesion<Real>>{base, rolling, {}, p.k_tangent});
      return make(
          AddedModel<Base, Rolling, SjkrCohesion<Real>>{base, rolling, {a.cohesion}, p.k_tangent});
    };
    switch (a.rolling) {
      case AddedRolling::cdt:
        return with_cohesion(CdtRolling<Real>{a.mu_roll});
      case AddedRolling::epsd2:
        return with_cohesion(Epsd2Rolling<Real>{a.mu_roll});
      default:
        return with_cohesion(NoRolling<Real>{});
    }
  });
}

// `granular` with one normal sub-model, its other sub-models chosen one after another:
// each function here adds one template argument, and the last calls make(law).
template <class Normal, class Make>
class GranularLaws {
  using T = Real;

 public:
  GranularLaws(const ContactLaw &p, const Normal &normal, const Make &make) :
      p_(p), g_(p.granular), normal_(normal), make_(make)
  {
  }

  auto choose() const
  {
    const T k = g_.k_tangent, x = g_.x_tangent, mu = g_.mu;
    const TangentialModel t = g_.tangential;
    const bool sized = t != TangentialModel::linear_history;
    const bool of_force =
        t == TangentialModel::mindlin_force || t == TangentialModel::mindlin_rescale_force;
    if (t == TangentialModel::linear_nohistory) return with_rolling(SlipFriction<T>{x, mu});
    if (p_.has_rescale()) return with_rolling(SpringFriction<T, true>{k, x, mu, sized, of_force});
    return with_rolling(SpringFriction<T, false>{k, x, mu, sized, of_force});
  }

 private:
  template <class Tangential>
  auto with_rolling(const Tangential &t) const
  {
    if (g_.rolling) return with_twisting(t, SdsRolling<T>{g_.k_roll, g_.gamma_roll, g_.mu_roll});
    return with_twisting(t, NoRolling<T>{});
  }
  template <class Tangential, class Rolling>
  auto with_twisting(const Tangential &t, const Rolling &r) const
  {
    if (g_.twisting != TwistingModel::none)
      return with_heat(t, r,
                       SpringTwisting<T>{g_.twisting == TwistingModel::marshall, g_.k_twist,
                                         g_.gamma_twist, g_.mu_twist});
    return with_heat(t, r, NoTwisting<T>{});
  }
  template <class Tangential, class Rolling, class Twisting>
  auto with_heat(const Tangential &t, const Rolling &r, const Twisting &w) const
  {
    if (g_.heat != HeatModel::none)
      return make(t, r, w, Conduction<T>{g_.heat == HeatModel::area, g_.conductance});
    return make(t, r, w, NoHeat<T>{});
  }
  template <class Tangential, class Rolling, class Twisting, class Heat>
  auto make(const Tangential &t, const Rolling &r, const Twisting &w, const Heat &h) const
  {
    const bool sized = g_.damping == DampingModel::viscoelastic ||
                       g_.tangential >= TangentialModel::mindlin ||
                       g_.twisting == TwistingModel::marshall || g_.heat != HeatModel::none;
    return make_(GranularModel<T, Normal, Tangential, Rolling, Twisting, Heat>{
        normal_, {g_.damping, g_.eta}, t, r, w, h, sized, p_.limit_damping});
  }

  const ContactLaw &p_;
  const GranularLaw &g_;
  Normal normal_;
  Make make_;
};

template <class Normal, class Make>
auto with_granular_law(const ContactLaw &p, const Normal &normal, const Make &make)
{
  return GranularLaws<Normal, Make>(p, normal, make).choose();
}

}    // namespace lsdcd
