// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A locale whose numbers have a comma, as German ones, made here: machines of tests often have none.
#pragma once

#include "support/temp_dir.h"

#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace lsdcd {

// While it lives, the program writes 0,5. works(): does the C library take it?
class CommaLocale {
 public:
  CommaLocale()
  {
    std::filesystem::create_directory(folder_.path("comma"));
    folder_.write("comma/LC_NUMERIC", file());
    setenv("LOCPATH", folder_.path("").c_str(), 1);
    works_ = std::setlocale(LC_NUMERIC, "comma") != nullptr;
  }
  ~CommaLocale()
  {
    std::setlocale(LC_NUMERIC, "C");
    unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale &) = delete;
  CommaLocale &operator=(const CommaLocale &) = delete;

  bool works() const { return works_; }

 private:
  // As localedef of glibc writes it: a mark, the number of fields, where each begins, and these: decimal
  // point, thousands separator, grouping, both signs as wide characters, character set.
  static std::string file()
  {
    const std::string fields[] = {std::string(",\0", 2),      std::string("\0", 1),
                                  std::string("\0", 1),       std::string(",\0\0\0", 4),
                                  std::string("\0\0\0\0", 4), std::string("UTF-8\0", 6)};
    constexpr std::uint32_t kMark = 0x20031115, kFields = 6;
    std::string head, body;
    const auto add = [&](std::uint32_t x) { head.append(reinterpret_cast<const char *>(&x), 4); };
    add(kMark ^ LC_NUMERIC);
    add(kFields);
    for (const std::string &field : fields) {
      body.resize((body.size() + 3) / 4 * 4);
      add(static_cast<std::uint32_t>(4 * (2 + kFields) + body.size()));
      body += field;
    }
    return head + body;
  }

  TempDir folder_;
  bool works_ = false;
};

}    // namespace lsdcd
