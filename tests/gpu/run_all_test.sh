#!/usr/bin/env bash
# run_all_test.sh: tests run_all.sh for machines that are not here. Stand-ins for the driver's and the toolkit's programs, for cmake and for
# its outputs print the same text; nothing is built, and nothing runs on a GPU.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0 tried=0

check() {
  local what=$1
  shift
  tried=$((tried + 1))
  "$@" && return
  printf '%s: not so\n' "$what"
  failed=$((failed + 1))
}
says() { grep -qF -- "$1" "$folder/out/gpu-results.md"; }
says_not() { ! says "$1"; }
ended() { [[ $code -eq $1 ]]; }
# before A B: the step A began before the step B.
before() { [[ $(grep -n "^--- $1:" "$folder/log" | cut -d: -f1) -lt $(grep -n "^--- $2:" "$folder/log" | cut -d: -f1) ]]; }

stand_in() {
  cat >"$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}
# machine: makes a tree and stand-ins with which everything works: one H100.
machine() {
  rm -rf "$folder/bin" "$folder/tree" "$folder/out"
  mkdir -p "$folder/bin" "$folder/tree/tests" "$folder/tree/cmake"
  cp -r "$root/tests/gpu" "$folder/tree/tests/"
  cp -r "$root/resources" "$folder/tree/"
  mkdir -p "$folder/tree/tests/gui"
  printf '#!/bin/sh\n' >"$folder/tree/cmake/install-packages.sh"
  chmod +x "$folder/tree/cmake/install-packages.sh"
  stand_in nvcc <<<'#!/bin/sh
echo "Cuda compilation tools, release 12.4, V12.4.99"'
  gpus 'NVIDIA H100 PCIe, 9.0, 81559 MiB' Disabled
  stand_in compute-sanitizer <<<'#!/bin/sh
echo "[       OK ] Cuda.SameBitsOnTheZoo (3 ms)"
echo "========= ERROR SUMMARY: 0 errors"'
  stand_in ctest <<<'#!/bin/sh
echo "100% tests passed, 0 tests failed out of 12"'
  cuda_line='toolkit 12.4, compiled for 90-real;75-virtual'
  say 'usable, NVIDIA H100' 'drawn from the device'
  make_cmake
}
# say CUDA DRAWN: sets the output about the cuda backend of the program that is built or bundled, and that of its tests about drawing.
say() {
  cat >"$folder/program" <<END
#!/bin/sh
case "\$*" in
  info) printf 'backends\n  cpu    usable\n  cuda   %s\n\nformats\n' "$1" ;;
  *--gtest_list_tests*) printf 'Cuda.\n  One\n  Two  # of a device\n' ;;
  *) echo "[       OK ] Cuda.One (1 ms)"; echo "cuda with interop"; echo "$2"; echo "\$*" ;;
esac
END
  chmod +x "$folder/program"
}
# make_cmake: makes a stand-in that configures with $cuda_line, and builds programs with short output.
make_cmake() {
  stand_in cmake <<END
#!/bin/sh
if [ "\$1" = --build ]; then
  mkdir -p "\$2/tests"
  for p in tests/test_gpu tests/test_gui dmoscope; do cp "$folder/program" "\$2/\$p"; done
  exit 0
fi
while [ "\$1" != -B ]; do shift; done
mkdir -p "\$2"; : >"\$2/build.ninja"
echo "-- CUDA: $cuda_line"
case "$cuda_line" in *compiled*) printf 'build test_gui: phony\n' >"\$2/build.ninja" ;; esac
END
}
# gpus LINE MIG [LINE...]: sets the output of nvidia-smi.
gpus() {
  local first=$1 mig=$2
  shift 2
  stand_in nvidia-smi <<END
#!/bin/sh
case "\$*" in
  *" -lms "*) while :; do echo "0, 1755 MHz, 1755 MHz, 1593 MHz, 300 W, 350 W, 40, 99 %"; sleep 1; done ;;
  *compute_cap*) printf '%s\n' "$first" "\$@" | sed '\$d' >/dev/null; printf '%s\n' "$first"$(printf ' "%s"' "$@") ;;
  *mig.mode*) echo $mig ;;
  *driver_version*) echo 550.54 ;;
  *) echo "a table" ;;
