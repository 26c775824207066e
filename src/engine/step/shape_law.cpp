// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "engine/step/shape_law.h"
#include "engine/shape_engine.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "engine/step/compile_law.h"
#include "engine/step/shape_step.h"

#include <string>

namespace lsdcd {
namespace {

// Does the law read Contact::radius?
template <class Normal, class Damping, class Tangential>
bool reads_radius(const ContactModel<Normal, Damping, Tangential> &)
{
  return Normal::kUsesContactRadius;
}
template <class Normal, bool kHistory>
bool reads_radius(const GranularModel<Normal, kHistory, GranularSet::few> &law)
{
  return law.uses_contact_radius || law.elastic.uses_contact_radius();
}

// Returns friction_spring() of the law `of`, whose memory but for the spring is of effects that are off.
template <class Base>
SpringPart spring_of(const LawBytes &of, const Contact &c, const Vec3 &begun, const Vec3 &shear)
{
  if constexpr (Base::kHistory) {
    ContactMemory<Base::kExtra> before = {}, after = {};
    before.shear = begun;
    after.shear = shear;
    return of.as<Base>().friction_spring(c, before, after);
  } else {
    return {};
  }
}

// Returns a law for shapes by one of spheres; all of them have the kernels of walls that move and keep contacts.
template <class Base>
CompiledLaw<CpuBackend> compiled(const Base &base, ShapeWork &work)
{
  static_assert(Base::kExtra == 0 && !Base::kBeyondContact && !Base::kContactTorque,
                "such laws are not for shapes");
  using Law = OnWall<ShapeLaw<Base::kHistory>, true, true>;
  work.laws.emplace_back(base);
  const auto evaluate = [](const LawBytes &of, const Contact &c, ContactMemory<0> &memory) {
    return static_cast<ContactForce>(of.as<Base>().evaluate(c, memory));
  };
  const Law law = {
      {&work.laws.back(), evaluate, spring_of<Base>, reads_radius(base), &work, nullptr, nullptr},
      {},
      {}};
  return {traits_of(law), {LawBytes(law)}, run_shape_law<Law, CpuBackend>};
}

// Returns a law for shapes with energy balance, by one of spheres that says what its force is made of. What that keeps beside its spring is
// of effects that are off.
template <bool kRecords, class Base>
CompiledLaw<CpuBackend> booked(const Base &base, bool reads, [[maybe_unused]] bool keeps_losses,
                               ShapeWork &work)
{
  static_assert(!Base::kBeyondContact, "such laws are not for shapes");
  using Law = OnWall<ShapeLaw<true, true>, true, true, false, true, kRecords>;
  using Memory = ContactMemory<Base::kExtra>;
  work.laws.emplace_back(base);
  const auto evaluate = [](const LawBytes &of, const Contact &c, ContactMemory<0> &sliding) {
    Memory memory = {sliding.shear, {}};
    const ContactForce force = of.as<Base>().evaluate(c, memory);
    sliding.shear = memory.shear;
    return force;
  };
  const auto parts = [](const LawBytes &of, const Contact &c, const Vec3 &begun, const Vec3 &shear,
                        const FullForce &force) {
    return of.as<Base>().parts(c, Memory{begun, {}}, Memory{shear, {}}, force);
  };
  const auto energy = [](const LawBytes &of, const Contact &c, Real overlap) {
    return of.as<Base>().normal_energy(c, overlap);
  };
  Law law = {{&work.laws.back(), evaluate, spring_of<Base>, reads, &work, parts, energy}, {}, {}};
  if constexpr (kRecords) law.keeps_losses = keeps_losses;
  return {traits_of(law), {LawBytes(law)}, run_shape_law<Law, CpuBackend>};
}

template <bool kRecords>
CompiledLaw<CpuBackend> booked_law(const ContactLaw &p, ShapeWork &work)
{
  if (p.is_classic())
    return with_classic_law(p, [&](const auto &law) {
      using Base = std::decay_t<decltype(law)>;
      return booked<kRecords>(
          AddedModel<Base, true>{law, family_of<AnyRolling>(p.rolling), {0}, p.k_tangent},
          reads_radius(law), p.keeps_losses, work);
    });
  const auto law =
      granular_model<true, GranularSet::all>(p, TouchingNormal{p.normal, p.k_normal, 0});
  return booked<kRecords>(law, law.uses_contact_radius || law.elastic.uses_contact_radius(),
                          p.keeps_losses, work);
}

CompiledLaw<CpuBackend> compiled_law(const ContactLaw &p, bool records, ShapeWork &work)
{
  const std::string why = why_not_for_shapes(p);
  if (!why.empty()) throw InputError(why);
  if (p.keeps_forces) return records ? booked_law<true>(p, work) : booked_law<false>(p, work);
  if (p.is_classic())
    return with_classic_law(p, [&](const auto &law) { return compiled(law, work); });
  const TouchingNormal normal = {p.normal, p.k_normal, 0};
  return p.has_history() ? compiled(granular_model<true, GranularSet::few>(p, normal), work)
                         : compiled(granular_model<false, GranularSet::few>(p, normal), work);
}

}    // namespace

CompiledLaw<CpuBackend> shape_law_for(const EngineSettings &settings, ShapeWork &work)
{
  const bool records = settings.records_energy();
  CompiledLaw<CpuBackend> all = compiled_law(settings.law(), records, work);
  all.laws.clear();
  for (const ContactLaw &law : settings.laws.laws)
    all.laws.push_back(compiled_law(law, records, work).laws.front());
  return all;
}

std::string why_not_for_shapes(const ContactLaw &law)
{
  const auto refused = [](const char *what) {
    return std::string(what) +
           ": the wall has it for spheres alone; grains of other shapes can have hooke and hertz "
           "with their damping and sliding friction";
  };
  if (law.yields()) return refused("contacts that yield");
  if (law.is_adhesive()) return refused("adhesion");
  if (law.cohesion.is_on()) return refused("cohesion");
  if (law.rolling.is_on()) return refused("rolling resistance");
  if (law.twisting.is_on()) return refused("twisting resistance");
  if (law.has_heat()) return refused("heat");
  if (law.is_at_midpoint()) return refused("LIGGGHTS's friction");
  if (law.rescales()) return refused("a tangential spring that is rescaled");
  return "";
}

}    // namespace lsdcd
