#!/usr/bin/env bash
# Optimises trees and compares each with its result on 10 million fresh points; one line a tree.
# Ends with 1 when a tree fails or a single point differs.
#
#   scripts/prove-trees.sh TREE...    HEWN_FLAGS="--tolerance 0.002" adds flags
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

hewn=build/bin/hewn
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
value() { sed -n "s/^ *\"$1\": \([0-9.e-]*\),*$/\1/p" "$work/report.json" | head -n 1; }
literals() { sed -n 's/^ *"literals": \([0-9]*\),*$/\1/p' "$work/report.json" | paste -sd' '; }

failed=0
echo "| tree | primitives | after | cells | points | different |"
echo "|---|---|---|---|---|---|"
for tree in "$@"; do
  # shellcheck disable=SC2086  # flags are several words
  if ! "$hewn" optimise "$tree" -o "$work/out.json" --report "$work/report.json" --threads 1 \
    --points 10000000 --quiet ${HEWN_FLAGS:-}; then
    echo "| $(basename "$tree") | failed | | | | |"
    failed=1
    continue
  fi
  read -r before after <<<"$(literals)"
  different=$(value points_different)
  echo "| $(basename "$tree") | $before | $after | $(value cells_compared) |" \
    "$(value points_compared) | $different |"
  [ "$different" = 0 ] || failed=1
done
exit "$failed"