esac
END
}
# run [VARIABLE=VALUE...] [-- OPTION...]: runs run_all.sh on the stand-ins.
run() {
  local settings=()
  while [[ $# -gt 0 && $1 != -- ]]; do settings+=("$1"); shift; done
  [[ $# -gt 0 ]] && shift
  code=0
  env -u DISPLAY -u WAYLAND_DISPLAY CUDA_HOME="$folder/none" PATH="$folder/bin:/usr/bin:/bin" "${settings[@]}" "$folder/tree/tests/gpu/${script:-run_all.sh}" --commit abc --out "$folder/out" "$@" \
    >"$folder/log" 2>&1 || code=$?
}

machine
run
check "all is well" ended 0
check "the GPU is named" says 'NVIDIA H100 PCIe, 9.0'
check "commit, driver, toolkit" says '| commit | abc |'
check "driver" says '| driver | 550.54 |'
check "toolkit" says '| CUDA toolkit | 12.4 |'
check "what CUDA was compiled for" says 'compiled for 90-real;75-virtual'
check "bits are compared before anything is measured" before bits bench-warm
check "speed is measured before all tests" before bench-warm tests
check "and before the sanitizers" before bench compute-sanitizer
check "every test is a process of its own" says '| tests that need a GPU | 2 passed, 0 failed, 0 skipped of 2 |'
check "from the mesh to the mesh" says '--repeats 9 --end-to-end'
check "tests of drawing are run" says "| tests of drawing from the GPU's memory | 1 passed"
check "the window is told of" says '| a window (glx) | not run: DISPLAY is not set |'
check "sanitizers" says 'ERROR SUMMARY: 0 errors'
check "clocks" says '1755 MHz'

run DISPLAY=:7 WAYLAND_DISPLAY=wayland-7
check "a window by GLX" says '| a window (glx) | cuda with interop |'
check "a window by Wayland" says '| a window (wayland) | cuda with interop |'

machine
cuda_line='toolkit 11.8 (/usr/bin/nvcc) is too old, 12.0 or later is needed; built without the cuda backend'
make_cmake
run
check "CUDA 11: fails" ended 1
check "CUDA 11: says why" says 'is too old, 12.0 or later is needed'
check "CUDA 11: stops" says '**NOT RUN**: CUDA was left out of the build'
check "CUDA 11: builds nothing" test ! -e "$folder/tree/build/gpu/dmoscope"
cuda_line='toolkit 12.4 (/usr/bin/nvcc) takes no C++ compiler that is here; built without the cuda backend. It says: unsupported GNU version!'
make_cmake
run
check "refused g++: says why" says 'unsupported GNU version!'
check "refused g++: fails" ended 1
machine
cuda_line='toolkit 12.0, compiled for 75-virtual;90-virtual; the toolkit does not know compute capability 12.0'
make_cmake
run
check "a new GPU: goes on, and says so" says 'does not know compute capability 12.0'
check "a new GPU: passes" ended 0

machine
gpus 'NVIDIA H100 PCIe, 9.0, 81559 MiB' Enabled
run
check "MIG is told" says '(MIG)'
gpus 'NVIDIA A100, 8.0, 40960 MiB' Disabled B C D E F G H
run
check "eight GPUs are told" says '8 GPUs: the program takes the one with most memory that works'

machine
stand_in nvidia-smi <<<'#!/bin/sh
echo "NVIDIA-SMI has failed because it could not communicate with the NVIDIA driver."
exit 9'
say 'not usable: no NVIDIA driver is installed' ''
run
check "no driver: says why" says '**NOT RUN**: not usable: no NVIDIA driver is installed'
check "no driver: measures nothing" says_not 'bench'
check "no driver: fails" ended 1
check "no driver: the file says that there was no GPU" says 'NO GPU: NOTHING HERE WAS RUN ON ONE'

machine
rm "$folder/bin/compute-sanitizer"
run
check "no sanitizer: fails" ended 1
check "no sanitizer: says so" says '**NOT RUN**: it is not installed'
machine
stand_in ctest <<<'#!/bin/sh
echo " 1/2 Test #1: Cuda ....***Skipped"
echo " 2/2 Test #2: Cuda ....***Skipped"
echo "100% tests passed, 0 tests failed out of 2"'
run
check "all tests skipped: fails" ended 1
check "all tests skipped: says so" says '**NOTHING RAN**'
machine
stand_in ncu <<<'#!/bin/sh
[ "$1 $2" = "--clock-control none" ] || exit 4
exit 3'
run
check "a step that fails is told" says '| ncu | **FAILED**: exit code 3 |'
check "and the next are run" says '| tests that need a GPU | 2 passed'
machine
say 'usable, NVIDIA H100' 'drawn through the host'
run
check "no interop: fails, though the tests of its fallback pass" ended 1
check "no interop: says so" says "Nothing was drawn from the device's memory"

# A limit is for the whole, and the remaining time is never zero or less.
machine
run -- --limit 2
check "a limit: what was cut is told" says '**NOT RUN**: CUDA was left out of the build'
run -- --limit 2 --build "$folder/tree/build/gpu"
check "a limit: of a build that is there" says 'out of time'
run -- --limit soon
check "a limit is a number" ended 2
stand_in compute-sanitizer <<<'#!/bin/sh
sleep 60'
SECONDS=0
run -- --limit 12  # enough for all before them on a busy machine
check "a limit: the sanitizers keep to it" test "$SECONDS" -lt 40
check "a limit: and are told" says '| compute-sanitizer memcheck |'

# A bundle that was built elsewhere: nothing is built.
bundle() {
  machine
  stand_in cmake <<<'#!/bin/sh
echo "cmake was asked" >&2
exit 5'
  mkdir -p "$folder/bundle/bin" "$folder/bundle/lib/glvnd"
  for p in dmoscope test_gpu test_gui; do cp "$folder/program" "$folder/bundle/bin/$p"; done
}
bundle
run -- --bundle "$folder/bundle"
check "a bundle: all is well" ended 0
check "a bundle: nothing is built" says_not build
check "a bundle: is measured" says '| bench, warm | done |'
check "a bundle: is tested" says '| tests that need a GPU | 2 passed'
run -- --bundle "$folder/none"
check "a bundle that is not there" ended 2

# A bundle that is packed.
bundle
mkdir "$folder/tree/.prebuilt" "$folder/bundle/authors"
cp "$folder/program" "$folder/bundle/authors/driver"
tar -cJ -C "$folder/bundle" -f "$folder/tree/.prebuilt/programs.tar.xz" .
echo def >"$folder/tree/.prebuilt/commit"
script=prebuilt/run.sh
run
check "packed programs: all is well" ended 0
check "packed programs: the authors' kernel is measured" says "| the authors' kernel | done |"
rm -r "$folder/bundle/bin/dmoscope"
printf '#!/bin/sh\nexit 126\n' >"$folder/bundle/bin/dmoscope"
chmod +x "$folder/bundle/bin/dmoscope"
tar -cJ -C "$folder/bundle" -f "$folder/tree/.prebuilt/programs.tar.xz" .
make_cmake
run
check "packed programs that do not start: they are built there" says '| build | done |'
rm "$folder/tree/.prebuilt/programs.tar.xz"
run
check "nothing packed" ended 2

printf '%d answers, %d wrong\n' "$tried" "$failed"
[[ $failed -eq 0 ]]
