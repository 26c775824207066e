// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The history of contacts: moved to an engine and back, written to restart files and read from them.
#include "support/fake_host.h"
#include "wall/history_exchange.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace lsdcd::test_history_exchange {
namespace {

constexpr FeatureCode kFace = 5, kImage = 9;

// One mesh; contacts keep a shear displacement, or nothing.
WallSpec wall(bool keeps = true)
{
  WallSpec settings;
  settings.meshes.resize(1);
  settings.laws[0].law = classic_law(NormalModel::hooke, keeps);
  return settings;
}

// History of two spheres on a process: sphere 1 has one contact with this feature.
void give_spring(HistoryExchange &history, FeatureCode feature)
{
  history.grow(2);
  ContactHistory &store = history.on_cpu();
  const Spring one = {{0.25, -0.5, 0}, {0, 0, 1}, feature, 0};
  store.set(1, &one, nullptr, 1);
}

FeatureCode without_image(int /*mesh*/, FeatureCode feature)
{
  return feature == kImage ? kFace : feature;
}

bool is_face(const Spring &s)
{
  return s.feature == kFace;
}

TEST(HistoryExchange, comes_back_from_the_engine_as_it_went)
{
  FakeHost host;
  const WallSpec settings = wall();
  HistoryExchange history(host, settings);
  EngineSettings of_engine;
  of_engine.law() = settings.law();
  of_engine.device = Device::cpu;
  const std::unique_ptr<WallEngine> engine = make_engine(of_engine);
  history.set_engine(*engine);
  give_spring(history, kFace);
  history.to_engine(2);
  EXPECT_TRUE(history.is_with_engine());
  history.grow(3);
  const ContactHistory &back = history.on_cpu();
  EXPECT_FALSE(history.is_with_engine());
  EXPECT_EQ(back.count(0), 0);
  ASSERT_EQ(back.count(1), 1);
  EXPECT_EQ(back.of(1)->shear, (Vec3{0.25, -0.5, 0}));
  EXPECT_EQ(back.count(2), 0);    // room for a third sphere
}

TEST(HistoryExchange, of_a_law_that_keeps_nothing_stays_where_it_is)
{
  FakeHost host;
  const WallSpec settings = wall(false);
  HistoryExchange history(host, settings);
  history.to_engine(2);    // there is no engine
  EXPECT_FALSE(history.is_with_engine());
  EXPECT_EQ(history.max_packed_size(), 0);
}

TEST(HistoryExchange, of_an_image_is_written_as_of_what_it_is_an_image_of)
{
  FakeHost host;
  const WallSpec settings = wall();
  HistoryExchange written(host, settings), read(host, settings);
  give_spring(written, kImage);
  std::vector<double> buffer(written.max_packed_size());
  const int size = written.pack_saved(1, buffer.data(), without_image);
  read.set_kind_of_file(settings.law().history_kind());
  read.grow(2);
  read.unpack_saved(1, buffer.data(), size);
  ASSERT_EQ(read.on_cpu().count(1), 1);
  EXPECT_EQ(read.on_cpu().of(1)->feature, kFace);
  EXPECT_EQ(written.on_cpu().of(1)->feature, kImage);    // is as it was
}

TEST(HistoryExchange, of_another_law_is_not_taken_and_told_once)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall();
    HistoryExchange written(host, settings), read(host, settings);
    give_spring(written, kFace);
    std::vector<double> buffer(written.max_packed_size());
    const int size = written.pack_saved(1, buffer.data(), without_image);
    read.set_kind_of_file(settings.law().history_kind() + 1);
    read.grow(2);
    read.unpack_saved(1, buffer.data(), size);
    EXPECT_EQ(read.on_cpu().count(1), 0);
    read.check_restored(2, is_face);
    ASSERT_EQ(host.warnings.size(), 1u);
    EXPECT_EQ(
        host.warnings[0],
        "2 spheres lose their springs: the saved state was written with a different contact law");
  });
}

TEST(HistoryExchange, of_features_that_are_not_there_is_dropped_and_told)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall();
    HistoryExchange history(host, settings);
    give_spring(history, host.rank() == 0 ? kFace : kImage);
    history.check_restored(2, is_face);
    EXPECT_TRUE(history.is_checked());
    EXPECT_EQ(history.on_cpu().count(1), host.rank() == 0 ? 1 : 0);
    ASSERT_EQ(host.warnings.size(), 1u);
    EXPECT_EQ(host.warnings[0],
              "1 sphere loses its springs: the saved state was written with a different mesh");
  });
}

TEST(HistoryExchange, follows_features_that_get_other_names)
{
  FakeHost host;
  const WallSpec settings = wall();
  HistoryExchange history(host, settings);
  give_spring(history, kImage);
  history.rename_features(without_image);
  EXPECT_EQ(history.on_cpu().of(1)->feature, kFace);
}

}    // namespace
}    // namespace lsdcd::test_history_exchange
