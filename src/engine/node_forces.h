// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The forces of contacts on the nodes of a mesh: the shares of each contact, in the order of the spheres. The sum of
// a node has three levels, as those of a step have (results/results.h): 32 shares, 32 of these sums, and these in turn,
// so that a GPU, which adds many at once, has the bits of a CPU.
#pragma once

#include "backend/backend.h"
#include "contact/node_field.h"
#include "engine/results/results.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lsdcd {

// The contacts of a step on one mesh. `first_contact`: the first contact of each candidate that has contacts.
struct NodeContacts {
  const int *candidates;    // null: all spheres
  std::size_t n;
  const int *n_contacts, *first_contact;
  const StepContact *contacts;
  StridedView<const Real> x;
  std::uint32_t mesh;
  MeshFeaturesView wall;
  const Vec3 *velocity;    // of the nodes

  LSDCD_FN int count(std::size_t k) const
  {
    const int n_k = n_contacts[k];
    return n_k > 0 && contacts[first_contact[k]].mesh == mesh ? n_k : 0;
  }
  LSDCD_FN NodeShares shares(std::size_t k, const StepContact &contact) const
  {
    return node_shares(wall, contact.feature, x[candidates ? candidates[k] : k] - contact.arm);
  }
};

// Adds up values three numbers each, one after the other, on three levels for each node.
class NodeSums {
 public:
  NodeSums(std::size_t n_nodes, Real *sums) : sums_(sums), n_(n_nodes, 0) {}

  void add(std::int32_t node, Real share, const Vec3 &force)
  {
    int &n = n_[node];
    if (n > 0 && n % kTotalsBlock == 0) end_block(node, n);
    n++;
    for (int d = 0; d < 3; d++) sums_[3 * std::size_t(node) + d] += share * force[d];
  }
  void finish()
  {
    for (std::size_t i = 0; !group_.empty() && i < n_.size(); i++) {
      if (n_[i] <= kTotalsBlock) continue;
      for (std::size_t d = 3 * i; d < 3 * i + 3; d++) sums_[d] = total_[d] + (group_[d] + sums_[d]);
    }
  }

 private:
  void end_block(std::int32_t node, int n)
  {
    if (group_.empty()) {
      group_.assign(3 * n_.size(), 0);
      total_ = group_;
    }
    for (std::size_t d = 3 * std::size_t(node); d < 3 * std::size_t(node) + 3; d++) {
      group_[d] += sums_[d];
      sums_[d] = 0;
      if (n % (kTotalsBlock * kTotalsBlock) != 0) continue;
      total_[d] += group_[d];
      group_[d] = 0;
    }
  }

  Real *sums_;
  std::vector<int> n_;
  std::vector<Real> group_, total_;    // of nodes with more than a block; empty: there are none
};

// Of block `at` of n values.
LSDCD_FN Real sum_of_block(const Real *values, std::size_t at, std::size_t n)
{
  Real sum = 0;
  for (std::size_t k = at * kTotalsBlock; k < (at + 1) * kTotalsBlock && k < n; k++)
    sum += values[k];
  return sum;
}

template <class B>
class NodeForces {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Returns where a CPU can read the contacts. Adds to `forces`, x y z, node after node, and returns the power on the
  // spheres.
  static Real add_on_cpu(const NodeContacts &in, std::size_t n_nodes, Real *forces)
  {
    NodeSums sums(n_nodes, forces);
    std::vector<Real> power(in.n);
    for (std::size_t k = 0; k < in.n; k++) {
      power[k] = 0;
      for (int c = 0; c < in.count(k); c++) {
        const StepContact &contact = in.contacts[in.first_contact[k] + c];
        const NodeShares at = in.shares(k, contact);
        for (int j = 0; j < at.n; j++) sums.add(at.node[j], at.share[j], contact.force);
        power[k] -= dot(contact.force, field_at(at, in.velocity));
      }
    }
    sums.finish();
    for (int level = 0; level < 2; level++) {
      const std::size_t n = power.size();
      for (std::size_t at = 0; at < blocks_of(n); at++)
        power[at] = sum_of_block(power.data(), at, n);
      power.resize(blocks_of(n));
    }
    return sum_of(power.data(), power.size());
  }

