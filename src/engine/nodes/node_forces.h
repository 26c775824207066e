// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The forces of contacts on the nodes of a mesh. Each contact's force is divided by the shares of its nodes and added in
// fixed point (sum_unit.h). The unit follows from the shares of this step, on all processes if sums are over all of them.
// So a sum has the same bits on any backend and any number of threads and processes, and nothing is kept between steps.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "backend/threads.h"
#include "backend/warp.h"
#include "contact/node_field.h"
#include "engine/nodes/shared_items.h"
#include "engine/results/result_columns.h"
#include "engine/results/step_counts.h"
#include "engine/results/sum_unit.h"
#include "mesh/face_pressure.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lsdcd {

// The contacts of a step on one mesh. `first_contact`: the first contact of each candidate that has contacts.
struct NodeContacts {
  const int *candidates;    // the sphere of each
  std::size_t n;
  const int *n_contacts, *first_contact;
  const StepContact *contacts;
  StridedView<const Real> x;
  std::uint32_t mesh;
  MeshFeaturesView wall;
  const Vec3 *velocity;    // of the nodes

  LSDCD_FN std::size_t sphere(std::size_t k) const { return candidates[k]; }
  LSDCD_FN int count(std::size_t k) const
  {
    const int n_k = n_contacts[k];
    return n_k > 0 && contacts[first_contact[k]].mesh == mesh ? n_k : 0;
  }
  // Prefetches, on a CPU, the record of the first contact of a candidate whose turn comes soon.
  LSDCD_FN void prefetch_ahead([[maybe_unused]] std::size_t k) const
  {
#if !LSDCD_ON_GPU()
    constexpr std::size_t kAhead = 8;
    if (k + kAhead < n && n_contacts[k + kAhead] > 0)
      prefetch(wall, contacts[first_contact[k + kAhead]].feature);
#endif
  }
  LSDCD_FN NodeShares shares(std::size_t k, const StepContact &contact) const
  {
    return node_shares(wall, contact.feature, x[sphere(k)] - contact.arm);
  }
};

// Stores the power of the nodes on each candidate, and finds the range of the shares. A thread reads several candidates,
// so that few threads raise the same number at once. Also clears the sums, and the range of the next step.
struct SeeNodeForces {
  NodeContacts in;
  std::size_t n_threads, n_sums;
  Real *powers;
  std::int64_t *sums;
  NodeForceRange *range, *next_range;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t t) const
  {
    if (mine && t == 0) *next_range = NodeForceRange();
    std::uint32_t contacts = 0;
    unsigned exponent = 0;
    for_each_of_thread(warp, t, n_threads, mine ? n_sums : 0, [&](std::size_t k) { sums[k] = 0; });
    for_each_of_thread(warp, t, n_threads, mine ? in.n : 0, [&](std::size_t k) {
      in.prefetch_ahead(k);
      Real power = 0;
      const int n = in.count(k);
      for (int c = 0; c < n; c++) see(k, in.contacts[in.first_contact[k] + c], exponent, power);
      powers[k] = power;
      contacts += n;
    });
    if (contacts > 0) add_to(&range->shares.count, contacts);
    exponent = warp.largest(exponent);
    if (warp.rank() == 0) raise_to(&range->shares.exponent, exponent);
  }

 private:
  LSDCD_FN void see(std::size_t k, const StepContact &contact, unsigned &exponent,
                    Real &power) const
  {
    const NodeShares at = in.shares(k, contact);
    unsigned most = 0;
    for (int j = 0; j < 3; j++)
      for (int d = 0; d < 3 && j < at.n; d++) {
        const unsigned e = exponent_field(at.share[j] * contact.force[d]);
        if (e > most) most = e;
      }
    if (most == kNotFinite) raise_to(&range->not_finite, kNoSphere - in.sphere(k));
    if (most > exponent) exponent = most;
    power -= dot(contact.force, field_at(at, in.velocity));
  }
};

// Adds the shares of each candidate. Threads that have the same node first add theirs together: otherwise many contacts
// of a coarse mesh would wait for each other at few nodes.
struct AddNodeForces {
  NodeContacts in;
  const NodeForceRange *range;
  std::int64_t *sums;
  bool is_alone;    // is this the only thread?

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    if (mine) in.prefetch_ahead(k);
    const int n = mine ? in.count(k) : 0;
    if (!warp.any(n > 0)) return;
    const SumUnit unit(range->shares);
    if (!unit.is_finite()) return;
    for (int c = 0; warp.any(c < n); c++) {
      NodeShares at = {};
      Vec3 force = {0, 0, 0};
      if (c < n) {
        const StepContact &contact = in.contacts[in.first_contact[k] + c];
        at = in.shares(k, contact);
        force = contact.force;
      }
      for (int j = 0; j < 3; j++) {
        std::int64_t units[3] = {0, 0, 0};
        const bool has = j < at.n;
        for (int d = 0; has && d < 3; d++) units[d] = unit.units(at.share[j] * force[d]);
        if (warp.sum_by_key(has, at.node[j], units)) add(at.node[j], units);
      }
    }
  }

 private:
  LSDCD_FN void add(std::int32_t node, const std::int64_t (&units)[3]) const
  {
    std::int64_t *to = sums + 3 * std::size_t(node);
    for (int d = 0; d < 3; d++) {
      if (is_alone)
        to[d] += units[d];
      else
        add_signed(to + d, units[d]);
    }
  }
};

