// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "base/number_words.h"
#include "mesh/io/read_stl_text.h"
#include "mesh/io/whole_file.h"
#include "mesh/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace lsdcd {
namespace {

constexpr std::size_t kHeaderBytes = 84;    // 80 of text, 4 of facet count
constexpr std::size_t kFacetBytes = 50;     // normal, 3 corners, 2 bytes of attributes

// STL is little-endian and unaligned whatever the machine is.
std::uint32_t read_u32(const char *bytes)
{
  const auto *b = reinterpret_cast<const unsigned char *>(bytes);
  return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
         std::uint32_t{b[3]} << 24;
}

float read_f32(const char *bytes)
{
  const std::uint32_t bits = read_u32(bytes);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::uint64_t promised_facets(const char *bytes)
{
  return read_u32(bytes + kHeaderBytes - 4);
}

// Is there a byte near the beginning that no text has?
bool has_control_byte(const char *bytes, std::size_t size)
{
  return std::any_of(bytes, bytes + std::min<std::size_t>(size, 1024), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && !(c >= '\t' && c <= '\r') && c != 0x1a;
  });
}

// A header may say anything, even "solid", so the size decides first. A file that fits
// neither kind is damaged. It is read as the more similar kind, for the message.
bool is_binary(const char *bytes, std::size_t size)
{
  if (size >= kHeaderBytes && size - kHeaderBytes == kFacetBytes * promised_facets(bytes))
    return true;
  return !begins_as_stl_text(bytes, size) && has_control_byte(bytes, size);
}

void check_binary_size(const char *bytes, std::size_t size, const std::string &source)
{
  if (size < kHeaderBytes)
    throw InputError(source + ", facet 1: the file ends after " + std::to_string(size) +
                     " bytes, inside the header of 84 of a binary STL; it is truncated: "
                     "copy or export it again");
  const std::uint64_t promised = promised_facets(bytes);
  const std::uint64_t whole = (size - kHeaderBytes) / kFacetBytes;
  const std::string count = std::to_string(promised) + " facets promised";
  if (whole < promised)
    throw InputError(source + ", facet " + std::to_string(whole + 1) + ": the file ends after " +
                     std::to_string(size) + " bytes, with " + count + " (" +
                     std::to_string(kHeaderBytes + kFacetBytes * promised) +
                     " bytes); it is truncated or not an STL: copy or export it again");
  const std::uint64_t extra = size - kHeaderBytes - kFacetBytes * promised;
  if (extra > 0)
    throw InputError(source + ", facet " + std::to_string(promised + 1) + ": " + count +
                     " by the header, but " +
                     counted(static_cast<std::int64_t>(extra), "byte follows", "bytes follow") +
                     " them; correct the count (bytes 81 to 84) or, if it is not "
                     "an STL, export the mesh again");
}

void read_binary(const char *bytes, TriangleSoup &soup)
{
  const std::uint64_t n = promised_facets(bytes);
  soup.corners.resize(3 * n);    // the file is known to be that long
  soup.rounding.step = std::numeric_limits<float>::epsilon();
  for (std::uint64_t facet = 0; facet < n; ++facet) {
    const char *at = bytes + kHeaderBytes + kFacetBytes * facet + 12;    // past the normal
    for (int i = 0; i < 9; ++i) {
      const float value = read_f32(at + 4 * i);
      if (!std::isfinite(value))
        throw InputError(soup.source + ", facet " + std::to_string(facet + 1) + ": coordinate " +
                         "xyz"[i % 3] + " of vertex " + std::to_string(i / 3 + 1) + " is " +
                         std::to_string(value) +
                         ", not a finite number; repair or export the mesh again");
      soup.corners[3 * facet + i / 3][i % 3] = value;
    }
  }
}

// Throws if `size` bytes with this beginning can be no STL, before the rest is read.
void check_beginning(const char *bytes, std::size_t n, std::size_t size, const std::string &source)
{
  if (size - kHeaderBytes == kFacetBytes * promised_facets(bytes)) return;
  if (has_control_byte(bytes, n)) {
    if (!begins_as_stl_text(bytes, n)) check_binary_size(bytes, size, source);
  } else if (!begins_with_solid(bytes, n)) {
    TriangleSoup none;
    none.source = source;
    read_stl_text(bytes, n, none);
  }
}

// How much of a longer file is read.
std::size_t check_long_file(const char *bytes, std::size_t n, std::size_t size,
                            const std::string &source)
{
  // From a pipe: what the binary header promises, and one byte more to see that there is none.
  if (size == 0 && has_control_byte(bytes, n) && !begins_as_stl_text(bytes, n))
    return kHeaderBytes + kFacetBytes * promised_facets(bytes) + 1;
  if (size == 0 || size > n) check_beginning(bytes, n, std::max(size, n), source);
  return kAllBytes;
}

}    // namespace

TriangleSoup read_stl(const std::string &path)
{
  const FileBytes bytes = read_whole_file(path, [&](const char *beginning, auto n, auto size) {
    return check_long_file(beginning, n, size, path);
  });
  return read_stl_bytes(bytes.data.get(), bytes.size, path);
}

TriangleSoup read_stl_bytes(const char *bytes, std::size_t size, const std::string &source)
{
  TriangleSoup soup;
  soup.source = source;
  if (size == 0) throw InputError(source + ", line 1: the file is empty; export the mesh again");
  if (is_binary(bytes, size)) {
    check_binary_size(bytes, size, source);
    read_binary(bytes, soup);
  } else {
    read_stl_text(bytes, size, soup);
  }
  if (soup.corners.empty())
    throw InputError(source + ", facet 1: the file holds no facets; export the mesh again, with "
                              "its triangles");
  return soup;
}

}    // namespace lsdcd
