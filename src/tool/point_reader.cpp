// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/point_reader.h"

#include "tool/field_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

namespace lsdcd {

namespace {

using Words = std::vector<std::string_view>;

class LinesReader : public PointReader {
 public:
  explicit LinesReader(InputFile file) : lines_(std::move(file)) {}

  void read(PointBlock &block, std::size_t most) override
  {
    block.clear();
    while (block.size() < most && lines_.next()) {
      if (std::exchange(is_first_, false))
        take_names(lines_.are_names() ? lines_.fields() : lines_.names_of_comment());
      if (lines_.are_names()) continue;
      check_columns();
      for (const std::size_t c : column_)
        block.xyz.push_back(number<double>(lines_.file(), lines_.fields(), c));
    }
  }
  double share_read() const override { return lines_.file().share_read(); }

 private:
  // A line with more columns than others may be two lines in one, of which the second point would be lost.
  void check_columns()
  {
    if (columns_ == 0) {
      columns_ = lines_.fields().size();
      columns_at_ = lines_.file().line_number();
    }
    if (lines_.fields().size() != columns_)
      lines_.fail("has " + counted(static_cast<std::int64_t>(lines_.fields().size()), "column") +
                  ", and line " + std::to_string(columns_at_) + " has " + std::to_string(columns_) +
                  ": give each line as many");
  }
  void take_names(const Words &names)
  {
    for (int k = 0; k < 3 && !names.empty(); k++) {
      const std::ptrdiff_t found = column_of(names, "xyz"[k]);
      if (found < 0)
        lines_.fail(std::string("names columns, but none ") + "xyz"[k] + "; name them x, y and z");
      column_[k] = static_cast<std::size_t>(found);
    }
  }

  FieldLines lines_;
  bool is_first_ = true;
  std::array<std::size_t, 3> column_ = {0, 1, 2};
  std::size_t columns_ = 0;    // of the first line of numbers
  long columns_at_ = 0;
};

class DumpReader : public PointReader {
 public:
  explicit DumpReader(InputFile file) : file_(std::move(file)) { has_ids_ = true; }

  void read(PointBlock &block, std::size_t most) override
  {
    block.clear();
    while (block.size() < most) {
      if (left_ == 0 && !snapshot()) return;
      if (left_ == 0) continue;    // a snapshot of no atoms
      words_of_line("an atom");
      for (int k = 0; k < 3; k++) {
        const double x = number<double>(file_, words_, column_[k]);
        block.xyz.push_back(scaled_[k] ? lo_[k] + x * (hi_[k] - lo_[k]) : x);
      }
      block.step.push_back(step_);
      block.id.push_back(id_column_ < 0 ? ++order_
                                        : number<std::int64_t>(file_, words_, id_column_));
      left_--;
    }
  }
  double share_read() const override { return file_.share_read(); }

 private:
  void words_of_line(const char *what)
  {
    std::string_view line;
    if (!file_.line(line))
      file_.fail("ends after line " + std::to_string(file_.line_number()) + ", where " + what +
                 " should be; is the dump still being written?");
    split_words(line, words_);
  }

  // Reads up to the first atom; false: the file ends.
  bool snapshot()
  {
    std::string_view line;
    while (file_.line(line)) {
      split_words(line, words_);
      if (words_.empty()) continue;
      if (words_[0] != "ITEM:" || words_.size() < 2)
        file_.fail_at_line(file_.line_number(),
                           "is '" + std::string(line.substr(0, 40)) + "', not ITEM: ...");
      const std::string item(words_[1]);
      if (item == "ATOMS") {
        take_columns();
        return true;
      }
      // Bounds of a tilted box, or, of any three edges, abc.
      const bool tilted = words_.size() > 3 && (words_[3] == "xy" || words_[3] == "abc");
      if (item == "BOX") {
        take_box(tilted);
        continue;
      }
      words_of_line(item.c_str());
      if (item == "TIMESTEP") step_ = number<std::int64_t>(file_, words_, 0);
      if (item == "NUMBER") left_ = number<std::int64_t>(file_, words_, 0);
    }
    return false;
  }
  void take_box(bool tilted)
  {
    tilted_ = tilted;
    for (int k = 0; k < 3; k++) {
      words_of_line("the box");
      lo_[k] = number<double>(file_, words_, 0);
      hi_[k] = number<double>(file_, words_, 1);
    }
  }
  void take_columns()
  {
    const auto find = [&](const std::string &name) -> std::ptrdiff_t {
      const auto at = std::find(words_.begin() + 2, words_.end(), name);
      return at == words_.end() ? -1 : at - words_.begin() - 2;
    };
    id_column_ = find("id");
    order_ = 0;
    for (int k = 0; k < 3; k++) {
      const std::string axis(1, "xyz"[k]);
      column_[k] = -1;
      for (const char *ending : {"", "u", "s", "su"}) {
        if (column_[k] >= 0) break;
        column_[k] = find(axis + ending);
        scaled_[k] = ending[0] == 's';
      }
      if (column_[k] < 0)
        file_.fail_at_line(file_.line_number(), "has no column " + axis + ", " + axis + "u or " +
                                                    axis + "s; dump custom ... id x y z");
      if (scaled_[k] && tilted_)
        file_.fail_at_line(file_.line_number(),
                           "has " + axis + "s of a tilted box; dump custom ... id x y z");
    }
  }

