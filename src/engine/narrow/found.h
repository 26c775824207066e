// Contacts of the spheres near the wall that kernels of their own have found ahead of the
// law, so that its kernel holds no search.
#pragma once

#include "contact/contact_set.h"

namespace lsdcd {

// Two lists of near spheres: with one contact, and with several or what may be several.
enum FoundList { kNoList = -1, kSingle = 0, kSeveral = 1 };
constexpr int kFoundLists = 2;

struct FoundCounts {
  int listed[kFoundLists];
  unsigned several_ended;    // see FindSeveral::ended()
};

struct ContactArrays {
  FeatureCode *feature;
  Vec3 *normal;
  Real *distance;

  LSDCD_FN ContactsView view(std::size_t first, int n) const
  {
    return {n, feature + first, normal + first, distance + first};
  }
  template <int kPlaces>
  LSDCD_FN void put(std::size_t to, const ContactSet<kPlaces> &set, int i) const
  {
    feature[to] = set.feature[i];
    normal[to] = set.normal[i];
    distance[to] = set.distance[i];
  }
};

// Single contacts with all that the law reads of where they are: neighbours in the list are
// neighbours in memory.
struct SingleContacts {
  int *sphere = nullptr;    // not its number among the near ones
  FeatureCode *feature = nullptr;
  Rows<Real> x, normal;
  Column<Real> radius, distance;
};

struct Found {
  FoundCounts *counts = nullptr;         // of this step
  FoundCounts *next_counts = nullptr;    // of the next one, cleared in this
  int n_near = 0;
  bool just_now = false;    // nothing comes between the search and the law
  SingleContacts single = {};
  int *several_near = nullptr;    // near sphere of each that is listed as having several
  ContactArrays several = {};     // kPlaces places each
  Real *weight = nullptr;         // of several; that of a single one is 1
  // Of several: how many contacts; kOverflow: they do not fit; below that: they are found
  // with the crowded ones, see crowded_as().
  int *n = nullptr;

  // Results of a step in place lie in the order of the lists: those of single contacts from
  // the first place on, those of several from the last one down.
  LSDCD_FN int result_of_several(std::size_t s) const { return n_near - 1 - static_cast<int>(s); }
};

}    // namespace lsdcd
