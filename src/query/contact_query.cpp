// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/contact_query.h"

#include "backend/threads.h"
#include "base/input_error.h"
#include "contact/corner.h"
#include "contact/find_contacts.h"
#include "query/radius_error.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>

namespace lsdcd {
namespace {

// Contacts of one sphere at a time. False where there are more than kMost.
template <int kMost>
class SphereSearch {
 public:
  bool find(const GridView &grid, const Vec3 &q, Real radius, std::vector<SphereContact> &found)
  {
    set_.clear();
    find_contacts(grid, q, radius, set_);
    if (set_.overflow) return false;
    set_.sort();
    rule_.solve(set_, radius, weight_, MeshGeometry::tolerance(grid));
    for (int i = 0; i < set_.n; i++)
      found.push_back({set_.feature[i], q - set_.distance[i] * set_.normal[i], set_.normal[i],
                       set_.distance[i], radius - set_.distance[i], weight_[i]});
    return true;
  }

 private:
  ContactSet<kMost> set_;
  CornerRule<kMost> rule_;
  Real weight_[kMost];
};

constexpr int kFew = 32;
constexpr std::size_t kSpheresAtATime = 1024;    // spheres

template <class T>
class ContactQuery {
 public:
  ContactQuery(const GridView &grid, const SphereView<T> &spheres) : grid_(grid), spheres_(spheres)
  {
  }

  SphereContacts run()
  {
    const std::size_t n = spheres_.n, n_chunks = (n + kSpheresAtATime - 1) / kSpheresAtATime;
    out_.first.resize(n + 1);
    chunks_.resize(n_chunks);
    std::exception_ptr error;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads()) if (n_chunks > 1)
    for (std::int64_t c = 0; c < static_cast<std::int64_t>(n_chunks); c++) {
      try {
        find_chunk(static_cast<std::size_t>(c));
      } catch (...) {
#pragma omp critical(lsdcd_contact_query)
        if (!error) error = std::current_exception();
      }
    }
    if (error) std::rethrow_exception(error);
    for (std::size_t i = 0; i < n; i++) out_.first[i + 1] += out_.first[i];
    out_.found.reserve(out_.first[n]);
    for (std::vector<SphereContact> &chunk : chunks_) {
      out_.found.insert(out_.found.end(), chunk.begin(), chunk.end());
      chunk = {};
    }
    return std::move(out_);
  }

 private:
  void find_chunk(std::size_t c)
  {
    SphereSearch<kFew> few;
    std::unique_ptr<SphereSearch<kMaxContacts>> many;    // more than a stack may have room for
    std::vector<SphereContact> &found = chunks_[c];
    for (std::size_t i = c * kSpheresAtATime; i < std::min(spheres_.n, (c + 1) * kSpheresAtATime);
         i++) {
      const std::size_t before = found.size();
      const std::size_t sphere = spheres_.from + i;
      const Real radius = radius_of(sphere);
      const Vec3 q = spheres_.centres[sphere];
      if (!few.find(grid_, q, radius, found)) {
        if (!many) many = std::make_unique<SphereSearch<kMaxContacts>>();
        if (!many->find(grid_, q, radius, found))
          throw InputError("sphere " + std::to_string(sphere) + " touches the wall in more than " +
                           std::to_string(kMaxContacts) +
                           " separate places: use a smaller radius, or a coarser mesh");
      }
      out_.first[i + 1] = found.size() - before;
    }
  }

  Real radius_of(std::size_t i) const
  {
    if (!spheres_.radii.at) return spheres_.radius;
    // Compared in the caller's type, as the cutoff of the caller may be a rounded one.
    const T radius = spheres_.radii[i], most = static_cast<T>(grid_.cutoff);
    if (!(radius >= 0 && radius <= most)) throw_bad_radius("sphere", i, radius, most);
    return std::min(static_cast<Real>(radius), grid_.cutoff);
  }

  const GridView &grid_;
  const SphereView<T> &spheres_;
  std::vector<std::vector<SphereContact>> chunks_;
  SphereContacts out_;
};

}    // namespace

template <class T>
SphereContacts find_all_contacts(const GridView &grid, const SphereView<T> &spheres)
{
  return ContactQuery<T>(grid, spheres).run();
}
template SphereContacts find_all_contacts(const GridView &, const SphereView<float> &);
template SphereContacts find_all_contacts(const GridView &, const SphereView<double> &);

}    // namespace lsdcd
