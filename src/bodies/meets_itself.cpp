#include "bodies/meets_itself.h"

#include "bodies/triangles_meet.h"
#include "mesh/box_tree.h"

#include <algorithm>
#include <utility>

namespace lsdcd {

namespace {

using namespace triangles_meet_detail;

Triangle triangle_of(const WallMesh &mesh, int face)
{
  const auto &v = mesh.faces[face];
  return {{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}};
}

// Both begin with what they share.
bool meet_beyond(int shared, const Triangle &a, const Triangle &b)
{
  if (shared == 0) return triangles_meet(a, b);
  // From a common corner whatever else they share goes on to the side across, of one of them.
  if (shared == 1) return segment_meets(a, b[1], b[2]) || segment_meets(b, a[1], a[2]);
  // On both sides of a common edge, unless one is folded upon the other.
  if (orientation(a[0], a[1], a[2], b[2]) != 0) return false;
  const int axis = axis_of_plane(a.corner, 3);
  return orientation_along(axis, a[0], a[1], a[2]) == orientation_along(axis, a[0], a[1], b[2]);
}

// How many corners two faces share, the corners turned so that these come first.
int line_up(const WallMesh &mesh, int f, int g, Triangle &a, Triangle &b)
{
  auto v = mesh.faces[f], w = mesh.faces[g];
  int shared = 0;
  for (int i = 0; i < 3; i++) {
    const auto same = std::find(w.begin() + shared, w.end(), v[i]);
    if (same == w.end()) continue;
    std::swap(w[shared], *same);
    std::swap(v[shared++], v[i]);
  }
  for (int k = 0; k < 3; k++) {
    a.corner[k] = mesh.vertices[v[k]];
    b.corner[k] = mesh.vertices[w[k]];
  }
  return shared;
}

}    // namespace

SelfMeetings meets_itself(const WallMesh &mesh, const std::function<void(double)> &progress)
{
  const int n = static_cast<int>(mesh.faces.size());
  std::vector<Box> boxes(n);
  for (int f = 0; f < n; f++) {
    const Triangle t = triangle_of(mesh, f);
    for (int k = 0; k < 3; k++) {
      boxes[f].lo[k] = std::min({t[0][k], t[1][k], t[2][k]});
      boxes[f].hi[k] = std::max({t[0][k], t[1][k], t[2][k]});
    }
  }
  const BoxTree tree(boxes);
  SelfMeetings out;
  for (int f = 0; f < n; f++) {
    if (progress && f % 1024 == 0) progress(double(f) / n);
    int first = n;
    const auto overlaps = [&](const Box &b) {
      for (int k = 0; k < 3; k++)
        if (b.lo[k] > boxes[f].hi[k] || b.hi[k] < boxes[f].lo[k]) return false;
      return true;
    };
    tree.visit(overlaps, [&](int g) {
      Triangle a, b;
      if (g <= f || !meet_beyond(line_up(mesh, f, g, a, b), a, b)) return;
      out.pairs++;
      first = std::min(first, g);
    });
    if (out.first[0] < 0 && first < n) {
      out.first[0] = f;
      out.first[1] = first;
    }
  }
  return out;
}

}    // namespace lsdcd
