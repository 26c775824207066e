// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres with a list of pairs, as a host has them for an engine of pairs: of type and mass 1, with a row for each.
#pragma once

#include "pair/pair_engine.h"

#include <numeric>
#include <vector>

namespace lsdcd {

struct GrainRows {
  // A row has so many places, of which it uses `length`.
  GrainRows(int n, int places) : places(places), n(n) { std::iota(grain.begin(), grain.end(), 0); }

  PairRows list() const
  {
    PairRows rows;
    rows.rows = n;
    rows.grain = grain.data();
    rows.length = length.data();
    rows.neighbor = neighbor.data();
    rows.row = rows.longest = places;
    rows.place = 1;
    rows.mask = 0x1fffffff;
    rows.factor_shift = 30;
    return rows;
  }
  // Gives a step all but its dt. With forces that are 0.
  void give(PairInput &s)
  {
    force.assign(x.size(), 0);
    torque = force;
    s.x = x.data();
    s.v = v.data();
    s.omega = omega.data();
    s.radius = radius.data();
    s.mass = mass.data();
    s.type = type.data();
    s.force = force.data();
    s.torque = torque.data();
    s.n_own = s.n_all = n;
    s.list = list();
    s.update = true;
  }

  int places, n;
  std::vector<Real> x = std::vector<Real>(3 * n), v = x, omega = x, force, torque,
                    radius = std::vector<Real>(n, 0.5), mass = std::vector<Real>(n, 1);
  std::vector<int> type = std::vector<int>(n, 1), grain = type, length = std::vector<int>(n),
                   neighbor = std::vector<int>(places * n);
};

}    // namespace lsdcd
