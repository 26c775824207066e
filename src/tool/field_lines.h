// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lines of fields: CSV, or words between blanks. The first line may name the fields.
#pragma once

#include "base/number_words.h"
#include "tool/input_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsdcd {

// Infinite is a word that says so, and not one with too many digits before its point.
inline bool read_number(std::string_view word, Real &value)
{
  return read_real(word, value) &&
         (std::isfinite(value) || word.find_first_of("0123456789") == word.npos);
}
inline bool read_number(std::string_view word, std::int64_t &value)
{
  return read_integer(word, value);
}

// Returns the number in a column of the last line read.
template <class T>
T number(const InputFile &file, const std::vector<std::string_view> &words, std::size_t column)
{
  T value = 0;
  if (column >= words.size())
    file.fail_at_line(file.line_number(), "has " + std::to_string(words.size()) +
                                              " columns, and no number in column " +
                                              std::to_string(column + 1));
  if (words[column].empty())
    file.fail_at_line(file.line_number(), "has nothing in column " + std::to_string(column + 1) +
                                              ", where a number should be");
  if (!read_number(words[column], value))
    file.fail_at_line(file.line_number(), "has '" + std::string(words[column]) + "' in column " +
                                              std::to_string(column + 1) +
                                              ", which is not a number");
  return value;
}

// Returns the column of this name, x, Y or "z" for 'x', 'y' or 'z'; -1: none has it.
inline std::ptrdiff_t column_of(const std::vector<std::string_view> &names, char name)
{
  for (std::size_t k = 0; k < names.size(); k++) {
    std::string_view w = names[k];
    if (w.size() > 2 && w.front() == '"' && w.back() == '"') w = w.substr(1, w.size() - 2);
    if (w.size() == 1 && (w[0] == name || w[0] == name - 'a' + 'A'))
      return static_cast<std::ptrdiff_t>(k);
  }
  return -1;
}

class FieldLines {
 public:
  explicit FieldLines(InputFile file) : file_(std::move(file)) {}

  const InputFile &file() const { return file_; }
  const std::vector<std::string_view> &fields() const { return fields_; }
  // Is this the first line, without a number in it?
  bool are_names() const { return are_names_; }
  // Returns the names of a comment before the first line of numbers, as numpy.savetxt writes them: one for each column, with x, y and z;
  // without such a comment none.
  const std::vector<std::string_view> &names_of_comment() const { return of_comment_; }

  // The next line that is neither empty nor a comment (#); false: there is none.
  bool next()
  {
    for (std::string_view line; file_.line(line);) {
      line = without_blanks(line);
      if (first_ && !line.empty() && line[0] == '#') comment_ = line.substr(1);
      if (line.empty() || line[0] == '#') continue;
      // 0,1;0,2 would be read as four numbers.
      if (line.find(',') != line.npos && line.find(';') != line.npos)
        fail("has both ',' and ';': write decimal commas as points, and separate fields by one "
             "of them");
      split_fields(line, fields_);
      double ignored = 0;
      are_names_ = first_ && std::none_of(fields_.begin(), fields_.end(),
                                          [&](auto word) { return read_number(word, ignored); });
      if (first_ && !are_names_) take_comment();
      first_ = false;
      if (are_names_) {
        named_ = fields_.size();
        named_at_ = file_.line_number();
      }
      if (named_ > 0 && fields_.size() != named_)
        fail("has " + counted(fields_.size(), "column") + ", and line " +
             std::to_string(named_at_) + " names " + std::to_string(named_) +
             ": give each line a value for each name, with '.' in decimals");
      return true;
    }
    return false;
  }
  [[noreturn]] void fail(const std::string &what) const
  {
    file_.fail_at_line(file_.line_number(), what);
  }

 private:
  void take_comment()
  {
    split_fields(without_blanks(comment_), of_comment_);
    bool has_all = of_comment_.size() == fields_.size();
    for (const char axis : {'x', 'y', 'z'}) has_all = has_all && column_of(of_comment_, axis) >= 0;
    if (!has_all) of_comment_.clear();
  }

  InputFile file_;
  std::vector<std::string_view> fields_, of_comment_;
  std::string comment_;    // the last one before the first line
  bool first_ = true, are_names_ = false;
  std::size_t named_ = 0;    // 0: there is no line of names
  long named_at_ = 0;
};

}    // namespace lsdcd
