// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/likely_scale.h"

#include "base/input_words.h"
#include "box/outside_box.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace lsdcd {

namespace {

struct Unit {
  Real factor;    // to metres
  const char *name;
};

// Units with which a mesh that is many times too large would have about the size of the box, the likeliest first: inches
// are rare. At least one.
std::vector<Unit> likely_units(const Vec3 &mesh, const Vec3 &box)
{
  // A floor may be far larger than a box along two axes, but no useful wall is along all three. For a
  // mesh that is flat along an axis the other two have to distinguish millimetres from metres.
  constexpr Real kTooLarge = 20, kFlatTooLarge = 300, kFlat = 1e-6;
  Real least = HUGE_VAL, limit = kTooLarge;
  for (int k = 0; k < 3; k++)
    if (mesh[k] > kFlat * norm(mesh))
      least = std::min(least, mesh[k] / box[k]);
    else
      limit = kFlatTooLarge;
  if (!(least > limit)) return {};
  constexpr Real kSmall = 0.1, kLarge = 1.2;    // of the box
  const Unit units[] = {
      {1e-2, "centimetres"}, {1e-3, "millimetres"}, {1e-6, "micrometres"}, {0.0254, "inches"}};
  const Real ratio = norm(mesh) / norm(box);
  const auto miss = [&](const Unit &u) { return std::fabs(std::log(ratio * u.factor)); };
  std::vector<Unit> likely;
  for (const Unit &u : units)
    if (ratio * u.factor >= kSmall && ratio * u.factor <= kLarge) likely.push_back(u);
  if (likely.empty())
    likely.push_back(
        *std::min_element(std::begin(units), std::end(units),
                          [&](const Unit &a, const Unit &b) { return miss(a) < miss(b); }));
  return likely;
}

}    // namespace

Real likely_scale(const Vec3 &mesh, const Vec3 &box)
{
  const std::vector<Unit> likely = likely_units(mesh, box);
  return likely.empty() ? 1 : likely[0].factor;
}

std::string likely_scale_text(const Vec3 &mesh, const PeriodicBox &box)
{
  if (box.any_follows()) return "";
  const Box bounds = box.bounds({0, 0, 0});
  Vec3 extents = mesh, room = bounds.hi - bounds.lo;
  if (box.dimension == 2) {    // an outline may be of any thickness
    extents.z = extents.x;
    room.z = room.x;
  }
  std::string text;
  for (const Unit &u : likely_units(extents, room))
    text += (text.empty() ? "; the file is probably in different units: add scale " : ", or ") +
            number_text(u.factor) + " if they are " + u.name;
  return text;
}

std::string too_large_text(const Vec3 &mesh, const Box &spans, const PeriodicBox &box)
{
  const std::string likely = likely_scale_text(mesh, box);
  if (likely.empty()) return "";
  return "the mesh is far larger than the box: it spans " + extents_text(spans) + ", the box " +
         extents_text(box.bounds({0, 0, 0})) + likely;
}

}    // namespace lsdcd
