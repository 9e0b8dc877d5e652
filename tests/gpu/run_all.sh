#!/usr/bin/env bash
# run_all.sh [OPTION...]: all there is to try on a machine with an NVIDIA GPU, in one command. Installs what the build lacks where it can,
# builds for that GPU, runs the tests that need one, measures, draws from the GPU's memory with and without a window, and ends with NVIDIA's
# compute-sanitizer. Writes one file, gpu-results.md, with all of it: please send it. A step that fails is told and the next one is run; the
# exit code is 1 then. Where CUDA was left out of the build it says why and stops.
#   --out DIR      where logs, figures and gpu-results.md go (build/gpu-results)
#   --commit ID    what is being tried, where git cannot tell
#   --build DIR    a build folder that is there already
#   --limit S      seconds for all of it; what comes last is cut (no limit)
#   --bundle DIR   a folder made by tools/bundle: its tests and drawing are tried as well
#   --authors DIR  a checkout or git folder of the paper's authors' code: their kernel is measured beside ours (authors.sh)
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
    *) sed -n '2,13s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
  esac
  shift 2
done
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
[[ -n $gpu ]] || echo "No GPU is shown by nvidia-smi: what follows tries this script, and nothing on a GPU."
if [[ $mig -gt 0 ]]; then remark "A GPU is split into parts (MIG): CUDA sees the first part alone, and OpenGL none"; fi
if [[ $(wc -l <<<"$gpus") -gt 1 ]]; then remark "$(wc -l <<<"$gpus") GPUs: the program takes the one with most memory that works; CUDA_VISIBLE_DEVICES chooses another"; fi

# Meshes of others that the tests and the bench can use, where they are at hand.
shared=''
for folder in shared ../shared; do
  if [[ -z $shared && -d $folder/meshes ]]; then shared=$(realpath "$folder"); fi
done

# --- build
if [[ -z $build ]]; then
  preset=release headers=()
  if [[ -d .headers ]]; then
    preset=gpu-bench
  else
    step install 600 cmake/install-packages.sh build test
    if [[ $status -ne 0 ]]; then told "install" "$(outcome): see $out/install.log; tools/collect-headers says how to do without"; fi
  fi
  build=build/gpu
  step configure 120 cmake --preset "$preset" -B "$build" -DDMOSCOPE_TESTS=ON -DDMOSCOPE_CUDA=ON -DDMOSCOPE_CUDA_ARCHITECTURES=native \
    ${shared:+"-DDMOSCOPE_SHARED=$shared"} "${headers[@]}"
  if [[ $status -ne 0 ]]; then told configure "$(outcome)"; fi
  said=$(sed -n 's/^-- CUDA: //p' "$out/configure.log")
  told "CUDA in the build" "$(paste -sd' ' <<<"${said:-CMake said nothing}")"
  if ! grep -q 'compiled for' <<<"$said"; then
    broken=$((broken + 1))
    told "all else" "**NOT RUN**: CUDA was left out of the build"
    finish
  fi
  # -k 0: what can be built is, so that the steps below have something to try.
  targets=(dmoscope test_gpu)
  for folder in mesh quality search smooth session io cli render gui; do
    if grep -qsE '^TEST.*\(Cuda' "tests/$folder"/*.cpp && grep -qE "^(build tests/)?test_$folder[:, ]" "$build/build.ninja"; then
      targets+=("test_$folder")
    fi
  done
  step build 3600 cmake --build "$build" --target "${targets[@]}" -- -k 0
  told "build" "$(outcome)"
fi
program=$build/dmoscope

# --- tests
step tests 600 ctest --test-dir "$build" -L '^gpu(_host)?$' -j 4 --output-on-failure --no-tests=error
told_tests "tests of the GPU backend" tests
if [[ -x $build/tests/test_gui ]]; then
  step interop 300 "$build/tests/test_gui" --gtest_filter='Cuda*:*/Cuda*'
  told_tests "tests of drawing from the GPU's memory" interop
fi
step info 60 "$program" info

# --- speed. Nothing else runs meanwhile; clocks, power and whoever else is on the GPU are noted.
watch_gpu
step bench 600 "$program" bench --backend cpu,cuda --sizes 1e4,1e5,1330000,1e7 --threads 0 --repeats 3
told "bench of generated meshes" "$(outcome)"
# The first repeat is cold: kernels are loaded, clocks are low. "step" has the statistics, "seconds" the smoothing alone, "prepare" the copies.
step bench-cold 120 "$program" bench --backend cuda --sizes 1330000 --threads 0 --repeats 1 --json
told "bench, cold" "$(outcome)"
step bench-warm 300 "$program" bench --backend cuda --sizes 1330000 --threads 0 --repeats 9 --json
told "bench, warm" "$(outcome)"
step bench-volumes 300 "$program" bench --backend cpu,cuda --elements tetrahedra,hexahedra --sizes 1e5 --threads 0 --repeats 3
told "bench of volumes" "$(outcome)"
# A formula, a target, and the built-in metric that both stand for; a formula is compiled before its run begins.
step bench-formulas 300 "$program" bench --backend cpu,cuda --sizes 1330000 --threads 0 --repeats 3 \
  --metric 'mean-ratio,mean-ratio@input,formula:2*det/norm^2'
told "bench of a formula and a target" "$(outcome)"
mesh=resources/samples/coast.14
[[ -f $shared/meshes/ocean/east.14 ]] && mesh=$shared/meshes/ocean/east.14
step bench-small 120 "$program" bench "$mesh" --backend cpu,cuda --threads 1 --iterations 1000 --repeats 3
told "bench of $(basename "$mesh")" "$(outcome)"

# --- drawing
if [[ -x $build/tests/test_gui ]]; then
  step draw 180 "$program" bench --draw 120 --backend cpu,cuda --sizes 1330000
  told "stepped and drawn, without a window" "$(outcome)"
  draw_in_window glx DISPLAY WAYLAND_DISPLAY
  draw_in_window wayland WAYLAND_DISPLAY DISPLAY
fi
if [[ -n $bundle ]]; then
  step bundle-info 30 "$bundle/bin/dmoscope" info
  told "the bundle's info" "$(outcome)"
  step bundle-tests 90 env -C "$bundle" sh -c 'for t in bin/test_*; do "$t" --gtest_filter="Cuda*:*/Cuda*" || bad=1; done; exit ${bad:-0}'
  told_tests "the bundle's tests" bundle-tests
  step bundle-draw 60 "$bundle/bin/dmoscope" bench --draw 120 --backend cuda --sizes 1330000
  told "the bundle, stepped and drawn" "$(outcome)"
fi
if [[ -n $authors ]]; then
  step authors 300 tests/gpu/authors.sh "$authors" "$out/authors" "$program"
  told "the authors' kernel" "$(outcome)"
fi
unwatch_gpu
if command -v ncu >/dev/null; then
  step ncu 300 ncu --set basic --launch-skip 20 --launch-count 12 "$program" bench --backend cuda --sizes 1e6 --threads 0 --repeats 1
  told "ncu (occupancy and throughput of twelve launches)" "$(outcome)"
fi

# --- sanitizers, which are slow
sanitize
finish
