#!/usr/bin/env bash
# installed.sh BUILD EXAMPLES MANUAL: installs the library into an empty folder, builds the examples with that installation alone, by CMake and by
# pkg-config, and the blocks of the manual, and compares their output with the program's.
set -euo pipefail
build=$1 examples=$2 manual=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
for component in library development; do cmake --install "$build" --prefix "$prefix" --component "$component" >/dev/null; done

# Headers must not mention internals.
if grep -rnE 'OpenMesh|imgui|GLFW|glad|core/|library/' "$prefix/include"; then
  echo "the installed headers name what is not installed" >&2
  exit 1
fi
# The shared library exports its own functions alone.
foreign=$(nm -DC --defined-only "$prefix"/lib*/libdmoscope.so | grep -vE ' (dmo::|(vtable|typeinfo|typeinfo name) for dmo::)' | grep -E ' [TDB] ' || true)
[[ -z $foreign ]] || { printf 'it shows what it should not:\n%s\n' "$foreign" >&2; exit 1; }

cmake -S "$examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work/build" >/dev/null
"$work/build/smooth_arrays" | tee "$work/arrays"
# Right angles with equal legs have a mean ratio of 0.866, which the middle alone gives all eight.
grep -qE -- '-> 0\.86[0-9]+, vertex 4 at \((0\.99|1\.00)' "$work/arrays"

"$build/dmoscope" generate coast -o "$work/coast.14" >/dev/null
"$build/dmoscope" smooth "$work/coast.14" -o "$work/program.14" --until-converged >/dev/null
"$work/build/smooth_file" "$work/coast.14" "$work/library.14" >/dev/null
cmp "$work/program.14" "$work/library.14"
"$work/build/progress_and_cancel" >"$work/told"
tail -1 "$work/told" | grep -qE '^cancelled after [0-9]+ iterations; minimum 0.17[0-9]* -> 0.8[0-9]+; 121203 coordinates'
"$work/build/compare_metrics" "$work/coast.14" | tee "$work/told"
[[ $(wc -l <"$work/told") == 3 ]]
"$work/build/slide_on_surface"
if "$work/build/smooth_file" "$work/none.14" "$work/none.out" 2>"$work/told"; then exit 1; fi
grep -q 'none.14' "$work/told"

# The blocks of the manual are bodies of programs.
awk -v folder="$work" '/^```cpp/ { file = folder "/manual" ++n ".cpp"; inside = 1; body = ""; next }
  /^```/ && inside { print "int main() {\n" body "}" >file; inside = 0 }
  inside && /^#include/ { print >file; next }
  inside { body = body $0 "\n" }' "$manual"
[[ $(ls "$work"/manual*.cpp | wc -l) == 5 ]]
for program in "$work"/manual*.cpp; do
  c++ -std=c++17 "$program" -o "${program%.cpp}" -I"$prefix/include" -L"$(dirname "$(find "$prefix" -name libdmoscope.so)")" -ldmoscope
  (cd "$work" && LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name libdmoscope.so)") "${program%.cpp}")
done

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name dmoscope.pc)")
# shellcheck disable=SC2046
c++ -std=c++17 "$examples/smooth_file.cpp" -o "$work/by_pkg_config" $(pkg-config --define-variable=prefix="$prefix" --cflags --libs dmoscope)
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name libdmoscope.so)") "$work/by_pkg_config" "$work/coast.14" "$work/again.14" >/dev/null
cmp "$work/program.14" "$work/again.14"
echo "the installed library does what the program does"
