// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "output/mesh_file.h"
#include "support/random.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>

namespace lsdcd::test_read_ply {
namespace {

ReadMesh read(const std::string &bytes)
{
  return read_ply_bytes(bytes.data(), bytes.size(), "test.ply");
}

std::string error_of(const std::string &bytes)
{
  return lsdcd::error_of([&] { read(bytes); });
}

std::string with_line_ends(const std::string &text, const std::string &end)
{
  std::string changed;
  for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
  return changed;
}

// The bytes of a number, in any order whatever the machine is.
template <class Number>
std::string bytes_of(Number x, bool big_endian)
{
  std::uint64_t bits = 0;
  if constexpr (std::is_same_v<Number, float>) {
    std::uint32_t half;
    std::memcpy(&half, &x, sizeof half);
    bits = half;
  } else if constexpr (std::is_same_v<Number, double>) {
    std::memcpy(&bits, &x, sizeof bits);
  } else {
    bits = static_cast<std::uint64_t>(x);
  }
  std::string bytes;
  for (std::size_t i = 0; i < sizeof x; ++i)
    bytes += static_cast<char>(bits >> 8 * (big_endian ? sizeof x - 1 - i : i) & 255);
  return bytes;
}

struct Type {
  const char *name, *sized_name;
  std::string (*bytes)(double, bool big_endian);
  double low, high;    // two of its numbers, the second above 127
};

template <class Number>
std::string bytes_as(double x, bool big_endian)
{
  return bytes_of(static_cast<Number>(x), big_endian);
}

const Type kTypes[] = {
    {"char", "int8", bytes_as<std::int8_t>, -128, 127},
    {"uchar", "uint8", bytes_as<std::uint8_t>, 0, 255},
    {"short", "int16", bytes_as<std::int16_t>, -32768, 258},
    {"ushort", "uint16", bytes_as<std::uint16_t>, 2570, 65535},
    {"int", "int32", bytes_as<std::int32_t>, -2147483648., 2147483647},
    {"uint", "uint32", bytes_as<std::uint32_t>, 66051, 4294967295.},
    {"float", "float32", bytes_as<float>, 0.1f, -3e30f},
    {"double", "float64", bytes_as<double>, 0.1, -1e300},
};

const char *const kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

// Writes the header and the numbers of a file in any of the three formats.
class Ply {
 public:
  explicit Ply(const std::string &format) :
      text_(format == "ascii"), big_endian_(format == "binary_big_endian"),
      bytes_("ply\nformat " + format + " 1.0\n")
  {
  }

  Ply &line(const std::string &words)
  {
    bytes_ += words + '\n';
    return *this;
  }
  Ply &vertices(int n, const std::string &type = "float")
  {
    line("element vertex " + std::to_string(n));
    for (const char *axis : {"x", "y", "z"}) line("property " + type + ' ' + axis);
    return *this;
  }
  Ply &faces(int n, const std::string &list = "uchar int vertex_indices")
  {
    return line("element face " + std::to_string(n)).line("property list " + list);
  }
  Ply &end_header() { return line("end_header"); }

  Ply &put(const std::string &type, const std::vector<double> &numbers)
  {
    for (const Type &t : kTypes) {
      if (t.name != type && t.sized_name != type) continue;
      for (const double x : numbers) {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%.17g ", x);
        bytes_ += text_ ? digits : t.bytes(x, big_endian_);
      }
    }
    return *this;
  }
  Ply &end_row()    // of an element
  {
    if (text_) bytes_ += '\n';
    return *this;
  }
  // A triangle of the vertices a, b, c with the list of faces().
  Ply &triangle(double a, double b, double c)
  {
    return put("uchar", {3}).put("int", {a, b, c}).end_row();
  }
  Ply &vertex(double x, double y, double z) { return put("float", {x, y, z}).end_row(); }

  const std::string &bytes() const { return bytes_; }

