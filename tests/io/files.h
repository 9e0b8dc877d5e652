#pragma once
// Files for the tests of readers and writers: a folder that goes away, and the properties that every format has to keep.

#include <cstdint>
#include <filesystem>
#include <functional>
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

/// Is there a file of this format for a mesh that was read from another one?
[[nodiscard]] inline bool is_made_anew(const FormatInfo& format) {
  return format.name != "meshb" && format.name != "mike" && format.name != "selafin" && format.name != "exodus" && format.name != "cgns";
}

/// Expects InputError at this line (from 1; 0: none) with these words in it.
void expect_refused(std::string_view name, std::string_view bytes, std::size_t line, std::string_view words);

[[nodiscard]] inline std::vector<Index> corners(const Mesh& mesh, Index element) {
  const auto own = mesh.elements.corners(element);
  return {own.begin(), own.end()};
}

/// Is every corner and every member of a group a vertex or element of the mesh, and has every field its size?
void expect_consistent(const Mesh& mesh);

/// Reads every beginning of `bytes`: a mesh that is in order, or an InputError, and nothing else.
void expect_truncation_safe(std::string_view name, std::string_view bytes);

/// Bitwise: -0.0 is not 0.0.
void expect_same_positions(std::span<const Vec3> expected, std::span<const Vec3> found);
void expect_same_elements(const Mesh& expected, const Mesh& found);

/// Doubles of every size, tiny and huge ones, and -0.0, with x and y (and z if `three`) changed for every `every`-th vertex.
[[nodiscard]] std::vector<Vec3> moved(const Mesh& mesh, std::size_t every, bool three, std::uint64_t seed);

/// Writes text files again with every third vertex moved to random doubles and checks: the same doubles come back, and of the old and new
/// bytes, cut into words and the blanks between them, only as many words differ as coordinates changed; unmoved: the very bytes.
/// `three`: the file holds z.
void expect_patched(std::string_view name, std::string_view bytes, bool three);

/// All files below the shared meshes with this extension; empty where they are not there.
[[nodiscard]] std::vector<std::filesystem::path> shared_meshes(std::string_view extension);

}  // namespace dmoscope::test
