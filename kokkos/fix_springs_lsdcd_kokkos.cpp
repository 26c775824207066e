// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "fix_springs_lsdcd_kokkos.h"

#include "update.h"
#include "utils.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixSpringsLsdcdKokkos<DeviceType>::FixSpringsLsdcdKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixSpringsLsdcd(lmp, narg, arg), atomKK(static_cast<AtomKokkos *>(atom))
{
  lsdcd::bring_no_atoms(*this, ExecutionSpaceFromDevice<DeviceType>::space);
  exchange_comm_device = sort_device = std::is_same<DeviceType, LMPDeviceType>::value;
  // Restart files of both forms are the same.
  delete[] style;
  style = utils::strdup("SPRINGS/LSDCD");
}

template <class DeviceType>
lsdcd::ListedGrains FixSpringsLsdcdKokkos<DeviceType>::grains()
{
  atomKK->sync(execution_space, TAG_MASK | TYPE_MASK);
  lsdcd::ListedGrains all;
  all.name = {atomKK->k_tag.template view<DeviceType>().data(), sizeof(tagint) == 8};
  all.type = atomKK->k_type.template view<DeviceType>().data();
  all.n_all = atom->nlocal + atom->nghost;
  all.near = near_images();
  if constexpr (!lsdcd::kFloatAtoms)
    if (all.near > 0) {
      atomKK->sync(execution_space, X_MASK);
      all.x = lsdcd::rows_of(atomKK->k_x.template view<DeviceType>());
    }
  return all;
}

template <class DeviceType>
lsdcd::Partners &FixSpringsLsdcdKokkos<DeviceType>::of_atoms()
{
  if (on_device) {
    engine->to_cpu(partners, atom->nlocal + (ghosts_too ? atom->nghost : 0));
    partners.grow(atom->nmax);
    on_device = false;
  }
  return partners;
}

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::need_on_device(int n_atoms)
{
  if (!on_device) engine->from_cpu(partners, n_atoms);
  on_device = true;
  engine->partners().grow(n_atoms);    // fixes may have created atoms since
}

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::set_laws(int width, int for_energy,
                                                 const std::string &of_laws,
                                                 const LawsOfTypes &of_types)
{
  const bool same = width == law_width && of_laws == kinds;
  FixSpringsLsdcd::set_laws(width, for_energy, of_laws, of_types);
  if (!same) on_device = false;
}

// ---- steps -------------------------------------------------------------------------------

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::begin_step(const lsdcd::PairRows &of_step,
                                                   bool types_changed, bool newton)
{
  rows = of_step;
  own = atom->nlocal;
  ghosts_too = newton && !rows.full;
  if (new_list) {
    need_on_device(atom->nlocal);
    cleared |= engine->hand_out(rows, grains());
  } else if (by_law && types_changed) {
    cleared |= note_types();
  }
  new_list = shown = false;
  in_pairs = true;
  if (update->setupflag) tell_cleared();
}

template <class DeviceType>
bool FixSpringsLsdcdKokkos<DeviceType>::note_types()
{
  return engine->note_types(rows, grains());
}

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::collect()
{
  engine->collect(rows, grains(), own + (ghosts_too ? atom->nghost : 0));
  on_device = true;
  if (ghosts_too) tell_owners();
  ghosts_too = false;
}

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::forget()
{
  FixSpringsLsdcd::forget();
  on_device = false;
}

template <class DeviceType>
int FixSpringsLsdcdKokkos<DeviceType>::largest_packed_size() const
{
  return on_device ? engine->partners().largest_packed_size(atom->nlocal)
                   : partners.largest_packed_size();
}

template <class DeviceType>
std::vector<double> FixSpringsLsdcdKokkos<DeviceType>::numbers_of(int i, int j)
{
  if (in_pairs && !shown) {
    const bool ghosts = ghosts_too;
    ghosts_too = false;
    collect();
    ghosts_too = ghosts;
    shown = true;
  }
  const lsdcd::Partners &here = of_atoms();
  atomKK->sync(Host, TAG_MASK | X_MASK);
  const lsdcd::Vec3 offset = {atom->x[i][0] - atom->x[j][0], atom->x[i][1] - atom->x[j][1],
                              atom->x[i][2] - atom->x[j][2]};
  const lsdcd::PartnerForm &form = here.form();
  for (int k = 0; k < here.count(i); k++)
    if (here.name(i, k) == atom->tag[j] &&
        (!form.by_image || form.is_image(here.numbers(i, k), offset, near_images())))
      return {here.numbers(i, k), here.numbers(i, k) + here.width()};
  return {};
}

// The engine has nothing of an atom that is new.
template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::set_arrays(int i)
{
  moved = true;
  if (!on_device || between_runs) of_atoms().clear(i);
  known_as[i] = 0;
}

template <class DeviceType>
const double *FixSpringsLsdcdKokkos<DeviceType>::radii()
{
  atomKK->sync(Host, RADIUS_MASK);
  return atom->radius;
}

template <class DeviceType>
const tagint *FixSpringsLsdcdKokkos<DeviceType>::tags()
{
  atomKK->sync(Host, TAG_MASK);
  return atom->tag;
}

template <class DeviceType>
double FixSpringsLsdcdKokkos<DeviceType>::memory_usage()
{
  return FixSpringsLsdcd::memory_usage() + static_cast<double>(engine ? engine->bytes() : 0);
}

// ---- where it moves them on the device ----------------------------------------------------

template <class DeviceType>
int FixSpringsLsdcdKokkos<DeviceType>::pack_exchange_kokkos(const int &n,
                                                            lsdcd::ExchangeBuffer &buffer,
                                                            DAT::tdual_int_1d which,
                                                            DAT::tdual_int_1d from,
                                                            ExecutionSpace space)
{
  if (!keeps()) return 0;
  need_on_device(lsdcd::most_in_exchange(*atom, n));
  if (between_runs) keep_names();    // partners know atoms by these since init()
  return lsdcd::pack_on_device<DeviceType>(which, from, buffer, space,
                                           [&](const int *leaves, const int *comes, double *to) {
                                             return engine->partners().pack(n, leaves, comes, to);
                                           });
}

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::unpack_exchange_kokkos(lsdcd::ExchangeBuffer &buffer,
                                                               DAT::tdual_int_1d &to, int n,
                                                               int n_first, int second,
                                                               ExecutionSpace space)
{
  if (!keeps()) return;
  need_on_device(atom->nlocal);
  lsdcd::unpack_on_device<DeviceType>(to, buffer, space, [&](const int *at, const double *from) {
    engine->partners().unpack(n, at, from, n_first, second);
  });
  if (between_runs) keep_names();
}

template <class DeviceType>
void FixSpringsLsdcdKokkos<DeviceType>::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  if (!keeps()) return;
  need_on_device(atom->nlocal);
  lsdcd::sort_rows(sorter, engine->partners(), atom->nlocal);
}

template class LAMMPS_NS::FixSpringsLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::FixSpringsLsdcdKokkos<LMPHostType>;
#endif
