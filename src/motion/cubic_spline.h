// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Slopes of cubic splines with continuous second derivatives, from the lengths of their pieces and the mean slope
// of each piece (C. de Boor, A Practical Guide to Splines, chapter IV).
#pragma once

#include "base/real.h"

#include <vector>

namespace lsdcd {

// Returns the n + 1 slopes of n pieces, at the ends of pieces. The first two pieces are one polynomial, and the last two
// ("not a knot"); two pieces alone are one parabola.
std::vector<Real> spline_slopes(const std::vector<Real> &length, const std::vector<Real> &mean);

// Returns the n slopes of n pieces after which all begins again, at the beginnings of pieces.
std::vector<Real> periodic_spline_slopes(std::vector<Real> length, std::vector<Real> mean);

}    // namespace lsdcd
