#!/usr/bin/env bash
# real_window.sh PROGRAM MESH: starts the true program on a virtual display, steps, takes a picture of the window, and lets it close
# itself. Exits 77 (skipped) where there is no Xvfb.
set -euo pipefail
program=$1 mesh=$2
for tool in xvfb-run Xvfb xauth; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/smoke.txt" <<SCRIPT
open "$mesh"
step iteration 2
expect iteration == 2
screenshot "$folder/window.png" --window
SCRIPT
status=0
env -u WAYLAND_DISPLAY timeout 120 xvfb-run -a -s "-screen 0 1280x800x24" "$program" script "$folder/smoke.txt" || status=$?
[[ $status -eq 0 ]] || { echo "the program ended with $status"; exit 1; }
# A PNG of some size: a window with a mesh in it does not shrink to a few bytes.
[[ $(head -c 8 "$folder/window.png" | od -An -tx1 | tr -d ' \n') == 89504e470d0a1a0a ]] || { echo "no picture"; exit 1; }
[[ $(stat -c %s "$folder/window.png") -gt 10000 ]] || { echo "the picture is empty"; exit 1; }
