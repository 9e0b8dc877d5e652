#!/usr/bin/env bash
# run_all.sh [--out DIR] [--commit ID] [--bundle DIR] [--authors DIR]: all there is to try on a machine with a GPU, within nine minutes on one
# with 16 processor cores. Builds the preset gpu-bench for that GPU, runs the tests that need it, compute-sanitizer over those of small
# meshes, and measures; ends with a block for RESULTS.md. A step that fails is told and the next one is run; the exit code is 1 then.
#   --out      where logs, figures and the block go (build/gpu-results)
#   --commit   what is being tried, where git cannot tell
#   --bundle   a folder made by tools/bundle: its drawing from the GPU's memory is tried as well
#   --authors  a checkout or git folder of the paper's authors' code: their kernel is measured beside ours (authors.sh)
# A machine without Debian's packages needs .headers in the tree (tools/collect-headers).
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root" || exit 2
out=build/gpu-results commit='' bundle='' authors=''
while [[ $# -gt 0 ]]; do
  case $1 in
    --out) out=${2:?} ;;
    --commit) commit=${2:?} ;;
    --bundle) bundle=$(realpath "${2:?}") ;;
    --authors) authors=$(realpath "${2:?}") ;;
    *) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
  esac
  shift 2
done
readonly all_seconds=530
build=build/gpu-bench
mkdir -p "$out"
out=$(realpath "$out")
: "${commit:=$(git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)}"

results=() broken=0
# told NAME RESULT: notes how a step ended.
told() {
  results+=("| $1 | $2 |")
  printf '    %s\n' "$2"
}

# limit_of SECONDS: that, or what is left of the whole.
limit_of() {
  local left=$((all_seconds - SECONDS))
  echo $(($1 < left ? $1 : left))
}

# step NAME SECONDS COMMAND...: runs it with a limit, its output in $out/NAME.log; sets `status`. Shows the log's end when it fails.
step() {
  local name=$1 limit=$2
  shift 2
  limit=$(limit_of "$limit")
  printf -- '--- %s: %s\n' "$name" "$*"
  status=124
  if [[ $limit -gt 3 ]]; then
    status=0
    timeout -k 5 "$limit" "$@" >"$out/$name.log" 2>&1 || status=$?
  else
    echo "no time was left" >"$out/$name.log"
  fi
  if [[ $status -ne 0 ]]; then
    broken=$((broken + 1))
    tail -n 25 "$out/$name.log" | sed 's/^/    /'
  fi
}

# outcome: how the last step ended, in words.
outcome() {
  case $status in
    0) echo "done" ;;
    124 | 137) echo "**FAILED**: out of time" ;;
    *) echo "**FAILED**: exit code $status" ;;
  esac
}

# tests_of LOG: "12 passed, 1 failed, 3 skipped", of ctest's or GoogleTest's output.
tests_of() {
  local all failed skipped
  if grep -q 'tests passed,' "$1"; then
    read -r failed all < <(sed -nE 's/.*tests passed, ([0-9]+) tests? failed out of ([0-9]+).*/\1 \2/p' "$1")
    skipped=$(grep -cE '\*\*\*Skipped' "$1")
    echo "$((all - failed - skipped)) passed, $failed failed, $skipped skipped"
  else
    echo "$(grep -c '^\[       OK \]' "$1") passed, $(grep -cE '^\[  FAILED  \] .*\([0-9]+ ms\)' "$1") failed, $(grep -cE '^\[  SKIPPED \] .*\([0-9]+ ms\)' "$1") skipped"
  fi
}

# told_tests NAME STEP: notes how a step's tests ended; that all were skipped is a failure, for here there should be a GPU.
told_tests() {
  local tests
  tests=$(tests_of "$out/$2.log")
  if [[ $tests == "0 passed, 0 failed, "* && $status -eq 0 ]]; then
    broken=$((broken + 1))
    tests="$tests; **NOTHING RAN**"
  fi
  told "$1" "$tests$([[ $status -eq 0 ]] || echo "; $(outcome)")"
}

gpu=$(nvidia-smi --query-gpu=name,compute_cap,memory.total --format=csv,noheader 2>/dev/null | head -1)
driver=$(nvidia-smi --query-gpu=driver_version --format=csv,noheader 2>/dev/null | head -1)
nvcc=$(PATH=$PATH:/usr/local/cuda/bin command -v nvcc || echo nvcc)
toolkit=$("$nvcc" --version 2>/dev/null | sed -n 's/.*release \([0-9.]*\).*/\1/p')
processor="$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores"
[[ -n $gpu ]] || echo "No GPU is shown by nvidia-smi: what follows tries this script, and nothing on a GPU."

headers=()
if [[ ! -d .headers ]]; then
  echo "No .headers in the tree: taking the libraries from this machine's packages."
  headers=(-DDMOSCOPE_HEADERS=)
fi
# Meshes of others that the tests and the bench can use, where they are at hand.
shared=''
for folder in shared ../shared; do
  if [[ -z $shared && -d $folder/meshes ]]; then shared=$(realpath "$folder"); fi
