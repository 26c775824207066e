// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A crowd of spheres on a wall for a few steps of any engine, with all results, so that
// engines can be compared to the bit.
#pragma once

#include "box/periodic_images.h"
#include "support/meshes.h"

#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

struct Case {
  const char *name;
  TriangleSoup soup;
  Real cutoff, length;
  bool periodic = false;    // in a box a little smaller than the wall, which acts through its faces
};
std::vector<Case> cases();

// The wall of a case, with its periodic images, and where its grid is cut off.
WeldedMesh mesh_of(const Case &c);
Box within(const Case &c);

TriangleSoup random_soup(int n, unsigned seed);

template <class T>
bool same_bytes(const std::vector<T> &a, const std::vector<T> &b)
{
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

ContactLaw classic(NormalModel normal, bool history);
// `granular` with all further effects at once.
ContactLaw everything(NormalModel normal);

// Spheres all over the box of a wall, some in motion, for a few steps on one backend.
struct Outcome {
  std::vector<Vec3> force, torque;
  WallTotals totals;
  std::vector<Spring> springs;
  std::vector<Real> extra, heat;
  std::vector<TouchingSphere> outputs;
  std::vector<StepContact> contacts;
};

// How a wall is searched.
struct Search {
  const char *name;
  int nearest;
};
constexpr Search kComplete = {"complete", 0};
std::vector<Search> other_searches();

using EngineMaker = std::function<std::unique_ptr<WallEngine>(const EngineSettings &)>;

Outcome run_steps(const Case &c, const ContactLaw &law, const EngineMaker &make, int n_spheres,
                  const Search &search = kComplete, const EngineSettings &wall = {});

// To the bit, and that there were contacts.
void expect_same(const Outcome &a, const Outcome &b, const std::string &name);

}    // namespace lsdcd
