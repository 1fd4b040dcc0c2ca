#!/usr/bin/env bash
# Micro-benchmarks, then whole reconstructions with 1 and with 2 threads. `./dev bench` builds and
# calls this. Tables and how to read them: docs/benchmarks.md
# Usage: scripts/bench.sh [--micro | --parts] [MESH...]
#   --micro, --parts   only one half
#   MESH...            for the whole reconstructions; else ../shared/data/parts/*.off when that
#                      folder exists beside the checkout, else the samples in assets/
set -euo pipefail
cd "$(dirname "$0")/.."
bin=build/bin

do_micro=1
do_parts=1
meshes=()
for argument in "$@"; do
  case "$argument" in
    --micro) do_parts=0 ;;
    --parts) do_micro=0 ;;
    -*)
      echo "bench: no option '$argument' (there are --micro and --parts)" >&2
      exit 2
      ;;
    *) meshes+=("$argument") ;;
  esac
done

default_meshes() {
  shopt -s nullglob
  meshes=(../shared/data/parts/*.off)
  [ ${#meshes[@]} -gt 0 ] || meshes=(assets/*.{off,stl,obj,ply})
  shopt -u nullglob
}

# One short line a benchmark: name, processor time, and its counters.
micro() {
  echo "== micro-benchmarks (processor time of one thread)"
  "$bin/hewn-bench" --benchmark_min_time=0.2 --benchmark_counters_tabular=false 2>/dev/null |
    awk '/ERROR OCCURRED/ { print; next }
         /^(-|Benchmark)/ || NF < 6 { next }
         { name = $1; sub(/\/iterations:.*/, "", name)
           # A comparison has no time of its own: its counters tell.
           time = name ~ /^bits_against_floats/ ? "" : $4 " " $5
           printf "%-34s %12s ", name, time
           for (i = 7; i <= NF; ++i) printf " %s", $i
           print "" }'
}

# whole N: the table with N threads; the last line's seconds end up in `seconds`.
whole() {
  echo
  echo "== whole reconstructions, $1 thread(s)"
  local log
  log=$(mktemp)
  # A part that fails has its line in the table; the others still count.
  "$bin/end_to_end" --threads "$1" "${meshes[@]}" | tee "$log" || true
  seconds=$(tail -n 1 "$log" | sed -n 's/.* literals, \([0-9.]*\) s.*/\1/p')
  rm -f "$log"
  if [ -z "$seconds" ]; then
    echo "bench: $bin/end_to_end did not finish" >&2
    exit 1
  fi
}

parts() {
  local one
  whole 1
  one=$seconds
  whole 2
  echo
  awk -v one="$one" -v two="$seconds" 'BEGIN {
    printf "2 threads against 1: %.2f s / %.2f s = %.2f times as fast\n",
           one, two, (two > 0 ? one / two : 0) }'
}

[ ${#meshes[@]} -gt 0 ] || default_meshes
[ $do_micro = 0 ] || micro
[ $do_parts = 0 ] || parts
