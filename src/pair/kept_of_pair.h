// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which of KeptForces a touching pair keeps for the energy balance of the next step, behind its springs. The spheres of a pair have the
// whole of their weight, and arms that follow from their radii; torques are 0 unless a law of the run rolls or twists.
#pragma once

#include "law/contact_law.h"
#include "law/force_parts.h"

#include <vector>

namespace lsdcd {

struct KeptOfPair {
  static constexpr int kForces = 10, kTorques = 10;    // numbers of each of the two parts

  int first = 0;    // of the numbers that a pair keeps
  int n = 0;        // kForces, or with torques also kTorques

  LSDCD_FN bool has_torques() const { return n > kForces; }

  template <class From>
  LSDCD_FN KeptForces read(const From &numbers) const
  {
    KeptForces kept = {};
    kept.weight = 1;
    int at = first;
    each_force(kept, [&](Real &number) { number = numbers[at++]; });
    if (has_torques()) each_torque(kept, [&](Real &number) { number = numbers[at++]; });
    return kept;
  }
  template <class To>
  LSDCD_FN void write(KeptForces kept, const To &numbers) const
  {
    int at = first;
    each_force(kept, [&](const Real &number) { numbers[at++] = number; });
    if (has_torques()) each_torque(kept, [&](const Real &number) { numbers[at++] = number; });
  }

  // Returns which of the numbers change sign if the spheres of a pair change places, from the first one on: the vectors.
  unsigned flips() const { return kVectors | (has_torques() ? kVectors << kForces : 0); }

 private:
  static constexpr unsigned kVectors = 0x3fu << 4;    // the last 6 of each part

  template <class Do>
  LSDCD_FN static void each_force(KeptForces &kept, const Do &with)
  {
    with(kept.held);
    with(kept.elastic);
    with(kept.damping);
    with(kept.k_friction);
    for (int k = 0; k < 3; k++) with(kept.friction[k]);
    for (int k = 0; k < 3; k++) with(kept.friction_spring[k]);
  }
  template <class Do>
  LSDCD_FN static void each_torque(KeptForces &kept, const Do &with)
  {
    with(kept.twisting);
    with(kept.twisting_spring);
    with(kept.k_rolling);
    with(kept.k_twisting);
    for (int k = 0; k < 3; k++) with(kept.rolling[k]);
    for (int k = 0; k < 3; k++) with(kept.rolling_spring[k]);
  }
};

// Returns how many numbers of KeptForces each pair keeps in a run with these laws.
inline int n_kept_of_pairs(const std::vector<ContactLaw> &laws)
{
  for (const ContactLaw &law : laws)
    if (law.rolling.is_on() || law.twisting.is_on())
      return KeptOfPair::kForces + KeptOfPair::kTorques;
  return KeptOfPair::kForces;
}

}    // namespace lsdcd
