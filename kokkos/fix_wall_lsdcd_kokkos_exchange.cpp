// Springs follow their atoms: on the device where the host does that, else by way of the
// plain fix's store on the host.

#include "fix_wall_lsdcd_kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::springs_to_host()
{
  if (!history || springs_are == Where::host) return;
  resident().springs_to(springs, n_with_springs);
  springs.grow(atom->nmax);
  springs_are = Where::host;
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::springs_to_device()
{
  resident().grow(atom->nmax);
  if (springs_are == Where::device) return;
  resident().springs_from(springs, atom->nlocal);
  springs_are = Where::device;
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::grow_arrays(int nmax)
{
  FixWallLsdcd::grow_arrays(nmax);
  if (springs_are == Where::device) resident().grow(nmax);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::copy_arrays(int i, int j, int delflag)
{
  springs_to_host();
  FixWallLsdcd::copy_arrays(i, j, delflag);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::set_arrays(int i)
{
  springs_to_host();
  FixWallLsdcd::set_arrays(i);
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::pack_exchange(int i, double *buf)
{
  springs_to_host();
  return FixWallLsdcd::pack_exchange(i, buf);
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::unpack_exchange(int i, double *buf)
{
  springs_to_host();
  return FixWallLsdcd::unpack_exchange(i, buf);
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::pack_restart(int i, double *buf)
{
  springs_to_host();
  return FixWallLsdcd::pack_restart(i, buf);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::unpack_restart(int i, int nth)
{
  springs_to_host();
  FixWallLsdcd::unpack_restart(i, nth);
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::size_restart(int i)
{
  springs_to_host();
  return FixWallLsdcd::size_restart(i);
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::maxsize_restart()
{
  springs_to_host();
  return FixWallLsdcd::maxsize_restart();
}

#if LSDCD_DEVICE_EXCHANGE

// Atoms on a GPU whose messages leave from the host.
template <class DeviceType>
bool FixWallLsdcdKokkos<DeviceType>::sends_from_host(ExecutionSpace space)
{
  return !lsdcd::kOnHost<DeviceType> && space != Device;
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::pack_exchange_kokkos(const int &n,
                                                         lsdcd::ExchangeBuffer &buffer,
                                                         DAT::tdual_int_1d which,
                                                         DAT::tdual_int_1d from,
                                                         ExecutionSpace space)
{
  if (!history) return 0;
  springs_to_device();
  which.template sync<DeviceType>();
  from.template sync<DeviceType>();
  buffer.clear_sync_state();
  const int size = resident().pack(n, which.template view<DeviceType>().data(),
                                   from.template view<DeviceType>().data(),
                                   buffer.template view<DeviceType>().data());
  if (sends_from_host(space)) {
    buffer.template modify<DeviceType>();
    buffer.template sync<LMPHostType>();
  }
  return size;
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::unpack_exchange_kokkos(lsdcd::ExchangeBuffer &buffer,
                                                            DAT::tdual_int_1d &to, int n,
                                                            int n_first, int second,
                                                            ExecutionSpace space)
{
  if (!history) return;
  springs_to_device();
  buffer.clear_sync_state();
  if (sends_from_host(space)) buffer.template modify<LMPHostType>();
  buffer.template sync<DeviceType>();
  to.template sync<DeviceType>();
  resident().unpack(n, to.template view<DeviceType>().data(),
                    buffer.template view<DeviceType>().data(), n_first, second);
  n_with_springs = std::max(n_with_springs, atom->nlocal);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  if (!history) return;
  springs_to_device();
  using Ints = Kokkos::View<int *, LMPDeviceType, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  sorter.sort(LMPDeviceType(), Ints(resident().first_spring(), atom->nlocal));
  sorter.sort(LMPDeviceType(), Ints(resident().n_springs(), atom->nlocal));
}

#endif

template class LAMMPS_NS::FixWallLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::FixWallLsdcdKokkos<LMPHostType>;
#endif
