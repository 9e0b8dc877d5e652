#!/usr/bin/env bash
# toolkit_test.sh: tests the build's choices with simulated CUDA toolkits and GPUs: stand-ins for nvcc and nvidia-smi;
# cmake/cuda_toolkit.cmake decides.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake=$(command -v cmake)
failed=0 tried=0

# same WHAT EXPECTED FOUND
same() {
  tried=$((tried + 1))
  [[ $2 == "$3" ]] && return
  printf '%s: expected "%s", found "%s"\n' "$1" "$2" "$3"
  failed=$((failed + 1))
}

# toolkit VERSION ARCHITECTURES [REFUSED...]: makes a stand-in for nvcc in $folder/VERSION that compiles with no compiler whose name is
# REFUSED; `default` is a call without -ccbin.
toolkit() {
  local bin=$folder/$1/bin
  mkdir -p "$bin"
  cat >"$bin/nvcc" <<END
#!/bin/sh
case "\$*" in
  *--version*) echo "Cuda compilation tools, release $1, V$1.99"; exit 0 ;;
  *--list-gpu-arch*) for a in $2; do echo "compute_\$a"; done; exit 0 ;;
esac
compiler=default
[ "\$1" = -ccbin ] && compiler=\$2
for refused in ${*:3}; do
  if [ "\$refused" = "\$compiler" ]; then
    echo "In file included from <command-line>:"
    echo "host_config.h:143:2: error: #error -- unsupported GNU version! gcc versions later than 12 are not supported!" >&2
    exit 1
  fi
