// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lines of numbers and texts in a file that appears whole or not at all, or, named -, in the standard output.
#pragma once

#include "base/atomic_file.h"
#include "base/input_error.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

namespace lsdcd {

// CSV: quotes around a text from outside.
inline std::string csv_quoted(const std::string &text)
{
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

class CsvFile {
 public:
  explicit CsvFile(const std::string &path)
  {
    if (path != "-") file_.emplace(path);
  }

  void add(const char *text) { text_ += text; }
  // Writes as many digits as read back the same number.
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
    if (file_)
      file_->write_at(at_, text_.data(), text_.size());
    else if (std::fwrite(text_.data(), 1, text_.size(), stdout) < text_.size())
      throw InputError(std::string("the standard output: ") + std::strerror(errno));
    at_ += text_.size();
    text_.clear();
  }
  void commit()
  {
    flush();
    if (file_) file_->commit();
  }

 private:
  std::optional<AtomicFile> file_;
  std::string text_;
  std::uint64_t at_ = 0;
};

}    // namespace lsdcd
