// The loop of a contact law over the spheres near the wall: one body for every backend,
// whether it finds their contacts as it goes or they were found before.
#pragma once

#include "engine/compiled_law.h"
#include "engine/found_contacts.h"
#include "engine/step_notes.h"

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
  if (!weight) return set.n;
  int n = 0;
  for (int i = 0; i < set.n; i++) n += weight[i] > 0;
  return n;
}

// Result of near sphere k, which is sphere i: into the spheres' arrays, and kept with its
// torque about the origin, so that totals can be made when the spheres are elsewhere.
template <class Law>
LSDCD_FN void add_in_place(const LawJob &job, std::size_t k, std::size_t i, const SphereState &s,
                           int first, SphereResult &out)
{
  const InPlace &to = job.in_place;
  if (out.overlap_ratio > 0)
    raise_to(&to.counts->deepest,
             std::uint64_t(ascending_bits(static_cast<float>(out.overlap_ratio))) << 32 | (i + 1));
  if constexpr (Law::kHistory)
    if (job.settings.update) {
      if (out.n_contacts > 0) to.pool.first[i] = first;
      to.pool.count[i] = out.n_contacts;
    }
  if (out.n_contacts == 0) return;
  if constexpr (Law::kRecords) to.pool.place[k] = first;
  // All are read before one is written: the compiler does not know that they are apart.
  const Vec3 force = to.force[i] + out.force, torque = to.torque[i] + out.torque;
  to.force.put(i, force);
  to.torque.put(i, torque);
  if constexpr (Law::kHeat) to.heat_flow[i] += job.sink.heat[k];
  out.torque = cross(s.x, out.force) + out.torque;
}

// What its contacts do to near sphere k, which is sphere i.
template <class Law>
LSDCD_FN void bear(const Law &law, const LawJob &job, std::size_t k, std::size_t i, SphereState &s,
                   const ContactsView &set, const Real *weight)
{
  if (set.n == 0) {
    touches_nothing(job, k, i);
    return;
  }
  const bool stays = job.in_place.counts != nullptr;
  int first = 0;
  SphereSink sink = {};
  if (!stays) {
    sink = sink_of<Law>(job, k);
  } else if (!take_places<Law>(job, k, count_bearing(set, weight), first, sink)) {
    does_not_fit(job, k);
    return;
  }
  if constexpr (Law::kHeat) *sink.heat = 0;
  add_motion<Law>(job, i, s);
  SphereResult out = {};
  add_contacts(job.grid, law, job.settings, s, set, weight, sink, out);
  if (job.uncertain.at) out.uncertain = job.uncertain[k];
  if (stays) add_in_place<Law>(job, k, i, s, first, out);
  job.n_contacts[k] = out.n_contacts;
  if (out.n_contacts > 0) job.result[k] = out;
}

// The contacts of the c-th crowded sphere; false: they do not fit.
LSDCD_FN bool crowded_contacts(const Crowd &crowd, int c, ContactsView &set, const Real *&weight)
{
  if (crowd.n[c] < 0) return false;
  set = crowd.contacts.view(crowd.first[c], crowd.n[c]);
  weight = crowd.weight + crowd.first[c];
  return true;
}

// Near sphere k from search to result, in one pass; `crowded` is its place among the crowded
// ones, or -1.
template <class Law>
LSDCD_FN void near_sphere(const Law &law, const LawJob &job, std::size_t k, int crowded)
{
  const std::size_t i = job.near ? job.near[k] : k;
  SphereState s = place_of<Law>(job, i);
  Touch<kPlaces> touching;
  ContactsView set;
  const Real *weight = touching.weight;
  if (crowded < 0) {
    note_reach(job, i, law_reach(law, s.radius));
    SphereResult found = {};
    find_touch(job.grid, law, job.settings, s, touching, found);
    if (touching.set.overflow) {
      put_off(job, k);
      return;
    }
    keep_uncertain(job, k, found.uncertain, s.radius);
    set = touching.set.view();
  } else if (!crowded_contacts(job.in_place.crowd, crowded, set, weight)) {
    does_not_fit(job, k);
    return;
  }
  bear(law, job, k, i, s, set, weight);
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

// The at-th of the near spheres for which find_first() has found one contact. That it is one
// and bears all of the force is known to the compiler: there is no loop to keep sums for, and
// half the registers do.
template <class Law>
LSDCD_FN void found_single(const Law &law, const LawJob &job, std::size_t at)
{
  const Found &found = job.found;
  if (at >= static_cast<std::size_t>(found.counts->listed[kSingle])) return;
  const std::size_t k = found.sphere[kSingle][at], i = job.near ? job.near[k] : k;
  SphereState s = place_of<Law>(job, i);
  bear(law, job, k, i, s, found.single.view(at, 1), nullptr);
}

// The at-th of those for which it has found several.
template <class Law>
LSDCD_FN void found_several(const Law &law, const LawJob &job, std::size_t at)
{
  const Found &found = job.found;
  const std::size_t k = found.sphere[kSeveral][at], i = job.near ? job.near[k] : k;
  const int n = found.n[at];
  if (n == kOverflow) return;
  ContactsView set = found.several.view(at * kPlaces, n);
  const Real *weight = found.weight + at * kPlaces;
  if (n < kOverflow && !crowded_contacts(job.in_place.crowd, place_of_crowded(n), set, weight)) {
    does_not_fit(job, k);
    return;
  }
  SphereState s = place_of<Law>(job, i);
  bear(law, job, k, i, s, set, weight);
}

// For backends that find contacts as they go: n near spheres, or lanes of crowded ones.
template <class Law, class Backend>
void start_law(const LawBytes &bytes, const LawJob &job, std::size_t n, Backend &backend)
{
  const Law law = bytes.as<Law>();
  backend.for_each(
      n, [=] LSDCD_LAMBDA(std::size_t at) { law_step(law, job, at); }, 128);
}

// For those that find them first (Backend::kFindsFirst): n near spheres, one each in the
// first kernel, though only the device knows how many of them are listed.
template <class Law, class Backend>
void start_found_law(const LawBytes &bytes, const LawJob &job, std::size_t n, Backend &backend)
{
  const Law law = bytes.as<Law>();
  backend.for_each(
      n, [=] LSDCD_LAMBDA(std::size_t at) { found_single(law, job, at); }, 128);
  for_each_several(backend, job.found, n,
                   [=] LSDCD_LAMBDA(std::size_t at) { found_several(law, job, at); });
}

}    // namespace lsdcd
