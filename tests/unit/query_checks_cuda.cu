// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Queries checked on a GPU.
#include "support/query_checks.h"

#include "backend/backend_cuda.h"

namespace lsdcd {

std::unique_ptr<QueryChecks> query_checks_on_cuda(const Bins &bins, const QueryCheckSettings &s)
{
  return std::make_unique<QueryChecksOn<CudaBackend>>(bins, s);
}

}    // namespace lsdcd
