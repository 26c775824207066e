// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/version.h"

namespace lsdcd {

const char *version()
{
  return LSDCD_VERSION;
}

}    // namespace lsdcd
