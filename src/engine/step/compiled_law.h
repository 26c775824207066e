// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A compiled contact law: its numbers as bytes, and a function for the loop over spheres. So engines are compiled once, and each law
// adds only that loop.
#pragma once

#include "contact/feature_turn.h"
#include "engine/settings.h"
#include "law/contact_model.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

namespace lsdcd {

class LawBytes {
 public:
  LawBytes() = default;    // without a law
  template <class Law>
  explicit LawBytes(const Law &law)
  {
    static_assert(std::is_trivially_copyable<Law>::value && sizeof(Law) <= sizeof bytes_,
                  "laws are plain numbers");
    ::new (bytes_) Law(law);
  }
  template <class Law>
  const Law &as() const
  {
    return *std::launder(reinterpret_cast<const Law *>(bytes_));
  }
  // Returns the law in a kernel, which has no launder.
  template <class Law>
  LSDCD_FN const Law &in_kernel() const
  {
    return *reinterpret_cast<const Law *>(bytes_);
  }

 private:
  alignas(std::max_align_t) unsigned char bytes_[256];
};

// A law of a table.
struct LawEntry {
  LawBytes law;
  LawReach reach;    // see ContactLaw::reach()
};

// The laws by mesh and kind of sphere. If a wall has one law, all indices are 0.
struct LawsView {
  const LawEntry *entries = nullptr;
  int of_mesh = 0;    // number of entries of a mesh
  SphereKinds kind;

