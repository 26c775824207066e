// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/io/read_ply_header.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace lsdcd {
namespace {

// Both names of each PlyType.
const char *const kTypeNames[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                     {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                     {"float", "float32"}, {"double", "float64"}};

class HeaderReader {
 public:
  explicit HeaderReader(TextWords &file) : file_(file) {}

  PlyHeader read()
  {
    file_.refuse_utf16();
    next_line();
    if (line() != "ply")
      file_.fail(words_[0], quoted(words_[0]) + " found where 'ply' is expected",
                 "this is not a PLY file: export the mesh as PLY");
    // Does a CR alone end the lines?
    const char *at = file_.here().data(), *const end = file_.end();
    const bool cr = at != end && *at == '\r' && (at + 1 == end || at[1] != '\n');

    std::optional<PlyHeader::Format> format;
    for (next_line(); words_[0] != "end_header"; next_line()) {
      if (words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "format" && !format)
        format = read_format();
      else if (words_[0] == "element")
        read_element();
      else if (words_[0] == "property" && !header_.elements.empty())
        read_property();
      else
        fail(quoted(words_[0]) + " found where 'element', 'property' or 'end_header' is expected",
             "correct the line, begin it with 'comment', or export the mesh again");
    }
    if (!format)
      fail("the header has no line 'format', which says whether the data are text or binary",
           "export the mesh again, or write 'format ascii 1.0' as line 2 if they are text");
    header_.format = *format;
    header_.data = std::find(file_.here().data(), end, cr ? '\r' : '\n');
    if (header_.data != end) ++header_.data;
    return std::move(header_);
  }

 private:
  static constexpr const char *kCorrect = "correct the line or export the mesh again";

  // The words of the next line that has some.
  void next_line()
  {
    words_ = {file_.next_word()};
    if (words_[0].empty())
      fail("the file ends inside the header, without 'end_header'",
           "it is truncated: copy or export it again");
    for (auto word = file_.word_in_line(); !word.empty(); word = file_.word_in_line())
      words_.push_back(word);
  }

  std::string_view line() const
  {
    return {words_[0].data(), static_cast<std::size_t>(words_.back().end() - words_[0].begin())};
  }

  PlyHeader::Format read_format() const
  {
    if (words_.size() == 3 && words_[2] == "1.0") {
      if (words_[1] == "ascii") return PlyHeader::Format::text;
      if (words_[1] == "binary_little_endian") return PlyHeader::Format::little_endian;
      if (words_[1] == "binary_big_endian") return PlyHeader::Format::big_endian;
    }
    fail(quoted(line()) + " is not 'format ascii 1.0', 'format binary_little_endian 1.0' or "
                          "'format binary_big_endian 1.0'",
         "export the mesh in one of these formats");
  }

  void read_element()
  {
    PlyElement element{"", 0, {}, line()};
    const auto count = words_.back();
    const auto read = std::from_chars(count.begin(), count.end(), element.size);
    if (words_.size() != 3 || read.ec != std::errc() || read.ptr != count.end())
      fail(quoted(line()) + " is not 'element', a name and a count", kCorrect);
    element.name = words_[1];
    for (const PlyElement &other : header_.elements)
      if (other.name == element.name)
        fail("the header has element " + quoted(element.name) + " twice",
             "export the mesh again, with each element once");
    header_.elements.push_back(std::move(element));
  }

  void read_property()
  {
    PlyProperty property;
    const bool is_list = words_.size() > 1 && words_[1] == "list";
    if (words_.size() != (is_list ? 5 : 3))
      fail(quoted(line()) + " is not 'property' or 'property list', types and a name", kCorrect);
    if (is_list) property.count = type_of(words_[2]);
    property.type = type_of(words_[words_.size() - 2]);
    property.name = words_.back();
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type_of(std::string_view name) const
  {
    std::string all;
    for (std::size_t i = 0; i < std::size(kTypeNames); ++i)
      for (const char *known : kTypeNames[i]) {
        if (name == known) return static_cast<PlyType>(i);
        all += (all.empty() ? "" : ", ") + std::string(known);
      }
    fail("the type of a property is " + quoted(name) + ", not one of " + all, kCorrect);
  }

  [[noreturn]] void fail(const std::string &what, const char *remedy) const
  {
    file_.fail(words_[0], what,
               file_.done() ? "the file is truncated: copy or export it again" : remedy);
  }

  TextWords &file_;
  std::vector<std::string_view> words_;    // of the line that is read
  PlyHeader header_{};
};

}    // namespace

PlyHeader read_ply_header(TextWords &file)
{
  return HeaderReader(file).read();
}

}    // namespace lsdcd
