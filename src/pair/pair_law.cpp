// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/compile_pair.h"
#include "pair/pair_lanes.h"

#include <algorithm>
#include <utility>

namespace lsdcd {

void PairHistory::grow(std::size_t n)
{
  const std::size_t room = std::max(2 * room_, n + kMoreLanes);
  std::unique_ptr<std::size_t[]> key(new std::size_t[room]);
  std::unique_ptr<Real[]> numbers(new Real[room * width_]);
  std::copy_n(key_.get(), size_, key.get());
  for (std::size_t k = 0; k < width_; k++)
    std::copy_n(numbers_.get() + k * room_, size_, numbers.get() + k * room);
  key_ = std::move(key);
  numbers_ = std::move(numbers);
  room_ = room;
}

std::size_t PairHistory::append(const std::size_t *keys, int n)
{
  const std::size_t first = size_, end = first + static_cast<std::size_t>(n);
  if (end + kMoreLanes > room_) grow(end);
  std::copy_n(keys, n, key_.get() + first);
  size_ = end;
  return first;
}

std::size_t PairHistory::find(std::size_t key) const
{
  const std::size_t *const begin = key_.get();
  const auto at = static_cast<std::size_t>(std::lower_bound(begin, begin + size_, key) - begin);
  return at < size_ && begin[at] == key ? at : size_;
}

namespace {

PairLaw law_without_books(const ContactLaw &law)
{
  if (law.is_classic()) return law.is_extended() ? added_pair(law) : classic_pair(law);
  if (law.reaches()) return reaching_pair(law);
  if (law.yields()) return plastic_pair(law);
  return law.is_extended() ? granular_added_pair(law) : granular_pair(law);
}

}    // namespace

PairLaw pair_law(const ContactLaw &law)
{
  ContactLaw forces = law;    // the same with energy balance as without
  forces.keeps_forces = false;
  PairLaw out = law_without_books(forces);
  if (law.keeps_forces) set_book(law, out);
  return out;
}

}    // namespace lsdcd
