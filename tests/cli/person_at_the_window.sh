#!/usr/bin/env bash
# person_at_the_window.sh PROGRAM MESH: a window opened on a mesh takes real key presses, asks before it is closed with unsaved work, saves
# settings and recent files at once, and has the same size the next time. Run by real_window.sh on a display of its own, with
# XDG_CONFIG_HOME and XDG_STATE_HOME in an empty folder. A display without a window manager may lose a key, and a busy machine is slow:
# every result is waited for, and keys are pressed again if it does not come.
set -u
program=$1 mesh=$2 tests=$(dirname "$(realpath "$0")")
id=0 window=""

fail() {
  echo "$*; its title: $(title)"
  kill "$id"
  exit 1
}
alive() { kill -0 "$id" 2>/dev/null; }
title() { xdotool getwindowname "$window"; }
# until_it WHAT [KEY ...]: waits until WHAT holds, pressing the keys again after some seconds in which it did not.
until_it() {
  local what=$1 key
  shift
  for _ in 1 2 3 4 5; do
    for key in "$@"; do
      xdotool windowfocus "$window" key --window 0 "$key" || true  # the window may be gone by now
      sleep 0.1
    done
    for _ in $(seq 30); do
      "$what" && return
      sleep 0.2
    done
  done
  return 1
}
opened() { [[ $(title) == *" – dmoscope" ]]; }
unsaved() { [[ $(title) == "• "* ]]; }
saved() { ! unsaved; }
closed() { ! alive; }
mesh_is_recent() { grep -q "\"$(realpath "$mesh")\"" "$XDG_STATE_HOME/dmoscope/recent.json"; }
no_wireframe_is_kept() { grep -q '"wireframe": false' "$XDG_CONFIG_HOME/dmoscope/settings.json"; }
is_1000x700() { xdotool getwindowgeometry "$window" | grep -q 'Geometry: 1000x700$'; }
open_window() {
  "$program" "$@" &
  id=$!
  window=$(timeout 60 xdotool search --sync --onlyvisible --class dmoscope | head -n 1)
}
stays() {
  sleep 1
  alive || { echo "$1"; exit 1; }
}

open_window "$mesh"
until_it opened || fail "the mesh did not open"
xdotool windowsize "$window" 1000 700
until_it unsaved n || fail "key N did no iteration, or the title does not tell it"
until_it no_wireframe_is_kept w || fail "settings wait for the window's end"
until_it mesh_is_recent || fail "the mesh is not among the recent files yet"
xdotool key --window 0 ctrl+q
stays "the window closed over an iteration that is in no file, without a question"
xdotool key --window 0 Escape  # answers no
sleep 0.5
python3 "$tests/ask_to_close.py" "$window"
stays "the button of its frame closed the window without a question"
# Back at the input there is nothing to lose.
until_it saved Escape r || fail "key R did not lead back to the input, or the title does not tell it"
until_it closed ctrl+q || fail "Ctrl+Q did not close the window"
wait "$id" || { echo "the window ended with $?"; exit 1; }

open_window
until_it is_1000x700 || fail "the window was left 1000x700 and is another size the next time"
kill "$id"
wait "$id" || true
