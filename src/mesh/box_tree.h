// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of boxes around things. A search tests the box around many things before each of them.
#pragma once

#include "mesh/box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lsdcd {

// What a kernel knows of a tree, in memory of its device.
struct BoxTreeView {
  static constexpr std::uint32_t kLeaf = 4;    // most things of a node without halves

  const Box *things, *around;
  std::uint32_t n_things;

  // Does test(box) hold for the box of any thing, and for each box around that?
  template <class Test>
  LSDCD_FN bool any(const Test &test) const
  {
    struct Node {
      std::uint32_t number, first, last;
    } open[32];    // a half is put off at each level, of which there are 30 at most
    int n = 0;
    if (n_things > 0) open[n++] = {1, 0, n_things};
    while (n > 0) {
      const Node node = open[--n];
      if (!test(around[node.number])) continue;
      if (node.last - node.first > kLeaf) {
        const std::uint32_t middle = node.first + (node.last - node.first) / 2;
        open[n++] = Node{2 * node.number + 1, middle, node.last};
        open[n++] = Node{2 * node.number, node.first, middle};
        continue;
      }
      for (std::uint32_t i = node.first; i < node.last; i++)
        if (test(things[i])) return true;
    }
    return false;
  }
};

class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box> &boxes) :
      things_(boxes), number_(boxes.size()), around_(4 * boxes.size() / kLeaf + 4)
  {
    std::iota(number_.begin(), number_.end(), 0);
    if (!boxes.empty()) build(1, 0, boxes.size());
    for (std::size_t i = 0; i < boxes.size(); i++) things_[i] = boxes[number_[i]];
  }

  // Calls found(i) for each thing i whose box, and each box around it, passes may_hold(box).
  template <class MayHold, class Found>
  void visit(MayHold &&may_hold, Found &&found) const
  {
    if (!things_.empty()) visit(root(), may_hold, found);
  }
  // Returns the smallest of `most` and of_thing(i) over all things. of_box(box) is a lower bound of of_thing(i) for the
  // things in the box. The half with the smaller bound is searched first.
  template <class OfBox, class OfThing>
  Real least(Real most, OfBox &&of_box, OfThing &&of_thing) const
  {
    if (!things_.empty() && of_box(bounds()) < most) lower(root(), most, of_box, of_thing);
    return most;
  }
  // Calls found(i, j) once for every pair of things whose boxes overlap.
  template <class Found>
  void visit_pairs(Found &&found) const
  {
    if (!things_.empty()) visit_pairs(root(), found);
  }
  // Calls found(i, j) once for every pair of thing i of this tree and thing j of `other` whose boxes overlap.
  template <class Found>
  void visit_pairs(const BoxTree &other, Found &&found) const
  {
    if (!things_.empty() && !other.things_.empty()) visit_pairs(root(), other, other.root(), found);
  }

  const Box &bounds() const { return around_[1]; }    // where there is a thing
  // Of as many things and boxes as these, as long as the tree is.
  BoxTreeView view() const
  {
    return {things_.data(), around_.data(), static_cast<std::uint32_t>(things_.size())};
  }
  std::size_t n_around() const { return around_.size(); }
  std::size_t bytes() const
  {
    return (things_.capacity() + around_.capacity()) * sizeof(Box) +
           number_.capacity() * sizeof(int);
  }

 private:
  static constexpr std::size_t kLeaf = BoxTreeView::kLeaf;

  // A node, and its things.
  struct Node {
    std::size_t number, first, last;

    std::size_t size() const { return last - first; }
    Node half(int side) const
    {
      const std::size_t middle = first + size() / 2;
      return {2 * number + side, side ? middle : first, side ? last : middle};
    }
  };
  Node root() const { return {1, 0, things_.size()}; }

  // Splits a range in two along the longest side of its box. Node n has the halves 2 n and 2 n + 1.
  void build(std::size_t node, std::size_t first, std::size_t last)
  {
    Box all = things_[number_[first]];
    for (std::size_t i = first; i < last; i++)
      for (const Vec3 &x : {things_[number_[i]].lo, things_[number_[i]].hi}) extend(all, x);
    if (node >= around_.size()) around_.resize(2 * node);
    around_[node] = all;
    if (last - first <= kLeaf) return;
    const Vec3 size = all.hi - all.lo;
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const auto middle = [&](int i) { return things_[i].lo[axis] / 2 + things_[i].hi[axis] / 2; };
    const std::size_t half = first + (last - first) / 2;
    std::nth_element(number_.begin() + first, number_.begin() + half, number_.begin() + last,
                     [&](int i, int j) { return middle(i) < middle(j); });
    build(2 * node, first, half);
    build(2 * node + 1, half, last);
  }

  template <class MayHold, class Found>
  void visit(const Node &node, MayHold &may_hold, Found &found) const
  {
    if (!may_hold(around_[node.number])) return;
    if (node.size() > kLeaf) {
      visit(node.half(0), may_hold, found);
      visit(node.half(1), may_hold, found);
      return;
    }
    for (std::size_t i = node.first; i < node.last; i++)
      if (may_hold(things_[i])) found(number_[i]);
  }
  template <class OfBox, class OfThing>
  void lower(const Node &node, Real &most, OfBox &of_box, OfThing &of_thing) const
  {
    if (node.size() > kLeaf) {
      const Node half[2] = {node.half(0), node.half(1)};
      const Real of_half[2] = {of_box(around_[half[0].number]), of_box(around_[half[1].number])};
      const int first = of_half[1] < of_half[0];
      for (const int i : {first, 1 - first})
        if (of_half[i] < most) lower(half[i], most, of_box, of_thing);
      return;
    }
    for (std::size_t i = node.first; i < node.last; i++)
      if (of_box(things_[i]) < most) most = std::min(most, of_thing(number_[i]));
  }
  template <class Found>
  void visit_pairs(const Node &node, Found &found) const
  {
    if (node.size() > kLeaf) {
      visit_pairs(node.half(0), found);
      visit_pairs(node.half(1), found);
      visit_pairs(node.half(0), *this, node.half(1), found);
      return;
    }
    for (std::size_t i = node.first; i < node.last; i++)
      for (std::size_t j = i + 1; j < node.last; j++)
        if (overlap(things_[i], things_[j])) found(number_[i], number_[j]);
  }
  template <class Found>
  void visit_pairs(const Node &node, const BoxTree &other, const Node &its, Found &found) const
  {
    if (!overlap(around_[node.number], other.around_[its.number])) return;
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
        if (overlap(things_[i], other.things_[j])) found(number_[i], other.number_[j]);
  }

  std::vector<Box> things_;    // in the order of number_
  std::vector<int> number_;
  std::vector<Box> around_;    // by node
};

}    // namespace lsdcd
