// A compiled contact law behind two pointers, so that engines are compiled once and laws
// add only the loop over spheres.
#pragma once

#include "contact/spring_store.h"
#include "engine/wall_force.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

namespace lsdcd {

// Places for contacts in the kernel: enough for nearly every sphere, and the
// sizes at which a sphere with more is done again.
constexpr int kPlaces = 8;
constexpr int kMorePlaces = 64;
constexpr int kMostPlaces = 512;

// What engines have to store and move for a law.
struct LawTraits {
  bool history, heat, records;
  int n_extra;
};

template <class Law>
LawTraits traits_of()
{
  return {Law::kHistory, Law::kHeat, Law::kRecords, Law::kExtra};
}

// The parameters of any law, as bytes.
class LawBytes {
 public:
  template <class Law>
  explicit LawBytes(const Law &law)
  {
    static_assert(std::is_trivially_copyable<Law>::value && sizeof(Law) <= sizeof bytes_,
                  "laws are plain numbers");
    ::new (bytes_) Law(law);
  }
  template <class Law>
  const Law &as() const
  {
    return *std::launder(reinterpret_cast<const Law *>(bytes_));
  }

 private:
  alignas(std::max_align_t) unsigned char bytes_[256];
};

// The work of a step on the host. Results, springs and the rest of sphere near[k] are at
// k, kPlaces places each for springs.
struct HostJob {
  const GridView *grid;
  ForceSettings settings;
  const Spheres *spheres;
  const SpringStore *springs;
  const int *near;
  SphereResult *result;
  SphereSink sink;    // of the first sphere
};

// The wall's effects that the settings ask for.
inline WallEffects wall_effects(const EngineSettings &s)
{
  return {s.surface.moves(), s.records};
}

struct HostLaw {
  LawTraits traits;
  LawBytes law;
  void (*run)(const LawBytes &, const HostJob &, std::size_t n);
  // Sphere k once more, with more places for its contacts. False: still not enough.
  bool (*redo)(const LawBytes &, const HostJob &, std::size_t k, const SphereSink &);
};

// The law that the settings ask for.
HostLaw host_law(const EngineSettings &settings);

// Those of `granular`, one function per normal sub-model: a source file each.
HostLaw host_hooke_law(const EngineSettings &);
HostLaw host_hertz_law(const EngineSettings &);
HostLaw host_dmt_law(const EngineSettings &);
HostLaw host_jkr_law(const EngineSettings &);

// Those of the classic styles with effects of LIGGGHTS, and on walls with effects.
HostLaw host_added_law(const EngineSettings &);
HostLaw host_on_wall_law(const EngineSettings &);

}    // namespace lsdcd
