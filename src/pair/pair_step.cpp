// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step of pairs: those that touch are found, put into lanes and computed there; their forces are added in the order of the
// host's list. Each of these is a loop of its own over some dozens of pairs.
#include "pair/compile_pair.h"
#include "pair/pair_kernel.h"
#include "pair/pair_lanes.h"

#include <algorithm>
#include <cfenv>
#include <cstddef>
#include <limits>
#include <vector>

namespace lsdcd {

namespace {

constexpr std::size_t kNone = ~static_cast<std::size_t>(0);    // a pair that keeps nothing yet

// While it lives, no operation without a result sends a signal, which a host may have asked for. Vectors do in vain what a branch
// would leave out, such as the root of a negative number.
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

// The pairs of one law in lanes.
struct LawLanes {
  PairLanes lanes = {};
  int n = 0;
  int pair[kLanes];    // their numbers among those that are found
  // The numbers of the memory that are stored, in the order of the history.
  int n_stored = 0, stored[kLaneNumbers] = {};
};

// kOne: all types have one law.
template <bool kOne>
class PairStep {
 public:
  explicit PairStep(const PairJob &job) :
      job_(job), keeps_(job.history != nullptr), wide_(job.update),
      n_both_(job.both_sides ? std::numeric_limits<int>::max() : job.n_own), of_law_(job.n_laws)
  {
    for (int law = 0; law < job.n_laws; law++) {
      const PairLaw &of = job.laws[law];
      beyond_contact_ = beyond_contact_ || of.pull_off > 0;
      LawLanes &l = of_law_[law];
      for (int k = 0; k < kLaneNumbers; k++)
        l.lanes.before[k] = l.lanes.after[k] = l.lanes.memory[k];
      if (wide_ && of.evaluate_wide) of.prepare(of.law, l.lanes);
      for (int k = 0; k < kLaneNumbers; k++)
        if (of.stored >> k & 1) l.stored[l.n_stored++] = k;
    }
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
      if (n_found_ >= 4 * kLanes) compute_found(false);
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
    if (!kOne) lane_.resize(2 * room);
  }

