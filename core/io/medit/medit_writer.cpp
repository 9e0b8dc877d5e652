// Writer of new MEDIT files: groups become references, and the marks (corners, ridges, ...) their own sections.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/io/medit/medit.h"
#include "core/io/mesh_writer.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/faces.h"

namespace dmoscope {
namespace {

constexpr std::array<std::string_view, kElementKindCount> kKeywords{"Triangles", "Quadrilaterals", "Tetrahedra",
                                                                    "Hexahedra", "Prisms",         "Pyramids"};

/// Cells to be written, each with corners and a reference.
struct ReferencedCells {
  std::vector<Index> corners;  // corners of all cells, one after the other
  std::vector<int> references;
};

/// The mark in kMeditMarks that a group stands for; null if none.
const MeditMark* mark_of(const Group& group, const Mesh& mesh) {
  if (group.role != kMeditMark) return nullptr;
  const MeditMark* mark = medit_mark(group.name);
  if (mark == nullptr || dimension_of(mark->of) != group.dimension) return nullptr;
  if (group.dimension < 2) return mark;
  const auto of_kind = [&](ElementKind kind) { return shape_of(kind) == mark->of; };
  const bool all = std::ranges::all_of(group.faces.kinds(), of_kind) &&
                   (!group.of_elements() || std::ranges::all_of(group.members, of_kind, [&](Index e) { return mesh.elements.kind(e); }));
  return all ? mark : nullptr;
}

class MeditWriter : MeshWriter {
 public:
  MeditWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, kMeditFormat.info.title, "reference") {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      // Restores reference 0: cells without a reference became a group if they are no elements.
      if (groups_[i].role == kMeditReference && groups_[i].code == 0) numbers_[i] = 0;
      marks_.push_back(mark_of(groups_[i], mesh));
      if (marks_[i] != nullptr) numbers_[i] = 0;
    }
  }

  Notes write() {
    const bool flat = is_flat();
    out_ << kMeditSignature << " 2\n";
    if (!mesh_.title.empty()) out_ << "# " << one_line(mesh_.title) << '\n';
    out_ << "Dimension " << (flat ? 2 : 3) << '\n';
    vertices(flat);
    edges();
    faces();
    elements();
    marks();
    out_ << "End\n";
    note_names();
    return finish();
  }

 private:
  void keep(std::size_t group) {
    kept_groups_.push_back(group);
    const Group& g = groups_[group];
    if (marks_[group] == nullptr && g.name != fmt::format("reference {}", numbers_[group])) unnamed_.push_back(group);
  }

  /// Notes one sentence on the loss of the groups' names.
  void note_names() {
    constexpr std::size_t kMostNamed = 32;
    if (unnamed_.empty()) return;
    std::string list;
    for (std::size_t i = 0; i < std::min(unnamed_.size(), kMostNamed); ++i) {
      const Group& g = groups_[unnamed_[i]];
      list +=
          fmt::format("{}{} \"{}\" has reference {}", i == 0 ? "" : ", ", g.role.empty() ? "group" : g.role, g.name, numbers_[unnamed_[i]]);
    }
    if (unnamed_.size() > kMostNamed) list += fmt::format(" and {} more have others", unnamed_.size() - kMostNamed);
    notes_.push_back(fmt::format("MEDIT holds no names: {}.", list));
  }

