// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How many times a surface that may be open, or broken, winds around a point: the solid angle under which
// it is seen from there, over that of a sphere.
#pragma once

#include "geometry/triangles_meet.h"
#include "mesh/welded_mesh.h"
#include "mesh/winding_number.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace lsdcd {

// It copies what it needs of the mesh, and any number of threads may ask it at once.
//
// Loose edges form loops. Caps of triangles over these close the surface; its winding number, exact, less
// the solid angles of the caps, is that of the mesh (Jacobson, Kavan and Sorkine-Hornung 2013, section 4).
// So a point takes the time of the loose edges, not of the mesh. Where a point is very near an edge of a
// cap, and where there would be as many caps as facets, the solid angles of all facets are added up.
//
// Rounding is all that it is off by: at most 2e-12 for each loose edge; and near the mesh, where facets
// are added up, 1e-15 times the length of an edge over how far it is.
class GeneralizedWinding {
 public:
  explicit GeneralizedWinding(const WeldedMesh &mesh, const ProgressListener &progress = {});

  // A whole number where the mesh has an inside. On the surface the mean of its two sides.
  struct Answer {
    bool on_surface;
    Real number;
  };
  Answer at(const Vec3 &q) const;

  // -1 where the nearest whole number is not 0: probably inside. Else, and on the surface, 1.
  static int side(const Answer &a)
  {
    return a.on_surface || std::fabs(a.number) <= Real(0.5) ? 1 : -1;
  }

 private:
  struct Cap {
    Triangle facet;
    int times;
  };
  Answer add_facets(const Vec3 &q) const;

  std::vector<Cap> caps_;
  std::unique_ptr<const WindingNumber> closed_;    // with the caps; null: there are too many
  std::vector<Triangle> facets_;                   // where that is null
  std::size_t n_facets_;
};

}    // namespace lsdcd
