// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of faces that are close enough to be tested. Boxes tell, but those of long faces that lie slantwise overlap those of many others, and
// those of a fan, the faces round one vertex, all overlap there: without more, n of them would be n^2 / 2 pairs.
#pragma once

#include "mesh/box_tree.h"
#include "mesh/end_tree.h"
#include "mesh/welded_mesh.h"

#include <functional>
#include <memory>
#include <vector>

namespace lsdcd {

Box box_of(const WeldedMesh &mesh, int face);

class CloseFaces {
 public:
  static constexpr int kNone = -1;    // no vertex

  using Found = std::function<void(int f, int g)>;

  // Of these faces. The mesh must outlive it.
  CloseFaces(const WeldedMesh &mesh, const std::vector<int> &faces);

  // Calls found(f, g) once for every pair of these faces that have a point in common beyond their common corners and edge, and for
  // others that are close.
  void visit_pairs(const Found &found) const;
  // The same for every pair of one of these faces and one of `others`.
  void visit_pairs(const CloseFaces &others, const Found &found) const;

 private:
  // The faces of a fan, or the long ones that are of none.
  struct Part {
    int hub;    // the vertex that all faces share; kNone: there is none
    std::vector<int> faces;
    EndTree tree;
  };
  void add_part(int hub, const std::vector<int> &faces);
  EndTree rest_as_ends() const;
  static void visit_pairs(const Part &a, const Part &b, const Found &found);
  // Pairs of one of the rest and one of the parts of `others`.
  void visit_rest(const CloseFaces &others, const Found &found) const;

  const WeldedMesh &mesh_;
  std::vector<Part> parts_;
  std::vector<int> rest_;    // faces of no part
  std::unique_ptr<BoxTree> rest_tree_;
};

}    // namespace lsdcd
