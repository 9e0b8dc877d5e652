#!/usr/bin/env bash
# Checks the walls between the modules: includes and calls that are forbidden in a folder. Prints every breach as file:line.
set -euo pipefail
cd "$(dirname "$0")/.."

failed=0

# breach "what is wrong" PATTERN FOLDER...: no source below the folders may match the pattern.
breach() {
  local what=$1 pattern=$2
  shift 2
  local folders=()
  for folder in "$@"; do [[ -d $folder ]] && folders+=("$folder"); done
  [[ ${#folders[@]} -gt 0 ]] || return 0
  local found
  found=$(grep -rnE --include='*.cpp' --include='*.h' --include='*.cu' --include='*.cuh' -- "$pattern" "${folders[@]}" || true)
  [[ -z $found ]] && return 0
  failed=1
  printf '%s:\n%s\n' "$what" "$found"
}

include='^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]'
opengl='(glad|GL|GLES[0-9]?|EGL|GLFW|glfw)[/0-9]'
imgui='(imgui|backends/imgui|misc/)'
cuda='(cuda|cuda_runtime|cuda_runtime_api|device_launch_parameters)'

breach "core knows no other module" "${include}(gpu|mpi|render|ui|app)/" core
breach "mpi knows core alone" "${include}(gpu|render|ui|app|library|python)/" mpi
breach "only mpi and its program know MPI" "${include}mpi\.h|\bMPI_[A-Z]" core gpu render ui library python app/common app/subcommands app/window
breach "core knows no OpenGL, ImGui or CUDA" "${include}(${opengl}|${imgui}|${cuda})" core
breach "core, gpu, render and ui know no library and no Python" "${include}(library|python)/" core gpu render ui app
breach "the library knows core alone" "${include}(gpu|mpi|render|ui|app|python|${opengl}|${imgui}|${cuda})" library
breach "the library's headers know themselves and the standard library alone" "#include \"[^d]|#include <[^>]*[/.]" library/include
breach "gpu knows neither the screen nor the program" "${include}(render|ui|app)/" gpu
breach "render knows no interface, program or GPU backend" "${include}(ui|app|gpu)/" render
breach "render knows no ImGui and no CUDA" "${include}(${imgui}|${cuda})" render
breach "ui knows no program and no GPU backend" "${include}(app|gpu)/" ui
breach "ui calls no OpenGL, CUDA or GLFW" "${include}(glad|GL|EGL|GLFW|${cuda})|(^|[^A-Za-z0-9_:])(gl[A-Z][A-Za-z0-9]+|glfw[A-Z][A-Za-z0-9]+|egl[A-Z][A-Za-z0-9]+)\(" ui
breach "only gpu includes CUDA" "${include}${cuda}" app $(find tests -mindepth 1 -maxdepth 1 ! -name gpu) $(find tests/gpu -mindepth 1 -maxdepth 1 ! -name fake)

breach "ui's state, analysis and commands know no ImGui" "${include}${imgui}" ui/state ui/analysis ui/commands

# A comment stands alone: a verb or noun phrase, not the end of a sentence whose beginning is elsewhere. tests/fuzz has what a script makes.
breach "a comment begins in the middle of a sentence" '^[[:space:]]*//+ ?(Of|What|Where|Likewise|Who|As|The same) ' core gpu mpi render ui app library python \
  $(find tests -mindepth 1 -maxdepth 1 -type d ! -name fuzz)

# layers MODULE FOLDER...: within a module, sources include headers of their own folder and of those named before it. "." is the module
# itself.
layers() {
  local module=$1 found
  shift
  found=$(find "$module" -name '*.cpp' -o -name '*.h' -o -name '*.cu' -o -name '*.cuh' | sort | xargs awk -v module="$module" -v order="$*" '
    function folder(file) { sub(/\/[^\/]*$/, "", file); return file == module ? "." : substr(file, length(module) + 2) }
    BEGIN { n = split(order, names, " "); for (i = 1; i <= n; ++i) rank[names[i]] = i }
    FNR == 1 && !(folder(FILENAME) in rank) { print FILENAME ":1: its folder has no place in the order" }
    $0 ~ "^[[:space:]]*#[[:space:]]*include[[:space:]]*\"" module "/" {
      split($0, part, "\"")
      if (rank[folder(part[2])] > rank[folder(FILENAME)]) print FILENAME ":" FNR ": " folder(FILENAME) " is below " folder(part[2]) ": " part[2]
    }')
  [[ -z $found ]] && return 0
  failed=1
  printf 'The order of the folders in %s:\n%s\n' "$module" "$found"
}
layers core base drawing numeric mesh io/reading io/writing io/arrays io io/polygons io/abaqus io/cgns io/exodus io/gmsh io/med io/medit io/nastran io/vtk \
  io/solvers io/vtu io/pvtu io/xdmf clipping formula target quality/metrics quality search input reference transfer smooth joint smooth/kernels smooth/kernels/targets smooth/kernels/compiled smooth/visit smooth/methods smooth/execution inspect run session view \
  commands engine
layers ui state analysis commands toolkit plots overlays viewports panels dialogs .
layers mpi world reading mesh files smooth
layers app common mpi window pictures pages comparison paper subcommands .

# One name, one type: two headers of a program that define the same name make it call one's functions on the other's objects.
twice=$(find core gpu mpi render ui app -name '*.h' -print0 | xargs -0 awk '
  FNR == 1 { space = "" }
  /^namespace [a-z:]+ \{/ { space = $2 }
  /^(struct|class|enum class) [A-Za-z0-9_]+( final)?( :.*)? \{/ {
    name = $1 == "enum" ? $3 : $2
    if ((space, name) in where) print FILENAME ":" FNR ": " space "::" name " is also defined at " where[space, name]
    else where[space, name] = FILENAME ":" FNR
  }')
if [[ -n $twice ]]; then
  failed=1
  printf 'One name, one type:\n%s\n' "$twice"
fi

# Code compiled for one kind of processor must share no compiled copy with the rest: every function that the linker could take for
# another's carries its packs' architecture (xsimd) in its name. $1: the build folder.
for object in ${1:+"$1"/core/CMakeFiles/dmoscope_core.dir/{formula/formula_kernel,smooth/kernels/compiled/kernel_set}_avx*.o}; do
  [[ -f $object ]] || continue
  shared=$(nm "$object" | awk '$2 == "W" && $3 !~ /avx2|avx512/ && $3 !~ /^DW\.ref\./ {print $3}' | c++filt)
  [[ -z $shared ]] && continue
  failed=1
  printf '%s could lend its code to other processors:\n%s\n' "${object##*/}" "$shared"
done

if [[ $failed -eq 0 ]]; then echo "The walls stand."; fi
exit "$failed"
