// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A fixed scene whose steps valgrind counts (test_instructions.py): 2000 spheres at a closed cylinder
// of about 1000 triangles. argv: hooke, hertz/history or energy (hertz/history with books of energy), kept or anew.
#include "bench.h"
#include "cylinder_bed.h"

#include <cstdio>
#include <cstring>

namespace {

constexpr int kSpheres = 2000, kSteps = 20;

// Only what this calls is counted. A function of its own, known by name.
extern "C" __attribute__((noinline)) void counted_steps(lsdcd::CylinderBed *bed, bool anew)
{
  for (int k = 0; k < kSteps; k++) {
    if (anew) bed->choose();
    bed->steps(1);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc != 3) return 2;
  using namespace lsdcd;
  const EvenCylinder wall(1000);
  const SphereArrays spheres = bed_spheres(wall, kSpheres, true);
  const bool history = std::strcmp(argv[1], "hooke") != 0;
  ContactLaw law = usual_law(history ? NormalModel::hertz : NormalModel::hooke, history);
  law.keeps_forces = std::strcmp(argv[1], "energy") == 0;
  CylinderBed bed(wall, spheres, law, Device::cpu);
  bed.steps(2);    // memory is taken and contacts are known
  counted_steps(&bed, std::strcmp(argv[2], "anew") == 0);
  std::printf("%d spheres, %d steps, %lld contacts\n", kSpheres, kSteps,
              static_cast<long long>(bed.contacts()));
}
