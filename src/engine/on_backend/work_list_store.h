// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory for the work lists of a step on a GPU, and for the general path of the step.
#pragma once

#include "backend/backend.h"
#include "engine/step/step_job.h"

#include <algorithm>

namespace lsdcd {

template <class B>
class WorkListStore {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Prepares for steps after a search that found n candidates, of which n_multi_mesh spheres are near more than one mesh.
  // `carries_over`: steps are over all of them, so that items with more than one contact stay listed from step to step.
  // `multi_contact`: for each, whether it seems to have more than one now; or null. `has_fast_path`: only items that the
  // fast path leaves take the general one. `seen`: the counts after the last step.
  void clear(B &b, std::size_t n, std::size_t n_multi_mesh, bool carries_over, bool has_fast_path,
             const char *multi_contact, StepCounts *counts, const StepCounts &seen)
  {
    const bool has_stepped = step_ > 0;
    carries_over_ = carries_over;
    step_ = 0;
    if (room_ < n) {
      room_ = with_spare(n);
      memory_ = Array<int>(4 * room_);
    }
    // Spheres on the general path share the memory of its threads. Few take that path if the wall is flat near them: once
    // steps were done, there is memory for twice as many as took it, and at least for those that a kernel always uses.
    std::size_t n_general = n;
    if (has_fast_path && has_stepped) {
      const std::size_t took = std::max(seen.n_found[0], seen.n_found[1]) +
                               std::max(seen.n_multi_contact[0], seen.n_multi_contact[1]);
      n_general = std::min(n, std::max(kFewGeneral, 2 * took));
    }
    const std::size_t need = general_bytes(n_general, n_multi_mesh);
    if (general_.size() < need || general_.size() / 4 > need) {
      general_ = Array<char>();    // free it before the new one is made
      general_ = Array<char>(general_bytes(with_spare(n_general), with_spare(n_multi_mesh)));
    }
    int *listed_in = column(3), *first = column(0);    // of the first step
    b.for_each(2, [=] LSDCD_LAMBDA(std::size_t k) {
      counts->n_found[k] = counts->n_multi_contact[k] = 0;
    });
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const bool is_multi_contact = multi_contact && multi_contact[k];
      listed_in[k] = is_multi_contact;
      if (is_multi_contact) first[fetch_add(counts->n_multi_contact, 1)] = static_cast<int>(k);
    });
  }

  // Returns the work lists of the next step.
  WorkLists next(StepCounts *counts)
  {
    WorkLists lists;
    const int turn = ++step_ % 2;
    lists.found = column(2);
    lists.n_found = counts->n_found + turn;
    lists.n_found_next = counts->n_found + 1 - turn;
    lists.memory = general_.data();
    lists.memory_bytes = general_.size();
    if (!carries_over_) return lists;
    lists.last = column(1 - turn);
    lists.n_last = counts->n_multi_contact + 1 - turn;
    lists.next = column(turn);
    lists.n_next = counts->n_multi_contact + turn;
    lists.listed_in = column(3);
    lists.step = step_;
    return lists;
  }

  std::size_t bytes() const { return memory_.size() * sizeof(int) + general_.size(); }

 private:
  static std::size_t general_bytes(std::size_t n, std::size_t n_multi_mesh)
  {
    const auto threads = [](std::size_t items) {    // in whole blocks
      return std::min(kMostGeneral, (items + kStepBlock - 1) / kStepBlock * kStepBlock);
    };
    return std::max(threads(n) * sizeof(GeneralMemory),
                    threads(n_multi_mesh) * sizeof(MultiMeshMemory));
  }
  int *column(int which) { return memory_.data() + which * room_; }

  bool carries_over_ = false;
  int step_ = 0;    // since the candidate search
  std::size_t room_ = 0;
  Array<int> memory_;
  Array<char> general_;    // of threads on the general path
};

}    // namespace lsdcd
