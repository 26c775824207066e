// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/split_faces.h"

#include "mesh/corners_on_edge.h"
#include "mesh/face_plane.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsdcd {

namespace {

using On = CornersOnEdge::On;

// A triangle, and the corners on its sides; side k goes from corner k to the next.
struct Piece {
  std::array<int, 3> corner;
  std::array<std::vector<On>, 3> on;
};

bool is_open(const WeldedMesh &mesh, std::size_t edge)
{
  return mesh.edge_first[edge + 1] - mesh.edge_first[edge] == 1;
}

class Cutter {
 public:
  Cutter(const WeldedMesh &mesh, SplitFaces &out, CutBefore &before) :
      x_(mesh.vertices), out_(out), before_(before)
  {
  }

  void cut(int face, Piece whole)
  {
    face_ = face;
    normal_ = plane_of(whole).normal;
    std::array<int, 3> corners = whole.corner;
    std::sort(corners.begin(), corners.end());
    if (before_.count(corners))
      for (auto &on : whole.on) on.clear();
    const std::size_t junctions = out_.junctions;
    divide(whole);
    if (out_.junctions == junctions) return;
    out_.faces++;
    before_.insert(corners);
  }

 private:
  FacePlane plane_of(const Piece &p) const
  {
    return face_plane(x_[p.corner[0]], x_[p.corner[1]], x_[p.corner[2]]);
  }
  bool is_good(const Piece &p) const
  {
    const FacePlane plane = plane_of(p);
    return !plane.degenerate && dot(plane.normal, normal_) > 0;
  }

  // Cuts it in two at a corner on one of its sides, the middle corner first.
  void divide(const Piece &p)
  {
    for (int k = 0; k < 3; k++) {
      const auto &on = p.on[k];
      for (std::size_t i = 0; i < on.size(); i++) {
        const std::size_t at = (on.size() / 2 + i) % on.size();
        const int next = (k + 1) % 3, last = (k + 2) % 3, m = on[at].corner;
        const Piece first = {{p.corner[k], m, p.corner[last]},
                             {std::vector<On>(on.begin(), on.begin() + at), {}, p.on[last]}};
        const Piece second = {{m, p.corner[next], p.corner[last]},
                              {std::vector<On>(on.begin() + at + 1, on.end()), p.on[next], {}}};
        if (!is_good(first) || !is_good(second)) continue;
        out_.junctions++;
        out_.moved = std::max(out_.moved, on[at].off);
        divide(first);
        divide(second);
        return;
      }
    }
    out_.corners.insert(out_.corners.end(), p.corner.begin(), p.corner.end());
    out_.face_of.push_back(face_);
  }

  const std::vector<Vec3> &x_;
  SplitFaces &out_;
  CutBefore &before_;
  int face_ = 0;
  Vec3 normal_ = {0, 0, 0};
};

}    // namespace

SplitFaces split_faces(const WeldedMesh &mesh, Real tolerance, CutBefore &before)
{
  std::vector<char> is_end(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (is_open(mesh, e)) is_end[mesh.edges[e][0]] = is_end[mesh.edges[e][1]] = 1;
  const CornersOnEdge corners(mesh.vertices, is_end);

  SplitFaces out;
  Cutter cutter(mesh, out, before);
  for (std::size_t f = 0; f < mesh.faces.size(); f++) {
    Piece whole = {mesh.faces[f], {}};
    for (int k = 0; k < 3; k++)
      if (is_open(mesh, mesh.face_edges[f][k]))
        whole.on[k] = corners.on(whole.corner[k], whole.corner[(k + 1) % 3], tolerance);
    // If the face is thin, its own third corner may be on its side; that is no neighbour's.
    for (int k = 0; k < 3; k++)
      whole.on[k].erase(
          std::remove_if(whole.on[k].begin(), whole.on[k].end(),
                         [&](const On &on) { return on.corner == whole.corner[(k + 2) % 3]; }),
          whole.on[k].end());
    cutter.cut(static_cast<int>(f), whole);
  }
  return out;
}

}    // namespace lsdcd
