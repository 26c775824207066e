// The loop of a contact law over the spheres near the wall: one body for every backend,
// whether it finds their contacts as it goes or they were found before.
#pragma once

#include "parallel/rows_together.h"
#include "engine/force/compiled_law.h"
#include "engine/narrow/found_contacts.h"
#include "engine/results/step_notes.h"

#include <cstdint>

namespace lsdcd {

// Sphere i, at x, without what only a contact needs: most of those near the wall touch
// nothing.
template <class Law>
LSDCD_FN SphereState state_at(const LawJob &job, std::size_t i, const Vec3 &x, Real radius)
{
  SphereState s = {};
  s.x = x;
  s.radius = radius;
  if constexpr (Law::kHistory) {
    s.n_springs = job.springs.count[i];
    const std::size_t first = s.n_springs > 0 ? job.springs.first[i] : 0;
    s.springs = job.springs.pool + first;
    if constexpr (Law::kExtra > 0) s.extra = job.springs.extra + first * Law::kExtra;
  }
  return s;
}
template <class Law>
LSDCD_FN SphereState place_of(const LawJob &job, std::size_t i)
{
  return state_at<Law>(job, i, job.x[i], job.radius[i]);
}

// `rows`: those of sphere i.
template <class Law, class TheRows>
LSDCD_FN void add_motion(const LawJob &job, std::size_t i, const TheRows &rows, SphereState &s)
{
  s.v = rows.read(job.v);
  s.omega = rows.read(job.omega);
  s.mass = job.mass[i];
  if constexpr (Law::kHeat) s.temperature = job.temperature[i];
}

// Where the result of a near sphere goes; in place also the places of its own that it has for
// springs and records.
struct ResultPlace {
  std::size_t at;
  int own, n_own;
};

// In one pass a result has its near sphere's number and two places: a face each side of an
// edge. Of a single contact it has its number in the list, and so has the only place. Of
// several ones, which are counted down from the end, two at twice its number: with m single
// contacts that is 2 m or more, past the places of these.
LSDCD_FN ResultPlace place_of_two(std::size_t at)
{
  return {at, kOwnPlaces * static_cast<int>(at), kOwnPlaces};
}
LSDCD_FN ResultPlace place_of_single(std::size_t at)
{
  return {at, static_cast<int>(at), 1};
}

// Where result `at` puts what few laws return; what the law has no use for is not even set.
template <class Law>
LSDCD_FN SphereSink sink_of(const LawJob &job, std::size_t at)
{
  SphereSink sink = {};
  if constexpr (Law::kHistory) sink.springs = job.sink.springs + at * kPlaces;
  if constexpr (Law::kExtra > 0) sink.extra = job.sink.extra + at * kPlaces * Law::kExtra;
  if constexpr (Law::kHeat) sink.heat = job.sink.heat + at;
  if constexpr (Law::kRecords) sink.records = job.sink.records + at * kPlaces;
  return sink;
}

// The same in place, for n contacts that bear; false: no room.
template <class Law>
LSDCD_FN bool take_places(const LawJob &job, const ResultPlace &to, int n, int &first,
                          SphereSink &sink)
{
  const ContactPool &pool = job.in_place.pool;
  first = to.own;
  if constexpr (Law::kHeat) sink.heat = job.sink.heat + to.at;
  if constexpr (Law::kHistory || Law::kRecords) {
    if (n > to.n_own) {
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

// What is kept of sphere i's result in place beside its force and torque: its moment about
// the origin, so that totals can be made when the spheres are elsewhere.
template <class Law>
LSDCD_FN void keep_in_place(const LawJob &job, const ResultPlace &to, std::size_t i, const Vec3 &x,
                            int first, const SphereResult &out)
{
  const InPlace &in_place = job.in_place;
  if (out.overlap_ratio > 0)
    raise_to(&in_place.counts->deepest,
             std::uint64_t(ascending_bits(static_cast<float>(out.overlap_ratio))) << 32 | (i + 1));
  if constexpr (Law::kHistory)
    if (job.settings.update) {
      if (out.n_contacts > 0) in_place.pool.first[i] = first;
      in_place.pool.count[i] = out.n_contacts;
    }
  if (out.n_contacts == 0) {
    put_count(job, to.at, 0);
    return;
  }
  if constexpr (Law::kRecords) in_place.pool.place[to.at] = first;
  if constexpr (Law::kHeat) in_place.heat_flow[i] += job.sink.heat[to.at];
  in_place.result.put(to.at, out, cross(x, out.force) + out.torque);
}

// What its contacts, of which there are some, do to sphere i, whose rows are `rows`. Where
// lanes take these together all of them call this, and those without a sphere are not `mine`.
template <class Law, class TheRows>
LSDCD_FN void bear(const Law &law, const LawJob &job, const ResultPlace &to, std::size_t i,
                   const TheRows &rows, SphereState &s, const ContactsView &set, const Real *weight,
                   bool mine)
{
  const bool stays = job.in_place.counts != nullptr;
  int first = 0;
  SphereSink sink = {};
  bool bears = mine;
  if (mine) {
    if (!stays) {
      sink = sink_of<Law>(job, to.at);
    } else if (!take_places<Law>(job, to, count_bearing(set, weight), first, sink)) {
      does_not_fit(job, to.at);
      bears = false;
    }
  }
  add_motion<Law>(job, i, rows, s);
  // The only spring of one of many, which lie side by side, is stored with its neighbours'.
  constexpr bool kSpringBeside = Law::kHistory && TheRows::kOneOfMany;
  [[maybe_unused]] Spring spring = {};
  [[maybe_unused]] Spring *const to_spring = sink.springs;
  if constexpr (kSpringBeside) sink.springs = &spring;
  SphereResult out = {};
  if (bears) {
    if constexpr (Law::kHeat) *sink.heat = 0;
    add_contacts(job.grid, law, job.settings, s, set, weight, sink, out);
    if (stays) {
      keep_in_place<Law>(job, to, i, s.x, first, out);
    } else {
      if (job.uncertain.at) out.uncertain = job.uncertain[to.at];
      job.result[to.at] = out;
    }
  }
  if constexpr (kSpringBeside) {
    if (stays)
      store_together(to_spring, spring, bears);
    else if (bears)
      *to_spring = spring;
  }
  if (stays)
    rows.add(job.in_place.force, out.force, job.in_place.torque, out.torque, out.n_contacts > 0);
}

// The contacts of the c-th crowded sphere; false: they do not fit.
LSDCD_FN bool crowded_contacts(const Crowd &crowd, int c, ContactsView &set, const Real *&weight)
{
  if (crowd.n[c] < 0) return false;
  set = crowd.contacts.view(crowd.first[c], crowd.n[c]);
  weight = crowd.weight + crowd.first[c];
  return true;
}

LSDCD_FN void touches_nothing(const LawJob &job, const ResultPlace &to, std::size_t i)
{
  put_count(job, to.at, 0);
  lose_springs(job, i);
}

// Near sphere k from search to result, in one pass; `crowded` is its place among the crowded
// ones, or -1.
template <class Law>
LSDCD_FN void near_sphere(const Law &law, const LawJob &job, std::size_t k, int crowded)
{
  const std::size_t i = job.near ? job.near[k] : k;
  const ResultPlace to = place_of_two(k);
  SphereState s = place_of<Law>(job, i);
  Touch<kPlaces> touching;
  ContactsView set;
  const Real *weight = touching.weight;
  if (crowded < 0) {
    note_reach(job, i, law_reach(law, s.radius));
    SphereResult found = {};
    find_touch(job.grid, law, job.settings, s, touching, found);
    if (touching.set.overflow) {
      put_off(job, k, to.at);
      return;
    }
    keep_uncertain(job, k, found.uncertain, s.radius);
    set = touching.set.view();
  } else if (!crowded_contacts(job.in_place.crowd, crowded, set, weight)) {
    does_not_fit(job, to.at);
    return;
  }
  if (set.n == 0)
    touches_nothing(job, to, i);
  else
    bear(law, job, to, i, RowsAlone(i), s, set, weight, true);
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

// The at-th sphere for which find_first() has found one contact. That it is one and bears all
// of the force is known to the compiler: there is no loop to keep sums for, and half the
// registers do. For lanes past the end of the list, the last one's rows are read once more.
template <class Law>
LSDCD_FN void found_single(const Law &law, const LawJob &job, std::size_t at)
{
  const std::size_t n = job.found.counts->listed[kSingle];
  if (RowsTogether::first(at) >= n) return;
  const bool mine = at < n;
  const std::size_t from = mine ? at : n - 1;
  const SingleContacts &single = job.found.single;
  const int i = single.sphere[from];
  const RowsTogether rows(i);
  SphereState s = state_at<Law>(job, i, single.x[from], single.radius[from]);
  const FeatureCode feature = single.feature[from];
  const Vec3 normal = single.normal[from];
  const Real distance = single.distance[from];
  ResultPlace to = place_of_single(from);
  if (!job.in_place.counts) to.at = i;    // a near sphere's own number
  bear(law, job, to, i, rows, s, {1, &feature, &normal, &distance}, nullptr, mine);
}

// The s-th of those for which it has found several.
template <class Law>
LSDCD_FN void found_several(const Law &law, const LawJob &job, std::size_t s)
{
  const Found &found = job.found;
  const std::size_t k = found.several_near[s], i = job.near ? job.near[k] : k;
  const ResultPlace to = place_of_two(result_of_several(job, s, k));
  const int n = found.n[s];
  if (n == kOverflow) return;
  ContactsView set = found.several.view(s * kPlaces, n);
  const Real *weight = found.weight + s * kPlaces;
  if (n < kOverflow && !crowded_contacts(job.in_place.crowd, place_of_crowded(n), set, weight)) {
    does_not_fit(job, to.at);
    return;
  }
  if (set.n == 0) {
    touches_nothing(job, to, i);
    return;
  }
  SphereState state = place_of<Law>(job, i);
  bear(law, job, to, i, RowsAlone(i), state, set, weight, true);
}

// For backends that find contacts as they go: n near spheres, or lanes of crowded ones.
template <class Law, class Backend>
void start_law(const LawBytes &bytes, const LawJob &job, std::size_t n, Backend &backend)
{
  const Law law = bytes.as<Law>();
  backend.for_each(
      n, [=] LSDCD_LAMBDA(std::size_t at) { law_step(law, job, at); }, 128);
}

// The law on what find_first() has found: many single contacts, and few spheres with several.
template <class Law>
struct FoundLoop {
  Law law;
  LawJob job;

  // Blocks at once on a GPU's processor: 64, 80, 96 or 128 registers are left to a thread. That
  // is what single contacts need; several ones may spill.
  static constexpr bool kLarge = Law::kExtra > 0 || Law::kCouple || Law::kHeat || Law::kBeyond,
                        kOnWall = Law::kSurface || Law::kRecords;
  static constexpr int kBlocksAtOnce = kLarge ? 4 : kOnWall ? 5 : Law::kHistory ? 6 : 8;

  LSDCD_FN void many(std::size_t at) const { found_single(law, job, at); }
  LSDCD_FN std::size_t n_few() const { return job.found.counts->listed[kSeveral]; }
  LSDCD_FN void few(std::size_t s) const { found_several(law, job, s); }
};

// For those that find them first (Backend::kFindsFirst): n near spheres, a call for each,
// though only the device knows how many of them are listed.
template <class Law, class Backend>
void start_found_law(const LawBytes &bytes, const LawJob &job, std::size_t n, Backend &backend)
{
  constexpr std::size_t warp = RowsTogether::kTogether;
  backend.few_and_many(n, (n + warp - 1) / warp * warp, FoundLoop<Law>{bytes.as<Law>(), job},
                       job.found.just_now);
}

}    // namespace lsdcd
