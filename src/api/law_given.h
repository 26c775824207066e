// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A caller's lsdcd_law as a ContactLaw, by the rows of law/sub_models.h.
#pragma once

#include "api/lsdcd.h"
#include "law/contact_law.h"

#include <string>

namespace lsdcd {

struct NamedLaw {
  ContactLaw law;
  std::string name;    // for the log: its style; else its sub-models with their numbers
};

// `field`: what holds the pointer, for errors: "meshes[1].law". Throws ApiError.
NamedLaw law_of(const lsdcd_law *given, const std::string &field);

}    // namespace lsdcd