// Stores the sums of blocks of values, each added in order.
struct SumBlocks {
  const Real *values;
  std::size_t n;
  Real *sums;

  LSDCD_FN void operator()(std::size_t at) const
  {
    Real sum = 0;
    for (std::size_t k = at * kTotalsBlock; k < (at + 1) * kTotalsBlock && k < n; k++)
      sum += values[k];
    sums[at] = sum;
  }
};

// Computes the force on the node of row k: of contacts, and of faces that push it, in the order of their numbers, as on a
// host.
struct ForceOfNode {
  const int *faces, *first, *around;
  const Vec3 *at;
  const std::int64_t *sums;
  const NodeForceRange *range;
  const int *node_of_row;
  Real sixth;
  Real *to;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = node_of_row[k];
    const SumUnit unit(range->shares);
    Vec3 sum;
    for (int d = 0; d < 3; d++) sum[d] = unit.value(sums[3 * i + d]);
    for (int m = first[i]; sixth != 0 && m < first[i + 1]; m++)
      sum += corner_share_of_pressure(faces + 3 * std::size_t(around[m]), at, sixth);
    for (int d = 0; d < 3; d++) to[3 * k + d] = sum[d];
  }
};

template <class B>
class NodeForces {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Finds the range of the contacts of a step on this process, and drops those of the last step.
  void see(B &b, const NodeContacts &in, std::size_t n_nodes)
  {
    if (ranges_.size() == 0) ranges_ = from_cpu(b, std::vector<NodeForceRange>(2));
    now_ = 1 - now_;
    in_ = in;
    n_sums_ = 3 * n_nodes;
    sums_.reserve(n_sums_);
    powers_.reserve(in.n + blocks_of(in.n));
    const std::size_t n = threads_for<B>(std::max(in.n, n_sums_), kMostThreads);
    b.for_each_in_warps(n, SeeNodeForces{in, n, n_sums_, powers_.data(), sums_.data(), range_now(),
                                         ranges_.data() + 1 - now_});
    b.copy_out(range_now(), range_on_cpu_.data(), 1);
    seen_.record(b);
  }

  // Returns the range that was found. Waits for it.
  NodeForceRange range() const
  {
    seen_.wait();
    return *range_on_cpu_.data();
  }

  // Adds up the contacts, in units that follow from this range, or if it is null from the one that was found. Does not
  // wait.
  void add(B &b, const NodeForceRange *of_all)
  {
    if (of_all) put_one(b, range_now(), *of_all);
    b.for_each_in_warps(in_.n,
                        AddNodeForces{in_, range_now(), sums_.data(), B::kOnCpu && threads() == 1});
  }

  // Copies the last sums to the CPU, in units, and returns the power on the spheres. Waits.
  Real fetch(B &b, std::int64_t *sums)
  {
    const std::size_t n = in_.n, n_blocks = blocks_of(n), n_groups = blocks_of(n_blocks);
    Real *of_one = powers_.data(), *of_block = of_one + n;
    power_.reserve(n_groups);
    power_on_cpu_.reserve(n_groups);
    b.for_each(n_blocks, SumBlocks{of_one, n, of_block});
    b.for_each(n_groups, SumBlocks{of_block, n_blocks, power_.data()});
    b.copy_out(power_.data(), power_on_cpu_.data(), n_groups);
    b.copy_out(sums_.data(), sums, n_sums_);
    b.wait();
    Real power = 0;
    for (std::size_t k = 0; k < n_groups; k++) power += power_on_cpu_.data()[k];
    return power;
  }

  // Return the last sums, in units, and their range, where the backend has them.
  const std::int64_t *sums() const { return sums_.data(); }
  const NodeForceRange *range_in_place() const { return ranges_.data() + now_; }

  std::size_t bytes() const
  {
    return (powers_.size() + power_.size()) * sizeof(Real) + sums_.size() * sizeof(std::int64_t) +
           ranges_.size() * sizeof(NodeForceRange);
  }

 private:
  static constexpr std::size_t kMostThreads = 1 << 17;

  static std::size_t blocks_of(std::size_t n) { return (n + kTotalsBlock - 1) / kTotalsBlock; }
  NodeForceRange *range_now() { return ranges_.data() + now_; }

  NodeContacts in_ = {};    // of the last step; not read afterwards
  std::size_t n_sums_ = 0;
  int now_ = 0;                     // index of the range of the last step; the other one is clear
  Array<NodeForceRange> ranges_;    // two
  Array<std::int64_t> sums_;        // in units, x y z, node after node
  Array<Real> powers_,
      power_;    // powers_: of candidates, and of blocks; power_: of groups of these
  typename B::template CpuArray<Real> power_on_cpu_;
  typename B::template CpuArray<NodeForceRange> range_on_cpu_ =
      typename B::template CpuArray<NodeForceRange>(1);
  typename B::Event seen_;    // the range has been found
};

}    // namespace lsdcd
