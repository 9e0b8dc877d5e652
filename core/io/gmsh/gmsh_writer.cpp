// Writer of new MSH files: version 2.2, ASCII. Groups become physical groups with their names, fields data of nodes and elements.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/io/gmsh/gmsh.h"
#include "core/io/mesh_writer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

class GmshWriter : MeshWriter {
 public:
  GmshWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, kGmshFormat.info.title, "physical group") {}

  Notes write() {
    out_ << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    if (!mesh_.title.empty()) out_ << "$Comments\n" << one_line(mesh_.title) << "\n$EndComments\n";
    const std::vector<int> physical = numbers_of_elements(mesh_, numbers_, title_, notes_);
    names();
    nodes();
    elements(physical);
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) data(i);
    return finish();
  }

 private:
  static std::string one_line(std::string text) {
    text = without_line_ends(std::move(text));
    std::ranges::replace(text, '"', '\'');
    return text;
  }

  /// The dimension of a group's members.
  [[nodiscard]] int dimension(const Group& group) const {
    if (!group.of_elements() || group.members.empty()) return group.dimension;
    return info(mesh_.elements.kind(group.members.front())).dimension;
  }

  [[nodiscard]] static std::size_t members(const Group& group) {
    if (group.of_elements()) return 0;  // elements have no lines of their own
    return group.dimension == 2 ? group.faces.size() : group.members.size() / static_cast<std::size_t>(group.dimension + 1);
  }

  void names() {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (members(groups_[i]) > 0 || !groups_[i].members.empty()) kept_groups_.push_back(i);
    }
    if (kept_groups_.empty()) return;
    out_ << "$PhysicalNames\n" << kept_groups_.size() << '\n';
    for (const std::size_t i : kept_groups_) {
      out_ << dimension(groups_[i]) << ' ' << numbers_[i] << " \"" << one_line(groups_[i].name) << "\"\n";
    }
    out_ << "$EndPhysicalNames\n";
  }

  void nodes() {
    out_ << "$Nodes\n" << positions_.size() << '\n';
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << v + 1 << ' ' << positions_[v].x << ' ' << positions_[v].y << ' ' << positions_[v].z << '\n';
    });
    out_ << "$EndNodes\n";
  }

  static void line(TextBuffer& part, std::size_t number, CellShape shape, int physical, int entity, std::span<const Index> corners) {
    part << number << ' ' << kGmshTypes[static_cast<std::size_t>(shape)] << " 2 " << physical << ' ' << entity;
    for (const Index c : corners) part << ' ' << c + 1;
    part << '\n';
  }

  /// Writes the members of groups first, then the elements, like Gmsh.
  void elements(std::span<const int> physical) {
    std::size_t before = 0;
    for (const Group& group : groups_) before += members(group);
    const std::vector<int> entities = entities_of(physical);
    out_ << "$Elements\n" << before + mesh_.elements.size() << '\n';
    std::size_t number = 1;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const Group& group = groups_[i];
      const auto corners = static_cast<std::size_t>(group.dimension + 1);  // corners of vertices and edges
      out_.for_each(members(group), [&](TextBuffer& part, std::size_t m) {
        if (group.dimension == 2) {
          const auto face = static_cast<Index>(m);
          line(part, number + m, shape_of(group.faces.kind(face)), numbers_[i], numbers_[i], group.faces.corners(face));
        } else {
          const auto shape = group.dimension == 0 ? CellShape::Point : CellShape::Line;
          line(part, number + m, shape, numbers_[i], numbers_[i], std::span(group.members).subspan(m * corners, corners));
        }
      });
      number += members(group);
    }
    out_.for_each(mesh_.elements.size(), [&](TextBuffer& part, std::size_t i) {
      line(part, number + i, shape_of(mesh_.elements.kinds()[i]), physical[i], entities[i], file_corners(mesh_, i));
    });
    out_ << "$EndElements\n";
    first_element_ = number;
  }

  /// Entities for the elements: those of Gmsh if the mesh has kept them, else one for each physical group; they count from 1.
  std::vector<int> entities_of(std::span<const int> physical) {
    std::vector<int> entities(physical.begin(), physical.end());
    std::replace(entities.begin(), entities.end(), 0, 1);
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (field.name != kGmshGeometrical || field.on != Field::On::Elements || field.values.size() != entities.size()) continue;
      auto kept = whole_values(field, 1.0);
      if (!kept) continue;
      kept_fields_.push_back(i);
      return *std::move(kept);
    }
    return entities;
  }

  void data(std::size_t i) {
    const Field& field = mesh_.fields[i];
    if (std::find(kept_fields_.begin(), kept_fields_.end(), i) != kept_fields_.end()) return;
    const bool of_nodes = field.on == Field::On::Vertices;
    const std::size_t things = of_nodes ? positions_.size() : mesh_.elements.size();
    const auto n = static_cast<std::size_t>(field.components);
    if (!is_of(field, field.on)) return;
    kept_fields_.push_back(i);
    const auto has_some = [&](std::size_t thing) {
      const auto row = std::span(field.values).subspan(thing * n, n);
      return !std::all_of(row.begin(), row.end(), [](double v) { return std::isnan(v); });
    };
    std::size_t with = 0;
    for (std::size_t thing = 0; thing < things; ++thing) with += has_some(thing) ? 1 : 0;
    const std::string_view section = of_nodes ? "NodeData" : "ElementData";
    out_ << '$' << section << "\n1\n\"" << one_line(field.name) << "\"\n1\n0\n3\n0\n" << n << '\n' << with << '\n';
    const std::size_t first = of_nodes ? 1 : first_element_;
    out_.for_each(things, [&](TextBuffer& part, std::size_t thing) {
      if (!has_some(thing)) return;
      part << first + thing;
      for (std::size_t k = 0; k < n; ++k) part << ' ' << field.values[thing * n + k];
      part << '\n';
    });
    out_ << "$End" << section << '\n';
  }

  std::size_t first_element_ = 1;
};

}  // namespace

Notes write_gmsh(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return GmshWriter(file, mesh, positions, context).write();
}

}  // namespace dmoscope