  // By the backend, in its memory: the shares of all contacts, sorted by node, which keeps their order. The sums of a few
  // more than the last step had are started before the CPU knows how many there are, and made again if that was too few.
  void sum(B &b, const NodeContacts &in, std::size_t n_nodes)
  {
    n_nodes_ = n_nodes;
    n_powers_ = in.n;
    if (in.n == 0) return clear(b);
    count_shares(b, in);
    for (std::size_t room = room_for(n_shares_);; room = room_for(n_shares_)) {
      sum_shares(b, in, room);
      counted_.wait();
      n_shares_ = *n_on_cpu_.data();
      if (n_shares_ <= room) break;
    }
  }

  // The last sums, if `forces` is not null, and the power on the spheres. Waits.
  Real fetch(B &b, Real *forces)
  {
    const std::size_t n = 3 * n_nodes_, n_sums = sum_power(b);
    on_cpu_.reserve(n + n_sums);
    if (forces) b.copy_out(sums_.data(), on_cpu_.data(), n);
    b.copy_out(power_.data(), on_cpu_.data() + n, n_sums);
    b.wait();
    if (forces) std::copy_n(on_cpu_.data(), n, forces);
    return sum_of(on_cpu_.data() + n, n_sums);
  }
  const Real *sums() const { return sums_.data(); }

  std::size_t bytes() const
  {
    return (powers_.size() + power_.size() + sums_.size()) * sizeof(Real) +
           (offset_.size() + first_.size()) * sizeof(int) + pairs_.bytes() +
           (share_.size() + block_.size() + group_.size()) * sizeof(Vec3);
  }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  void clear(B &b) { put_all(b, reserve(sums_, 3 * n_nodes_), 3 * n_nodes_, 0); }

  // Where the shares of each candidate begin, three a contact, and their number behind these, which goes to the host.
  void count_shares(B &b, const NodeContacts &in)
  {
    const std::size_t n = in.n;
    int *at = reserve(offset_, n + 1);
    b.for_each(n + 1, [=] LSDCD_LAMBDA(std::size_t k) { at[k] = k < n ? 3 * in.count(k) : 0; });
    b.scan(at, n + 1);
    b.copy_out(at + n, n_on_cpu_.data(), 1);
    counted_.record(b);
  }

  // The first `room` shares, where n_nodes stands for a node that there is not, and the power of nodes on each candidate.
  void put_shares(B &b, const NodeContacts &in, std::size_t room)
  {
    Vec3 *share = reserve(share_, room);
    pairs_.reserve(share_.size());
    std::uint32_t *node = pairs_.keys[0].data(), *number = pairs_.values[0].data();
    const int *offset = offset_.data();
    const auto none = static_cast<std::uint32_t>(n_nodes_);
    const std::size_t n = in.n;
    Real *powers = reserve(powers_, n + blocks_of(n));
    b.for_each(std::max(n, room), [=] LSDCD_LAMBDA(std::size_t k) {
      if (k < room) number[k] = static_cast<std::uint32_t>(k);
      if (k < room && k >= static_cast<std::size_t>(offset[n])) node[k] = none;
      if (k >= n) return;
      std::size_t to = offset[k];
      Real power = 0;
      for (int c = 0; c < in.count(k) && to + 3 <= room; c++) {
        const StepContact &contact = in.contacts[in.first_contact[k] + c];
        const NodeShares at = in.shares(k, contact);
        for (int j = 0; j < 3; j++, to++) {
          const bool is_one = j < at.n;
          node[to] = is_one ? static_cast<std::uint32_t>(at.node[j]) : none;
          if (is_one) share[to] = at.share[j] * contact.force;
        }
        power -= dot(contact.force, field_at(at, in.velocity));
      }
      powers[k] = power;
    });
  }

