#include "input_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lsdcd {

bool is_number(const std::string &word, Real *value)
{
  char *end = nullptr;
  *value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' && std::isfinite(*value);
}

std::string number_text(Real value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

namespace {

// Letters to insert, delete or change to turn a into b.
std::size_t edit_distance(const std::string &a, const std::string &b)
{
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); j++) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); i++) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); j++) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}    // namespace

std::string nearest(const std::string &word, const std::vector<std::string> &names)
{
  return *std::min_element(names.begin(), names.end(),
                           [&](const std::string &a, const std::string &b) {
                             return edit_distance(word, a) < edit_distance(word, b);
                           });
}

std::string Words::between(std::size_t first) const
{
  std::string text;
  for (std::size_t i = first; i < at_; i++) text += (i > first ? " " : "") + words_[i];
  return text;
}

void Words::expect(const std::string &name, const std::string &syntax)
{
  name_ = name;
  syntax_ = syntax;
}

bool Words::number_follows() const
{
  Real value;
  return !done() && is_number(peek(), &value);
}

Real Words::number(const char *what, Real low, Real high)
{
  Real value = 0;
  if (done()) fail(std::string("the value of ") + what + " is missing");
  if (!is_number(peek(), &value))
    fail(std::string(what) + " must be a number, not '" + peek() + "'");
  if (value < low || value > high) fail(std::string(what) + " = " + peek() + " is out of range");
  ++at_;
  return value;
}

Real Words::number_or(const char *instead, Real otherwise, const char *what, Real low)
{
  if (done() || peek() != instead) return number(what, low);
  ++at_;
  return otherwise;
}

int Words::choice(const std::vector<std::string> &choices)
{
  if (done()) fail("its value is missing");
  const auto found = std::find(choices.begin(), choices.end(), peek());
  if (found == choices.end()) fail("'" + peek() + "' is not one of its values");
  ++at_;
  return static_cast<int>(found - choices.begin());
}

void Words::fail(const std::string &problem) const
{
  throw InputError("in '" + name_ + "', " + problem + ". Syntax: " + syntax_);
}

}    // namespace lsdcd
