// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/threads.h"
#include "base/input_error.h"
#include "grid/cache/grid_cache.h"
#include "grid/flat_grid.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lsdcd::test_grid_cache {
namespace {

namespace fs = std::filesystem;

QueryGridSettings some_settings()
{
  QueryGridSettings settings;
  settings.cutoff = 0.2;
  settings.length = 0.1;
  return settings;
}

// A grid, flat, and the key of its mesh and settings.
struct Made {
  explicit Made(const TriangleSoup &soup, const QueryGridSettings &settings = some_settings()) :
      settings(settings), mesh(weld(soup, -1)), grid(build_grid(mesh, settings)),
      block(flat_bytes(grid)), key(grid_key(mesh, settings))
  {
    flatten(grid, block.data());
  }

  std::size_t write(const std::string &path) const { return write(path, key); }
  std::size_t write(const std::string &path, const GridKey &as) const
  {
    return write_grid_cache(path, as, grid.report, block.data(), block.size());
  }
  // The result of a start: the state, and `usable` only if every bit is right.
  CacheState state(const std::string &path, std::string *problem = nullptr) const
  {
    CachedGrid cached(path, key);
    if (cached.state() == CacheState::usable) {
      std::vector<char> read(cached.block_bytes(), 'x');
      if (cached.read(read.data())) {
        EXPECT_TRUE(read == block) << "a wrong grid was taken for the right one";
      }
    }
    if (problem) *problem = cached.problem();
    return cached.state();
  }

  QueryGridSettings settings;
  WeldedMesh mesh;
  QueryGrid grid;
  std::vector<char> block;
  GridKey key;
};

const Made &box()
{
  static const Made made(box_mesh({0, 0, 0}, {1, 1, 1}));
  return made;
}

// Large enough for several frames.
const Made &cylinder()
{
  static const Made made([] {
    QueryGridSettings settings = some_settings();
    settings.length = 0.03;
    return Made(cylinder_mesh(100, 10, 1, 2), settings);
  }());
  return made;
}

TEST(grid_cache, a_grid_comes_back_bit_for_bit)
{
  TempDir dir;
  for (const Made *made : {&box(), &cylinder()}) {
    const std::string path = dir.path("grid");
    const std::size_t bytes = made->write(path);
    EXPECT_EQ(bytes, fs::file_size(path));
    EXPECT_EQ(made->state(path), CacheState::usable);
  }
  EXPECT_GT(cylinder().block.size(), 4u << 20) << "one frame only";
}

TEST(grid_cache, lists_of_the_nearest_and_records_in_floats_come_back_too)
{
  TempDir dir;
  for (const bool in_floats : {false, true}) {
    QueryGridSettings settings = some_settings();
    settings.nearest = 2;
    settings.in_floats = in_floats;
    const Made made(cylinder_mesh(20, 3, 1, 2), settings);
    made.write(dir.path("grid"));
    EXPECT_EQ(made.state(dir.path("grid")), CacheState::usable);
  }
}

TEST(grid_cache, the_report_of_the_build_comes_back)
{
  TempDir dir;
  const std::string path = dir.path("grid");
  box().write(path);
  EXPECT_EQ(describe(CachedGrid(path, box().key).report()), describe(box().grid.report));
}

// ---- damage ------------------------------------------------------------------------------

TEST(grid_cache, a_file_cut_off_anywhere_is_damaged)
{
  TempDir dir;
  const std::string path = dir.path("grid");
  for (const Made *made : {&box(), &cylinder()}) {
    std::size_t n = made->write(path);
    ASSERT_GT(n, 4096u);
    for (n--; n > 0; n = n > 1024 ? (n - 1) / 1024 * 1024 : n - std::min<std::size_t>(n, 7)) {
      fs::resize_file(path, n);
      ASSERT_EQ(CachedGrid(path, made->key).state(), CacheState::damaged) << "from the header on";
      ASSERT_EQ(made->state(path), CacheState::damaged) << n << " bytes";
    }
  }
}

// Flips n single bits one at a time, every second one in the first kilobyte. A few bits
// of a compressed stream mean nothing: the grid is then right, which state() looks at.
void flip_bits(const Made &made, int n)
{
  TempDir dir;
  made.write(dir.path("grid"));
  const std::string whole = content(dir.path("grid"));
  std::fstream file(dir.path("grid"), std::ios::in | std::ios::out | std::ios::binary);
  const auto put = [&](std::size_t at, char c) { file.seekp(at).put(c).flush(); };
  std::mt19937_64 random(1);
  int harmless = 0;
  for (int i = 0; i < n; i++) {
    const std::size_t at = random() % (i % 2 ? 1024 : whole.size());
    put(at, whole[at] ^ 1 << random() % 8);
    const CacheState found = made.state(dir.path("grid"));
    put(at, whole[at]);
    if (found == CacheState::usable)
      harmless++;
    else
      ASSERT_EQ(found, CacheState::damaged) << "byte " << at;
  }
  EXPECT_EQ(made.state(dir.path("grid")), CacheState::usable) << "the test itself did damage";
  EXPECT_LE(harmless, n / 100);
}

TEST(grid_cache, a_flipped_bit_never_gives_a_wrong_grid)
{
  flip_bits(box(), std::getenv("LSDCD_QUICK") ? 300 : 10000);
}

TEST(grid_cache, a_flipped_bit_in_any_frame_never_gives_a_wrong_grid)
{
  flip_bits(cylinder(), 100);
}

TEST(grid_cache, a_file_with_other_bytes_than_were_written_is_damaged)
{
  TempDir dir;
  const Made other(box_mesh({0, 0, 0}, {1, 1, 1.0000001}));
  const std::size_t half = box().write(dir.path("grid")) / 2;
  other.write(dir.path("other"));
  ASSERT_EQ(other.block.size(), box().block.size());
  const std::string whole = content(dir.path("grid")), front = whole.substr(0, half);
  const std::pair<const char *, std::string> rows[] = {
      {"longer", whole + "x"},
      {"with frames of another grid", front + content(dir.path("other")).substr(half)},
      {"with zeros after a crash", front + std::string(whole.size() - half, '\0')},
      {"empty", ""}};
  for (const auto &[what, bytes] : rows)
    EXPECT_EQ(box().state(dir.write("file", bytes)), CacheState::damaged) << what;
}

// ---- of something else -------------------------------------------------------------------

TEST(grid_cache, another_version_is_told)
{
  TempDir dir;
  GridKey older = box().key;
  older.version.low ^= 1;
  box().write(dir.path("grid"), older);
  EXPECT_EQ(box().state(dir.path("grid")), CacheState::other_version);
}

TEST(grid_cache, another_mesh_is_told)
{
  TempDir dir;
  // One corner, by the least that a double can move.
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 1});
  for (Vec3 &x : soup.corners)
    if (x == Vec3{1, 1, 1}) x.z = std::nextafter(1., 2.);
  Made(soup).write(dir.path("grid"));
  EXPECT_EQ(box().state(dir.path("grid")), CacheState::other_mesh);
}

