// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words read one after another, with errors that show the right syntax.
#pragma once

#include "base/input_error.h"
#include "base/number_words.h"
#include "base/real.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

constexpr Real kAboveZero = 1e-300;    // the lower end of a range without 0

// "from 0 to 1", or "above 0" for kAboveZero.
std::string range_text(Real low, Real high);

// From `least` to `most`, both in it.
struct NumberRange {
  Real least, most;
};

// Returns the name that takes the fewest inserted, deleted, changed or swapped letters.
std::string nearest(const std::string &word, const std::vector<std::string> &names);
// Returns whether it is near enough to be suggested. At most two letters differ, and not all.
bool is_near(const std::string &word, const std::string &name);
// "the nearest is 'x'" if that is near; else "those are x, y".
std::string nearest_or_all(const std::string &word, const std::vector<std::string> &names);
// May the word be a misspelt name? At most a third of its letters differ.
bool is_like(const std::string &word, const std::string &name);

class Tokens {
 public:
  // `origins`: what a word was made of by a program, as "$law, number 7"; empty: it is written so. Null: all are.
  explicit Tokens(const std::vector<std::string> &tokens,
                  const std::vector<std::string> *origins = nullptr) :
      tokens_(tokens),
      origins_(origins)
  {
  }

  bool done() const { return at_ == tokens_.size(); }
  const std::string &peek() const { return tokens_[at_]; }
  std::string take() { return tokens_[at_++]; }
  // Returns the next word for messages: "'0.5'", or "'0.5' ($law, number 7)".
  std::string quoted() const { return "'" + peek() + "'" + with_origin(); }
  bool number_follows() const;
  // Is it one of the next n words?
  bool is_near(const std::string &word, std::size_t n) const;

  // Returns the position in the words, and the words read since a position, as they were written.
  std::size_t at() const { return at_; }
  std::string between(std::size_t first) const;

  // `name` is being read, with this syntax: errors of the next words say so.
  void set_context(const std::string &name, const std::string &syntax);

  // Returns a number in [low, high]; `what` is its name in messages.
  Real number(const char *what, Real low = -kHuge, Real high = kHuge);
  Real number(const char *what, const NumberRange &in) { return number(what, in.least, in.most); }
  // A whole number in [low, high]; `what` is its name in messages.
  std::int64_t whole(const char *what, Real low, Real high);
  std::int64_t whole(const char *what, const NumberRange &in)
  {
    return whole(what, in.least, in.most);
  }
  // As number(), or `otherwise` if the word is `instead`.
  Real number_or(const char *instead, Real otherwise, const char *what, const NumberRange &in);
  // Returns the index of the word among `choices`.
  int choice(const std::vector<std::string> &choices);

  [[noreturn]] void fail(const std::string &problem) const;
  // Fails where a number follows, which nothing reads. `why`: what is behind "expected".
  void refuse_number(const std::string &why = "") const;

  static constexpr Real kHuge = 1.7976931348623157e308;

 private:
  std::string with_origin() const;
  // Returns what the word before the next one was made of, for messages: " (behind $law, number 5)". Empty: it is written so.
  std::string behind() const;
  const std::vector<std::string> &tokens_;
  const std::vector<std::string> *origins_;
  std::size_t at_ = 0;
  std::string name_, syntax_;
};

}    // namespace lsdcd
