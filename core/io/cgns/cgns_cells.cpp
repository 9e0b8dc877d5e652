// Cells of CGNS: sections of unstructured zones, blocks of structured ones, and the boundary conditions on them.

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/io/cgns/cgns.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

// Element types and boundary conditions of CGNS.

namespace {

constexpr auto kCgnsTypes = std::to_array<std::string_view>(
    {"null",     "user defined", "NODE",     "BAR_2",    "BAR_3",   "TRI_3",   "TRI_6",    "QUAD_4",     "QUAD_8",
     "QUAD_9",   "TETRA_4",      "TETRA_10", "PYRA_5",   "PYRA_14", "PENTA_6", "PENTA_15", "PENTA_18",   "HEXA_8",
     "HEXA_20",  "HEXA_27",      "MIXED",    "PYRA_13",  "NGON_n",  "NFACE_n", "BAR_4",    "TRI_9",      "TRI_10",
     "QUAD_12",  "QUAD_16",      "TETRA_16", "TETRA_20", "PYRA_21", "PYRA_29", "PYRA_30",  "PENTA_24",   "PENTA_38",
     "PENTA_40", "HEXA_32",      "HEXA_56",  "HEXA_64",  "BAR_5",   "TRI_12",  "TRI_15",   "QUAD_P4_16", "QUAD_25"});

/// Reads the numbers of a range or a list, of whatever kind.
bool take_numbers(const CgnsTree& tree, const CgnsNode& node, CgnsCondition& into) {
  for (const CgnsNode& child : tree.children(node.path)) {
    const bool range = child.label == "IndexRange_t" && (child.name == "PointRange" || child.name == "ElementRange");
    const bool list = child.label == "IndexArray_t" && (child.name == "PointList" || child.name == "ElementList");
    if (!range && !list) continue;
    into.numbers = tree.wholes(child);
    into.of_range = range;
    if (child.name.starts_with("Element") && into.location.empty()) into.location = "FaceCenter";
    return true;
  }
  return false;
}

}  // namespace

std::optional<CellShape> cgns_shape(std::int64_t type) noexcept {
  constexpr std::array<std::int64_t, kCellShapeCount> kShapeTypes{2, 3, 5, 7, 10, 17, 14, 12};  // types in the order of CellShape
  const auto* const at = std::ranges::find(kShapeTypes, type);
  return at == kShapeTypes.end() ? std::nullopt : std::optional(static_cast<CellShape>(at - kShapeTypes.begin()));
}

std::string cgns_type_name(std::int64_t type) {
  if (type >= 0 && static_cast<std::size_t>(type) < kCgnsTypes.size()) return std::string(kCgnsTypes[static_cast<std::size_t>(type)]);
  return fmt::format("of type {}", type);
}

std::vector<CgnsCondition> read_cgns_conditions(const CgnsTree& tree, const CgnsZone& zone) {
  std::vector<CgnsCondition> found;
  for (const CgnsNode& all : tree.children(zone.node, "ZoneBC_t")) {
    for (const CgnsNode& node : tree.children(all, "BC_t")) {
      CgnsCondition one{.name = node.name, .family = {}, .numbers = {}, .location = {}};
      if (const auto location = tree.child(node, "GridLocation_t")) one.location = tree.text(*location);
      if (const auto family = tree.child(node, "FamilyName_t")) one.family = tree.text(*family);
      if (!take_numbers(tree, node, one)) continue;
      one.of_vertices = one.location.empty() || one.location == "Vertex";
      found.push_back(std::move(one));
    }
  }
  return found;
}

namespace {

constexpr std::int64_t kMixed = 20;

struct Section {
  CgnsNode node;
  std::int64_t type = 0;
  std::int64_t first = 0, last = 0;  // numbers of its first and last element
  std::size_t offset = 0;            // offset among the zone's cells
  bool divides = false;              // whether it distinguishes elements of the same kind
};

class CgnsCellReader {
 public:
  CgnsCellReader(const CgnsTree& tree, const CgnsPoints& points, SourceFile& source, Progress& progress)
      : tree_(tree), points_(points), source_(source), progress_(progress) {}

  CgnsCells read() {
    for (const CgnsZone& zone : points_.zones) {
      progress_.check();
      found_.first_cell.push_back(found_.cells.size());
      zone_labels(zone);
      conditions_ = read_cgns_conditions(tree_, zone);
      if (zone.structured) {
        structured(zone);
      } else {
        unstructured(zone);
      }
      for (const CgnsCondition& one : conditions_) {
        if (one.of_vertices && !zone.structured) vertices(zone, one);
      }
    }
    found_.first_cell.push_back(found_.cells.size());
    for (auto& [name, group] : vertex_groups_) found_.vertex_groups.push_back(std::move(group));
    return std::move(found_);
  }

