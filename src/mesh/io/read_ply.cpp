// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// PLY, text and binary: polygons, and triangle strips as the files of 3D scanners have. Elements and
// properties that are no part of a surface are passed over.
#include "base/input_error.h"
#include "base/number_words.h"
#include "mesh/io/cut_polygon.h"
#include "mesh/io/read_mesh.h"
#include "mesh/io/read_ply_header.h"
#include "mesh/io/whole_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lsdcd {
namespace {

constexpr const char *kCutRemedy = "it is truncated: copy or export it again";
constexpr const char *kCorrect = "correct it or export the mesh again";

std::string promise(const PlyElement &element)
{
  return "with " + quoted(element.line) + " promised by the header";
}

// The values of an element, one after another. Each has to be on a line of its own, as the programs
// that defined PLY read it: so a value too few or too many is found where it is.
class TextValues {
 public:
  TextValues(const TextWords &behind_header) : file_(behind_header) {}

  std::size_t bytes_left() const { return file_.end() - file_.here().data(); }

  void begin(const PlyElement &element, std::uint64_t number)
  {
    element_ = &element;
    number_ = number;
    first_word_ = {};
  }

  double number(const PlyProperty &property, PlyType)
  {
    const auto word = next_word();
    const ReadNumber number = read_number(word);
    if (number.problem)
      fail("the value of " + quoted(property.name) + " is " + quoted(word) + ", " + number.problem,
           number.remedy);
    return number.value;
  }

  void skip(PlyType, std::uint64_t count)
  {
    for (; count > 0; --count) next_word();
  }

  void end_of_element()
  {
    if (const auto word = file_.word_in_line(); !word.empty())
      fail(quoted(word) + " follows all values that the line should have",
           "correct the line or the header, or export the mesh again");
  }

  void end_of_file()
  {
    if (const auto word = file_.next_word(); !word.empty())
      file_.fail(word, quoted(word) + " follows the last element that the header promises",
                 "correct the counts of the header or export the mesh again");
  }

  [[noreturn]] void fail(const std::string &what, const std::string &remedy) const
  {
    file_.fail(first_word_.empty() ? file_.here() : first_word_, what, remedy,
               element_->name + ' ' + std::to_string(number_ + 1));
  }

 private:
  std::string_view next_word()
  {
    const bool is_first = first_word_.empty();
    const auto word = is_first ? file_.next_word() : file_.word_in_line();
    if (is_first) first_word_ = word;
    if (word.empty() && file_.done()) fail("the file ends, " + promise(*element_), kCutRemedy);
    if (word.empty()) fail("the line ends before it has all values that it should have", kCorrect);
    return word;
  }

  TextWords file_;
  const PlyElement *element_ = nullptr;
  std::uint64_t number_ = 0;       // of the element, from 0
  std::string_view first_word_;    // of it
};

template <bool kBigEndian>
class BinaryValues {
 public:
  BinaryValues(const char *bytes, std::size_t size, const char *data, const std::string &source) :
      begin_(bytes), at_(data), end_(bytes + size), source_(source)
  {
  }

  std::size_t bytes_left() const { return end_ - at_; }

  void begin(const PlyElement &element, std::uint64_t number)
  {
    element_ = &element;
    number_ = number;
    element_at_ = at_;
  }

  double number(const PlyProperty &, PlyType type)
  {
    const char *at = at_;
    skip(type, 1);
    switch (type) {
      case PlyType::i8:
        return load<std::int8_t>(at);
      case PlyType::u8:
        return load<std::uint8_t>(at);
      case PlyType::i16:
        return load<std::int16_t>(at);
      case PlyType::u16:
        return load<std::uint16_t>(at);
      case PlyType::i32:
        return load<std::int32_t>(at);
      case PlyType::u32:
        return load<std::uint32_t>(at);
      case PlyType::f32:
        return load<float>(at);
      case PlyType::f64:
        break;
    }
    return load<double>(at);
  }

  void skip(PlyType type, std::uint64_t count)
  {
    constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t bytes = kBytes[static_cast<std::size_t>(type)];
    if (count > bytes_left() / bytes)
      fail("the file ends inside it, " + promise(*element_), kCutRemedy);
    at_ += bytes * count;
  }

  void end_of_element() {}

  void end_of_file()
  {
    if (at_ != end_)
      throw InputError(source_ + ", byte " + std::to_string(at_ - begin_ + 1) + ": " +
                       counted(bytes_left(), "byte follows", "bytes follow") +
                       " the last element that the header promises; copy or export "
                       "the file again");
  }

