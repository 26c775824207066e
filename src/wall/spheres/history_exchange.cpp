// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spheres/history_exchange.h"

#include "base/number_words.h"
#include "contact/contact_set.h"
#include "law/force_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace lsdcd {

// Gives the feature of a packed spring another name.
static void rename_feature(Real *row, const HistoryExchange::FeatureName &name)
{
  Spring s;
  unpack_location(*row, s);
  s.feature = name(static_cast<int>(s.mesh), s.feature);
  *row = packed_location(s);
}

void HistoryExchange::grow(int room)
{
  room_ = room;
  if (!is_on()) return;
  if (!with_engine_)
    springs_.grow(room);
  else if (in_place_)
    engine_->springs().grow(room);
}

ContactHistory &HistoryExchange::on_cpu()
{
  if (with_engine_) {
    engine_->springs().to_cpu(springs_, n_with_engine_);
    springs_.grow(std::max(room_, n_with_engine_));
    with_engine_ = false;
  }
  return springs_;
}

void HistoryExchange::clear()
{
  if (!is_on()) return;
  on_cpu();
  for (int i = 0; i < room_; i++) springs_.clear(i);
}

void HistoryExchange::to_engine(int n)
{
  if (with_engine_ || !is_on()) return;
  engine_->springs().from_cpu(springs_, n);
  n_with_engine_ = n;
  with_engine_ = true;
  grow(room_);
}

ResidentRows &HistoryExchange::in_engine(int n)
{
  to_engine(n);
  return engine_->springs();
}

int HistoryExchange::max_packed_size() const
{
  return is_on() ? 1 + springs_.row_size() * kMaxContacts : 0;
}

int HistoryExchange::pack_saved(int i, double *buffer, const FeatureName &name) const
{
  const int size = springs_.pack(i, buffer);
  for (int k = 0; k < springs_.count(i); k++)
    rename_feature(buffer + 1 + k * springs_.row_size(), name);
  return size;
}

bool HistoryExchange::is_sound(const double *buffer, int size)
{
  const double count = size > 0 ? buffer[0] : -1;
  if (count == 0) return size == 1;
  const double each = (size - 1) / count;
  if (!(count > 0) || count != std::floor(count) || each < kPackedSpring ||
      each != std::floor(each) ||
      !std::all_of(buffer, buffer + size, [](double a) { return std::isfinite(a); }))
    return false;
  for (int at = 1; at < size; at += static_cast<int>(each))
    if (!(buffer[at] >= 0 && buffer[at] < 0x1p53) || buffer[at] != std::floor(buffer[at]))
      return false;
  return true;
}

// Another law may have kept other numbers for each contact, and this one none. One of our kind has KeptLosses or not.
void HistoryExchange::unpack_saved(int i, const double *buffer, int size)
{
  const int count = static_cast<int>(buffer[0]);
  if (count == 0) return;
  const int each = (size - 1) / count, more = each - springs_.row_size();
  if (!is_on() || !kind_is_ours_ || size != 1 + count * each ||
      !(more == 0 || std::abs(more) == kKeptLosses)) {
    other_law_++;
    return;
  }
  springs_.clear(i);
  Real *const rows = springs_.add(i, count);
  for (int k = 0; k < count; k++)
    std::copy_n(buffer + 1 + k * each, std::min(each, springs_.row_size()),
                rows + k * springs_.row_size());
}

int HistoryExchange::drop_unknown(int n, const std::function<bool(const Spring &)> &is_there)
{
  int lost = 0;
  for (int i = 0; is_on() && i < n; i++)
    for (int k = 0; k < springs_.count(i); k++)
      if (!is_there(springs_.spring(i, k))) {
        lost++;
        springs_.clear(i);
        break;
      }
  return lost;
}

void HistoryExchange::check_restored(int n, const std::function<bool(const Spring &)> &is_there)
{
  checked_ = true;
  Real lost[2] = {static_cast<Real>(drop_unknown(n, is_there)), static_cast<Real>(other_law_)};
  host_.sum(lost, 2);
  const char *const file[] = {"was written with a different mesh",
                              "was written with a different contact law"};
  for (int k = 0; k < 2; k++) {
    if (!(lost[k] > 0)) continue;
    const std::int64_t n = static_cast<std::int64_t>(lost[k]);
    const std::string who = counted(n, host_.names().sphere);
    host_.warn((n == 1 ? who + " loses its springs: the " + host_.names().saved + " "
                       : who + " lose their springs: the " + host_.names().saved + " ") +
               file[k]);
  }
}

void HistoryExchange::rename_features(const FeatureName &name)
{
  for (int i = 0; is_on() && i < springs_.n_grains(); i++)
    for (int k = 0; k < springs_.count(i); k++) rename_feature(springs_.row(i, k), name);
}

}    // namespace lsdcd
