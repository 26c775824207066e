// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The worked example of doc/design.md: a sub-model in a file of its own, which no file of
// src knows. Normal damping that saturates: gamma v0 v/(v0 + |v|), so that fast impacts
// lose a smaller share of their speed than slow ones.
#pragma once

#include "law/contact.h"

namespace lsdcd {

struct SaturatingDamping {
  Real gamma;    // 1/time
  Real v0;       // length/time

  LSDCD_FN Real force(const Contact &c, Real scale) const
  {
    return -scale * c.mass * gamma * v0 * c.v_normal / (v0 + fabs(c.v_normal));
  }
};

}    // namespace lsdcd