  [[noreturn]] void fail(const std::string &what, const std::string &remedy) const
  {
    throw InputError(source_ + ", byte " + std::to_string(element_at_ - begin_ + 1) + " (" +
                     element_->name + ' ' + std::to_string(number_ + 1) + "): " + what + "; " +
                     remedy);
  }

 private:
  template <class Number>
  static Number load(const char *at)
  {
    std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t> bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      const std::size_t power = kBigEndian ? sizeof(Number) - 1 - i : i;
      bits |= decltype(bits){static_cast<unsigned char>(at[i])} << 8 * power;
    }
    if constexpr (std::is_integral_v<Number>) {
      return static_cast<Number>(bits);
    } else {
      Number value;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
  }

  const char *begin_, *at_, *end_, *element_at_ = nullptr;
  std::string source_;
  const PlyElement *element_ = nullptr;
  std::uint64_t number_ = 0;    // of the element, from 0
};

template <class Values>
class PlyReader {
 public:
  PlyReader(const PlyHeader &header, const TextWords &file, const Values &values,
            const std::string &source) :
      header_(header),
      file_(file), values_(values)
  {
    read_.soup.source = source;
  }

  ReadMesh read()
  {
    std::vector<std::pair<const PlyElement *, Values>> before;    // faces before the vertices
    bool has_vertices = false;
    for (const PlyElement &element : header_.elements) {
      const bool has_facets = element.name == "face" || element.name == "tristrips";
      if (element.name == "vertex") {
        read_vertices(element);
        has_vertices = true;
      } else if (has_facets && has_vertices) {
        read_facets(element);
      } else {
        if (has_facets) before.emplace_back(&element, values_);
        for_each(element, [&] { skip(element, 0, element.properties.size()); });
      }
      if (element.name == "edge") read_.left_out += element.size;
    }
    values_.end_of_file();
    for (const auto &[element, values] : before) {
      values_ = values;
      read_facets(*element);
    }
    read_.vertices = std::move(vertices_);
    return std::move(read_);
  }

 private:
  // Calls f for each, to read all its values. An element without properties takes no room in a file.
  template <class F>
  void for_each(const PlyElement &element, F f)
  {
    if (element.properties.empty()) return;
    for (std::uint64_t number = 0; number < element.size; ++number) {
      values_.begin(element, number);
      f();
      values_.end_of_element();
    }
  }

  // The values of the properties from `first` up to `end`.
  void skip(const PlyElement &element, std::size_t first, std::size_t end)
  {
    for (; first < end; ++first) {
      const PlyProperty &property = element.properties[first];
      values_.skip(property.type, property.count ? list_size(property) : 1);
    }
  }

  // The number of values of a list, which come next.
  std::uint64_t list_size(const PlyProperty &list)
  {
    const double size = values_.number(list, *list.count);
    if (!(size >= 0 && size <= 4294967295. && size == std::floor(size)))
      values_.fail("the list " + quoted(list.name) + " begins with " + exact_text(size) +
                       ", which should be the number of its values",
                   kCorrect);
    return static_cast<std::uint64_t>(size);
  }

