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

// Gives a law the compiled form that books energy.
void set_book(const ContactLaw &law, PairLaw &out);

// A step of pairs, whatever the laws of the job are.
void run_pairs(const PairJob &job);
// Adds what the pairs of a step that has run have done with energy to job.energy. What a pair had held that is in no list any
// more is not `seen`.
void book_pairs(const PairJob &job);

}    // namespace lsdcd
