#!/usr/bin/env bash
# no_driver_needed.sh PROGRAM: checks that the program needs no library of CUDA's to start, and that without a driver info tells why cuda is
# not used.
set -euo pipefail
program=$1

libraries=$(ldd "$program")
if grep -E 'libcuda|libcudart|libnv' <<<"$libraries"; then
  echo "The program would not start on a machine without these."
  exit 1
fi

# A machine without a device, which this variable simulates on one that has some.
told=$(CUDA_VISIBLE_DEVICES='' "$program" info)
grep -i 'cuda' <<<"$told"
if ! grep -qE 'cuda .*(built without a CUDA toolkit|no usable CUDA device: .+|no CUDA device found)' <<<"$told"; then
  echo "info does not say why the cuda backend cannot be used."
  exit 1
fi
