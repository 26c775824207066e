// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What warps of a GPU do for meshes whose nodes move, and for pairs of grains, by threads of a CPU: what a CPU does.
#include "support/warp_on_cpu.h"

#include "backend/backend_cpu.h"
#include "engine/nodes/node_list.h"
#include "pair/book_on.h"
#include "support/grain_rows.h"
#include "support/meshes.h"
#include "support/moved_records.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace lsdcd::test_warps {
namespace {

using GpuWarp = Warp<kWarpSize>;

// The memory is that of the CPU, and kernels for warps run on 32 threads, warp after warp.
struct WarpBackend : CpuBackend {
  static constexpr bool kOnCpu = false;

  template <class F>
  void for_each_in_warps(std::size_t n, const F &f, const std::uint32_t *n_at = nullptr)
  {
    if (n_at) n = *n_at <= n ? *n_at : 0;
    for (std::size_t first = 0; first < n; first += kWarpSize)
      warp_on_cpu::run([&] {
        const std::size_t i = first + threadIdx.x;
        f(GpuWarp(), i < n, i < n ? i : 0);
      });
  }
};

TEST(warps, that_leave_out_a_call_are_an_error)
{
  EXPECT_THROW(warp_on_cpu::run([] {
                 const GpuWarp warp;
                 const bool is_first = warp.rank() == 0 && warp.any(true);
                 EXPECT_EQ(warp.vote(is_first), 1u);
               }),
               std::logic_error);
}

TEST(warps, add_up_what_has_the_same_key_once)
{
  Random random(3);
  for (const int n_keys : {1, 3, 40}) {
    int key[kWarpSize];
    bool mine[kWarpSize], has_sum[kWarpSize];
    std::int64_t sums[kWarpSize][2];
    std::map<int, std::int64_t> expected;
    for (unsigned k = 0; k < kWarpSize; k++) {
      key[k] = static_cast<int>(uniform(random, 0, n_keys));
      mine[k] = uniform(random, 0, 1) < 0.8;
      sums[k][0] = static_cast<std::int64_t>(uniform(random, -1e17, 1e17));
      sums[k][1] = -sums[k][0];
      if (mine[k]) expected[key[k]] += sums[k][0];
    }
    warp_on_cpu::run([&] {
      const unsigned k = threadIdx.x;
      has_sum[k] = GpuWarp::sum_by_key(mine[k], key[k], sums[k]);
    });
    std::map<int, std::int64_t> found;
    for (unsigned k = 0; k < kWarpSize; k++) {
      if (!has_sum[k]) continue;
      EXPECT_TRUE(found.emplace(key[k], sums[k][0]).second) << "key " << key[k];
      EXPECT_EQ(sums[k][1], -sums[k][0]);
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(warps, make_the_records_of_a_CPU)
{
  const MovedWaves waves;
  ASSERT_NE(waves.mesh.faces.size() % kWarpSize, 0u);
  expect_same_records(moved_records_by(CpuBackend(), waves.mesh, waves.after),
                      moved_records_by(WarpBackend(), waves.mesh, waves.after));
}

// Spheres near the triangles of a mesh.
struct Spheres {
  std::vector<QuerySphere> all;

  Spheres(const WeldedMesh &mesh, int n, Real radius)
  {
    Random random(17);
    for (int k = 0; k < n; k++) {
      const auto &face =
          mesh.faces[static_cast<std::size_t>(uniform(random, 0, 1) * double(mesh.faces.size()))];
      Vec3 x = {0, 0, 0};
      for (const int v : face) x += Real(1) / 3 * mesh.vertices[v];
      for (int d = 0; d < 3; d++) x[d] += uniform(random, -radius, radius);
      all.push_back({x, radius, radius, nullptr, 0});
    }
  }
};

void expect_same_list(const FeatureList &a, const FeatureList &b)
{
  EXPECT_TRUE(a.x == b.x);
  EXPECT_EQ(a.margin, b.margin);
  EXPECT_EQ(a.cutoff, b.cutoff);
  ASSERT_EQ(a.n, b.n);
  for (int i = 0; i < a.n; i++) EXPECT_EQ(a.code[i], b.code[i]);
}

// By all threads of a warp, and by some. `has_full`: are there lists that have no room for the whole way?
void expect_lists(const WeldedMesh &mesh, Real radius, bool has_full)
{
  constexpr Real kGoing = 0.02;
  Box box = {mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3 &x : mesh.vertices) extend(box, x);
  CpuBackend b;
  const MeshFeatures features = make_moving_features(mesh, false);
  const MeshFeaturesView records = features.view();
  MovingGrid<CpuBackend> grid;
  grid.build(b, records, {features.primitives.data(), features.primitives.size()},
             {radius, 2 * kGoing, 1, box, "mesh"});
  const GridView view = grid.view(records);
  const Spheres spheres(mesh, 4 * kWarpSize, radius);
  int n_shorter = 0, n_none = 0, n_long = 0;
  for (std::size_t first = 0; first < spheres.all.size(); first += kWarpSize) {
    const std::uint32_t patterns[] = {~0u, 1u << 9, 0x80100401, 0x00f0f00f};
    const std::uint32_t mine = patterns[first / kWarpSize];
    FeatureList lists[kWarpSize];
    warp_on_cpu::run([&] {
      const unsigned k = threadIdx.x;
      gather_nodes(GpuWarp(), mine >> k & 1, view, spheres.all[first + k], kGoing, lists[k]);
    });
    for (unsigned k = 0; k < kWarpSize; k++) {
      if (!(mine >> k & 1)) continue;
      FeatureList expected;
      gather_nodes(Warp<1>(), true, view, spheres.all[first + k], kGoing, expected);
      expect_same_list(expected, lists[k]);
      n_shorter += expected.margin >= 0 && expected.margin < kSkinFraction * radius;
      n_none += expected.margin < 0;
      n_long += expected.n > 3;
    }
  }
  EXPECT_GT(n_long, 0);
  EXPECT_EQ(n_shorter + n_none > 0, has_full);
}

TEST(warps, list_what_a_thread_lists)
{
  expect_lists(waves(), 0.5, true);
  expect_lists(weld(cone_mesh(300, 6, 4), -1), 0.5, true);
  expect_lists(weld(box_mesh({0, 0, 0}, {2, 2, 2}), -1), 0.5, false);
}

// Spheres of a cloud, of which the list has all that follow one in its row, in up to three words. Some touch, of which most did a step
// ago; some have parted.
struct Cloud : GrainRows {
  static constexpr int kGrains = 75, kWords = 3;

  // `laws`: so many are looked up by type, or the one is in the kernel.
  Cloud(bool rolls, int laws) : GrainRows(kGrains, kGrains), n_laws(laws)
  {
    Random random(11);
    const auto fill = [&](std::vector<Real> &all, Real most) {
      for (Real &one : all) one = uniform(random, -most, most);
    };
    fill(x, 1.3);
    fill(v, 1);
    fill(omega, 1);
    law.k_normal = 1000;
    law.damping = DampingModel::velocity;
    law.eta = 1;
    law.tangential = TangentialModel::linear_history;
    law.k_tangent = 300;
    law.xgammat = 1;
    law.mu = 0.4;
    law.keeps_forces = true;
    if (rolls) law.rolling = {RollingModel::sds, {300, 2, 0.3}};
    const int width = 3 + law.n_extra();
    for (Real &one : radius) one = uniform(random, 0.3, 0.5);
    for (int i = 0; i < kGrains; i++) {
      length[i] = kGrains - 1 - i;
      first.push_back(n_now);
      old_first.push_back(n_old);
      for (int place = 0; place < kGrains; place++) {
        const int j = i + 1 + place;
        neighbor[kGrains * i + place] = j;
        if (j >= kGrains) continue;
        const std::size_t word = std::size_t(place / kWordBits) * kGrains + std::size_t(i);
        const std::uint32_t bit = std::uint32_t(1) << place % kWordBits;
        const Real gap = distance(i, j) - radius[i] - radius[j];
        const bool is_now = gap < 0, was = gap < 0.05 && uniform(random, 0, 1) < 0.8;
        if (is_now) words[word] |= bit;
        if (was) old_words[word] |= bit;
        n_now += is_now;
        n_old += was;
      }
    }
    numbers.resize(std::size_t(n_now) * width);
    old_numbers.resize(std::size_t(n_old) * width);
    book(CpuBackend(), {old_words.data(), old_first.data(), old_numbers.data(), std::size_t(n_old)},
         {});
  }
  Real distance(int i, int j) const
  {
    return norm(
        Vec3{x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1], x[3 * i + 2] - x[3 * j + 2]});
  }

  // Books all pairs; returns the sums of all that share one.
  template <class B>
  std::vector<EnergyRows> book(B &&b)
  {
    return book(std::forward<B>(b),
                {words.data(), first.data(), numbers.data(), std::size_t(n_now)},
                {old_words.data(), old_first.data(), old_numbers.data(), std::size_t(n_old)});
  }
  PairStepView step(const TouchingPairs &now, const TouchingPairs &old)
  {
    PairStepView s;
    give(s);
    s.dt = 1e-3;
    s.words = kWords;
    s.now = now;
    s.old = old;
    s.width = 3 + law.n_extra();
    s.law_of = s.kind_of = zeros.data();
    s.n_types = 2;
    s.n_pairs = &n_places;
    return s;
  }
  // Adds the forces of all pairs.
  template <bool kFull, class B>
  void add(B &&b)
  {
    const PairStepView s =
        step({words.data(), first.data(), numbers.data(), std::size_t(n_now)},
             {old_words.data(), old_first.data(), old_numbers.data(), std::size_t(n_old)});
    with_granular_law(law, [&](const auto &model) {
      b.for_each_in_warps(kGrains, AddPairs<std::decay_t<decltype(model)>, true, kFull>{s, model});
    });
  }
  template <class B>
  std::vector<EnergyRows> book(B &&b, const TouchingPairs &now, const TouchingPairs &old)
  {
    PairStepView s = step(now, old);
    const std::size_t share = std::decay_t<B>::kOnCpu ? 1 : kWarpSize;
    std::vector<EnergyRows> sums((kGrains + share - 1) / share);
    std::vector<char> is_booked(sums.size());
    s.n_laws = n_laws;
    with_booked_law(law, [&](const auto &model) {
      const LawBytes bytes(model);
      s.laws = &bytes;
      run_pair_book<std::decay_t<decltype(model)>>(s, bytes, sums.data(), is_booked.data(), b);
    });
    for (std::size_t k = 0; k < sums.size(); k++)
      EXPECT_TRUE(is_booked[k] || sums[k][EnergyRow::held] == 0);
    return sums;
  }

  ContactLaw law = granular_law(NormalModel::hooke);
  std::vector<Real> numbers, old_numbers;
  std::vector<int> first, old_first, zeros = std::vector<int>(4);
  std::vector<std::uint32_t> words = std::vector<std::uint32_t>(kWords * kGrains),
                             old_words = words;
  int n_now = 0, n_old = 0, n_laws;
  std::uint32_t n_places = 0;
};

// Checks that a warp adds to each grain what threads of a CPU add, and keeps the same springs.
template <bool kFull>
void expect_same_forces()
{
  Cloud alone(false, 1), shared(false, 1);
  alone.add<kFull>(CpuBackend());
  shared.add<kFull>(WarpBackend());
  EXPECT_EQ(alone.numbers, shared.numbers);
  Real largest[2] = {0, 0};
  for (std::size_t k = 0; k < alone.force.size(); k++) {
    largest[0] = std::max(largest[0], std::abs(alone.force[k]));
    largest[1] = std::max(largest[1], std::abs(alone.torque[k]));
  }
  ASSERT_GT(std::min(largest[0], largest[1]), 1);
  // A grain has less than kGrains contacts, of forces less than 10 times the largest sum, added in another order.
  for (std::size_t k = 0; k < alone.force.size(); k++) {
    EXPECT_NEAR(shared.force[k], alone.force[k], Cloud::kGrains * 1.2e-15 * largest[0]) << k;
    EXPECT_NEAR(shared.torque[k], alone.torque[k], Cloud::kGrains * 1.2e-15 * largest[1]) << k;
  }
}
TEST(warps, add_the_forces_of_a_half_list)
{
  expect_same_forces<false>();
}
TEST(warps, add_the_forces_of_a_full_list)
{
  expect_same_forces<true>();
}

// The sums and the kept forces of a GPU, with as many laws, are those of a CPU.
void expect_shared(bool rolls, int n_laws)
{
  Cloud alone(rolls, 2), shared(rolls, n_laws);
  const std::vector<EnergyRows> rows = alone.book(CpuBackend()), sums = shared.book(WarpBackend());
  ASSERT_GT(alone.n_now, 200);
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_EQ(alone.numbers, shared.numbers);    // the forces that each pair keeps
  for (int row = 0; row < kEnergyRows; row++) {
    Real of_rows = 0, of_sums = 0, size = 0;
    for (const EnergyRows &one : rows) {
      of_rows += one.of[row];
      size += std::abs(one.of[row]);
    }
    for (const EnergyRows &one : sums) of_sums += one.of[row];
    // Sums of less than 6000 numbers, two of a pair, in another order.
    EXPECT_NEAR(of_sums, of_rows, 6000 * 1.2e-16 * size) << "row " << row;
  }
  EXPECT_EQ(rolls, std::any_of(rows.begin(), rows.end(),
                               [](const EnergyRows &one) { return one[EnergyRow::rolling] != 0; }));
}

TEST(warps, share_the_pairs_that_they_book)
{
  for (const bool rolls : {false, true})
    for (const int n_laws : {1, 2}) expect_shared(rolls, n_laws);
}

}    // namespace
}    // namespace lsdcd::test_warps
