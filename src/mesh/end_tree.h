// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of long things, each in the hull of two small boxes, its ends. Where things lie slantwise, boxes around them hold much more
// than they do, and hulls of ends do not.
#pragma once

#include "mesh/box.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lsdcd {

// What lies in the hull of both boxes. One that is not long may have equal ends.
struct Ends {
  Box end[2];

  Box bounds() const
  {
    Box all = end[0];
    extend(all, end[1].lo);
    extend(all, end[1].hi);
    return all;
  }
};

// Of length 1, or 0 where both are one.
Vec3 direction(const Vec3 &from, const Vec3 &to);

// May they have a common point? Of two that are as long as segments it tells exactly, but for those that pass each other at less than
// the sizes of their ends.
bool may_meet(const Ends &a, const Ends &b);

class EndTree {
 public:
  explicit EndTree(const std::vector<Ends> &things);

  Box bounds() const { return around_[1].bounds(); }    // where there is a thing

  // Calls found(i, j) once for every pair of things that may meet.
  template <class Found>
  void visit_pairs(const Found &found) const
  {
    if (!things_.empty()) visit_pairs({1, 0, things_.size()}, found);
  }
  // The same for thing i of this tree and thing j of `other`.
  template <class Found>
  void visit_pairs(const EndTree &other, const Found &found) const
  {
    if (!things_.empty() && !other.things_.empty())
      visit_pairs({1, 0, things_.size()}, other, {1, 0, other.things_.size()}, found);
  }

 private:
  static constexpr std::size_t kLeaf = 4;    // most things of a node without halves

  // A node, and its things. Node n has the halves 2 n and 2 n + 1.
  struct Node {
    std::size_t number, first, last;

    std::size_t size() const { return last - first; }
    Node half(int side) const
    {
      const std::size_t middle = first + size() / 2;
      return {2 * number + side, side ? middle : first, side ? last : middle};
    }
  };

  void build(const Node &node);

  template <class Found>
  void visit_pairs(const Node &node, const Found &found) const
  {
    if (node.size() > kLeaf) {
      visit_pairs(node.half(0), found);
      visit_pairs(node.half(1), found);
      visit_pairs(node.half(0), *this, node.half(1), found);
      return;
    }
    for (std::size_t i = node.first; i < node.last; i++)
      for (std::size_t j = i + 1; j < node.last; j++)
        if (may_meet(things_[i], things_[j])) found(number_[i], number_[j]);
  }
  template <class Found>
  void visit_pairs(const Node &node, const EndTree &other, const Node &its,
                   const Found &found) const
  {
    if (!may_meet(around_[node.number], other.around_[its.number])) return;
    if (std::max(node.size(), its.size()) > kLeaf) {
      for (const int side : {0, 1})
        if (node.size() > its.size())
          visit_pairs(node.half(side), other, its, found);
        else
          visit_pairs(node, other, its.half(side), found);
      return;
    }
    for (std::size_t i = node.first; i < node.last; i++)
      for (std::size_t j = its.first; j < its.last; j++)
        if (may_meet(things_[i], other.things_[j])) found(number_[i], other.number_[j]);
  }

  std::vector<Ends> things_;    // in the order of number_
  std::vector<int> number_;
  std::vector<Ends> around_;    // by node
};

}    // namespace lsdcd