 private:
  void zone_labels(const CgnsZone& zone) {
    zone_labels_.clear();
    if (points_.zones.size() == 1) return;
    zone_labels_.push_back({zone.node.name, std::string(kCgnsZone), 0});
    if (const auto family = tree_.child(zone.node, "FamilyName_t")) {
      const std::string name = tree_.text(*family);
      if (!name.empty() && name != zone.node.name) zone_labels_.push_back({name, std::string(kCgnsFamily), 0});
    }
  }

  static void add_labels(std::vector<GroupLabel>& labels, const CgnsCondition& one) {
    labels.push_back({one.name, std::string(kCgnsCondition), 0});
    if (!one.family.empty() && one.family != one.name) labels.push_back({one.family, std::string(kCgnsFamily), 0});
  }

  /// Adds an origin for cells with these labels.
  std::uint32_t add_origin(std::vector<GroupLabel> labels) {
    found_.labels.push_back({std::move(labels), true});
    return static_cast<std::uint32_t>(found_.labels.size() - 1);
  }

  // --- Unstructured zones ---

  void unstructured(const CgnsZone& zone) {
    sections_of(zone);
    std::size_t count = 0;
    for (Section& section : sections_) {
      section.offset = count;
      count += static_cast<std::size_t>(section.last - section.first + 1);
    }
    tree_.file().take_room(count, sizeof(std::uint32_t));
    mark_of_.assign(count, 0);
    marks_.assign(1, {});
    known_marks_.clear();
    for (std::uint32_t c = 0; c < conditions_.size(); ++c) mark(zone, c);
    for (const Section& section : sections_) elements(zone, section);
  }

  void sections_of(const CgnsZone& zone) {
    sections_.clear();
    for (const CgnsNode& node : tree_.children(zone.node, "Elements_t")) {
      const std::vector<std::int64_t> type = tree_.wholes(node);
      const auto range = tree_.named(node, "ElementRange");
      const std::vector<std::int64_t> numbers = range ? tree_.wholes(*range) : std::vector<std::int64_t>();
      if (type.empty() || numbers.size() != 2 || numbers[0] < 1 || numbers[1] < numbers[0] || numbers[1] - numbers[0] >= kNoIndex) {
        tree_.fail(node, "damaged: it does not say what elements it has");
      }
      if (type[0] != kMixed && !cgns_shape(type[0])) {
        const bool polyhedra = type[0] == 22 || type[0] == 23;
        tree_.fail(node, fmt::format(
                             "elements {} are not read: {}", cgns_type_name(type[0]),
                             polyhedra ? "convert these polyhedra to tetrahedra" : "only elements without nodes beyond their corners are"));
      }
      sections_.push_back({.node = node, .type = type[0], .first = numbers[0], .last = numbers[1]});
    }
    std::ranges::sort(sections_, {}, &Section::first);
    for (std::size_t s = 1; s < sections_.size(); ++s) {
      if (sections_[s].first <= sections_[s - 1].last) tree_.fail(sections_[s].node, "its elements have numbers of another section");
    }
    // Finds sections that distinguish elements of one kind: most programs make one section for each kind, which says nothing of materials.
    for (Section& one : sections_) {
      one.divides = std::ranges::any_of(sections_, [&](const Section& other) { return &other != &one && share_kind(one, other); });
    }
  }

  [[nodiscard]] bool share_kind(const Section& a, const Section& b) const {
    const auto inside = [&](const Section& one) {
      return one.type == kMixed || dimension_of(*cgns_shape(one.type)) == points_.cell_dimension;
    };
    return inside(a) && inside(b) && (a.type == b.type || a.type == kMixed || b.type == kMixed);
  }

  /// Marks the elements that a condition names.
  void mark(const CgnsZone& zone, std::uint32_t condition) {
    const CgnsCondition& one = conditions_[condition];
    if (one.of_vertices) return;
    if (one.of_range && (one.numbers.size() != 2 || one.numbers[1] - one.numbers[0] >= kNoIndex)) {
      tree_.fail(zone.node, fmt::format("boundary condition {}: a range that is none", quote_token(one.name)));
    }
    const auto each = [&](std::int64_t number) {
      const auto after = std::ranges::upper_bound(sections_, number, {}, &Section::first);
      if (after == sections_.begin() || number > std::prev(after)->last) {
        tree_.fail(zone.node, fmt::format("boundary condition {}: the zone has no element {}", quote_token(one.name), number));
      }
      const Section& section = *std::prev(after);
      std::uint32_t& mark = mark_of_[section.offset + static_cast<std::size_t>(number - section.first)];
      mark = grown(mark, condition);
    };
    if (one.of_range) {
      for (std::int64_t number = one.numbers[0]; number <= one.numbers[1]; ++number) each(number);
    } else {
      for (const std::int64_t number : one.numbers) each(number);
    }
  }

