// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace lsdcd {

// Says why a path is no file of text, as "it is a directory"; empty: it is one. A device or a pipe may have no end.
inline std::string why_no_file(const std::string &path)
{
  namespace fs = std::filesystem;
  std::error_code failed;
  switch (fs::status(path, failed).type()) {
    case fs::file_type::regular:
      return "";
    case fs::file_type::directory:
      return "it is a directory";
    case fs::file_type::fifo:
      return "it is a pipe";
    case fs::file_type::none:
    case fs::file_type::unknown:
      return failed.message();
    case fs::file_type::not_found:
      return "there is no such file";
    default:
      return "it is a device";
  }
}

}    // namespace lsdcd
