// What a wall does beside a contact law: its surface may move, and what happens to it may
// be recorded. Compiled into a law's kernel only where it is asked for.
#pragma once

#include "motion/surface_motion.h"
#include "geometry/feature_code.h"
#include "law/wear.h"

namespace lsdcd {

// What one contact does to the wall in one step.
struct ContactRecord {
  FeatureCode feature;
  std::uint32_t mesh;    // of the wall's
  Real normal;           // force on the wall, > 0 where the sphere presses
  Real shear;            // size of the force along the wall
  Real wear_power;       // see law/wear.h; 0 without wear
  // In the frame of the mesh:
  Vec3 force;    // on the wall
  Vec3 arm;      // from the closest point to the sphere's centre
};

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
