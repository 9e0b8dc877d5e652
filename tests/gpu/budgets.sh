#!/usr/bin/env bash
# budgets.sh [--write] PTX_FOLDER [ARCHITECTURE...]: compares ptxas's figures for every kernel with the committed table (budgets.txt):
# registers, stack and spills. Fails if a figure is worse by more than a tenth (a stack by 16 bytes at least, any new spill), or if a kernel
# is in one of the two alone. PTX_FOLDER has one folder for each compute capability whose PTX it is (75, 120); architectures are 75, 90 and
# 120 unless given, and those below 100 are made of the PTX of 75, for nvcc has one code generator up to 90 and another from 100 on. --write
# writes the table anew, for all three. Needs no GPU, but minutes: ptxas's answers stay in PTX_FOLDER/ptxas, and are asked for again if the
# PTX is another. JOBS: number of ptxas at once (all processors).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
table=$here/budgets.txt write=false
if [[ ${1:-} == --write ]]; then write=true; shift; fi
[[ $# -ge 1 && -d $1 ]] || { sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
folder=$1
architectures=("${@:2}")
if $write || [[ ${#architectures[@]} -eq 0 ]]; then architectures=(75 90 120); fi
PATH=$PATH:/usr/local/cuda/bin
command -v ptxas >/dev/null || { echo "budgets: no ptxas; it comes with the CUDA toolkit" >&2; exit 2; }
release=$(ptxas --version | sed -n 's/.*, \(V[0-9.]*\).*/\1/p')

# ask ARCHITECTURE PTX ANSWER: calls ptxas with the flags that nvcc passes on.
ask() {
  local asked
  asked="ptxas $release sm_$1 of $(sha256sum <"$2" | cut -d ' ' -f 1)"
  if [[ -f $3 && $(head -1 "$3") == "$asked" ]]; then return; fi
  { echo "$asked" && ptxas -v -O3 -arch="sm_$1" --fmad false "$2" -o /dev/null 2>&1; } >"$3.new" || { cat "$3.new" >&2; return 1; }
  mv "$3.new" "$3"
}
export -f ask
export release
for architecture in "${architectures[@]}"; do
  of=75
  if [[ $architecture -ge 100 ]]; then of=120; fi
  [[ -d $folder/$of ]] || { echo "budgets: no PTX of compute_$of in $folder" >&2; exit 2; }
  mkdir -p "$folder/ptxas/$architecture"
  rm -f "$folder/ptxas/$architecture"/*.new
  for ptx in "$folder/$of"/*.ptx; do
    [[ -f $ptx ]] || { echo "budgets: no PTX in $folder/$of" >&2; exit 2; }
    printf '%s\0' "$architecture" "$ptx" "$folder/ptxas/$architecture/$(basename "$ptx" .ptx).txt"
  done
done | xargs -0 -r -n 3 -P "${JOBS:-$(nproc)}" bash -c 'set -euo pipefail; ask "$@"' ask

# Metrics are numbers in a kernel's name: "0=mean-ratio 1=mean-ratio-area ...".
metrics=$(sed -n '/^enum class Metric /,/^}/p' "$here/../../core/quality/metrics/metric_info.h" | sed -n 's/^ *\([A-Z][A-Za-z]*\),\{0,1\}$/\1/p' |
  sed 's/\([a-z]\)\([A-Z]\)/\1-\2/g' | tr '[:upper:]' '[:lower:]' | awk '{ printf "%d=%s ", NR - 1, $0 }')

# figures ARCHITECTURE: prints "ARCHITECTURE REGISTERS STACK STORED LOADED KERNEL", a line a kernel.
figures() {
  local answers=() ptx of=75
  if [[ $1 -ge 100 ]]; then of=120; fi
  for ptx in "$folder/$of"/*.ptx; do answers+=("$folder/ptxas/$1/$(basename "$ptx" .ptx).txt"); done
  cat "${answers[@]}" | c++filt | awk -v architecture="$1" -v metrics="$metrics" '
    BEGIN { n = split(metrics, pairs, " "); for (i = 1; i <= n; ++i) { split(pairs[i], pair, "="); metric[pair[1]] = pair[2] } }
    # "void dmoscope::gpu::kernel<dmoscope::gpu::bodies::Visit<(dmoscope::Metric)0, (dmoscope::Stars)0, false>, dmoscope::Solo>(...)"
    function short(name,   number, form, team) {
      sub(/\(dmoscope::gpu::Task.*/, "", name)
      if (name !~ /bodies::/) return "probe"  # the one kernel of probe.cu
      number = name ~ /Metric\)[0-9]/ ? name : ""
      sub(/.*Metric\)/, "", number); sub(/[^0-9].*/, "", number)
      if (name ~ /bodies::Visit</)
        name = name ~ /Stars\)0/ ? "VisitSmallFans" : name ~ /Stars\)1/ ? "VisitLargeFans" : name ~ /Stars\)2/ ? "VisitOthers" : "VisitInTeam"
      else if (name ~ /bodies::VisitComposite</)
        name = name ~ /dmoscope::Space/ ? "VisitVolumeComposite" : "VisitComposite"
      else if (name ~ /bodies::Judge</)
        name = name ~ /dmoscope::Space/ ? "JudgeVolume" : "Judge"
      else if (name ~ /bodies::[A-Za-z]*(Defined|Targets)</) {  # with their frame and numbers, or the form of their targets
        form = name ~ /Targets</ ? (name ~ /<true>|<\(bool\)1>/ ? "crossed" : "plain") : (name ~ /dmoscope::Space/ ? "space" : "plane")
        if (name ~ /double>/) form = form "-double"
        team = name ~ /VisitTargets/ && name ~ /CudaTeam/ ? "InTeam" : ""
        sub(/.*bodies::/, "", name); sub(/[^A-Za-z].*/, "", name)
        return name team " " form
      } else { sub(/.*bodies::/, "", name); sub(/[^A-Za-z].*/, "", name) }
      return number == "" ? name : name " " (number in metric ? metric[number] : "metric" number)
    }
    /Compiling entry function/ { name = $0; sub(/[^\047]*\047/, "", name); sub(/\047 for .*/, "", name); name = short(name) }
    /bytes stack frame/ { stack = $1; stored = $5; loaded = $9 }
    /: Used [0-9]+ registers/ { match($0, /Used [0-9]+/); print architecture, substr($0, RSTART + 5, RLENGTH - 5), stack, stored, loaded, name }' |
    sort -k6
}

