#!/usr/bin/env bash
# authors.sh CODE OUT [PROGRAM]: times the kernel that the paper's authors published (github.com/daniel-zint/dmo_templated, MIT) on this
# machine's GPU, and ours on the same mesh, in turn. CODE: a checkout or git folder of it, compiled aside in OUT and never copied into the
# tree; or the program that was made of it. PROGRAM: our program (build/gpu-bench/dmoscope). SIZE: vertices of the mesh (1330000).
# authors.sh --compile CODE OUT: only makes OUT/driver, for compute capability CAPABILITY (90), on a machine that needs no GPU.
# Their OpenMesh is not needed: driver.cu fills their structures. Compiled as their CMakeLists.txt has it (--use_fast_math included).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
only=''
if [[ ${1:-} == --compile ]]; then
  only=yes
  shift
fi
[[ $# -ge 2 ]] || { sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
code=$1 out=$2 program=${3:-$here/../../build/gpu-bench/dmoscope} size=${SIZE:-1330000}
mkdir -p "$out"

capability=$([[ -n $only ]] || nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2>/dev/null | head -1 | tr -d .) || true
driver=$code
if [[ -d $code ]]; then
  source=$code driver=$out/driver
  if [[ ! -d $code/src/DMO ]]; then
    source=$out/code
    mkdir -p "$source"
    git -C "$code" archive HEAD src | tar -x -C "$source"
  fi
  nvcc=$(PATH=$PATH:/usr/local/cuda/bin command -v nvcc)
  "$nvcc" -O3 -std=c++17 -arch="sm_${capability:-${CAPABILITY:-90}}" --expt-extended-lambda --expt-relaxed-constexpr --use_fast_math \
    -D_DMO_USE_CUDA -D_USE_MATH_DEFINES -w -I"$here/authors" -I"$source/src" "$here/authors/driver.cu" -o "$driver"
  rm -rf "$out/code"
fi
[[ -z $only ]] || exit 0

mesh=$out/grid.off
"$program" generate grid --size "$size" --seed 1 -o "$mesh" >/dev/null
if [[ -z $capability ]]; then
  "$driver" "$mesh" 0
  echo "No GPU here: their kernel compiles, and was not run."
  exit
fi
for _ in 1 2; do
  "$driver" "$mesh" 4
  "$program" bench "$mesh" --backend cuda --iterations 4 --threads 0
done
