// Writer of new Abaqus input files: nodes, elements, sets and surfaces.

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/io/abaqus/abaqus.h"
#include "core/io/element_sides.h"
#include "core/io/mesh_writer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

class AbaqusWriter : MeshWriter {
 public:
  AbaqusWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, kAbaqusFormat.info.title, "surface") {}

  Notes write() {
    out_ << "*HEADING\n" << heading() << '\n';
    nodes();
    elements();
    for (std::size_t i = 0; i < groups_.size(); ++i) group(i);
    return finish();
  }

 private:
  /// Heading in one line that is no keyword.
  [[nodiscard]] std::string heading() const {
    std::string text = mesh_.title.empty() ? mesh_.name : mesh_.title;
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    while (text.starts_with('*') || text.starts_with(' ')) text.erase(0, 1);
    return text.empty() ? "mesh" : text;
  }

  void nodes() {
    out_ << "*NODE\n";
    std::atomic<std::size_t> rounded = 0;
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << v + 1;
      const Vec3 p = positions_[v];
      for (const double x : {p.x, p.y, p.z}) {
        const FieldNumber number = number_in_field(x, kAbaqusNumber, ExponentStyle::Letter);
        if (number.value != x) ++rounded;
        part << ", " << number.text;
      }
      part << '\n';
    });
    if (rounded > 0) {
      notes_.push_back(
          fmt::format("{} coordinates were rounded to the {} characters that Abaqus has for a number.", rounded.load(), kAbaqusNumber));
    }
  }

  [[nodiscard]] std::string_view type_of(ElementKind kind) const {
    constexpr std::array<std::string_view, kElementKindCount> kInSpace{"S3", "S4", "C3D4", "C3D8", "C3D6", "C3D5"};  // by ElementKind
    if (plane_ && info(kind).dimension == 2) return kind == ElementKind::Triangle ? "CPS3" : "CPS4";
    return kInSpace[static_cast<std::size_t>(kind)];
  }

  /// Writes the elements in the mesh's order, with a keyword for each run of one kind.
  void elements() {
    for (std::size_t first = 0; first < mesh_.elements.size();) {
      const ElementKind kind = mesh_.elements.kind(static_cast<Index>(first));
      std::size_t last = first;
      while (last < mesh_.elements.size() && mesh_.elements.kind(static_cast<Index>(last)) == kind) ++last;
      out_ << "*ELEMENT, TYPE=" << type_of(kind) << '\n';
      const auto line = [&](auto& out, std::size_t i) {
        out << first + i + 1;
        for (const Index c : file_corners(mesh_, first + i)) out << ", " << c + 1;
        out << '\n';
      };
      constexpr std::size_t kMany = 64;  // number of elements for which threads pay
      if (last - first >= kMany) {
        out_.for_each(last - first, [&](TextBuffer& part, std::size_t i) { line(part, i); });
      } else {
        for (std::size_t i = 0; i < last - first; ++i) line(out_, i);
      }
      first = last;
    }
  }

  /// A valid name that no other set of this kind has.
  std::string name_of(const Group& group, std::set<std::string>& taken) {
    constexpr std::size_t kLongest = 70;  // characters: 80 less room for a number
    std::string name = group.name.substr(0, kLongest);
    const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
    for (char& c : name) {
      if (!letter(c) && !(c >= '0' && c <= '9') && c != '-') c = '_';
    }
    if (name.empty() || !letter(name.front())) name.insert(0, "G_");
    const std::string wanted = name;
    for (int n = 2; !taken.insert(abaqus_key(name)).second; ++n) name = fmt::format("{}-{}", wanted, n);
    if (name != group.name) notes_.push_back(fmt::format("Group \"{}\" is named {} in the file.", group.name, name));
    return name;
  }

  void group(std::size_t i) {
    const Group& group = groups_[i];
    if (group.of_elements()) {
      if (group.members.empty()) return;
      list("*ELSET, ELSET=", name_of(group, element_sets_), group.members);
    } else if (group.dimension == 2) {
      if (!surface(group, sides_of_faces(mesh_, group.faces), "faces", "S")) return;
    } else if (group.dimension == 1) {
      if (group.members.empty()) return;
      if (volume_) return vertices_of_edges(i);
      if (!surface(group, sides_of_edges(mesh_, group.members), "edges", plane_ ? "S" : "E")) return;
    } else {
      if (group.members.empty()) return;
      list("*NSET, NSET=", name_of(group, node_sets_), group.members);
    }
    kept_groups_.push_back(i);
  }

  void list(std::string_view keyword, const std::string& name, std::span<const Index> members) {
    constexpr std::size_t kOnLine = 16;
    out_ << keyword << name << '\n';
    for (std::size_t k = 0; k < members.size(); ++k) {
      out_ << members[k] + 1 << (k % kOnLine == kOnLine - 1 || k + 1 == members.size() ? "\n" : ", ");
    }
  }

  /// Writes a surface. False: none of its faces or edges is a side of an element.
  bool surface(const Group& group, const std::vector<std::optional<ElementSide>>& sides, std::string_view plural, std::string_view letter) {
    const auto lost = static_cast<std::size_t>(std::ranges::count_if(sides, [](const auto& s) { return !s; }));
    if (lost == sides.size()) return false;
    if (lost > 0) {
      notes_.push_back(
          fmt::format("Group \"{}\" lost {} of its {} {}, which are no sides of elements.", group.name, lost, sides.size(), plural));
    }
    out_ << "*SURFACE, TYPE=ELEMENT, NAME=" << name_of(group, surfaces_) << '\n';
    for (const std::optional<ElementSide>& side : sides) {
      if (!side) continue;
      // Undoes the reversal of an element, which the file has as it was read.
      out_ << side->element + 1 << ", " << letter << number_in_file(*side) << '\n';
    }
    return true;
  }

  /// Number, from 1, of a side of the element in the file's own winding.
  [[nodiscard]] Index number_in_file(ElementSide side) const {
    if (mesh_.flipped.empty() || mesh_.flipped[side.element] == 0) return side.side + 1;
    ElementTable one;
    one.add(mesh_.elements.kind(side.element), file_corners(mesh_, side.element));
    auto wanted = vertices_of_side(mesh_.elements, side);
    std::ranges::sort(wanted);
    for (Index s = 0; s < side_count(one.kind(0)); ++s) {
      auto there = vertices_of_side(one, {0, s});
      std::ranges::sort(there);
      if (there == wanted) return s + 1;
    }
    return side.side + 1;
  }

  /// Writes the vertices of edges in a volume mesh, which are no sides.
  void vertices_of_edges(std::size_t i) {
    std::vector<Index> members;
    std::set<Index> met;
    for (const Index v : groups_[i].members) {
      if (met.insert(v).second) members.push_back(v);
    }
    list("*NSET, NSET=", name_of(groups_[i], node_sets_), members);
    notes_.push_back(fmt::format("Group \"{}\" was written as the set of its vertices; Abaqus has no edges of solids.", groups_[i].name));
    kept_groups_.push_back(i);
  }

  const bool volume_ = is_volume(), plane_ = is_flat();
  std::set<std::string> node_sets_, element_sets_, surfaces_;
};

}  // namespace

Notes write_abaqus(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return AbaqusWriter(file, mesh, positions, context).write();
}

}  // namespace dmoscope