done
echo "\$compiler" >>"$folder/compiled-with"
END
  chmod +x "$bin/nvcc"
}
# gpus CAPABILITY...: makes a stand-in for nvidia-smi; without arguments one that finds no driver.
gpus() {
  mkdir -p "$folder/smi"
  if [[ $# -eq 0 ]]; then
    printf '#!/bin/sh\necho "NVIDIA-SMI has failed because it could not communicate with the NVIDIA driver."\nexit 9\n' >"$folder/smi/nvidia-smi"
  else
    { echo '#!/bin/sh'; for c in "$@"; do echo "echo $c"; done; } >"$folder/smi/nvidia-smi"
  fi
  chmod +x "$folder/smi/nvidia-smi"
}
# asked COMMANDS: prints the variable `answer` after these commands, CMake code after the functions.
asked() {
  printf 'cmake_minimum_required(VERSION 3.25)\ninclude(%s/cmake/cuda_toolkit.cmake)\n%s\nfile(WRITE %s/answer "${answer}")\n' "$root" "$1" "$folder" >"$folder/ask.cmake"
  env -u CUDACXX -u CUDA_HOME -u CUDA_PATH -u CUDAHOSTCXX PATH="$folder/smi:$PATH" "${@:2}" "$cmake" -P "$folder/ask.cmake" >"$folder/log" 2>&1 ||
    { cat "$folder/log"; echo "<failed>" >"$folder/answer"; }
  cat "$folder/answer"
}

toolkit 11.8 "35 50 75 80 86 87 89 90"
toolkit 12.4 "50 60 70 75 80 86 87 89 90"
toolkit 13.0 "75 80 86 87 88 89 90 100 110 103 120 121"
toolkit 12.0 "75 80 86 89 90" /usr/bin/c++ default
gpus

# Choice of the toolkit.
find='dmoscope_cuda_find(NVCC version)
string(APPEND answer "${NVCC} ${version}")'
same "CUDA_HOME" "$folder/12.4/bin/nvcc 12.4" "$(asked "$find" CUDA_HOME="$folder/12.4")"
same "CUDACXX" "$folder/13.0/bin/nvcc 13.0" "$(asked "$find" CUDACXX="$folder/13.0/bin/nvcc")"
same "-DNVCC" "$folder/12.4/bin/nvcc 12.4" "$(asked "set(NVCC $folder/12.4/bin/nvcc)
$find" CUDACXX="$folder/13.0/bin/nvcc")"
same "an old one that is named" "$folder/11.8/bin/nvcc 11.8" "$(asked "$find" CUDA_HOME="$folder/11.8")"
if [[ -x /usr/local/cuda/bin/nvcc ]]; then
  same "an old one on the path, and one at the usual place" /usr/local/cuda/bin/nvcc "$(asked "$find" PATH="$folder/11.8/bin:/usr/bin:/bin" | cut -d' ' -f1)"
fi
mkdir -p "$folder/silent/bin"
printf '#!/bin/sh\nexit 3\n' >"$folder/silent/bin/nvcc"
chmod +x "$folder/silent/bin/nvcc"
same "one that says nothing" "$folder/silent/bin/nvcc 0" "$(asked "$find" CUDA_HOME="$folder/silent")"

# Choice of the GPUs.
native='dmoscope_cuda_native(NVCC-HERE answer remark)
string(APPEND answer "${remark}")'
native_of() { asked "${native/NVCC-HERE/$folder/$1/bin/nvcc}"; }
same "no driver" "75-virtual" "$(native_of 12.4)"
gpus 9.0
same "an H100" "90-real;75-virtual" "$(native_of 12.4)"
gpus 8.6 8.6 9.0 8.6 8.6 9.0 8.6 8.6
same "eight GPUs of two kinds" "86-real;90-real;75-virtual" "$(native_of 12.4)"
gpus 12.0
same "a GPU newer than the toolkit" "75-virtual;90-virtual; the toolkit does not know compute capability 12.0, whose driver will compile PTX of 90 at the first start" \
  "$(native_of 12.4)"
gpus 6.1
same "a GPU too old" "75-virtual; a GPU of compute capability 6.1 is too old, 7.5 is the oldest" "$(native_of 12.4)"
gpus "[N/A]"
same "a GPU of which the driver says nothing" "75-virtual" "$(native_of 12.4)"
gpus
all='dmoscope_cuda_all(NVCC-HERE PROCESSOR answer)'
all_of() { local c=${all/NVCC-HERE/$folder/$1/bin/nvcc}; asked "${c/PROCESSOR/$2}"; }
same "all, toolkit 12.4" "75-real;80-real;86-real;89-real;90-real;90-virtual" "$(all_of 12.4 x86_64)"
same "all, toolkit 13.0" "75-real;80-real;86-real;89-real;90-real;100-real;103-real;120-real;120-virtual" "$(all_of 13.0 x86_64)"
same "all, on an ARM" "75-real;80-real;86-real;87-real;88-real;89-real;90-real;100-real;103-real;110-real;120-real;120-virtual" "$(all_of 13.0 aarch64)"

# Choice of the compiler.
compiler='dmoscope_cuda_candidates(candidates)
dmoscope_cuda_host_compiler(NVCC-HERE FOLDER answer reason ${candidates})
string(APPEND answer "|${reason}")'
compiler_of() { local c=${compiler/NVCC-HERE/$folder/$1/bin/nvcc}; asked "set(CMAKE_CXX_COMPILER /usr/bin/c++)
set(CMAKE_CXX_COMPILER_ID GNU)
$2
${c/FOLDER/$folder/scratch}" "${@:3}"; }
error='host_config.h:143:2: error: #error -- unsupported GNU version! gcc versions later than 12 are not supported!'
mkdir -p "$folder/compilers"
for name in g++-11 g++-15; do
  printf '#!/bin/sh\n' >"$folder/compilers/$name"
  chmod +x "$folder/compilers/$name"
done
only=(PATH="$folder/compilers:$folder/smi")
same "one compiler for all" "/usr/bin/c++|" "$(compiler_of 12.4 '')"
toolkit 12.1 "75 80" /usr/bin/c++
same "nvcc's own, where it refuses that" "default|" "$(compiler_of 12.1 '')"
toolkit 12.2 "75 80" /usr/bin/c++ default "$folder/compilers/g++-15"
same "another version of g++, the newest that it takes" "$folder/compilers/g++-11|" "$(compiler_of 12.2 '' "${only[@]}")"
toolkit 12.3 "75 80" /usr/bin/c++ default "$folder/compilers/g++-15" "$folder/compilers/g++-11"
same "none: nvcc's first error" "|$error" "$(compiler_of 12.3 '' "${only[@]}")"
same "the one that was asked for" "/opt/g++|" "$(compiler_of 12.4 'set(CMAKE_CUDA_HOST_COMPILER /opt/g++)')"
same "no other than that one" "|$error" "$(compiler_of 12.1 'set(CMAKE_CUDA_HOST_COMPILER /usr/bin/c++)')"
same "CUDAHOSTCXX" "/opt/g++|" "$(compiler_of 12.4 '' CUDAHOSTCXX=/opt/g++)"

printf '%d answers, %d wrong\n' "$tried" "$failed"
[[ $failed -eq 0 ]]
