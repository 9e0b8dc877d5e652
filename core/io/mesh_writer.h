#pragma once
// Common parts of the writers of new files in text formats: their base, and boundaries as edges.

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

// Boundary strings of fort.14 files, chains of vertices, for formats whose boundaries consist of edges.

/// Whether the group is an open or land boundary of a fort.14.
[[nodiscard]] bool is_boundary_string(const Group& group);

/// The edges of a boundary string, two vertices each: each vertex joined with the next, and the last of an island with the first.
[[nodiscard]] std::vector<Index> chain_edges(const Group& group);

/// Notes one sentence for each role among these boundary strings, with the form in which they were written (for one and for several), and
/// their types.
void note_boundary_strings(std::span<const Group* const> strings, std::string_view written_as, std::string_view written_as_many,
                           Notes& notes);

/// The mesh's groups, with boundary strings as groups of their edges; the notes name these. `written_as`: "physical group".
[[nodiscard]] std::vector<Group> groups_with_edges(const Mesh& mesh, std::string_view written_as, Notes& notes);

// --- The writers ---

/// The values of a field as whole numbers; none unless all are whole, from `least` on, and not too large.
[[nodiscard]] std::optional<std::vector<int>> whole_values(const Field& field, double least = -2147483647.0);

class MeshWriter {
 protected:
  /// Begins a file. `title`: of the format; `strings_as`: form of boundary strings, see groups_with_edges(); empty: no groups are written.
  MeshWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context, std::string_view title,
             std::string_view strings_as = {})
      : out_(file, context), mesh_(mesh), positions_(positions), title_(title) {
    if (strings_as.empty()) return;
    groups_ = groups_with_edges(mesh, strings_as, notes_);
    numbers_ = numbers_of_groups(groups_);
  }

  [[nodiscard]] bool is_volume() const {
    return std::ranges::any_of(mesh_.elements.kinds(), [](ElementKind kind) { return info(kind).dimension == 3; });
  }
  /// Whether the mesh is planar and in the plane z = 0.
  [[nodiscard]] bool is_flat() const {
    return !is_volume() && std::ranges::all_of(positions_, [](Vec3 p) { return p.z == 0.0; });
  }
  /// Whether a field has numbers of all vertices or elements.
  [[nodiscard]] bool is_of(const Field& field, Field::On on) const {
    const std::size_t things = on == Field::On::Vertices ? positions_.size() : mesh_.elements.size();
    return field.on == on && field.components >= 1 && field.values.size() == things * static_cast<std::size_t>(field.components);
  }
  /// Completes the notes, at the end of the file.
  [[nodiscard]] Notes finish() {
    out_.finish();
    note_dropped(mesh_, kept_fields_, kept_groups_, title_, notes_);
    return std::move(notes_);
  }

  TextWriter out_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  std::string_view title_;
  Notes notes_;
  std::vector<Group> groups_;  // groups of the mesh, boundary strings by their edges
  std::vector<int> numbers_;   // numbers of the groups
  std::vector<std::size_t> kept_fields_, kept_groups_;
};

}  // namespace dmoscope
