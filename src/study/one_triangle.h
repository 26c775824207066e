// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Possible errors in the paper's runs with one triangle per cell: each as a way to answer,
// with its accuracy.
#pragma once

#include "study/accuracy.h"

#include <string>
#include <vector>

namespace lsdcd {

struct Guess {
  std::string what;
  Real accuracy;
};

// Returns the study's spheres against its mesh; the lists have cells of this length.
std::vector<Guess> guess_one_triangle(AccuracyStudy &study, Real length);

}    // namespace lsdcd
