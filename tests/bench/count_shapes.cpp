// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Steps of grains that are no spheres, which valgrind counts (test_instructions.py). argv: the numbers of a kind and of a place of shape_bed.h.
#include "shape_bed.h"

#include <cstdio>
#include <cstdlib>

namespace {

constexpr int kGrains = 300;

// Only what this calls is counted. A function of its own, known by name.
extern "C" __attribute__((noinline)) void counted_steps(lsdcd::ShapeBed *bed)
{
  bed->steps();
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc != 3) return 2;
  using namespace lsdcd;
  ShapeBed bed(kShapeKinds[std::atoi(argv[1])], static_cast<ShapePlace>(std::atoi(argv[2])),
               kGrains);
  bed.steps();    // memory is taken and lists are made
  counted_steps(&bed);
  std::printf("%d spheres, %d steps, %.0f contacts\n", kGrains, ShapeBed::kSteps, bed.contacts());
}
