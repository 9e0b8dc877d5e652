#!/usr/bin/env bash
# real_window.sh PROGRAM MESH: tests the program on a virtual display. A script steps by command, key and click, takes pictures of the
# window and lets it close itself; one that fails ends with the failing line's exit code; and, with xdotool, a window opened on a mesh takes
# real key presses, asks before it is closed, and has the same size the next time. Exits 77 (skipped) without Xvfb.
set -euo pipefail
program=$1 mesh=$2 tests=$(dirname "$(realpath "$0")")
for tool in xvfb-run Xvfb xauth; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME=$folder XDG_STATE_HOME=$folder
unset WAYLAND_DISPLAY

fail() { echo "$*"; exit 1; }
on_display() { timeout 120 xvfb-run -a -s "-screen 0 1600x1000x24" "$@"; }
png_size() { od -An -tu1 -j16 -N8 "$1" | awk '{ print $3 * 256 + $4 "x" $7 * 256 + $8 }'; }

cat >"$folder/smoke.txt" <<SCRIPT
open "$mesh"
step iteration 2
expect iteration == 2
key N
expect iteration == 3
click step-iteration
expect iteration == 4
key Ctrl+Z
expect iteration == 3
drag 500 300 560 340
screenshot "$folder/window.png" --window
size 900 700
screenshot "$folder/small.png" --window
SCRIPT
status=0
on_display "$program" script "$folder/smoke.txt" || status=$?
[[ $status -eq 0 ]] || fail "the program ended with $status"
for picture in window small; do
  [[ $(head -c 8 "$folder/$picture.png" | od -An -tx1 | tr -d ' \n') == 89504e470d0a1a0a ]] || fail "no picture: $picture"
  # A window with a mesh in it does not shrink to a few bytes.
  [[ $(stat -c %s "$folder/$picture.png") -gt 10000 ]] || fail "the picture is empty: $picture"
done
[[ $(png_size "$folder/window.png") == 1280x800 ]] || fail "the window was $(png_size "$folder/window.png")"
[[ $(png_size "$folder/small.png") == 900x700 ]] || fail "after \"size 900 700\" the window was $(png_size "$folder/small.png")"

printf 'fit\nopen "%s/none.off"\nscreenshot "%s/never.png"\n' "$folder" "$folder" >"$folder/bad.txt"
status=0
on_display "$program" script "$folder/bad.txt" 2>"$folder/said" || status=$?
[[ $status -eq 3 ]] || fail "a file that is not there gave $status"
grep -q "bad.txt:2: .*none.off" "$folder/said" || fail "the failing line is not named: $(cat "$folder/said")"
[[ ! -e $folder/never.png ]] || fail "the script went on after its failing line"

command -v xdotool >/dev/null || { echo "no xdotool: keys of a person not tried"; exit 0; }
status=0
on_display bash "$tests/person_at_the_window.sh" "$program" "$mesh" || status=$?
[[ $status -eq 0 ]] || fail "a person's window ended with $status"