  // Append the pairs of a row that touch to those that are found, and return how many these are. The row's first pair has the
  // number `start` in the list. A branch would often be foreseen wrongly.
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
    return bits >> job_.list.factor_shift & 3 ? without_excluded(touching) : touching;
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
      if (p.distance_sq < sum * sum || (keeps_ && is_held(p, job_.laws[law_of(i, j)].pull_off) &&
                                        job_.old->find(key) != job_.old->size())) {
        first_[count] = i;
        neighbour_[count] = neighbour;
        key_[count++] = key;
      }
    }
    return without_excluded(count - n_found_);
  }
  // Takes those away whose factor is 0.
  int without_excluded(int n)
  {
    int count = n_found_;
    for (int m = n_found_; m < n_found_ + n; m++) {
      const Real factor = factor_of(neighbour_[m]);
      has_factors_ = has_factors_ || factor != 1;
      first_[count] = first_[m];
      neighbour_[count] = neighbour_[m];
      key_[count] = key_[m];
      count += factor != 0;
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

  // Computes the pairs that are found; while more are found, as many as fill the lanes of a law.
  void compute_found(bool all)
  {
    int begin = 0;
    while (begin < n_found_) {
      const int end = choose_lanes(begin);
      if (end == n_found_ && !all && !is_full()) break;
      compute(begin, end);
      begin = end;
    }
    for (int m = begin; m < n_found_; m++) {
      first_[m - begin] = first_[m];
      neighbour_[m - begin] = neighbour_[m];
      key_[m - begin] = key_[m];
    }
    n_found_ -= begin;
  }
  // Gives the pairs from `begin` on their lanes, and returns the one behind them.
  int choose_lanes(int begin)
  {
    if (kOne) {
      of_law_[0].n = std::min(kLanes, n_found_ - begin);
      return begin + of_law_[0].n;
    }
    for (LawLanes &l : of_law_) l.n = 0;
    for (int m = begin; m < n_found_; m++) {
      const int law = law_of(first_[m], neighbour_[m] & job_.list.mask);
      LawLanes &l = of_law_[law];
      if (l.n == kLanes) return m;
      lane_[m] = {law, l.n};
      l.pair[l.n++] = m;
    }
    return n_found_;
  }
  bool is_full() const
  {
    return std::any_of(of_law_.begin(), of_law_.end(),
                       [](const LawLanes &l) { return l.n == kLanes; });
  }

  // Computes these pairs, which have their lanes, and adds their forces.
  void compute(int begin, int end)
  {
    const std::size_t kept = keeps_ ? begin_history(begin, end) : 0;
    for (int law = 0; law < job_.n_laws; law++) {
      LawLanes &l = of_law_[law];
      if (l.n == 0) continue;
      if (kOne)
        for (int k = 0; k < l.n; k++) l.pair[k] = begin + k;
      gather(l);
      if (keeps_) set_history(l, kept, begin);
      const PairLaw &of = job_.laws[law];
      if (wide_ && of.evaluate_wide)
        of.evaluate_wide(of.law, l.lanes, l.n, job_.dt);
      else
        of.evaluate_lanes(of.law, l.lanes, l.n, job_.dt, job_.update);
      if (keeps_ && !kOne) write_history(l, kept, begin);
    }
    if (has_factors_ || job_.heat)
      add_forces<true>(begin, end);
    else
      add_forces<false>(begin, end);
    if (job_.record) record(begin, end);
  }

  void gather(LawLanes &l) const
  {
    const int n = l.n, mask = job_.list.mask;
    PairLanes &lanes = l.lanes;
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
  // Says where the lanes read and write what their pairs keep: with one law in the histories, where the pairs lie side by side
  // as in the lanes.
  void set_history(LawLanes &l, std::size_t kept, int begin) const
  {
    for (int m = 0; m < l.n_stored; m++) {
      const int number = l.stored[m];
      const Real *const old = job_.old->column(m);
      if (kOne) l.lanes.after[number] = job_.history->column(m) + kept;
      l.lanes.before[number] = kOne && same_ ? old + same_from_ : l.lanes.memory[number];
      if (kOne && same_) continue;
      for (int k = 0; k < l.n; k++) {
        const std::size_t pair = same_ ? same_from_ + l.pair[k] - begin : old_[l.pair[k]];
        l.lanes.memory[number][k] = pair == kNone ? 0 : old[pair];
      }
    }
  }
  // The pair `begin` of those that are found is number `kept` of the history. Laws of other types may keep more numbers.
  void write_history(const LawLanes &l, std::size_t kept, int begin) const
  {
    for (int m = 0; m < job_.history->width(); m++) {
      Real *const to = job_.history->column(m) + kept;
      const Real *const from = m < l.n_stored ? l.lanes.memory[l.stored[m]] : nullptr;
      for (int k = 0; k < l.n; k++) to[l.pair[k] - begin] = from ? from[k] : 0;
    }
  }

  // ---- results --------------------------------------------------------------------------

  struct Lane {
    int law, lane;
  };
  const PairLanes &lanes_of(int m) const { return of_law_[kOne ? 0 : lane_[m].law].lanes; }
  int lane_of(int m, int begin) const { return kOne ? m - begin : lane_[m].lane; }

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
      const PairLanes &lanes = lanes_of(m);
      const int k = lane_of(m, begin), j = neighbour[m] & mask;
      Vec3 on_i = lane_vec(lanes.force, k), turns_i = lane_vec(lanes.torque_i, k),
           turns_j = lane_vec(lanes.torque_j, k);
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
      if (kMore && job_.heat && job_.laws[kOne ? 0 : lane_[m].law].has_heat) {
        heat_ += lanes.heat[k];
        if (j < n_both) job_.heat[j] -= lanes.heat[k];
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
      const PairLanes &lanes = lanes_of(m);
      const int k = lane_of(m, begin);
      const Real factor = factor_of(neighbour_[m]);
      job_.record->push_back({first_[m], neighbour_[m] & job_.list.mask, lane_vec(lanes.offset, k),
                              factor * lane_vec(lanes.force, k), factor * lanes.energy[k]});
    }
  }

  const PairJob &job_;
  const bool keeps_, wide_;
  const int n_both_;    // forces act on both grains of a pair whose second is below it
  bool beyond_contact_ = false, has_factors_ = false;
  // Pairs that are found: first grain, neighbour as it is in the list, number in the list; number in the last step's history, lane.
  int n_found_ = 0;
  std::vector<int> first_, neighbour_;
  std::vector<std::size_t> key_, old_;
  std::vector<Lane> lane_;
  std::vector<LawLanes> of_law_;
  // Of the last step's history: pairs before last_ have been looked at. Are the pairs that are computed now, from same_from_ on,
  // the same?
  std::size_t last_ = 0, same_from_ = 0;
  bool same_ = false;
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
