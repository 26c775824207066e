// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From a law to its compiled form for pairs.
#pragma once

#include "law/contact_law.h"
#include "pair/pair_job.h"

namespace lsdcd {

// The groups of laws that are compiled together, a source file each (laws/CMakeLists.txt).
PairLaw granular_pair(const ContactLaw &law);
PairLaw granular_added_pair(const ContactLaw &law);
PairLaw added_pair(const ContactLaw &law);
PairLaw classic_pair(const ContactLaw &law);

PairLaw pair_law(const ContactLaw &law);

// A step of pairs, whatever the laws of the job are.
void run_pairs(const PairJob &job);

}    // namespace lsdcd
