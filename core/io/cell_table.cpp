#include "core/io/cell_table.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/base/memory.h"

namespace dmoscope {
namespace {

constexpr std::size_t kMostGroups = 4096;  // greatest number that lists and colours of groups are designed for

/// Groups of cells, looked up by their dimension and label.
class Groups {
 public:
  Groups(std::span<const OriginLabels> labels, Mesh& mesh, SourceFile& source, int top)
      : labels_(labels), mesh_(mesh), source_(source), top_(top), of_origin_(4 * labels.size()) {}

  /// Numbers of the groups that a cell of this origin and dimension belongs to.
  std::span<const std::size_t> of(std::uint32_t origin, int dimension) {
    std::optional<std::vector<std::size_t>>& known = of_origin_[4 * std::size_t{origin} + static_cast<std::size_t>(dimension)];
    if (!known) known = look_up(labels_[origin], dimension);
    return *known;
  }

 private:
  std::vector<std::size_t> look_up(const OriginLabels& origin, int dimension) {
    std::vector<std::size_t> found;
    if (dimension == top_ && !origin.of_elements) return found;
    for (const GroupLabel& label : origin.labels) {
      const auto key = std::make_tuple(dimension, label.role, label.code, label.name);
      const auto known = groups_.find(key);
      if (known != groups_.end()) {
        found.push_back(known->second);
      } else if (groups_.size() < kMostGroups) {
        found.push_back(groups_.emplace(key, add(label, dimension)).first->second);
      } else {
        source_.add_only_in_file(fmt::format("the numbers of all but {} groups", kMostGroups));
        if (dimension < top_) found.push_back(rest(label, dimension));
      }
    }
    return found;
  }

  std::size_t add(const GroupLabel& label, int dimension) {
    mesh_.groups.push_back({.name = label.name, .role = label.role, .code = label.code, .dimension = std::min(dimension, 2)});
    return mesh_.groups.size() - 1;
  }

  std::size_t rest(const GroupLabel& label, int dimension) {
    const auto [at, added] = rests_.try_emplace(dimension, mesh_.groups.size());
    if (added) add({"all other groups", label.role, 0}, dimension);
    return at->second;
  }

  std::span<const OriginLabels> labels_;
  Mesh& mesh_;
  SourceFile& source_;
  int top_;
  std::vector<std::optional<std::vector<std::size_t>>> of_origin_;  // by origin and dimension
  std::map<std::tuple<int, std::string, int, std::string>, std::size_t> groups_;
  std::map<int, std::size_t> rests_;  // by dimension, group of the cells beyond the limit
};

/// Kind of a group's members; groups are numbered within a kind.
enum class MemberKind : std::uint8_t { Vertices, Edges, Faces, Elements };

MemberKind member_kind_of(const Group& group) {
  if (group.dimension < 2) return group.dimension == 0 ? MemberKind::Vertices : MemberKind::Edges;
  return group.of_elements() ? MemberKind::Elements : MemberKind::Faces;
}

}  // namespace

void CellTable::reserve_more(std::size_t cells, std::size_t corners) {
  const auto more = [](auto& list, std::size_t count) {
    if (list.capacity() - list.size() < count) reserve_large(list, std::max(list.size() + count, 2 * list.capacity()));
  };
  more(shapes_, cells);
  more(origins_, cells);
  more(corners_, corners);
}

std::vector<std::span<const Index>> CellTable::corners_by_cell() const {
  std::vector<std::span<const Index>> cells;
  cells.reserve(size());
  const Index* at = corners_.data();
  for (const CellShape shape : shapes_) {
    cells.emplace_back(at, corners_of(shape));
    at += corners_of(shape);
  }
  return cells;
}

std::vector<Index> elements_of_cells(const CellTable& cells, const Mesh& mesh, std::span<const Index> rows) {
  std::vector<Index> elements(cells.size(), kNoIndex);
  for (Index e = 0; e < mesh.elements.size(); ++e) elements[rows.empty() ? e : rows[e]] = e;
  return elements;
}

std::vector<Index> split_cells(const CellTable& cells, std::span<const OriginLabels> labels, Mesh& mesh, SourceFile& source) {
  const int top = cells.dimension();
  if (top < 2) return {};
  std::size_t elements = 0, corners = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (dimension_of(cells.shape(c)) < top) continue;
    ++elements;
    corners += corners_of(cells.shape(c));
  }
  mesh.elements.reserve(elements, corners);
  std::vector<Index> rows;
  if (elements < cells.size()) rows.reserve(elements);
  Groups groups(labels, mesh, source, top);
  const Index* at = cells.all_corners().data();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const CellShape shape = cells.shape(c);
    const std::span<const Index> of_cell(at, corners_of(shape));
    at += of_cell.size();
    const int dimension = dimension_of(shape);
    const Index element = mesh.elements.size();
    if (dimension == top) {
      add_element(mesh, *kind_of(shape), of_cell, source);
      if (elements < cells.size()) rows.push_back(static_cast<Index>(c));
    }
    for (const std::size_t g : groups.of(cells.origin(c), dimension)) {
      Group& group = mesh.groups[g];
      if (dimension == top) {
        group.members.push_back(element);
      } else if (dimension == 2) {
        group.faces.add(*kind_of(shape), of_cell);
      } else {
        group.members.insert(group.members.end(), of_cell.begin(), of_cell.end());
      }
    }
  }
  return rows;
}

std::vector<int> numbers_of_groups(std::span<const Group> groups) {
  std::array<std::set<int>, 4> used;
  std::vector<int> numbers(groups.size(), 0);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Group& group = groups[i];
    if (group.code > 0 && used[static_cast<std::size_t>(member_kind_of(group))].insert(group.code).second) numbers[i] = group.code;
  }
  std::array<int, 4> next{1, 1, 1, 1};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (numbers[i] != 0) continue;
    const auto kind = static_cast<std::size_t>(member_kind_of(groups[i]));
    while (!used[kind].insert(next[kind]).second) ++next[kind];
    numbers[i] = next[kind];
  }
  return numbers;
}

std::vector<int> numbers_of_elements(const Mesh& mesh, std::span<const int> numbers, std::string_view format_title, Notes& notes) {
  std::vector<int> of_elements(mesh.elements.size(), 0);
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    const Group& group = mesh.groups[i];
    if (!group.of_elements() || numbers[i] == 0) continue;
    std::size_t lost = 0;
    for (const Index e : group.members) {
      if (of_elements[e] == 0) {
        of_elements[e] = numbers[i];
      } else if (of_elements[e] != numbers[i]) {
        ++lost;
      }
    }
    if (lost > 0) {
      notes.push_back(fmt::format("Group \"{}\" lost {} elements that are in a group before it; {} holds one for each.", group.name, lost,
                                  format_title));
    }
  }
  return of_elements;
}

}  // namespace dmoscope
