// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selecting the spheres near the wall among all, on each backend.
#pragma once

namespace lsdcd {

// selection_cpu.h and selection_gpu.h specialise it. Each has, with a `work` like NearChoice:
//   start(b, n, work, to, total)    puts those of [0, n) that `work` keeps, ascending, into `to`, which has
//                                   room for n. *total, where kernels run, becomes how many. Does not wait.
//   had_room(b, total)              false: there was too little memory, now there is enough; start again
//   bytes()                         that it holds
// Of each sphere the work is asked check(), with what read() has read of it, and coarse_test(). Of those that
// pass it is asked locate(), and where has_refine() then refine(), with the cell that locate() returned. Where
// has_notes(), note() is told of each. The memory must not be freed before what was started has ended.
template <class B, bool kOnHost = B::kOnHost>
class Selection;

}    // namespace lsdcd
