// From a contact law's parameters to the compiled law that has just its effects.
#pragma once

#include "base/input_error.h"
#include "engine/wall_engine.h"
#include "model/contact_model.h"

namespace lsdcd {

// The law in numbers of type T.
template <class T, class Make>
auto with_law_of(const ContactLaw &p, Make make)
{
  const T k = static_cast<T>(p.k_normal), mu = static_cast<T>(p.mu);
  const MassVelocityDamping<T> damping = {static_cast<T>(p.gamma_normal)};
  const T k_tangent = static_cast<T>(p.k_tangent), gamma_tangent = static_cast<T>(p.gamma_tangent);
  const LinearHistory<T> history = {k_tangent, gamma_tangent, mu};
  switch (p.style) {
    case LawStyle::hooke_history:
      return make(HookeHistoryLaw<T>{k, damping, history, p.limit_damping});
    case LawStyle::hertz_history:
      return make(HertzHistoryLaw<T>{k, damping, history, p.limit_damping});
    default:
      return make(HookeLaw<T>{k, damping, LinearNoHistory<T>{gamma_tangent, mu}, p.limit_damping});
  }
}

// Calls make(law) with the one compiled law that the settings ask for.
template <class Make>
auto with_law(const EngineSettings &settings, Make make)
{
  if (settings.precision == Precision::single_) return with_law_of<float>(settings.law, make);
  return with_law_of<Real>(settings.law, make);
}

inline ForceSettings force_settings(const EngineSettings &engine, const StepSettings &step)
{
  ForceSettings s;
  s.dt = step.dt;
  s.update = step.update_history;
  s.search.blend = engine.corner == Corner::blend;
  s.search.side = engine.side == Side::both ? 0 : (engine.side == Side::out ? 1 : -1);
  s.with_point = step.per_sphere;
  return s;
}

}    // namespace lsdcd
