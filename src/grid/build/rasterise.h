// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The octants and cells of bricks that a feature meets, from large boxes to small ones: the paper's culling. Its formula (4)
// leaves out cells of length 2 L that are farther than R + sqrt(3) L from all triangles, half their diagonal more
// than the largest radius R, and only divides the others. Here bricks come first, then octants, blocks of 2 x 2 x 2 cells
// and cells, all by the same bound.
#pragma once

#include "backend/bits.h"
#include "geometry/feature_box.h"
#include "geometry/primitive_distance.h"
#include "grid/build/meets.h"
#include "grid/build/primitive_bounds.h"
#include "grid/plan/grid_plan.h"

#include <cstring>

namespace lsdcd {

// What says whether a cell lists a feature: its region, as a contact needs; the distance of a primitive; or the bounds of
// a primitive that moves.
enum class CellTest { regions, distances, bounds };

// The input of all kernels of the build.
struct BuildView {
  MeshFeaturesView wall;
  const FeatureCode *features;    // all that can hold a contact, or all primitives
  CellTest test;
  GridPlan plan;
};

// Can a sphere of the grid's cutoff, centred within `around` of c, have a contact
// on this feature, or touch this primitive? If so, `distance` is how far it is from c. With half the diagonal of a box
// around c as `around`, this is formula (4) of the paper.
LSDCD_FN bool meets(const BuildView &b, FeatureCode feature, const Vec3 &c, Real around,
                    Real &distance)
{
  if (b.test == CellTest::distances) {
    distance = primitive_distance(b.wall, feature, c);
    return distance <= b.plan.cutoff + b.plan.tolerance + around;
  }
  return feature_meets(b.wall, feature, c, around + b.plan.widened(), b.plan.cutoff, distance);
}

// A brick's octants: what features are sorted into, finer than a brick so that a
// cell has few to try. A key is the brick's number in the table times 8 plus the
// octant; the sort then leaves a brick's octants side by side.
constexpr int kOctantSide = kBrickSide / 2;
constexpr int kOctantCells = kOctantSide * kOctantSide * kOctantSide;

// Returns the cell in its brick of the i-th cell of an octant, x fastest.
LSDCD_FN int cell_of_octant(int octant, int i)
{
  const int x = (octant & 1) * kOctantSide + (i & 3);
  const int y = (octant >> 1 & 1) * kOctantSide + (i >> 2 & 3);
  const int z = (octant >> 2) * kOctantSide + (i >> 4);
  return (z * kBrickSide + y) * kBrickSide + x;
}

// The bricks that overlap a feature's box widened by the cutoff.
struct BrickBox {
  std::int32_t first[3], n[3];