TEST(grid_cache, the_name_of_the_mesh_file_does_not_matter)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 1});
  soup.source = "elsewhere.stl";
  EXPECT_TRUE(grid_key(weld(soup, -1), some_settings()).mesh == box().key.mesh);
}

TEST(grid_cache, every_setting_is_told)
{
  TempDir dir;
  const std::string path = dir.path("grid");
  const auto with = [&](void (*change)(QueryGridSettings &)) {
    QueryGridSettings settings = some_settings();
    change(settings);
    box().write(path, grid_key(box().mesh, settings));
    return box().state(path);
  };
  EXPECT_EQ(with([](QueryGridSettings &) {}), CacheState::usable);
  EXPECT_EQ(with([](QueryGridSettings &s) { s.length = 0; }), CacheState::other_settings);
  EXPECT_EQ(with([](QueryGridSettings &s) { s.cutoff = std::nextafter(s.cutoff, 1.); }),
            CacheState::other_settings);
  EXPECT_EQ(with([](QueryGridSettings &s) { s.memory_budget++; }), CacheState::other_settings);
  EXPECT_EQ(with([](QueryGridSettings &s) { s.sides = true; }), CacheState::other_settings);
  EXPECT_EQ(with([](QueryGridSettings &s) { s.nearest = 1; }), CacheState::other_settings);
  EXPECT_EQ(with([](QueryGridSettings &s) { s.in_floats = true; }), CacheState::other_settings);
  StepGridSettings for_steps;
  static_cast<GridSettings &>(for_steps) = some_settings();
  box().write(path, grid_key(box().mesh, for_steps));
  EXPECT_EQ(box().state(path), CacheState::other_settings);
}

