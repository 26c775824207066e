// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall does beside a contact law: its surface may move, and what happens to it may
// be recorded. Compiled into a law's kernel only where it is asked for.
#pragma once

namespace lsdcd {

// Which of the two a kernel has.
struct WallEffects {
  bool surface, records;
};

template <class Law, bool kSurface_, bool kRecords_>
struct OnWall : Law {
  static constexpr bool kSurface = kSurface_, kRecords = kRecords_;
};

// Which kernels a law has: the one without effects; the one for a moving surface and the one for both
// effects, which serves records alone, too; the one without effects and the one for both.
enum class WallKernels { plain, moving_or_both, plain_or_both };

// Calls make(law) with the law that has the effects.
template <WallKernels kernels, class Law, class Make>
auto on_wall(const Law &law, const WallEffects &effects, const Make &make)
{
  if constexpr (kernels == WallKernels::plain) return make(OnWall<Law, false, false>{law});
  if constexpr (kernels == WallKernels::moving_or_both)
    if (!effects.records) return make(OnWall<Law, true, false>{law});
  if constexpr (kernels == WallKernels::plain_or_both)
    if (!effects.records && !effects.surface) return make(OnWall<Law, false, false>{law});
  if constexpr (kernels != WallKernels::plain) return make(OnWall<Law, true, true>{law});
}

}    // namespace lsdcd
