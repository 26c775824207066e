// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step of pairs: those that touch are found, put into lanes and computed there; their forces are added in the order of the
// host's list. Each of these is a loop of its own over some dozens of pairs; with several laws over some hundreds or thousands, so that
// the lanes of each law are filled.
#include "backend/bits.h"
#include "pair/compile_pair.h"
#include "pair/pair_kernel.h"
#include "pair/pair_lanes.h"

#include <algorithm>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lsdcd {

namespace {

constexpr std::size_t kNone = ~static_cast<std::size_t>(0);    // a pair that keeps nothing yet
constexpr Lane kNothing = {};
// So many pairs are found before they get their lanes. With several laws so many wait at most until all are computed: enough to fill the
// lanes of most laws, and few enough for caches.
constexpr int kFindAtOnce = 4 * kLanes, kMostWaitOfLaw = 4 * kLanes, kMostWait = 128 * kLanes;

// While it lives, floating-point traps that the host has switched on are off: lanes without a pair may take the root of a negative number, whose
// result nobody reads.
class NoSignals {
 public:
#if defined(__GLIBC__)
  NoSignals() : asked_(fegetexcept())
  {
    if (asked_) fedisableexcept(asked_);
  }
  ~NoSignals()
  {
    if (!asked_) return;
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(asked_);
  }
  NoSignals(const NoSignals &) = delete;
  NoSignals &operator=(const NoSignals &) = delete;

 private:
  int asked_;
#endif
};

std::size_t index_of(int i)
{
  return static_cast<unsigned>(i);
}
Vec3 vec_at(const Real *all, std::size_t i)
{
  const Real *const a = all + 3 * i;
  return {a[0], a[1], a[2]};
}
void add_to(Real *all, std::size_t i, const Vec3 &a)
{
  Real *const to = all + 3 * i;
  for (int k = 0; k < 3; k++) to[k] += a[k];
}
void take_from(Real *all, std::size_t i, const Vec3 &a)
{
  Real *const to = all + 3 * i;
  for (int k = 0; k < 3; k++) to[k] -= a[k];
}

// The pairs of one law that are in lanes, or wait for them to be filled: their numbers among those that are found.
struct LawPairs {
  int n = 0;
  int pair[kLanes];
};

// What a pair does to its grains, its heat and its elastic energy.
struct PairResult {
  Vec3 force, torque_i, torque_j;
  Real heat, energy;
};

// Of a pair that waits what it has kept, in the order of the history, and then its force and torques.
struct PairRecord {
  Real numbers[10];

  PairRecord() {}    // an array of them takes memory alone
};
static_assert(kLaneNumbers <= 10, "a record has room for what a pair keeps");

// kOne: all types have one law.
template <bool kOne>
class PairStep {
 public:
  explicit PairStep(const PairJob &job) :
      job_(job), keeps_(job.history != nullptr), wide_(job.update),
      n_both_(job.both_sides ? std::numeric_limits<int>::max() : job.n_own),
      has_more_(job.heat || job.record),
      most_wait_(std::min(kMostWaitOfLaw * job.n_laws, kMostWait)), of_law_(job.n_laws)
  {
    for (int k = 0; k < kLaneNumbers; k++) lanes_.before[k] = lanes_.after[k] = lanes_.memory[k];
    for (int law = 0; law < job.n_laws; law++) {
      beyond_contact_ = beyond_contact_ || job.laws[law].reach.acts();
      most_stored_ = std::max(most_stored_, static_cast<int>(count_bits(job.laws[law].stored)));
    }
    if (!kOne) make_room((most_wait_ + 2 * kFindAtOnce) / 2);    // of which it makes twice as much
  }

  void run()
  {
    const PairList &list = job_.list;
    if (list.rows == 0) return;
    sum_of_ = list.grain[0];
    std::size_t start = 0;
    for (int row = 0; row < list.rows; row++) {
      const int i = list.grain[row], n = list.length[i];
      make_room(n_found_ + n);
      n_found_ += beyond_contact_ ? find_held(i, start) : find_touching(i, start);
      start += static_cast<std::size_t>(n);
      if (n_found_ - n_chosen_ >= kFindAtOnce) compute_found(false);
    }
    compute_found(true);
    add_to(job_.force, index_of(sum_of_), force_);
    add_to(job_.torque, index_of(sum_of_), torque_);
    add_heat(sum_of_);
  }

