#include "mesh/likely_scale.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

// A floor may be far larger than a box along two axes. No wall of use is along all three.
Real likely_scale(const Vec3 &mesh, const Vec3 &box)
{
  constexpr Real kTooLarge = 20;
  const Real least = std::min({mesh.x / box.x, mesh.y / box.y, mesh.z / box.z});
  if (!(least > kTooLarge)) return 1;
  const Real ratio = norm(mesh) / norm(box);
  Real best = 1;
  // Micrometres, millimetres, centimetres, inches and feet to metres.
  for (Real factor : {1e-6, 1e-3, 1e-2, 0.0254, 0.3048})
    if (std::fabs(std::log(ratio * factor)) < std::fabs(std::log(ratio * best))) best = factor;
  return best;
}

}    // namespace lsdcd
