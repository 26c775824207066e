// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "pair/book_on.h"

template lsdcd::PairBookOn<lsdcd::CudaBackend> lsdcd::pair_book_on(const ContactLaw &);
