// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/reports/time_report.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace lsdcd {

Real TimeReport::steady_clock()
{
  return std::chrono::duration<Real>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void TimeReport::begin_run()
{
  std::fill_n(seconds_, kSections, 0);
}

void TimeReport::end_run(bool brief, Real loop)
{
  // No name is "Step", with which programs find the head of the table that a host logs.
  static const char *const names[kSections] = {"Search", "Forces", "Waiting", "Grids", "Files"};
  // Averages of the sections, of all of them and of the loop; the last is the number of processes.
  Real mean[kSections + 3] = {}, most[kSections], least[kSections];
  Real &total = mean[kSections], &mean_loop = mean[kSections + 1], &n = mean[kSections + 2];
  for (int k = 0; k < kSections; k++) {
    mean[k] = most[k] = seconds_[k];
    least[k] = -seconds_[k];
    total += seconds_[k];
  }
  mean_loop = loop;
  n = 1;
  begin_run();
  if (brief) return;
  host_.sum(mean, kSections + 3);
  host_.max(most, kSections);
  host_.max(least, kSections);
  if (total == 0) return;
  for (int k = 0; k < kSections + 2; k++) mean[k] /= n;

  char line[128];
  const auto percent = [](Real part, Real whole) { return 100 * part / whole; };
  const bool of_loop = mean_loop > 0;
  std::string text = "timing breakdown of the wall";
  if (of_loop) {
    std::snprintf(line, sizeof line, ", %.2f %% of the loop time", percent(total, mean_loop));
    text += line;
  }
  text += ":\n  Section |  min time  |  avg time  |  max time  |%varavg| %total";
  text += std::string(of_loop ? "| %loop" : "") + "\n  " + std::string(of_loop ? 70 : 63, '-');
  for (int k = 0; k < kSections; k++) {
    if (most[k] == 0) continue;
    const Real min = -least[k], apart = std::max(most[k] - mean[k], mean[k] - min);
    std::snprintf(line, sizeof line, "\n  %-8s|%- 12.5g|%- 12.5g|%- 12.5g|%6.1f |%6.2f", names[k],
                  min, mean[k], most[k], percent(apart, mean[k]), percent(mean[k], total));
    text += line;
    if (of_loop) {
      std::snprintf(line, sizeof line, " |%6.2f", percent(mean[k], mean_loop));
      text += line;
    }
  }
  host_.log(text);
}

}    // namespace lsdcd
