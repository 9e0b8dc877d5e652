#!/usr/bin/env bash
# run.sh [OPTION...]: on the machine with the GPU, in a tree that has .prebuilt (prepare.sh): unpacks it and runs run_all.sh with it.
# OPTION: run_all.sh's. Where the programs do not start on that machine they are built there, if it has a compiler and the tree .headers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
[[ -f .prebuilt/programs.tar.xz ]] || { echo "run.sh: there is no .prebuilt/programs.tar.xz; prepare.sh makes it" >&2; exit 2; }
bundle=${UNPACKED:-$(mktemp -d)}
if [[ ! -x $bundle/bin/dmoscope ]]; then
  mkdir -p "$bundle"
  # Python reads the archive if there is no xz.
  tar -xJ -C "$bundle" -f .prebuilt/programs.tar.xz 2>/dev/null ||
    python3 -c 'import sys, tarfile; tarfile.open(sys.argv[1]).extractall(sys.argv[2])' .prebuilt/programs.tar.xz "$bundle"
fi
options=(--commit "$(cat .prebuilt/commit)")
if [[ -x $bundle/authors/driver ]]; then options+=(--authors "$bundle/authors/driver"); fi
if "$bundle/bin/dmoscope" --version >/dev/null; then
  options+=(--bundle "$bundle")
else
  echo "What was built elsewhere does not start here: it is built here."
fi
exec tests/gpu/run_all.sh "${options[@]}" "$@"