done
step configure 60 cmake --preset gpu-bench -DDMOSCOPE_TESTS=ON ${shared:+"-DDMOSCOPE_SHARED=$shared"} "${headers[@]}"
[[ $status -eq 0 ]] || told configure "$(outcome)"
# -k 0: what can be built is, so that the steps below have something to try.
targets=(dmoscope test_gpu)
for folder in mesh quality search smooth session io cli; do
  if grep -qsE '^TEST.*\(Cuda' "tests/$folder"/*.cpp; then targets+=("test_$folder"); fi
done
step build 300 cmake --build "$build" --target "${targets[@]}" -- -k 0
told "build" "$(outcome)"

step tests 150 ctest --test-dir "$build" -L '^gpu(_host)?$' -j 4 --output-on-failure --no-tests=error
told_tests "tests (ctest -L gpu)" tests

# The sanitizers are slow: they get small meshes, of all metrics for memory, of two for the rest; and run side by side, for nothing is
# measured here.
sanitizer=$(PATH=$PATH:/usr/local/cuda/bin command -v compute-sanitizer)
tools=(memcheck racecheck synccheck initcheck)
small='*Cuda*.SameBitsOnTheZoo'
declare -A subset=([memcheck]="$small/*:*Cuda*.GivesItsMemoryBack*:CudaDevice.*")
for tool in "${tools[@]:1}"; do subset[$tool]="$small/meanratio:$small/minangle"; done
if [[ -z $sanitizer ]]; then
  told compute-sanitizer "**NOT RUN**: it is not installed"
  broken=$((broken + 1))
elif [[ ! -x $build/tests/test_gpu ]]; then
  told compute-sanitizer "**NOT RUN**: there is no test_gpu"
else
  printf -- '--- compute-sanitizer: %s\n' "${tools[*]}"
  pids=()
  for tool in "${tools[@]}"; do
    timeout -k 5 "$(limit_of 150)" "$sanitizer" --tool "$tool" --error-exitcode 9 \
      "$build/tests/test_gpu" --gtest_filter="${subset[$tool]}" >"$out/$tool.log" 2>&1 &
    pids+=($!)
  done
  for i in "${!tools[@]}"; do
    status=0
    wait "${pids[i]}" || status=$?
    log=$out/${tools[i]}.log
    tests=$(tests_of "$log")
    [[ $tests != "0 passed, 0 failed, "* || $status -ne 0 ]] || status=1
    if [[ $status -ne 0 ]]; then
      broken=$((broken + 1))
      tail -n 25 "$log" | sed 's/^/    /'
    fi
    summary=$(grep -oE '(ERROR|RACECHECK) SUMMARY: .*' "$log" | tail -1)
    told "compute-sanitizer ${tools[i]}" "$tests; ${summary:-no summary}$([[ $status -eq 0 ]] || echo "; $(outcome)")"
  done
fi

program=$build/dmoscope
step info 30 "$program" info
step bench 150 "$program" bench --backend cpu,cuda --sizes 1e4,1e5,1330000,1e7 --threads 0 --repeats 3
told "bench of generated meshes" "$(outcome)"
mesh=resources/samples/coast.14
[[ -f $shared/meshes/ocean/east.14 ]] && mesh=$shared/meshes/ocean/east.14
step bench-small 40 "$program" bench "$mesh" --backend cpu,cuda --threads 1 --iterations 1000 --repeats 3
told "bench of $(basename "$mesh")" "$(outcome)"

if [[ -n $bundle ]]; then
  step bundle-info 30 "$bundle/bin/dmoscope" info
  told "the bundle's info" "$(outcome)"
  step bundle-tests 90 env -C "$bundle" sh -c 'for t in bin/test_*; do "$t" --gtest_filter="Cuda*:*/Cuda*" || bad=1; done; exit ${bad:-0}'
  told_tests "the bundle's tests" bundle-tests
  step draw 60 "$bundle/bin/dmoscope" bench --draw 120 --backend cuda --sizes 1330000
  told "stepped and drawn" "$(outcome)"
fi
if [[ -n $authors ]]; then
  step authors 120 tests/gpu/authors.sh "$authors" "$out/authors" "$program"
  told "the authors' kernel" "$(outcome)"
fi

# The block for RESULTS.md.
figures() {
  [[ -s $out/$1.log ]] || return
  printf '\n`%s`\n\n```\n' "$2"
  cat "$out/$1.log"
  printf '```\n'
}
{
  printf '## %s, %s\n\n' "$(date +%F)" "${gpu:-NO GPU: NOTHING HERE WAS RUN ON ONE}"
  printf '| what | |\n|---|---|\n| commit | %s |\n| driver | %s |\n| CUDA toolkit | %s |\n| processor | %s |\n| command | `tests/gpu/run_all.sh`, %d s in all |\n' \
    "$commit" "${driver:-none}" "${toolkit:-none}" "$processor" "$SECONDS"
  printf '%s\n' "${results[@]}"
  printf '\n`dmoscope info`\n\n```\n'
  sed -n '/^backends/,/^formats/{/^formats/d;p}' "$out/info.log"
  printf '```\n'
  figures bench "dmoscope bench --backend cpu,cuda --sizes 1e4,1e5,1330000,1e7 --threads 0 --repeats 3"
  figures bench-small "dmoscope bench $(basename "$mesh") --backend cpu,cuda --threads 1 --iterations 1000 --repeats 3"
  [[ -n $bundle ]] && figures draw "dmoscope bench --draw 120 --backend cuda --sizes 1330000"
  [[ -n $authors ]] && figures authors "tests/gpu/authors.sh"
} >"$out/block.md"
printf '\n========== for tests/gpu/RESULTS.md (also in %s)\n\n' "$out/block.md"
cat "$out/block.md"
printf '\n%d steps failed, %d s in all\n' "$broken" "$SECONDS"
[[ $broken -eq 0 ]]
