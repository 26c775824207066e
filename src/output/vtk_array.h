// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Parts of a file of VTK's XML format for polygons and lines (.vtp).
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace lsdcd {

// Before and behind the one piece.
constexpr const char *kVtkHead =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\">\n<PolyData>\n";
constexpr const char *kVtkEnd = "</Piece>\n</PolyData>\n</VTKFile>\n";

inline std::string base64(const std::vector<unsigned char> &bytes)
{
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = bytes.size() - i;
    const std::uint32_t three = std::uint32_t(bytes[i]) << 16 |
                                (n > 1 ? std::uint32_t(bytes[i + 1]) << 8 : 0) |
                                (n > 2 ? std::uint32_t(bytes[i + 2]) : 0);
    text += letters[three >> 18];
    text += letters[three >> 12 & 63];
    text += n > 1 ? letters[three >> 6 & 63] : '=';
    text += n > 2 ? letters[three & 63] : '=';
  }
  return text;
}

// Returns an array as VTK's "binary": the number of bytes in 64 bits, then the values.
template <class T>
std::string data_array(const char *type, const std::string &name, const std::vector<T> &values,
                       const std::string &more = "")
{
  const std::uint64_t n_bytes = values.size() * sizeof(T);
  std::vector<unsigned char> bytes(sizeof n_bytes + n_bytes);
  std::memcpy(bytes.data(), &n_bytes, sizeof n_bytes);
  if (n_bytes > 0) std::memcpy(bytes.data() + sizeof n_bytes, values.data(), n_bytes);
  return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\"" + more +
         " format=\"binary\">" + base64(bytes) + "</DataArray>\n";
}

}    // namespace lsdcd
