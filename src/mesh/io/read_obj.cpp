// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Wavefront OBJ: the vertices and polygons of its text. A face may name vertices that come after it, and
// negative numbers count back from where it stands. So vertices are read first, then faces.
#include "base/input_error.h"
#include "base/number_words.h"
#include "mesh/io/cut_polygon.h"
#include "mesh/io/read_mesh.h"
#include "mesh/io/text_words.h"
#include "mesh/io/whole_file.h"

#include <algorithm>
#include <iterator>

namespace lsdcd {

namespace {

const char *const kElements[] = {"v", "f", "fo", "l", "p", "curv", "cdc"};
const char *const kPatches[] = {"surf", "bzp", "bsp", "cdp"};    // surfaces that are no polygons
// Words that a wall does not need: normals, textures, looks, and what belongs to curves and patches.
const char *const kNumbers[] = {"vn",    "vt",       "vp",       "s",     "mg",     "lod",
                                "bevel", "deg",      "step",     "bmat",  "parm",   "trim",
                                "hole",  "scrv",     "sp",       "curv2", "cstype", "ctech",
                                "stech", "c_interp", "d_interp", "con",   "end",    "res"};
const char *const kNames[] = {"g",      "o",      "usemtl",     "mtllib",
                              "usemap", "maplib", "shadow_obj", "trace_obj"};

constexpr TextStyle kObjStyle = {'#', true};

template <std::size_t kSize>
bool is_one_of(std::string_view word, const char *const (&words)[kSize])
{
  return std::any_of(std::begin(words), std::end(words),
                     [&](const char *w) { return same_word(word, w); });
}

bool is_known(std::string_view word)
{
  return is_one_of(word, kElements) || is_one_of(word, kNumbers) || is_one_of(word, kNames) ||
         is_one_of(word, kPatches);
}

class ObjReader {
 public:
  ObjReader(const char *bytes, std::size_t size, const std::string &source) :
      words_(bytes, size, source, kObjStyle)
  {
    read_.soup.source = source;
    words_.refuse_utf16();
  }

  ReadMesh read()
  {
    const TextWords beginning = words_;
    for_each_line([&](std::string_view keyword) {
      if (same_word(keyword, "v"))
        read_vertex(keyword);
      else if (!is_known(keyword))
        refuse(keyword);
    });
    words_ = beginning;
    for_each_line([&](std::string_view keyword) { read_element(keyword); });
    if (read_.soup.corners.empty())
      throw InputError(read_.soup.source +
                       ": the mesh has no facets; give a mesh with triangles or polygons");
    read_.vertices = std::move(vertices_);
    return std::move(read_);
  }

 private:
  template <class Line>
  void for_each_line(const Line &line)
  {
    do {
      const auto keyword = words_.word_in_line();
      if (keyword.empty()) continue;
      line(keyword);
      if (is_one_of(keyword, kNames)) skip_names();
    } while (words_.next_line());
  }

  // A backslash at the end may belong to the name of a folder. The line behind it is one of names only if
  // it begins as no other does.
  void skip_names()
  {
    while (words_.skip_line_alone()) {
      TextWords behind = words_;
      behind.next_line();
      const auto word = TextWords(behind).word_in_line();
      if (word.empty() || is_known(word)) return;
      words_ = behind;
    }
  }

  void refuse(std::string_view keyword) const
  {
    if (same_word(keyword, "call") || same_word(keyword, "csh"))
      words_.fail(keyword, quoted(keyword) + " asks for another file or program",
                  "export the mesh into one file");
    words_.fail(keyword, "the line begins with " + quoted(keyword) + ", which OBJ does not know",
                vertices_.empty() ? "this is not an OBJ file: export the mesh as OBJ"
                                  : "correct it, or write # before it if it is a comment");
  }

  // Throws that `what` is wrong in a line, unless the file is cut off there.
  [[noreturn]] void fail_line(std::string_view last, const std::string &what, const char *remedy,
                              const std::string &place) const
  {
    if (words_.file_ends_with(last)) remedy = "the file is truncated: copy or export it again";
    words_.fail(last, what, remedy, place);
  }

  // x y z, then nothing, a weight, or a colour of 3 or 4 numbers.
  void read_vertex(std::string_view last)
  {
    constexpr std::size_t kMost = 7;
    Real number[kMost];
    std::size_t n = 0;
    const auto vertex = [&] { return "vertex " + std::to_string(vertices_.size() + 1); };
    for (auto word = words_.word_in_line(); !word.empty(); word = words_.word_in_line(), n++) {
      last = word;
      if (n >= kMost) continue;
      number[n] = words_.number(word, [&] {
        return n < 3 ? std::string("coordinate ") + "xyz"[n] + " of " + vertex()
                     : "number " + std::to_string(n + 1) + " of " + vertex();
      });
    }
    if (n < 3 || n == 5 || n > kMost)
      fail_line(last, "it has " + counted(n, "number") + ", not 3, 4, 6 or 7",
                "correct the line or export the mesh again", vertex());
    // Programs differ in what a weight means for polygons: nothing, or a divisor.
    if (n == 4 && number[3] != 1)
      words_.fail(last, "its weight is " + quoted(last) + ", not 1",
                  "give x, y and z without a weight", vertex());
    vertices_.push_back({number[0], number[1], number[2]});
  }

