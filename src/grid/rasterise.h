// Which octants of bricks a feature meets.
#pragma once

#include "contact/piece_distance.h"
#include "grid/grid_plan.h"
#include "grid/meets.h"

namespace lsdcd {

// What the kernels of the build share.
struct BuildView {
  WallFeaturesView wall;
  const FeatureCode *features;    // all that can hold a contact, or all pieces
  bool pieces;
  GridPlan plan;
  const std::uint64_t *only;    // a bit per place of the brick table, or null: all bricks
};

// Can a sphere of the grid's reach, centred within `around` of c, have a contact
// on this feature, or touch this piece? If so, `distance` is how far it is from c.
LSDCD_FN bool meets(const BuildView &b, FeatureCode feature, const Vec3 &c, Real around,
                    Real &distance)
{
  if (b.pieces) {
    distance = piece_distance(b.wall, feature, c);
    return distance <= b.plan.reach + b.plan.slack + around;
  }
  return feature_meets(b.wall, feature, c, around + b.plan.slack, b.plan.reach, distance);
}

LSDCD_FN void grow_box(Vec3 &lo, Vec3 &hi, const Vec3 &p)
{
  for (int k = 0; k < 3; k++) {
    if (p[k] < lo[k]) lo[k] = p[k];
    if (p[k] > hi[k]) hi[k] = p[k];
  }
}

LSDCD_FN void feature_box(const WallFeaturesView &wall, FeatureCode feature, Vec3 &lo, Vec3 &hi)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      lo = hi = wall.vertices[wall.face_vertex[i].v[0]].position;
      grow_box(lo, hi, wall.vertices[wall.face_vertex[i].v[1]].position);
      grow_box(lo, hi, wall.vertices[wall.face_vertex[i].v[2]].position);
      return;
    case FeatureKind::edge:
      lo = hi = wall.vertices[wall.edge_vertex[i].v[0]].position;
      grow_box(lo, hi, wall.vertices[wall.edge_vertex[i].v[1]].position);
      return;
    default:
      lo = hi = wall.vertices[i].position;
  }
}

// A brick's octants: what features are sorted into, finer than a brick so that a
// cell has few to try. A key is the brick's number in the table times 8 plus the
// octant; the sort then leaves a brick's octants side by side.
constexpr int kOctantSide = kBrickSide / 2;
constexpr int kOctantCells = kOctantSide * kOctantSide * kOctantSide;

// The cell in its brick of the i-th cell of an octant, x fastest.
LSDCD_FN int cell_of_octant(int octant, int i)
{
  const int x = (octant & 1) * kOctantSide + (i & 3);
  const int y = (octant >> 1 & 1) * kOctantSide + (i >> 2 & 3);
  const int z = (octant >> 2) * kOctantSide + (i >> 4);
  return (z * kBrickSide + y) * kBrickSide + x;
}

// Calls visit(key) for every octant that the feature meets.
template <class Visit>
LSDCD_FN void rasterise(const BuildView &b, FeatureCode feature, Visit visit)
{
  Vec3 lo, hi;
  feature_box(b.wall, feature, lo, hi);
  const GridPlan &plan = b.plan;
  std::int32_t first[3], last[3];
  for (int k = 0; k < 3; k++) {
    // Half a cell more than the reach, so that rounding cannot lose a brick.
    const Real margin = plan.reach + plan.slack + Real(0.5) * plan.length;
    const Real inv = 1 / (kBrickSide * plan.length);
    first[k] = static_cast<std::int32_t>(fmax(Real(0), (lo[k] - margin - plan.origin[k]) * inv));
    last[k] = static_cast<std::int32_t>((hi[k] + margin - plan.origin[k]) * inv);
    if (last[k] >= plan.n_bricks[k]) last[k] = plan.n_bricks[k] - 1;
  }
  const Real quarter = Real(0.5) * kOctantSide * plan.length;
  for (std::int32_t z = first[2]; z <= last[2]; z++)
    for (std::int32_t y = first[1]; y <= last[1]; y++)
      for (std::int32_t x = first[0]; x <= last[0]; x++) {
        const std::uint32_t brick = static_cast<std::uint32_t>(
            (std::size_t(z) * plan.n_bricks[1] + y) * plan.n_bricks[0] + x);
        if (b.only && !(b.only[brick >> 6] >> (brick & 63) & 1)) continue;
        const Vec3 centre = plan.brick_centre(x, y, z);
        Real distance;
        if (!meets(b, feature, centre, kBrickSide * plan.half_diagonal, distance)) continue;
        for (std::uint32_t o = 0; o < 8; o++) {
          const Vec3 at =
              centre + quarter * Vec3{o & 1 ? Real(1) : Real(-1), o & 2 ? Real(1) : Real(-1),
                                      o & 4 ? Real(1) : Real(-1)};
          if (meets(b, feature, at, kOctantSide * plan.half_diagonal, distance))
            visit(brick * 8 + o);
        }
      }
}

}    // namespace lsdcd
