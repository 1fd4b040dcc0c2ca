#!/usr/bin/env bash
# Remakes the sample meshes from their OpenSCAD sources, in the four formats that hewn reads.
# Needs: openscad. Usage: assets/make-meshes.sh
set -euo pipefail
cd "$(dirname "$0")"

staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT

# OpenSCAD writes OFF and STL; OBJ and PLY are rewritten from OFF.
render() { openscad -o "$2" "$1" >"$staging/log" 2>&1 || { cat "$staging/log" >&2; exit 1; }; }

off_to_obj() {
  awk 'NR == 1 { next_line = ($1 == "OFF" && NF > 1) ? 1 : 2 }
       NR == next_line { n = (NF > 3) ? $2 : $1; first = NR; next }
       NR > next_line && NF == 3 { print "v", $1, $2, $3; next }
       NR > next_line && $1 == 3 { print "f", $2 + 1, $3 + 1, $4 + 1 }' "$1"
}

off_to_ply() {
  awk 'NF == 3 && NR > 1 { vertex[nv++] = $1 " " $2 " " $3 }
       NF >= 4 && $1 == 3 && NR > 1 { face[nf++] = "3 " $2 " " $3 " " $4 }
       END {
         print "ply\nformat ascii 1.0"
         print "element vertex " nv "\nproperty double x\nproperty double y\nproperty double z"
         print "element face " nf "\nproperty list uchar int vertex_indices\nend_header"
         for (i = 0; i < nv; i++) print vertex[i]
         for (i = 0; i < nf; i++) print face[i]
       }' "$1"
}

for part in bracket flange elbow clevis; do render $part.scad $part.off; done
for part in housing shaft; do render $part.scad $part.stl; done
render knob.scad "$staging/knob.off"
off_to_ply "$staging/knob.off" >knob.ply
render slotted_plate.scad "$staging/slotted_plate.off"
off_to_obj "$staging/slotted_plate.off" >slotted_plate.obj
ls -l ./*.off ./*.stl ./*.ply ./*.obj
