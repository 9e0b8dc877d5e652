#!/usr/bin/env bash
# run_all.sh [OPTION...]: all there is to try on a machine with an NVIDIA GPU, in one command. Installs what the build lacks where it can,
# builds for that GPU, checks that the GPU gives the processor's bits, measures, draws from the GPU's memory with and without a window, runs
# all tests that need a GPU, and ends with NVIDIA's compute-sanitizer. Writes one file, gpu-results.md, anew after every step: please send
# it. A failed step is reported and the next one is run; the exit code is 1 then. If CUDA was left out of the build, or the built program
# cannot use it, prints the reason and stops.
#   --out DIR      folder of logs, figures and gpu-results.md (build/gpu-results)
#   --commit ID    the commit that is tested, if git cannot tell
#   --build DIR    a build folder that is there already
#   --bundle DIR   a folder made by tools/bundle, tried in place of a build: nothing is built
#   --limit S      seconds for the whole; the last steps are cut (no limit)
#   --authors DIR  a checkout or git folder of the paper's authors' code, or the program that authors.sh made of it: their kernel is
#                  measured beside ours
# A machine without Debian's packages needs .headers in the tree (tools/collect-headers); there is no window then.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root" || exit 2
# shellcheck source=tests/gpu/steps.sh
source tests/gpu/steps.sh
out=build/gpu-results commit='' bundle='' authors='' build=''
while [[ $# -gt 0 ]]; do
  case $1 in
    --out) out=${2:?} ;;
    --commit) commit=${2:?} ;;
    --build) build=$(realpath "${2:?}") ;;
    --limit) all_seconds=${2:?} ;;
    --bundle) bundle=$(realpath "${2:?}") ;;
    --authors) authors=$(realpath "${2:?}") ;;
    *) sed -n '2,16s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
  esac
  shift 2
done
[[ $all_seconds =~ ^[0-9]+$ ]] || { echo "run_all.sh: --limit takes a number of seconds, not '$all_seconds'" >&2; exit 2; }
[[ -z $bundle || -x $bundle/bin/dmoscope ]] || { echo "run_all.sh: there is no bin/dmoscope in $bundle" >&2; exit 2; }
mkdir -p "$out"
out=$(realpath "$out")
: "${commit:=$(git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)}"
PATH=$PATH:${CUDA_HOME:-/usr/local/cuda}/bin

asks() { nvidia-smi --query-gpu="$1" --format=csv,noheader 2>/dev/null | grep -v 'NVIDIA-SMI has failed'; }
gpus=$(asks name,compute_cap,memory.total)
gpu=$(head -1 <<<"$gpus")
driver=$(asks driver_version | head -1)
mig=$(asks mig.mode.current | grep -c Enabled)
toolkit=$(nvcc --version 2>/dev/null | sed -n 's/.*release \([0-9.]*\).*/\1/p')
processor="$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores"
[[ -n $gpu ]] || echo "No GPU is shown by nvidia-smi."
if [[ $mig -gt 0 ]]; then remark "A GPU is split into parts (MIG): CUDA sees the first part alone, and OpenGL none"; fi
if [[ $(wc -l <<<"$gpus") -gt 1 ]]; then remark "$(wc -l <<<"$gpus") GPUs: the program takes the one with most memory that works; CUDA_VISIBLE_DEVICES chooses another"; fi

# Other people's meshes for the tests and the bench, if they are there.
shared=''
for folder in shared ../shared ${bundle:+"$bundle/shared"}; do
  if [[ -z $shared && -d $folder/meshes ]]; then shared=$(realpath "$folder"); fi
done

# --- build
if [[ -z $build && -z $bundle ]]; then
  preset=release
  if [[ -d .headers ]]; then
    preset=gpu-bench
  else
    step install 600 cmake/install-packages.sh build test
    if [[ $status -ne 0 ]]; then told "install" "$(outcome): see $out/install.log; tools/collect-headers says how to do without"; fi
  fi
  build=build/gpu
  step configure 120 cmake --preset "$preset" -B "$build" -DDMOSCOPE_TESTS=ON -DDMOSCOPE_CUDA=ON -DDMOSCOPE_CUDA_ARCHITECTURES=native \
    ${shared:+"-DDMOSCOPE_SHARED=$shared"}
  if [[ $status -ne 0 ]]; then told configure "$(outcome)"; fi
  said=$(sed -n 's/^-- CUDA: //p' "$out/configure.log")
  told "CUDA in the build" "$(paste -sd' ' <<<"${said:-CMake said nothing}")"
  if ! grep -q 'compiled for' <<<"$said"; then
    broken=$((broken + 1))
    told "all else" "**NOT RUN**: CUDA was left out of the build"
    finish
  fi
  # -k 0: builds as much as possible, so that the steps below have something to try.
  targets=(dmoscope test_gpu)
  if grep -qE '^(build tests/)?test_gui[:, ]' "$build/build.ninja"; then targets+=(test_gui); fi
  step build 3600 cmake --build "$build" --target "${targets[@]}" -- -k 0
  told "build" "$(outcome)"
