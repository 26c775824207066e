// Things in boxes: those that a question may be about, found by asking of boxes around many first.
#pragma once

#include "mesh/periodic_box.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lsdcd {

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
    if (!things_.empty()) visit(1, 0, things_.size(), may_hold, found);
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  // Halves of a range along the longest side of what is in it; node n has 2 n and 2 n + 1.
  void build(std::size_t node, std::size_t first, std::size_t last)
  {
    Box all = things_[number_[first]];
    for (std::size_t i = first; i < last; i++)
      for (int k = 0; k < 3; k++) {
        all.lo[k] = std::min(all.lo[k], things_[number_[i]].lo[k]);
        all.hi[k] = std::max(all.hi[k], things_[number_[i]].hi[k]);
      }
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
  void visit(std::size_t node, std::size_t first, std::size_t last, MayHold &may_hold,
             Found &found) const
  {
    if (!may_hold(around_[node])) return;
    if (last - first > kLeaf) {
      const std::size_t half = first + (last - first) / 2;
      visit(2 * node, first, half, may_hold, found);
      visit(2 * node + 1, half, last, may_hold, found);
      return;
    }
    for (std::size_t i = first; i < last; i++)
      if (may_hold(things_[i])) found(number_[i]);
  }

  std::vector<Box> things_;    // in the order of number_
  std::vector<int> number_;
  std::vector<Box> around_;    // by node
};

}    // namespace lsdcd