  /// Number of the set of conditions with one more condition added.
  std::uint32_t grown(std::uint32_t mark, std::uint32_t condition) {
    if (!marks_[mark].empty() && marks_[mark].back() == condition) return mark;
    const auto [at, added] = known_marks_.try_emplace({mark, condition}, static_cast<std::uint32_t>(marks_.size()));
    if (added) {
      marks_.push_back(marks_[mark]);
      marks_.back().push_back(condition);
    }
    return at->second;
  }

  std::uint32_t origin(const Section& section, std::uint32_t mark, int dimension) {
    const auto [at, added] = origins_.try_emplace({section.node.path, mark, dimension}, 0);
    if (!added) return at->second;
    std::vector<GroupLabel> labels;
    const bool inside = dimension == points_.cell_dimension;
    if (inside) labels = zone_labels_;
    if (inside ? section.divides : marks_[mark].empty()) labels.push_back({section.node.name, std::string(kCgnsSection), 0});
    for (const std::uint32_t condition : marks_[mark]) add_labels(labels, conditions_[condition]);
    return at->second = add_origin(std::move(labels));
  }

  void elements(const CgnsZone& zone, const Section& section) {
    const auto node = tree_.named(section.node, "ElementConnectivity");
    if (!node) tree_.fail(section.node, "it has no ElementConnectivity");
    const std::vector<std::int64_t> numbers = tree_.wholes(*node);
    const auto count = static_cast<std::size_t>(section.last - section.first + 1);
    std::size_t at = 0;
    std::array<Index, 8> corners{};
    std::optional<CellShape> shape = cgns_shape(section.type);
    if (shape) found_.cells.reserve_more(std::min(count, numbers.size()), numbers.size());
    for (std::size_t e = 0; e < count; ++e) {
      const std::int64_t called = section.first + static_cast<std::int64_t>(e);
      if (section.type == kMixed) shape = next_shape(section, numbers, at, called);
      if (corners_of(*shape) > numbers.size() - at) tree_.fail(section.node, fmt::format("its list of corners ends in element {}", called));
      for (Index k = 0; k < corners_of(*shape); ++k) {
        const std::int64_t point = numbers[at++];
        if (point < 1 || point > zone.count) {
          tree_.fail(section.node, fmt::format("element {}: point {} out of range (the zone has {})", called, point, zone.count));
        }
        corners[k] = points_.vertex_of[zone.first + static_cast<Index>(point - 1)];
      }
      found_.cells.add(*shape, corners.data(), origin(section, mark_of_[section.offset + e], dimension_of(*shape)));
    }
    if (at != numbers.size()) tree_.fail(section.node, fmt::format("{} numbers are left behind its elements", numbers.size() - at));
  }

  CellShape next_shape(const Section& section, const std::vector<std::int64_t>& numbers, std::size_t& at, std::int64_t called) const {
    if (at >= numbers.size()) tree_.fail(section.node, fmt::format("its list of corners ends before element {}", called));
    const std::int64_t type = numbers[at++];
    const auto shape = cgns_shape(type);
    if (!shape) {
      tree_.fail(section.node, fmt::format("element {}: {} is not read: only elements without nodes beyond their corners are", called,
                                           cgns_type_name(type)));
    }
    return *shape;
  }

  /// Adds a condition on points.
  void vertices(const CgnsZone& zone, const CgnsCondition& one) {
    const auto [at, added] = vertex_groups_.try_emplace(one.name);
    Group& group = at->second;
    if (added) group = {.name = one.name, .role = std::string(kCgnsCondition), .code = 0, .dimension = 0};
    const auto each = [&](std::int64_t point) {
      if (point < 1 || point > zone.count) {
        tree_.fail(zone.node,
                   fmt::format("boundary condition {}: point {} out of range (the zone has {})", quote_token(one.name), point, zone.count));
      }
      group.members.push_back(points_.vertex_of[zone.first + static_cast<Index>(point - 1)]);
    };
    if (!one.of_range) {
      for (const std::int64_t point : one.numbers) each(point);
      return;
    }
    if (one.numbers.size() != 2) tree_.fail(zone.node, fmt::format("boundary condition {}: a range that is none", quote_token(one.name)));
    for (std::int64_t point = one.numbers[0]; point <= one.numbers[1]; ++point) each(point);
  }

  // --- Structured zones ---

  using Place = std::array<std::int64_t, 3>;  // i, j, k from 0

  [[nodiscard]] Index point(const CgnsZone& zone, Place at) const {
    std::int64_t number = 0;
    for (std::size_t d = zone.sizes.size(); d-- > 0;) number = number * zone.sizes[d] + at[d];
    return points_.vertex_of[zone.first + static_cast<Index>(number)];
  }

