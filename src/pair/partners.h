// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What touching pairs keep, by grain and partner: used while the host's list is made anew, and while grains go to other processes
// or into files.
#pragma once

#include "base/vec3.h"
#include "pair/pair_job.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsdcd {

// The numbers of a partner: those of the pair, followed by those that decide whether a pair of a new list continues with them.
struct PartnerForm {
  int width = 0;    // numbers of the pair
  // One more number: ContactLaw::history_kind() of the law that keeps them. kUnknownLaw: it may be any law.
  bool by_law = false;
  // Three more numbers: the place of the grain less that of the partner, length, because a grain may touch several images of
  // another grain, or its own. All 0: it may have been any image.
  bool by_image = false;
  static constexpr Real kUnknownLaw = -1;

  LSDCD_FN int stride() const { return image_at() + (by_image ? 3 : 0); }
  LSDCD_FN int image_at() const { return width + (by_law ? 1 : 0); }

  // Returns whether these are the numbers of the pair with this offset. Images are more than twice `near` apart; 0: there is only
  // one image.
  LSDCD_FN bool is_image(const Real *numbers, const Vec3 &offset, Real near) const
  {
    const Real *const at = numbers + image_at();
    const Vec3 was = {at[0], at[1], at[2]};
    return !(near > 0) || norm_sq(was) == 0 || norm_sq(offset - was) < near * near;
  }
  // Returns whether a law of this kind may continue with these numbers.
  LSDCD_FN bool is_of_law(const Real *numbers, int kind) const
  {
    return !by_law || numbers[width] == kUnknownLaw || numbers[width] == kind;
  }
};

// The partners of grain i, and the numbers of each of them, as grain i sees them. The host may copy, pack, unpack and reset grains.
// In messages and files a grain has a count, and for each partner its name and its numbers.
class Partners {
 public:
  using Name = std::int64_t;    // of a grain, the same on all processes

  explicit Partners(const PartnerForm &form = {}) :
      form_(form), stride_(static_cast<std::size_t>(form.stride()))
  {
  }
  const PartnerForm &form() const { return form_; }
  int width() const { return form_.width; }

  void grow(int n_grains);    // keeps what is there; new grains have no partners
  // Sets the form of the numbers of each partner: the numbers of the pair that are there stay, others are 0 or unknown.
  void set_form(const PartnerForm &form);
  void copy(int from, int to) { first_[to] = first_[from], count_[to] = count_[from]; }
  void clear(int i) { count_[i] = 0; }
  // Replaces all partners by these: grain i has count[i] partners, beginning with first[i].
  void assign(const PartnerForm &form, std::vector<std::size_t> first, std::vector<int> count,
              std::vector<Name> name, std::vector<Real> numbers)
  {
    form_ = form;
    stride_ = static_cast<std::size_t>(form.stride());
    first_ = std::move(first);
    count_ = std::move(count);
    name_ = std::move(name);
    numbers_ = std::move(numbers);
  }
  int count(int i) const { return count_[i]; }
  Name name(int i, int k) const { return name_[first_[i] + k]; }
  void rename(int i, int k, Name name) { name_[first_[i] + k] = name; }
  const Real *numbers(int i, int k) const { return numbers_.data() + stride_ * (first_[i] + k); }

  // Takes over what the pairs of a list keep, for the first n grains, for both grains of each pair. `grains` has name(i), and for pairs
  //   flips(i, j)    the numbers that change sign if i and j change places, see ContactLaw::flips()
  //   kind(i, j)     the kind of the law that keeps them, see PartnerForm
  //   offset(i, j)   the place of i less that of j
  template <class Grains>
  void collect(const PairList &list, const PairHistory &history, int n, const PartnerForm &form,
               const Grains &grains);
  // Transfers what partners keep to the pairs of a new list. Pairs that are no longer in the list have parted. If the law is of
  // another kind, the first of_law numbers become 0. Returns whether any of these was not 0. `near`: see PartnerForm::is_image().
  template <class Grains>
  bool hand_out(const PairList &list, PairHistory &history, Real near, int of_law,
                const Grains &grains) const;

