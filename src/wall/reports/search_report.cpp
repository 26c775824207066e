// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/reports/search_report.h"

#include "base/input_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lsdcd {

void SearchReport::add(const StepDiagnostics &seen)
{
  uncertified_ += seen.uncertified;
  uncertain_ = std::max(uncertain_, seen.uncertain);
  lists_ += seen.lists;
  listed_ += seen.listed;
  cell_searches_ += seen.by_cells;
}

void SearchReport::end_run(bool brief, const std::string &advice)
{
  // Counts are exact in a Real up to 2^53.
  Real sum[3] = {static_cast<Real>(lists_), static_cast<Real>(listed_),
                 static_cast<Real>(cell_searches_)};
  host_.sum(sum, 3);
  if (steps_ + setups_ > 0 && !brief) {
    std::string t = counted(steps_, "step") + (setups_ > 0 ? " and the setup" : "") + ": " +
                    host_.names().sphere + "s near the wall searched for " +
                    counted(updates_, "time") + advice;
    if (sum[0] > 0) {
      char features[32];
      std::snprintf(features, sizeof features, "%.2f", sum[1] / sum[0]);
      t += ", wall neighbor lists made " + counted(static_cast<std::int64_t>(sum[0]), "time") +
           ", " + features + " mesh features each";
    }
    if (sum[2] > 0)
      t += ", a grid cell searched instead " + counted(static_cast<std::int64_t>(sum[2]), "time");
    host_.log(t);
  }
  steps_ = setups_ = updates_ = lists_ = listed_ = cell_searches_ = 0;
}

void SearchReport::log_uncertified(int nearest, bool brief)
{
  Real sum = static_cast<Real>(uncertified_), worst = uncertain_;
  host_.sum(&sum, 1);
  host_.max(&worst, 1);
  if (sum < uncertified_due_ && worst < uncertain_due_) return;
  uncertified_due_ = std::max<Real>(1, 10 * sum);
  uncertain_due_ = worst > 0 ? 2 * worst : HUGE_VAL;
  if (brief && sum == 0) return;
  std::string t = "nearest " + std::to_string(nearest) + ": " +
                  counted(static_cast<std::int64_t>(sum), "answer was", "answers were") +
                  " not certified exact";
  if (sum > 0)
    t += "; contacts overlapping by up to " + number_text(100 * worst) +
         " % of a radius may have been missed (nearest all misses none). This warning comes again "
         "if they are ten times as many or could be twice as deep";
  host_.log(t);
}

}    // namespace lsdcd