  LSDCD_FN const LawEntry &of(int mesh, int of_kind) const
  {
    return entries[mesh * of_mesh + of_kind];
  }
};

// The effects that a kernel has.
struct WallEffects {
  // Spheres are transformed to the frame of a mesh, which moves, or is one of several, or has a surface that moves.
  bool posed;
  bool contacts, nodes;    // contacts are kept; nodes of a mesh move
  bool records = false;    // EnergyRecord is written, of impacts and of what is dissipated
  bool losses = false;     // see ContactLaw::keeps_losses; with records
};

// Says whether a law is for grains that may be no spheres (shape_law.h).
template <class Law>
struct IsShapeLaw : std::false_type {
};

// The number that a law with energy balance and records has in addition to its sub-models.
template <bool kLosses_>
struct LossesOnWall {
  static constexpr bool kLosses = false;
};
template <>
struct LossesOnWall<true> {
  static constexpr bool kLosses = true;
  bool keeps_losses;    // see ContactLaw
};

// The number that a law with energy balance has where the nodes of a mesh may move.
template <bool kKeptAtNodes_>
struct EnergyAtNodes {
  static constexpr bool kMayKeepAtNodes = false;
};
template <>
struct EnergyAtNodes<true> {
  static constexpr bool kMayKeepAtNodes = true;
  bool keeps_at_nodes;    // see ContactLaw
};

// kNodes: the nodes of a mesh may move. kEnergy: the law records what contacts do with energy, and keeps KeptForces of each contact.
// kRecords: it writes an EnergyRecord when one is due.
template <class Law, bool kPosed_, bool kKeepsContacts_, bool kNodes_ = false,
          bool kEnergy_ = false, bool kRecords_ = false>
struct OnWall : Law, LossesOnWall<kEnergy_ && kRecords_>, EnergyAtNodes<kEnergy_ && kNodes_> {
  static constexpr bool kPosed = kPosed_, kKeepsContacts = kKeepsContacts_, kNodes = kNodes_,
                        kEnergy = kEnergy_, kRecords = kRecords_;
  static constexpr bool kShapes = IsShapeLaw<Law>::value;
  // Whether a contact stores numbers in addition to its shear displacement; see n_stored().
  static constexpr bool kStoresExtra = Law::kExtra > 0 || kEnergy;
  // A setup stores what contacts keep, but does not move their springs.
  static constexpr bool kSetsUp = kEnergy || kRecords;
};

// Returns how many numbers of a contact engines store in addition to its shear displacement: those of the law, then KeptForces,
// KeptAtNodes and KeptLosses.
template <class Law>
LSDCD_FN int n_stored(const Law &law)
{
  int n = n_extra(law) + (Law::kEnergy ? kKeptForces : 0);
  if constexpr (Law::kMayKeepAtNodes) n += law.keeps_at_nodes ? kKeptAtNodes : 0;
  if constexpr (Law::kLosses) n += law.keeps_losses ? kKeptLosses : 0;
  return n;
}

// The kernels of a law, by their effects. plain: {none}. moving_or_both: {moving}, {moving + contacts}. plain_or_both: {none},
// {moving + contacts}. A wall that has only contacts takes {moving + contacts}. For each of these there is also {moving + contacts +
// nodes}, so that walls whose nodes do not move have no instruction for them. energy: {moving + contacts + energy}; energy_records:
// the same with records; impacts: {moving + contacts + records}; each with nodes, and on a GPU also without.
enum class WallKernels { plain, moving_or_both, plain_or_both, energy, energy_records, impacts };

// Calls make(law) with the form of a law that books energy, has records, or both. kForNodes: walls whose nodes do not move take the form
// in which they may, too, so that the compiler makes one form of each law and not two.
template <bool kEnergy, bool kRecords, bool kForNodes, class Law, class Make>
auto on_wall_with_books(const Law &law, const WallEffects &effects, const Make &make)
{
  const auto make_form = [&](auto nodes) {
    using Form = OnWall<Law, true, true, decltype(nodes)::value, kEnergy, kRecords>;
    Form form = {law, {}, {}};
    if constexpr (Form::kLosses) form.keeps_losses = effects.losses;
    if constexpr (Form::kMayKeepAtNodes) form.keeps_at_nodes = effects.nodes;
    return make(form);
  };
  if constexpr (!kForNodes)
    if (!effects.nodes) return make_form(std::false_type());
  return make_form(std::true_type());
}

// Calls make(law) with the form of the law that has these effects. On a CPU one form with books or records serves walls whose nodes move
// and others: see on_wall_with_books(). On a GPU, where each number that a kernel holds takes a register, there are two.
template <WallKernels kernels, bool kOnCpu, class Law, class Make>
auto on_wall(const Law &law, const WallEffects &effects, const Make &make)
{
  if constexpr (kernels == WallKernels::plain) return make(OnWall<Law, false, false>{law, {}, {}});
  if constexpr (kernels == WallKernels::energy)
    return on_wall_with_books<true, false, kOnCpu>(law, effects, make);
  if constexpr (kernels == WallKernels::energy_records)
    return on_wall_with_books<true, true, kOnCpu>(law, effects, make);
  if constexpr (kernels == WallKernels::impacts)
    return on_wall_with_books<false, true, kOnCpu>(law, effects, make);
  if constexpr (kernels == WallKernels::moving_or_both)
    if (!effects.contacts) return make(OnWall<Law, true, false>{law, {}, {}});
  if constexpr (kernels == WallKernels::plain_or_both)
    if (!effects.contacts && !effects.posed) return make(OnWall<Law, false, false>{law, {}, {}});
  if constexpr (kernels == WallKernels::moving_or_both || kernels == WallKernels::plain_or_both)
    return effects.nodes ? make(OnWall<Law, true, true, true>{law, {}, {}})
                         : make(OnWall<Law, true, true>{law, {}, {}});
}

struct StepJob;

// The numbers that engines store and move for a law.
struct LawTraits {
  bool history, heat, contacts, energy, records;
  bool losses;     // does a contact keep KeptLosses, behind all other numbers?
  bool sets_up;    // does a setup store what contacts keep?
  // n_vectors, at most kMostVectors: how many vectors, of three numbers each, the extra numbers begin with.
  int n_extra, n_vectors;
};

template <class Law>
LawTraits traits_of(const Law &law)
{
  bool heat = false, losses = false;
  if constexpr (Law::kHeat) heat = law.has_heat();
  if constexpr (Law::kLosses) losses = law.keeps_losses;
  static_assert(Law::kVectors <= kMostVectors, "springs are turned with all of them");
  int n_vectors = 0;
  if constexpr (Law::kVectors > 0)
    for (int k = 0; k < Law::kVectors; k++) n_vectors += law.stores(k);
  return {Law::kHistory, heat,         Law::kKeepsContacts, Law::kEnergy, Law::kRecords,
          losses,        Law::kSetsUp, n_stored(law),       n_vectors};
}

// A law compiled for one backend; run() does the step of n candidates, see run_compiled_law().
template <class Backend>
struct CompiledLaw {
  LawTraits traits;
  std::vector<LawBytes> laws;    // of LawTable::laws
  void (*run)(const LawBytes &, const StepJob &, std::size_t n, Backend &);
};

// Returns the wall's effects that the settings ask for.
inline WallEffects wall_effects(const EngineSettings &s)
{
  return {s.surface.moves() || s.moves || uses_slots(s), s.contacts || s.bodies || s.nodes, s.nodes,
          s.records_energy(), s.law().keeps_losses};
}

}    // namespace lsdcd