// A pipe is not waited for.
TEST(grid_cache, what_is_no_file_of_ours_is_foreign)
{
  TempDir dir;
  const char *const files[] = {"x", "solid floor\nfacet normal 0 0 1\n", "LAMMPS data file\n\n"};
  for (const char *file : files)
    EXPECT_EQ(box().state(dir.write("file", file)), CacheState::foreign) << file;
  EXPECT_EQ(box().state(dir.path("")), CacheState::foreign);
  ASSERT_EQ(mkfifo(dir.path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(box().state(dir.path("pipe")), CacheState::foreign);
}

// ---- writing -----------------------------------------------------------------------------

// Files in the folder.
int files_in(const std::string &folder)
{
  int n = 0;
  for (const auto &entry : fs::directory_iterator(folder)) n += entry.exists();
  return n;
}

// The error of write(), or "".
std::string error_of_writing(const Made &made, const std::string &path)
{
  return lsdcd::error_of([&] { made.write(path); });
}

// A process of its own that runs `work` and ends well where it returned true. It works alone: the
// threads that the parent has are not forked, and OpenMP would wait for them.
template <class Work>
pid_t start_child(Work &&work)
{
  const pid_t child = fork();
  if (child == 0) {
    const OneThread alone;
    _exit(work() ? 0 : 1);
  }
  return child;
}

// Does one end well?
template <class Work>
bool in_child(Work &&work)
{
  const pid_t child = start_child(work);
  int status = 1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(grid_cache, a_reader_keeps_the_file_that_it_opened)
{
  TempDir dir;
  const std::string path = dir.path("grid");
  box().write(path);
  CachedGrid cached(path, box().key);
  cylinder().write(path);
  std::vector<char> read(cached.block_bytes());
  ASSERT_TRUE(cached.read(read.data()));
  EXPECT_TRUE(read == box().block);
}

TEST(grid_cache, a_link_stays_and_its_file_is_replaced)
{
  TempDir dir;
  const std::string path = dir.write("grid", "damaged");
  fs::create_symlink(path, dir.path("link"));
  box().write(dir.path("link"));
  EXPECT_TRUE(fs::is_symlink(dir.path("link")));
  EXPECT_EQ(box().state(path), CacheState::usable);
}

TEST(grid_cache, a_read_only_folder_is_an_error_and_stays_as_it_is)
{
  TempDir dir;
  const std::string folder = dir.path("");
  chmod(folder.c_str(), 0555);
  const std::string path = dir.path("grid");
  EXPECT_TRUE(in_child([&] {
    if (geteuid() == 0 && setuid(65534) != 0) return false;    // root may write anywhere
    return error_of_writing(box(), path).find("Permission denied") != std::string::npos;
  }));
  chmod(folder.c_str(), 0755);
  EXPECT_EQ(files_in(folder), 0);
}

// A limit on the size of files is met like a full disk, in the middle of writing.
TEST(grid_cache, a_full_disk_is_an_error_and_leaves_the_old_file)
{
  TempDir dir;
  const std::string path = dir.path("grid");
  const std::size_t bytes = box().write(path);
  EXPECT_TRUE(in_child([&] {
    const rlimit limit = {bytes + 8192, bytes + 8192};
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return false;
    return error_of_writing(cylinder(), path).find("File too large") != std::string::npos;
  }));
  EXPECT_EQ(files_in(dir.path("")), 1);
  EXPECT_EQ(box().state(path), CacheState::usable);
}

// Several processes write and read at once: whoever reads finds nothing or one of
// the whole files, and one is left.
TEST(grid_cache, writers_at_once_leave_one_good_file)
{
  TempDir dir;
  const std::string path = dir.path("grid");
  const Made other(box_mesh({0, 0, 0}, {1, 1, 2}));
  std::vector<pid_t> children;
  for (int k = 0; k < 6; k++) {
    children.push_back(start_child([&] {
      bool good = true;
      for (int i = 0; i < 10; i++) {
        if (k < 4) (k % 2 ? other : box()).write(path);
        const CacheState found = box().state(path);
        good = good && (found == CacheState::usable || found == CacheState::other_mesh ||
                        (found == CacheState::missing && k >= 4));
      }
      return good && !testing::Test::HasFailure();
    }));
  }
  for (const pid_t child : children) {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(files_in(dir.path("")), 1);
  EXPECT_TRUE(box().state(path) == CacheState::usable || other.state(path) == CacheState::usable);
}

}    // namespace
}    // namespace lsdcd::test_grid_cache