 private:
  // ---- pairs that touch -----------------------------------------------------------------

  void make_room(int n)
  {
    const auto room = static_cast<std::size_t>(n);
    if (room <= first_.size()) return;
    first_.resize(2 * room);
    neighbour_.resize(2 * room);
    key_.resize(2 * room);
    old_.resize(2 * room);
    if (kOne) return;
    record_.resize(2 * room);
    if (has_more_) more_.resize(2 * room);
  }

  // Append the pairs of a row that touch to those that are found, and return how many these are. The row's first pair has the
  // number `start` in the list. There is no branch, because it would often be predicted wrongly.
  int find_touching(int i, std::size_t start)
  {
    const int *const neighbours = job_.list.row[i];
    const Real *const all_x = job_.x, *const all_radius = job_.radius;
    const Vec3 x = vec_of(all_x, i);
    const Real radius = all_radius[i];
    const auto mask = static_cast<unsigned>(job_.list.mask);
    int *const first = first_.data() + n_found_, *const found = neighbour_.data() + n_found_;
    std::size_t *const key = key_.data() + n_found_;
    const auto n = static_cast<std::size_t>(job_.list.length[i]);
    std::size_t count = 0;
    int bits = 0;
    for (std::size_t place = 0; place < n; place++) {
      const int neighbour = neighbours[place];
      const std::size_t j = static_cast<unsigned>(neighbour) & mask;
      const Real sum = radius + all_radius[j];
      bits |= neighbour;
      first[count] = i;
      found[count] = neighbour;
      key[count] = start + place;
      count += norm_sq(x - vec_at(all_x, j)) < sum * sum;
    }
    const int touching = static_cast<int>(count);
    const bool may_be_excluded = bits >> job_.list.factor_shift & 3 || job_.mask;
    return may_be_excluded ? without_excluded(touching) : touching;
  }
  // The same with those that adhesion holds.
  int find_held(int i, std::size_t start)
  {
    int count = n_found_;
    for (int place = 0; place < job_.list.length[i]; place++) {
      const int neighbour = job_.list.row[i][place], j = neighbour & job_.list.mask;
      const std::size_t key = start + static_cast<std::size_t>(place);
      GrainPair p;
      p.distance_sq = norm_sq(vec_of(job_.x, i) - vec_of(job_.x, j));
      p.radius_i = job_.radius[i];
      p.radius_j = job_.radius[j];
      const Real sum = p.radius_i + p.radius_j;
      if (p.distance_sq < sum * sum || is_within_reach(p, job_.laws[law_of(i, j)].reach, key)) {
        first_[count] = i;
        neighbour_[count] = neighbour;
        key_[count++] = key;
      }
    }
    return without_excluded(count - n_found_);
  }
  bool is_within_reach(const GrainPair &p, const LawReach &reach, std::size_t key) const
  {
    return is_within(p, reach, true) &&
           (reach.of == LawReach::Of::near || (keeps_ && job_.old->find(key) != job_.old->size()));
  }
  // Takes those away whose factor is 0, and those of two grains that do not move.
  int without_excluded(int n)
  {
    int count = n_found_;
    for (int m = n_found_; m < n_found_ + n; m++) {
      const Real factor = factor_of(neighbour_[m]);
      has_factors_ = has_factors_ || factor != 1;
      first_[count] = first_[m];
      neighbour_[count] = neighbour_[m];
      key_[count] = key_[m];
      count += factor != 0 && !are_frozen(job_, first_[m], neighbour_[m] & job_.list.mask);
    }
    return count - n_found_;
  }
  Real factor_of(int neighbour) const
  {
    return job_.factor[neighbour >> job_.list.factor_shift & 3];
  }
  int law_of(int i, int j) const
  {
    return kOne ? 0 : job_.law_of[job_.type[i] * job_.n_types + job_.type[j]];
  }

  // ---- in lanes -------------------------------------------------------------------------

