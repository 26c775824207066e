// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/io/read_stl_text.h"

#include "base/number_words.h"
#include "mesh/io/text_words.h"

#include <string>
#include <string_view>

namespace lsdcd {
namespace {

bool is_stl_word(std::string_view word)
{
  for (const char *keyword :
       {"solid", "facet", "outer", "loop", "vertex", "endloop", "endfacet", "endsolid"})
    if (same_word(word, keyword)) return true;
  return false;
}

// Returns the first "solid" that begins a line, in front of which no line begins with another word of STL;
// empty: there is none.
std::string_view first_solid(const char *bytes, std::size_t size)
{
  TextWords words(bytes, size, "");
  auto word = words.next_word();
  for (; !word.empty() && !same_word(word, "solid"); word = words.next_word()) {
    if (is_stl_word(word)) return {};
    words.skip_line();
  }
  return word;
}

class Reader {
 public:
  Reader(const char *bytes, std::size_t size, TriangleSoup &soup) :
      words_(bytes, size, soup.source), soup_(soup), is_stl_(begins_with_solid(bytes, size))
  {
  }

  void read_file()
  {
    bool in_stl = false;
    for (auto word = words_.next_word(); !word.empty(); word = words_.next_word()) {
      const bool solid = same_word(word, "solid");
      // Text before a solid and after an endsolid is ignored, but STL words there are lost facets.
      if (!solid && (in_stl ? is_stl_word(word) : !is_stl_)) fail_word(word, "'solid'");
      words_.skip_line();
      if (solid) read_solid();
      in_stl = in_stl || solid;
    }
  }

 private:
  void read_solid()
  {
    for (;;) {
      const auto word = words_.next_word();
      if (same_word(word, "facet"))
        read_facet();
      else if (same_word(word, "endsolid"))
        return words_.skip_line();
      else
        fail_word(word, "'facet' or 'endsolid'");
    }
  }

  void read_facet()
  {
    // The normal is not used: some exporters write 0 or NaN or leave it out. The corners give it.
    auto word = words_.next_word();
    for (int skipped = 0; !same_word(word, "outer"); ++skipped) {
      if (skipped == 4 || word.empty() || is_stl_word(word)) fail_word(word, "'outer loop'");
      word = words_.next_word();
    }
    expect("loop");
    for (int corner = 1; corner <= 3; ++corner) {
      word = words_.next_word();
      if (same_word(word, "endloop"))
        fail(word, "the facet has " + counted(corner - 1, "vertex", "vertices") + ", not 3",
             "remove or complete it, or export the mesh again");
      if (!same_word(word, "vertex")) fail_word(word, "'vertex'");
      Vec3 x;
      for (int axis = 0; axis < 3; ++axis) x[axis] = read_coordinate(corner, axis);
      soup_.corners.push_back(x);
    }
    word = words_.next_word();
    if (same_word(word, "vertex"))
      fail(word, "the facet has more than 3 vertices", "triangulate the mesh when exporting it");
    if (!same_word(word, "endloop")) fail_word(word, "'endloop'");
    expect("endfacet");
    ++facet_;
  }

  Real read_coordinate(int corner, int axis)
  {
    const auto here = words_.here();
    const auto word = words_.next_word();
    const auto name = [&] {
      return std::string("coordinate ") + "xyz"[axis] + " of vertex " + std::to_string(corner);
    };
    if (word.empty()) fail_word(word, name());
    if (is_stl_word(word))
      fail(here, name() + " is missing: " + quoted(word) + " found",
           "complete the line or export the mesh again");

    const ReadNumber number = read_number(word);
    if (number.problem && words_.file_ends_with(word)) fail_word(word, name());
    if (number.problem)
      fail(word, name() + " is " + quoted(word) + ", " + number.problem, number.remedy);
    return number.value;
  }

  void expect(const char *keyword)
  {
    const auto word = words_.next_word();
    if (!same_word(word, keyword)) fail_word(word, "'" + std::string(keyword) + "'");
  }

  // An unexpected word, or the end of the file where `expected` should be.
  [[noreturn]] void fail_word(std::string_view word, const std::string &expected) const
  {
    const std::string found = word.empty() ? "the file ends" : quoted(word) + " found";
    const char *remedy = "correct the line or export the mesh again";
    if (!is_stl_)
      remedy = "this is not an STL file: export the mesh as STL";
    else if (words_.file_ends_with(word))
      remedy = "the file is truncated: copy or export it again";
    fail(word, found + " where " + expected + " is expected", remedy);
  }

  [[noreturn]] void fail(std::string_view word, const std::string &what,
                         const std::string &remedy) const
  {
    words_.fail(word, what, remedy, "facet " + std::to_string(facet_));
  }

  TextWords words_;
  TriangleSoup &soup_;
  bool is_stl_;              // it has a solid
  std::size_t facet_ = 1;    // the one being read, for messages
};

}    // namespace

bool begins_with_solid(const char *bytes, std::size_t size)
{
  return !first_solid(bytes, size).empty();
}

bool begins_as_stl_text(const char *bytes, std::size_t size)
{
  const auto solid = first_solid(bytes, size);
  if (solid.empty()) return false;
  TextWords words(solid.data(), static_cast<std::size_t>(bytes + size - solid.data()), "");
  words.skip_line();
  const auto word = words.next_word();
  return same_word(word, "facet") || same_word(word, "endsolid");
}

void read_stl_text(const char *bytes, std::size_t size, TriangleSoup &soup)
{
  constexpr std::size_t kTypicalFacetBytes = 200;
  soup.corners.reserve(soup.corners.size() + 3 * (size / kTypicalFacetBytes));
  Reader(bytes, size, soup).read_file();
}

}    // namespace lsdcd
