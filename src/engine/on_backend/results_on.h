// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Results of a step in the memory of the engine's backend: columns by candidate sphere, and the totals and rows
// that are made from them on request.
#pragma once

#include "engine/broad_phase/candidate_slots.h"
#include "engine/loads/sums_on.h"
#include "engine/nodes/node_forces.h"
#include "engine/results/energy_sums.h"
#include "engine/results/total_sums.h"
#include "engine/step/step_job.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

namespace lsdcd {

// What contacts dissipate, at the places of a pool with n numbers `extra` at each place.
struct LossesInPool {
  const Real *extra;
  int n;
  LSDCD_FN KeptLosses operator[](std::size_t place) const
  {
    KeptLosses losses;
    memcpy(&losses, extra + (place + 1) * n - kKeptLosses, sizeof losses);
    return losses;
  }
};

template <class B>
class ResultsOn : public StepResults {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // The backend must outlive this object.
  explicit ResultsOn(B &backend) : b_(&backend) {}

  // Begins a step of n candidates among these spheres. `candidates`: their indices. `adds_later`: will
  // add_forces() be called? `meshes`: which candidate-mesh pairs are of which mesh; null if there is one mesh.
  void begin(const LawTraits &traits, const StepSettings &step, const Spheres &spheres,
             const int *candidates, std::size_t n, bool may_miss, bool adds_later,
             const CandidateSlots<B> *meshes = nullptr)
  {
    slots_ = meshes;
    has_slots_ = meshes;
    traits_ = traits;
    step_ = step;
    spheres_ = spheres;
    candidates_ = candidates;
    n_ = n;
    totals_known_ = false;
    n_parts_ = 0;
    has_records_ = false;
    n_contacts_.reserve(n);
    if (traits.heat) heat_.reserve(n);
    if (traits.energy) {
      energy_.reserve(n);
      is_booked_.reserve(n);
    }
    if (traits.contacts) first_contact_.reserve(n);
    if (!may_miss)
      uncertain_ = Array<Real>();
    else
      uncertain_.reserve(n);
    const std::size_t room = n_contacts_.size(),
                      numbers = room * ResultColumns::reals(step.per_sphere, adds_later);
    if (numbers_.size() < numbers) numbers_ = Array<Real>(numbers);
    columns_ =
        ResultColumns::of(numbers_.data(), room, step.per_sphere, adds_later, n_contacts_.data());
  }

  // Returns where kernels of the step put up to `most` records, and up to `most_ended` contacts that have ended.
  EnergyRecordList begin_records(std::size_t most, std::size_t most_ended,
                                 const EngineSettings &settings)
  {
    has_records_ = settings.energy_places || settings.impact_speed > 0;
    if (has_records_) {
      records_.reserve(most);
      n_records_.reserve(1);
      put_one(*b_, n_records_.data(), 0);
    }
    if (traits_.losses) {
      ended_there_.reserve(most_ended);
      n_ended_.reserve(1);
      put_one(*b_, n_ended_.data(), 0);
    }
    if (settings.wears_by_impact()) {
      oka_.reserve(1);
      put_one(*b_, oka_.data(), settings.oka);
    }
    return {records_.data(),
            n_records_.data(),
            settings.impact_speed,
            settings.velocity_unit,
            ended_there_.data(),
            n_ended_.data(),
            oka_.data()};
  }
  EnergyRecords energy_records() const override
  {
    if (!B::kOnCpu || !has_records_) return {};
    return {records_.data(), *n_records_.data()};
  }
  EnergyItems energy_items(int mesh, const ImpactBins &bins) const
  {
    return {records_.data(),
            has_records_ ? records_.size() : 0,
            n_records_.data(),
            static_cast<std::uint32_t>(mesh),
            bins,
            {}};
  }

  // Makes a step write its results here. The pool of the step must be set before.
  void put_into(StepJob &job)
  {
    job.result = columns_;
    job.pool.first_contact = first_contact_.data();
    job.heat = heat_.data();
    job.energy = energy_.data();
    job.is_booked = is_booked_.data();
    job.uncertain = uncertain_.data();
  }

