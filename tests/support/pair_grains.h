// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that act on each other, step by step, where a test moves them.
#pragma once

#include "pair/compile_pair.h"
#include "pair/pair_job.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

// Grains, their list, and what a step of pairs writes.
struct PairGrains {
  int n, n_own;
  std::vector<Real> x, v, omega, radius, mass, force, torque;
  std::vector<int> type, rows, length;
  std::vector<std::vector<int>> neighbours;
  std::vector<int *> row;
  std::vector<PairLaw> laws;
  std::vector<int> law_of;
  int n_types = 1;
  PairHistory history[2];
  int now = 0;
  Real dt = 1e-4;
  Real factor[4] = {1, 1, 1, 1};
  std::vector<RecordedPair> *record = nullptr;

  explicit PairGrains(int n_grains) :
      n(n_grains), n_own(n), x(3 * n), v(3 * n), omega(3 * n), radius(n, 1), mass(n, 1),
      force(3 * n), torque(3 * n), type(n, 1), length(n), neighbours(n), row(n)
  {
    for (int i = 0; i < n; i++) rows.push_back(i);
  }
  void set_law(const ContactLaw &law)
  {
    laws = {pair_law(law)};
    law_of.assign(4, 0);
    const int width = law.has_history() ? 3 + law.n_extra() : 0;
    for (PairHistory &h : history) h.begin(width);
  }
  // All pairs, each in the row of the lower one, or of the higher one.
  void set_list(bool swapped = false)
  {
    for (int i = 0; i < n; i++) neighbours[i].clear();
    for (int i = 0; i < n; i++)
      for (int j = i + 1; j < n; j++) neighbours[swapped ? j : i].push_back(swapped ? i : j);
    for (int i = 0; i < n; i++) {
      length[i] = static_cast<int>(neighbours[i].size());
      row[i] = neighbours[i].data();
    }
  }
  PairList list() const { return {n, rows.data(), length.data(), row.data(), 0x1FFFFFFF, 30}; }
  PairJob job(bool update)
  {
    PairJob job = {};
    job.x = x.data(), job.v = v.data(), job.omega = omega.data();
    job.radius = radius.data(), job.mass = mass.data(), job.type = type.data();
    job.force = force.data(), job.torque = torque.data();
    job.n_own = n_own;
    job.list = list();
    job.factor = factor;
    job.laws = laws.data(), job.law_of = law_of.data(), job.n_types = n_types + 1;
    job.n_laws = static_cast<int>(laws.size());
    job.dt = dt, job.update = update;
    job.record = record;
    return job;
  }
  void step(bool update = true)
  {
    std::fill(force.begin(), force.end(), 0);
    std::fill(torque.begin(), torque.end(), 0);
    PairJob step = job(update);
    if (history[0].width() > 0) {
      now = 1 - now;
      history[now].begin(history[now].width());
      step.old = &history[1 - now];
      step.history = &history[now];
    }
    run_pairs(step);
  }
};

}    // namespace lsdcd
