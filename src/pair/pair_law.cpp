// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/compile_pair.h"
#include "pair/pair_kernel.h"

#include <algorithm>
#include <utility>

namespace lsdcd {

void PairMemory::grow(std::size_t n)
{
  const std::size_t room = std::max(2 * room_, size_ + n);
  std::unique_ptr<int[]> place(new int[room]);
  std::unique_ptr<Real[]> numbers(new Real[room * width_]);
  if (size_ > 0) {
    std::copy_n(place_.get(), size_, place.get());
    std::copy_n(numbers_.get(), size_ * width_, numbers.get());
  }
  place_ = std::move(place);
  numbers_ = std::move(numbers);
  room_ = room;
}

PairLaw pair_law(const ContactLaw &law)
{
  if (law.is_classic()) return law.is_extended() ? added_pair(law) : classic_pair(law);
  return law.is_extended() ? granular_added_pair(law) : granular_pair(law);
}

void run_pairs(const PairJob &job)
{
  const auto is_first = [&](const PairLaw &law) { return law.run == job.laws->run; };
  if (std::all_of(job.laws, job.laws + job.n_laws, is_first)) return job.laws->run(job);
  add_pairs(job, AnyLaw{job});
}

}    // namespace lsdcd