  InputFile file_;
  Words words_;
  std::int64_t step_ = 0, left_ = 0, order_ = 0;
  double lo_[3] = {0, 0, 0}, hi_[3] = {1, 1, 1};
  bool scaled_[3] = {false, false, false}, tilted_ = false;
  std::ptrdiff_t column_[3] = {-1, -1, -1}, id_column_ = -1;
};

// Numbers of an array, `stride` apart as doubles. Integers beyond 2^53 are rounded.
template <class T>
void to_doubles(const char *raw, std::size_t n, double *to, std::size_t stride)
{
  for (std::size_t i = 0; i < n; i++) {
    T x;
    std::memcpy(&x, raw + i * sizeof x, sizeof x);
    to[i * stride] = static_cast<double>(x);
  }
}

struct NumberType {
  const char *name;    // numpy's
  std::size_t bytes;
  void (*to_doubles)(const char *raw, std::size_t n, double *to, std::size_t stride);
};

template <class T>
constexpr NumberType number_type(const char *name)
{
  return {name, sizeof(T), to_doubles<T>};
}

constexpr NumberType kNumberTypes[] = {
    number_type<double>("<f8"),        number_type<float>("<f4"),
    number_type<std::int64_t>("<i8"),  number_type<std::int32_t>("<i4"),
    number_type<std::int16_t>("<i2"),  number_type<std::int8_t>("|i1"),
    number_type<std::uint64_t>("<u8"), number_type<std::uint32_t>("<u4"),
    number_type<std::uint16_t>("<u2"), number_type<std::uint8_t>("|u1")};

// The header of an .npy file: a dict of Python with these three keys and no others, blanks between its parts and behind it.
class NpyHeader {
 public:
  explicit NpyHeader(std::string_view text) : left_(text) {}

  // False: it is something else, or an array of another shape than (n, 3).
  bool read()
  {
    bool descr = false, order = false, shape = false;
    if (!take("{")) return false;
    while (!take("}")) {
      if (!descr && take_key("descr"))
        descr = take_type();
      else if (!order && take_key("fortran_order"))
        order = (by_columns_ = take("True")) || take("False");
      else if (!shape && take_key("shape"))
        shape =
            take("(") && take_count() && take(",") && take("3") && (take(",") || true) && take(")");
      else
        return false;
      if (!take(",") && left_.substr(0, 1) != "}") return false;
    }
    skip_blanks();
    return descr && order && shape && left_.empty();
  }

  const NumberType *type() const { return type_; }
  bool by_columns() const { return by_columns_; }    // in Fortran order
  std::size_t rows() const { return rows_; }

 private:
  void skip_blanks()
  {
    left_.remove_prefix(std::min(left_.find_first_not_of(" \t\r\n"), left_.size()));
  }
  // Takes this and the blanks around it; false: something else comes.
  bool take(std::string_view what)
  {
    skip_blanks();
    if (left_.substr(0, what.size()) != what) return false;
    left_.remove_prefix(what.size());
    skip_blanks();
    return true;
  }
  bool take_quoted(const std::string &text)
  {
    return take("'" + text + "'") || take("\"" + text + "\"");
  }
  bool take_key(const std::string &name) { return take_quoted(name) && take(":"); }
  bool take_type()
  {
    for (const NumberType &type : kNumberTypes)
      if (take_quoted(type.name)) type_ = &type;
    return type_ != nullptr;
  }
  bool take_count()
  {
    const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), rows_);
    left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    return error == std::errc();
  }

  std::string_view left_;
  const NumberType *type_ = nullptr;
  bool by_columns_ = false;
  std::size_t rows_ = 0;
};