  // Computes the pairs that are found; while more are found, as many as fill lanes.
  void compute_found(bool all)
  {
    if (kOne)
      compute_in_order(all);
    else
      compute_by_law(all);
  }
  void compute_in_order(bool all)
  {
    LawPairs &l = of_law_[0];
    int begin = 0;
    while (n_found_ - begin >= (all ? 1 : kLanes)) {
      const int n = std::min(kLanes, n_found_ - begin), end = begin + n;
      l.n = n;
      for (int k = 0; k < n; k++) l.pair[k] = begin + k;
      const std::size_t kept = keeps_ ? begin_history(begin, end) : 0;
      gather(l);
      if (keeps_) set_history(l, kept);
      evaluate(0, l.n);
      add_results(begin, end);
      begin = end;
    }
    for (int m = begin; m < n_found_; m++) {
      first_[m - begin] = first_[m];
      neighbour_[m - begin] = neighbour_[m];
      key_[m - begin] = key_[m];
    }
    n_found_ -= begin;
  }
  // With several laws a pair waits until the lanes of its law are full. Forces are added in the order of the list, when none waits.
  void compute_by_law(bool all)
  {
    for (int begin = n_chosen_; keeps_ && begin < n_found_; begin += kLanes) {
      const int end = std::min(begin + kLanes, n_found_);
      const std::size_t kept = begin_history(begin, end);
      if (begin == 0) kept_ = kept;
      record_kept(begin, end);
    }
    for (; n_chosen_ < n_found_; n_chosen_++) {
      const int law = law_of(first_[n_chosen_], neighbour_[n_chosen_] & job_.list.mask);
      LawPairs &l = of_law_[law];
      l.pair[l.n++] = n_chosen_;
      if (l.n == kLanes) compute_waiting(law);
    }
    if (n_found_ < most_wait_ && !all) return;
    for (int law = 0; law < job_.n_laws; law++)
      if (of_law_[law].n > 0) compute_waiting(law);
    add_results(0, n_found_);
    n_found_ = n_chosen_ = 0;
  }
  // Computes the pairs of a law that wait, and records what they do and keep.
  void compute_waiting(int law)
  {
    LawPairs &l = of_law_[law];
    gather(l);
    if (keeps_) read_kept(law, l);
    evaluate(law, l.n);
    if (keeps_) write_kept(law, l);
    for (int k = 0; k < l.n; k++) {
      Real *const to = record_[l.pair[k]].numbers;
      for (int d = 0; d < 3; d++) {
        to[d] = lanes_.force[d][k];
        to[3 + d] = lanes_.torque_i[d][k];
        to[6 + d] = lanes_.torque_j[d][k];
      }
    }
    if (has_more_)
      for (int k = 0; k < l.n; k++)
        more_[l.pair[k]] = {job_.laws[law].has_heat ? lanes_.heat[k] : 0, lanes_.energy[k]};
    l.n = 0;
  }

  void evaluate(int law, int n)
  {
    const PairLaw &of = job_.laws[law];
    if (!wide_ || !of.evaluate_wide) {
      of.evaluate_lanes(of.law, lanes_, n, job_.dt, job_.update);
      return;
    }
    if (of.prepare != prepared_ || of.choices != choices_) {
      of.prepare(of.law, lanes_);
      prepared_ = of.prepare;
      choices_ = of.choices;
    }
    of.evaluate_wide(of.law, lanes_, n, job_.dt);
  }

  void gather(const LawPairs &l)
  {
    const int n = l.n, mask = job_.list.mask;
    PairLanes &lanes = lanes_;
    int i[kLanes], j[kLanes];
    for (int k = 0; k < n; k++) {
      i[k] = first_[l.pair[k]];
      j[k] = neighbour_[l.pair[k]] & mask;
    }
    const Real *const x = job_.x, *const v = job_.v, *const omega = job_.omega,
                      *const radius = job_.radius, *const mass = job_.mass;
    for (int k = 0; k < n; k++) {
      const std::size_t a = index_of(i[k]), b = index_of(j[k]);
      set_lane(lanes.offset, k, vec_at(x, a) - vec_at(x, b));
      set_lane(lanes.velocity, k, vec_at(v, a) - vec_at(v, b));
      set_lane(lanes.omega_i, k, vec_at(omega, a));
      set_lane(lanes.omega_j, k, vec_at(omega, b));
      lanes.radius_i[k] = radius[a];
      lanes.radius_j[k] = radius[b];
      lanes.mass_i[k] = mass[a];
      lanes.mass_j[k] = mass[b];
    }
    if (job_.mask)
      for (int k = 0; k < n; k++)
        lanes.mass[k] = reduced_mass(job_, i[k], j[k], lanes.mass_i[k], lanes.mass_j[k]);
    else
      for (int k = 0; k < n; k++)
        lanes.mass[k] = lanes.mass_i[k] * lanes.mass_j[k] / (lanes.mass_i[k] + lanes.mass_j[k]);
    if (job_.heat)
      for (int k = 0; k < n; k++)
        lanes.temperature_difference[k] = job_.temperature[j[k]] - job_.temperature[i[k]];
  }

