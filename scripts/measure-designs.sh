#!/usr/bin/env bash
# Renders designs with OpenSCAD, reconstructs them from nothing but their triangles, and compares: one
# line a design. The first line of each says how many primitives it is made of.
#
#   scripts/measure-designs.sh [DESIGN.scad...]    bench/designs/*.scad when none is given
#   HEWN=OTHER/hewn compares another build; HEWN_FLAGS="--segment-smooth-angle 20" adds flags
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

hewn=${HEWN:-build/bin/hewn}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
value() { sed -n "s/^ *\"$1\": \([0-9.e-]*\),*$/\1/p" "$work/report.json" | head -n 1; }

[ $# -gt 0 ] || set -- bench/designs/*.scad
made=0
found=0
echo "| design | made of | found | largest distance | IoU |"
echo "|---|---|---|---|---|"
for design in "$@"; do
  primitives=$(sed -n '1s/.*: \([0-9]*\) primitives\.$/\1/p' "$design")
  openscad -o "$work/mesh.off" "$design" 2>"$work/openscad.log" ||
    { cat "$work/openscad.log" >&2 && exit 1; }
  # shellcheck disable=SC2086  # flags are several words
  "$hewn" reconstruct "$work/mesh.off" -o "$work/out.scad" --report "$work/report.json" \
    --threads 1 --quiet ${HEWN_FLAGS:-}
  literals=$(value literals)
  made=$((made + primitives))
  found=$((found + literals))
  printf '| %s | %s | %s | %.4f | %.4f |\n' "$(basename "$design" .scad)" "$primitives" \
    "$literals" "$(value hausdorff_rel)" "$(value iou)"
done
echo "| together | $made | $found | | |"
