// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/shape_query.h"

#include "backend/threads.h"
#include "base/input_error.h"
#include "base/quaternion.h"
#include "shape/shapes_made.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <string>

namespace lsdcd {
namespace {

class GrainReader {
 public:
  explicit GrainReader(const ShapesGiven &given) : given_(given) {}

  PlacedGrain read(std::size_t i)
  {
    const Real *centre = given_.centres + 3 * i;
    const std::size_t k = given_.all_alike ? 0 : i;
    const Real *half = given_.half_axes + 3 * k;
    const Real *n = given_.exponents ? given_.exponents + 2 * k : kTwo;
    PlacedGrain grain;
    try {
      grain.shape = made_.get({half[0], half[1], half[2]}, n[0], n[1]);
    } catch (const InputError &e) {
      throw InputError("grain " + std::to_string(i) + ": " + e.what());
    }
    grain.centre = {centre[0], centre[1], centre[2]};
    Quaternion turn;
    if (given_.quaternions) {
      const Real *q = given_.quaternions + 4 * i;
      const Real most =
          std::max({std::fabs(q[0]), std::fabs(q[1]), std::fabs(q[2]), std::fabs(q[3])});
      if (!(most > 0 && most - most == 0 &&
            q[0] - q[0] + q[1] - q[1] + q[2] - q[2] + q[3] - q[3] == 0))
        throw InputError("grain " + std::to_string(i) +
                         " has a quaternion that is 0 or no number: give w i j k of a rotation");
      turn = normalised({q[0] / most, {q[1] / most, q[2] / most, q[3] / most}});
    }
    rows_of(turn, grain.row);
    return grain;
  }

 private:
  static constexpr Real kTwo[2] = {2, 2};
  const ShapesGiven &given_;
  ShapesMade made_;
};

constexpr std::size_t kGrainsAtATime = 64;

// Calls of_chunk(chunk, from, to, reader, search) for all grains, some at a time, with threads() threads.
template <class OfChunk>
void each_chunk(const TriangleTree &tree, const ShapesGiven &grains, const OfChunk &of_chunk)
{
  const std::size_t n_chunks = (grains.n + kGrainsAtATime - 1) / kGrainsAtATime;
  std::exception_ptr error;
#pragma omp parallel num_threads(threads()) if (n_chunks > 1)
  {
    GrainReader reader(grains);
    ShapeSearch search(tree);
#pragma omp for schedule(dynamic, 1)
    for (std::int64_t c = 0; c < static_cast<std::int64_t>(n_chunks); c++) {
      try {
        const std::size_t from = static_cast<std::size_t>(c) * kGrainsAtATime;
        of_chunk(static_cast<std::size_t>(c), from, std::min(grains.n, from + kGrainsAtATime),
                 reader, search);
      } catch (...) {
#pragma omp critical(lsdcd_shape_query)
        if (!error) error = std::current_exception();
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

}    // namespace

FoundGrainContacts find_shape_contacts(const TriangleTree &tree, const ShapesGiven &grains)
{
  FoundGrainContacts out;
  out.first.resize(grains.n + 1);
  std::vector<std::vector<FoundGrainContact>> chunks((grains.n + kGrainsAtATime - 1) /
                                                     kGrainsAtATime);
  each_chunk(tree, grains,
             [&](std::size_t c, std::size_t from, std::size_t to, GrainReader &reader,
                 ShapeSearch &search) {
               for (std::size_t i = from; i < to; i++) {
                 const std::size_t before = chunks[c].size();
                 search.contacts(reader.read(grains.from + i), chunks[c]);
                 out.first[i + 1] = chunks[c].size() - before;
               }
             });
  for (std::size_t i = 0; i < grains.n; i++) out.first[i + 1] += out.first[i];
  out.found.reserve(out.first[grains.n]);
  for (std::vector<FoundGrainContact> &chunk : chunks) {
    out.found.insert(out.found.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
  return out;
}

void find_shape_distances(const TriangleTree &tree, const ShapesGiven &grains,
                          FoundGrainContact *nearest)
{
  each_chunk(
      tree, grains,
      [&](std::size_t, std::size_t from, std::size_t to, GrainReader &reader, ShapeSearch &search) {
        for (std::size_t i = from; i < to; i++)
          nearest[i] = search.nearest(reader.read(grains.from + i));
      });
}

}    // namespace lsdcd
