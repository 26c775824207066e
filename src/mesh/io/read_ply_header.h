// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The header of a PLY file, which says what the file holds; private to the mesh room.
#pragma once

#include "mesh/io/text_words.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace lsdcd {

enum class PlyType : unsigned char { i8, u8, i16, u16, i32, u32, f32, f64 };

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count;    // of a list: the type of the number before its values
};

struct PlyElement {
  std::string name;
  std::uint64_t size;    // how many the file promises
  std::vector<PlyProperty> properties;
  std::string_view line;    // of the header
};

struct PlyHeader {
  enum class Format { text, little_endian, big_endian };
  Format format;
  std::vector<PlyElement> elements;
  const char *data;    // where they begin
};

// `file` is all of the file; behind its last word that was read come the data. Lines end with LF, CR LF
// or CR; the first line says which, so that data may begin with any byte.
// Throws InputError naming the file, the line, the value and the remedy.
PlyHeader read_ply_header(TextWords &file);

}    // namespace lsdcd
