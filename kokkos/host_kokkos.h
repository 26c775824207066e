// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Kokkos as the host has it: what differs between LAMMPS of 2023, 2025 and 2026, and which of our backends shares memory with a Kokkos
// device.
#pragma once

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "atom_vec_kokkos.h"
#include "error.h"
#include "fix.h"
#include "kokkos.h"
#include "kokkos_base.h"
#include "kokkos_type.h"

#include "backend/owned_array.h"
#include "backend/threads.h"
#include "base/input_error.h"
#include "base/strided_view.h"
#include "engine/engine.h"
#include "pair/pair_engine.h"

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lsdcd {

// The type of the buffer in which LAMMPS packs and sorts data of fixes on the device. It has had three names.
template <class>
struct SecondArgument;
template <class R, class C, class A, class B, class... More>
struct SecondArgument<R (C::*)(A, B, More...)> {
  using type = std::remove_reference_t<B>;
};
using ExchangeBuffer =
    typename SecondArgument<decltype(&LAMMPS_NS::KokkosBase::pack_exchange_kokkos)>::type;

// Packs atoms that leave, and moves others to their places. LAMMPS of 2026 has a list of bonus data in addition.
template <class Atoms, class List>
void pack_exchange(Atoms &atoms, int n, ExchangeBuffer &buffer, List &leave, List &come,
                   LAMMPS_NS::ExecutionSpace space)
{
  if constexpr (std::is_invocable_v<decltype(&Atoms::pack_exchange_kokkos), Atoms &, const int &,
                                    ExchangeBuffer &, List, List, List, decltype(space)>)
    atoms.pack_exchange_kokkos(n, buffer, leave, come, List(), space);
  else
    atoms.pack_exchange_kokkos(n, buffer, leave, come, space);
}

// Returns a view of LAMMPS, of any layout, as rows.
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
// Are their forces in float, too? In mixed precision LAMMPS sums them in double.
#if defined(LMP_KOKKOS_SINGLE_SINGLE)
constexpr bool kFloatForces = true;
#else
constexpr bool kFloatForces = false;
#endif

template <class DeviceType>
constexpr bool kOnCpu =
    Kokkos::SpaceAccessibility<Kokkos::HostSpace,
                               typename DeviceType::execution_space::memory_space>::accessible;

// Does Kokkos change atoms in LAMMPS's own arrays? If not, these arrays are out of date until a sync(Host).
constexpr bool kSharesAtoms = kOnCpu<LMPDeviceType> && !kFloatAtoms;

// Returns whether the atoms of a device are on a GPU while messages are sent from the host.
template <class DeviceType>
bool sends_from_host(LAMMPS_NS::ExecutionSpace space)
{
  return !kOnCpu<DeviceType> && space != LAMMPS_NS::Device;
}

// Packs what a fix has of atoms that leave: pack(atoms that leave, atoms that take their places, buffer) writes numbers where the device
// is, and returns how many.
template <class DeviceType, class List, class Pack>
int pack_on_device(List &which, List &from, ExchangeBuffer &buffer, LAMMPS_NS::ExecutionSpace space,
                   const Pack &pack)
{
  which.template sync<DeviceType>();
  from.template sync<DeviceType>();
  buffer.clear_sync_state();
  const int size =
      pack(which.template view<DeviceType>().data(), from.template view<DeviceType>().data(),
           buffer.template view<DeviceType>().data());
  if (sends_from_host<DeviceType>(space)) {
    buffer.template modify<DeviceType>();
    buffer.template sync<LMPHostType>();
  }
  return size;
}

// Unpacks what a fix has of atoms that have arrived: unpack(places of these atoms, buffer) reads numbers where the device is. If messages
// arrive on the host, LAMMPS writes these places there and does not mark them as modified for Kokkos.
template <class DeviceType, class List, class Unpack>
void unpack_on_device(List &to, ExchangeBuffer &buffer, LAMMPS_NS::ExecutionSpace space,
                      const Unpack &unpack)
{
  buffer.clear_sync_state();
  if (sends_from_host<DeviceType>(space)) {
    buffer.template modify<LMPHostType>();
    to.clear_sync_state();
    to.template modify<LMPHostType>();
  }
  buffer.template sync<DeviceType>();
  to.template sync<DeviceType>();
  unpack(to.template view<DeviceType>().data(), buffer.template view<DeviceType>().data());
}

// Sorts rows with their n atoms.
template <class Sorter>
void sort_rows(Sorter &sorter, ResidentRows &rows, int n)
{
  using namespace LAMMPS_NS;
  using Ints = Kokkos::View<int *, LMPDeviceType, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  sorter.sort(LMPDeviceType(), Ints(rows.first(), n));
  sorter.sort(LMPDeviceType(), Ints(rows.count(), n));
}

// Returns how many atoms may exist while n atoms that have left are packed. LAMMPS has already removed these from nlocal, and may have
// added atoms that arrived.
inline int most_in_exchange(const LAMMPS_NS::Atom &atom, int n)
{
  return std::min(atom.nlocal + n, atom.nmax);
}

// Returns LAMMPS after a check that it runs with Kokkos, and copies to the host the data of atoms in `mask`, which the constructor of a fix
// without /kk reads.
inline LAMMPS_NS::LAMMPS *with_atoms_on_cpu(LAMMPS_NS::LAMMPS *lmp, const std::string &id,
                                            const std::string &style, std::uint64_t mask)
{
  if (!lmp->kokkos)
    lmp->error->all(FLERR, "Fix " + id + " " + style +
                               "/kk: LAMMPS runs without Kokkos: start it with -k on, or use " +
                               style);
  static_cast<LAMMPS_NS::AtomKokkos *>(lmp->atom)->sync(LAMMPS_NS::Host, mask);
  return lmp;
}

// Tells LAMMPS to copy no atoms to or from the device for this fix. Each function of the fix names itself what it reads and changes.
inline void bring_no_atoms(LAMMPS_NS::Fix &fix, LAMMPS_NS::ExecutionSpace space)
{
  fix.kokkosable = 1;
  fix.execution_space = space;
  fix.datamask_read = fix.datamask_modify = EMPTY_MASK;
}

// Runs work while LAMMPS regards the atoms on the host as the newest, as it does around code that does not know Kokkos.
template <class Work>
void with_atoms_of_host(LAMMPS_NS::LAMMPS *lmp, Work &&work)
{
  const int before = lmp->kokkos->auto_sync;
  lmp->kokkos->auto_sync = 1;
  work();
  lmp->kokkos->auto_sync = before;
}

// Ends a run with all atoms on the host, marked as changed there. The next run then starts from what commands such as set and velocity
// change without marking it for Kokkos, also with "run ... pre no", which does no setup. A LAMMPS fix with /kk that is defined after the
// caller, such as gravity/kk, may copy what it reads to the device once more; without a setup that copy is then out of date.
inline void leave_atoms_to_host(LAMMPS_NS::LAMMPS *lmp)
{
  auto &atoms = *static_cast<LAMMPS_NS::AtomKokkos *>(lmp->atom);
  atoms.sync(LAMMPS_NS::Host, ALL_MASK);    // a rerun has not copied them
  atoms.modified(LAMMPS_NS::Host, ALL_MASK);
}

// Copies to a device the atoms as commands between runs have left them on the host: set and velocity change them there without marking them
// for Kokkos. LAMMPS does the same itself during a setup until it calls setup() of fixes.
inline void bring_after_commands(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::ExecutionSpace space,
                                 std::uint64_t mask)
{
  auto &atoms = *static_cast<LAMMPS_NS::AtomKokkos *>(lmp->atom);
  with_atoms_of_host(lmp, [&] { atoms.sync(space, mask); });
}

// Runs work as LAMMPS runs fixes without /kk: copies all atoms to the host before, and marks them as changed there afterwards.
template <class Work>
void run_on_host(LAMMPS_NS::LAMMPS *lmp, Work &&work)
{
  auto &atoms = *static_cast<LAMMPS_NS::AtomKokkos *>(lmp->atom);
  atoms.sync(LAMMPS_NS::Host, ALL_MASK);
  with_atoms_of_host(lmp, work);
  atoms.modified(LAMMPS_NS::Host, ALL_MASK);
}

// Copies numbers of the CPU to memory of a device, which grows if it is too small.
template <class DeviceType>
void to_device(const std::vector<double> &from, Kokkos::View<double *, DeviceType> &to)
{
  using namespace LAMMPS_NS;
  const std::size_t n = from.size();
  if (to.extent(0) < n) to = Kokkos::View<double *, DeviceType>("lsdcd:numbers", with_spare(n));
  const Kokkos::View<const double *, LMPHostType, Kokkos::MemoryTraits<Kokkos::Unmanaged>> host(
      from.data(), n);
  Kokkos::deep_copy(Kokkos::subview(to, std::make_pair(std::size_t(0), n)), host);
}

// Copies the first n numbers of a device to the CPU.
template <class DeviceType>
void from_device(const Kokkos::View<double *, DeviceType> &from, std::size_t n,
                 std::vector<double> &to)
{
  using namespace LAMMPS_NS;
  to.resize(n);
  const Kokkos::View<double *, LMPHostType, Kokkos::MemoryTraits<Kokkos::Unmanaged>> host(to.data(),
                                                                                          n);
  Kokkos::deep_copy(host, Kokkos::subview(from, std::make_pair(std::size_t(0), n)));
}

// Makes the engine whose memory is that of a Kokkos device.
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

// Makes the engine of pairs whose memory is that of a Kokkos device.
template <class DeviceType>
std::unique_ptr<PairEngine> make_pair_engine_on()
{
#if defined(KOKKOS_ENABLE_CUDA)
  using Space = typename DeviceType::execution_space;
  if constexpr (std::is_same<Space, Kokkos::Cuda>::value)
    return make_cuda_pair_engine(Space().cuda_device(), Space().cuda_stream());
  else
#endif
  {
#if defined(KOKKOS_ENABLE_OPENMP)
    if (std::is_same<typename DeviceType::execution_space, Kokkos::OpenMP>::value)
      threads_asked_for() = true;
#endif
    return make_cpu_pair_engine();
  }
}

}    // namespace lsdcd
