#!/usr/bin/env bash
# no_driver_needed.sh PROGRAM: the program needs no library of CUDA's to start, and where there is no driver, info says why cuda is not used.
set -euo pipefail
program=$1

libraries=$(ldd "$program")
if grep -E 'libcuda|libcudart|libnv' <<<"$libraries"; then
  echo "The program would not start on a machine without these."
  exit 1
fi

# No device is what a machine without one looks like, and what this variable makes of one that has some.
told=$(CUDA_VISIBLE_DEVICES='' "$program" info)
grep -i 'cuda' <<<"$told"
if ! grep -qE 'cuda .*(built without a CUDA toolkit|no usable CUDA device: .+|no CUDA device found)' <<<"$told"; then
  echo "info does not say why the cuda backend cannot be used."
  exit 1
fi
