// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// OFF, Geomview's Object File Format, as text: a header with counts, then vertices and faces. What follows the numbers of
// one in its line is its colour.
#include "base/input_error.h"
#include "base/number_words.h"
#include "mesh/io/cut_polygon.h"
#include "mesh/io/read_mesh.h"
#include "mesh/io/text_words.h"
#include "mesh/io/whole_file.h"

#include <algorithm>

namespace lsdcd {

namespace {

constexpr TextStyle kOffStyle = {'#', false};

// "[ST][C][N][4][n]OFF": what a vertex has beside x, y and z.
struct OffHeader {
  bool texture = false, colour = false, normal = false, weight = false, dimension = false;
  std::string_view behind;    // digits without a space behind the word, as in "OFF8 6 12"

  // False: the word is no header, and the members mean nothing.
  bool read(std::string_view word)
  {
    const auto starts_with = [&](std::string_view letters) {
      return same_word(word.substr(0, letters.size()), letters);
    };
    while (!starts_with("off")) {
      std::size_t used = 1;
      if (starts_with("st"))
        texture = true, used = 2;
      else if (starts_with("c"))
        colour = true;
      else if (word.substr(0, 1) == "n")
        dimension = true;
      else if (starts_with("n"))
        normal = true;
      else if (starts_with("4"))
        weight = true;
      else
        return false;
      word.remove_prefix(used);
    }
    behind = word.substr(3);
    return true;
  }
};

class OffReader {
 public:
  OffReader(const char *bytes, std::size_t size, const std::string &source) :
      words_(bytes, size, source, kOffStyle), size_(size)
  {
    read_.soup.source = source;
    words_.refuse_utf16();
  }

  ReadMesh read()
  {
    read_header();
    // A line of a vertex has six bytes or more.
    vertices_.reserve(std::min(n_vertices_, size_ / 6));
    for (std::size_t v = 0; v < n_vertices_; v++) read_vertex();
    for (std::size_t f = 0; f < n_faces_; f++) read_face();
    const auto word = words_.next_word();
    if (!word.empty())
      words_.fail(word, quoted(word) + " found after the " + promised(),
                  "correct the counts or export the mesh again");
    if (read_.soup.corners.empty())
      throw InputError(read_.soup.source +
                       ": the mesh has no facets; give a mesh with triangles or polygons");
    read_.vertices = std::move(vertices_);
    return std::move(read_);
  }

 private:
  std::string promised() const
  {
    return counted(n_vertices_, "vertex", "vertices") + " and " + counted(n_faces_, "face") +
           " that the header promises";
  }

  [[noreturn]] void fail_ended(std::string_view word, const std::string &where,
                               const std::string &what) const
  {
    words_.fail(word, what + ", with the " + promised(),
                "the file is truncated or its counts are wrong: copy or export it again", where);
  }

  void read_header()
  {
    auto word = words_.next_word();
    const auto header_word = word;
    std::int64_t number = 0;
    if (OffHeader header; header.read(word)) {
      header_ = header;
      word = header_.behind.empty() ? words_.next_word() : header_.behind;
    } else if (!read_integer(word, number)) {    // the word may be missing
      words_.fail(word,
                  word.empty() ? "the file is empty"
                               : quoted(word) + " found where 'OFF' is expected",
                  "this is not an OFF file: export the mesh as OFF");
    }
    if (same_word(word, "binary"))
      words_.fail(word, "the file is a binary OFF",
                  "export the mesh as OFF text, or as STL or PLY");
    if (header_.dimension) {
      if (!read_integer(word, number) || number != 3)
        words_.fail(word, quoted(header_word) + " has the dimension " + quoted(word) + ", not 3",
                    "give a mesh in three dimensions");
      word = words_.next_word();
    }
    n_vertices_ = read_count(word, "the number of vertices");
    n_faces_ = read_count(words_.next_word(), "the number of faces");
    // The number of edges is not used. It may be missing, or be in a line of its own.
    word = words_.word_in_line();
    if (word.empty()) {
      TextWords behind = words_;
      const auto alone = behind.next_word();
      if (alone.empty() || !behind.word_in_line().empty()) return;
      word = alone;
      words_ = behind;
    }
    read_count(word, "the number of edges");
    const auto more = words_.word_in_line();
    if (!more.empty())
      words_.fail(more, quoted(more) + " found after the counts of vertices, faces and edges",
                  "write each vertex in a line of its own");
  }

  std::size_t read_count(std::string_view word, const char *name) const
  {
    std::int64_t count = 0;
    if (!read_integer(word, count) || count < 0)
      words_.fail(word,
                  std::string(name) + (word.empty()
                                           ? " is missing"
                                           : " is " + quoted(word) + ", not a whole number"),
                  "correct the header or export the mesh again");
    return static_cast<std::size_t>(count);
  }

  // Where a vertex or a face goes on in another line: the last word of its first line, and how many it had there.
  struct LineEnd {
    std::string_view word;
    std::size_t n = 0;
    bool passed() const { return !word.empty(); }
  };

  // Returns the next word of a vertex or a face, in this line or after it, behind `last`, which is the n-th; empty: the file
  // ends. Nothing may follow in the line where one ends that goes over several, so that a line that lacks a number is told
  // from these.
  std::string_view next_of_record(std::string_view last, std::size_t n, LineEnd &line)
  {
    auto word = words_.word_in_line();
    if (!word.empty()) return word;
    if (!line.passed()) line = {last, n};
    return words_.next_word();
  }