  // Adds forces and torques to the spheres, in the order in which a step would add them itself.
  void add_forces(B &b)
  {
    if (n_ == 0) return;
    const std::size_t n_single = slots_ ? slots_->begin(slots_->n_meshes()) : n_;
    const ResultColumns result = columns_;
    const int *candidates = candidates_;
    const StridedView<Real> force = spheres_.force, torque = spheres_.torque;
    const auto add = [=] LSDCD_LAMBDA(std::size_t k) {
      if (result.n_contacts[k] == 0) return;
      const std::size_t i = candidates[k];
      force.add(i, result.force[k]);
      torque.add(i, result.torque[k]);
    };
    b.for_each(n_single, add);
    if (!slots_ || slots_->n_multi_mesh() == 0) return;
    const int *first = slots_->first();
    b.for_each(slots_->n_multi_mesh(), [=] LSDCD_LAMBDA(std::size_t g) {
      for (int k = first[g]; k < first[g + 1]; k++) add(k);
    });
  }

  const Array<int> &n_contacts() const { return n_contacts_; }

  // Copies to the CPU what the step's settings ask for. `contacts`: the pool, in which places between the contacts of a sphere and those of
  // the next one are not written.
  void fetch(B &b, const StepContact *contacts)
  {
    touching_.clear();
    contacts_.clear();
    if (traits_.energy) sum_energy(b);
    if (n_ == 0) return;
    if (step_.per_sphere) fetch_touching(b);
    if (traits_.contacts && step_.contacts) contacts_ = packed_contacts<StepContact>(b, contacts);
  }
  // Copies to the CPU what contacts dissipate, if laws keep losses. `extra`: the numbers of the contacts, with gaps.
  void fetch_losses(B &b, const Real *extra)
  {
    losses_.clear();
    ended_.clear();
    if (n_ == 0 || !step_.contacts) return;
    losses_ = packed_contacts<KeptLosses>(b, LossesInPool{extra, traits_.n_extra});
    fetch_ended(b);
  }

  // Returns the contacts of the last step in memory of the backend. `contacts`: the pool, in which places between the contacts of a sphere
  // and those of the next one are not written.
  NodeContacts node_contacts(const StepContact *contacts, int mesh, const MeshFeaturesView &wall,
                             const Vec3 *velocity) const
  {
    return {candidates_,
            n_,
            n_contacts_.data(),
            first_contact_.data(),
            contacts,
            spheres_.x,
            static_cast<std::uint32_t>(mesh),
            wall,
            velocity};
  }

  // Returns the totals, which are summed on the first request.
  const WallTotals &totals() override
  {
    if (!totals_known_) sum_totals(*b_);
    return totals_;
  }
  WallTotals mesh_totals(int mesh) override
  {
    WallTotals t;
    if (!has_slots_)
      t = totals();
    else
      know_mesh_totals(*b_);
    if (has_slots_ && mesh < static_cast<int>(mesh_totals_.size())) t = mesh_totals_[mesh];
    t.largest_overlap_sphere = -1;
    return t;
  }

  EnergyRows energy(int mesh) override
  {
    const std::size_t k = static_cast<std::size_t>(mesh);
    return k < energy_of_mesh_.size() ? energy_of_mesh_[k] : EnergyRows();
  }

  std::size_t bytes() const
  {
    return energy_.size() * sizeof(EnergyRows) + is_booked_.size() +
           records_.size() * sizeof(EnergyRecord) + ended_there_.size() * sizeof(EndedContact) +
           (numbers_.size() + heat_.size() + uncertain_.size()) * sizeof(Real) +
           (n_contacts_.size() + first_contact_.size() + stored_candidates_.size()) * sizeof(int) +
           oka_.size() * sizeof(OkaWear) + touching_.capacity() * sizeof(TouchingSphere) +
           contacts_.capacity() * sizeof(StepContact) + losses_.capacity() * sizeof(KeptLosses) +
           ended_.capacity() * sizeof(EndedContact) +
           (block_sums_.size() + group_sums_.size() + sums_on_cpu_.size()) * sizeof(UnitTotals) +
           (ranges_.size() + ranges_on_cpu_.size()) * sizeof(TotalsRange);
  }

  // Prepares for a new candidate search: totals stay those of the last step.
  void detach_from_candidates(B &b)
  {
    know_mesh_totals(b);
    if (totals_known_ || n_parts_ == 1 || n_ == 0) return;
    stored_candidates_.reserve(n_);
    copy_all(b, candidates_, stored_candidates_.data(), n_);
    candidates_ = stored_candidates_.data();
  }

