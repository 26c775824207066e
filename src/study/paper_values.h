// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of the paper (its Table 2 and the text to its figures 9 to 12), to stand beside
// ours. Tesla K40; 1e7 spheres unless another number is given.
#pragma once

#include "base/real.h"

#include <cstddef>

namespace lsdcd {

// Table 2. n: triangles per cell, 0 for all of them.
struct PaperAccuracy {
  Real length;
  int n;
  Real accuracy, seconds;
};
constexpr PaperAccuracy kPaperTable2[] = {
    {0.2, 1, 0.963049, 0.362065},  {0.3, 1, 0.963002, 0.367259},  {0.4, 1, 0.961837, 0.372562},
    {0.5, 1, 0.962520, 0.372499},  {0.2, 2, 0.993950, 0.564954},  {0.3, 2, 0.993887, 0.581134},
    {0.4, 2, 0.993887, 0.591163},  {0.5, 2, 0.993817, 0.595089},  {0.2, 3, 0.994015, 0.937022},
    {0.3, 3, 0.993997, 0.956412},  {0.4, 3, 0.993982, 0.970890},  {0.5, 3, 0.994011, 0.976490},
    {0.2, 0, 0.994025, 57.899280}, {0.3, 0, 0.994025, 58.054784}, {0.4, 0, 0.994025, 58.001506},
    {0.5, 0, 0.994025, 57.737152}};
// The accuracy with all triangles, whatever the cells; formula (7) is relative to it.
constexpr Real kPaperBest = 0.994025;

// Figure 9: N = 2, L = 0.2; times from the text. 0: only drawn.
struct PaperCount {
  std::size_t spheres;
  Real accuracy, seconds;
};
constexpr PaperCount kPaperFigure9[] = {
    {1000000, 0.994, 0}, {10000000, 0.994, 0.564}, {60000000, 0, 3.488030}};

// Figures 10 to 12: N = 2; the grid's time from the text, on both of its GPUs.
struct PaperLength {
  Real length, accuracy, build_seconds;
};
constexpr PaperLength kPaperFigure10[] = {{0.179, 0.993847, 0},
                                          {0.2, 0.993950, 0},
                                          {0.3, 0.993887, 0},
                                          {0.4, 0.993887, 0},
                                          {0.5, 0.993817, 9}};

}    // namespace lsdcd
