// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a setting costs in time, on one device: a search that keeps nothing between steps, and a step with what that setting
// keeps. Spheres, grid and answers lie where the device computes, and nothing is copied while time is taken.
#pragma once

#include "engine/engine.h"
#include "grid/triangle_grid.h"
#include "study/sphere_sample.h"

#include <cstddef>
#include <memory>
#include <string>

namespace lsdcd {

// The smallest and the largest of several runs, nanoseconds for each sphere of the sample.
struct Spread {
  double least = 0, most = 0;

  void add(double ns)
  {
    least = most > 0 && least < ns ? least : ns;
    most = most > ns ? most : ns;
  }
};

// There is a candidate search every kChosenEvery steps, for a way of kMargin of the largest radius: half of the skin of a
// host's neighbour lists, whose renewal asks for the search. The fastest sphere goes that way in this time, the others go any part
// of it, each straight on in a direction of its own. An impact at the speed of the fastest overlaps by 1 % of the radius
// where a contact lasts 50 steps: overlap / radius = 50 steps / pi * 0.2 / 336.
constexpr Real kMargin = 0.2;
constexpr int kChosenEvery = 336;

struct StepTimes {
  Spread step;          // of one step, the mean between two searches; with its share of one
  Spread choice;        // of one candidate search, with the lists that it makes
  double listed = 0;    // features of a kept list in the mean; 0: no list is kept
  std::size_t kept_bytes = 0;    // of the engine
};

class SampleTimer {
 public:
  virtual ~SampleTimer() = default;

  virtual std::string device() const = 0;
  // Times the search for all contacts of each sphere in the list of its cell, by the function that a step calls.
  virtual Spread search(const ViewOf<StepGrid> &grid, int repeats) = 0;
  // Times steps of an engine whose spheres move. Throws InputError as WallEngine::read_diagnostics().
  virtual StepTimes steps(const ViewOf<StepGrid> &grid, const EngineSettings &settings,
                          int repeats) = 0;
};

// On a CPU times are those of one thread's processor, however busy the others are, and caches are filled with something else
// before each piece that is timed, as the rest of a simulation's step does. On a GPU they are those between two events around
// kernels that follow each other. Throws InputError where there is no GPU.
std::unique_ptr<SampleTimer> make_sample_timer(bool on_cuda, const SphereSample &sample);

}    // namespace lsdcd
