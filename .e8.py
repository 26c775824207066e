exec(open('/tmp/h-eff.sub.py').read().split("# on_wall")[0])
sub('src/model/contact_law.h',("struct ContactLaw {\n","""// Of LIGGGHTS; beside one of the classic styles.
enum class AddedRolling { none, cdt, epsd2 };
struct AddedEffects {
  AddedRolling rolling = AddedRolling::none;
  Real mu_roll = 0;    // rolling friction coefficient
  Real cohesion = 0;    // energy/length^3 (sjkr); 0: none

  bool any() const { return rolling != AddedRolling::none || cohesion > 0; }
};

struct ContactLaw {
"""),("  GranularLaw granular;    // where style is granular\n","  GranularLaw granular;    // where style is granular\n  AddedEffects added;      // where it is not\n"),
("    if (style != LawStyle::granular) return style != LawStyle::hooke;\n","    if (style != LawStyle::granular)\n      return style != LawStyle::hooke || added.rolling == AddedRolling::epsd2;\n"),
("  int n_extra() const { return 3 * has_rolling() + has_twisting() + has_rescale(); }","""  int n_extra() const
  {
    const bool rolled = has_rolling() || added.rolling == AddedRolling::epsd2;
    return 3 * rolled + has_twisting() + has_rescale();
  }"""))
