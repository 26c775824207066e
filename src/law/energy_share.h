// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which of two grains takes how much of the energy with which they are pressed together.
#pragma once

#include "law/contact_law.h"

namespace lsdcd {

// Returns the share (0 to 1) of the energy of a contact that the grain of the first law takes, by the laws that grains of either type
// have among themselves. Two grains are two springs in a row: the softer one yields more, and of the energy each takes the share that the
// stiffness of the other one has in the sum of both. Where the normal models differ, so that their stiffnesses are of two kinds, and where
// contacts yield, each has half.
inline Real energy_share(const ContactLaw &own, const ContactLaw &other)
{
  if (own.normal != other.normal || !(own.k_normal > 0 && other.k_normal > 0)) return 0.5;
  return other.k_normal / (own.k_normal + other.k_normal);
}

}    // namespace lsdcd
