// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/contact_law.h"

#include "law/force_parts.h"
#include "law/smallest_model.h"
#include "law/sub_models.h"

#include <cmath>
#include <cstdint>
#include <string>

namespace lsdcd {

bool ContactLaw::has_history() const
{
  if (reach().acts() || keeps_forces || keeps_touch) return true;
  for (const SubModel *row : rows_of(*this))
    if (row->stored.what) return true;
  return false;
}

int ContactLaw::n_extra() const
{
  int n = (for_shapes && has_history() ? 3 : 0) + (keeps_forces ? kKeptForces : 0) +
          (keeps_at_nodes ? kKeptAtNodes : 0) + (keeps_losses ? kKeptLosses : 0);
  for (const SubModel *row : rows_of(*this)) n += row->stored.beside_shear;
  return n;
}

unsigned ContactLaw::flips() const
{
  unsigned bits = has_history() ? 7 : 0;
  int at = 3;
  for (const bool vectors : {true, false})
    for (const SubModel *row : rows_of(*this)) {
      const int n = row->stored.beside_shear;
      if ((n == 3) != vectors) continue;
      if (row->stored.flips) bits |= ((1u << n) - 1) << at;
      at += n;
    }
  if (keeps_forces) bits |= KeptForces::flips() << at;
  return bits;
}

// FNV-1a, of 31 bits.
int ContactLaw::history_kind() const
{
  std::uint32_t hash = 2166136261u;
  const auto add = [&](const std::string &text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  };
  for (const SubModel *row : rows_of(*this))
    if (row->stored.what) add(row->stored.what + std::string(";"));
  if (for_shapes && has_history()) add("arm;");
  if (keeps_forces) add("forces;");
  if (keeps_at_nodes) add("nodes;");
  ContactLaw without_touch = *this;
  without_touch.keeps_touch = false;
  if (!without_touch.has_history() && keeps_touch) add("touch;");
  return static_cast<int>(hash >> 1);
}

ContactLaw classic_law(NormalModel normal, bool history)
{
  ContactLaw law;
  law.normal = normal;
  if (history) law.tangential = TangentialModel::linear_history_classic;
  return law;
}

ContactLaw granular_law(NormalModel normal)
{
  ContactLaw law;
  law.normal = normal;
  law.damping = DampingModel::viscoelastic;
  law.tangential = TangentialModel::linear_nohistory;
  return law;
}

LawReach ContactLaw::reach() const
{
  LawReach reach;
  if (reaches()) return reaching_cohesion(*this).reach();
  if (!is(NormalModel::jkr)) return reach;
  reach.of = LawReach::Of::held;
  reach.per_root = JkrNormal(modulus, surface_energy).pull_off;
  return reach;
}

Real tsuji_damping(Real e)
{
  const Real c[] = {4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728};
  Real sum = 0;
  for (Real each : c) sum = sum * e + each;
  return std::sqrt(Real(2)) * sum;
}

Real restitution_damping(NormalModel normal, Real e)
{
  const Real l = std::log(e);
  return -facts_of(normal).no_rebound * l / std::sqrt(kPi * kPi + l * l);
}

Real cutoff_of(const ContactLaw &law, Real radius)
{
  return cutoff_of(radius, law.reach());
}

}    // namespace lsdcd
