// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Copies of a large wall's records, for a step on a CPU. They lie side by side in the order of the
// lists that name them: the wall's own records are far apart in memory, and the CPU waits for each of
// them and for its page.
#pragma once

#include "backend/atomic.h"
#include "backend/bits.h"
#include "geometry/wall_records.h"

namespace lsdcd {

struct RecordCopies {
  // Copies of the first n records of a list, and the number for which there is space.
  struct Range {
    std::int32_t first;
    std::int16_t n, room;
  };

  FeatureRecord *records = nullptr;    // null: there are no copies
  Range *ranges = nullptr;             // of each list
  int *used = nullptr, capacity = 0;

  // Returns the copies from list k on.
  RecordCopies from(std::size_t k) const
  {
    RecordCopies c = *this;
    if (records) c.ranges += k;
    return c;
  }

  // Returns the copy of record i of list k; null if there is none.
  LSDCD_FN const FeatureRecord *of([[maybe_unused]] std::size_t k, [[maybe_unused]] int i) const
  {
#if !LSDCD_ON_GPU()
    if (records && i < ranges[k].n) return records + ranges[k].first + i;
#endif
    return nullptr;
  }

  // Copies the n records that list k names now; one list by one thread. If there is no space left,
  // the list has no copies, and the wall's own records are read.
  LSDCD_FN void put([[maybe_unused]] std::size_t k, [[maybe_unused]] const MeshFeaturesView &wall,
                    [[maybe_unused]] const FeatureCode *code, [[maybe_unused]] int n) const
  {
#if !LSDCD_ON_GPU()
    if (!records) return;
    Range &range = ranges[k];
    range.n = 0;
    if (n > range.room) {
      if (__atomic_load_n(used, __ATOMIC_RELAXED) > capacity - n) return;
      const int first = fetch_add(used, n);
      if (first > capacity - n) return;
      range = {first, 0, static_cast<std::int16_t>(n)};
    }
    for (int i = 0; i < n; i++) records[range.first + i] = record_of(wall, code[i]);
    range.n = static_cast<std::int16_t>(n);
#endif
  }
};

}    // namespace lsdcd
