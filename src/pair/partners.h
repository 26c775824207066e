// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What touching pairs keep, by grain and partner: used while the host's list is made anew, and while grains go to other processes
// or into files.
#pragma once

#include "base/kept_rows.h"
#include "base/vec3.h"
#include "pair/pair_job.h"

#include <cstddef>
#include <cstdint>
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

  LSDCD_FN int size() const { return image_at() + (by_image ? 3 : 0); }
  LSDCD_FN int row_size() const { return 1 + size(); }    // with the partner's name
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

// The partners of grain i, and the numbers of each of them, as grain i sees them. A row is the name of a partner, followed by its
// numbers.
class Partners : public KeptRows {
 public:
  using Name = std::int64_t;    // of a grain, the same on all processes; a row has it as a Real

  explicit Partners(const PartnerForm &form = {}) : KeptRows(form.row_size()), form_(form) {}
  const PartnerForm &form() const { return form_; }
  int width() const { return form_.width; }

  // Sets the form of the numbers of each partner: the numbers of the pair that are there stay, others are 0 or unknown.
  void set_form(const PartnerForm &form);
  // Forgets all partners; those to come have this form.
  void begin(const PartnerForm &form)
  {
    form_ = form;
    KeptRows::begin(form.row_size());
  }
  Name name(int i, int k) const { return static_cast<Name>(*row(i, k)); }
  void rename(int i, int k, Name name) { *row(i, k) = static_cast<Real>(name); }
  const Real *numbers(int i, int k) const { return row(i, k) + 1; }

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

  using KeptRows::pack;
  using KeptRows::packed_size;
  // Return the size of the partners of grain i, and pack them, with only the first `width` numbers of each pair.
  int packed_size(int i, int width) const
  {
    return 1 + (row_size() - form_.width + width) * count(i);
  }
  int pack(int i, Real *to, int width) const;
  // Returns whether pack() can have written these `size` numbers.
  bool is_sound(const Real *from, int size) const;

 private:
  PartnerForm form_;
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
  begin(form);
  std::vector<int> found(static_cast<std::size_t>(n), 0);
  for_pairs(list, history, [&](int i, int j, std::size_t) {
    if (i < n) found[i]++;
    if (j < n) found[j]++;
  });
  for (int i = 0; i < n; i++) {
    add(i, found[i]);
    found[i] = 0;
  }
  for_pairs(list, history, [&](int i, int j, std::size_t pair) {
    const auto put = [&](int grain, int partner, unsigned flip) {
      Real *to = row(grain, found[grain]++);
      *to++ = static_cast<Real>(grains.name(partner));
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
    int left = count(i);
    for (int place = 0; place < list.length[i] && left > 0; place++) {
      const int j = list.row[i][place] & list.mask;
      const Name other = grains.name(j);
      for (int p = 0; p < count(i); p++) {
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
