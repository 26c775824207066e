// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Makes the compiled form of a law for pairs.
#pragma once

#include "law/contact_law.h"
#include "pair/pair_job.h"

namespace lsdcd {

// Each of the following functions has a group of laws that are compiled together, with a source file for each group
// (laws/CMakeLists.txt).
PairLaw granular_pair(const ContactLaw &law);
PairLaw granular_added_pair(const ContactLaw &law);
PairLaw plastic_pair(const ContactLaw &law);
PairLaw reaching_pair(const ContactLaw &law);
PairLaw added_pair(const ContactLaw &law);
PairLaw classic_pair(const ContactLaw &law);

PairLaw pair_law(const ContactLaw &law);

// Gives a law the compiled form that records energy.
void set_book(const ContactLaw &law, PairLaw &out);

// Runs a step of pairs, for any laws of the job.
void run_pairs(const PairJob &job);
// Adds to job.energy what the pairs of a step that has run have done with energy. What was held by a pair that is no longer
// in a list is not part of `seen`.
void book_pairs(const PairJob &job);

}    // namespace lsdcd
