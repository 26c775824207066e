// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/io/text_words.h"

#include "base/byte_order_mark.h"
#include "base/input_error.h"
#include "base/number_words.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {
namespace {

bool is_line_end(char c)
{
  return c == '\n' || c == '\r';
}

bool is_space(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

const char *remedy_for(std::string_view word)
{
  const auto letter = word.find_first_of("dD");
  if (letter != word.npos && letter > 0 && (is_digit(word[letter - 1]) || word[letter - 1] == '.'))
    return "D is an exponent of Fortran: write E for it";
  if (word.find(',') != word.npos) return "write a decimal point, and spaces between numbers";
  return "correct the line or export the mesh again";
}

}    // namespace

bool same_word(std::string_view word, std::string_view keyword)
{
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    if ((c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) != keyword[i]) return false;
  }
  return true;
}

std::string quoted(std::string_view word)
{
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest))
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return text + (word.size() > kLongest ? "...'" : "'");
}

ReadNumber read_number(std::string_view word)
{
  ReadNumber number;
  if (!read_real(word, number.value)) return {0, "not a number", remedy_for(word)};
  if (!std::isfinite(number.value)) return {0, "not a finite number", remedy_for(word)};
  return number;
}

TextWords::TextWords(const char *bytes, std::size_t size, std::string source, TextStyle style) :
    begin_(bytes), at_(bytes), end_(bytes + size), source_(std::move(source)), style_(style)
{
  if (std::string_view(bytes, size).substr(0, 3) == kByteOrderMark) at_ += 3;
}

void TextWords::refuse_utf16() const
{
  const auto mark = std::string_view(begin_, end_ - begin_).substr(0, 2);
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF")
    fail(here(), "the text is in UTF-16", "save it as UTF-8 or ASCII");
}

void TextWords::pass_line_end()
{
  at_ += at_ + 1 != end_ && at_[0] == '\r' && at_[1] == '\n' ? 2 : 1;
}

bool TextWords::at_continuation() const
{
  return style_.continued && end_ - at_ > 1 && *at_ == '\\' && is_line_end(at_[1]);
}

// A comment goes to the end of its line, whatever it ends with: it may be a folder of Windows.
bool TextWords::at_comment() const
{
  return style_.comment && at_ != end_ && *at_ == style_.comment;
}

bool TextWords::pass_continuation()
{
  if (!at_continuation()) return false;
  ++at_;
  pass_line_end();
  return true;
}

std::string_view TextWords::word_in_line()
{
  for (;;) {
    while (at_ != end_ && is_space(*at_) && !is_line_end(*at_)) ++at_;
    if (!pass_continuation()) break;
  }
  if (at_comment()) skip_line_alone();
  const char *first = at_;
  // 1.#INF and 1.#QNAN of Microsoft's library are words, not 1 and a comment.
  while (at_ != end_ && !is_space(*at_) && !at_continuation() &&
         (!at_comment() || (at_ != first && at_[-1] == '.')))
    ++at_;
  return {first, static_cast<std::size_t>(at_ - first)};
}

std::string_view TextWords::next_word()
{
  for (;;) {
    const auto word = word_in_line();
    if (!word.empty() || !next_line()) return word;
  }
}

void TextWords::skip_line()
{
  while (skip_line_alone()) pass_line_end();
}

bool TextWords::skip_line_alone()
{
  while (at_ != end_ && !is_line_end(*at_) && !at_continuation() && !at_comment()) ++at_;
  if (at_continuation()) {
    ++at_;
    return true;
  }
  while (at_ != end_ && !is_line_end(*at_)) ++at_;
  return false;
}

bool TextWords::next_line()
{
  skip_line();
  if (at_ == end_) return false;
  pass_line_end();
  return true;
}

void TextWords::fail(std::string_view word, const std::string &what, const std::string &remedy,
                     const std::string &place) const
{
  std::size_t line = 1;
  for (const char *c = begin_; c != word.data(); ++c)
    if (*c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n'))) ++line;
  throw InputError(source_ + ", line " + std::to_string(line) +
                   (place.empty() ? "" : " (" + place + ")") + ": " + what + "; " + remedy);
}

}    // namespace lsdcd
