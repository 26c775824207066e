// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "rigid/step_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {

void ContactSum::add(const Mobility &body, const Vec3 &x, const Vec3 &n, Real k)
{
  add(n, cross(x - body.point, n), k);
}

void ContactSum::add(const Vec3 &shift, const Vec3 &turn, Real k)
{
  const Real j[6] = {shift.x, shift.y, shift.z, turn.x, turn.y, turn.z};
  Real *next = number;
  for (int a = 0; a < 6; a++)
    for (int b = a; b < 6; b++) *next++ += k * j[a] * j[b];
}

// M^-1 K has the eigenvalues of S K S, with S S = M^-1.
Real ContactSum::largest(const Mobility &body) const
{
  const auto root = [](Real value) { return std::sqrt(std::max(Real(0), value)); };
  Real k[6][6], s[6][6] = {}, product[6][6] = {}, both[6][6] = {}, vectors[6][6];
  const Real *next = number;
  for (int a = 0; a < 6; a++)
    for (int b = a; b < 6; b++) k[a][b] = k[b][a] = *next++;
  const SymmetricMatrix *part[2] = {&body.shifts, &body.turns};
  for (int p = 0; p < 2; p++) {
    const SymmetricMatrix m = function_of(*part[p], root);
    const Real row[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) s[3 * p + a][3 * p + b] = row[a][b];
  }
  for (int a = 0; a < 6; a++)
    for (int b = 0; b < 6; b++)
      for (int c = 0; c < 6; c++) product[a][b] += s[a][c] * k[c][b];
  for (int a = 0; a < 6; a++)
    for (int b = 0; b < 6; b++)
      for (int c = 0; c < 6; c++) both[a][b] += product[a][c] * s[c][b];
  for (int a = 0; a < 6; a++)
    for (int b = 0; b < 6; b++)
      if (!std::isfinite(both[a][b])) return HUGE_VAL;    // beyond any timestep
  for (int a = 0; a < 6; a++)
    for (int b = 0; b < a; b++) both[a][b] = both[b][a];
  diagonalise(both, vectors);
  Real most = 0;
  for (int a = 0; a < 6; a++) most = std::max(most, both[a][a]);
  return most;
}

Real longest_step(Real stiffness, Real damping)
{
  if (!(stiffness > 0) && !(damping > 0)) return std::numeric_limits<Real>::max();
  // x^2 + 2 damping dt = 4 with x^2 = stiffness dt^2, without cancellation.
  return 4 / (damping + std::sqrt(damping * damping + 4 * stiffness));
}

}    // namespace lsdcd
