// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "clump/molecule_file.h"

#include "base/number_words.h"

#include <functional>

namespace lsdcd {

std::string molecule_text(const std::vector<Ball> &balls, const std::vector<Real> &masses,
                          const MassProperties &clump, int type, const std::string &about)
{
  const auto words = [](const std::vector<Real> &numbers) {
    std::string line;
    for (const Real x : numbers) line += (line.empty() ? "" : " ") + exact_text(x);
    return line;
  };
  const SymmetricMatrix &i = clump.inertia;
  // LAMMPS skips the first line, whatever it has.
  std::string text = "# " + about + "\n\n" + std::to_string(balls.size()) + " atoms\n" +
                     words({clump.mass}) + " mass\n" +
                     words({clump.centre.x, clump.centre.y, clump.centre.z}) + " com\n" +
                     words({i.xx, i.yy, i.zz, i.yz, i.xz, i.xy}) +
                     " inertia    # xx yy zz yz xz xy, as LAMMPS reads them\n";
  const auto section = [&](const char *title, const std::function<std::string(std::size_t)> &row) {
    text += std::string("\n") + title + "\n\n";
    for (std::size_t k = 0; k < balls.size(); k++)
      text += std::to_string(k + 1) + " " + row(k) + "\n";
  };
  section("Coords", [&](std::size_t k) {
    const Vec3 &c = balls[k].centre;
    return words({c.x, c.y, c.z});
  });
  section("Types", [&](std::size_t) { return std::to_string(type); });
  section("Diameters", [&](std::size_t k) { return words({2 * balls[k].radius}); });
  section("Masses", [&](std::size_t k) { return words({masses[k]}); });
  return text;
}

}    // namespace lsdcd
