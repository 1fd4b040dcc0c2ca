#!/usr/bin/env bash
# How fast the window draws without a graphics card, and that it rests when nothing happens.
# Usage: frames.sh STUDIO PICTURE_TOOL MESH PIECES FOLDER
# Judged by processor time, which other programs on the machine do not change: a frame of 100,000
# triangles may cost 50 ms on each of two cores, and while a job runs no frame may cost the window's
# own thread more than 100 ms.
set -euo pipefail
studio=$1 tool=$2 mesh=$3 pieces=$4 folder=$5
. "$(dirname "$0")/driving.sh"
with_screen 1280x800 "$@"
rm -rf "$folder"
mkdir -p "$folder"
export XDG_STATE_HOME=$folder/state
"$tool" fine-mesh "$mesh" "$folder/fine.off" "$pieces"

open_window "$folder/fine.off" --no-live
until_true "the mesh" is ready true
until_true "rest" is_idle
xdotool mousemove 640 440
sleep 0.3
xdotool mousedown 2
for i in $(seq 120); do
  xdotool mousemove_relative -- $(((i / 30) % 2 ? -6 : 6)) $((i % 3 - 1))
  sleep 0.02
done
xdotool mouseup 2
until_true "rest after orbiting" is_idle
sleep 0.5

ticks() { awk '{print $14 + $15}' "/proc/$pid/stat"; }
before=$(ticks)
sleep 5
idle=$(($(ticks) - before))
echo "idle: $idle ticks of $(getconf CLK_TCK) a second in 5 s"

# The view keeps turning while a tree is searched.
key ctrl+r
until_true "the search" is busy true
xdotool mousemove 640 440
xdotool mousedown 2
for i in $(seq 2000); do
  xdotool mousemove_relative -- $(((i / 30) % 2 ? -6 : 6)) $((i % 3 - 1))
  sleep 0.02
  if is busy false; then break; fi
done
xdotool mouseup 2
until_true "the tree" is is_current true
close_window
cat "$folder/studio.txt"
[ "$idle" -le $((5 * $(getconf CLK_TCK) * 2 / 100)) ] || fail "the idle window is busy"
cpu=$(sed -n 's/.*"orbiting": {[^}]*"cpu_ms": \([0-9]*\).*/\1/p' "$folder/studio.txt")
[ -n "$cpu" ] || fail "no frames while orbiting"
own=$(sed -n 's/.*"while_jobs_run": {[^}]*"own_max_ms": \([0-9]*\).*/\1/p' "$folder/studio.txt")
[ -n "$own" ] || fail "no frames while a job ran"
[ "$own" -le 100 ] || fail "the window's thread works $own ms in a frame while a job runs"
[ "$cpu" -le 100 ] || fail "a frame costs $cpu ms of processor time"
echo "ok: $cpu ms of processor time a frame"
