#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/io/abaqus/abaqus.h"
#include "core/io/element_sides.h"
#include "core/mesh/faces.h"

namespace dmoscope {
namespace {

/// Calls each(number) for the numbers in a set that exist in the file, some perhaps twice. `numbers`: all numbers in the file.
template <class Each>
void for_numbers(const AbaqusSet& set, std::span<const std::int32_t> numbers, Each each) {
  for (const AbaqusSet::Range& range : set.ranges()) {
    const std::int64_t count = (std::int64_t{range.last} - range.first) / range.step + 1;
    if (count <= static_cast<std::int64_t>(numbers.size())) {
      for (std::int64_t i = 0; i < count; ++i) each(range.first + i * range.step);
      continue;
    }
    for (const std::int32_t number : numbers) {
      if (number >= range.first && number <= range.last && (number - range.first) % range.step == 0) each(number);
    }
  }
}

/// Makes groups, and limits their size against that of the file: a range of a few bytes may name every element.
class GroupMaker {
 public:
  GroupMaker(const NumberedMesh& numbered, std::span<const Index> elements, Mesh& mesh, SourceFile& source)
      : numbered_(numbered),
        elements_(elements),
        mesh_(mesh),
        source_(source),
        room_(kLeastRoom + 16 * source.bytes().size()),
        in_set_(elements.size(), 0),
        corners_(numbered.cells().corners_by_cell()) {}

  void node_set(const std::string& name, std::string_view role, const AbaqusSet& set) {
    std::vector<Index> members;
    std::size_t missing = 0;
    std::vector<std::uint8_t> met(mesh_.positions.size(), 0);
    if (!take_room(set, numbered_.node_count())) return;
    for_numbers(set, numbered_.node_numbers(), [&](std::int64_t number) {
      const Index vertex = numbered_.vertex(number);
      if (vertex == kNoIndex) {
        ++missing;
      } else if (met[vertex] == 0) {
        met[vertex] = 1;
        members.push_back(vertex);
      }
    });
    say_missing(name, role, missing, "nodes");
    if (members.empty()) return;
    mesh_.groups.push_back({.name = name, .role = std::string(role), .code = 0, .dimension = 0, .members = std::move(members)});
  }

  void element_set(const std::string& name, const AbaqusSet& set) {
    Parts parts;
    std::size_t missing = 0;
    std::vector<std::uint8_t> met(elements_.size(), 0);
    if (!take_room(set, elements_.size())) return;
    for_numbers(set, numbered_.cell_numbers(), [&](std::int64_t number) {
      const Index cell = numbered_.cell(number);
      if (cell == kNoIndex) {
        ++missing;
      } else if (met[cell] == 0) {
        met[cell] = in_set_[cell] = 1;
        add_cell(parts, cell);
      }
    });
    say_missing(name, kAbaqusElementSet, missing, "elements of the mesh");
    add(std::move(parts), name, kAbaqusElementSet);
  }

  void surface(const AbaqusSets::Surface& surface) {
    Parts parts;
    std::size_t unknown = 0;
    for (const AbaqusSets::SurfaceItem& item : surface.items) {
      if (!take_room(item.set, elements_.size())) return;
      for_numbers(item.set, numbered_.cell_numbers(), [&](std::int64_t number) {
        const Index cell = numbered_.cell(number);
        if (cell == kNoIndex || !add_side(parts, cell, item.side)) ++unknown;
      });
    }
    if (unknown > 0) {
      source_.add_only_in_file(fmt::format("{} sides of the surface \"{}\"", unknown, surface.name));
    }
    add(std::move(parts), surface.name, kAbaqusSurface);
  }

  /// Adds groups of cells of fewer dimensions that are in no set.
  void rest(std::span<const std::string> types) {
    for (std::size_t type = 0; type < types.size(); ++type) {
      Parts parts;
      for (std::size_t c = 0; c < elements_.size(); ++c) {
        if (numbered_.cells().origin(c) == type && elements_[c] == kNoIndex && in_set_[c] == 0) add_cell(parts, static_cast<Index>(c));
      }
      add(std::move(parts), types[type], "element type");
    }
  }

 private:
  static constexpr std::size_t kLeastRoom = 65536;

  struct Parts {
    std::vector<Index> points, edges, elements;
    ElementTable faces;
  };

  bool take_room(const AbaqusSet& set, std::size_t most) {
    std::size_t count = 0;
    for (const AbaqusSet::Range& range : set.ranges()) {
      count += std::min(most, static_cast<std::size_t>((std::int64_t{range.last} - range.first) / range.step + 1));
    }
    if (count > room_) {
      source_.add_only_in_file("sets that hold far more members than the file has numbers");
      return false;
    }
    room_ -= count;
    return true;
  }

  void add_cell(Parts& parts, Index cell) {
    const CellShape shape = numbered_.cells().shape(cell);
    const std::span<const Index> of_cell = corners_[cell];
    if (elements_[cell] != kNoIndex) {
      parts.elements.push_back(elements_[cell]);
    } else if (const auto kind = kind_of(shape)) {
      parts.faces.add(*kind, of_cell);
    } else {
      std::vector<Index>& list = shape == CellShape::Line ? parts.edges : parts.points;
      list.insert(list.end(), of_cell.begin(), of_cell.end());
    }
  }