  void know_mesh_totals(B &b)
  {
    if (!slots_) return;
    mesh_totals_.assign(slots_->n_meshes(), WallTotals());
    if (n_ > 0 && n_parts_ != slots_->n_meshes()) start_sums(b);
    for (int m = 0; m < slots_->n_meshes() && n_ > 0; m++) mesh_totals_[m] = read_sum(m);
    if (n_parts_ > 1) n_parts_ = 0;
    slots_ = nullptr;
  }

  // The steps of the functions above. Public because nvcc takes no device lambda from a private function.

  // Fetches the touching spheres. The candidate-mesh pairs of a sphere at several meshes follow each other, and
  // make one row.
  void fetch_touching(B &b)
  {
    const std::size_t n = n_;
    Array<char> flags(n);
    Array<int> chosen(n);
    Array<std::uint32_t> count(1);
    char *flag = flags.data();
    const ResultColumns result = columns_;
    const int *candidates = candidates_;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      bool touches = false;
      if (k == 0 || candidates[k - 1] != candidates[k])
        for (std::size_t j = k; j < n && candidates[j] == candidates[k]; j++)
          touches |= result.n_contacts[j] > 0;    // other columns are not written if this is 0
      flag[k] = touches;
    });
    b.compact(n, nullptr, flag, chosen.data(), count.data());
    const std::size_t n_touching = read_one(b, count.data());
    Array<TouchingSphere> rows(n_touching);
    TouchingSphere *to = rows.data();
    const int *at = chosen.data();
    const Real *heat = traits_.heat ? heat_.data() : nullptr;
    const Spheres spheres = spheres_;
    b.for_each(n_touching, [=] LSDCD_LAMBDA(std::size_t m) {
      const std::size_t first = at[m];
      const int i = candidates[first];
      SphereResult all = {};
      Real heat_in = 0;
      for (std::size_t k = first; k < n && candidates[k] == i; k++) {
        if (result.n_contacts[k] == 0) continue;
        const SphereResult r = result.get(k);
        all.n_contacts += r.n_contacts;
        all.force += r.force;
        all.weighted_point += r.weighted_point;
        all.weight += r.weight;
        if (heat) heat_in += heat[k];
      }
      const Vec3 x = spheres.x[i];
      to[m] = {x,
               spheres.radius[i],
               spheres.mass[i],
               all.force,
               all.weight > 0 ? (1 / all.weight) * all.weighted_point : x,
               heat_in,
               i,
               spheres.type ? spheres.type[i] : 0,
               all.n_contacts,
               0};
    });
    touching_ = to_cpu(b, rows, n_touching);
  }

  // Returns from[place] for each contact of the step, at its place in the pool.
  template <class T, class From>
  std::vector<T> packed_contacts(B &b, const From &from)
  {
    const std::size_t n = n_;
    Array<int> offset(n);
    int *at = offset.data();
    const int *n_contacts = n_contacts_.data();
    const int *first_contact = first_contact_.data();
    copy_all(b, n_contacts, at, n);
    const std::size_t total = b.exclusive_scan(at, n);
    // The gaps between contacts were never written.
    Array<T> packed(total);
    T *to = packed.data();
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      for (int c = 0; c < n_contacts[k]; c++) to[at[k] + c] = from[first_contact[k] + c];
    });
    return to_cpu(b, packed, total);
  }

  // Fetches the contacts that have ended, and sorts them, because kernels write them in any order.
  void fetch_ended(B &b)
  {
    ended_ = to_cpu(b, ended_there_, static_cast<std::size_t>(read_one(b, n_ended_.data())));
    std::sort(ended_.begin(), ended_.end(), [](const EndedContact &a, const EndedContact &c) {
      return a.sphere != c.sphere ? a.sphere < c.sphere : a.number < c.number;
    });
  }

  void sum_energy(B &b)
  {
    const std::size_t n_meshes = slots_ ? slots_->n_meshes() : 1;
    energy_of_mesh_.assign(n_meshes, EnergyRows());
    if (n_ == 0) return;
    energy_sums_.sum(b, {n_, energy_.data(), is_booked_.data(), slots_ ? slots_->mesh() : nullptr},
                     n_meshes, energy_of_mesh_.data());
  }

  void sum_totals(B &b)
  {
    totals_known_ = true;
    totals_ = WallTotals();
    if (n_ == 0) return;
    if (n_parts_ != 1) sum(b, 1);
    totals_ = read_sum(0);
  }

  // Starts the sums of each mesh if there are candidate-mesh pairs, else those of all candidates.
  void start_sums(B &b) { sum(b, slots_ ? slots_->n_meshes() : 1); }

  // Starts the sums of one part, which is all candidates, or of as many parts as there are meshes. Does not wait.
  void sum(B &b, int n_parts)
  {
    const std::size_t n_blocks = (n_ + kTotalsBlock - 1) / kTotalsBlock,
                      n_groups = (n_blocks + kTotalsBlock - 1) / kTotalsBlock,
                      parts = static_cast<std::size_t>(n_parts);
    n_parts_ = n_parts;
    n_groups_ = n_groups;
    ranges_.reserve(parts);
    block_sums_.reserve(parts * n_blocks);
    group_sums_.reserve(parts * n_groups);
    ranges_on_cpu_.reserve(parts);
    sums_on_cpu_.reserve(parts * n_groups);
    TotalsRange *range = ranges_.data();
    const TotalsParts in = {
        columns_,         n_, n_blocks, candidates_, n_parts > 1 ? slots_->mesh() : nullptr,
        uncertain_.data()};
    b.for_each(parts, [=] LSDCD_LAMBDA(std::size_t part) { range[part] = TotalsRange(); });
    b.for_each_in_warps(parts * n_blocks, SeeTotals{in, range});
    b.for_each(parts * n_blocks, SumTotals{in, range, block_sums_.data()});
    b.for_each(parts * n_groups,
               SumTotalsOfBlocks{block_sums_.data(), n_blocks, n_groups, group_sums_.data()});
    b.copy_out(ranges_.data(), ranges_on_cpu_.data(), parts);
    b.copy_out(group_sums_.data(), sums_on_cpu_.data(), parts * n_groups);
    if (!are_summed_) are_summed_ = std::make_unique<typename B::Event>();
    are_summed_->record(b);
  }

  // Waits for what was started before start_sums() returned, and for nothing after it.
  WallTotals read_sum(int part) const
  {
    are_summed_->wait();
    UnitTotals total = no_totals();
    const UnitTotals *const groups = sums_on_cpu_.data() + part * n_groups_;
    for (std::size_t k = 0; k < n_groups_; k++) total.add(groups[k]);
    return totals_of(total, ranges_on_cpu_.data()[part]);
  }

 private:
  B *b_;
  LawTraits traits_ = {};
  StepSettings step_;
  Spheres spheres_;
  const int *candidates_ = nullptr;
  std::size_t n_ = 0;

  ResultColumns columns_;
  Array<Real> numbers_, heat_, uncertain_;
  Array<EnergyRows> energy_;    // of each candidate-mesh pair, if the law records energy
  Array<char> is_booked_;
  std::vector<EnergyRows> energy_of_mesh_;
  EnergySums<B> energy_sums_;
  Array<EnergyRecord> records_;
  Array<OkaWear> oka_;    // one, if impacts wear
  Array<EndedContact> ended_there_;
  Array<int> n_records_, n_ended_;
  bool has_records_ = false;    // of the last step
  Array<int> n_contacts_, first_contact_, stored_candidates_;

  WallTotals totals_;
  bool totals_known_ = true;
  int n_parts_ = 0;    // number of sums that were started; 0: none were
  std::size_t n_groups_ = 0;
  Array<TotalsRange> ranges_;                    // of each part
  Array<UnitTotals> block_sums_, group_sums_;    // part after part
  typename B::template CpuArray<TotalsRange> ranges_on_cpu_;
  typename B::template CpuArray<UnitTotals> sums_on_cpu_;
  std::unique_ptr<typename B::Event> are_summed_;
  const CandidateSlots<B> *slots_ = nullptr;    // until their totals are known
  bool has_slots_ = false;
  std::vector<WallTotals> mesh_totals_;
};

}    // namespace lsdcd
