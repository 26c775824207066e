// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A contact law of each kind, for tests that go through all.
#pragma once

#include "support/crowd.h"
#include "support/laws.h"

#include <vector>

namespace lsdcd {

struct NamedLaw {
  const char *name;
  EngineSettings settings;
};

inline std::vector<NamedLaw> laws(Real k)
{
  EngineSettings rolling = hooke_history(k, 3e4, 50, 20, 0.4), all, records;
  rolling.law().rolling = {RollingModel::epsd2, {0.1}};
  all.law() = everything(NormalModel::jkr);
  records = hertz_history(k, 3e4, 50, 20, 0.4);
  records.contacts = true;
  return {{"hooke", hooke(k, 50, 20, 0.4)},
          {"hooke/history", hooke_history(k, 3e4, 50, 20, 0.4)},
          {"hertz/history with records", records},
          {"rolling epsd2", rolling},
          {"granular jkr, all", all}};
}

}    // namespace lsdcd
