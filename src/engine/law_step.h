// The loop of a contact law over the spheres near the wall: one body for every backend.
#pragma once

#include "base/atomic.h"
#include "engine/compiled_law.h"

#include <cstdint>

namespace lsdcd {

// What the search for contacts reads of sphere i: most of those near the wall touch
// nothing, and what only a contact needs is left where it is.
template <class Law>
LSDCD_FN SphereState place_of(const LawJob &job, std::size_t i)
{
  SphereState s = {};
  s.x = job.x[i];
  s.radius = job.radius[i];
  if constexpr (Law::kHistory) {
    s.n_springs = job.springs.count[i];
    const std::size_t first = s.n_springs > 0 ? job.springs.first[i] : 0;
    s.springs = job.springs.pool + first;
    if constexpr (Law::kExtra > 0) s.extra = job.springs.extra + first * Law::kExtra;
  }
  return s;
}

template <class Law>
LSDCD_FN void add_motion(const LawJob &job, std::size_t i, SphereState &s)
{
  s.v = job.v[i];
  s.omega = job.omega[i];
  s.mass = job.mass[i];
  if constexpr (Law::kHeat) s.temperature = job.temperature[i];
}

// The places of near sphere k in the sink; what the law has no use for is not even set.
template <class Law>
LSDCD_FN SphereSink sink_of(const LawJob &job, std::size_t k)
{
  SphereSink sink = {};
  if constexpr (Law::kHistory) sink.springs = job.sink.springs + k * kPlaces;
  if constexpr (Law::kExtra > 0) sink.extra = job.sink.extra + k * kPlaces * Law::kExtra;
  if constexpr (Law::kHeat) sink.heat = job.sink.heat + k;
  if constexpr (Law::kRecords) sink.records = job.sink.records + k * kPlaces;
  return sink;
}

// The same in place, for n contacts that bear; false: no room.
template <class Law>
LSDCD_FN bool take_places(const LawJob &job, std::size_t k, int n, int &first, SphereSink &sink)
{
  const ContactPool &pool = job.in_place.pool;
  first = static_cast<int>(k) * pool.own;
  if constexpr (Law::kHeat) sink.heat = job.sink.heat + k;
  if constexpr (Law::kHistory || Law::kRecords) {
    if (n > pool.own) {
      first = pool.shared + fetch_add(&job.in_place.counts->shared_used[pool.which], n);
      if (first > pool.size - n) return false;
    }
    if constexpr (Law::kHistory) sink.springs = pool.springs + first;
    if constexpr (Law::kExtra > 0) sink.extra = pool.extra + std::size_t(first) * Law::kExtra;
    if constexpr (Law::kRecords) sink.records = pool.records + first;
  }
  return true;
}

LSDCD_FN int count_bearing(const ContactsView &set, const Real *weight)
{
  int n = 0;
  for (int i = 0; i < set.n; i++) n += weight[i] > 0;
  return n;
}

// What the host will want to know of the step.
LSDCD_FN void note(StepCounts &counts, const SphereResult &out, std::size_t i)
{
  if (out.uncertain > 0) {
    count_one(&counts.uncertified);
    raise_to(&counts.uncertain, ascending_bits(static_cast<float>(out.uncertain)));
  }
  if (out.overlap_ratio > 0)
    raise_to(&counts.deepest,
             std::uint64_t(ascending_bits(static_cast<float>(out.overlap_ratio))) << 32 | (i + 1));
}

// Result of near sphere k, which is sphere i: into the spheres' arrays, and kept with its
// torque about the origin and what it may have missed as a ratio, so that totals can be
// made when the spheres are elsewhere.
template <class Law>
LSDCD_FN void add_in_place(const LawJob &job, std::size_t k, std::size_t i, const SphereState &s,
                           int first, SphereResult &out)
{
  const InPlace &to = job.in_place;
  out.uncertain /= s.radius;
  note(*to.counts, out, i);
  if constexpr (Law::kHistory)
    if (job.settings.update) {
      if (out.n_contacts > 0) to.pool.first[i] = first;
      to.pool.count[i] = out.n_contacts;
    }
  if (out.n_contacts == 0) return;
  if constexpr (Law::kRecords) to.pool.place[k] = first;
  to.force.add(i, out.force);
  to.torque.add(i, out.torque);
  if constexpr (Law::kHeat) to.heat_flow[i] += job.sink.heat[k];
  out.torque = cross(s.x, out.force) + out.torque;
}

// A sphere that was not done in place: for the loop over crowded ones, or lost.
LSDCD_FN void put_off(const InPlace &in_place, std::size_t k, bool is_crowded)
{
  if (is_crowded) {
    const int at = fetch_add(&in_place.counts->n_crowded, 1);
    if (at < in_place.crowd.most) {
      in_place.crowd.which[at] = static_cast<int>(k);
      return;
    }
  }
  fetch_add(&in_place.counts->lost, 1);
}

// Near sphere k; `crowded` is its place among the crowded ones, or -1.
template <class Law>
LSDCD_FN void near_sphere(const Law &law, const LawJob &job, std::size_t k, int crowded)
{
  const InPlace &in_place = job.in_place;
  const bool stays = in_place.counts != nullptr;
  const std::size_t i = job.near ? job.near[k] : k;
  SphereState s = place_of<Law>(job, i);
  if (stays && law_reach(law, s.radius) > job.grid.reach)
    raise_to(&in_place.counts->too_large, kNoSphere - i);

  SphereResult out = {};
  Touch<kPlaces> touching;
  ContactsView set;
  const Real *weight = touching.weight;
  if (crowded < 0) {
    find_touch(job.grid, law, job.settings, s, touching, out);
    set = touching.set.view();
  } else {
    const Crowd &crowd = in_place.crowd;
    const int from = crowd.first[crowded];
    set = {crowd.n[crowded], crowd.feature + from, crowd.normal + from, crowd.distance + from};
    weight = crowd.weight + from;
    out.uncertain = crowd.uncertain[crowded];
    if (set.n < 0) out.n_contacts = kOverflow;
  }

  int first = 0;
  SphereSink sink = {};
  if (out.n_contacts != kOverflow && set.n > 0) {
    bool has_room = true;
    if (stays)
      has_room = take_places<Law>(job, k, count_bearing(set, weight), first, sink);
    else
      sink = sink_of<Law>(job, k);
    if constexpr (Law::kHeat) *sink.heat = 0;
    add_motion<Law>(job, i, s);
    if (has_room)
      add_contacts(job.grid, law, job.settings, s, set, weight, sink, out);
    else
      out.n_contacts = kOverflow;
  }
  if (stays) {
    if (out.n_contacts != kOverflow)
      add_in_place<Law>(job, k, i, s, first, out);
    else
      put_off(in_place, k, crowded < 0 && touching.set.overflow);
  }
  // Nothing else is read of a result without contacts.
  if (out.n_contacts == 0) {
    job.result[k].uncertain = out.uncertain;
    job.result[k].n_contacts = 0;
  } else {
    job.result[k] = out;
  }
}

template <class Law>
LSDCD_FN void law_step(const Law &law, const LawJob &job, std::size_t at)
{
  const InPlace &in_place = job.in_place;
  const bool crowd = in_place.crowd_lanes > 0;
  int end = 0;
  if (crowd)
    end = in_place.counts->n_crowded < in_place.crowd.most ? in_place.counts->n_crowded
                                                           : in_place.crowd.most;
  // One call, so that the law is compiled once: a near sphere, or a lane's crowded ones.
  for (int c = static_cast<int>(at); !crowd || c < end; c += in_place.crowd_lanes) {
    near_sphere(law, job, crowd ? in_place.crowd.which[c] : at, crowd ? c : -1);
    if (!crowd) break;
  }
}

template <class Law, class Backend>
void start_law(const LawBytes &bytes, const LawJob &job, std::size_t n, Backend &backend)
{
  const Law law = bytes.as<Law>();
  backend.for_each(
      n, [=] LSDCD_LAMBDA(std::size_t at) { law_step(law, job, at); }, 128);
}

}    // namespace lsdcd
