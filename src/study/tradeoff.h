// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Accuracy and cost of each setting of a wall, for one mesh.
#pragma once

#include "mesh/welded_mesh.h"
#include "study/sample_timer.h"
#include "study/wall_answers.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

struct TradeoffSettings {
  std::vector<Real> radii;    // each as likely; the grid's cutoff is the largest
  std::size_t memory_budget = std::size_t(1) << 30;    // bytes of a grid
  int spheres = 20000;     // spheres for errors and times; 50 times as many for times on a GPU
  int moving = 32;         // bouncing, and rolling
  int repeats = 5;         // of what is timed
  double seconds = 120;    // seconds after which no more settings are tried
  bool cpu = true, cuda = false;
  std::uint64_t seed = 1;
};

// Values of the keywords `grid` and `nearest`.
struct GridOptions {
  Real length;    // of a cell
  int nearest;    // 0: complete lists
};

struct TradeoffRow {
  GridOptions choice;
  Corner corner;
  bool on_cuda;
  std::string device;
  AnswerError error;    // against complete lists with the same corner rule
  Real bounce_drift, roll_drift;
  Spread
      search;    // of the cells' lists, with nothing kept between steps; the same with both corner rules
  StepTimes
      times;    // of steps: with complete lists they keep lists of spheres, with nearest N they search cells
  std::size_t bytes;       // of the grid
  int checked, spheres;    // for errors, and timed
  bool is_default = false;
  bool on_front = false;    // no setting on the same device is as good in one of mean force
                            // error and least time of a step, and better in the other
};

struct Tradeoff {
  std::vector<TradeoffRow> rows;
  std::vector<std::string> left_out;    // in words
};

// The lists that are tried for each cell length, the complete ones first.
constexpr int kTriedNearest[] = {0, 1, 2, 3, 4, 8};

// Cells of half to four times the default length, all lists, both corner rules, each device: spheres
// in the order in which LAMMPS sorts them, uniform in the band within the cutoff, the same for all settings and devices.
// Hooke with springs, at rest for errors. The default comes first. Errors and drifts are computed once, on the CPU:
// those of a GPU are the same bits.
Tradeoff measure_tradeoff(const WeldedMesh &mesh, const TradeoffSettings &settings,
                          const std::function<void(const TradeoffRow &)> &progress);

void mark_front(std::vector<TradeoffRow> &rows);

// "all" or N; "grid 0.4 nearest all".
std::string nearest_word(const GridOptions &choice);
std::string words_of(const GridOptions &choice);

// Returns the fastest row of one device with corner blend, with missed contacts / contacts and the largest error of a
// force below `bound`, and with all answers certified: otherwise the next sphere may miss a contact. Rows within a tenth
// of the fastest differ by noise, so the one of these with the smallest error is returned. Null: there is none.
const TradeoffRow *fastest_below(const std::vector<TradeoffRow> &rows, Real bound, bool on_cuda);

}    // namespace lsdcd
