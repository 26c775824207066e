// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the candidate spheres among all, on each backend.
#pragma once

namespace lsdcd {

// selection_cpu.h and selection_gpu.h specialise it. Each has, with a `work` like CandidateTest:
//   run(b, n, work, to, total)    puts those of [0, n) that pass the tests of `work`, ascending, into `to`, which has room
//                                 for n. *total, where kernels run, becomes how many. May return before it is so.
//   bytes()                       that it holds
// For each sphere: check() with the result of read(), then coarse_test(). If that passes: is_near(). If that passes and
// has_refine(): refine(). One that fails passes all the same where closes() says so; note_out() gets the others.
template <class B, bool kOnCpu = B::kOnCpu>
class Selection;

}    // namespace lsdcd
