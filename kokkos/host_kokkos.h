// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The Kokkos of the host: what differs between LAMMPS of 2023, 2025 and 2026, and which of
// our backends shares memory with a Kokkos device.
#pragma once

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "kokkos_base.h"
#include "kokkos_type.h"

#include "backend/threads.h"
#include "base/input_error.h"
#include "base/strided_view.h"
#include "engine/engine.h"

#include <memory>
#include <type_traits>

namespace lsdcd {

// LAMMPS packs and sorts data of fixes on the device, in a buffer whose type has had three names.
template <class>
struct SecondArgument;
template <class R, class C, class A, class B, class... More>
struct SecondArgument<R (C::*)(A, B, More...)> {
  using type = std::remove_reference_t<B>;
};
using ExchangeBuffer =
    typename SecondArgument<decltype(&LAMMPS_NS::KokkosBase::pack_exchange_kokkos)>::type;

// A view of LAMMPS as rows, of whatever layout it is.
template <class View>
auto rows_of(const View &view)
{
  using Number = std::remove_pointer_t<decltype(view.data())>;
  return StridedView<Number>(view.data(), static_cast<std::ptrdiff_t>(view.stride(0)),
                             static_cast<std::ptrdiff_t>(view.stride(1)));
}

// Are atoms in float (KOKKOS_PREC mixed or single, which LAMMPS has had since 2026)?
#if defined(LMP_KOKKOS_SINGLE_SINGLE) || defined(LMP_KOKKOS_SINGLE_DOUBLE)
constexpr bool kFloatAtoms = true;
#else
constexpr bool kFloatAtoms = false;
#endif
// And their forces? In mixed precision LAMMPS sums them in double.
#if defined(LMP_KOKKOS_SINGLE_SINGLE)
constexpr bool kFloatForces = true;
#else
constexpr bool kFloatForces = false;
#endif

template <class DeviceType>
constexpr bool kOnCpu =
    Kokkos::SpaceAccessibility<Kokkos::HostSpace,
                               typename DeviceType::execution_space::memory_space>::accessible;

// The engine whose memory is that of a Kokkos device.
template <class DeviceType>
std::unique_ptr<WallEngine> make_engine_on(EngineSettings settings)
{
  if (kFloatAtoms) settings.arrays = HostArrays::in_float;
  if (!kOnCpu<DeviceType> && settings.law().has_heat())
    throw InputError("the sub-model heat does not work for atoms on a GPU, where LAMMPS keeps no "
                     "temperature: use wall/lsdcd, or wall/lsdcd/kk/host");
  if (settings.device != Device::automatic)
    throw InputError("the keyword device has no meaning for wall/lsdcd/kk, which computes where "
                     "Kokkos has the atoms: leave it out, or use wall/lsdcd");
  using Space = typename DeviceType::execution_space;
#if defined(KOKKOS_ENABLE_CUDA)
  if constexpr (std::is_same<Space, Kokkos::Cuda>::value)
    return make_cuda_engine_in_place(settings, Space().cuda_device(), Space().cuda_stream());
  else
#endif
  {
    static_assert(
        Kokkos::SpaceAccessibility<Kokkos::HostSpace, typename Space::memory_space>::accessible,
        "wall/lsdcd/kk runs on Kokkos's host backends and on CUDA");
#if defined(KOKKOS_ENABLE_OPENMP)
    // -k on t N
    if (std::is_same<Space, Kokkos::OpenMP>::value) threads_asked_for() = true;
#endif
    return make_cpu_engine(settings);
  }
}

}    // namespace lsdcd
