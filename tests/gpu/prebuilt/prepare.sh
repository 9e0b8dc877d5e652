#!/usr/bin/env bash
# prepare.sh [BUNDLE]: packs into .prebuilt all that run.sh needs besides the tree, so that minutes on a machine with a GPU are not spent on
# a build: the programs and tests of BUNDLE, the meshes of ../shared where they are, and the kernel of the paper's authors as a program.
#   BUNDLE    a folder made by tools/bundle (build/prebuilt, made if it is missing, for the GPUs that ARCHITECTURES names)
#   ARCHITECTURES   90-real: an H100 or H200. Only the first kind's code is made of the authors' kernel
#   AUTHORS   a checkout or git folder of their code, or nothing
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
bundle=$(realpath -m "${1:-build/prebuilt}") architectures=${ARCHITECTURES:-90-real}
[[ -d .headers ]] || tools/collect-headers
[[ -x $bundle/bin/test_gui ]] || tools/bundle "$bundle" --quick "-DDMOSCOPE_CUDA_ARCHITECTURES=$architectures"

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
cp -r "$bundle"/. "$stage"
rm -rf "$stage/share" "$stage/bin/test_render"
if [[ -d ../shared/meshes ]]; then
  mkdir "$stage/shared"
  cp -r --no-preserve=mode ../shared/meshes "$stage/shared"
fi
if [[ -n ${AUTHORS:-} ]]; then CAPABILITY=${architectures%%[-;]*} tests/gpu/authors.sh --compile "$AUTHORS" "$stage/authors"; fi
rm -rf .prebuilt
mkdir .prebuilt
git describe --always --dirty --abbrev=12 >.prebuilt/commit
# The programs are mostly alike: they stand one after the other, with a dictionary that reaches over all of them.
find "$stage" -type f -printf '%P\n' | sort -t/ -k2 | tar -C "$stage" -c --no-recursion -T - |
  xz -T1 --lzma2=preset=2,dict=128MiB >.prebuilt/programs.tar.xz
du -sh "$stage" .prebuilt .headers | sed "s:$stage:unpacked:"
echo "Carry the tree with .prebuilt and .headers; there: tests/gpu/prebuilt/run.sh"
