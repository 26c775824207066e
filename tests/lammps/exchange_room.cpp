// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Preloaded, says before atoms go to other processes by Irregular, as fix balance sends them, how many numbers all fixes
// pack of one atom at most, and for how many there is room: the largest maxexchange of one fix.
#include "atom.h"
#include "fix.h"
#include "modify.h"
#include "pointers.h"

#include <algorithm>
#include <cstdio>
#include <dlfcn.h>
#include <vector>

using namespace LAMMPS_NS;

// Its header is in no package.
namespace LAMMPS_NS {
class Irregular : protected Pointers {
 public:
  void migrate_atoms(int sort, int known, int *to);
};
}    // namespace LAMMPS_NS

void __attribute__((visibility("default"))) Irregular::migrate_atoms(int sort, int known, int *to)
{
  int room = 0, most = 0;
  for (int k = 0; k < modify->nfix; k++) room = std::max(room, modify->fix[k]->maxexchange);
  std::vector<double> numbers(1000000);
  for (int i = 0; i < atom->nlocal; i++) {
    int packed = 0;
    for (int k = 0; k < atom->nextra_grow; k++)
      packed += modify->fix[atom->extra_grow[k]]->pack_exchange(i, &numbers[0]);
    most = std::max(most, packed);
  }
  std::fprintf(stderr, "room for %d, packed %d\n", room, most);
  using Original = void(Irregular *, int, int, int *);
  static Original *const original =
      reinterpret_cast<Original *>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS9Irregular13migrate_atomsEiiPi"));
  original(this, sort, known, to);
}
