// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A fixed scene whose steps valgrind counts (test_instructions.py): 8000 grains of a cubic lattice that touch their neighbours, of so many
// types with a law each. argv: number of types.
#include "base/input_words.h"
#include "input/pair_words.h"
#include "pair/compile_pair.h"
#include "pair/pair_coeff.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace lsdcd;

constexpr int kSide = 20, kGrains = kSide * kSide * kSide, kSteps = 5;

PairCoeff coeff_of(int type)
{
  std::istringstream in("hertz/material " + std::to_string(10000 + 1000 * type) +
                        " 0.7 0.3 tangential mindlin NULL 0.5 0.4 damping tsuji");
  return read_pair_coeff({std::istream_iterator<std::string>(in), {}});
}

// Grains with a diameter of 1.02, 1 apart. The list has neighbours that are up to the diagonal of a cell apart.
struct Lattice {
  explicit Lattice(int types) : n_types(types), law_of((types + 1) * (types + 1))
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<Real> unit(-1, 1);
    for (int i = 0; i < kGrains; i++) {
      const int at[] = {i % kSide, i / kSide % kSide, i / (kSide * kSide)};
      for (int k = 0; k < 3; k++) {
        x.push_back(at[k]);
        v.push_back(0.1 * unit(random));
        omega.push_back(0.1 * unit(random));
      }
      type.push_back(1 + static_cast<int>(random() % static_cast<unsigned>(types)));
      grain.push_back(i);
      for (int dz = 0; dz < 2; dz++)
        for (int dy = -dz; dy < 2; dy++)
          for (int dx = dz || dy ? -1 : 1; dx < 2; dx++)
            if (const int to[] = {at[0] + dx, at[1] + dy, at[2] + dz};
                std::all_of(to, to + 3, [](int a) { return a >= 0 && a < kSide; }))
              neighbours[i].push_back(to[0] + kSide * (to[1] + kSide * to[2]));
      row.push_back(neighbours[i].data());
      length.push_back(static_cast<int>(neighbours[i].size()));
    }
    std::vector<PairCoeff> own;
    for (int t = 1; t <= types; t++) own.push_back(coeff_of(t));
    for (int t = 0; t < types; t++)
      for (int u = t; u < types; u++) {
        law_of[(t + 1) * (types + 1) + u + 1] = law_of[(u + 1) * (types + 1) + t + 1] =
            static_cast<int>(laws.size());
        laws.push_back(
            pair_law(lsdcd::law_of(t == u ? own[t] : mixed(own[t], own[u], "of types"))));
      }
    for (PairHistory &h : history) h.begin(3);
  }

  void step()
  {
    PairJob job = {};
    job.x = x.data(), job.v = v.data(), job.omega = omega.data();
    job.radius = radius.data(), job.mass = mass.data(), job.type = type.data();
    job.force = force.data(), job.torque = torque.data();
    job.n_own = kGrains;
    job.list = {kGrains, grain.data(), length.data(), row.data(), 0x1FFFFFFF, 30};
    job.factor = factor;
    job.laws = laws.data(), job.law_of = law_of.data(), job.n_types = n_types + 1;
    job.n_laws = static_cast<int>(laws.size());
    job.dt = 1e-6, job.update = true;
    now = 1 - now;
    history[now].begin(3);
    job.old = &history[1 - now];
    job.history = &history[now];
    run_pairs(job);
  }

  int n_types;
  std::vector<int> law_of;
  std::vector<Real> x, v, omega, radius = std::vector<Real>(kGrains, 0.51),
                                 mass = std::vector<Real>(kGrains, 1),
                                 force = std::vector<Real>(3 * kGrains), torque = force;
  std::vector<int> type, grain, length;
  std::vector<std::vector<int>> neighbours = std::vector<std::vector<int>>(kGrains);
  std::vector<const int *> row;
  std::vector<PairLaw> laws;
  Real factor[4] = {1, 1, 1, 1};
  PairHistory history[2];
  int now = 0;
};

// Only what this calls is counted. A function of its own, known by name.
extern "C" __attribute__((noinline)) void counted_steps(Lattice *lattice)
{
  for (int k = 0; k < kSteps; k++) lattice->step();
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc != 2) return 2;
  Lattice lattice(std::atoi(argv[1]));
  for (int k = 0; k < 2; k++) lattice.step();    // memory is taken and contacts are known
  counted_steps(&lattice);
  std::printf("%d spheres, %d steps, %zu contacts\n", kGrains, kSteps,
              lattice.history[lattice.now].size());
}
