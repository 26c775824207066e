// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A vector in messages.
#pragma once

#include "base/input_words.h"
#include "base/vec3.h"

#include <string>

namespace lsdcd {

// "0.5 0 -1", six digits a number.
inline std::string vector_text(const Vec3 &a)
{
  return number_text(a.x) + " " + number_text(a.y) + " " + number_text(a.z);
}

}    // namespace lsdcd
