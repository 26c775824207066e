// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The laws of pairs in lanes: a processor computes as many lanes at once as its vectors hold. The compiler vectorises the laws as
// they are written for one contact, so that a pair gets the same bits in both ways. It can do so if every decision is one between
// two numbers. A decision by the law's own numbers would be a branch; therefore it is read from arrays in which all lanes have the
// same value.
#pragma once

#include "law/contact_model.h"
#include "pair/pair_kernel.h"
#include "pair/pair_lanes.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

// The loops that GCC vectorises.
#if defined(__GNUC__) && !defined(__clang__)
#define LSDCD_WIDE_PAIRS
#endif

namespace lsdcd {

// Computes the pair of a lane.
template <class Law>
LSDCD_FN void evaluate_lane(const Law &law, PairLanes &lanes, int k, Real dt, bool update)
{
  GrainPair p = {};
  p.offset = lane_vec(lanes.offset, k);
  p.velocity = lane_vec(lanes.velocity, k);
  p.omega_i = lane_vec(lanes.omega_i, k);
  p.omega_j = lane_vec(lanes.omega_j, k);
  p.distance_sq = norm_sq(p.offset);
  p.radius_i = lanes.radius_i[k];
  p.radius_j = lanes.radius_j[k];
  p.mass_i = lanes.mass_i[k];
  p.mass_j = lanes.mass_j[k];
  p.mass = lanes.mass[k];
  if constexpr (Law::kHeat) p.temperature_difference = lanes.temperature_difference[k];
  p.dt = dt;
  p.update = update;

  static_assert(3 + Law::kExtra <= kLaneNumbers, "lanes have room for what a law keeps");
  ContactMemory<Law::kExtra> memory = {};
  if constexpr (Law::kHistory)
    memory.shear = {lanes.before[0][k], lanes.before[1][k], lanes.before[2][k]};
  if constexpr (Law::kHistory && Law::kExtra > 0)
    for (int m = 0; m < Law::kExtra; m++) memory.extra[m] = lanes.before[3 + m][k];
  PairForce f;
  evaluate_pair(law, p, memory, f);
  // In a setup the limits of friction cut forces, but springs stay as they are.
  if constexpr (Law::kHistory)
    for (int m = 0; m < 3; m++) lanes.after[m][k] = update ? memory.shear[m] : lanes.before[m][k];
  if constexpr (Law::kHistory && Law::kExtra > 0)
    for (int m = 0; m < Law::kExtra; m++)
      lanes.after[3 + m][k] = update ? memory.extra[m] : lanes.before[3 + m][k];

  set_lane(lanes.force, k, f.force());
  set_lane(lanes.torque_i, k, f.torque_i());
  set_lane(lanes.torque_j, k, f.torque_j());
  if constexpr (Law::kHeat) lanes.heat[k] = f.heat;
  lanes.energy[k] = f.energy;
}

template <class Law>
void evaluate_lanes(const LawBytes &bytes, PairLanes &lanes, int n, Real dt, bool update)
{
  const Law law = bytes.as<Law>();
  for (int k = 0; k < n; k++) evaluate_lane(law, lanes, k, dt, update);
}

#if defined(LSDCD_WIDE_PAIRS)
// Call act(choice) for each option of a law: a bool or an enumerator.
template <class Normal, class Damping, class Tangential, class Act>
void each_choice(ContactModel<Normal, Damping, Tangential> &law, const Act &act)
{
  act(law.limit_damping);
}
template <class Base, bool kHistory, class Act>
void each_choice(AddedModel<Base, kHistory> &law, const Act &act)
{
  each_choice(law.base, act);
  act(law.rolling.model);
}
template <class Normal, bool kHistory, GranularSet kSet, class Act>
void each_choice(GranularModel<Normal, kHistory, kSet> &law, const Act &act)
{
  act(law.elastic.model);
  act(law.damping.model);
  act(law.rolling.model);
  act(law.twisting.model);
  act(law.conduction.model);
  act(law.tangential.spring);
  act(law.tangential.by_radius);
  act(law.tangential.of_force);
  act(law.tangential.rescale);
  act(law.tangential.slip);
  act(law.tangential.at_midpoint);
  act(law.uses_contact_radius);
  act(law.limit_damping);
}

template <class Law>
void prepare_lanes(const LawBytes &bytes, PairLanes &lanes)
{
  Law law = bytes.as<Law>();
  int at = 0;
  each_choice(law, [&](auto choice) {
    for (std::int64_t &lane : lanes.choice[at]) lane = static_cast<std::int64_t>(choice);
    at++;
  });
}

// Returns the options of a law in one number.
template <class Law>
std::uint64_t choices_of(const Law &given)
{
  constexpr int kBits = 4;
  static_assert(kBits * kLaneChoices <= 64, "a number has room for all choices");
  Law law = given;
  std::uint64_t choices = 0;
  each_choice(
      law, [&](auto choice) { choices = choices << kBits | static_cast<std::uint64_t>(choice); });
  return choices;
}

// The options for which a loop is compiled: fix() makes constants of them. The usual options of `granular` leave out roots and
// divisions of sub-models that few laws have.
struct AnyChoice {
  template <class Law>
  static void fix(Law &)
  {
  }
};
template <DampingModel damping>
struct UsualChoice {
  template <class Law>
  static void fix(Law &law)
  {
    law.damping.model = damping;
    law.elastic.model =
        law.elastic.model == NormalModel::hooke ? NormalModel::hooke : NormalModel::hertz;
    law.tangential.spring = true;
    law.tangential.of_force = law.tangential.slip = law.tangential.rescale = false;
    law.limit_damping = false;
    law.conduction.model = HeatModel::none;
  }
};
// The options of LIGGGHTS's friction.
template <RollingModel rolling>
struct RollingChoice {
  template <class Base, bool kHistory>
  static void fix(AddedModel<Base, kHistory> &law)
  {
    law.rolling.model = rolling;
  }
  template <class Normal>
  static void fix(GranularModel<Normal, true, GranularSet::all> &law)
  {
    UsualChoice<DampingModel::stiffness>::fix(law);
    law.rolling.model = rolling;
    law.tangential.at_midpoint = true;
    law.twisting.model = TwistingModel::none;
  }
};

// Returns whether a law has these options, so that fix() changes none of them.
template <class Choice, class Law>
bool fits(const Law &law)
{
  Law fixed = law;
  Choice::fix(fixed);
  return choices_of(fixed) == choices_of(law);
}

// Computes the pair of a lane with the options of the lane.
template <class Choice, class Law>
inline void evaluate_chosen(const Law &given, PairLanes &lanes, int k, Real dt)
{
  Law law = given;
  int at = 0;
  each_choice(law, [&](auto &choice) {
    choice = static_cast<std::decay_t<decltype(choice)>>(lanes.choice[at++][k]);
  });
  Choice::fix(law);
  evaluate_lane(law, lanes, k, dt, true);
}

template <class Law, class Choice>
inline void evaluate_all(const LawBytes &bytes, PairLanes &lanes, int n, Real dt)
{
  const Law law = bytes.as<Law>();
  const int whole = (n + kMoreLanes) / (kMoreLanes + 1) * (kMoreLanes + 1);
#pragma omp simd
  for (int k = 0; k < whole; k++) evaluate_chosen<Choice>(law, lanes, k, dt);
}
#if defined(__x86_64__)
template <class Law, class Choice>
[[gnu::target("avx2"), gnu::flatten]] void evaluate_avx2(const LawBytes &bytes, PairLanes &lanes,
                                                         int n, Real dt)
{
  evaluate_all<Law, Choice>(bytes, lanes, n, dt);
}
template <class Law, class Choice>
[[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=512"), gnu::flatten]] void
evaluate_avx512(const LawBytes &bytes, PairLanes &lanes, int n, Real dt)
{
  evaluate_all<Law, Choice>(bytes, lanes, n, dt);
}
#else
template <class Law, class Choice>
[[gnu::flatten]] void evaluate_wide(const LawBytes &bytes, PairLanes &lanes, int n, Real dt)
{
  evaluate_all<Law, Choice>(bytes, lanes, n, dt);
}
#endif

// Returns the loop for the widest vectors that the processor has; null if these are too short.
template <class Law, class Choice>
auto widest_loop() -> decltype(PairLaw::evaluate_wide)
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return evaluate_avx512<Law, Choice>;
  return __builtin_cpu_supports("avx2") ? evaluate_avx2<Law, Choice> : nullptr;
#else
  return evaluate_wide<Law, Choice>;
#endif
}
// Selects the loop of the first options that fit.
template <class First, class... More, class Law>
void set_wide(const Law &law, PairLaw &out)
{
  if (fits<First>(law))
    out.evaluate_wide = widest_loop<Law, First>();
  else if constexpr (sizeof...(More) > 0)
    set_wide<More...>(law, out);
}
template <class Law>
void set_wide_of(const Law &law, PairLaw &out)
{
  set_wide<AnyChoice>(law, out);
}
template <class Normal, GranularSet kSet>
void set_wide_of(const GranularModel<Normal, true, kSet> &law, PairLaw &out)
{
  set_wide<UsualChoice<DampingModel::stiffness>, UsualChoice<DampingModel::viscoelastic>,
           AnyChoice>(law, out);
}
template <class Normal>
void set_wide_of(const GranularModel<Normal, true, GranularSet::midpoint> &law, PairLaw &out)
{
  set_wide<UsualChoice<DampingModel::stiffness>, AnyChoice>(law, out);
}
template <class Law>
void set_wide_of_liggghts(const Law &law, PairLaw &out)
{
  set_wide<RollingChoice<RollingModel::none>, RollingChoice<RollingModel::cdt>,
           RollingChoice<RollingModel::epsd2>, RollingChoice<RollingModel::epsd>, AnyChoice>(law,
                                                                                             out);
}
template <class Base, bool kHistory>
void set_wide_of(const AddedModel<Base, kHistory> &law, PairLaw &out)
{
  set_wide_of_liggghts(law, out);
}
template <class Normal>
void set_wide_of(const GranularModel<Normal, true, GranularSet::all> &law, PairLaw &out)
{
  set_wide_of_liggghts(law, out);
}
#endif

template <class Law>
bool evaluate_one(const LawBytes &bytes, const GrainPair &p, bool touched, const Real *old,
                  Real *kept, PairForce &out)
{
  const Law &law = bytes.as<Law>();
  if (!pair_touches(law, p, touched)) return false;
  evaluate_pair(law, p, old, kept, out);
  return true;
}

template <class Law>
PairLaw compiled_pair(const Law &law, const LawReach &reach)
{
  PairLaw out = {
      LawBytes(law), reach, false, 0,      evaluate_one<Law>, evaluate_lanes<Law>, nullptr,
      nullptr,       0,     {},    nullptr};
  if constexpr (Law::kHeat) out.has_heat = law.has_heat();
  if constexpr (Law::kHistory) out.stored = stored_numbers(law);
#if defined(LSDCD_WIDE_PAIRS)
  // Others find their contact radius by iteration, or have a branch for each model that yields.
  if constexpr (!Law::kBeyondContact && !Law::kYields) {
    set_wide_of(law, out);
    out.prepare = prepare_lanes<Law>;
    out.choices = choices_of(law);
  }
#endif
  return out;
}

}    // namespace lsdcd
