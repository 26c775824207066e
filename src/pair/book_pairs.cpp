// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/booked_law.h"
#include "pair/compile_pair.h"
#include "pair/pair_energy.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace lsdcd {

void set_book(const ContactLaw &law, PairLaw &out)
{
  with_booked_law(law, [&](const auto &model) {
    using Law = std::decay_t<decltype(model)>;
    out.booked = LawBytes(model);
    out.book = [](const LawBytes &bytes, const GrainPair &p, const PairNumbers<Real> &old,
                  const PairNumbers<Real> &now, const KeptOfPair &place, EnergyRows &rows) {
      const Law &of_pair = bytes.as<Law>();
      if (!!old) book_old_pair(of_pair, p, old, place, !!now, rows);
      if (!!now)
        book_new_pair(
            of_pair, [&p] { return p; }, old, now, place, rows);
    };
  });
}

void book_pairs(const PairJob &job)
{
  const PairHistory &before = *job.old, &now = *job.history;
  const PairList &list = job.list;
  std::size_t start = 0, old = 0, pair = 0;
  for (int k = 0; k < list.rows; k++) {
    const int i = list.grain[k];
    const std::size_t end = start + static_cast<std::size_t>(list.length[i]);
    for (;;) {
      const std::size_t old_key = old < before.size() ? before.key(old) : end,
                        now_key = pair < now.size() ? now.key(pair) : end,
                        key = std::min(old_key, now_key);
      if (key >= end) break;
      const bool touched = old_key == key, touches = now_key == key;
      const int other = list.row[i][key - start], j = other & list.mask;
      const PairLaw &law = job.laws[job.law_of[job.type[i] * job.n_types + job.type[j]]];
      EnergyRows rows;
      law.book(law.booked, grain_pair(job, i, j, job.update),
               touched ? before.of(old) : PairNumbers<Real>{nullptr, 0},
               touches ? now.of(pair) : PairNumbers<Real>{nullptr, 0}, job.kept, rows);
      const Real share =
          (job.both_sides || j < job.n_own ? 1 : 0.5) * job.factor[other >> list.factor_shift & 3];
      for (int row = 0; row < kEnergyRows; row++) job.energy->of[row] += share * rows.of[row];
      old += touched;
      pair += touches;
    }
    start = end;
  }
}

}    // namespace lsdcd
