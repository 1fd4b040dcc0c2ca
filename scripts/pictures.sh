#!/usr/bin/env bash
# Makes the README's pictures: of parts by the command, of the studio with real events on a screen of
# its own.
# Usage: scripts/pictures.sh [FOLDER]; docs/pictures when left out. Needs a build.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
into=$(realpath -m "${1:-$root/docs/pictures}")
studio=$root/build/bin/hewn-studio
. "$root/tests/ui/driving.sh"
with_screen 1280x800 "$into"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/state/hewn" "$into"
export XDG_STATE_HOME=$folder/state
cd "$folder"

for part in bracket.off elbow.off clevis.off housing.stl; do
  "$root/build/bin/hewn" reconstruct "$root/assets/$part" -o tree.scad \
    --picture "$into/${part%.*}.png" >/dev/null
done

open_part() {
  echo '{"hints": false}' >"$folder/state/hewn/studio.json"
  cp "$root/assets/$1" "$folder/"
  open_window "$1" --no-live
  until_true "the groups" is ready true
}
# pick_in_graph TEXT: clicks down the graph until a literal is picked that begins with TEXT.
pick_in_graph() {
  local page y
  for page in 1 2 3 4; do
    for y in $(seq 280 14 550); do
      click 1150 "$y"
      sleep 0.2
      if begins picked "$1"; then return 0; fi
    done
    drag 1000 300 1000 400 2
  done
  fail "no literal in the graph begins with $1"
}

open_part housing.stl
scan hovered_text "cylinder r 5" 480 290 560 400 20
click $(xdotool getmouselocation --shell | sed -n 's/^[XY]=//p' | tr '\n' ' ')
until_true "a boss" is selected 1
key shift+s
until_true "the others" is selected 4
leave_view
take "$into/studio-select.png"
key Escape
until_true "no selection" is selected 0
key k
drag 568 330 566 590
until_true "a plane" is has_plane true
leave_view
take "$into/studio-knife.png"
key Escape
close_window

open_part bracket.off
key ctrl+r
until_true "the tree" is is_current true
until_true "its picture" is has_view true
click 1050 251
pick_in_graph "cylinder r 8"
drag 1000 500 1000 380 2
xdotool mousemove 1200 396
key e  # every ray; last, because such a frame may take a second
until_true "every ray" is is_exact true
take "$into/studio-result.png"
close_window

open_part housing.stl
key ctrl+r
until_true "the tree" is is_current true
key ctrl+shift+r
until_true "other trees" at_least results 3
until_true "all of them" is_idle
click 1108 251
key ctrl+t
key ctrl+2
key i
leave_view
take "$into/studio-pareto.png"
close_window
echo "wrote the pictures in $into"
