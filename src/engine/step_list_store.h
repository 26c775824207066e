// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory for the lists that the kernels of a step on a GPU hand on.
#pragma once

#include "engine/step/law_job.h"

namespace lsdcd {

template <class B>
class StepListStore {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // After a choice of n near spheres. `keeps`: steps are over all of them, so that those with several
  // contacts are kept from step to step. `several`: of each, does it seem to have them now? Or null.
  void clear(B &b, std::size_t n, bool keeps, const char *several, StepCounts *counts)
  {
    if (B::kOnHost) return;
    keeps_ = keeps;
    step_ = 0;
    if (room_ < n) {
      room_ = n + n / 8;
      memory_ = Array<int>(4 * room_);
    }
    int *listed_in = column(3), *first = column(0);    // of the first step
    b.for_each(2,
               [=] LSDCD_LAMBDA(std::size_t k) { counts->n_found[k] = counts->n_several[k] = 0; });
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const bool has_several = several && several[k];
      listed_in[k] = has_several;
      if (has_several) first[fetch_add(counts->n_several, 1)] = static_cast<int>(k);
    });
  }

  // Of the next step.
  StepLists next(StepCounts *counts)
  {
    StepLists lists;
    if (B::kOnHost) return lists;
    const int turn = ++step_ % 2;
    lists.found = column(2);
    lists.n_found = counts->n_found + turn;
    lists.n_found_next = counts->n_found + 1 - turn;
    if (!keeps_) return lists;
    lists.last = column(1 - turn);
    lists.n_last = counts->n_several + 1 - turn;
    lists.next = column(turn);
    lists.n_next = counts->n_several + turn;
    lists.listed_in = column(3);
    lists.step = step_;
    return lists;
  }

  std::size_t bytes() const { return memory_.size() * sizeof(int); }

 private:
  int *column(int which) { return memory_.data() + which * room_; }

  bool keeps_ = false;
  int step_ = 0;    // since the choice
  std::size_t room_ = 0;
  Array<int> memory_;
};

}    // namespace lsdcd
