// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "api/c_border.h"

#include "base/version.h"

namespace {
std::string &last_error() noexcept
{
  static thread_local std::string text;
  return text;
}
}    // namespace

namespace lsdcd {

int store_error(int code, const char *text) noexcept
{
  try {
    last_error() = text;
  } catch (...) {
    last_error().clear();
  }
  return code;
}

}    // namespace lsdcd

extern "C" {

const char *lsdcd_version(void)
{
  return lsdcd::version();
}

const char *lsdcd_error_name(int code)
{
  switch (code) {
    case LSDCD_OK:
      return "ok";
    case LSDCD_ERROR_ARGUMENT:
      return "argument";
    case LSDCD_ERROR_INPUT:
      return "input";
    case LSDCD_ERROR_CUTOFF:
      return "cutoff";
    case LSDCD_ERROR_SIDE:
      return "side";
    case LSDCD_ERROR_DEVICE:
      return "device";
    case LSDCD_ERROR_MEMORY:
      return "memory";
    case LSDCD_ERROR_INTERNAL:
      return "internal";
    case LSDCD_ERROR_CANCELLED:
      return "cancelled";
  }
  return "unknown";
}

const char *lsdcd_last_error(void)
{
  return last_error().c_str();
}

}    // extern "C"
