// What a step leaves behind of a near sphere apart from what its law computes: that it
// touches nothing, what its search may have missed, that its contacts do not fit.
#pragma once

#include "parallel/atomic.h"
#include "engine/force/law_job.h"

namespace lsdcd {

// Sphere i feels the wall from as far as `reach`: an error where the grid does not go there.
LSDCD_FN void note_reach(const LawJob &job, std::size_t i, Real reach)
{
  if (job.in_place.counts && reach > job.grid.reach)
    raise_to(&job.in_place.counts->too_large, kNoSphere - i);
}

// Overlap of the deepest contact that near sphere k may have beside those that were found;
// a ratio to its radius where results stay, as radii may be elsewhere when they are read.
LSDCD_FN void keep_uncertain(const LawJob &job, std::size_t k, Real uncertain, Real radius)
{
  if (!job.uncertain.at) return;
  StepCounts *counts = job.in_place.counts;
  if (counts) uncertain /= radius;
  job.uncertain[k] = uncertain;
  if (!counts || !(uncertain > 0)) return;
  count_one(&counts->uncertified);
  raise_to(&counts->uncertain, ascending_bits(static_cast<float>(uncertain)));
}

// How many contacts result `at` is of; kOverflow: it has to be done again.
LSDCD_FN void put_count(const LawJob &job, std::size_t at, int n)
{
  if (job.in_place.counts)
    job.in_place.result.n_contacts[at] = n;
  else
    job.result[at].n_contacts = n;
}

// Sphere i touches nothing. Few have a spring to lose: the others' counts are not written.
LSDCD_FN void lose_springs(const LawJob &job, std::size_t i)
{
  int *n_springs = job.in_place.pool.count;
  if (n_springs && job.settings.update && n_springs[i] != 0) n_springs[i] = 0;
}

// There is no room for the contacts of result `at`: done again by the host, or an error.
LSDCD_FN void does_not_fit(const LawJob &job, std::size_t at)
{
  StepCounts *counts = job.in_place.counts;
  if (counts) fetch_add(&counts->lost, 1);
  put_count(job, at, counts ? 0 : kOverflow);
}

// The contacts of near sphere k, whose result is `at_result`, do not fit into a kernel's places:
// returns its place among the crowded ones, or -1 where it does not fit there either.
LSDCD_FN int put_off(const LawJob &job, std::size_t k, std::size_t at_result)
{
  const Crowd &crowd = job.in_place.crowd;
  const int at = job.in_place.counts ? fetch_add(&job.in_place.counts->n_crowded, 1) : 0;
  if (at < crowd.most) {
    crowd.which[at] = static_cast<int>(k);
    return at;
  }
  does_not_fit(job, at_result);
  return -1;
}

// What counts of one step begin with; those that the host looks at stay.
LSDCD_FN void clear_step(const InPlace &in_place)
{
  StepCounts &counts = *in_place.counts;
  counts.shared_used[in_place.pool.which] = counts.n_crowded = counts.crowd_used = 0;
}

}    // namespace lsdcd
