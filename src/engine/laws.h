// From a contact law's parameters to the compiled law that has just its effects.
#pragma once

#include "base/input_error.h"
#include "engine/wall_engine.h"
#include "model/contact_model.h"

namespace lsdcd {

// Calls make(law) with the one compiled law that the parameters ask for.
template <class Make>
auto with_law(const ContactLaw &p, Make make)
{
  const MassVelocityDamping damping = {p.gamma_normal};
  const LinearHistory history = {p.k_tangent, p.gamma_tangent, p.mu};
  switch (p.style) {
    case LawStyle::hooke_history:
      return make(HookeHistoryLaw{p.k_normal, damping, history, p.limit_damping});
    case LawStyle::hertz_history:
      return make(HertzHistoryLaw{p.k_normal, damping, history, p.limit_damping});
    default:
      return make(
          HookeLaw{p.k_normal, damping, LinearNoHistory{p.gamma_tangent, p.mu}, p.limit_damping});
  }
}

inline ForceSettings force_settings(const EngineSettings &engine, const StepSettings &step)
{
  ForceSettings s;
  s.dt = step.dt;
  s.update = step.update_history;
  s.blend = engine.corner == Corner::blend;
  s.side = engine.side == Side::both ? 0 : (engine.side == Side::out ? 1 : -1);
  s.with_point = step.per_sphere;
  return s;
}

}    // namespace lsdcd
