// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Shared by the benchmark programs: their words, timing, the copy that a floor is taken
// from, the paper's cylinder in four sizes, and rows of one format.
#pragma once

#include "engine/engine.h"
#include "mesh/triangle_soup.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace lsdcd {

struct BenchOptions {
  std::vector<Device> devices;    // the CPU and, where there is one, a GPU
  // 0: the program's own numbers.
  double spheres = 0, most_triangles = 0, length = 0;
  int repeats = 0;
  bool quick = false;    // small sizes, to see that all runs
  std::string commit;
};

struct Timing {
  double median_ms, min_ms, max_ms;
  int repeats;
};

// The statistics of times in milliseconds, at least one.
Timing timing_of(std::vector<double> ms);

// Milliseconds; with rows of one CPU thread those that it works, so that others on the machine do
// not count.
double clock_ms();

// Runs f once to warm up, then `repeats` times. The time is that of each of the n that f does.
template <class F>
Timing time_it(int repeats, F f, int n = 1)
{
  f();
  std::vector<double> ms;
  for (int i = 0; i < repeats; i++) {
    const double start = clock_ms();
    f();
    ms.push_back((clock_ms() - start) / n);
  }
  return timing_of(std::move(ms));
}

// The paper's wall, radius 50 and height 100, in about 160, 1e4, 1e5 and 1e6 triangles; as
// many of them as the options allow.
std::vector<TriangleSoup> cylinders(const BenchOptions &options, double most);

struct BenchRow {
  std::string what;    // the case, in words
  std::size_t triangles = 0, spheres = 0;
  double length = 0;    // of cells
  std::string order;    // of the spheres: random or sorted
  Timing timing = {0, 0, 0, 0};
  double bytes = 0;     // that must move: what is read once, what is written once; 0: not known
  std::string facts;    // more numbers, name=value and spaces
};

// Rows of one program as CSV on stdout.
class BenchRows {
 public:
  BenchRows(const char *program, const std::string &commit);
  // From now on rows are of this device: measures its copy.
  void begin(Device device);
  void add(const BenchRow &row);

 private:
  std::string program_, commit_, device_;
  double copy_gb_s_ = 0;
};

// main() of a program: reads the words of the command line, measures, says what went
// wrong.
int run_bench(int argc, char **argv, const char *program, const char *about,
              void (*measure)(const BenchOptions &options, BenchRows &rows));

// A law with stiffnesses, damping and friction that all programs take.
ContactLaw usual_law(NormalModel normal, bool has_history);

// printf into a string.
std::string format(const char *how, ...) __attribute__((format(printf, 1, 2)));

// The compiler and its version.
const char *compiler();

}    // namespace lsdcd