  /// Adds a side of a cell. False: it has no such side.
  bool add_side(Parts& parts, Index cell, std::string_view side) {
    const auto kind = kind_of(numbered_.cells().shape(cell));
    if (!kind || side.empty()) return false;
    const bool volume = info(*kind).dimension == 3;
    if (!volume && (side == "SPOS" || side == "SNEG")) {
      add_cell(parts, cell);
      return true;
    }
    if (side.size() != 2 || !(side[0] == 'S' || (side[0] == 'E' && !volume)) || side[1] < '1') return false;
    const auto number = static_cast<std::size_t>(side[1] - '1');
    const std::span<const Index> of_cell = corners_[cell];
    if (!volume) {
      if (number >= of_cell.size()) return false;
      parts.edges.insert(parts.edges.end(), {of_cell[number], of_cell[(number + 1) % of_cell.size()]});
      return true;
    }
    // Abaqus numbers the faces of all its solids like faces_of(), and lists each as seen from inside.
    if (number >= faces_of(*kind).size()) return false;
    const LocalFace& face = faces_of(*kind)[number];
    std::array<Index, 4> vertices{};
    for (Index k = 0; k < face.count; ++k) vertices[k] = of_cell[face.corners[k]];
    parts.faces.add(face.count == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, std::span(vertices).first(face.count));
    return true;
  }

  void add(Parts parts, const std::string& name, std::string_view role) {
    const auto group = [&](int dimension) -> Group& {
      return mesh_.groups.emplace_back(Group{.name = name, .role = std::string(role), .code = 0, .dimension = dimension, .faces = {}});
    };
    if (!parts.elements.empty()) group(2).members = std::move(parts.elements);
    if (parts.faces.size() > 0) group(2).faces = std::move(parts.faces);
    if (!parts.edges.empty()) group(1).members = std::move(parts.edges);
    if (!parts.points.empty()) group(0).members = std::move(parts.points);
  }

  void say_missing(const std::string& name, std::string_view role, std::size_t missing, std::string_view what) {
    if (missing > 0) source_.add_note(fmt::format("{} members of the {} \"{}\" are no {}.", missing, role, name, what));
  }

  const NumberedMesh& numbered_;
  std::span<const Index> elements_;
  Mesh& mesh_;
  SourceFile& source_;
  std::size_t room_;
  std::vector<std::uint8_t> in_set_;             // flags by cell
  std::vector<std::span<const Index>> corners_;  // corners of each cell
};

}  // namespace

std::string abaqus_key(std::string_view name) {
  const std::string_view within = unquoted(name);
  return within.size() < name.size() ? std::string(within) : in_capitals(name);
}

void AbaqusSet::add(std::int32_t number) {
  if (!ranges_.empty() && ranges_.back().step == 1 && ranges_.back().last == number - 1) {
    ranges_.back().last = number;
  } else {
    ranges_.push_back({number, number, 1});
  }
}

void AbaqusSet::add(const AbaqusSet& other) {
  const std::vector<Range> copy = other.ranges_;  // copied, since it may be the same set
  ranges_.insert(ranges_.end(), copy.begin(), copy.end());
}

void AbaqusSet::tidy() {
  if (ranges_.size() < 2) return;
  std::vector<std::size_t> order(ranges_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return ranges_[a] < ranges_[b]; });
  // Avoids std::ranges::unique, which clang 14 cannot compile.
  const auto same = std::unique(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ranges_[a] == ranges_[b]; });
  order.erase(same, order.end());
  std::ranges::sort(order);
  std::vector<Range> kept(order.size());
  std::ranges::transform(order, kept.begin(), [&](std::size_t i) { return ranges_[i]; });
  ranges_ = std::move(kept);
}

AbaqusSet& AbaqusSets::set(Of of, std::string_view scope, std::string_view name, bool shown) {
  const std::string key = abaqus_key(name);
  Named*& known = by_name_[{of, std::string(scope) + '\n' + key}];
  if (known == nullptr) {
    const bool quoted = name.size() >= 2 && name.front() == '"';
    known = &sets_.emplace_back(Named{quoted ? key : std::string(name), of, shown, {}});
    entries_.push_back({known, nullptr});
  }
  return known->set;
}

const AbaqusSet* AbaqusSets::find(Of of, std::string_view scope, std::string_view name) const {
  const std::string key = abaqus_key(name);
  const std::size_t dot = key.rfind('.');
  for (const std::string& one : {key, dot == std::string::npos ? std::string() : key.substr(dot + 1)}) {
    if (one.empty()) continue;
    for (const std::string_view where : {scope, std::string_view()}) {
      const auto found = by_name_.find({of, std::string(where) + '\n' + one});
      if (found != by_name_.end()) return &found->second->set;
    }
  }
  return nullptr;
}

AbaqusSets::Surface& AbaqusSets::add_surface(std::string name, bool of_nodes) {
  Surface& surface = surfaces_.emplace_back(Surface{std::move(name), of_nodes, {}});
  entries_.push_back({nullptr, &surface});
  return surface;
}

void AbaqusSets::add_groups(const NumberedMesh& numbered, std::span<const Index> elements, std::span<const std::string> types, Mesh& mesh,
                            SourceFile& source) const {
  constexpr std::size_t kMostGroups = 4096;  // greatest number that lists and colours of groups are designed for
  GroupMaker maker(numbered, elements, mesh, source);
  for (const Entry& entry : entries_) {
    if (mesh.groups.size() >= kMostGroups) {
      source.add_only_in_file(fmt::format("all sets beyond {}", kMostGroups));
      break;
    }
    if (entry.surface != nullptr && entry.surface->of_nodes) {
      AbaqusSet all;
      for (const SurfaceItem& item : entry.surface->items) all.add(item.set);
      maker.node_set(entry.surface->name, kAbaqusSurface, all);
    } else if (entry.surface != nullptr) {
      maker.surface(*entry.surface);
    } else if (entry.set->shown && entry.set->of == Of::Nodes) {
      maker.node_set(entry.set->name, kAbaqusNodeSet, entry.set->set);
    } else if (entry.set->shown) {
      maker.element_set(entry.set->name, entry.set->set);
    }
  }
  maker.rest(types);
}

}  // namespace dmoscope
