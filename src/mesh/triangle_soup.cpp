// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/triangle_soup.h"

#include <limits>

namespace lsdcd {

FileRounding known_rounding(const TriangleSoup &soup)
{
  FileRounding rounding = soup.rounding;
  if (!(rounding.step > 0)) rounding.step = std::numeric_limits<Real>::epsilon();
  return rounding;
}

}    // namespace lsdcd
