// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Histories of contacts follow their atoms on the device. Rows of the contacts array stay in memory of the CPU, as do their
// readers, and go from and to it where messages are on the device.

#include "fix_wall_lsdcd_kokkos.h"

#include <algorithm>

using namespace LAMMPS_NS;

// Numbers on the device as an array on the host, and the other way.
template <class DeviceType, class T>
static std::vector<std::remove_const_t<T>> copied_to_cpu(T *from, std::size_t n)
{
  std::vector<std::remove_const_t<T>> to(n);
  using Raw = Kokkos::MemoryTraits<Kokkos::Unmanaged>;
  Kokkos::deep_copy(Kokkos::View<std::remove_const_t<T> *, LMPHostType, Raw>(to.data(), n),
                    Kokkos::View<const T *, DeviceType, Raw>(from, n));
  return to;
}
template <class DeviceType>
static void to_device(const std::vector<double> &from, double *to)
{
  using Raw = Kokkos::MemoryTraits<Kokkos::Unmanaged>;
  Kokkos::deep_copy(Kokkos::View<double *, DeviceType, Raw>(to, from.size()),
                    Kokkos::View<const double *, LMPHostType, Raw>(from.data(), from.size()));
}

// Atom which[k] leaves and atom from[k], if that is not -1, takes its place. All pointers are to
// memory of the device. Returns the numbers written.
template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::pack_rows(int n, const int *which, const int *from,
                                              double *buffer)
{
  const int size = row_size();
  if (size == 0) return 0;
  const std::vector<int> leaves = copied_to_cpu<DeviceType>(which, n),
                         comes = copied_to_cpu<DeviceType>(from, n);
  std::vector<double> rows(std::size_t(n) * size);
  for (int k = 0; k < n; k++) {
    double *row = array_atom[leaves[k]];
    std::copy_n(row, size, rows.data() + std::size_t(k) * size);
    if (comes[k] >= 0) std::copy_n(array_atom[comes[k]], size, row);
  }
  to_device<DeviceType>(rows, buffer);
  return n * size;
}

// Atom to[k], if that is not -1, gets row k.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::unpack_rows(int n, const int *to, const double *rows)
{
  const int size = row_size();
  if (size == 0) return;
  const std::vector<int> place = copied_to_cpu<DeviceType>(to, n);
  const std::vector<double> row = copied_to_cpu<DeviceType>(rows, std::size_t(n) * size);
  for (int k = 0; k < n; k++)
    if (place[k] >= 0) std::copy_n(row.data() + std::size_t(k) * size, size, array_atom[place[k]]);
}

// A message has the rows first, then the histories.
template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::pack_exchange_kokkos(const int &n,
                                                         lsdcd::ExchangeBuffer &buffer,
                                                         DAT::tdual_int_1d which,
                                                         DAT::tdual_int_1d from,
                                                         ExecutionSpace space)
{
  return lsdcd::pack_on_device<DeviceType>(
      which, from, buffer, space, [&](const int *leaves, const int *comes, double *at) {
        const int size = pack_rows(n, leaves, comes, at);
        if (!has_history()) return size;
        lsdcd::ResidentRows &springs = wall->history().in_engine(lsdcd::most_in_exchange(*atom, n));
        return size + springs.pack(n, leaves, comes, at + size);
      });
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::unpack_exchange_kokkos(lsdcd::ExchangeBuffer &buffer,
                                                            DAT::tdual_int_1d &to, int n,
                                                            int n_first, int second,
                                                            ExecutionSpace space)
{
  lsdcd::unpack_on_device<DeviceType>(to, buffer, space, [&](const int *places, const double *at) {
    const int n_second = n - n_first, rows = n_first * row_size();
    unpack_rows(n_first, places, at);
    if (n_second > 0) unpack_rows(n_second, places + n_first, at + second);
    if (!has_history()) return;
    lsdcd::HistoryExchange &history = wall->history();
    history.in_engine(atom->nlocal)
        .unpack(n, places, at + rows, n_first, second + n_second * row_size() - rows);
    history.set_spheres_of_engine(std::max(history.spheres_of_engine(), atom->nlocal));
  });
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  if (spec().contacts) {
    const auto order = sorter.get_permute_vector();
    const int n = atom->nlocal, size = row_size();
    const auto from = copied_to_cpu<LMPDeviceType>(order.data(), n);
    const std::vector<double> rows(array_atom[0], array_atom[0] + std::size_t(n) * size);
    for (int i = 0; i < n; i++)
      std::copy_n(rows.data() + std::size_t(from[i]) * size, size, array_atom[i]);
  }
  if (!has_history()) return;
  lsdcd::sort_rows(sorter, wall->history().in_engine(atom->nlocal), atom->nlocal);
}

template class LAMMPS_NS::FixWallLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::FixWallLsdcdKokkos<LMPHostType>;
#endif
