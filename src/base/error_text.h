// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The text of an exception.
#pragma once

#include <exception>
#include <new>
#include <string>

namespace lsdcd {

// Runs `work`. Returns what it throws as a text; empty: it threw nothing.
template <class Work>
std::string error_of(Work &&work)
{
  try {
    work();
    return "";
  } catch (const std::bad_alloc &) {
    return "out of memory";
  } catch (const std::exception &e) {
    return *e.what() ? e.what() : "unknown error";
  }
}

}    // namespace lsdcd