  LSDCD_FN std::uint64_t count() const { return std::uint64_t(n[0]) * n[1] * n[2]; }
};

LSDCD_FN BrickBox brick_box(const BuildView &b, FeatureCode feature)
{
  Vec3 lo, hi;
  feature_box(b.wall, feature, lo, hi);
  const GridPlan &plan = b.plan;
  BrickBox box;
  for (int k = 0; k < 3; k++) {
    // Half a cell more than the cutoff, so that rounding cannot lose a brick.
    const Real margin = plan.cutoff + plan.widened() + Real(0.5) * plan.length;
    const Real inv = 1 / (kBrickSide * plan.length);
    // The grid may be cut off where no sphere can be.
    const Real from = (lo[k] - margin - plan.origin[k]) * inv,
               to = (hi[k] + margin - plan.origin[k]) * inv, n = plan.n_bricks[k];
    box.first[k] = static_cast<std::int32_t>(smaller(larger(from, 0), n));
    const std::int32_t last = static_cast<std::int32_t>(smaller(larger(to, -1), n - 1));
    box.n[k] = to >= 0 && last >= box.first[k] ? last - box.first[k] + 1 : 0;
  }
  return box;
}

// Returns the index in the table of the i-th brick of a box.
LSDCD_FN std::uint32_t brick_index(const GridPlan &plan, const BrickBox &box, std::uint64_t i)
{
  const std::uint64_t x = box.first[0] + i % box.n[0], y = box.first[1] + i / box.n[0] % box.n[1],
                      z = box.first[2] + i / box.n[0] / box.n[1];
  return static_cast<std::uint32_t>((z * plan.n_bricks[1] + y) * plan.n_bricks[0] + x);
}

// Returns the part of a span of cells that lies in an octant, from the octant's first cell on.
LSDCD_FN CellSpan in_octant(const GridPlan &plan, const CellSpan &cells, std::uint32_t octant_key)
{
  const CellCentres brick(plan, octant_key >> 3);
  const std::uint32_t first[3] = {brick.x, brick.y, brick.z};
  CellSpan part;
  for (int d = 0; d < 3; d++) {
    const std::int32_t from = static_cast<std::int32_t>(first[d]) +
                              static_cast<std::int32_t>(octant_key >> d & 1) * kOctantSide,
                       lo = cells.lo[d] - from, hi = cells.hi[d] - from;
    part.lo[d] = lo < 0 ? 0 : lo;
    part.hi[d] = hi > kOctantSide ? kOctantSide : hi;
  }
  return part;
}

// Returns the octants of a brick that a primitive that moves reaches, a bit each.
LSDCD_FN unsigned octants_reached(const BuildView &b, FeatureCode primitive, std::uint32_t index)
{
  const CellSpan cells = cells_reached(b.plan, PrimitiveBounds(b.wall, primitive));
  unsigned reached = 0;
  for (unsigned o = 0; o < 8; o++)
    if (!in_octant(b.plan, cells, index * 8 + o).is_empty()) reached |= 1u << o;
  return reached;
}

// Returns the octants of a brick that the feature meets, a bit each.
LSDCD_FN unsigned octants_met(const BuildView &b, FeatureCode feature, std::uint32_t index)
{
  if (b.test == CellTest::bounds) return octants_reached(b, feature, index);
  const GridPlan &plan = b.plan;
  const std::uint32_t nx = plan.n_bricks[0], ny = plan.n_bricks[1];
  const Vec3 centre = plan.brick_centre(static_cast<std::int32_t>(index % nx),
                                        static_cast<std::int32_t>(index / nx % ny),
                                        static_cast<std::int32_t>(index / nx / ny));
  Real distance;
  if (!meets(b, feature, centre, kBrickSide * plan.half_diagonal, distance)) return 0;
  const Real quarter = Real(0.5) * kOctantSide * plan.length;
  unsigned met = 0;
  for (unsigned o = 0; o < 8; o++) {
    const Vec3 at = centre + quarter * Vec3{o & 1 ? Real(1) : Real(-1), o & 2 ? Real(1) : Real(-1),
                                            o & 4 ? Real(1) : Real(-1)};
    if (meets(b, feature, at, kOctantSide * plan.half_diagonal, distance)) met |= 1u << o;
  }
  return met;
}

// The cells of an octant for which meets(centre, half diagonal) is true, a bit each in the order of
// cell_of_octant. Blocks of 2 x 2 x 2 cells are tested first: most are far from the feature.
template <class Meets>
LSDCD_FN std::uint64_t cells_where(const GridPlan &plan, std::uint32_t octant_key,
                                   const Meets &meets)
{
  const CellCentres centres(plan, octant_key >> 3);
  const int octant = octant_key & 7;
  const Real half = Real(0.5) * plan.length;
  std::uint64_t met = 0;
  for (int block = 0; block < 8; block++) {
    const int first = (block & 1) * 2 + (block & 2) * 4 + (block & 4) * 8;
    const Vec3 at = centres.at(cell_of_octant(octant, first)) + Vec3{half, half, half};
    if (!meets(at, 2 * plan.half_diagonal)) continue;
    for (int c = 0; c < 8; c++) {
      const int k = first + (c & 1) + (c & 2) * 2 + (c & 4) * 4;
      if (meets(centres.at(cell_of_octant(octant, k)), plan.half_diagonal))
        met |= std::uint64_t(1) << k;
    }
  }
  return met;
}

// Returns the cells of an octant that a primitive that moves reaches.
LSDCD_FN std::uint64_t moving_cells(const GridPlan &plan, std::uint32_t octant_key,
                                    const PrimitiveBounds &of)
{
  const CellSpan cells = in_octant(plan, cells_reached(plan, of), octant_key);
  const CellCentres centres(plan, octant_key >> 3);
  const Vec3 &normal = of.normal;
  const Real most = reach_of_moving(plan) +
                    Real(0.5) * plan.length * (fabs(normal.x) + fabs(normal.y) + fabs(normal.z));
  std::uint64_t reached = 0;
  for (int z = cells.lo[2]; z < cells.hi[2]; z++)
    for (int y = cells.lo[1]; y < cells.hi[1]; y++)
      for (int x = cells.lo[0]; x < cells.hi[0]; x++) {
        const int k = (z * kOctantSide + y) * kOctantSide + x;
        if (!(of.off_plane(centres.at(cell_of_octant(octant_key & 7, k))) > most))
          reached |= std::uint64_t(1) << k;
      }
  return reached;
}

// Returns the bits of x: below 0 if x is.
inline std::int64_t sign_of(Real x)
{
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

// Returns the cells of an octant that a face meets. It has the bits of 64 calls of face_meets(), but the cells of a
// column share what x and y add to each half-space, and a processor tests several at once.
inline std::uint64_t face_cells(const GridPlan &plan, std::uint32_t octant_key,
                                const FaceRecord &face)
{
  constexpr int kColumns = kOctantSide * kOctantSide;
  const CellCentres centres(plan, octant_key >> 3);
  Vec3 d[kOctantSide];    // of the cells on the diagonal, from which the others follow
  for (int i = 0; i < kOctantSide; i++) {
    const int on_diagonal = i * (1 + kOctantSide + kColumns);
    d[i] = centres.at(cell_of_octant(octant_key & 7, on_diagonal)) - face.anchor;
  }
  const Vec3 normal[4] = {face.inward[0], face.inward[1], face.inward[2], face.normal};
  Real of_column[4][kColumns];
  for (int h = 0; h < 4; h++)
    for (int c = 0; c < kColumns; c++)
      of_column[h][c] = normal[h].x * d[c % kOctantSide].x + normal[h].y * d[c / kOctantSide].y;

  const Real around = plan.half_diagonal + plan.widened(), reach = plan.cutoff + around;
  Real past[3];
  for (int k = 0; k < 3; k++)
    past[k] = square_of_past(2 + 2 * dot(face.inward[k], face.inward[(k + 1) % 3]), around);
  std::uint64_t met = 0;
  for (int z = 0; z < kOctantSide; z++) {
    const Real up[4] = {normal[0].z * d[z].z, normal[1].z * d[z].z, normal[2].z * d[z].z,
                        normal[3].z * d[z].z};
    // Below 0 if a test fails. With signs in place of branches compilers vectorise over cells.
    std::int64_t fails[kColumns];
    for (int c = 0; c < kColumns; c++) {
      const Real s[3] = {-(of_column[0][c] + up[0]), -(of_column[1][c] + up[1]) - face.height,
                         -(of_column[2][c] + up[2])};
      std::int64_t fail = sign_of(reach - fabs(of_column[3][c] + up[3]));
      for (int k = 0; k < 3; k++) {
        const Real sum = s[k] + s[(k + 1) % 3];
        fail |= sign_of(around - s[k]) | (sign_of(past[k] - sum * sum) & ~sign_of(sum));
      }
      fails[c] = fail;
    }
    for (int c = 0; c < kColumns; c++)
      met |= static_cast<std::uint64_t>(fails[c] >= 0) << (z * kColumns + c);
  }
  return met;
}

// Returns the cells of an octant that the feature meets. The record is read once for all of them.
LSDCD_FN std::uint64_t cells_met(const BuildView &b, FeatureCode feature, std::uint32_t octant_key)
{
  const Real cutoff = b.plan.cutoff, widened = b.plan.widened();
  const std::uint32_t i = feature_index(feature);
  Real distance;
  if (b.test == CellTest::bounds)
    return moving_cells(b.plan, octant_key, PrimitiveBounds(b.wall, feature));
  if (b.test == CellTest::distances)
    return cells_where(b.plan, octant_key, [&](const Vec3 &c, Real around) {
      return meets(b, feature, c, around, distance);
    });
  switch (feature_kind(feature)) {
    case FeatureKind::face: {
      const FaceRecord face = b.wall.faces[i];
#if !LSDCD_ON_GPU()
      return face_cells(b.plan, octant_key, face);
#else
      return cells_where(b.plan, octant_key, [&](const Vec3 &c, Real around) {
        return face_meets(face, c, around + widened, cutoff, distance);
      });
#endif
    }
    case FeatureKind::edge: {
      const EdgeRecord edge = b.wall.edges[i];
      return cells_where(b.plan, octant_key, [&](const Vec3 &c, Real around) {
        return edge_meets(edge, b.wall.edge_inward, c, around + widened, cutoff, distance);
      });
    }
    default: {
      const VertexRecord vertex = b.wall.vertices[i];
      return cells_where(b.plan, octant_key, [&](const Vec3 &c, Real around) {
        return vertex_meets(vertex, b.wall.vertex_direction, c, around + widened, cutoff, distance);
      });
    }
  }
}

}    // namespace lsdcd