class NpyReader : public PointReader {
 public:
  explicit NpyReader(InputFile file)
  {
    const bool by_columns = take_header(file);
    const long start = file.taken();
    const std::string path = file.path();
    files_.push_back(std::move(file));
    if (files_[0].size() > 0) check_size(static_cast<std::size_t>(files_[0].size() - start));
    if (!by_columns) return;
    if (files_[0].size() == 0)
      files_[0].fail("is in Fortran order, which cannot be read from a pipe; give the file, or "
                     "numpy.save(file, numpy.ascontiguousarray(points))");
    for (const long column : {1, 2}) {
      files_.emplace_back(path);
      files_.back().go_to(start + column * static_cast<long>(n_ * type_->bytes));
    }
  }

  void read(PointBlock &block, std::size_t most) override
  {
    block.clear();
    const std::size_t n = std::min<std::size_t>(most, n_ - done_);
    block.xyz.resize(3 * n);
    const std::size_t stride = files_.size(), each = 3 * n / stride;
    raw_.resize(each * type_->bytes);
    for (std::size_t k = 0; k < stride; k++) {
      const std::size_t got = files_[k].bytes(raw_.data(), raw_.size());
      if (got < raw_.size()) fail_in_point(done_ + got / (raw_.size() / n));
      type_->to_doubles(raw_.data(), each, block.xyz.data() + k, stride);
    }
    done_ += n;
    char more;
    if (n == 0 && files_[0].size() == 0 && files_[0].bytes(&more, 1) > 0) fail_past_end();
  }
  double share_read() const override { return n_ > 0 ? double(done_) / double(n_) : 0; }

 private:
  // Is the array in Fortran order?
  bool take_header(InputFile &file)
  {
    char start[12] = {};
    const std::size_t short_bytes = 2;
    file.bytes(start, 8);
    if (start[6] < 1 || start[6] > 3 || start[7] != 0)
      file.fail("is of version " + std::to_string(static_cast<unsigned char>(start[6])) + "." +
                std::to_string(static_cast<unsigned char>(start[7])) +
                " of .npy files; those of 1.0 to 3.0 are read: numpy.save() writes them");
    const std::size_t length_bytes = start[6] == 1 ? short_bytes : 4;
    file.bytes(start + 8, length_bytes);
    std::size_t length = 0;
    for (std::size_t i = 0; i < length_bytes; i++)
      length |= std::size_t(static_cast<unsigned char>(start[8 + i])) << (8 * i);
    constexpr std::size_t kMax = 1 << 16;
    std::string head(std::min(length, kMax), ' ');
    if (length > kMax || file.bytes(head.data(), length) < length)
      file.fail("its .npy header is truncated");
    NpyHeader header(head);
    if (!header.read()) fail_as_array(file, head);
    type_ = header.type();
    n_ = header.rows();
    return header.by_columns();
  }
  // `bytes`: of the file behind the header.
  void check_size(std::size_t bytes) const
  {
    const std::size_t points = bytes / (3 * type_->bytes);
    if (points < n_) fail_in_point(points);
    if (bytes > n_ * 3 * type_->bytes) fail_past_end();
  }
  [[noreturn]] static void fail_as_array(const InputFile &file, std::string head)
  {
    for (char &c : head)
      if (c < ' ' || c > '~') c = c == '\n' ? ' ' : '?';
    head.erase(head.find_last_not_of(' ') + 1);
    file.fail("has the .npy header " + head +
              "; points are (n, 3), of integers or little-endian float32 or float64: "
              "numpy.save(file, numpy.asarray(points, float).reshape(-1, 3))");
  }
  [[noreturn]] void fail_in_point(std::size_t point) const
  {
    files_[0].fail("ends in point " + std::to_string(point) + " of " + std::to_string(n_) +
                   "; it is truncated");
  }
  [[noreturn]] void fail_past_end() const
  {
    files_[0].fail("goes on behind the " + counted(static_cast<std::int64_t>(n_), "point") +
                   " of its header; it is damaged, or has several arrays: save the points alone");
  }

  std::vector<InputFile> files_;    // in Fortran order one at each of the columns x, y and z
  const NumberType *type_ = nullptr;
  std::size_t n_ = 0, done_ = 0;
  std::vector<char> raw_;
};

}    // namespace

std::unique_ptr<PointReader> open_points(const std::string &path)
{
  InputFile file(path);
  if (file.ahead(6) == "\x93NUMPY") return std::make_unique<NpyReader>(std::move(file));
  if (file.ahead(5) == "ITEM:") return std::make_unique<DumpReader>(std::move(file));
  if (file.ahead(1 << 12).find('\0') != std::string_view::npos)
    file.fail("is neither an .npy array, nor a LAMMPS text dump, nor lines of numbers");
  return std::make_unique<LinesReader>(std::move(file));
}

}    // namespace lsdcd
