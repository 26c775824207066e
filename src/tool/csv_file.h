// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lines of numbers in a file that appears whole or not at all.
#pragma once

#include "base/atomic_file.h"

#include <charconv>
#include <string>

namespace lsdcd {

class CsvFile {
 public:
  explicit CsvFile(const std::string &path) : file_(path) {}

  void add(const char *text) { text_ += text; }
  // With the digits that read back the same number.
  template <class T>
  void add(T value, char after)
  {
    char digits[32];
    char *end = std::to_chars(digits, digits + sizeof digits - 1, value).ptr;
    *end++ = after;
    text_.append(digits, end);
  }
  void flush()
  {
    file_.write_at(at_, text_.data(), text_.size());
    at_ += text_.size();
    text_.clear();
  }
  void commit()
  {
    flush();
    file_.commit();
  }

 private:
  AtomicFile file_;
  std::string text_;
  std::uint64_t at_ = 0;
};

}    // namespace lsdcd
