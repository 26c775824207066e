// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sums over pairs, and the interface of the checker that runs on a GPU.
#pragma once

#include "support/walk_check.h"

namespace lsdcd {

struct PairTotals {
  long pairs = 0, meshes = 0, touching = 0, missed = 0, not_there = 0, wrong = 0, bad = 0;
  Real error = 0;    // largest, over the tolerance
  long first_mesh = -1, first_sphere = -1;

  void count(const PairResult &r, long sphere)
  {
    pairs++;
    touching += r.touches;
    missed += r.missed;
    not_there += r.not_there;
    wrong += r.wrong;
    bad += r.bad;
    if (!(r.error <= error)) error = r.error;
    if (first_sphere < 0 && (r.missed || r.not_there || r.wrong || r.bad)) first_sphere = sphere;
  }
  void add(const PairTotals &o, long mesh)
  {
    pairs += o.pairs;
    meshes++;
    touching += o.touching;
    missed += o.missed;
    not_there += o.not_there;
    wrong += o.wrong;
    bad += o.bad;
    if (!(o.error <= error)) error = o.error;
    if (o.first_sphere >= 0 && (first_mesh < 0 || mesh < first_mesh)) {
      first_mesh = mesh;
      first_sphere = o.first_sphere;
    }
  }
};

// Checks n spheres of a mesh on the GPU; the oracle runs there too, in double-double.
// `mesh` points to the host; its grid is `grid`.
PairTotals check_pairs_on_cuda(const TriangleGrid &grid, PairMesh<DoubleDouble> mesh, long n);

// The same for walks of n spheres: what each of them counted.
std::vector<Walks> check_walks_on_cuda(const TriangleGrid &grid, WalkMesh<DoubleDouble> mesh,
                                       long n);

}    // namespace lsdcd
