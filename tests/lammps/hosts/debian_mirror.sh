# The Debian mirror that this machine's apt uses, or nothing; to be sourced.
debian_mirror() {
  command -v apt-get >/dev/null || return 0
  apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -m1 -E '/debian/?$' || true
}
