// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The data of an insertion in a restart file.
#pragma once

#include "base/state_blocks.h"
#include "insert/feed_schedule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// How many positions were refused, by the reason.
struct Refused {
  std::int64_t no_place = 0, grains = 0, walls = 0;

  std::int64_t all() const { return no_place + grains + walls; }
  void add(const Refused &more);
};

// Steps are counted from the step of the file.
struct InsertionState {
  struct Plan {
    // Numbers of amounts and grains, beginning with the kind of the feed.
    std::vector<Real> numbers;
    Real given = 0;    // mass or number
  };
  struct Grains {
    GrainTotals inserted, drawn, not_drawn;
    std::int64_t next_number = 0;
    std::int64_t wait = 1, retry_in = 0;    // steps, for owed grains
    std::vector<std::int64_t> owed;         // their numbers
  };
  Plan plan;
  FeedState schedule;
  Grains grains;
  Refused refused;
  std::int64_t last_id = 0, last_molecule = 0;    // 0: none was given

  State blocks() const;
  // Throws StateError.
  static InsertionState from(const Real *numbers, std::size_t n);
};

}    // namespace lsdcd
