# shellcheck shell=bash
# The steps of run_all.sh, which sources this file and sets out, home, program, tests: running, judging and reporting a step, and the file
# of results, written anew after each.
results=() remarks=() shown=() broken=0 status=0 all_seconds=0 watcher=''

# told NAME RESULT: notes how a step ended.
told() {
  results+=("| $1 | $2 |")
  printf '    %s: %s\n' "$1" "$2"
  write_results
}
# remark SENTENCE: notes a fact about the machine for readers of the figures.
remark() {
  remarks+=("$1")
  printf '%s.\n' "$1"
}

# limit_of SECONDS: prints that, or the remaining time, or nothing if too little remains.
limit_of() {
  local left=$((all_seconds - SECONDS))
  if [[ $all_seconds -eq 0 || $1 -lt $left ]]; then echo "$1"; elif [[ $left -gt 3 ]]; then echo "$left"; fi
}

# step NAME SECONDS COMMAND...: runs it with a limit, its output in $out/NAME.log; sets `status`. Shows the log's end if it fails.
step() {
  local name=$1 limit
  limit=$(limit_of "$2")
  shift 2
  printf -- '--- %s: %s\n' "$name" "$*"
  status=124
  if [[ -n $limit ]]; then
    status=0
    timeout -k 5 "$limit" "$@" >"$out/$name.log" 2>&1 </dev/null || status=$?
  else
    echo "no time was left" >"$out/$name.log"
  fi
  if [[ $status -ne 0 ]]; then
    broken=$((broken + 1))
    tail -n 25 "$out/$name.log" | sed 's/^/    /'
  fi
}

# outcome: prints how the last step ended, in words.
outcome() {
  case $status in
    0) echo "done" ;;
    124 | 137) echo "**FAILED**: out of time" ;;
    *) echo "**FAILED**: exit code $status" ;;
  esac
}

# measure NAME SECONDS TITLE ARGUMENT...: runs `dmoscope bench` with these arguments; its output is shown in the file.
measure() {
  local name=$1 seconds=$2 title=$3
  shift 3
  step "$name" "$seconds" "$program" bench "$@"
  shown+=("$name|dmoscope bench $*")
  told "$title" "$(outcome)"
}

# test_each TITLE NAME SECONDS PROGRAM FILTER: runs each of its tests in a process of its own, eight at a time, so that one that loses the
# device spoils no other. Tests that did not pass are listed in the file; no passed test at all is a failure, for here there should be a
# GPU.
test_each() {
  local title=$1 name=$2 seconds=$3 test=$tests/$4 list passed failed skipped
  list=$(env -C "$home" "$test" --gtest_list_tests --gtest_filter="$5" 2>/dev/null | awk '/^[^ ]/ { suite = $1 } /^  / { print suite $1 }')
  # shellcheck disable=SC2016
  step "$name" "$seconds" xargs -P 8 -I{} -a <(printf '%s\n' "$list") env -C "$home" bash -c '
    said=$("$0" --gtest_brief=1 --gtest_filter="$1" 2>&1); code=$?
    if grep -q SKIPPED <<<"$said"; then word=skipped; elif [[ $code -eq 0 ]]; then word=passed; else word=FAILED; fi
    echo "$word $1"; [[ $word == passed ]] || tail -n 15 <<<"$said" | sed "s/^/    /"; [[ $word != FAILED ]]' "$test" {}
  passed=$(grep -c '^passed' "$out/$name.log") failed=$(grep -c '^FAILED' "$out/$name.log") skipped=$(grep -c '^skipped' "$out/$name.log")
  [[ $passed -gt 0 || $status -ne 0 ]] || { broken=$((broken + 1)); status=1; }
  # Tests that timeout ended print no line of their own.
  told "$title" "$passed passed, $failed failed, $skipped skipped of $(wc -l <<<"$list")$([[ $status -eq 0 ]] || echo "; $(outcome)")$(sed -n 's/^FAILED \(.*\)/; \1/p' "$out/$name.log" | head -20 | tr -d '\n')"
}

# tests_of LOG: prints "12 passed, 1 failed, 3 skipped", from ctest's or GoogleTest's output.
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

# told_tests NAME STEP: notes how a step's tests ended; it is a failure if all were skipped.
told_tests() {
  local found
  found=$(tests_of "$out/$2.log")
  if [[ $found == "0 passed, 0 failed, "* && $status -eq 0 ]]; then
    broken=$((broken + 1))
    found="$found; **NOTHING RAN**"
  fi
  told "$1" "$found$([[ $status -eq 0 ]] || echo "; $(outcome)")"
}