  // ---- history --------------------------------------------------------------------------

  // Appends these pairs to the history, and finds which of the last step's they were. Returns the number of the first.
  std::size_t begin_history(int begin, int end)
  {
    const PairHistory &last = *job_.old;
    const std::size_t *const keys = key_.data();
    const auto n = static_cast<std::size_t>(end - begin);
    same_ = last.has(last_, keys + begin, n);
    if (same_) {
      same_from_ = last_;
      last_ += n;
    } else {
      for (int m = begin; m < end; m++) {
        while (last_ < last.size() && last.key(last_) < keys[m]) last_++;
        old_[m] = last_ < last.size() && last.key(last_) == keys[m] ? last_ : kNone;
      }
    }
    return job_.history->append(keys + begin, end - begin);
  }
  // Calls act(k, number) for the numbers of the memory that a law stores: the k-th in the history, which number of the memory it is.
  template <class Act>
  void for_stored(int law, const Act &act) const
  {
    int k = 0;
    for (std::uint32_t left = job_.laws[law].stored; left != 0; left &= left - 1)
      act(k++, static_cast<int>(lowest_bit(left)));
  }
  // With one law: says where the lanes read and write what their pairs keep, which is in the histories, where the pairs lie side by
  // side as in the lanes, in the new one from number `kept` on.
  void set_history(const LawPairs &l, std::size_t kept)
  {
    for_stored(0, [&](int m, int number) {
      const Real *const old = job_.old->column(m);
      lanes_.after[number] = job_.history->column(m) + kept;
      lanes_.before[number] = same_ ? old + same_from_ : lanes_.memory[number];
      if (same_) return;
      for (int k = 0; k < l.n; k++) {
        const std::size_t pair = old_[l.pair[k]];
        lanes_.memory[number][k] = pair == kNone ? 0 : old[pair];
      }
    });
  }
  // With several laws: records what these pairs have kept, side by side for each pair.
  void record_kept(int begin, int end)
  {
    for (int k = 0; k < most_stored_; k++) {
      const Real *const old = job_.old->column(k);
      if (same_)
        for (int m = begin; m < end; m++) record_[m].numbers[k] = old[same_from_ + (m - begin)];
      else
        for (int m = begin; m < end; m++)
          record_[m].numbers[k] = old_[m] == kNone ? 0 : old[old_[m]];
    }
  }
  void read_kept(int law, const LawPairs &l)
  {
    std::fill_n(lanes_.before, kLaneNumbers, kNothing);
    for_stored(law, [&](int m, int number) {
      lanes_.before[number] = lanes_.memory[number];
      for (int k = 0; k < l.n; k++) lanes_.memory[number][k] = record_[l.pair[k]].numbers[m];
    });
  }
  // Laws of other types may keep more numbers.
  void write_kept(int law, const LawPairs &l) const
  {
    const Real *from[kLaneNumbers];
    std::fill_n(from, kLaneNumbers, kNothing);
    for_stored(law, [&](int m, int number) { from[m] = lanes_.memory[number]; });
    for (int m = 0; m < job_.history->width(); m++) {
      Real *const to = job_.history->column(m) + kept_;
      const Real *const now = m < kLaneNumbers ? from[m] : kNothing;
      for (int k = 0; k < l.n; k++) to[l.pair[k]] = now[k];
    }
  }

  // ---- results --------------------------------------------------------------------------

  // Returns what a pair does, of those from `begin` on that have been computed.
  PairResult result(int m, int begin) const
  {
    if (!kOne) {
      const Real *const r = record_[m].numbers;
      const More more = has_more_ ? more_[m] : More{0, 0};
      return {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}, more.heat, more.energy};
    }
    const int k = m - begin;
    return {lane_vec(lanes_.force, k), lane_vec(lanes_.torque_i, k), lane_vec(lanes_.torque_j, k),
            lanes_.heat[k], lanes_.energy[k]};
  }

