// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Decides pairs by exact signs if rounded signs do not. They touch or lie in one plane, are few and
// take long, so that the CPU does it for every backend.
#pragma once

#include "backend/backend_cpu.h"
#include "bodies/piece_candidates.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

// Adds those of n pairs that meet to `out`, sorted. `corners`: of the body.
inline void add_exact_pairs(const MeshFeaturesView &wall, const Vec3 *corners, const BodyPose &pose,
                            BodyPair *pairs, std::size_t n, bool with_segments, Collision &out)
{
  struct Tested {
    BodyPair pair;
    bool meet;
    MeetingSegment segment;
  };
  std::sort(pairs, pairs + n);
  std::vector<Tested> all(std::unique(pairs, pairs + n) - pairs);
  CpuBackend().for_each(all.size(), [&](std::size_t i) {
    const Triangle of_body = body_triangle(corners, pairs[i].triangle, pose),
                   of_wall = wall_triangle(wall, pairs[i].wall);
    all[i] = {pairs[i], triangles_meet(of_body, of_wall), {}};
    if (with_segments && all[i].meet) all[i].segment = meeting_segment(of_body, of_wall);
  });
  for (std::size_t i = 0; i < out.pairs.size(); i++)
    all.push_back({out.pairs[i], true, with_segments ? out.segments[i] : MeetingSegment()});
  std::sort(all.begin(), all.end(),
            [](const Tested &a, const Tested &b) { return a.pair < b.pair; });
  out.pairs.clear();
  out.segments.clear();
  for (const Tested &t : all) {
    if (!t.meet) continue;
    out.pairs.push_back(t.pair);
    if (with_segments) out.segments.push_back(t.segment);
  }
}

}    // namespace lsdcd
