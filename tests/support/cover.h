// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How much of a contact's overlap another one covers, by the formula of doc/theory.md.
#pragma once

namespace lsdcd {

constexpr double kLessCovered = 1e-6;    // largest difference from the cosine

// `cosine`: between the two normals.
template <class T>
T cover_of(T cosine)
{
  if (cosine <= 0) return 0;
  const T u = 1 - cosine;
  return cosine * (1 - T(kLessCovered) * (100 * u / (1 + 100 * u)));
}

}    // namespace lsdcd
