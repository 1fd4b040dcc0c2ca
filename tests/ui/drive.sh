#!/usr/bin/env bash
# Drives the real window under Xvfb with real mouse and keyboard events, and checks what came of it.
# Usage: drive.sh STUDIO HEWN MESH FOLDER; the pictures of the steps stay in FOLDER.
set -euo pipefail
studio=$1 hewn=$2 mesh=$3 folder=$4
export LIBGL_ALWAYS_SOFTWARE=1 XDG_STATE_HOME=$folder/state
rm -rf "$folder"
mkdir -p "$folder"
cp "$mesh" "$folder/part.off"

# Without a display, or with too old an OpenGL, the program says so and ends with 1.
refuses() {
  local what=$1 code=0
  shift
  "$@" >"$folder/refusal.txt" 2>&1 || code=$?
  if [ "$code" != 1 ] || ! grep -q "$what" "$folder/refusal.txt"; then
    echo "FAILED: expected exit code 1 and '$what', got $code:" >&2
    cat "$folder/refusal.txt" >&2
    exit 1
  fi
}

if [ -z "${HEWN_UI_INSIDE:-}" ]; then
  refuses "no display" env -u DISPLAY -u WAYLAND_DISPLAY "$studio"
  export HEWN_UI_INSIDE=1
  exec xvfb-run -a -s "-screen 0 1280x800x24 -noreset" "$0" "$@"
fi

refuses "OpenGL 4.3 is needed" env MESA_GL_VERSION_OVERRIDE=3.3 "$studio"

cd "$folder"
fail() {
  echo "FAILED: $*" >&2
  cat "$folder/studio.txt" >&2 || true
  kill "$pid" 2>/dev/null || true
  exit 1
}
# Waits up to a minute for a condition.
until_true() {
  local what=$1
  shift
  for _ in $(seq 240); do
    if "$@" 2>/dev/null; then return 0; fi
    sleep 0.25
  done
  fail "waited in vain: $what"
}
logged() { [ "$(grep -c "$1" "$folder/log.txt")" -ge "${2:-1}" ]; }
key() {
  xdotool key --delay 40 "$@"
  sleep 0.4
}
click() {
  xdotool mousemove "$1" "$2"
  sleep 0.4
  xdotool click 1
  sleep 0.4
}
drag() {
  xdotool mousemove "$1" "$2"
  sleep 0.3
  xdotool mousedown 1
  for i in 1 2 3 4 5 6; do
    xdotool mousemove $(($1 + ($3 - $1) * i / 6)) $(($2 + ($4 - $2) * i / 6))
    sleep 0.1
  done
  xdotool mouseup 1
  sleep 0.5
}
pictures() { find "$folder" -name 'hewn-*.png' | wc -l; }
more_pictures() { [ "$(pictures)" -gt "$1" ]; }

"$studio" part.off --record "$folder/log.txt" --pictures "$folder" --no-live --frame-stats \
  >"$folder/studio.txt" 2>&1 &
pid=$!
until_true "the window" xdotool search --name "Hewn Studio"
until_true "the mesh" logged '"open"'
sleep 3
grep -q . "$folder/log.txt" || fail "nothing is recorded"

# A click on the part selects; S takes all of its kind; Shift+P subtracts.
click 475 330
key shift+p
until_true "a partition from a click" logged '"partition"'
key ctrl+z
until_true "undo" logged '"undo"'
key ctrl+shift+z
until_true "redo" logged '"redo"'

# The knife: a line across the part, then Enter.
key k
drag 600 150 600 760
key Return
until_true "a cut" logged '"cut"'
key ctrl+z
until_true "the cut's undo" logged '"undo"' 2

# The tree, its file, and the same again without a window.
key ctrl+r
until_true "the search is asked for" logged '"reconstruct"'
key ctrl+e
sleep 1
xdotool key --delay 80 ctrl+a
xdotool type --delay 80 "tree.scad"
key Return
until_true "the exported tree" test -s "$folder/tree.scad"
mv tree.scad from-window.scad
count=$(pictures)
key r
sleep 1
key F12
until_true "a picture" more_pictures "$count"
key ctrl+q
until_true "the end" bash -c "! kill -0 $pid"

"$hewn" replay "$folder/log.txt" || fail "the log does not replay"
cmp tree.scad from-window.scad || fail "the replayed tree differs"
grep -q 'difference' tree.scad || fail "no difference in the tree"
grep -q '"frames"' "$folder/studio.txt" || fail "no frame times"
echo "ok: $(wc -l <"$folder/log.txt") commands"
