// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a step leaves behind of a near sphere apart from what its law computes: that it touches
// nothing, what its search may have missed, that its contacts do not fit.
#pragma once

#include "backend/atomic.h"
#include "engine/step/law_job.h"

namespace lsdcd {

// Sphere i feels the wall from as far as `cutoff`: an error where the grid does not go there.
LSDCD_FN void note_cutoff(const LawJob &job, std::size_t i, Real cutoff)
{
  if (cutoff > job.grid.cutoff) raise_to(&job.counts->too_large, kNoSphere - i);
}

LSDCD_FN void note_overlap(const LawJob &job, std::size_t i, Real ratio)
{
  if (ratio > 0)
    raise_to(&job.counts->deepest,
             std::uint64_t(ascending_bits(static_cast<float>(ratio))) << 32 | (i + 1));
}

// `uncertain`: overlap of the deepest contact that near sphere k may have beside those that were
// found. A ratio to its radius is kept, as radii may be elsewhere when it is read.
LSDCD_FN void keep_uncertain(const LawJob &job, std::size_t k, Real uncertain, Real radius)
{
  if (!job.uncertain) return;
  const Real ratio = uncertain / radius;
  job.uncertain[k] = ratio;
  if (!(ratio > 0)) return;
  count_one(&job.counts->uncertified);
  raise_to(&job.counts->uncertain, ascending_bits(static_cast<float>(ratio)));
}

// Near sphere k, which is sphere i, touches nothing. Few have springs to lose: the others' counts
// are not written.
LSDCD_FN void touches_nothing(const LawJob &job, std::size_t k, std::size_t i)
{
  job.result.n_contacts[k] = 0;
  int *n_springs = job.pool.count;
  if (n_springs && job.settings.update && n_springs[i] != 0) n_springs[i] = 0;
}

// There is no memory for the contacts of near sphere k, which is sphere i: an error, once the host
// looks. `counter`: what was used up. Until then the sphere has no springs, as its old ones are in
// the other pool.
LSDCD_FN void does_not_fit(const LawJob &job, std::size_t k, std::size_t i, int &counter)
{
  fetch_add(&counter, 1);
  touches_nothing(job, k, i);
}

// What counts of the next step begin with, which writes to the other pool where this one moves
// springs.
LSDCD_FN void clear_next(const LawJob &job)
{
  if (job.settings.update) job.counts->shared_used[1 - job.pool.which] = 0;
}

}    // namespace lsdcd
