// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "mesh/triangle_soup.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>

// Files as programs write them, and broken ones, are in library/mesh_corpus.py; here is what is no matter of a file's text.
namespace lsdcd::test_read_stl {
namespace {

TriangleSoup read(const std::string &bytes)
{
  return read_stl_bytes(bytes.data(), bytes.size(), "test.stl");
}

std::string error_of(const std::string &bytes)
{
  return lsdcd::error_of([&] { read(bytes); });
}

std::string facet(const std::string &a, const std::string &b, const std::string &c)
{
  return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}

std::string solid(const std::string &facets)
{
  return "solid name\n" + facets + "endsolid name\n";
}

const std::string kFacet = facet("0 0 0", "1 0 0", "0 1 0");

// Little-endian on any machine.
std::string u32(std::uint32_t n)
{
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> (8 * i) & 0xff);
  return bytes;
}

std::string f32(float x)
{
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return u32(bits);
}

std::string record(std::initializer_list<float> corners, float normal = 0)
{
  std::string bytes = f32(normal) + f32(normal) + f32(normal);
  for (const float x : corners) bytes += f32(x);
  return bytes + std::string(2, '\0');
}

std::string binary(std::string header, std::uint32_t count, const std::string &records)
{
  header.resize(80, ' ');
  return header + u32(count) + records;
}

const std::string kRecord = record({0, 0, 0, 1, 0, 0, 0, 1, 0});

TEST(read_stl, binary_corners_are_the_floats_of_the_file)
{
  const auto soup = read(binary("", 1, record({0.1f, -2, 3e30f, 4, 5, 6, 7, 8, 9})));
  ASSERT_EQ(soup.corners.size(), 3u);
  EXPECT_EQ(soup.corners[0], (Vec3{0.1f, -2, 3e30f}));
  EXPECT_EQ(soup.corners[2], (Vec3{7, 8, 9}));
  EXPECT_EQ(known_rounding(soup).step, std::numeric_limits<float>::epsilon());
}

TEST(read_stl, binary_may_be_unaligned_in_memory)
{
  const std::string shifted = "x" + binary("", 1, kRecord);
  EXPECT_EQ(read_stl_bytes(shifted.data() + 1, shifted.size() - 1, "t").corners[1].x, 1);
}

TEST(read_stl, every_truncation_of_ascii_is_an_error)
{
  const std::string whole = solid(kFacet + facet("0.5 0 0", "1 0 0", "0 1 0.25"));
  const std::size_t end = whole.find("endsolid") + 8;    // the name may be lost
  for (std::size_t size = 0; size < end; ++size)
    EXPECT_NE(error_of(whole.substr(0, size)), "") << size;
}

std::string times(int n, const std::string &part)
{
  std::string all;
  for (int i = 0; i < n; ++i) all += part;
  return all;
}

TEST(read_stl, a_pipe_is_read_to_its_end)
{
  for (const std::string &bytes :
       {solid(times(5000, kFacet)), binary("", 5000, times(5000, kRecord))}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    std::thread writer([&] {
      for (std::size_t done = 0; done < bytes.size();)
        done += static_cast<std::size_t>(write(ends[1], bytes.data() + done, bytes.size() - done));
      close(ends[1]);
    });
    const auto soup = read_stl("/dev/fd/" + std::to_string(ends[0]));
    writer.join();
    close(ends[0]);
    EXPECT_EQ(soup.n_triangles(), 5000u);
  }
}

std::string path_error(const std::string &path)
{
  return lsdcd::error_of([&] { read_stl(path); });
}

// Zeros are a binary STL of no facets, of which no more than a beginning is read.
TEST(read_stl, a_pipe_without_end_is_refused_at_once)
{
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::size_t written = 0;
  std::thread writer([&] {
    const std::vector<char> zeros(4096, 0);
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    while (written < (std::size_t(64) << 20)) {
      const auto n = write(ends[1], zeros.data(), zeros.size());
      if (n < 0) break;    // nobody reads any more
      written += static_cast<std::size_t>(n);
    }
    close(ends[1]);
    std::signal(SIGPIPE, before);
  });
  const std::string error = path_error("/dev/fd/" + std::to_string(ends[0]));
  close(ends[0]);
  writer.join();
  EXPECT_TRUE(has(error, "0 facets promised by the header"));
  EXPECT_LT(written, std::size_t(1) << 20);    // and what the pipe itself holds, 64 kB
}

TEST(read_stl, what_is_no_file_is_told)
{
  TempDir dir;
  EXPECT_TRUE(has(path_error("/dev/zero"), "it is a device"));
  EXPECT_TRUE(says(path_error(dir.path("none.stl")), {"none.stl", "No such file"}));
  EXPECT_TRUE(has(path_error(dir.path("")), "it is a directory"));
}

// Far larger than memory, though it takes no room on the disk.
TEST(read_stl, a_file_of_another_kind_is_refused_by_its_beginning)
{
  TempDir dir;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "0 facets promised"},
      {std::string(200000, 'a') + "\n", "not an STL"},
      {std::string("\x7f"
                   "ELF\x02\x01\x01\0",
                   8) +
           std::string(100, '\x05'),
       "not an STL"}};
  for (const auto &c : cases) {
    const auto path = dir.write("other.stl", c.first);
    std::filesystem::resize_file(path, std::uintmax_t(1) << 42);
    EXPECT_TRUE(has(path_error(path), c.second));
  }
}

TEST(read_stl, a_file_longer_than_its_beginning_is_read_to_its_end)
{
  TempDir dir;
  const std::string facets = times(5000, kFacet);
  EXPECT_EQ(read_stl(dir.write("long.stl", solid(facets))).n_triangles(), 5000u);
  EXPECT_EQ(
      read_stl(dir.write("late.stl", std::string(100000, '\n') + solid(facets))).n_triangles(),
      5000u);
}
}    // namespace
}    // namespace lsdcd::test_read_stl
