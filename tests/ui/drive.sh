#!/usr/bin/env bash
# The program refuses displays that it cannot use; a tree asked for and exported while it is still
# being searched comes out as it does without a window.
# Usage: drive.sh STUDIO HEWN MESH FOLDER; the pictures of the steps stay in FOLDER.
set -euo pipefail
studio=$1 hewn=$2 mesh=$3 folder=$4
. "$(dirname "$0")/driving.sh"

# Without a display, or with too old an OpenGL, the program says so and ends with 1.
refuses() {
  local what=$1 code=0 said
  shift
  said=$("$@" 2>&1) || code=$?
  if [ "$code" != 1 ] || ! grep -q "$what" <<<"$said"; then
    echo "FAILED: expected exit code 1 and '$what', got $code: $said" >&2
    exit 1
  fi
}
[ -n "${HEWN_UI_INSIDE:-}" ] || refuses "no display" env -u DISPLAY -u WAYLAND_DISPLAY "$studio"
with_screen 1280x800 "$@"
refuses "OpenGL 4.3 is needed" env MESA_GL_VERSION_OVERRIDE=3.3 "$studio"

rm -rf "$folder"
mkdir -p "$folder/state/hewn"
export XDG_STATE_HOME=$folder/state
echo '{"hints": false}' >"$folder/state/hewn/studio.json"
cp "$mesh" "$folder/part.off"
cd "$folder"

open_window part.off --record "$folder/log.txt" --no-live
until_true "the groups" is ready true
click 475 330
until_true "a selected group" is selected 1
key shift+p
until_true "the partition" is partitions 1
key ctrl+z
until_true "undo" is partitions 0
key ctrl+shift+z
until_true "redo" is partitions 1

# The knife: a line across the part, then Enter.
key k
drag 600 150 600 760
until_true "a plane" is has_plane true
key Return
until_true "the cut" is cuts 1
key ctrl+z
until_true "the cut's undo" is cuts 0

key ctrl+r
until_true "the search" is busy true
key ctrl+e
until_true "the file panel" is has_file_panel true
write_over file_name "tree.scad"
key Return
until_true "the exported tree" test -s "$folder/tree.scad"
picture exported
close_window

mv tree.scad from-window.scad
"$hewn" replay log.txt || fail "the log does not replay"
cmp tree.scad from-window.scad || fail "the replayed tree differs"
grep -q 'difference' tree.scad || fail "no difference in the tree"
grep -q '"frames"' studio.txt || fail "no frame times"
echo "ok: $(wc -l <log.txt) commands"
