// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the candidate spheres from all spheres, on each backend.
#pragma once

namespace lsdcd {

// selection_cpu.h and selection_gpu.h specialise it. Each has, with a `work` like CandidateTest:
//   run(b, n, work, to, total)    puts those of [0, n) that pass the tests of `work`, ascending, into `to`, which has space for n.
//                                 *total, where kernels run, becomes their number. May return before it is set.
//   bytes()                       returns the bytes that it holds
// For each sphere it calls check() with the result of read(), then coarse_test(). If that passes: is_near(). If that passes and
// has_refine(): refine(). A sphere that fails a test is selected all the same if closes() says so; all others go to note_out().
template <class B, bool kOnCpu = B::kOnCpu>
class Selection;

}    // namespace lsdcd
