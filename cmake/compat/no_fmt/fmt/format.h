// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// LAMMPS's headers name types of the fmt it was built with; some packages ship
// those headers without it. Declaring the types is enough for code that passes
// every message as std::string: no formatting function is ever called from here.
#pragma once

#include <string>

namespace fmt {
inline namespace v7_lmp {
template <typename Char>
class basic_string_view;
using string_view = basic_string_view<char>;
class format_args;
template <typename... Args, typename S>
format_args make_args_checked(const S &, const Args &...);
}    // namespace v7_lmp
}    // namespace fmt