  /// The references in a field; `otherwise` if there is none.
  std::vector<int> references_of(Field::On on, std::vector<int> otherwise) {
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (field.name != kMeditField || field.on != on || field.values.size() != otherwise.size()) continue;
      auto kept = whole_values(field);
      if (!kept) continue;
      kept_fields_.push_back(i);
      return *std::move(kept);
    }
    return otherwise;
  }

  void vertices(bool flat) {
    const std::vector<int> references = references_of(Field::On::Vertices, std::vector<int>(positions_.size(), 0));
    out_ << "Vertices\n" << positions_.size() << '\n';
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << positions_[v].x << ' ' << positions_[v].y << ' ';
      if (!flat) part << positions_[v].z << ' ';
      part << references[v] << '\n';
    });
  }

  void section(std::string_view keyword, Index corners, const ReferencedCells& cells) {
    if (cells.references.empty()) return;
    out_ << keyword << '\n' << cells.references.size() << '\n';
    out_.for_each(cells.references.size(), [&](TextBuffer& part, std::size_t i) {
      for (Index k = 0; k < corners; ++k) part << cells.corners[i * corners + k] + 1 << ' ';
      part << cells.references[i] << '\n';
    });
  }

  /// Writes edges of groups, and then those that only a mark names.
  void edges() {
    ReferencedCells edges;
    const auto add = [&](const Group& group, std::size_t at, int reference) {
      const Index a = group.members[at], b = group.members[at + 1];
      edge_numbers_.try_emplace(std::minmax(a, b), edges.references.size());
      edges.corners.insert(edges.corners.end(), {a, b});
      edges.references.push_back(reference);
    };
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const Group& group = groups_[i];
      if (group.dimension != 1 || marks_[i] != nullptr) continue;
      for (std::size_t k = 0; k + 1 < group.members.size(); k += 2) add(group, k, numbers_[i]);
      keep(i);
    }
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const Group& group = groups_[i];
      if (group.dimension != 1 || marks_[i] == nullptr) continue;
      for (std::size_t k = 0; k + 1 < group.members.size(); k += 2) {
        if (!edge_numbers_.contains(std::minmax(group.members[k], group.members[k + 1]))) add(group, k, 0);
      }
    }
    section("Edges", 2, edges);
  }

  void faces() {
    std::array<ReferencedCells, 2> faces;
    const auto add_face = [&](const ElementTable& of_group, Index f, int reference) {
      ReferencedCells& cells = faces[static_cast<std::size_t>(of_group.kind(f))];
      face_numbers_.try_emplace(corner_set(of_group.corners(f)), cells.references.size());
      add(cells, of_group.corners(f), reference);
    };
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const ElementTable& of_group = groups_[i].faces;
      if (of_group.size() == 0 || marks_[i] != nullptr) continue;
      for (Index f = 0; f < of_group.size(); ++f) add_face(of_group, f, numbers_[i]);
      keep(i);
    }
    for (std::size_t i = 0; i < groups_.size(); ++i) {  // faces that only a mark names
      const ElementTable& of_group = groups_[i].faces;
      if (marks_[i] == nullptr) continue;
      for (Index f = 0; f < of_group.size(); ++f)
        if (!face_numbers_.contains(corner_set(of_group.corners(f)))) add_face(of_group, f, 0);
    }
    section(kKeywords[0], 3, faces[0]);
    section(kKeywords[1], 4, faces[1]);
  }

  static void add(ReferencedCells& cells, std::span<const Index> corners, int reference) {
    cells.corners.insert(cells.corners.end(), corners.begin(), corners.end());
    cells.references.push_back(reference);
  }

  /// Writes the elements sorted by kinds, in the order in which the mesh has the first of each.
  void elements() {
    const std::size_t fields = kept_fields_.size();
    std::vector<int> references = references_of(Field::On::Elements, std::vector<int>(mesh_.elements.size(), 0));
    if (fields == kept_fields_.size()) {
      references = numbers_of_elements(mesh_, numbers_, title_, notes_);
      for (std::size_t i = 0; i < groups_.size(); ++i) {
        if (groups_[i].of_elements() && marks_[i] == nullptr) keep(i);
      }
    }
    std::array<ReferencedCells, kElementKindCount> by_kind;
    std::vector<ElementKind> order;
    bool in_order = true;
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      const ElementKind kind = mesh_.elements.kind(e);
      ReferencedCells& cells = by_kind[static_cast<std::size_t>(kind)];
      if (cells.references.empty()) order.push_back(kind);
      in_order = in_order && order.back() == kind;
      element_numbers_.push_back(cells.references.size());
      add(cells, file_corners(mesh_, e), references[e]);
    }
    for (const ElementKind kind : order) {
      const auto k = static_cast<std::size_t>(kind);
      section(kKeywords[k], info(kind).corners, by_kind[k]);
    }
    if (!in_order) notes_.emplace_back("The elements were sorted by their kinds, as MEDIT wants them.");
  }

  void marks() {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (marks_[i] == nullptr) continue;
      const std::vector<std::size_t> numbers = numbers_in_sections(groups_[i]);
      out_ << marks_[i]->keyword << '\n' << numbers.size() << '\n';
      for (const std::size_t number : numbers) out_ << number + 1 << '\n';
      kept_groups_.push_back(i);
    }
  }

  /// Numbers of a group's members, from 0, among the vertices, edges, faces or elements of their kind in this file.
  [[nodiscard]] std::vector<std::size_t> numbers_in_sections(const Group& group) const {
    std::vector<std::size_t> numbers;
    if (group.dimension == 0) numbers.assign(group.members.begin(), group.members.end());
    if (group.dimension == 1) {
      for (std::size_t k = 0; k + 1 < group.members.size(); k += 2)
        numbers.push_back(edge_numbers_.at(std::minmax(group.members[k], group.members[k + 1])));
    }
    if (group.of_elements()) {
      for (const Index e : group.members) numbers.push_back(element_numbers_[e]);
    }
    for (Index f = 0; f < group.faces.size(); ++f) numbers.push_back(face_numbers_.at(corner_set(group.faces.corners(f))));
    return numbers;
  }

  std::map<std::pair<Index, Index>, std::size_t> edge_numbers_;  // number of the first edge by its vertices, the smaller first
  std::map<std::array<Index, 4>, std::size_t> face_numbers_;     // number of the first face by its corners in ascending order
  std::vector<std::size_t> element_numbers_;                     // number of each element among those of its kind
  std::vector<const MeditMark*> marks_;                          // mark of each group; null: it is none
  std::vector<std::size_t> unnamed_;                             // groups whose names are not in the file
};

}  // namespace

Notes write_medit(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return MeditWriter(file, mesh, positions, context).write();
}

}  // namespace dmoscope
