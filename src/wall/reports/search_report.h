// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The work of the search for contacts, in lines for the log.
#pragma once

#include "engine/engine.h"
#include "host/host.h"

#include <cstdint>
#include <string>

namespace lsdcd {

class SearchReport {
 public:
  explicit SearchReport(Host &host) : host_(host) {}

  void count_step(bool is_setup) { (is_setup ? setups_ : steps_)++; }
  void count_update() { updates_++; }
  // Adds what the engine has counted since the last call.
  void add(const StepDiagnostics &seen);

  // Logs the counts of a run, and counts from 0 again. Logs nothing if `brief`, or after a run without a step and a setup.
  // `advice` follows the number of choices. Collective.
  void end_run(bool brief, const std::string &advice);

  // Logs the number of uncertified answers of nearest lists since this object was made: at the first call, and
  // again when there are ten times as many, or when the contacts that they may have missed are twice as deep.
  // With `brief` logs only if there are any. Collective.
  void log_uncertified(int nearest, bool brief);

 private:
  Host &host_;
  std::int64_t steps_ = 0, setups_ = 0, updates_ = 0;          // of this run, on all processes
  std::int64_t lists_ = 0, listed_ = 0, cell_searches_ = 0;    // of this run, on this process
  // On this process: answers that were not certified, and overlap / radius of the deepest contact that
  // they may have missed.
  std::int64_t uncertified_ = 0;
  Real uncertain_ = 0;
  Real uncertified_due_ = 0, uncertain_due_ = 0;    // on all processes: logged from here on
};

}    // namespace lsdcd
