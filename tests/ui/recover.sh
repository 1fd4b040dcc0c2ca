#!/usr/bin/env bash
# A window that is killed leaves its plan behind; the next one gives it back by one click.
# Usage: recover.sh STUDIO MESH FOLDER
set -euo pipefail
studio=$1 mesh=$2 folder=$3
. "$(dirname "$0")/driving.sh"
with_screen 1280x800 "$@"
rm -rf "$folder"
mkdir -p "$folder/state/hewn"
export XDG_STATE_HOME=$folder/state
echo '{"hints": false}' >"$folder/state/hewn/studio.json"
cp "$mesh" "$folder/part.off"
cd "$folder"

open_window part.off --no-live
until_true "the groups" is ready true
scan hovered_text "cylinder r 3" 448 300 500 400 10
click $(xdotool getmouselocation --shell | sed -n 's/^[XY]=//p' | tr '\n' ' ')
until_true "a selected group" is selected 1
key shift+p
until_true "the partition" is partitions 1
until_true "the copy" bash -c "ls '$folder'/state/hewn/recovery/unsaved-*.json >/dev/null"
kill -9 "$pid"
wait "$pid" 2>/dev/null || true

open_window part.off --no-live
until_true "the offer" is recoverable 1
until_true "the groups" is ready true
is partitions 0 || fail "the plan came back unasked"
picture offer
# The card's first button opens the copy.
found=
for y in $(seq 150 12 260); do
  click 480 "$y"
  sleep 0.3
  if is recoverable 0; then found=yes && break; fi
done
[ -n "$found" ] || fail "no button on the card"
until_true "the lost partition" is partitions 1
close_window
left=$(find "$folder/state/hewn/recovery" -name 'unsaved-*.json' | wc -l)
[ "$left" = 0 ] || fail "$left copies were left behind by a window that was closed"
echo "ok: the plan came back after kill -9"