  // The index of the one property with one of these names.
  std::size_t find(const PlyElement &element, std::initializer_list<std::string_view> names,
                   bool is_list, const std::string &what)
  {
    const auto &all = element.properties;
    std::size_t found = all.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::find(names.begin(), names.end(), all[i].name) == names.end()) continue;
      if (found != all.size())
        file_.fail(element.line,
                   "element " + quoted(element.name) + " has the properties " +
                       quoted(all[found].name) + " and " + quoted(all[i].name) +
                       ", which mean the same",
                   "export the mesh again, with one of them");
      found = i;
    }
    if (found == all.size() || all[found].count.has_value() != is_list)
      file_.fail(element.line, "element " + quoted(element.name) + " has no " + what,
                 "export the mesh again, with it");
    return found;
  }

  void read_vertices(const PlyElement &element)
  {
    std::vector<int> axis_of(element.properties.size(), -1);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      axis_of[find(element, {name}, false, "property '" + name + "' that is one number")] = axis;
    }
    vertices_.reserve(std::min<std::uint64_t>(element.size, values_.bytes_left() / 3));
    for_each(element, [&] {
      Vec3 x;
      for (std::size_t i = 0; i < axis_of.size(); ++i) {
        if (axis_of[i] < 0) {
          skip(element, i, i + 1);
          continue;
        }
        const PlyProperty &property = element.properties[i];
        const double value = x[axis_of[i]] = values_.number(property, property.type);
        if (!std::isfinite(value))
          values_.fail("the value of " + quoted(property.name) + " is " + exact_text(value) +
                           ", not a finite number",
                       kCorrect);
      }
      vertices_.push_back(x);
    });
  }

  void read_facets(const PlyElement &element)
  {
    if (element.size == 0) return;
    const std::size_t at = find(element, {"vertex_indices", "vertex_index"}, true,
                                "list 'vertex_indices' or 'vertex_index'");
    const PlyProperty &list = element.properties[at];
    const bool are_strips = element.name == "tristrips";
    read_.soup.corners.reserve(read_.soup.corners.size() +
                               3 * std::min<std::uint64_t>(element.size, values_.bytes_left() / 8));
    for_each(element, [&] {
      skip(element, 0, at);
      corners_.clear();
      for (std::uint64_t size = list_size(list); size > 0; --size) {
        const double index = values_.number(list, list.type);
        if (are_strips && index == -1)
          end_strip();    // another begins
        else
          corners_.push_back(vertex(index));
      }
      if (are_strips)
        end_strip();
      else
        end_face();
      skip(element, at + 1, element.properties.size());
    });
  }

  std::size_t vertex(double index) const
  {
    if (!(index >= 0 && index < static_cast<double>(vertices_.size()) &&
          index == std::floor(index)))
      values_.fail("a corner is vertex " + exact_text(index) + ", but the file has " +
                       std::to_string(vertices_.size()) + ", counted from 0",
                   kCorrect);
    return static_cast<std::size_t>(index);
  }

  void end_face()
  {
    const std::size_t n = corners_.size();
    if (n == 0) values_.fail("the face has no corners", "remove it or export the mesh again");
    if (n < 3) ++read_.left_out;    // a point or a line
    if (n == 3) add(corners_[0], corners_[1], corners_[2]);
    if (n <= 3) return;
    polygon_.clear();
    for (const std::size_t v : corners_) polygon_.push_back(vertices_[v]);
    if (const std::string why = cutter_.cut(polygon_, read_.soup.corners); !why.empty())
      values_.fail("the face of " + std::to_string(n) +
                       " corners cannot be cut into triangles: " + why,
                   kTriangulate);
  }

  // Each corner makes a triangle with the two before it, every other one wound the other way round. A
  // corner given twice leads from one part of a strip to the next.
  void end_strip()
  {
    const std::size_t n = corners_.size();
    if (n == 1 || n == 2) ++read_.left_out;
    for (std::size_t i = 2; i < n; ++i) {
      const std::size_t a = corners_[i - 2], b = corners_[i - 1], c = corners_[i];
      if (a == b || b == c || c == a) continue;
      if (i % 2 == 0)
        add(a, b, c);
      else
        add(b, a, c);
    }
    corners_.clear();
  }

  void add(std::size_t a, std::size_t b, std::size_t c)
  {
    for (const std::size_t v : {a, b, c}) read_.soup.corners.push_back(vertices_[v]);
  }

  const PlyHeader &header_;
  const TextWords &file_;
  Values values_;
  ReadMesh read_;
  std::vector<Vec3> vertices_, polygon_;
  PolygonCutter cutter_;
  std::vector<std::size_t> corners_;    // vertices of the face or strip that is read
};

}    // namespace

ReadMesh read_ply_bytes(const char *bytes, std::size_t size, const std::string &source)
{
  if (size == 0) throw InputError(source + ", line 1: the file is empty; export the mesh again");
  TextWords file(bytes, size, source);
  const PlyHeader header = read_ply_header(file);
  const auto read_values = [&](const auto &values) {
    return PlyReader(header, file, values, source).read();
  };
  const auto read_data = [&] {
    switch (header.format) {
      case PlyHeader::Format::text:
        return read_values(TextValues(file));
      case PlyHeader::Format::big_endian:
        return read_values(BinaryValues<true>(bytes, size, header.data, source));
      case PlyHeader::Format::little_endian:
        break;
    }
    return read_values(BinaryValues<false>(bytes, size, header.data, source));
  };
  ReadMesh read = read_data();
  if (read.soup.corners.empty()) {
    std::string all;
    for (const PlyElement &element : header.elements)
      all += (all.empty() ? "" : ", ") + quoted(element.line);
    throw InputError(source + ": the file has no facets; its header promises " + all +
                     "; export the mesh again, with its triangles");
  }
  return read;
}

ReadMesh read_ply(const std::string &path)
{
  const auto check = [&](const char *beginning, std::size_t n, std::size_t) {
    if (TextWords(beginning, n, path).next_word() != "ply") read_ply_bytes(beginning, n, path);
    return kAllBytes;
  };
  const FileBytes bytes = read_whole_file(path, check);
  return read_ply_bytes(bytes.data.get(), bytes.size, path);
}

}    // namespace lsdcd