  // Puts sums of groups into power_, and returns how many there are.
  std::size_t sum_power(B &b)
  {
    const std::size_t n = n_powers_;
    const std::size_t n_blocks = blocks_of(n), n_groups = blocks_of(n_blocks);
    Real *of_one = powers_.data(), *of_block = of_one + n, *of_group = reserve(power_, n_groups);
    b.for_each(n_blocks,
               [=] LSDCD_LAMBDA(std::size_t at) { of_block[at] = sum_of_block(of_one, at, n); });
    b.for_each(n_groups, [=] LSDCD_LAMBDA(std::size_t at) {
      of_group[at] = sum_of_block(of_block, at, n_blocks);
    });
    return n_groups;
  }

  // Of each node.
  void sum_shares(B &b, const NodeContacts &in, std::size_t n)
  {
    put_shares(b, in, n);
    const std::size_t n_nodes = n_nodes_;
    const SortedPairs sorted = b.sort_in(n, bits_of(static_cast<std::uint32_t>(n_nodes)), pairs_);
    const std::uint32_t *node = sorted.keys, *number = sorted.values;
    const Vec3 *share = share_.data();
    Vec3 *block = reserve(block_, n), *group = reserve(group_, n);
    int *first = reserve(first_, n_nodes + 2);
    Real *sums = reserve(sums_, 3 * n_nodes);
    // first[i]: the first share of node i, or of a later one that has any.
    b.for_each(n + 1, [=] LSDCD_LAMBDA(std::size_t i) {
      const std::size_t from = i == 0 ? 0 : node[i - 1] + std::size_t(1),
                        to = i == n ? n_nodes + 1 : node[i];
      for (std::size_t v = from; v <= to; v++) first[v] = static_cast<int>(i);
    });
    constexpr int kBlock = kTotalsBlock, kGroup = kBlock * kBlock;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const std::uint32_t of = node[i];
      const int at = static_cast<int>(i), from = first[of], end = first[of + 1];
      if (of == n_nodes || (at - from) % kBlock != 0) return;
      Vec3 sum = {0, 0, 0};
      for (int k = at; k < at + kBlock && k < end; k++) sum += share[number[k]];
      block[i] = sum;
    });
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const std::uint32_t of = node[i];
      const int at = static_cast<int>(i), from = first[of], end = first[of + 1];
      if (of == n_nodes || (at - from) % kGroup != 0) return;
      Vec3 sum = {0, 0, 0};
      for (int k = at; k < at + kGroup && k < end; k += kBlock) sum += block[k];
      group[i] = sum;
    });
    b.for_each(n_nodes, [=] LSDCD_LAMBDA(std::size_t v) {
      Vec3 sum = {0, 0, 0};
      for (int k = first[v]; k < first[v + 1]; k += kGroup) sum += group[k];
      for (int d = 0; d < 3; d++) sums[3 * v + d] = sum[d];
    });
  }

 private:
  template <class T>
  static T *reserve(Array<T> &array, std::size_t n)
  {
    array.reserve(n);
    return array.data();
  }

  static std::size_t blocks_of(std::size_t n) { return (n + kTotalsBlock - 1) / kTotalsBlock; }
  static Real sum_of(const Real *values, std::size_t n)
  {
    Real sum = 0;
    for (std::size_t k = 0; k < n; k++) sum += values[k];
    return sum;
  }

  // A multiple of three, as a contact has.
  static std::size_t room_for(std::size_t n_shares)
  {
    return 3 * (with_spare(n_shares) / 3 + 1024);
  }

  std::size_t n_nodes_ = 0, n_shares_ = 0, n_powers_ = 0;    // of the last step
  Array<Real> powers_, power_, sums_;    // powers_: of candidates, and of blocks
  typename B::template CpuArray<Real> on_cpu_;
  Array<int> offset_, first_;
  Array<Vec3> share_, block_, group_;
  PairMemory<B> pairs_;    // of a node and a share
  typename B::template CpuArray<int> n_on_cpu_ = typename B::template CpuArray<int>(1);
  typename B::Event counted_;    // once it is there
};

}    // namespace lsdcd
