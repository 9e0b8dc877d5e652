#!/usr/bin/env bash
# completion.sh PROGRAM: checks completions of bash by the program's own script; and, if zsh is installed, that it loads its script.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" --completion bash >"$work/bash"
"$program" --completion zsh >"$work/zsh"
# shellcheck disable=SC1091
source "$work/bash"

# completed WORD...: prints the completions of the last word.
completed() {
  COMP_WORDS=(dmoscope "$@")
  COMP_CWORD=$#
  _dmoscope
  printf '%s ' "${COMPREPLY[@]}"
}
# expect "WORDS" "WORD...": expects each of these among the completions.
expect() {
  local found word
  # shellcheck disable=SC2086
  found=" $(completed $2) "
  for word in $1; do [[ $found == *" $word "* ]] || { echo "'$2' is not completed to $word but to:$found" >&2; exit 1; }; done
}
expect "smooth script" "s"
expect "smooth" "smo"
expect "--metric --method --max-iterations" "smooth a.vtk --m"
expect "mean-ratio min-angle" "smooth a.vtk --metric m"
expect "slide" "smooth a.vtk --boundary s"
expect "best" "smooth --recipe b"
expect "coast can" "generate c"
expect "--output" "smooth --out"
[[ -z $(completed smooth a.vtk --output x | tr -d ' ') ]] || { echo "files are bash's to complete" >&2; exit 1; }
[[ $(completed smooth --order s) != *SEED* ]]
# Every option that --help names is completed.
for verb in smooth quality render convert generate compare script bench; do
  all=" $(completed "$verb" --) "
  for option in $("$program" "$verb" --help | grep -oE '^ +(-[a-z],)?--[a-z][a-z-]*' | grep -oE -- '--[a-z-]+'); do
    [[ $all == *" $option "* ]] || { echo "$verb: $option is not completed" >&2; exit 1; }
  done
done
if "$program" --completion tcsh 2>"$work/told"; then exit 1; fi
grep -q bash "$work/told"
if command -v zsh >/dev/null; then zsh -n "$work/zsh"; else echo "zsh is not here: its script was not tried"; fi
echo "the shell completes what --help tells"
