#!/usr/bin/env bash
# A window that is killed, or whose display goes, leaves its plan behind; the next one gives it back by
# one click.
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

# What cannot open a window says so and ends.
refuses() {
  local code=0
  "$studio" part.off >refused.txt 2>&1 || code=$?
  [ "$code" = 1 ] || fail "a window that cannot be opened ended with $code"
  grep -q "$1" refused.txt || fail "it did not say '$1': $(cat refused.txt)"
}
MESA_GL_VERSION_OVERRIDE=3.3 refuses "OpenGL 4.3 is needed"
DISPLAY='' WAYLAND_DISPLAY='' refuses "there is no display"

# A display of its own, which goes away under the window.
mkfifo display
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3<>display >/dev/null 2>&1 &
server=$!
read -r number <display
export DISPLAY=:$number
open_window part.off --no-live
until_true "the groups" is ready true
xdotool mousemove 600 400
key ctrl+a
until_true "selected groups" at_least selected 1
key p
until_true "the partition" is partitions 1
until_true "a copy" bash -c "ls '$folder'/state/hewn/recovery/unsaved-*.json >/dev/null"
key k
drag 600 150 604 700
until_true "a plane" is has_plane true
key Return
until_true "the cut" is cuts 1
kill "$server"
code=0
wait "$pid" || code=$?
[ "$code" = 1 ] || fail "the window without a display ended with $code"
grep -q "the display is gone; the plan is kept" studio.txt || fail "it did not say what happened"
# The copy of a moment ago had no cut, and the next was due in a minute.
grep -q '"cuts"' state/hewn/recovery/unsaved-*.json || fail "the last change was lost"
echo "ok: the plan came back after kill -9, and is kept when the display goes"
