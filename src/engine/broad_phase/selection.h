// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the candidate spheres among all, on each backend.
#pragma once

namespace lsdcd {

// selection_cpu.h and selection_gpu.h specialise it. Each has, with a `work` like CandidateTest:
//   start(b, n, work, to, total)    puts those of [0, n) that pass the tests of `work`, ascending, into `to`, which has
//                                   room for n. *total, where kernels run, becomes how many. Does not wait.
//   had_room(b, total)              false: there was too little memory, now there is enough; start again
//   bytes()                         that it holds
// For each sphere: check() with the result of read(), then coarse_test(). If that passes: locate(). If that
// passes and has_refine(): refine() with the cell that locate() returned. note() gets each result where
// has_notes(). The memory must not be freed before what was started has ended.
template <class B, bool kOnHost = B::kOnHost>
class Selection;

}    // namespace lsdcd