  void add_results(int begin, int end)
  {
    if (has_factors_ || job_.heat)
      add_forces<true>(begin, end);
    else
      add_forces<false>(begin, end);
    if (job_.record) record(begin, end);
  }
  // Adds forces in the order of the list: the pairs of a row are summed, and then added to its grain. kMore: with factors and heat.
  template <bool kMore>
  void add_forces(int begin, int end)
  {
    Real *const all_force = job_.force, *const all_torque = job_.torque;
    const int mask = job_.list.mask, n_both = n_both_;
    const int *const first = first_.data(), *const neighbour = neighbour_.data();
    int sum_of = sum_of_;
    Vec3 force = force_, torque = torque_;
    for (int m = begin; m < end; m++) {
      if (first[m] != sum_of) {
        add_to(all_force, index_of(sum_of), force);
        add_to(all_torque, index_of(sum_of), torque);
        force = torque = {0, 0, 0};
        if (kMore) add_heat(sum_of);
        sum_of = first[m];
      }
      const PairResult of_pair = result(m, begin);
      const int j = neighbour[m] & mask;
      Vec3 on_i = of_pair.force, turns_i = of_pair.torque_i, turns_j = of_pair.torque_j;
      if (kMore) {
        const Real factor = factor_of(neighbour[m]);
        on_i = factor * on_i;
        turns_i = factor * turns_i;
        turns_j = factor * turns_j;
      }
      force += on_i;
      torque += turns_i;
      if (j < n_both) {
        take_from(all_force, index_of(j), on_i);
        add_to(all_torque, index_of(j), turns_j);
      }
      if (kMore && job_.heat && (!kOne || job_.laws[0].has_heat)) {
        heat_ += of_pair.heat;
        if (j < n_both) job_.heat[j] -= of_pair.heat;
      }
    }
    sum_of_ = sum_of;
    force_ = force;
    torque_ = torque;
  }
  void add_heat(int i)
  {
    if (job_.heat) job_.heat[i] += heat_;
    heat_ = 0;
  }
  void record(int begin, int end) const
  {
    for (int m = begin; m < end; m++) {
      const PairResult of_pair = result(m, begin);
      const int i = first_[m], j = neighbour_[m] & job_.list.mask;
      const Real factor = factor_of(neighbour_[m]);
      job_.record->push_back({i, j, vec_of(job_.x, i) - vec_of(job_.x, j), factor * of_pair.force,
                              factor * of_pair.energy});
    }
  }

  struct More {
    Real heat, energy;
  };

  const PairJob &job_;
  const bool keeps_, wide_;
  const int n_both_;    // forces act on both grains of a pair whose second is below it
  bool beyond_contact_ = false, has_factors_ = false;
  // Of several laws: are heat and energy asked for, and how many pairs are found before all are computed?
  const bool has_more_;
  const int most_wait_;
  // Pairs that are found: first grain, neighbour as it is in the list, number in the list; number in the last step's history. With
  // several laws the first n_chosen_ of them wait or are computed, and have records.
  int n_found_ = 0, n_chosen_ = 0;
  std::vector<int> first_, neighbour_;
  std::vector<std::size_t> key_, old_;
  std::vector<PairRecord> record_;
  std::vector<More> more_;
  std::vector<LawPairs> of_law_;
  // The lanes, and for which choices they have been prepared.
  PairLanes lanes_ = {};
  void (*prepared_)(const LawBytes &, PairLanes &) = nullptr;
  std::uint64_t choices_ = 0;
  // Of the last step's history: pairs before last_ have been looked at. Are the pairs that were looked at last, from same_from_ on,
  // the same?
  std::size_t last_ = 0, same_from_ = 0;
  bool same_ = false;
  // With several laws: the number in the history of the first pair that is found, and how many numbers a law stores at most.
  std::size_t kept_ = 0;
  int most_stored_ = 0;
  // What the pairs of a row have given to its grain so far.
  int sum_of_ = 0;
  Vec3 force_ = {0, 0, 0}, torque_ = {0, 0, 0};
  Real heat_ = 0;
};

}    // namespace

void run_pairs(const PairJob &job)
{
  [[maybe_unused]] const NoSignals while_computing;
  if (job.n_laws == 1)
    PairStep<true>(job).run();
  else
    PairStep<false>(job).run();
  if (job.energy) book_pairs(job);
}

}    // namespace lsdcd
