// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/contact_history.h"
#include "law/contact_law.h"
#include "support/kept_springs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace lsdcd::test_contact_history {
namespace {

Spring spring(Real seed, FeatureCode feature)
{
  return {{seed, -seed / 3, seed * 1e-12}, {0.6, 0, 0.8}, feature, 0};
}

bool same(const Spring &a, const Spring &b)
{
  return a.shear == b.shear && a.normal == b.normal && a.feature == b.feature;
}

void expect_springs(const ContactHistory &store, int i, const std::vector<Spring> &expected)
{
  ASSERT_EQ(store.count(i), static_cast<int>(expected.size()));
  for (int k = 0; k < store.count(i); k++) EXPECT_TRUE(same(store.spring(i, k), expected[k]));
}

const std::vector<Spring> kTwo = {spring(0.1, 7), spring(-2, feature_code(FeatureKind::edge, 3))};
const std::vector<Spring> kThree = {spring(1, 1), spring(2, 2), spring(3, 3)};

TEST(contact_history, growing_keeps_what_is_there)
{
  ContactHistory store;
  store.grow(2);
  give_springs(store, 1, kTwo);
  store.grow(1000);
  expect_springs(store, 1, kTwo);
  EXPECT_EQ(store.count(999), 0);
  store.grow(3);    // never shrinks
  expect_springs(store, 1, kTwo);
}

TEST(contact_history, pack_and_unpack_are_a_round_trip)
{
  ContactHistory from, to;
  from.grow(3);
  to.grow(9);
  give_springs(from, 0, kTwo);
  give_springs(from, 2, kThree);
  std::vector<double> buffer(100, -7);
  int n = from.pack(0, buffer.data());
  EXPECT_EQ(n, from.packed_size(0));
  n += from.pack(1, buffer.data() + n);
  n += from.pack(2, buffer.data() + n);
  EXPECT_EQ(n, 3 + 5 * 7);
  EXPECT_EQ(buffer[n], -7);
  int m = to.unpack(8, buffer.data());
  m += to.unpack(4, buffer.data() + m);
  m += to.unpack(0, buffer.data() + m);
  EXPECT_EQ(m, n);
  expect_springs(to, 8, kTwo);
  expect_springs(to, 4, {});
  expect_springs(to, 0, kThree);
}

TEST(contact_history, packs_every_feature_code_and_the_last_bit_of_a_stretch)
{
  const auto through = [](const Spring &s) {
    ContactHistory from, to;
    from.grow(1);
    to.grow(1);
    give_springs(from, 0, {s});
    std::vector<double> buffer(from.packed_size(0));
    from.pack(0, buffer.data());
    to.unpack(0, buffer.data());
    return to.spring(0, 0);
  };
  for (FeatureKind kind : {FeatureKind::face, FeatureKind::edge, FeatureKind::vertex})
    for (std::uint32_t i : {0u, 1u, 0x3ffffffeu, kFeatureIndexMask}) {
      const FeatureCode feature = through(spring(1, feature_code(kind, i))).feature;
      EXPECT_EQ(feature_kind(feature), kind);
      EXPECT_EQ(feature_index(feature), i);
    }
  const Real next = std::nextafter(1.0, 2.0), tiny = std::numeric_limits<Real>::denorm_min();
  const Vec3 shear = through({{next, -tiny, -0.0}, {1, 0, 0}, 5, 0}).shear;
  EXPECT_EQ(shear.x, next);
  EXPECT_EQ(shear.y, -tiny);
  EXPECT_TRUE(std::signbit(shear.z));
}

TEST(contact_history, copy_gives_a_sphere_the_springs_of_another)
{
  ContactHistory store;
  store.grow(3);
  give_springs(store, 0, kTwo);
  give_springs(store, 2, kThree);
  store.copy(2, 0);
  expect_springs(store, 0, kThree);
  store.copy(1, 2);    // a sphere without any
  expect_springs(store, 2, {});
  expect_springs(store, 0, kThree);
}

TEST(contact_history, unpacking_into_a_sphere_leaves_its_copies_alone)
{
  ContactHistory store;
  store.grow(3);
  give_springs(store, 0, kTwo);
  store.copy(0, 1);
  std::vector<double> buffer(100);
  give_springs(store, 2, kThree);
  store.pack(2, buffer.data());
  store.unpack(0, buffer.data());
  expect_springs(store, 0, kThree);
  expect_springs(store, 1, kTwo);
}

// ---- numbers beside the springs ------------------------------------------------------

const std::vector<Real> kExtra = {1, -2, 3.5, 4, 5, -6e-300};    // two for each of three

void expect_extra(const ContactHistory &store, int i, const std::vector<Real> &expected)
{
  EXPECT_EQ(extra_of(store, i), expected);
}

TEST(contact_history, extra_numbers_go_wherever_their_springs_go)
{
  ContactHistory from(2), to(2);
  from.grow(3);
  to.grow(3);
  give_springs(from, 1, kTwo, {kExtra.begin() + 2, kExtra.end()});
  give_springs(from, 2, kThree, kExtra);
  from.copy(2, 0);
  expect_extra(from, 0, kExtra);
  expect_extra(from, 1, {kExtra.begin() + 2, kExtra.end()});
  std::vector<double> buffer(100, -7);
  EXPECT_EQ(from.pack(2, buffer.data()), 1 + 3 * 9);
  EXPECT_EQ(buffer[1 + 3 * 9], -7);
  EXPECT_EQ(to.unpack(0, buffer.data()), 1 + 3 * 9);
  expect_springs(to, 0, kThree);
  expect_extra(to, 0, kExtra);
  EXPECT_EQ(from.largest_packed_size(), 1 + 3 * 9);
}

// As many numbers as each other, and of another meaning.
TEST(history_kind, differs_where_the_numbers_are_not_the_same)
{
  std::vector<ContactLaw> laws(9, granular_law(NormalModel::hooke));
  laws[0] = classic_law(NormalModel::hooke, true);
  laws[1] = classic_law(NormalModel::hooke, false);
  laws[1].rolling = RollingModel::epsd2;
  laws[2].tangential = TangentialModel::mindlin_force;
  laws[3].tangential = TangentialModel::mindlin_rescale;
  laws[4].tangential = TangentialModel::mindlin_rescale_force;
  laws[5].rolling = RollingModel::sds;
  laws[6].twisting = TwistingModel::marshall;
  laws[7].twisting = TwistingModel::sds;
  laws[8].normal = NormalModel::jkr;
  std::set<int> seen;
  for (const ContactLaw &law : laws) EXPECT_TRUE(seen.insert(law.history_kind()).second);
}

TEST(history_kind, is_the_same_for_displacements_of_all_laws)
{
  const ContactLaw hertz = classic_law(NormalModel::hertz, true);
  for (TangentialModel model :
       {TangentialModel::linear_history, TangentialModel::linear_history_slip,
        TangentialModel::mindlin, TangentialModel::mindlin_slip}) {
    ContactLaw law = granular_law(NormalModel::hooke);
    law.tangential = model;
    EXPECT_EQ(hertz.history_kind(), law.history_kind());
  }
}

}    // namespace
}    // namespace lsdcd::test_contact_history
