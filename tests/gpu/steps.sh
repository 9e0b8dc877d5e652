# shellcheck shell=bash
# The steps of run_all.sh, which sources this and sets out, build, program: how one is run, judged and told, and the file at the end.
results=() remarks=() broken=0 status=0 all_seconds=0 watcher=''

# told NAME RESULT: notes how a step ended.
told() {
  results+=("| $1 | $2 |")
  printf '    %s: %s\n' "$1" "$2"
}
# remark SENTENCE: what whoever reads the figures has to know of the machine.
remark() {
  remarks+=("$1")
  printf '%s.\n' "$1"
}

# limit_of SECONDS: that, or what is left of the whole.
limit_of() {
  local left=$((all_seconds - SECONDS))
  if [[ $all_seconds -eq 0 || $1 -lt $left ]]; then echo "$1"; else echo "$left"; fi
}

# step NAME SECONDS COMMAND...: runs it with a limit, its output in $out/NAME.log; sets `status`. Shows the log's end when it fails.
step() {
  local name=$1 limit
  limit=$(limit_of "$2")
  shift 2
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

# watch_gpu, unwatch_gpu: once a second, the GPUs' clocks, power, temperature and use; once, the other processes on them.
watch_gpu() {
  command -v nvidia-smi >/dev/null || return 0
  nvidia-smi --query-compute-apps=pid,name,used_memory --format=csv >"$out/others.log" 2>&1
  nvidia-smi -q -d CLOCK,POWER,PERFORMANCE,COMPUTE >"$out/settings.log" 2>&1
  nvidia-smi --query-gpu=index,clocks.sm,clocks.max.sm,clocks.mem,power.draw,power.limit,temperature.gpu,utilization.gpu --format=csv -l 1 \
    >"$out/clocks.log" 2>/dev/null &
  watcher=$!
}
unwatch_gpu() {
  [[ -n $watcher ]] || return 0
  kill "$watcher" 2>/dev/null
  wait "$watcher" 2>/dev/null
  watcher=''
}

# draw_in_window NAME VARIABLE OTHER: a window on the display that VARIABLE names steps and draws on the GPU, where there is one. It says how
# what is smoothed reaches the screen: by interop, or why not. A display whose OpenGL is another GPU's or the processor's is no failure.
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

# sanitize: NVIDIA's compute-sanitizer over tests of small meshes, of all metrics for memory, of two for the rest; side by side, for nothing
# is measured.
sanitize() {
  local tools=(memcheck racecheck synccheck initcheck) small='*Cuda*.SameBitsOnTheZoo' sanitizer tool pids=() i log tests summary
  declare -A subset=([memcheck]="$small/*:*Cuda*.GivesItsMemoryBack*:CudaDevice.*")
  for tool in "${tools[@]:1}"; do subset[$tool]="$small/meanratio:$small/minangle"; done
  sanitizer=$(command -v compute-sanitizer)
  if [[ -z $sanitizer || ! -x $build/tests/test_gpu ]]; then
    told compute-sanitizer "**NOT RUN**: $([[ -n $sanitizer ]] && echo "there is no test_gpu" || echo "it is not installed")"
    broken=$((broken + 1))
    return
  fi
  printf -- '--- compute-sanitizer: %s\n' "${tools[*]}"
  for tool in "${tools[@]}"; do
    timeout -k 5 "$(limit_of 900)" "$sanitizer" --tool "$tool" --error-exitcode 9 \
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
}

# figures STEP COMMAND: what a step printed, below the command.
figures() {
  [[ -s $out/$1.log ]] || return 0
  printf '\n`%s`\n\n```\n' "$2"
  cat "$out/$1.log"
  printf '```\n'
}
# clocks: lowest, median and highest of each column while it was measured, of the first GPU.
clocks() {
  [[ -s $out/clocks.log ]] || return 0
  printf '\nClocks, power and temperature of GPU 0 while it was measured: first line, middle line, last line of %d\n\n```\n' "$(wc -l <"$out/clocks.log")"
  sed -n 1p "$out/clocks.log"
  grep '^0,' "$out/clocks.log" | awk '{ line[NR] = $0 } END { print line[1]; print line[int((NR + 1) / 2)]; print line[NR] }'
  printf '```\n'
}

# finish: writes gpu-results.md and ends run_all.sh.
finish() {
  unwatch_gpu
  {
    printf '## %s, %s\n\n' "$(date +%F)" "${gpu:-NO GPU: NOTHING HERE WAS RUN ON ONE}"
    printf '| what | |\n|---|---|\n| commit | %s |\n| driver | %s |\n| CUDA toolkit | %s |\n| processor | %s |\n| command | `tests/gpu/run_all.sh`, %d s in all |\n' \
      "$commit" "${driver:-none}" "${toolkit:-none}" "$processor" "$SECONDS"
    printf '%s\n' "${results[@]}"
    if [[ ${#remarks[@]} -gt 0 ]]; then printf '\n%s.\n' "${remarks[@]}"; fi
    if [[ $(wc -l <<<"$gpus") -gt 1 ]]; then printf '\n```\n%s\n```\n' "$gpus"; fi
    if [[ -s $out/info.log ]]; then
      printf '\n`dmoscope info`\n\n```\n'
      sed -n '/^backends/,/^formats/{/^formats/d;p}' "$out/info.log"
      printf '```\n'
    fi
    figures bench "dmoscope bench --backend cpu,cuda --sizes 1e4,1e5,1330000,1e7 --threads 0 --repeats 3"
    figures bench-volumes "dmoscope bench --backend cpu,cuda --elements tetrahedra,hexahedra --sizes 1e5 --threads 0 --repeats 3"
    figures bench-small "dmoscope bench $(basename "${mesh:-}") --backend cpu,cuda --threads 1 --iterations 1000 --repeats 3"
    figures draw "dmoscope bench --draw 120 --backend cpu,cuda --sizes 1330000"
    figures bundle-draw "the bundle's dmoscope bench --draw 120 --backend cuda --sizes 1330000"
    figures authors "tests/gpu/authors.sh"
    clocks
    figures others "other processes on the GPU before measuring"
    figures settings "nvidia-smi -q -d CLOCK,POWER,PERFORMANCE,COMPUTE"
    figures bench-cold "dmoscope bench --backend cuda --sizes 1330000 --threads 0 --repeats 1 --json: the first in a process"
    figures bench-warm "dmoscope bench --backend cuda --sizes 1330000 --threads 0 --repeats 9 --json"
    figures ncu "ncu --set basic"
  } >"$out/gpu-results.md"
  printf '\n========== for tests/gpu/RESULTS.md; please send %s\n\n' "$out/gpu-results.md"
  cat "$out/gpu-results.md"
  printf '\n%d steps failed, %d s in all\n' "$broken" "$SECONDS"
  if [[ $broken -eq 0 ]]; then exit 0; else exit 1; fi
}