  int packed_size(int i) const { return packed_size(i, width()); }
  int pack(int i, Real *to) const { return pack(i, to, width()); }    // returns packed_size(i)
  // Do the same with the first `width` numbers of each pair.
  int packed_size(int i, int width) const
  {
    return 1 + (1 + width + form_.stride() - form_.width) * count_[i];
  }
  int pack(int i, Real *to, int width) const;
  int unpack(int i,
             const Real *from);    // replaces what it has; returns how many numbers were read
  int unpack_more(int i, const Real *from);    // adds to what it has
  int largest_packed_size() const;             // over all grains
  // Returns whether pack() can have written these `size` numbers.
  bool is_sound(const Real *from, int size) const;
  std::size_t bytes() const;

 private:
  void append(Name name, const Real *numbers);

  PartnerForm form_;
  std::size_t stride_;
  std::vector<std::size_t> first_;
  std::vector<int> count_;
  std::vector<Name> name_;
  std::vector<Real> numbers_;
};

// Calls act(i, j, number of the pair in the history) for the pairs of a list that are in the history.
template <class Act>
void for_pairs(const PairList &list, const PairHistory &history, const Act &act)
{
  std::size_t pair = 0, start = 0;
  for (int k = 0; k < list.rows; k++) {
    const int i = list.grain[k];
    const std::size_t end = start + static_cast<std::size_t>(list.length[i]);
    for (; pair < history.size() && history.key(pair) < end; pair++)
      act(i, list.row[i][history.key(pair) - start] & list.mask, pair);
    start = end;
  }
}

// Clears the first n numbers of a pair of the history. Returns whether any of them was not 0.
inline bool clear_pair(PairHistory &history, std::size_t pair, int n)
{
  bool any = false;
  for (int k = 0; k < n; k++) {
    Real &number = history.column(k)[pair];
    any = any || number != 0;
    number = 0;
  }
  return any;
}

template <class Grains>
void Partners::collect(const PairList &list, const PairHistory &history, int n,
                       const PartnerForm &form, const Grains &grains)
{
  form_ = form;
  stride_ = static_cast<std::size_t>(form.stride());
  for (int &count : count_) count = 0;
  for_pairs(list, history, [&](int i, int j, std::size_t) {
    if (i < n) count_[i]++;
    if (j < n) count_[j]++;
  });
  std::size_t all = 0;
  for (int i = 0; i < n; i++) {
    first_[i] = all;
    all += static_cast<std::size_t>(count_[i]);
    count_[i] = 0;
  }
  name_.resize(all);
  numbers_.resize(all * stride_);
  for_pairs(list, history, [&](int i, int j, std::size_t pair) {
    const auto put = [&](int grain, int partner, unsigned flip) {
      const std::size_t at = first_[grain] + static_cast<std::size_t>(count_[grain]++);
      name_[at] = grains.name(partner);
      Real *to = numbers_.data() + at * stride_;
      for (int k = 0; k < form.width; k++) {
        const Real a = history.column(k)[pair];
        *to++ = flip >> k & 1 ? -a : a;
      }
      if (form.by_law) *to++ = grains.kind(i, j);
      if (!form.by_image) return;
      const Vec3 offset = grains.offset(grain, partner);
      for (int k = 0; k < 3; k++) *to++ = offset[k];
    };
    if (i < n) put(i, j, 0);
    if (j < n) put(j, i, grains.flips(i, j));
  });
}

template <class Grains>
bool Partners::hand_out(const PairList &list, PairHistory &history, Real near, int of_law,
                        const Grains &grains) const
{
  history.begin(width());
  std::size_t start = 0;
  bool cleared = false;
  for (int k = 0; k < list.rows; k++) {
    const int i = list.grain[k];
    int left = count_[i];
    for (int place = 0; place < list.length[i] && left > 0; place++) {
      const int j = list.row[i][place] & list.mask;
      const Name other = grains.name(j);
      for (int p = 0; p < count_[i]; p++) {
        if (this->name(i, p) != other) continue;
        const Real *const kept = numbers(i, p);
        if (form_.by_image && !form_.is_image(kept, grains.offset(i, j), near)) continue;
        const std::size_t key = start + static_cast<std::size_t>(place),
                          pair = history.append(&key, 1);
        for (int m = 0; m < width(); m++) history.column(m)[pair] = kept[m];
        if (form_.by_law && !form_.is_of_law(kept, grains.kind(i, j)))
          cleared |= clear_pair(history, pair, of_law);
        left--;
        break;
      }
    }
    start += static_cast<std::size_t>(list.length[i]);
  }
  return cleared;
}

}    // namespace lsdcd
