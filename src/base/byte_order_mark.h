// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The mark with which some programs begin a text in UTF-8. It is no text.
#pragma once

#include <string>
#include <string_view>

namespace lsdcd {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Takes it off the first line of a file.
inline void drop_byte_order_mark(std::string &line)
{
  if (line.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0)
    line.erase(0, kByteOrderMark.size());
}

}    // namespace lsdcd
