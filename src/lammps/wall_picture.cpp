// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/wall_picture.h"

#include "wall/wall.h"

#include <algorithm>

using namespace LAMMPS_NS;

int WallPicture::draw(const lsdcd::Wall &wall, int *&kinds, double **&rows)
{
#if LSDCD_HOST_VERSION >= 20251001
  constexpr int kLine = 2, kTriangle = 3;    // Graphics::LINE, Graphics::TRI
#else
  constexpr int kLine = 1, kTriangle = 2;
#endif
  constexpr int kRow = 10;
  const bool faces = spec.draw == lsdcd::Draw::faces, first = !is_drawn();
  const auto changes = [](const lsdcd::MeshPart &m) { return m.moves() || m.surface->changes(); };
  if (first || std::any_of(wall.meshes().begin(), wall.meshes().end(), changes)) {
    const int corners = faces ? 3 : 2;
    data.clear();
    row.clear();
    for (const lsdcd::MeshPart &m : wall.meshes()) {
      if (first) objects.push_back(lsdcd::draw_mesh(*m.mesh(), spec.draw));
      if (!first && m.surface->changes()) objects[m.index] = lsdcd::draw_mesh(*m.mesh(), spec.draw);
      for (lsdcd::ImageObject one : objects[m.index]) {
        lsdcd::Vec3 centre = {0, 0, 0};
        for (lsdcd::Vec3 &c : one.corner) c = m.pose().to_box(c);
        for (int k = 0; k < corners; k++) centre += (1.0 / corners) * one.corner[k];
        if (spec.cut && dot(spec.cut_normal, centre) > spec.cut_offset) continue;
        data.push_back(spec.type);
        for (const lsdcd::Vec3 &c : one.corner) data.insert(data.end(), {c.x, c.y, c.z});
      }
    }
    kind.assign(data.size() / kRow, faces ? kTriangle : kLine);
    for (std::size_t i = 0; i < data.size(); i += kRow) row.push_back(data.data() + i);
  }
  kinds = kind.data();
  rows = row.data();
  return static_cast<int>(kind.size());
}
