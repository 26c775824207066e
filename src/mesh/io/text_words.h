// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words and numbers of a mesh file that is text; private to the mesh room.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lsdcd {

// In any case of letters; `keyword` is in lower case.
bool same_word(std::string_view word, std::string_view keyword);

// A word as it may appear in a message: in quotes, short, without control characters.
std::string quoted(std::string_view word);

// A finite number of read_real(). Anything else has a problem and a remedy, for a message.
struct ReadNumber {
  Real value = 0;
  const char *problem = nullptr;    // nullptr: none
  const char *remedy = nullptr;
};
ReadNumber read_number(std::string_view word);

struct TextStyle {
  char comment = 0;          // begins a comment, which ends with its line; 0: there are none
  bool continued = false;    // a line that ends with a backslash goes on in the next
};

// Reads words one after another. A line ends with LF, CR LF or CR. A byte order mark of UTF-8 is skipped.
// The bytes have to outlive the reader.
class TextWords {
 public:
  // `source` is the name in messages.
  TextWords(const char *bytes, std::size_t size, std::string source, TextStyle style = {});

  // Returns the next word in this line or after it; empty: the file ends.
  std::string_view next_word();
  // Returns the next word in this line; empty: the line ends.
  std::string_view word_in_line();
  // Leaves what is left of this line, and of those that continue it.
  void skip_line();
  // Leaves what is left of this line alone. True: it ends with a backslash that would continue it.
  bool skip_line_alone();
  // True after a word of this line: it is the last thing in the file, which may have been cut there.
  bool file_ends_with(std::string_view word) const { return word.data() + word.size() == end_; }
  // Goes to the next line. False: there is none.
  bool next_line();

  bool done() const { return at_ == end_; }
  // Returns the offset of the next byte.
  std::string_view here() const { return {at_, 0}; }    // NOLINT(bugprone-string-constructor)
  const char *end() const { return end_; }

  // Returns the number that the word is. For an error name() says which one it is;
  template <class Name>
  Real number(std::string_view word, Name &&name) const
  {
    const ReadNumber number = read_number(word);
    if (number.problem)
      fail(word, name() + " is " + quoted(word) + ", " + number.problem, number.remedy);
    return number.value;
  }

  // Throws InputError if the bytes begin as UTF-16 does.
  void refuse_utf16() const;

  // Throws InputError: "source, line 7 (place): what; remedy". `word` is one of this file, or has its
  // address. Lines are counted here only, so that reading is quick.
  [[noreturn]] void fail(std::string_view word, const std::string &what, const std::string &remedy,
                         const std::string &place = "") const;

 private:
  bool at_comment() const;
  bool at_continuation() const;
  bool pass_continuation();    // false: there is none here
  void pass_line_end();

  const char *begin_, *at_, *end_;
  std::string source_;
  TextStyle style_;
};

}    // namespace lsdcd