# use_bundled_libraries BUNDLE: adds OpenGL's and EGL's loaders if the machine has none of its own, and NVRTC if it is not on the loader's
# path.
use_bundled_libraries() {
  local folder vendor=/usr/local/nvidia/share/glvnd/egl_vendor.d/10_nvidia.json
  ldconfig -p | grep -q libEGL.so.1 || LD_LIBRARY_PATH=$1/lib/glvnd${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  for folder in "${CUDA_HOME:-/usr/local/cuda}"/{lib64,targets/x86_64-linux/lib}; do
    if compgen -G "$folder/libnvrtc.so*" >/dev/null; then
      LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$folder
      break
    fi
  done
  export LD_LIBRARY_PATH=${LD_LIBRARY_PATH:-}
  if [[ -f $vendor ]] && ! compgen -G '/usr/share/glvnd/egl_vendor.d/*nvidia*' >/dev/null; then
    export __EGL_VENDOR_LIBRARY_FILENAMES=${__EGL_VENDOR_LIBRARY_FILENAMES:-$vendor}
  fi
}

# watch_gpu, unwatch_gpu: log, twice a second, the GPUs' clocks, power, temperature and use; once, the other processes on them.
watch_gpu() {
  command -v nvidia-smi >/dev/null || return 0
  nvidia-smi --query-compute-apps=pid,name,used_memory --format=csv >"$out/others.log" 2>&1
  nvidia-smi -q -d CLOCK,POWER,PERFORMANCE,COMPUTE >"$out/settings.log" 2>&1
  nvidia-smi --query-gpu=index,clocks.sm,clocks.max.sm,clocks.mem,power.draw,power.limit,temperature.gpu,utilization.gpu --format=csv -lms 500 \
    >"$out/clocks.log" 2>/dev/null &
  watcher=$!
}
unwatch_gpu() {
  [[ -n $watcher ]] || return 0
  kill "$watcher" 2>/dev/null
  wait "$watcher" 2>/dev/null
  watcher=''
}

# draw_in_window NAME VARIABLE OTHER: lets a window on the display that VARIABLE names step and draw on the GPU, if there is one. It reports
# how the mesh reaches the screen: by interop, or why not. A display whose OpenGL is another GPU's or the processor's is no failure.
draw_in_window() {
  if [[ -z ${!2:-} ]]; then
    told "a window ($1)" "not run: $2 is not set"
    return
  fi
  cat >"$out/window-$1.dmo" <<SCRIPT
generate grid 100000
backend cuda
step iteration 20
drawing-path
screenshot "$out/window-$1.png" --window
SCRIPT
  step "window-$1" 120 env -u "$3" "$program" script "$out/window-$1.dmo"
  told "a window ($1)" "$(if [[ $status -eq 0 ]]; then grep -E '^(cuda|cpu)' "$out/window-$1.log" | tail -1; else outcome; fi)"
}

# profile_search: reads the GPU's counters for one launch of the search, if ncu is installed. It leaves the clocks alone.
profile_search() {
  command -v ncu >/dev/null || { told "ncu" "not run: it is not installed"; return; }
  step ncu 120 ncu --clock-control none --set full --kernel-name-base demangled -k 'regex:Visit<.*Stars\)0' --launch-skip 1 --launch-count 1 \
    "$program" bench --backend cuda --sizes 1330000 --threads 0 --repeats 1
  grep -E 'Duration|SM Frequency|Registers Per|Occupancy|Executed Ipc|Issue Slots|No Eligible|One or More|Eligible Warps|Throughput|Hit Rate|Avg\. |stall|Est\. Speedup' \
    "$out/ncu.log" | cut -c1-140 >"$out/counters.log"
  shown+=("counters|ncu --clock-control none --set full, of one launch of the search for fans")
  told "ncu" "$(outcome)"
}

# sanitize: runs NVIDIA's compute-sanitizer over tests of small meshes, of all metrics for memory, of two for the rest; side by side, for
# nothing is measured.
sanitize() {
  local tools=(memcheck racecheck synccheck initcheck) small='*Cuda*.SameBitsOnTheZoo' sanitizer tool pids=() i log found summary limit
  declare -A subset=([memcheck]="$small/*:*Cuda*.GivesItsMemoryBack*:CudaDevice.*")
  for tool in "${tools[@]:1}"; do subset[$tool]="$small/meanratio:$small/minangle"; done
  sanitizer=$(command -v compute-sanitizer)
  limit=$(limit_of 900)
  if [[ -z $sanitizer || ! -x $tests/test_gpu || -z $limit ]]; then
    broken=$((broken + 1))
    told compute-sanitizer "**NOT RUN**: $(if [[ -z $sanitizer ]]; then echo "it is not installed"; elif [[ -z $limit ]]; then echo "no time was left"; else echo "there is no test_gpu"; fi)"
    return
  fi
  printf -- '--- compute-sanitizer: %s\n' "${tools[*]}"
  for tool in "${tools[@]}"; do
    timeout -k 5 "$limit" env -C "$home" "$sanitizer" --tool "$tool" --error-exitcode 9 "$tests/test_gpu" --gtest_filter="${subset[$tool]}" \
      >"$out/$tool.log" 2>&1 </dev/null &
    pids+=($!)
  done
  for i in "${!tools[@]}"; do
    status=0
    wait "${pids[i]}" || status=$?
    log=$out/${tools[i]}.log
    found=$(tests_of "$log")
    [[ $found != "0 passed, 0 failed, "* || $status -ne 0 ]] || status=1
    if [[ $status -ne 0 ]]; then
      broken=$((broken + 1))
      tail -n 25 "$log" | sed 's/^/    /'
    fi
    summary=$(grep -oE '(ERROR|RACECHECK) SUMMARY: .*' "$log" | tail -1)
    told "compute-sanitizer ${tools[i]}" "$found; ${summary:-no summary}$([[ $status -eq 0 ]] || echo "; $(outcome)")"
  done
}

# figures STEP COMMAND: prints a step's output, below the command.
figures() {
  [[ -s $out/$1.log ]] || return 0
  printf '\n`%s`\n\n```\n' "$2"
  cut -c1-250 "$out/$1.log"
  printf '```\n'
}
# clocks: prints the first, middle and last line of the log during the measurement, of the first GPU.
clocks() {
  [[ -s $out/clocks.log ]] || return 0
  printf '\nClocks, power and temperature of GPU 0 while it was measured: first line, middle line, last line of %d\n\n```\n' "$(wc -l <"$out/clocks.log")"
  sed -n 1p "$out/clocks.log"
  grep '^0,' "$out/clocks.log" | awk '{ line[NR] = $0 } END { print line[1]; print line[int((NR + 1) / 2)]; print line[NR] }'
  printf '```\n'
}

# write_results: writes gpu-results.md, from the results so far.
write_results() {
  local each
  {
    printf '## %s, %s\n\n' "$(date +%F)" "${gpu:-NO GPU: NOTHING HERE WAS RUN ON ONE}"
    printf '| what | |\n|---|---|\n| commit | %s |\n| driver | %s |\n| CUDA toolkit | %s |\n| processor | %s |\n| command | `tests/gpu/run_all.sh`%s, %d s so far |\n' \
      "$commit" "${driver:-none}" "${toolkit:-none}" "$processor" "${bundle:+ with a bundle}" "$SECONDS"
    printf '%s\n' "${results[@]}"
    if [[ ${#remarks[@]} -gt 0 ]]; then printf '\n%s.\n' "${remarks[@]}"; fi
    if [[ $(wc -l <<<"$gpus") -gt 1 ]]; then printf '\n```\n%s\n```\n' "$gpus"; fi
    if [[ -s $out/info.log ]]; then
      printf '\n`dmoscope info`\n\n```\n'
      sed -n '/^backends/,/^formats/{/^formats/d;p}' "$out/info.log"
      printf '```\n'
    fi
    if [[ -n $authors ]]; then figures authors tests/gpu/authors.sh; fi
    for each in "${shown[@]}"; do figures "${each%%|*}" "${each#*|}"; done
    clocks
    figures others "other processes on the GPU before measuring"
    figures settings "nvidia-smi -q -d CLOCK,POWER,PERFORMANCE,COMPUTE"
  } >"$out/gpu-results.md"
}

# finish: shows gpu-results.md and ends run_all.sh.
finish() {
  unwatch_gpu
  write_results
  printf '\n========== for tests/gpu/RESULTS.md; please send %s\n\n' "$out/gpu-results.md"
  cat "$out/gpu-results.md"
  printf '\n%d steps failed, %d s in all\n' "$broken" "$SECONDS"
  if [[ $broken -eq 0 ]]; then exit 0; else exit 1; fi
}
