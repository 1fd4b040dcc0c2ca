#!/usr/bin/env bash
# The result drawn ray by ray looks like its triangles: whole, with a literal picked, and cut open.
# Usage: exact.sh STUDIO PICTURE_TOOL FOLDER MESH...
# The pictures stay in FOLDER.
set -euo pipefail
studio=$1 tool=$2 folder=$3
. "$(dirname "$0")/driving.sh"
with_screen 1280x800 "$@"
shift 3
rm -rf "$folder"
mkdir -p "$folder/state/hewn"
export XDG_STATE_HOME=$folder/state
cd "$folder"

# both NAME: the same view ray by ray and as triangles, compared block by block.
both() {
  until_true "the exact picture" is is_exact true
  picture "$1-exact"
  key e  # never
  until_true "triangles" is is_exact false
  picture "$1-triangles"
  "$tool" match "$1-exact.png" "$1-triangles.png" || fail "$1: the two pictures differ"
  key e e  # automatic, then always
}

for mesh in "$@"; do
  name=$(basename "$mesh" .off)
  echo '{"hints": false, "exact": 1}' >"$folder/state/hewn/studio.json"
  open_window "$mesh" --no-live
  until_true "the groups" is ready true
  key ctrl+r
  until_true "the tree" is is_current true
  until_true "its picture" is has_view true
  key r
  both "$name-whole"
  # A literal of the outline: the rest fades.
  for y in $(seq 290 17 600); do
    click 1150 "$y"
    if soon is_picked; then break; fi
  done
  is_picked || fail "no literal in the outline"
  both "$name-picked"
  key c
  both "$name-section"
  # Over the part the rays also tell what is under the mouse.
  key c c c Escape
  xdotool mousemove 620 460
  until_true "a literal under the mouse" at_least hovered_literal 0
  close_window
done
echo "ok: $(find . -maxdepth 1 -name '*-exact.png' | wc -l) exact pictures"