fi
if [[ -n $bundle ]]; then
  program=$bundle/bin/dmoscope tests=$bundle/bin home=$bundle
  use_bundled_libraries "$bundle"
else
  build=$(realpath "$build")
  program=$build/dmoscope tests=$build/tests home=$root
fi

# --- function
step info 60 "$program" info
if ! grep -qE '^ +cuda +usable' "$out/info.log"; then
  broken=$((broken + 1))
  told "all else" "**NOT RUN**: $(sed -nE 's/^ +cuda +//p' "$out/info.log" | head -1 | grep . || outcome)"
  finish
fi
bits='CudaDevice.*:*/CudaDmo.SameBitsOnTheZoo/meanratio:*/CudaDmo.SameBitsOnALargeMesh/meanratio:*/CudaDmo.SameBitsOnTheBundledMeshes/*:*/CudaVolumeDmo.SameBits/meanratio'
test_each "the processor's bits" bits 60 test_gpu "$bits"

# --- speed. Nothing else runs meanwhile; clocks, power and other users of the GPU are noted.
watch_gpu
# The first repeat is cold: kernels are loaded, clocks are low. "step" has the statistics, "seconds" the smoothing alone, "prepare" the
# copies; "end to end" is all of it, the smoothed mesh back on the host.
measure bench-cold 120 "bench, cold" --backend cuda --sizes 1330000 --threads 0 --repeats 1 --end-to-end
measure bench-warm 120 "bench, warm" --backend cuda --sizes 1330000,1e7 --threads 0 --repeats 9 --end-to-end
if [[ -n $authors ]]; then
  step authors 300 tests/gpu/authors.sh "$authors" "$out/authors" "$program"
  told "the authors' kernel" "$(outcome)"
fi
mesh=resources/samples/coast.14
[[ -f $shared/meshes/ocean/east.14 ]] && mesh=$shared/meshes/ocean/east.14
measure bench-small 60 "bench of $(basename "$mesh")" "$mesh" --backend cpu,cuda --threads 1 --iterations 4 --repeats 25
measure bench-small-long 60 "bench of $(basename "$mesh"), a thousand iterations" "$mesh" --backend cpu,cuda --threads 1 --iterations 1000 --repeats 3
measure bench-volumes 120 "bench of volumes" --backend cpu,cuda --elements tetrahedra,hexahedra --sizes 1e5 --threads 0 --repeats 3
# A formula, a target, and the built-in metric that both stand for; a formula is compiled before its run begins.
measure bench-formulas 120 "bench of a formula and a target" --backend cuda --sizes 1330000 --threads 0 --repeats 3 \
  --metric 'mean-ratio,mean-ratio@input,formula:2*det/norm^2'

# --- drawing
if [[ -x $tests/test_gui ]]; then
  step interop 90 env -C "$home" "$tests/test_gui" --gtest_filter='Cuda*:*/Cuda*'
  # The path from the device's memory to the screen is to be tried on a GPU: without it the tests of its fallback would pass, too.
  if ! grep -q 'drawn from the device' "$out/interop.log"; then
    broken=$((broken + 1))
    remark "**Nothing was drawn from the device's memory**: $(sed -nE 's/^ +path +//p' "$out/info.log" | head -1)"
  fi
  told_tests "tests of drawing from the GPU's memory" interop
  measure draw 90 "stepped and drawn, without a window" --draw 120 --backend cpu,cuda --sizes 1330000
  draw_in_window glx DISPLAY WAYLAND_DISPLAY
  draw_in_window wayland WAYLAND_DISPLAY DISPLAY
fi
measure bench 300 "bench of generated meshes" --backend cpu,cuda --sizes 1e4,1e5,1330000 --threads 0 --repeats 3
unwatch_gpu
profile_search

# --- all other tests, without measurements
test_each "tests that need a GPU" tests 600 test_gpu 'Cuda*:*/Cuda*'
sanitize
if [[ -n $build ]]; then
  step host-tests 600 ctest --test-dir "$build" -L '^gpu_host$' -j 4 --output-on-failure --no-tests=error
  told_tests "tests of the backend that need no GPU" host-tests
fi
finish
