#!/usr/bin/env bash
# Installs the packages of scripts/packages.txt that are missing; does nothing when all are there.
# Usage: scripts/install-packages.sh
set -euo pipefail
list="$(dirname "$0")/packages.txt"

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install-packages: this system has no apt-get; install what $list names by hand" >&2
  echo "                  (HEWN_SKIP_PACKAGES=1 ./dev build then skips this step)" >&2
  exit 1
fi

missing=()
while read -r package; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done < <(grep -v -e '^#' -e '^[[:space:]]*$' "$list")
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install-packages: missing: ${missing[*]}" >&2
    echo "                  run as root: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  # Without a terminal nobody can type a password: fail with words instead of waiting.
  [ -t 0 ] || as_root=(sudo -n)
fi

echo "installing: ${missing[*]}"
apt() {
  ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive apt-get -qq "$@" </dev/null
}
install() { apt install -y --no-install-recommends "${missing[@]}"; }
# The package lists of a fresh machine are empty or old: refresh them when the first try fails.
if ! install >/dev/null 2>&1; then
  apt update
  install >/dev/null || {
    echo "install-packages: apt-get could not install: ${missing[*]}" >&2
    echo "                  check the network and the package sources, then run this again" >&2
    exit 1
  }
fi