  // x y z, what the header's word says, and perhaps a colour of 3 or 4 numbers, or its number in a list.
  void read_vertex()
  {
    constexpr std::size_t kMost = 3 + 1 + 3 + 4 + 2;
    Real number[kMost];
    std::size_t n = 0;
    const auto place = [&] { return "vertex " + std::to_string(vertices_.size() + 1); };
    const std::size_t least =
        3 + (header_.weight ? 1 : 0) + (header_.normal ? 3 : 0) + (header_.texture ? 2 : 0);
    auto last = words_.next_word();
    if (last.empty()) fail_ended(last, place(), "the file ends");
    LineEnd line;
    for (auto word = last; !word.empty(); n++) {
      last = word;
      if (n < kMost)
        number[n] = words_.number(word, [&] {
          return (n < 3 ? std::string("coordinate ") + "xyz"[n]
                        : "number " + std::to_string(n + 1)) +
                 " of " + place();
        });
      word = n + 1 < least ? next_of_record(last, n + 1, line) : words_.word_in_line();
    }
    const std::size_t more = n - least;
    if (n < least || (line.passed() && more > 0) ||
        !(more == 0 || more == 3 || more == 4 || (more == 1 && header_.colour))) {
      const std::string what = "it has " + counted(line.passed() ? line.n : n, "number") +
                               " in its line, not " + std::to_string(least) +
                               " and perhaps a colour";
      if (n < least) fail_ended(last, place(), what);
      words_.fail(line.passed() ? line.word : last, what,
                  "correct the line, or the counts in the header", place());
    }
    const Real weight = header_.weight ? number[3] : 1;
    const Vec3 x = {number[0] / weight, number[1] / weight, number[2] / weight};
    if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
      words_.fail(last, "divided by its fourth number it is not finite", "correct the line",
                  place());
    vertices_.push_back(x);
  }

  std::string face() const { return "face " + std::to_string(faces_); }

  // The number of corners, these, and perhaps a colour: 1, 3 or 4 numbers.
  void read_face()
  {
    faces_++;
    const auto first = words_.next_word();
    if (first.empty()) fail_ended(first, face(), "the file ends");
    std::int64_t n = 0;
    if (!read_integer(first, n) || n < 1)
      words_.fail(first,
                  "its number of corners is " + quoted(first) + ", not a whole number above 0",
                  "correct the line or export the mesh again", face());
    polygon_.clear();
    auto last = first;
    LineEnd line;
    const auto too_few = [&](std::size_t corners) {
      return "it has " + counted(static_cast<std::int64_t>(corners), "corner") + ", not " +
             quoted(first);
    };
    // Corners in other lines wait until nothing follows them there.
    waiting_.clear();
    for (std::int64_t corner = 1; corner <= n; corner++) {
      const auto word = next_of_record(last, polygon_.size() + waiting_.size(), line);
      if (word.empty()) fail_ended(last, face(), too_few(polygon_.size() + waiting_.size()));
      last = word;
      if (line.passed())
        waiting_.push_back(word);
      else
        polygon_.push_back(vertices_[read_corner(word)]);
    }
    std::size_t more = 0;
    for (auto word = words_.word_in_line(); !word.empty(); word = words_.word_in_line(), more++) {
      if (line.passed())
        words_.fail(line.word, too_few(line.n), "correct the line or export the mesh again",
                    face());
      last = word;
      words_.number(word, [&] { return "the colour of " + face(); });
    }
    for (const auto word : waiting_) polygon_.push_back(vertices_[read_corner(word)]);
    if (more == 2 || more > 4)
      words_.fail(last,
                  std::to_string(more) + " numbers follow its " + counted(n, "corner") +
                      ", where a colour has 1, 3 or 4",
                  "correct the line or export the mesh again", face());
    if (n < 3) {    // a point or a line
      read_.left_out++;
      return;
    }
    const std::string problem = cutter_.cut(polygon_, read_.soup.corners);
    if (!problem.empty())
      words_.fail(first,
                  "its " + std::to_string(n) + " corners cannot be cut into triangles: " + problem,
                  kTriangulate, face());
  }

  std::size_t read_corner(std::string_view word) const
  {
    std::int64_t index = 0;
    if (!read_integer(word, index) || index < 0)
      words_.fail(word,
                  "corner " + std::to_string(polygon_.size() + 1) + " is " + quoted(word) +
                      ", not a whole number from 0 on",
                  "correct the line or export the mesh again", face());
    if (static_cast<std::size_t>(index) >= n_vertices_)
      words_.fail(word,
                  "it names vertex " + std::to_string(index) + ", but there are " +
                      std::to_string(n_vertices_) + ", from 0 to " +
                      std::to_string(static_cast<std::int64_t>(n_vertices_) - 1),
                  "correct the line; OFF counts vertices from 0", face());
    return static_cast<std::size_t>(index);
  }

  TextWords words_;
  std::size_t size_;
  ReadMesh read_;
  OffHeader header_;
  std::size_t n_vertices_ = 0, n_faces_ = 0;
  std::vector<Vec3> vertices_, polygon_;
  std::vector<std::string_view> waiting_;
  PolygonCutter cutter_;
  std::size_t faces_ = 0;
};

}    // namespace

ReadMesh read_off_bytes(const char *bytes, std::size_t size, const std::string &source)
{
  return OffReader(bytes, size, source).read();
}

ReadMesh read_off(const std::string &path)
{
  const auto check = [&](const char *beginning, std::size_t n, std::size_t) {
    const auto word = TextWords(beginning, n, path, kOffStyle).next_word();
    std::int64_t number = 0;
    // Else a comment before it is that long.
    const bool is_whole = word.data() + word.size() < beginning + n;
    if (is_whole && !OffHeader().read(word) && !read_integer(word, number))
      read_off_bytes(beginning, n, path);
    return kAllBytes;
  };
  const FileBytes bytes = read_whole_file(path, check);
  return read_off_bytes(bytes.data.get(), bytes.size, path);
}

}    // namespace lsdcd
