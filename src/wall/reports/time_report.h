// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where the time of a run goes, in a table for the log.
#pragma once

#include "host/host.h"

#include <functional>
#include <utility>

namespace lsdcd {

class TimeReport {
 public:
  enum Section { choice, forces, waiting, grids, files, kSections };
  // Seconds of this process; never goes back.
  using Clock = std::function<Real()>;
  static Real steady_clock();

  explicit TimeReport(Host &host, Clock clock = steady_clock) :
      host_(host), clock_(std::move(clock))
  {
  }

  // begin() starts the clock. end() counts the time since then, or since the last end(), for the section.
  void begin() { last_ = clock_(); }
  void end(Section section)
  {
    const Real now = clock_();
    seconds_[section] += now - last_;
    last_ = now;
  }

  // Counts from 0 again.
  void begin_run();

  // Logs the times of a run, and counts from 0 again. `loop`: seconds of the whole
  // run; 0: not known. Sections without time are left out. Nothing is logged with `brief`, or if no
  // section has time. Collective.
  void end_run(bool brief, Real loop);

 private:
  Host &host_;
  Clock clock_;
  Real last_ = 0;
  Real seconds_[kSections] = {};    // of this run, on this process
};

}    // namespace lsdcd
