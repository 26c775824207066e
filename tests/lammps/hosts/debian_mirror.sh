# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# To be sourced; the caller has a function `skip REASON`.

# The Debian mirror that this machine's apt uses, or nothing.
debian_mirror() {
  command -v apt-get >/dev/null || return 0
  apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -m1 -E '/debian/?$' || true
}

# debian_root SUITE FOLDER: the folder becomes a small Debian, unless it is there; locked until the
# script ends.
debian_root() {
  local suite=$1 debian=$2 tool mirror
  [ "$(id -u)" -eq 0 ] || skip "another Debian is root's to enter"
  for tool in mmdebstrap unshare chroot flock; do
    command -v $tool >/dev/null || skip "no $tool on this machine"
  done
  unshare --mount true 2>/dev/null || skip "nothing can be mounted here"
  mirror=$(debian_mirror)
  [ -n "$mirror" ] || skip "apt has no Debian mirror configured"

  mkdir -p "$(dirname "$debian")"
  exec 9>"$debian.lock"
  flock 9
  if [ ! -d "$debian" ]; then
    rm -rf "$debian.new"
    # A package list past its term is good enough to test on; its signature is checked all the same.
    mmdebstrap --variant=apt --aptopt='Acquire::Check-Valid-Until "false"' \
      --aptopt='Acquire::Languages "none"' --dpkgopt=force-unsafe-io "$suite" "$debian.new" "$mirror" </dev/null ||
      { rm -rf "$debian.new"; skip "it does not come from the mirror"; }
    mv "$debian.new" "$debian"
  fi
}