 private:
  bool text_, big_endian_;
  std::string bytes_;
};

const std::vector<Vec3> kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

// Its last vertices and face; `more` are lines of the header after the face.
Ply triangle(const std::string &format, const std::string &more = "")
{
  Ply ply(format);
  ply.vertices(3).faces(1);
  if (!more.empty()) ply.line(more);
  return ply.end_header().vertex(0, 0, 0).vertex(1, 0, 0).vertex(0, 1, 0).triangle(0, 1, 2);
}

const std::string kText = triangle("ascii").bytes();

// A text file, all but whose data are given.
std::string text(const std::string &header, const std::string &data)
{
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + data;
}

const std::string kVertices = "element vertex 3\nproperty float x\nproperty float y\n"
                              "property float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n";

std::string face(const std::string &row)
{
  return text(kVertices + kFaces, kPoints + row + "\n");
}

TEST(read_ply, every_type_of_number_is_read_under_both_names_in_all_formats)
{
  for (const char *format : kFormats)
    for (const Type &t : kTypes)
      for (const char *name : {t.name, t.sized_name}) {
        Ply ply(format);
        ply.vertices(3, name).faces(1).end_header();
        for (const auto &x : {Vec3{t.low, t.high, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}})
          ply.put(name, {x.x, x.y, x.z}).end_row();
        const ReadMesh read_back = read(ply.triangle(0, 1, 2).bytes());
        EXPECT_EQ(read_back.soup.corners[0], (Vec3{t.low, t.high, 0})) << format << ' ' << name;
      }
}

TEST(read_ply, lists_may_have_any_type_of_count_and_of_index)
{
  for (const char *format : kFormats)
    for (const Type &count : kTypes)
      for (const Type &index : kTypes) {
        Ply ply(format);
        ply.vertices(3).faces(1, std::string(count.name) + ' ' + index.name + " vertex_index");
        ply.end_header().vertex(0, 0, 0).vertex(1, 0, 0).vertex(0, 1, 0);
        ply.put(count.name, {3}).put(index.name, {0, 1, 2}).end_row();
        EXPECT_EQ(read(ply.bytes()).soup.corners, kTriangle) << format << count.name << index.name;
      }
}

TEST(read_ply, properties_come_in_any_order_with_others_and_lists_between)
{
  for (const char *format : kFormats) {
    Ply ply(format);
    ply.line("element vertex 3").line("property uchar red").line("property float z");
    ply.line("property list ushort short neighbours").line("property double x");
    ply.line("property float y").line("property int flags");
    ply.line("element face 1").line("property list uchar float texcoord");
    ply.line("property list uchar int vertex_indices").line("property uchar flags").end_header();
    for (int v = 0; v < 3; ++v) {
      ply.put("uchar", {10}).put("float", {0}).put("ushort", {double(v)});
      ply.put("short", std::vector<double>(v, 7)).put("double", {kTriangle[v].x});
      ply.put("float", {kTriangle[v].y}).put("int", {9}).end_row();
    }
    ply.put("uchar", {2}).put("float", {0.5, 0.25}).put("uchar", {3}).put("int", {0, 1, 2});
    EXPECT_EQ(read(ply.put("uchar", {1}).end_row().bytes()).soup.corners, kTriangle) << format;
  }
}

TEST(read_ply, unknown_elements_before_between_and_after_are_passed_over)
{
  for (const char *format : kFormats) {
    Ply ply(format);
    ply.line("element camera 2").line("property double focus").line("property list int short grid");
    ply.vertices(3).line("element material 1").line("property uchar red").faces(1);
    ply.line("element empty 1000000000000000000");    // without properties it takes no room
    ply.line("element range_grid 2").line("property list uchar int vertex_indices").end_header();
    ply.put("double", {1}).put("int", {3}).put("short", {1, 2, 3}).end_row();
    ply.put("double", {2}).put("int", {0}).end_row();
    ply.vertex(0, 0, 0).vertex(1, 0, 0).vertex(0, 1, 0).put("uchar", {200}).end_row();
    ply.triangle(0, 1, 2).put("uchar", {0}).end_row().put("uchar", {1}).put("int", {2}).end_row();
    const ReadMesh mesh = read(ply.bytes());
    EXPECT_EQ(mesh.soup.corners, kTriangle) << format;
    EXPECT_EQ(mesh.left_out, 0u);
  }
}

TEST(read_ply, faces_may_come_before_the_vertices)
{
  for (const char *format : kFormats) {
    Ply ply(format);
    ply.faces(1).vertices(3).end_header().triangle(0, 1, 2);
    EXPECT_EQ(read(ply.vertex(0, 0, 0).vertex(1, 0, 0).vertex(0, 1, 0).bytes()).soup.corners,
              kTriangle);
  }
}

TEST(read_ply, edges_and_faces_of_one_or_two_corners_are_counted_as_left_out)
{
  for (const char *format : kFormats) {
    Ply ply(format);
    ply.vertices(3).faces(3).line("element edge 2").line("property int vertex1");
    ply.line("property int vertex2").end_header();
    ply.vertex(0, 0, 0).vertex(1, 0, 0).vertex(0, 1, 0).put("uchar", {1}).put("int", {0}).end_row();
    ply.triangle(0, 1, 2).put("uchar", {2}).put("int", {0, 1}).end_row();
    const ReadMesh mesh =
        read(ply.put("int", {0, 1}).end_row().put("int", {1, 2}).end_row().bytes());
    EXPECT_EQ(mesh.soup.corners, kTriangle) << format;
    EXPECT_EQ(mesh.left_out, 4u);
  }
}

// A grid of two columns, numbered row by row: every triangle of its strip has its normal along z.
Ply strip(const std::string &format, int columns, const std::vector<double> &indices)
{
  Ply ply(format);
  ply.vertices(2 * columns).line("element tristrips 1");
  ply.line("property list int int vertex_indices").end_header();
  for (int i = 0; i < columns; ++i) ply.vertex(i, 0, 0).vertex(i, -1, 0);
  return ply.put("int", {double(indices.size())}).put("int", indices).end_row();
}

Vec3 normal(const TriangleSoup &soup, std::size_t t)
{
  const auto *x = &soup.corners[3 * t];
  return cross(x[1] - x[0], x[2] - x[0]);
}

// -1 begins a strip with a winding of its own: of three corners, then four. Corners that are given twice lead from the first
// square to the one after the next, and make no facets.
TEST(read_ply, triangle_strips_are_their_triangles_all_wound_alike)
{
  const std::pair<std::vector<double>, std::size_t> rows[] = {{{1, 0, 3, 2, 5, 4, 7, 6}, 6},
                                                              {{1, 0, 3, -1, 3, 2, 5, 4, -1}, 3},
                                                              {{1, 0, 3, 2, 2, 5, 5, 4, 7, 6}, 4}};
  for (const char *format : kFormats)
    for (const auto &[corners, n] : rows) {
      const TriangleSoup soup = read(strip(format, 4, corners).bytes()).soup;
      ASSERT_EQ(soup.n_triangles(), n) << format;
      for (std::size_t t = 0; t < n; ++t) EXPECT_EQ(normal(soup, t), normal(soup, 0)) << t;
    }
}

TEST(read_ply, strips_of_one_or_two_corners_are_counted_as_left_out)
{
  const ReadMesh mesh = read(strip("ascii", 4, {1, 0, 3, -1, 1, 0, -1, 5}).bytes());
  EXPECT_EQ(mesh.soup.n_triangles(), 1u);
  EXPECT_EQ(mesh.left_out, 2u);
}

TEST(read_ply, text_keeps_all_digits_even_of_float_properties)
{
  const std::string bytes = text(kVertices + kFaces, "0.1 5421987.123456789 1e-300\n1 0 0\n0 1 0\n"
                                                     "3 0 1 2\n");
  EXPECT_EQ(read(bytes).soup.corners[0], (Vec3{0.1, 5421987.123456789, 1e-300}));
}

TEST(read_ply, comments_and_obj_info_stand_anywhere_in_the_header)
{
  const std::string lines = "comment element face 9\nobj_info property list a b c d\ncomment\n";
  std::string bytes = kText;
  for (const char *before : {"format", "element vertex", "property float y", "end_header"})
    bytes.insert(bytes.rfind(before), lines);
  EXPECT_EQ(read(bytes).soup.corners, kTriangle);
}

TEST(read_ply, lines_of_a_header_may_be_of_any_length)
{
  for (const char *format : kFormats) {
    const std::string bytes = triangle(format, "comment " + std::string(3000000, 'x')).bytes();
    EXPECT_EQ(read(bytes).soup.corners, kTriangle);
  }
}

// The first vertex is such that the data begin with any byte at all, 0A and 20 among them.
TEST(read_ply, binary_data_may_begin_with_any_byte_after_any_line_end)
{
  for (const char *end : {"\n", "\r\n", "\r"})
    for (int first = 0; first < 256; ++first) {
      Ply ply("binary_little_endian");
      ply.vertices(3, "uchar").faces(1).end_header();
      const std::string header = with_line_ends(ply.bytes(), end);
      ply.put("uchar", {double(first), 10, 13}).put("uchar", {1, 0, 0, 0, 1, 0}).triangle(0, 1, 2);
      const std::string data = ply.bytes().substr(ply.bytes().find("end_header") + 11);
      EXPECT_EQ(read(header + data).soup.corners[0], (Vec3{double(first), 10, 13})) << first;
    }
}

TEST(read_ply, text_with_line_ends_of_windows_and_old_macintosh_is_read)
{
  for (const char *end : {"\r\n", "\r", "\n\n", " \t\n"})
    EXPECT_EQ(read(with_line_ends(kText, end)).soup.corners, kTriangle);
}

TEST(read_ply, a_byte_order_mark_and_a_missing_last_line_end_do_no_harm)
{
  EXPECT_EQ(read("\xEF\xBB\xBF" + kText).soup.corners, kTriangle);
  EXPECT_EQ(read(kText.substr(0, kText.size() - 2)).soup.corners, kTriangle);
}

TEST(read_ply, every_cut_header_is_an_error)
{
  for (const char *format : kFormats) {
    const std::string bytes = triangle(format).bytes();
    for (std::size_t size = 1; size < bytes.find("end_header") + 11; ++size)
      EXPECT_NE(error_of(bytes.substr(0, size)), "") << size;
  }
}

// But inside the last number, and the line's end behind it: such a file cannot be told from a whole one.
TEST(read_ply, every_cut_of_the_data_is_an_error)
{
  for (const char *format : kFormats) {
    const std::string bytes = triangle(format).bytes();
    const std::size_t whole = format == kFormats[0] ? bytes.size() - 2 : bytes.size();
    for (std::size_t size = bytes.find("end_header") + 11; size < whole; ++size)
      EXPECT_TRUE(has(error_of(bytes.substr(0, size)), "truncated")) << size;
  }
}

// To reserve room for as many would throw something else.
// A text of too few vertices has a line of a face for the next one.
TEST(read_ply, a_huge_promise_allocates_nothing)
{
  for (const char *format : kFormats)
    for (const std::string element : {"vertex 3", "face 1"}) {
      std::string bytes = triangle(format).bytes();
      bytes.insert(bytes.find(element) + element.size(), "000000000000000000");
      if (bytes.back() == '\n') bytes.erase(bytes.find("3 0 1 2"));
      EXPECT_TRUE(has(error_of(bytes), "truncated"));
    }
  std::string bytes = Ply("binary_little_endian")
                          .vertices(0)
                          .faces(1, "uint int vertex_indices")
                          .end_header()
                          .put("uint", {4e9})
                          .put("int", {1, 2, 3})
                          .bytes();
  EXPECT_TRUE(has(error_of(bytes), "byte "));
}

TEST(read_ply, a_count_that_no_number_can_be_is_an_error)
{
  for (const char *count : {"-3", "3.0", "99999999999999999999", "x", "3 3", ""}) {
    std::string bytes = kText;
    bytes.replace(bytes.find("vertex 3") + 7, 1, count);
    EXPECT_TRUE(has(error_of(bytes), "line 3: 'element vertex"));
  }
}

TEST(read_ply, an_index_without_a_vertex_names_the_face)
{
  for (const char *index : {"3", "-1", "4294967295", "1.5", "1e+300"}) {
    const auto error = error_of(face("3 0 1 " + std::string(index)));
    EXPECT_TRUE(has(error, "line 13 (face 1): a corner is vertex " + std::string(index) +
                               ", but the file has 3, counted from 0"));
  }
}

TEST(read_ply, a_wrong_row_is_named_by_its_line_and_element)
{
  const std::string list = "line 13 (face 1): the list 'vertex_indices' begins with ";
  const std::pair<std::string, std::string> rows[] = {
      {face("0"), "line 13 (face 1): the face has no corners"},
      {face("-1 0 1 2"), list + "-1"},
      {face("2.5 0 1 2"), list + "2.5"},
      {face("1e+30 0 1 2"), list + "1e+30"},
      {face("3 0 1 2 2"), "line 13 (face 1): '2' follows all values"},
      {text(kVertices + kFaces, "0 0 0\n1 0\n0 0 1 0\n3 0 1 2\n"),
       "line 11 (vertex 2): the line ends before"},
      {kText + "\n3 0 1 2\n", "line 15: '3' follows the last element"},
      {triangle("binary_little_endian").bytes() + "\n", "1 byte follows the last element"},
      {Ply("binary_big_endian").vertices(1).faces(1).end_header().vertex(0, 0, NAN).bytes(),
       "(vertex 1): the value of 'z' is nan, not a finite number"},
      // Control characters do not reach a message.
      {face("3 0 1 \x1b[31m"), "'?[31m'"},
  };
  for (const auto &[bytes, words] : rows) EXPECT_TRUE(has(error_of(bytes), words));
}

TEST(read_ply, coordinates_that_are_no_finite_numbers_name_the_vertex)
{
  const std::pair<const char *, std::vector<std::string>> cases[] = {
      {"not a number", {"0.2D+01", "1,5", "x", "+-1", "0x10", "1.#IND"}},
      {"not a finite number", {"nan", "-inf", "1e400"}}};
  for (const auto &[what, words] : cases)
    for (const std::string &word : words)
      EXPECT_TRUE(has(error_of(text(kVertices + kFaces, "0 0 0\n1 " + word + " 0\n")),
                      "line 11 (vertex 2): the value of 'y' is '" + word + "', " + what));
}

TEST(read_ply, a_header_that_gives_no_mesh_says_what_is_missing)
{
  const std::pair<std::string, const char *> cases[] = {
      {text("element vertex 1\nproperty float x\nproperty float y\n" + kFaces, "0 0\n"),
       "line 3: element 'vertex' has no property 'z' that is one number"},
      {text("element vertex 1\nproperty list int float x\n" + kFaces, "0\n"),
       "line 3: element 'vertex' has no property 'x'"},
      {text(kVertices + "element face 1\nproperty list uchar int corners\n", kPoints + "3 0 1 2\n"),
       "line 7: element 'face' has no list 'vertex_indices'"},
      {text(kVertices + "element face 1\nproperty int vertex_indices\n", kPoints + "3\n"),
       "line 7: element 'face' has no list 'vertex_indices'"},
      {text(kVertices, kPoints), "no facets; its header promises 'element vertex 3'"},
      {text(kFaces, "3 0 1 2\n"), "the file has 0, counted from 0"},
      {"ply\n" + kVertices + kFaces + "end_header\n" + kPoints + "3 0 1 2\n", "no line 'format'"},
      {text(kVertices + kFaces + kFaces, ""), "line 9: the header has element 'face' twice"},
      {text(kVertices + "property double x\n" + kFaces, ""), "properties 'x' and 'x'"},
      {text(kVertices + kFaces + "property list int int vertex_index\n", kPoints),
       "properties 'vertex_indices' and 'vertex_index'"},
      {text("property float x\n", ""), "line 3: 'property' found"},
      {text("element vertex 1\nproperty real x\n", ""), "'real', not one of char, int8,"},
      {"ply\nformat ascii 2.0\n", "line 2: 'format ascii 2.0' is not 'format ascii 1.0'"},
      {"solid a\n", "line 1: 'solid' found where 'ply' is expected; this is not a PLY file"},
      {"ply\nformat ascii 1.0\nmade by hand\n", "line 3: 'made' found"},
      {"ply\n\x1b[31m\n", "'?[31m'"},
      {"ply\nformat ascii 1.0\n" + kVertices + kFaces + kPoints + "3 0 1 2\n",
       "line 9: '0' found where"},
      {"ply\nformat ascii 1.0\n" + kVertices + kFaces, "without 'end_header'"},
      {"\xFF\xFEp", "line 1: the text is in UTF-16"},
      {"", "line 1: the file is empty"}};
  for (const auto &[bytes, words] : cases) EXPECT_TRUE(has(error_of(bytes), words));
}

// Far larger than memory, though it takes no room on the disk.
TEST(read_ply, a_file_of_another_kind_is_refused_by_its_beginning)
{
  const TempDir dir;
  const std::string path = dir.write("other.ply", "solid a\n");
  std::filesystem::resize_file(path, std::uintmax_t(1) << 42);
  EXPECT_TRUE(fails_with("other.ply, line 1: 'solid' found where 'ply' is expected",
                         [&] { read_mesh(path); }));
}

TEST(read_ply, what_we_write_is_read_back_to_the_bit)
{
  const TempDir dir;
  Random random(50);
  for (const bool floats : {true, false}) {
    TriangleSoup soup;
    for (int i = 0; i < 3000; ++i) {
      Vec3 x = uniform(random, {-1, -1, -1}, {1, 1, 1});
      if (floats) x = {float(x.x), float(x.y), float(x.z)};
      soup.corners.push_back(x);
    }
    write_mesh_file(dir.path("a.ply"), soup);
    EXPECT_EQ(read_mesh(dir.path("a.ply")).soup.corners, soup.corners);
  }
}

}    // namespace
}    // namespace lsdcd::test_read_ply
