#pragma once
// Files for the tests of readers and writers: a temporary folder, and properties of all formats.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/io/mesh_io.h"
#include "core/mesh/mesh.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope::test {

void put(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] std::string get(const std::filesystem::path& path);

/// Writes `bytes` to a file of this name in a folder of its own, and reads it.
[[nodiscard]] Mesh read_bytes(std::string_view name, std::string_view bytes);
/// Writes the mesh at `positions` to a file of this name, and returns its bytes.
[[nodiscard]] std::string written(std::string_view name, const Mesh& mesh, std::span<const Vec3> positions,
                                  std::vector<std::string>* notes = nullptr);
[[nodiscard]] inline std::string written(std::string_view name, const Mesh& mesh) { return written(name, mesh, mesh.positions); }

/// Whether the format can write a mesh that was read from another one.
[[nodiscard]] inline bool is_made_anew(const FormatInfo& format) {
  constexpr std::string_view kOnlyAsRead[] = {"meshb", "unv", "mike", "selafin", "exodus", "cgns", "med"};
  return std::ranges::find(kOnlyAsRead, format.name) == std::end(kOnlyAsRead);
}

/// Expects InputError at this line (from 1; 0: none) with these words in it.
void expect_refused(std::string_view name, std::string_view bytes, std::size_t line, std::string_view words);

[[nodiscard]] inline std::vector<Index> corners(const Mesh& mesh, Index element) {
  const auto own = mesh.elements.corners(element);
  return {own.begin(), own.end()};
}

/// Expects every corner and every member of a group to be a vertex or element of the mesh, and every field to have its size.
void expect_consistent(const Mesh& mesh);

/// Reads every beginning of `bytes`, and expects a consistent mesh or an InputError.
void expect_truncation_safe(std::string_view name, std::string_view bytes);

/// Expects equal bits: -0.0 is not 0.0.
void expect_same_positions(std::span<const Vec3> expected, std::span<const Vec3> found);
void expect_same_elements(const Mesh& expected, const Mesh& found);

/// Positions with doubles of every size, tiny and huge ones, and -0.0, in x and y (and z if `three`) of every `every`-th vertex.
[[nodiscard]] std::vector<Vec3> moved(const Mesh& mesh, std::size_t every, bool three, std::uint64_t seed);

/// Writes text files again with every third vertex moved to random doubles and expects that the same doubles come back, and that of the old
/// and new bytes, cut into words and the blanks between them, only as many words differ as coordinates changed; unmoved: the same bytes.
/// `three`: the file holds z.
void expect_patched(std::string_view name, std::string_view bytes, bool three);

/// All files below the shared meshes with this extension; none if they are missing.
[[nodiscard]] std::vector<std::filesystem::path> shared_meshes(std::string_view extension);

}  // namespace dmoscope::test
