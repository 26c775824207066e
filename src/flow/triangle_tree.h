// Triangles in a tree of boxes: those that meet a box, and how far the nearest is.
#pragma once

#include "base/vec3.h"
#include "mesh/periodic_box.h"

#include <array>
#include <vector>

namespace lsdcd {

using Corners = std::array<Vec3, 3>;

class TriangleTree {
 public:
  explicit TriangleTree(std::vector<Corners> triangles);

  // Calls f(corners) for each triangle whose bounds meet the box.
  template <class F>
  void for_each_in(const Box &box, F &&f) const
  {
    int stack[kDepth], n = 0;
    stack[n++] = 0;
    while (n > 0) {
      const int at = stack[--n];
      const Node &node = nodes_[at];
      if (!meet(node.bounds, box)) continue;
      if (node.count == 0) {
        stack[n++] = node.second;
        stack[n++] = at + 1;
      }
      for (int t = node.first; t < node.first + node.count; t++)
        if (meet(bounds_of(triangles_[t]), box)) f(triangles_[t]);
    }
  }

  // Distance from q to the nearest triangle, or `within` where none is nearer. Rounded.
  Real distance(const Vec3 &q, Real within) const;

  const Box &bounds() const { return nodes_[0].bounds; }
  std::size_t bytes() const
  {
    return triangles_.capacity() * sizeof(Corners) + nodes_.capacity() * sizeof(Node);
  }

 private:
  static constexpr int kDepth = 64;    // halves of as many triangles as an int can count, and more
  struct Node {
    Box bounds;
    int first, count;    // of its triangles; count 0: two nodes, this one's next and `second`
    int second;
  };

  static bool meet(const Box &a, const Box &b)
  {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
           a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
  }
  static Box bounds_of(const Corners &triangle);
  void build(int first, int last);

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

}    // namespace lsdcd
