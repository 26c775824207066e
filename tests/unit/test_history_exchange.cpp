// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The history of contacts: written to restart files and read from them.
#include "support/fake_host.h"
#include "support/kept_springs.h"
#include "wall/spheres/history_exchange.h"

#include <gtest/gtest.h>

#include <vector>

namespace lsdcd::test_history_exchange {
namespace {

constexpr FeatureCode kFace = 5, kImage = 9;

// One mesh; contacts keep a shear displacement.
WallSpec wall()
{
  WallSpec settings;
  settings.meshes.resize(1);
  settings.laws[0].law = classic_law(NormalModel::hooke, true);
  return settings;
}

// History of two spheres on a process: sphere 1 has one contact with this feature.
void give_spring(HistoryExchange &history, FeatureCode feature)
{
  history.grow(2);
  ContactHistory &store = history.on_cpu();
  give_springs(store, 1, {{{0.25, -0.5, 0}, {0, 0, 1}, feature, 0}});
}

FeatureCode without_image(int /*mesh*/, FeatureCode feature)
{
  return feature == kImage ? kFace : feature;
}

bool is_face(const Spring &s)
{
  return s.feature == kFace;
}

TEST(HistoryExchange, of_an_image_is_written_as_of_what_it_is_an_image_of)
{
  FakeHost host;
  const WallSpec settings = wall();
  HistoryExchange written(host, settings.law()), read(host, settings.law());
  give_spring(written, kImage);
  std::vector<double> buffer(written.max_packed_size());
  const int size = written.pack_saved(1, buffer.data(), without_image);
  read.set_kind_of_file(settings.law().history_kind());
  read.grow(2);
  read.unpack_saved(1, buffer.data(), size);
  ASSERT_EQ(read.on_cpu().count(1), 1);
  EXPECT_EQ(read.on_cpu().spring(1, 0).feature, kFace);
  EXPECT_EQ(written.on_cpu().spring(1, 0).feature, kImage);    // is as it was
}

TEST(HistoryExchange, of_features_that_are_not_there_is_dropped_and_told)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall();
    HistoryExchange history(host, settings.law());
    give_spring(history, host.rank() == 0 ? kFace : kImage);
    history.check_restored(2, is_face);
    EXPECT_TRUE(history.is_checked());
    EXPECT_EQ(history.on_cpu().count(1), host.rank() == 0 ? 1 : 0);
    ASSERT_EQ(host.warnings.size(), 1u);
    EXPECT_EQ(host.warnings[0],
              "1 sphere loses its springs: the saved state was written with a different mesh");
  });
}

// A wall that lists contacts with their energies keeps numbers behind the others, which one that does not list them leaves out.
TEST(HistoryExchange, of_walls_that_keep_losses_and_that_do_not_go_to_each_other)
{
  FakeHost host;
  ContactLaw plain = wall().law();
  plain.keeps_forces = true;
  ContactLaw listing = plain;
  listing.keeps_losses = true;
  const int n_plain = plain.n_extra(), n_listing = listing.n_extra();
  ASSERT_EQ(n_listing, n_plain + kKeptLosses);
  for (const bool to_listing : {false, true}) {
    const ContactLaw &from = to_listing ? plain : listing, &to = to_listing ? listing : plain;
    HistoryExchange written(host, from), read(host, to);
    written.grow(2);
    const std::vector<Spring> two = {{{0.25, -0.5, 0}, {0, 0, 1}, kFace, 0},
                                     {{1, 2, 0}, {0, 0, 1}, kImage, 0}};
    std::vector<Real> extra;
    for (int k = 0; k < 2 * from.n_extra(); k++) extra.push_back(1 + k);
    give_springs(written.on_cpu(), 1, two, extra);
    std::vector<double> buffer(written.max_packed_size());
    const auto as_it_is = [](int, FeatureCode feature) { return feature; };
    const int size = written.pack_saved(1, buffer.data(), as_it_is);
    read.set_kind_of_file(from.history_kind());
    read.grow(2);
    read.unpack_saved(1, buffer.data(), size);
    ASSERT_EQ(read.on_cpu().count(1), 2);
    for (int c = 0; c < 2; c++) {
      EXPECT_EQ(read.on_cpu().spring(1, c).shear, two[c].shear);
      for (int k = 0; k < to.n_extra(); k++)
        EXPECT_EQ(extra_of(read.on_cpu(), 1)[c * to.n_extra() + k],
                  k < n_plain ? 1 + c * from.n_extra() + k : 0);
    }
  }
}

TEST(HistoryExchange, follows_features_that_get_other_names)
{
  FakeHost host;
  const WallSpec settings = wall();
  HistoryExchange history(host, settings.law());
  give_spring(history, kImage);
  history.rename_features(without_image);
  EXPECT_EQ(history.on_cpu().spring(1, 0).feature, kFace);
}

}    // namespace
}    // namespace lsdcd::test_history_exchange
