// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words of compute lsdcd/impacts -> ImpactsSettings.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

struct ImpactsSettings {
  Real least_speed = 0;    // length/time; impacts that are faster are recorded; 0: none are
  FileEvery spectrum;
};

// Throws InputError that names the word, what was expected and the syntax.
ImpactsSettings parse_impacts(const std::vector<std::string> &tokens);

}    // namespace lsdcd
