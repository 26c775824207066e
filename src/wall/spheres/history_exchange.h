// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The history of contacts: it is with the engine in steps, on the host where spheres move.
#pragma once

#include "contact/contact_history.h"
#include "engine/engine.h"
#include "host/host.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace lsdcd {

// Spheres are counted from 0, in the order of the host. If the law keeps nothing, nothing is moved, packed or asked of the engine.
class HistoryExchange {
 public:
  // Both arguments must outlive this object. The law says which numbers a contact stores.
  HistoryExchange(Host &host, const ContactLaw &law) :
      host_(host), law_(law), springs_(law.n_extra())
  {
  }

  bool is_on() const { return law_.has_history(); }

  // Sets the engine of the steps from now on. History of another engine must be on the host. `in_place`: in_engine() will be called.
  void set_engine(WallEngine &engine, bool in_place = false)
  {
    engine_ = &engine;
    in_place_ = in_place;
  }

  // Makes room for `room` spheres from now on, wherever the history is.
  void grow(int room);
  int room() const { return room_; }
  // Returns the history of this process's spheres, on the host from now on.
  ContactHistory &on_cpu();
  // Forgets all springs, if there are any; the history is on the host from now on.
  void clear();
  // Gives the history of the n spheres of this process to the engine, if it is not there.
  void to_engine(int n);
  // Gives the history to the engine as to_engine() does, and returns it, for a host that moves spheres where the engine
  // computes: it packs, unpacks and sorts the history there.
  ResidentRows &in_engine(int n);
  bool is_with_engine() const { return with_engine_; }
  // Notes that the engine has the history of the first n spheres of the host.
  void set_spheres_of_engine(int n) { n_with_engine_ = n; }
  int spheres_of_engine() const { return n_with_engine_; }

  int numbers_per_contact() const { return springs_.row_size(); }
  // Returns how many numbers one sphere has in a message or a file at most.
  int max_packed_size() const;

  // The name that a feature of a mesh gets.
  using FeatureName = std::function<FeatureCode(int mesh, FeatureCode feature)>;
  void rename_features(const FeatureName &name);    // on the host

  // The following functions are for saved states, with the history on the host. A saved state tells its kind of history
  // (ContactLaw::history_kind()). pack_saved() writes features with the names that `name` gives them, and returns how many numbers it
  // wrote.
  int pack_saved(int i, double *buffer, const FeatureName &name) const;
  // Sets the kind of history of the saved state. Called before the first sphere is unpacked.
  void set_kind_of_file(double kind)
  {
    kind_is_ours_ = kind == law_.history_kind();
    other_law_ = 0;
    checked_ = false;
  }
  // Returns whether `size` numbers are what pack_saved() can have written, for any law.
  static bool is_sound(const double *buffer, int size);
  // Reads the `size` numbers of one sphere. Spheres with numbers of another law are not read, but counted.
  void unpack_saved(int i, const double *buffer, int size);
  // Drops the history of those of the first n spheres that name a feature which is not there. Returns how many spheres lost it. Local.
  int drop_unknown(int n, const std::function<bool(const Spring &)> &is_there);
  // Drops the history of spheres that name a feature which is not there, and warns of these and of those
  // of another law. Checks the first n spheres, once. Collective.
  void check_restored(int n, const std::function<bool(const Spring &)> &is_there);
  bool is_checked() const { return checked_; }

  std::size_t bytes() const { return is_on() ? springs_.bytes() : 0; }

 private:
  Host &host_;
  const ContactLaw &law_;
  WallEngine *engine_ = nullptr;
  bool in_place_ = false;
  ContactHistory springs_;
  int room_ = 0;
  bool with_engine_ = false;
  int n_with_engine_ = 0;
  bool checked_ = false;
  bool kind_is_ours_ = false;
  std::int64_t other_law_ = 0;    // spheres of the saved state with springs of another law
};

}    // namespace lsdcd