  void read_element(std::string_view keyword)
  {
    if (same_word(keyword, "v")) {
      vertices_before_++;
    } else if (same_word(keyword, "f") || same_word(keyword, "fo")) {
      read_face(keyword);
    } else if (same_word(keyword, "p")) {
      read_.left_out += count_words();
    } else if (same_word(keyword, "l")) {
      read_.left_out += std::max<std::size_t>(count_words(), 1) - 1;
    } else if (same_word(keyword, "curv") || same_word(keyword, "cdc")) {
      read_.left_out++;
    } else if (is_one_of(keyword, kPatches)) {
      words_.fail(keyword, quoted(keyword) + " is a free-form surface, not a polygon",
                  "export the mesh as triangles or polygons");
    }
  }

  std::size_t count_words()
  {
    std::size_t n = 0;
    while (!words_.word_in_line().empty()) n++;
    return n;
  }

  std::string face() const { return "face " + std::to_string(faces_); }

  void read_face(std::string_view keyword)
  {
    faces_++;
    polygon_.clear();
    auto last = keyword;
    for (auto word = words_.word_in_line(); !word.empty(); word = words_.word_in_line()) {
      last = word;
      polygon_.push_back(vertices_[read_corner(word)]);
    }
    const std::string corners = counted(polygon_.size(), "corner");
    if (polygon_.empty() || (polygon_.size() < 3 && words_.file_ends_with(last)))
      fail_line(last, "it has " + corners + ", not 3 or more", "complete or remove it", face());
    if (polygon_.size() < 3) {    // a point or a line
      read_.left_out++;
      return;
    }
    const std::string problem = cutter_.cut(polygon_, read_.soup.corners);
    if (!problem.empty())
      words_.fail(keyword, "its " + corners + " cannot be cut into triangles: " + problem,
                  kTriangulate, face());
  }

  // The vertex of "7", "7/1", "7//2" or "7/1/2".
  std::size_t read_corner(std::string_view word) const
  {
    std::int64_t index = 0, ignored = 0;
    auto part = word.substr(0, word.find('/')), rest = word.substr(part.size());
    bool is_right = read_integer(part, index);
    for (int more = 0; is_right && !rest.empty(); more++) {
      rest.remove_prefix(1);
      part = rest.substr(0, rest.find('/'));
      rest.remove_prefix(part.size());
      is_right = more < 2 && (part.empty() || read_integer(part, ignored));
    }
    if (!is_right)
      words_.fail(word,
                  "corner " + std::to_string(polygon_.size() + 1) + " is " + quoted(word) +
                      ", not a whole number or whole numbers with / between them",
                  "correct the line or export the mesh again", face());
    const auto n = static_cast<std::int64_t>(vertices_.size());
    const auto before = static_cast<std::int64_t>(vertices_before_);
    if (index == 0)
      words_.fail(word, "it names vertex 0", "OBJ counts vertices from 1: add 1 to all", face());
    if (index > n)
      words_.fail(word, "it names vertex " + std::to_string(index) + " of " + std::to_string(n),
                  "the file lacks vertices: correct the line or export the mesh again", face());
    if (index < -before)
      words_.fail(word,
                  "it names vertex " + std::to_string(index) + ", counted back from " +
                      std::to_string(before) + " above it",
                  "correct the line or export the mesh again", face());
    return static_cast<std::size_t>(index > 0 ? index - 1 : before + index);
  }

  TextWords words_;
  ReadMesh read_;
  std::vector<Vec3> vertices_, polygon_;
  PolygonCutter cutter_;
  std::size_t vertices_before_ = 0;    // the line that is read
  std::size_t faces_ = 0;
};

}    // namespace

ReadMesh read_obj_bytes(const char *bytes, std::size_t size, const std::string &source)
{
  return ObjReader(bytes, size, source).read();
}

ReadMesh read_obj(const std::string &path)
{
  const auto check = [&](const char *beginning, std::size_t n, std::size_t) {
    const auto word = TextWords(beginning, n, path, kObjStyle).next_word();
    if (!word.empty() && !is_known(word)) read_obj_bytes(beginning, n, path);
    return kAllBytes;
  };
  const FileBytes bytes = read_whole_file(path, check);
  return read_obj_bytes(bytes.data.get(), bytes.size, path);
}

}    // namespace lsdcd
