// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances from a mesh that bounds a volume.
#pragma once

#include "mesh/welded_mesh.h"
#include "mesh/winding_number.h"
#include "tree/triangle_table.h"
#include "tree/triangle_tree.h"

namespace lsdcd {

class InsideMesh {
 public:
  // Borrows the mesh. Throws InputError, with the reason and the remedy, where it has no inside.
  explicit InsideMesh(const WeldedMesh &mesh) :
      mesh_(mesh), winding_(mesh), names_(mesh), tree_(mesh, names_)
  {
  }

  const WeldedMesh &mesh() const { return mesh_; }
  bool holds(const Vec3 &point) const { return winding_.side(point) < 0; }
  Real distance(const Vec3 &point) const
  {
    return tree_.nearest(point, kAnyDistance, kNoPrimitive).distance;
  }
  // Returns the distance inside, and minus the distance outside and on the surface.
  Real depth(const Vec3 &point) const
  {
    const Real d = distance(point);
    return holds(point) ? d : -d;
  }
  // Returns the distance, and sets the nearest point of the mesh.
  Real nearest(const Vec3 &point, Vec3 &at) const
  {
    const TreeAnswer answer = tree_.nearest(point, kAnyDistance, kNoPrimitive);
    Vec3 normal;
    tree_.closest(answer, point, at, normal);
    return answer.distance;
  }

 private:
  const WeldedMesh &mesh_;
  WindingNumber winding_;
  TriangleTable names_;
  TriangleTree tree_;
};

}    // namespace lsdcd
