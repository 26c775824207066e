// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A file read from its beginning to its end, in bytes or in lines; named -, the standard input.
#pragma once

#include "base/byte_order_mark.h"
#include "base/input_error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lsdcd {

class InputFile {
 public:
  explicit InputFile(const std::string &path) :
      path_(path == "-" ? "the standard input" : path),
      file_(path == "-" ? stdin : std::fopen(path.c_str(), "rb"))
  {
    if (!file_) fail(std::strerror(errno));
    if (path != "-") {
      if (std::fseek(file_.get(), 0, SEEK_END) == 0) size_ = std::ftell(file_.get());
      std::rewind(file_.get());
    }
    buffer_.resize(std::size_t(1) << 20);
    fill();
    if (ahead(kByteOrderMark.size()) == kByteOrderMark) at_ = kByteOrderMark.size();
  }

  const std::string &path() const { return path_; }
  long size() const { return size_; }    // 0: not known, as of a pipe
  long taken() const { return read_ - static_cast<long>(end_ - at_); }
  void go_to(long byte)
  {
    if (std::fseek(file_.get(), byte, SEEK_SET) != 0) fail(std::strerror(errno));
    read_ = byte;
    at_ = end_ = 0;
  }
  double share_read() const { return size_ > 0 ? double(taken()) / size_ : 0; }
  long line_number() const { return line_; }

  // Returns the next bytes, without taking them; fewer if the file has no more.
  std::string_view ahead(std::size_t n) const
  {
    return {buffer_.data() + at_, std::min(n, end_ - at_)};
  }
  // Takes up to n bytes.
  std::size_t bytes(char *to, std::size_t n)
  {
    std::size_t done = 0;
    while (done < n) {
      if (at_ == end_ && !fill()) break;
      const std::size_t part = std::min(n - done, end_ - at_);
      std::memcpy(to + done, buffer_.data() + at_, part);
      at_ += part;
      done += part;
    }
    return done;
  }
  // Finds the next line without its end, valid until the next call; false: there is none.
  bool line(std::string_view &text)
  {
    for (std::size_t looked = 0;;) {
      const char *from = buffer_.data() + at_;
      const void *found = std::memchr(from + looked, '\n', end_ - at_ - looked);
      if (found) {
        text = {from, static_cast<std::size_t>(static_cast<const char *>(found) - from)};
        at_ += text.size() + 1;
        break;
      }
      looked = end_ - at_;
      if (looked == buffer_.size())
        fail_at_line(line_ + 1, "has more than 1 MB; is this a text file?");
      if (!fill()) {
        if (at_ == end_) return false;
        text = {buffer_.data() + at_, end_ - at_};
        at_ = end_;
        break;
      }
    }
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    line_++;
    return true;
  }

  [[noreturn]] void fail(const std::string &what) const { throw InputError(path_ + ": " + what); }
  [[noreturn]] void fail_at_line(long line, const std::string &what) const
  {
    fail("line " + std::to_string(line) + " " + what);
  }

 private:
  struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };

  // Reads more of the file after what is not yet read; false: there is no more.
  bool fill()
  {
    std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
    end_ -= at_;
    at_ = 0;
    const std::size_t n = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
    if (n == 0 && std::ferror(file_.get())) fail(std::strerror(errno));
    end_ += n;
    read_ += static_cast<long>(n);
    return n > 0;
  }

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  long size_ = 0, line_ = 0, read_ = 0;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;
};

inline bool is_blank(char c)
{
  return c == ' ' || c == '\t';
}

inline std::string_view without_blanks(std::string_view text)
{
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Words between blanks.
inline void split_words(std::string_view text, std::vector<std::string_view> &words)
{
  words.clear();
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    std::size_t n = 0;
    while (n < text.size() && !is_blank(text[n])) n++;
    words.push_back(text.substr(0, n));
    text.remove_prefix(n);
  }
}

// In a line with commas or semicolons each of them ends a field, even an empty one. Else the fields are
// the words.
inline void split_fields(std::string_view text, std::vector<std::string_view> &fields)
{
  constexpr const char *kEnds = ",;";
  std::size_t end = text.find_first_of(kEnds);
  if (end == text.npos) return split_words(text, fields);
  fields.clear();
  for (; end != text.npos; end = text.find_first_of(kEnds)) {
    fields.push_back(without_blanks(text.substr(0, end)));
    text.remove_prefix(end + 1);
  }
  fields.push_back(without_blanks(text));
}

}    // namespace lsdcd
