// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds how deep a grain that is no sphere is in a mesh along the way from one of its contacts to another, on a CPU.
#pragma once

#include "contact/shape_search.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsdcd {

// A contact as an end of a pass.
struct PassEnd {
  FeatureCode feature;
  Real overlap;
  Vec3 normal, point;    // of the grain's surface, in its frame; the normal is unit, outwards
};

// Finds passes. The pass of two contacts is a largest least overlap: among all chains of faces that are joined at edges, from a face of
// one contact to a face of the other, the chain counts whose crossed edges have the largest least overlap. The overlap of an edge is the
// largest one on it.
class ShapePasses {
 public:
  explicit ShapePasses(const TriangleTree &tree) : view_(tree.view()) {}

  // Begins with another grain, and takes all of its contacts with the mesh.
  void begin(const PlacedGrain &grain, const std::vector<PassEnd> &contacts);
  // Returns the pass of contact `from` and each other contact if it is deeper than `above` >= 0, else 0. The result is valid until the
  // next call.
  const std::vector<Real> &find(std::size_t from, Real above);

 private:
  // Values by key, all of which can be forgotten at once.
  template <class Value>
  class Notes {
   public:
    void clear() { age_++, n_ = 0; }
    // Returns the value of a key, and whether it is new; a new value is undefined.
    Value &at(std::uint32_t key, bool &is_new)
    {
      if (2 * (n_ + 1) > slots_.size()) grow();
      Slot &slot = find(slots_, key);
      is_new = slot.age != age_;
      if (is_new) slot.age = age_, slot.key = key, n_++;
      return slot.value;
    }

   private:
    struct Slot {
      std::uint64_t age = 0;
      std::uint32_t key = 0;
      Value value = {};
    };
    Slot &find(std::vector<Slot> &in, std::uint32_t key)
    {
      const std::size_t mask = in.size() - 1;    // of a power of two
      std::size_t i = key * std::size_t(0x9e3779b1u) & mask;
      while (in[i].age == age_ && in[i].key != key) i = (i + 1) & mask;
      return in[i];
    }
    void grow()
    {
      std::vector<Slot> more(slots_.empty() ? 64 : 2 * slots_.size());
      for (const Slot &slot : slots_)
        if (slot.age == age_) find(more, slot.key) = slot;
      slots_ = std::move(more);
    }

    std::vector<Slot> slots_;
    std::uint64_t age_ = 1;
    std::size_t n_ = 0;
  };
  struct Crossing {
    Real overlap;
    std::uint32_t edge;
  };
  struct EdgeOverlap {
    Real overlap;    // undefined if it is not above the next number
    Real above;
  };
  struct FaceOfContact {
    std::uint32_t face;
    std::size_t contact;
  };

  struct Tangent {
    Vec3 normal;
    Real height;    // of the plane, over the centre
  };

  void list_faces();
  void reach(std::uint32_t face, Real pass, Real above);
  Real overlap_of(std::uint32_t edge, Real above);
  Real compute_overlap(std::uint32_t edge, Real above) const;

  const TreeView &view_;
  PlacedGrain grain_;
  std::vector<PassEnd> contacts_;
  std::vector<Tangent> tangents_;    // of the contacts, and one between two of them
  Notes<EdgeOverlap> overlap_;       // of edges
  Notes<char> reached_;              // faces
  std::vector<Crossing> waiting_;    // a heap
  std::vector<FaceOfContact> faces_;
  std::vector<Real> pass_;
};

}    // namespace lsdcd
