// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_words.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// Letters to insert, delete, change or swap with the next to turn a into b.
std::size_t edit_distance(const std::string &a, const std::string &b)
{
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); i++)
    for (std::size_t j = 0; j <= b.size(); j++) {
      d[i][j] = i + j;
      if (i == 0 || j == 0) continue;
      d[i][j] =
          std::min({d[i - 1][j - 1] + (a[i - 1] != b[j - 1]), d[i - 1][j] + 1, d[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}    // namespace

std::string nearest(const std::string &word, const std::vector<std::string> &names)
{
  return *std::min_element(names.begin(), names.end(),
                           [&](const std::string &a, const std::string &b) {
                             return edit_distance(word, a) < edit_distance(word, b);
                           });
}

bool is_near(const std::string &word, const std::string &name)
{
  return edit_distance(word, name) < std::min({std::size_t(3), word.size(), name.size()});
}

std::string nearest_or_all(const std::string &word, const std::vector<std::string> &names)
{
  const std::string near = nearest(word, names);
  if (is_near(word, near)) return "the nearest is '" + near + "'";
  std::string all;
  for (const std::string &name : names) all += (all.empty() ? "" : ", ") + name;
  return "those are " + all;
}

bool is_like(const std::string &word, const std::string &name)
{
  return 3 * edit_distance(word, name) <= std::max(word.size(), name.size());
}

std::string range_text(Real low, Real high)
{
  const bool with_low = low > -Tokens::kHuge, with_high = high < Tokens::kHuge;
  Real shown_low = 0, shown_high = 0;
  if (low <= 0 || low > kAboveZero) is_number(number_text(low), &shown_low);
  is_number(number_text(high), &shown_high);
  const bool open_low = shown_low<low, open_high = shown_high> high;
  const std::string from = number_text(shown_low), to = number_text(shown_high);
  if (!with_high) return open_low ? "above " + from : from + " or more";
  if (!with_low) return open_high ? "below " + to : to + " or less";
  if (open_low || open_high)
    return (open_low ? "above " : "from ") + from + (open_high ? " to below " : " to ") + to;
  return "from " + from + " to " + to;
}

std::string Tokens::between(std::size_t first) const
{
  std::string text;
  for (std::size_t i = first; i < at_; i++) text += (i > first ? " " : "") + tokens_[i];
  return text;
}

void Tokens::set_context(const std::string &name, const std::string &syntax)
{
  name_ = name;
  syntax_ = syntax;
}

bool Tokens::number_follows() const
{
  Real value;
  return !done() && is_number(peek(), &value);
}

bool Tokens::is_near(const std::string &word, std::size_t n) const
{
  const auto from = tokens_.begin() + static_cast<std::ptrdiff_t>(at_),
             to = from + static_cast<std::ptrdiff_t>(std::min(n, tokens_.size() - at_));
  return std::find(from, to, word) != to;
}

Real Tokens::number(const char *what, Real low, Real high)
{
  Real value = 0;
  if (done()) fail(std::string("the value of ") + what + " is missing" + behind());
  if (!is_number(peek(), &value))
    fail(std::string(what) + " must be a number, not " + quoted() + behind());
  if (value < low || value > high)
    fail(std::string(what) + " = " + peek() + with_origin() + " is out of range: it must be " +
         range_text(low, high));
  ++at_;
  return value;
}

std::int64_t Tokens::whole(const char *what, Real low, Real high)
{
  const Real n = number(what, low, high);
  if (n != std::floor(n)) fail(std::string(what) + " must be a whole number");
  return static_cast<std::int64_t>(n);
}

Real Tokens::number_or(const char *instead, Real otherwise, const char *what, const NumberRange &in)
{
  if (done() || peek() != instead) return number(what, in);
  ++at_;
  return otherwise;
}

int Tokens::choice(const std::vector<std::string> &choices)
{
  if (done()) fail("its value is missing");
  const auto found = std::find(choices.begin(), choices.end(), peek());
  if (found == choices.end()) fail("'" + peek() + "' is not one of its values");
  ++at_;
  return static_cast<int>(found - choices.begin());
}

std::string Tokens::with_origin() const
{
  return origins_ && !(*origins_)[at_].empty() ? " (" + (*origins_)[at_] + ")" : "";
}

std::string Tokens::behind() const
{
  return origins_ && at_ > 0 && !(*origins_)[at_ - 1].empty()
             ? " (behind " + (*origins_)[at_ - 1] + ")"
             : "";
}

void Tokens::refuse_number(const std::string &why) const
{
  if (number_follows()) fail("the number " + quoted() + " is one more than expected" + why);
}

void Tokens::fail(const std::string &problem) const
{
  throw InputError("in '" + name_ + "', " + problem + ". Syntax: " + syntax_);
}

}    // namespace lsdcd
