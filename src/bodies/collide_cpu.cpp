// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "bodies/collide_on.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

#if defined(LSDCD_HAVE_CUDA)
std::unique_ptr<BodyCollision> make_cuda_body_collision();
#endif

std::unique_ptr<BodyCollision> make_body_collision(Device device)
{
  std::string why;
  const bool cuda = device != Device::cpu && cuda_available(&why);
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) return make_cuda_body_collision();
#endif
  if (!cuda && device == Device::cuda)
    throw InputError("device cuda: " + why + "; use device auto or cpu");
  return std::make_unique<BodyCollisionOn<CpuBackend>>(CpuBackend());
}

BodyGridSettings collision_grid(const TriangleSoup &body, Real length, int nearest)
{
  BodyGridSettings settings;
  settings.nearest = nearest;
  settings.may_coarsen = length <= 0;
  if (length <= 0) {
    std::vector<Real> edges;
    edges.reserve(body.corners.size());
    for (std::size_t c = 0; c < body.corners.size(); c++)
      edges.push_back(norm(body.corners[c % 3 == 2 ? c - 2 : c + 1] - body.corners[c]));
    if (edges.empty()) throw InputError(body.source + ": the body has no triangles");
    std::nth_element(edges.begin(), edges.begin() + edges.size() / 2, edges.end());
    length = edges[edges.size() / 2];
    if (!(length > 0))
      throw InputError(body.source + ": most edges of the body have no length; give the length of "
                                     "a cell");
  }
  settings.length = length;
  // 2 / 3 of a cell, the most that a piece reaches from its centroid, and a thousandth for
  // rounding.
  settings.cutoff = length * (Real(2) / 3) * (1 + Real(1e-3));
  return settings;
}

}    // namespace lsdcd
