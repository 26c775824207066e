// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/periodic_box.h"

namespace lsdcd {

namespace {

// Normal of the faces that edge k joins, of length 1 / width.
Vec3 gradient(const PeriodicBox &box, int k)
{
  const Vec3 area = cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]);
  return (1 / dot(area, box.edge[k])) * area;
}

}    // namespace

Vec3 PeriodicBox::fraction(const Vec3 &x) const
{
  const Vec3 d = x - corner;
  return {dot(gradient(*this, 0), d), dot(gradient(*this, 1), d), dot(gradient(*this, 2), d)};
}

Real PeriodicBox::width(int k) const
{
  return 1 / norm(gradient(*this, k));
}

PeriodicFaces periodic_faces(const PeriodicBox &box)
{
  PeriodicFaces faces;
  faces.corner = box.corner;
  for (int k = 0; k < 3; k++) {
    faces.gradient[k] = gradient(box, k);
    faces.width[k] = box.width(k);
    faces.periodic[k] = box.periodic[k];
  }
  return faces;
}

Box PeriodicBox::bounds(const Vec3 &past) const
{
  Box box = {corner, corner};
  for (int i = 0; i < 8; i++) {
    Vec3 x = corner;
    for (int k = 0; k < 3; k++) {
      const Real part = past[k] / width(k);
      x += (i >> k & 1 ? 1 + part : -part) * edge[k];
    }
    if (i == 0) box = {x, x};
    extend(box, x);
  }
  return box;
}

Box in_fractions(const Box &box, const PeriodicBox &periodic)
{
  Box out = {periodic.fraction(box.lo), periodic.fraction(box.lo)};
  for_corners(box, [&](const Vec3 &x) { extend(out, periodic.fraction(x)); });
  return out;
}

}    // namespace lsdcd
