#!/usr/bin/env bash
# nothing_lost.sh PROGRAM: tests that windows on a virtual display lose no work when they end unexpectedly. One is killed (SIGKILL) in a
# long run, and the next start recovers it; one gets SIGTERM; one is to be closed during a run, and asks. Recovered positions must have the
# bits of the same visits done elsewhere. Exits 77 (skipped) without Xvfb or xdotool.
set -euo pipefail
program=$1
for tool in xvfb-run Xvfb xauth xdotool; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export folder program XDG_CONFIG_HOME=$folder/config XDG_STATE_HOME=$folder/state DMOSCOPE_AUTOSAVE=1
unset WAYLAND_DISPLAY
"$program" generate block --size 200000 -o "$folder/mesh.off" >/dev/null 2>&1

cat >"$folder/person.sh" <<'PERSON'
set -euo pipefail
kept=$XDG_STATE_HOME/dmoscope/autosave
fail() { echo "$*"; [[ -z ${id:-} ]] || kill -9 "$id" 2>/dev/null || true; exit 1; }
until_true() { for _ in $(seq 600); do eval "$1" && return 0; sleep 0.1; done; fail "not within a minute: $1"; }
saved() { compgen -G "$kept/window-*.json" >/dev/null; }
# Reads the moment from the session itself: the note about it is written after it, and the kill may come between.
moment() { tr -d '\n ' <"$1" | grep -o '"moment":\[[0-9,]*' | head -n 1 | sed 's/.*\[//; s/,/ /g'; }
title() { xdotool getwindowname "$window" 2>/dev/null || true; }
# Presses Return again, for a dialog that a slow machine has not drawn yet receives no key.
enter_until() { for _ in $(seq 60); do eval "$1" && return 0; sleep 1; eval "$1" && return 0; press Return; done; fail "not within minutes: $1"; }
press() { xdotool key --window 0 "$@"; sleep 0.4; }
start() {  # opens a window; its process is $id, its window $window
  "$program" "$@" & id=$!
  window=$(timeout 60 xdotool search --sync --onlyvisible --pid "$id" --class dmoscope | head -n 1)
  xdotool windowfocus "$window"
  sleep 1
}
# Does the same visits elsewhere, without a window.
elsewhere() { printf 'open "%s"\nseek %s\nexport "%s"\n' "$folder/mesh.off" "$1" "$2" | "$program" script - >/dev/null; }

# A window that is killed in a long run.
start "$folder/mesh.off"
until_true '[[ $(title) == "mesh"*" – dmoscope" ]]'
press u
until_true saved
until_true '[[ $(title) == "• mesh"* ]]'
sleep 1
[[ $(ls "$kept"/window-*.lock | wc -l) -eq 1 ]] || fail "not one window's"
kill -9 "$id"; wait "$id" 2>/dev/null || true
n=$(moment "$kept"/window-*.dmoscope)
[[ $n != "0 0 0" ]] || fail "nothing was saved on the way"

# The next start offers recovery; Enter accepts it, and the result is exported.
start
enter_until '[[ $(title) == "• mesh"* ]]'
press ctrl+s
enter_until '[[ -s $folder/mesh-smoothed.off ]]'
until_true '[[ $(title) == "mesh"* ]]'
elsewhere "$n" "$folder/elsewhere.off"
cmp "$folder/mesh-smoothed.off" "$folder/elsewhere.off" || fail "moment $n is another one"
echo "killed at moment $n or later: recovered bit for bit"
until_true '! kill -0 "$id" 2>/dev/null || { sleep 1; press ctrl+q || true; false; }'  # without a window manager a key may be lost
wait "$id" || fail "the window ended with $?"
[[ -z $(ls "$kept") ]] || fail "a good end left $(ls "$kept")"

# A window that gets SIGTERM.
rm -f "$XDG_CONFIG_HOME/dmoscope/settings.json"
start "$folder/mesh.off"
until_true '[[ $(title) == "mesh"* ]]'
for key in n n n w; do press "$key"; done
until_true '[[ $(title) == "• mesh"* ]]'
kill -TERM "$id"
until_true '! kill -0 "$id" 2>/dev/null'
wait "$id" || fail "after SIGTERM the window ended with $?"
n=$(moment "$kept"/window-*.dmoscope)
[[ $n != "0 0 0" ]] || fail "SIGTERM saved nothing"
printf 'open-state "%s"\nexport "%s"\n' "$(ls "$kept"/window-*.dmoscope)" "$folder/term.off" | "$program" script - >/dev/null
elsewhere "$n" "$folder/again.off"
cmp "$folder/term.off" "$folder/again.off" || fail "SIGTERM saved another mesh"
grep -q '"wireframe": false' "$XDG_CONFIG_HOME/dmoscope/settings.json" || fail "SIGTERM lost the settings"
grep -q "\"$folder/mesh.off\"" "$XDG_STATE_HOME/dmoscope/recent.json" || fail "the recent files have no whole path"
echo "SIGTERM: moment $n is there bit for bit, settings are written"
rm -f "$kept"/*

# A window that is to be closed during a run.
start "$folder/mesh.off"
until_true '[[ $(title) == "mesh"* ]]'
press u
until_true '[[ $(title) == "• mesh"* ]]'
press ctrl+q
sleep 2
kill -0 "$id" 2>/dev/null || fail "Ctrl+Q gave a run up without a question"
press Escape
kill -0 "$id" 2>/dev/null || fail "Escape did not stay"
echo "closed in the midst of a run: asked, and Escape stays"
kill -9 "$id"; wait "$id" 2>/dev/null || true
PERSON
status=0
timeout 500 xvfb-run -a -s "-screen 0 1600x1000x24" bash "$folder/person.sh" || status=$?
exit "$status"
