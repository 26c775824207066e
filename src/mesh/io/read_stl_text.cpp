// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/io/read_stl_text.h"

#include "base/input_error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

namespace lsdcd {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_space(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// `keyword` is in lower case.
bool same_word(std::string_view word, std::string_view keyword)
{
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    if ((c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) != keyword[i]) return false;
  }
  return true;
}

bool is_stl_word(std::string_view word)
{
  for (const char *keyword :
       {"solid", "facet", "outer", "loop", "vertex", "endloop", "endfacet", "endsolid"})
    if (same_word(word, keyword)) return true;
  return false;
}

// A word as it may appear in a message: short, and free of control characters.
std::string quoted(std::string_view word)
{
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest))
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return text + (word.size() > kLongest ? "...'" : "'");
}

// from_chars reports 1e-400 and 1e400 alike. The first is zero, the second is infinite: the power of
// ten of the first digit that is not 0 tells.
bool is_underflow(std::string_view number)
{
  const auto e = std::min(number.find_first_of("eE"), number.size());
  const auto digits = number.substr(0, e), exponent = number.substr(std::min(e + 1, number.size()));
  const auto first = digits.find_first_of("123456789"), point = std::min(digits.find('.'), e);
  if (first == digits.npos) return true;
  long long power = 0;
  const char *sign = exponent.data();
  const auto *begin = sign + (!exponent.empty() && *sign == '+');
  const auto read = std::from_chars(begin, exponent.data() + exponent.size(), power);
  if (read.ec == std::errc::result_out_of_range) return *begin == '-';
  power = std::clamp<long long>(power, -1000000000000, 1000000000000);    // as far as files go
  return power + static_cast<long long>(point) < static_cast<long long>(first);
}

class Reader {
 public:
  Reader(const char *bytes, std::size_t size, TriangleSoup &soup) :
      begin_(bytes), at_(bytes), end_(bytes + size), soup_(soup)
  {
    if (std::string_view(bytes, size).substr(0, 3) == kByteOrderMark) at_ += 3;
  }

  std::string_view next_word()
  {
    while (at_ != end_ && is_space(*at_)) ++at_;
    const char *first = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  void skip_line()
  {
    while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
  }

  void read_file()
  {
    bool in_stl = false;
    for (auto word = next_word(); !word.empty(); word = next_word()) {
      const bool solid = same_word(word, "solid");
      // Text after an endsolid is ignored, but STL words there are lost facets.
      if (!solid && (!in_stl || is_stl_word(word))) fail_word(word, "'solid'");
      skip_line();
      if (solid) read_solid();
      in_stl = true;
    }
  }

 private:
  void read_solid()
  {
    for (;;) {
      const auto word = next_word();
      if (same_word(word, "facet"))
        read_facet();
      else if (same_word(word, "endsolid"))
        return skip_line();
      else
        fail_word(word, "'facet' or 'endsolid'");
    }
  }

  void read_facet()
  {
    // The normal is not used: some exporters write 0 or NaN or leave it out. The corners give it.
    auto word = next_word();
    for (int skipped = 0; !same_word(word, "outer"); ++skipped) {
      if (skipped == 4 || word.empty() || is_stl_word(word)) fail_word(word, "'outer loop'");
      word = next_word();
    }
    expect("loop");
    for (int corner = 1; corner <= 3; ++corner) {
      word = next_word();
      if (same_word(word, "endloop"))
        fail(word, "the facet has " + std::to_string(corner - 1) + " vertices, not 3",
             "remove or complete it, or export the mesh again");
      if (!same_word(word, "vertex")) fail_word(word, "'vertex'");
      Vec3 x;
      for (int axis = 0; axis < 3; ++axis) x[axis] = read_coordinate(corner, axis);
      soup_.corners.push_back(x);
    }
    word = next_word();
    if (same_word(word, "vertex"))
      fail(word, "the facet has more than 3 vertices", "triangulate the mesh when exporting it");
    if (!same_word(word, "endloop")) fail_word(word, "'endloop'");
    expect("endfacet");
    ++facet_;
  }

  Real read_coordinate(int corner, int axis)
  {
    const std::string_view here(at_, 0);    // NOLINT(bugprone-string-constructor): a place, no text
    const auto word = next_word();
    const auto name = [&] {
      return std::string("coordinate ") + "xyz"[axis] + " of vertex " + std::to_string(corner);
    };
    if (word.empty()) fail_word(word, name());
    if (is_stl_word(word))
      fail(here, name() + " is missing: " + quoted(word) + " found",
           "complete the line or export the mesh again");

    auto digits = word;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    Real value = 0;
    const auto end = digits.data() + digits.size();
    const auto parsed = std::from_chars(digits.data(), end, value);
    if (parsed.ec == std::errc::invalid_argument || parsed.ptr != end) {
      if (end == end_) fail_word(word, name());
      fail(word, name() + " is " + quoted(word) + ", not a number",
           word.find(',') != word.npos ? "write a decimal point, and spaces between numbers"
                                       : "correct the line or export the mesh again");
    }
    if (parsed.ec == std::errc::result_out_of_range) value = is_underflow(digits) ? 0 : HUGE_VAL;
    if (!std::isfinite(value))
      fail(word, name() + " is " + quoted(word) + ", not a finite number",
           "correct the line or export the mesh again");
    return value;
  }

  void expect(const char *keyword)
  {
    const auto word = next_word();
    if (!same_word(word, keyword)) fail_word(word, "'" + std::string(keyword) + "'");
  }

  // An unexpected word, or the end of the file where `expected` should be.
  [[noreturn]] void fail_word(std::string_view word, const std::string &expected) const
  {
    const std::string found = word.empty() ? "the file ends" : quoted(word) + " found";
    const char *remedy = "correct the line or export the mesh again";
    if (!begins_with_solid(begin_, static_cast<std::size_t>(end_ - begin_)))
      remedy = "this is not an STL file: export the mesh as STL";
    else if (word.data() + word.size() == end_)
      remedy = "the file is truncated: copy or export it again";
    fail(word, found + " where " + expected + " is expected", remedy);
  }

  // Lines are counted only for a message, so that reading is quick.
  [[noreturn]] void fail(std::string_view word, const std::string &what,
                         const std::string &remedy) const
  {
    std::size_t line = 1;
    for (const char *c = begin_; c != word.data(); ++c)
      if (*c == '\n' || (*c == '\r' && c + 1 != end_ && c[1] != '\n')) ++line;
    throw InputError(soup_.source + ", line " + std::to_string(line) + " (facet " +
                     std::to_string(facet_) + "): " + what + "; " + remedy);
  }

  const char *begin_, *at_, *end_;
  TriangleSoup &soup_;
  std::size_t facet_ = 1;    // the one being read, for messages
};

}    // namespace

bool begins_with_solid(const char *bytes, std::size_t size)
{
  TriangleSoup none;
  return same_word(Reader(bytes, size, none).next_word(), "solid");
}

bool begins_as_stl_text(const char *bytes, std::size_t size)
{
  TriangleSoup none;
  Reader reader(bytes, size, none);
  if (!same_word(reader.next_word(), "solid")) return false;
  reader.skip_line();
  const auto word = reader.next_word();
  return same_word(word, "facet") || same_word(word, "endsolid");
}

void read_stl_text(const char *bytes, std::size_t size, TriangleSoup &soup)
{
  constexpr std::size_t kTypicalFacetBytes = 200;
  soup.corners.reserve(soup.corners.size() + 3 * (size / kTypicalFacetBytes));
  Reader(bytes, size, soup).read_file();
}

}    // namespace lsdcd
