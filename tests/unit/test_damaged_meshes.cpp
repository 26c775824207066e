// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files of every format, cut or with a bit turned over, are a mesh or an InputError. Another exception, a crash or
// (under CTest's limit of time) a hang fails the test.
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "output/mesh_file.h"
#include "support/random.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <optional>

namespace lsdcd::test_damaged_meshes {
namespace {

constexpr int kTimes = 100;

ReadMesh read_stl_mesh(const char *bytes, std::size_t size, const std::string &source)
{
  return {read_stl_bytes(bytes, size, source), 0, {}};
}

struct Whole {
  std::string name, bytes;
  ReadMesh (*read)(const char *bytes, std::size_t size, const std::string &source);
  bool has_counts = true;    // OBJ has none: if it ends early, it is whole again
};

void PrintTo(const Whole &file, std::ostream *out)
{
  *out << file.name;
}

// Files that we write, with floats and other numbers, and polygons and strips as others write them.
std::vector<Whole> whole_files()
{
  const TempDir dir;
  Random random(50);
  std::vector<Whole> files;
  for (const bool floats : {true, false}) {
    TriangleSoup soup;
    for (int i = 0; i < 90; ++i) {
      const Vec3 x = uniform(random, {-1, -1, -1}, {1, 1, 1});
      soup.corners.push_back(floats ? Vec3{float(x.x), float(x.y), float(x.z)} : x);
    }
    for (Whole file : {Whole{".stl", "", read_stl_mesh}, Whole{".obj", "", read_obj_bytes, false},
                       Whole{".ply", "", read_ply_bytes}, Whole{".off", "", read_off_bytes}}) {
      file.name.insert(0, floats ? "floats" : "doubles");
      write_mesh_file(dir.path(file.name), soup);
      file.bytes = content(dir.path(file.name));
      files.push_back(file);
    }
  }
  const std::string vertices = "element vertex 6\nproperty float x\nproperty float y\n"
                               "property float z\nproperty uchar red\n";
  const std::string rows = "0 0 0 1\n2 0 0 2\n2 1 0 3\n1 1 0 4\n1 2 0 5\n0 2 0 6\n";
  const std::string begin = "ply\nformat ascii 1.0\ncomment made by hand\n" + vertices;
  files.push_back({"polygons.ply",
                   begin +
                       "element face 2\nproperty list uchar int vertex_indices\n"
                       "element edge 1\nproperty int a\nproperty int b\nend_header\n" +
                       rows + "6 0 1 2 3 4 5\n4 0 1 2 3\n0 1\n",
                   read_ply_bytes});
  files.push_back({"strips.ply",
                   begin +
                       "element tristrips 1\nproperty list int int vertex_index\n"
                       "end_header\n" +
                       rows + "10 0 1 5 4 -1 3 4 2 5 -1\n",
                   read_ply_bytes});
  files.push_back({"polygons.obj",
                   "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                   "usemtl b\nf 1 2 3 4 5 6 # an L\nl 1 2\nf -6//1 -5//1 \\\n-4//1 -3//1\n",
                   read_obj_bytes, false});
  files.push_back({"polygons.off",
                   "OFF # an L\n6 2 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0 255 0 0\n1 2 0\n0 2 0\n"
                   "6 0 1 2 3 4 5 0 0 1\n4 0 1 2 3\n",
                   read_off_bytes});
  return files;
}

class damaged : public testing::TestWithParam<Whole> {
 protected:
  // Nothing: it is refused.
  std::optional<TriangleSoup> read(const std::string &bytes) const
  {
    try {
      TriangleSoup soup = GetParam().read(bytes.data(), bytes.size(), "damaged").soup;
      for (const Vec3 &x : soup.corners)
        EXPECT_TRUE(std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z));
      EXPECT_FALSE(soup.corners.empty());
      return soup;
    } catch (const InputError &error) {
      EXPECT_EQ(std::string(error.what()).rfind("damaged", 0), 0u) << error.what();
      return {};
    }
  }
};

// In text the last number may have lost digits: no format but STL would show that.
TEST_P(damaged, a_cut_file_is_no_smaller_mesh)
{
  const std::string &whole = GetParam().bytes;
  const TriangleSoup soup = read(whole).value();
  const std::size_t last_word = whole.find_last_of(" \n", whole.find_last_not_of(" \n")) + 1;
  Random random(1);
  for (int i = 0; i < kTimes; ++i) {
    const std::size_t size = random() % whole.size();
    const auto cut = read(whole.substr(0, size));
    if (!cut) continue;
    EXPECT_LE(cut->n_triangles(), soup.n_triangles()) << size;
    if (!GetParam().has_counts) continue;
    EXPECT_EQ(cut->n_triangles(), soup.n_triangles()) << size;
    EXPECT_GT(size, last_word);
  }
}

TEST_P(damaged, a_bit_turned_over_is_a_mesh_or_an_error)
{
  const std::string &whole = GetParam().bytes;
  Random random(2);
  for (int i = 0; i < kTimes; ++i) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
    read(bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(files, damaged, testing::ValuesIn(whole_files()), [](const auto &row) {
  std::string name = row.param.name;
  name[name.find('.')] = '_';
  return name;
});

}    // namespace
}    // namespace lsdcd::test_damaged_meshes