s=open('src/model/rolling.h').read()
i=s.rindex("}    // namespace lsdcd")
s=s[:i]+'''// ---- of LIGGGHTS, beside a classic style -------------------------------------------------
// couple(c, elastic, normal, k_tangent, memory, at): the couple on the sphere, where the
// contact bears the elastic force `elastic` and in all, damping included, `normal`, with
// the tangential stiffness k_tangent (force/length).

// The part of the sphere's turning that rolls.
template <class T>
LSDCD_FN Vec3Of<T> rolling_part(const Vec3Of<T> &omega, const Vec3Of<T> &normal)
{
  return omega - dot(omega, normal) * normal;
}

// `cdt`, constant directional torque: mu k_n overlap R against the rolling, whatever its
// speed (Ai et al. 2011, model A). Near rest it changes sign from step to step, as any
// constant friction does, and the spin stays within a step's change of 0.
template <class T>
struct CdtRolling {
  static constexpr bool kOn = true;
  static constexpr int kVectors = 0;
  T mu;

  template <class Memory>
  LSDCD_FN Vec3Of<T> couple(const Contact<T> &c, T elastic, T, T, Memory &, int) const
  {
    const Vec3Of<T> rolls = rolling_part(c.omega, c.normal);
    const T rate = norm(rolls);
    if (!(rate > 0)) return {0, 0, 0};
    return (-mu * elastic * c.radius / rate) * rolls;
  }
  template <class Memory>
  LSDCD_FN T energy(const Contact<T> &, T, const Memory &, int) const
  {
    return 0;
  }
};

// `epsd2`, elastic-plastic spring: a couple that grows by k_t R^2 per angle rolled, up to
// mu |F_n| R (Iwashita and Oda 1998; Ai et al. 2011, model C without its dashpot). The
// couple is the vector `at` of the memory.
template <class T>
struct Epsd2Rolling {
  static constexpr bool kOn = true;
  static constexpr int kVectors = 1;
  T mu;

  template <class Memory>
  LSDCD_FN Vec3Of<T> couple(const Contact<T> &c, T, T normal, T k_tangent, Memory &m, int at) const
  {
    Vec3Of<T> held = m.vec(at);
    if (c.update) {
      const T stiff = k_tangent * c.radius * c.radius;
      held -= (stiff * c.dt) * rolling_part(c.omega, c.normal);
      held = rolling_part(held, c.normal);
    }
    const T size = norm(held), limit = mu * fabs(normal) * c.radius;
    if (size > limit) held = (limit / size) * held;
    m.put(at, held);
    return held;
  }
  template <class Memory>
  LSDCD_FN T energy(const Contact<T> &c, T k_tangent, const Memory &m, int at) const
  {
    const T stiff = k_tangent * c.radius * c.radius;
    return stiff > 0 ? T(0.5) * norm_sq(m.vec(at)) / stiff : T(0);
  }
};

'''+s[i:]
s=s.replace("  static constexpr bool kOn = false;\n","  static constexpr bool kOn = false;\n  static constexpr int kVectors = 0;\n",1)
open('src/model/rolling.h','w').write(s)
open('src/model/cohesion.h','w').write('''// Cohesion beside a normal law: a pull that acts where the surfaces touch.
#pragma once

#include "model/contact.h"

namespace lsdcd {

template <class T>
struct NoCohesion {
  static constexpr bool kOn = false;
};

// `sjkr` of LIGGGHTS: k times the area in which a plane cuts the sphere, pi (R^2 - r^2)
// with the centre's distance r = R - overlap. Friction does not see it.
template <class T>
struct SjkrCohesion {
  static constexpr bool kOn = true;
  T k;    // energy/length^3

  LSDCD_FN T pull(const Contact<T> &c) const
  {
    return T(3.14159265358979323846) * k * c.overlap * (2 * c.radius - c.overlap);
  }
  // Of the surfaces that have come together; < 0.
  LSDCD_FN T energy(const Contact<T> &c) const
  {
    return T(-3.14159265358979323846) * k * c.overlap * c.overlap * (c.radius - c.overlap / 3);
  }
};

}    // namespace lsdcd
''')
sub('src/model/contact_model.h',('#include "model/contact.h"\n','#include "model/cohesion.h"\n#include "model/contact.h"\n'),
("// The sub-models of `granular`, with the formulas of LAMMPS 4Jul2026.\ntemplate <class T>\nstruct GranularForce : ContactForce<T> {","""// Of laws with kCouple or kHeat.
template <class T>
struct FullForce : ContactForce<T> {"""))
s=open('src/model/contact_model.h').read()
s=s.replace("GranularForce<T>","FullForce<T>")
i=s.index("template <class T, class Normal, class Tangential, class Rolling, class Twisting, class Heat>")
s=s[:i]+'''// A classic style with effects of LIGGGHTS beside it.
template <class Base, class Rolling, class Cohesion>
struct AddedModel {
  using Number = typename Base::Number;
  using T = Number;
  static constexpr int kVectors = Rolling::kVectors, kScalars = 0, kExtra = 3 * kVectors;
  static constexpr bool kHistory = Base::kHistory || kVectors > 0;
  static constexpr bool kBeyond = false, kCouple = Rolling::kOn, kHeat = false;

  Base base;
  Rolling rolling;
  Cohesion cohesion;
  T k_tangent;    // per unit of Base::scale()

  LSDCD_FN FullForce<T> evaluate(const Contact<T> &c, ContactMemory<T, kExtra> &memory) const
  {
    ContactMemory<T, 0> sliding = {memory.stretch};
    FullForce<T> out = {base.evaluate(c, sliding), {0, 0, 0}, 0};
    memory.stretch = sliding.stretch;
    if constexpr (Rolling::kOn) {
      const T scale = base.scale(c);
      out.couple = rolling.couple(c, base.elastic.force(c, scale), out.normal, scale * k_tangent,
                                  memory, 0);
      out.energy += rolling.energy(c, scale * k_tangent, memory, 0);
    }
    if constexpr (Cohesion::kOn) {
      out.normal -= cohesion.pull(c);
      out.energy += cohesion.energy(c);
    }
    return out;
  }
};

// The sub-models of `granular`, with the formulas of LAMMPS 4Jul2026.
'''+s[i:]
s=s.replace('''  LSDCD_FN ContactForce<T> evaluate(const Contact<T> &c, ContactMemory<T, 0> &memory) const
  {
    const T scale = Normal<T>::kSized ? elastic.contact_radius(c) : T(1);
''','''  // What the stiffnesses are multiplied by: the contact radius, or 1.
  LSDCD_FN T scale(const Contact<T> &c) const
  {
    return Normal<T>::kSized ? elastic.contact_radius(c) : T(1);
  }

  LSDCD_FN ContactForce<T> evaluate(const Contact<T> &c, ContactMemory<T, 0> &memory) const
  {
    const T scale = this->scale(c);
''')
open('src/model/contact_model.h','w').write(s)
sub('src/engine/laws.h',("// `granular` with one normal","""// A classic style with effects of LIGGGHTS beside it: calls make(law).
template <class Make>
auto with_added_law(const ContactLaw &p, const Make &make)
{
  const AddedEffects &a = p.added;
  return with_classic_law<Real>(p, [&](const auto &base) {
    using Base = std::decay_t<decltype(base)>;
    const auto with_cohesion = [&](const auto &rolling) {
      using Rolling = std::decay_t<decltype(rolling)>;
      if (a.cohesion > 0)
        return make(AddedModel<Base, Rolling, SjkrCohesion<Real>>{
            base, rolling, {a.cohesion}, p.k_tangent});
      return make(AddedModel<Base, Rolling, NoCohesion<Real>>{base, rolling, {}, p.k_tangent});
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

// `granular` with one normal"""),('#include "model/contact_model.h"\n','#include "model/contact_model.h"\n\n#include <type_traits>\n'))
for side,ext in (('host','cpp'),('cuda','cu')):
    S=side.capitalize()
    open('src/engine/laws/%s_added.%s'%(side,ext),'w').write('''#include "engine/%s_law.h"

namespace lsdcd {

%sLaw %s_added_law(const EngineSettings &s)
{
  return with_added_law(s.law, Make%sLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
'''%(side,S,side,S))
    sub('src/engine/%s_law.%s'%(side,ext),("  if (law.style != LawStyle::granular) {\n","  if (law.style != LawStyle::granular && law.added.any()) return %s_added_law(settings);\n  if (law.style != LawStyle::granular) {\n"%side))
    h='src/engine/compiled_law.h' if side=='host' else 'src/engine/cuda_law.h'
    s=open(h).read()
    line="%sLaw %s_jkr_law(const EngineSettings &);\n"%(S,side)
    assert line in s
    s=s.replace(line,line+"\n// Those of the classic styles with effects of LIGGGHTS.\n%sLaw %s_added_law(const EngineSettings &);\n"%(S,side))
    open(h,'w').write(s)
sub('src/CMakeLists.txt',("  engine/laws/host_jkr.cpp","  engine/laws/host_jkr.cpp engine/laws/host_added.cpp"),("engine/laws/cuda_jkr.cu)","engine/laws/cuda_jkr.cu engine/laws/cuda_added.cu)"))
sub('src/engine/make_engine.cpp',("  return settings.law.style != LawStyle::granular && !settings.surface.moves() &&\n         !settings.records;","  return settings.law.style != LawStyle::granular && !settings.law.added.any() &&\n         !settings.surface.moves() && !settings.records;"),
("neither granular nor a moving surface","neither granular, rolling, cohesion, a moving surface"),("wear or mesh_fields: use","wear nor mesh_fields: use"))
sub('src/engine/wall_engine.h',("There are for the classic styles on walls that only bear.","There are for the classic styles with nothing\n// beside them, on walls that only bear."))
