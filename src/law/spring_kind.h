// What the numbers that a contact law keeps for each contact are.
#pragma once

#include "law/contact_law.h"

namespace lsdcd {

// Laws with the same kind can go on from each other's springs. It is in restart files: a kind keeps
// its number.
int spring_kind(const ContactLaw &law);

}    // namespace lsdcd