  /// Adds a line, quadrilateral or hexahedron that extends from a point along these indices.
  void cell(const CgnsZone& zone, Place at, std::span<const std::size_t> along, std::uint32_t origin) {
    constexpr std::array<std::array<int, 3>, 8> kCorners{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    std::array<Index, 8> corners{};
    const std::size_t n = std::size_t{1} << along.size();
    for (std::size_t c = 0; c < n; ++c) {
      Place corner = at;
      for (std::size_t a = 0; a < along.size(); ++a) corner[along[a]] += kCorners[c][a];
      corners[c] = point(zone, corner);
    }
    constexpr std::array kShapes{CellShape::Point, CellShape::Line, CellShape::Quadrilateral, CellShape::Hexahedron};
    found_.cells.add(kShapes[along.size()], corners.data(), origin);
  }

  /// Adds the cells between two points.
  void cells(const CgnsZone& zone, Place from, Place to, std::span<const std::size_t> along, std::uint32_t origin) {
    for (const std::size_t a : along) {
      if (from[a] >= to[a]) return;
    }
    Place at = from;
    for (;;) {
      cell(zone, at, along, origin);
      std::size_t a = 0;
      while (a < along.size() && ++at[along[a]] == to[along[a]]) {
        at[along[a]] = from[along[a]];
        ++a;
      }
      if (a == along.size()) return;
    }
  }

  void structured(const CgnsZone& zone) {
    constexpr std::array<std::size_t, 3> kAll{0, 1, 2};
    const std::size_t dimension = zone.sizes.size();
    Place last{};
    for (std::size_t d = 0; d < dimension; ++d) last[d] = zone.sizes[d] - 1;
    cells(zone, {}, last, std::span(kAll).first(dimension), add_origin(zone_labels_));
    for (const CgnsCondition& one : conditions_) patch(zone, one);
  }

  /// Adds a condition on a part of the surface of a structured zone.
  void patch(const CgnsZone& zone, const CgnsCondition& one) {
    const std::size_t dimension = zone.sizes.size();
    if (!one.of_range || one.numbers.size() != 2 * dimension) return source_.add_only_in_file("boundary conditions given point by point");
    Place from{}, to{};
    for (std::size_t d = 0; d < dimension; ++d) {
      from[d] = std::min(one.numbers[d], one.numbers[dimension + d]) - 1;
      to[d] = std::max(one.numbers[d], one.numbers[dimension + d]) - 1;
    }
    std::size_t normal = dimension;
    for (std::size_t d = 0; d < dimension && normal == dimension; ++d) {
      if (from[d] == to[d]) normal = d;
    }
    for (std::size_t d = 0; d < dimension; ++d) {  // location such as "IFaceCenter"
      if (!one.of_vertices && one.location.size() > 1 && one.location[0] == "IJK"[d] && one.location[1] == 'F') normal = d;
    }
    for (std::size_t d = 0; d < dimension; ++d) {
      if (!one.of_vertices && d != normal) ++to[d];
      if (from[d] < 0 || to[d] >= zone.sizes[d] || to[d] < from[d]) {
        tree_.fail(zone.node, fmt::format("boundary condition {}: its range leaves the zone", quote_token(one.name)));
      }
    }
    std::vector<std::size_t> along;
    for (std::size_t d = 0; d < dimension; ++d) {
      if (d != normal) along.push_back(d);
    }
    if (along.size() + 1 != dimension) return source_.add_only_in_file("boundary conditions on no surface");
    std::vector<GroupLabel> labels;
    add_labels(labels, one);
    cells(zone, from, to, along, add_origin(std::move(labels)));
  }

  const CgnsTree& tree_;
  const CgnsPoints& points_;
  SourceFile& source_;
  Progress& progress_;
  CgnsCells found_;
  std::vector<GroupLabel> zone_labels_;
  std::vector<CgnsCondition> conditions_;          // conditions of the zone
  std::vector<Section> sections_;                  // sections of the zone, by their elements' numbers
  std::vector<std::uint32_t> mark_of_;             // by element of the zone, index into marks_
  std::vector<std::vector<std::uint32_t>> marks_;  // sets of conditions
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_marks_;
  std::map<std::tuple<std::string, std::uint32_t, int>, std::uint32_t> origins_;
  std::map<std::string, Group> vertex_groups_;  // groups by name
};

}  // namespace

CgnsCells read_cgns_cells(const CgnsTree& tree, const CgnsPoints& points, SourceFile& source, Progress& progress) {
  return CgnsCellReader(tree, points, source, progress).read();
}

}  // namespace dmoscope
