#!/usr/bin/env bash
# idle.sh PROGRAM MESH [SECONDS]: measures an idle window. Opens MESH on a virtual display, once plainly and once with inspection, plots and
# labels, waits until it has settled, and reads the processor time that the process uses. Prints the share of one processor, in percent, and
# fails above 5 (a machine may be busy with other things; an idle window uses under 1). Exits 77 (skipped) without Xvfb or /proc.
set -euo pipefail
program=$1 mesh=$2 seconds=${3:-10}
for tool in xvfb-run Xvfb xauth xdotool; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
[[ -r /proc/self/stat ]] || { echo "skipped: no /proc"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME=$folder XDG_STATE_HOME=$folder
unset WAYLAND_DISPLAY

cat >"$folder/measure.sh" <<'MEASURE'
set -euo pipefail
program=$1 mesh=$2 seconds=$3 keys=$4
"$program" "$mesh" &
id=$!
ticks() { awk '{ print $14 + $15 }' "/proc/$id/stat"; }
sleep 3
if [[ -n $keys ]]; then
  window=$(timeout 20 xdotool search --sync --onlyvisible --class dmoscope | head -n 1)
  xdotool windowfocus "$window"
  for key in $keys; do xdotool key --window 0 "$key"; sleep 0.3; done
  sleep 3
fi
kill -0 "$id" || { echo "the program ended" >&2; exit 1; }
before=$(ticks) from=$(date +%s%N)
sleep "$seconds"
after=$(ticks) to=$(date +%s%N)
kill "$id"
wait "$id" 2>/dev/null || true
awk -v t="$((after - before))" -v hz="$(getconf CLK_TCK)" -v ns="$((to - from))" 'BEGIN { printf "%.2f\n", 100 * t / hz / (ns / 1e9) }'
MEASURE

for keys in "" "n g F6 Escape"; do
  share=$(timeout 300 xvfb-run -a -s "-screen 0 1600x1000x24" bash "$folder/measure.sh" "$program" "$mesh" "$seconds" "$keys" | tail -n 1) || { echo "not measured"; exit 1; }
  echo "idle${keys:+, after the keys $keys}: $share % of a processor"
  awk -v share="$share" 'BEGIN { exit !(share < 5) }' || { echo "an idle window works"; exit 1; }
done