found=$(for architecture in "${architectures[@]}"; do figures "$architecture"; done)
if $write; then
  {
    echo "# What ptxas $release makes of each kernel (budgets.sh --write): bytes of a lane's stack, and of spills that its code stores and loads."
    printf '%-4s %9s %6s %6s %6s  %s\n' '# sm' registers stack stored loaded kernel
    awk '{ printf "%-4s %9s %6s %6s %6s  %s\n", $1, $2, $3, $4, $5, $6 (NF > 6 ? " " $7 : "") }' <<<"$found"
  } >"$table"
  echo "budgets: $(wc -l <<<"$found") lines written to $table"
  exit
fi
[[ -f $table ]] || { echo "budgets: no table $table; budgets.sh --write makes it" >&2; exit 2; }
was=$(sed -n '1s/.*ptxas \(V[0-9.]*\).*/\1/p' "$table")
if [[ $was != "$release" ]]; then echo "The table is of ptxas $was and this is $release: figures may differ for that alone."; fi
awk -v asked="${architectures[*]}" '
  BEGIN { split("registers,bytes of stack,bytes of spills stored,bytes of spills loaded", what, ","); n = split(asked, a, " "); for (i = 1; i <= n; ++i) wanted[a[i]] }
  /^#/ || NF < 6 || !($1 in wanted) { next }
  { key = $6 (NF > 6 ? " " $7 : "") ", sm_" $1 }
  NR == FNR { known[key]; order[++rows] = key; for (i = 1; i <= 4; ++i) before[key, i] = $(i + 1); next }
  {
    seen[key]; ++kernels
    if (!(key in known)) { print key ": not in the table"; ++worse; next }
    for (i = 1; i <= 4; ++i) {
      old = before[key, i]; now = $(i + 1)
      if (now < old) ++better
      if (now > old * 1.1 && (i != 2 || now - old >= 16)) { print key ": " now " " what[i] ", " old " in the table"; ++worse }
    }
  }
  END {
    for (i = 1; i <= rows; ++i) if (!(order[i] in seen)) { print order[i] ": in the table, but ptxas was given no such kernel"; ++worse }
    if (better) print better " figures are better than in the table: budgets.sh --write keeps them so"
    print kernels + 0 " rows looked at, " worse + 0 " breaches"
    exit worse > 0
  }' "$table" - <<<"$found"
