// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the kernels of a step on a GPU hand on to each other and to the next step.
#pragma once

namespace lsdcd {

// Lists of indices into what the step is over, and how many each has. Null: there is no such list.
struct StepLists {
  // What is left to the second kernel of this step: single() has said no, or they need a list.
  int *found = nullptr, *n_found = nullptr;
  int *n_found_next = nullptr;    // of the next step, to be cleared
  // What several() has asked for again: in the last step, and in this one. Most have several
  // contacts for many steps, so that these need not be found first.
  int *last = nullptr, *n_last = nullptr;
  int *next = nullptr, *n_next = nullptr;
  // Of each index the newest step that several() is asked of it first, and the number of this one.
  int *listed_in = nullptr, step = 0;
};

}    // namespace lsdcd
