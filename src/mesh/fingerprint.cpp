// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/fingerprint.h"

#include <cstring>

namespace lsdcd {

namespace {

// Each step is one-to-one in the old hash and in the word, so that a change of one word always changes the hash.
class Mixer {
 public:
  void add(std::uint64_t word)
  {
    state = (state ^ word) * 0x9E3779B97F4A7C15;    // odd
    state ^= state >> 32;
  }
  void add(Real number)
  {
    std::uint64_t bits;
    static_assert(sizeof bits == sizeof number, "bit for bit");
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  std::uint64_t state = 0;
};

}    // namespace

// Every build has this, unlike the key of the grid cache: restart files go from one build to another.
std::uint64_t fingerprint(const WeldedMesh &mesh)
{
  Mixer mixer;
  mixer.add(std::uint64_t(mesh.vertices.size()));
  for (const Vec3 &v : mesh.vertices)
    for (int d = 0; d < 3; d++) mixer.add(v[d]);
  for (const auto &edge : mesh.edges)
    for (const int v : edge) mixer.add(std::uint64_t(v));
  for (const auto &face : mesh.faces)
    for (const int v : face) mixer.add(std::uint64_t(v));
  return mixer.state;
}

}    // namespace lsdcd
