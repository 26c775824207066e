// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Words of a script about a servo.
#pragma once

#include "base/input_words.h"
#include "input/settings.h"

#include <string>
#include <vector>

namespace lsdcd {

extern const char *const kServoSyntax;    // what may follow the word servo

// Reads what follows the keyword. Throws InputError.
void read_servo(Tokens &w, MeshSettings &s);

// `fix_modify ID servo ...`, or `servo none`. `taken`: how many words that is.
struct ModifiedServo {
  Servo servo;         // not present: none
  std::string text;    // as a log shows it
  std::size_t taken = 0;
};
ModifiedServo read_modified_servo(const std::vector<std::string> &tokens);

}    // namespace lsdcd
