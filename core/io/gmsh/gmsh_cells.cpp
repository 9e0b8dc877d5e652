#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include "core/io/gmsh/gmsh.h"

namespace dmoscope {
namespace {

constexpr std::size_t kInt = 4;   // size in bytes
constexpr std::size_t kSize = 8;  // size in bytes
constexpr int kAnyDimension = -1;

struct HigherOrder {
  std::int64_t first, last;  // range of type numbers
  std::string_view name;
};
constexpr std::array kHigherOrder{
    HigherOrder{8, 8, "line"},          HigherOrder{9, 9, "triangle"},        HigherOrder{10, 10, "quadrilateral"},
    HigherOrder{11, 11, "tetrahedron"}, HigherOrder{12, 12, "hexahedron"},    HigherOrder{13, 13, "wedge"},
    HigherOrder{14, 14, "pyramid"},     HigherOrder{16, 16, "quadrilateral"}, HigherOrder{17, 17, "hexahedron"},
    HigherOrder{18, 18, "wedge"},       HigherOrder{19, 19, "pyramid"},       HigherOrder{20, 25, "triangle"},
    HigherOrder{26, 28, "line"},        HigherOrder{29, 31, "tetrahedron"},   HigherOrder{36, 41, "quadrilateral"},
    HigherOrder{42, 46, "triangle"},    HigherOrder{47, 51, "quadrilateral"}, HigherOrder{52, 58, "triangle"},
    HigherOrder{62, 66, "line"},        HigherOrder{71, 83, "tetrahedron"},   HigherOrder{90, 91, "wedge"},
    HigherOrder{92, 98, "hexahedron"},  HigherOrder{106, 117, "wedge"},       HigherOrder{118, 131, "pyramid"},
};

}  // namespace

void GmshCells::physical_names() {
  const std::size_t count = in_.words.count("the number of physical names", 5.0);
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t dimension = in_.words.integer_before('"', "the dimension of a physical group");
    std::int64_t number = dimension;
    // Accepts a missing dimension of old files, and -1, which Gmsh writes for it: the name then belongs to any group with the number.
    if (in_.words.peek_word().starts_with('"')) {
      dimension = kAnyDimension;
    } else {
      number = in_.words.integer_before('"', "the number of a physical group");
    }
    if (dimension < kAnyDimension || dimension > 3) in_.words.fail(fmt::format("a physical group of {} dimensions", dimension));
    if (!std::in_range<int>(number)) in_.words.fail(fmt::format("the number of a physical group is too large: {}", number));
    const std::string_view name = unquoted(in_.words.rest_of_line());
    if (name.empty()) continue;
    names_[{static_cast<int>(dimension), static_cast<int>(number)}] = name;
  }
}

void GmshCells::entities() {
  in_.begin_data();
  each_entity([this](int dimension) { entity(dimension); });
  source_.add_only_in_file("the geometry ($Entities)");
}

template <class Read>
void GmshCells::each_entity(Read read) {
  std::array<std::size_t, 4> counts{};
  for (std::size_t& n : counts) n = in_.count("the number of entities", 10.0, 36.0);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) read(dimension);
  }
}

void GmshCells::entity(int dimension) {
  const int tag = in_.whole("the number of an entity");
  std::vector<int> physical = end_entity(dimension);
  if (!physical.empty()) entity_physical_[{dimension, tag}] = std::move(physical);
}

std::vector<int> GmshCells::end_entity(int dimension) {
  const int corners = dimension == 0 ? 3 : 6;
  for (int k = 0; k < corners; ++k) (void)in_.real("the bounds of an entity");
  std::vector<int> physical(in_.count("the number of physical groups of an entity", 2.0, kInt));
  for (int& number : physical) number = in_.whole("a physical group");
  if (dimension == 0) return physical;
  const std::size_t bounds = in_.count("the number of entities that bound one", 2.0, kInt);
  for (std::size_t i = 0; i < bounds; ++i) (void)in_.whole("an entity that bounds one");
  return physical;
}

/// Reads the entities of a partitioned mesh, whose parts are joined again.
void GmshCells::partitioned_entities() {
  in_.begin_data();
  (void)in_.size("the number of partitions");
  const std::size_t ghosts = in_.count("the number of ghost entities", 4.0, 2 * kInt);
  for (std::size_t i = 0; i < ghosts; ++i) {
    (void)in_.whole("the number of a ghost entity");
    (void)in_.whole("a partition");
  }
  each_entity([this](int dimension) { partitioned_entity(dimension); });
  source_.add_only_in_file("the partitions of its elements");
}

void GmshCells::partitioned_entity(int dimension) {
  const int tag = in_.whole("the number of an entity");
  const int whole_dimension = in_.whole("the dimension of an entity");
  const int whole = in_.whole("the number of an entity");
  const std::size_t partitions = in_.count("the number of partitions of an entity", 2.0, kInt);
  for (std::size_t i = 0; i < partitions; ++i) (void)in_.whole("a partition");
  std::vector<int> physical = end_entity(dimension);
  whole_[{dimension, tag}] = {whole_dimension, whole};
  if (!physical.empty() && whole_dimension == dimension) entity_physical_.try_emplace({dimension, whole}, std::move(physical));
}

/// The entity, by dimension and number, of which this one is a part; the entity itself in a mesh without partitions.
std::pair<int, int> GmshCells::whole_of(int dimension, int entity) const {
  const auto found = whole_.find({dimension, entity});
  return found == whole_.end() ? std::pair(dimension, entity) : found->second;
}

void GmshCells::elements(const TagPlaces& nodes) {
  if (elements_read_) in_.words.fail("a second $Elements");
  elements_read_ = true;
  if (in_.version == 2) {
    elements_2(nodes);
  } else {
    elements_4(nodes);
  }
  if (!tags_.count_from_one()) source_.add_only_in_file("the numbers of its elements");
}

CellShape GmshCells::shape(std::int64_t type) const {
  const auto* const found = std::find(kGmshTypes.begin(), kGmshTypes.end(), type);
  if (found != kGmshTypes.end()) return static_cast<CellShape>(found - kGmshTypes.begin());
  for (const HigherOrder& one : kHigherOrder) {
    if (type < one.first || type > one.last) continue;
    in_.words.fail(
        fmt::format("a {} of higher order (element type {}): only linear elements are read; make it linear in Gmsh by "
                    "gmsh.model.mesh.setOrder(1), and save it again",
                    one.name, type));
  }
  in_.words.fail(fmt::format("elements of type {} are not read", type));
}

Index GmshCells::node(std::int64_t tag, const TagPlaces& nodes, std::size_t place) const {
  const Index found = nodes.find(tag);
  if (found == kNoIndex) in_.words.fail_at(place, fmt::format("an element names node {}, which the file does not have", tag));
  return found;
}

std::uint32_t GmshCells::origin_of(int dimension, int physical, int entity) {
  const std::tuple key{dimension, physical, entity};
  if (key == last_key_) return last_origin_;
  const auto [at, added] = origin_numbers_.try_emplace(key, static_cast<std::uint32_t>(origins_.size()));
  if (added) {
    origins_.push_back({dimension, entity, {}});
    if (physical != 0) origins_.back().physical.push_back(physical);
  }
  last_key_ = key;
  return last_origin_ = at->second;
}

void GmshCells::elements_2(const TagPlaces& nodes) {
  const std::size_t count = in_.words.count("the number of elements", 8.0);
  if (in_.binary) return binary_elements_2(count, nodes);
  cells_.reserve_more(count, 4 * count);
  for (std::size_t e = 0; e < count; ++e) {
    const std::int64_t tag = in_.words.integer("the number of an element");
    const CellShape of_type = shape(in_.words.integer("the type of an element"));
    const std::int64_t tags = in_.words.integer("the number of tags of an element");
    if (tags < 0) in_.words.fail(fmt::format("an element with {} tags", tags));
    std::array<int, 2> kept{};  // physical group and entity
    for (std::int64_t t = 0; t < tags; ++t) {
      const int value = in_.whole("a tag of an element");
      if (t < 2) kept[static_cast<std::size_t>(t)] = value;
    }
    if (tags > 2) source_.add_only_in_file("the partitions of its elements");
    std::array<Index, 8> corners{};
    for (Index k = 0; k < corners_of(of_type); ++k) {
      const std::int64_t number = in_.words.integer("a node of an element");
      corners[k] = node(number, nodes, in_.words.token());
    }
    cells_.add(of_type, corners.data(), origin_of(dimension_of(of_type), kept[0], kept[1]));
    tags_.add(tag);
  }
}

void GmshCells::binary_elements_2(std::size_t count, const TagPlaces& nodes) {
  in_.begin_data();
  for (std::size_t done = 0; done < count;) {
    const int type = in_.whole("the type of elements");
    const CellShape of_type = shape(type);
    const int follow = in_.whole("a number of elements");
    if (follow < 1 || static_cast<std::size_t>(follow) > count - done) {
      in_.words.fail(fmt::format("{} elements of type {}, but {} of {} are left", follow, type, count - done, count));
    }
    const int tags = in_.whole("the number of tags of elements");
    if (tags < 0) in_.words.fail(fmt::format("elements with {} tags", tags));
    const auto number = static_cast<std::size_t>(follow);
    const std::size_t corners = corners_of(of_type);
    const std::size_t each = kInt * (1 + static_cast<std::size_t>(tags) + corners);
    in_.words.need(number, static_cast<double>(each), "a number of elements");
    const char* at = in_.words.block(number * each, "elements").data();
    if (tags > 2) source_.add_only_in_file("the partitions of its elements");
    cells_.reserve_more(number, number * corners);
    for (std::size_t e = 0; e < number; ++e, at += each) {
      const int physical = tags > 0 ? in_.int_at(at + kInt) : 0;
      const int entity = tags > 1 ? in_.int_at(at + 2 * kInt) : 0;
      const char* const first = at + each - kInt * corners;
      std::array<Index, 8> of_cell{};
      for (std::size_t k = 0; k < corners; ++k) of_cell[k] = node(in_.int_at(first + kInt * k), nodes, in_.words.token());
      cells_.add(of_type, of_cell.data(), origin_of(dimension_of(of_type), physical, entity));
      tags_.add(in_.int_at(at));
    }
    done += number;
  }
}

void GmshCells::elements_4(const TagPlaces& nodes) {
  in_.begin_data();
  const std::size_t blocks = in_.count("the number of blocks of elements", 8.0, 3 * kInt + kSize);
  const std::size_t count = in_.count("the number of elements", 4.0, 2 * kSize);
  (void)in_.size("the smallest number of an element");
  (void)in_.size("the largest number of an element");
  cells_.reserve_more(count, 4 * count);
  for (std::size_t b = 0; b < blocks; ++b) block_4(nodes, count);
  const std::size_t found = cells_.size() + skipped_;
  if (found != count) in_.words.fail(fmt::format("{} elements in the blocks, but $Elements says {}", found, count));
}

void GmshCells::block_4(const TagPlaces& nodes, std::size_t count) {
  const int dimension = in_.whole("the dimension of an entity");
  const int entity = in_.whole("the number of an entity");
  const int type = in_.whole("the type of elements");
  const CellShape of_type = shape(type);
  if (dimension_of(of_type) != dimension) in_.words.fail(fmt::format("elements of type {} in an entity of {} dimensions", type, dimension));
  const std::size_t corners = corners_of(of_type);
  const std::size_t each = kSize * (1 + corners);
  const std::size_t number = in_.count("a number of elements", 2.0 * static_cast<double>(1 + corners), static_cast<double>(each));
  if (number > count - cells_.size() - skipped_)
    in_.words.fail(fmt::format("more elements in the blocks than the {} that $Elements says", count));
  const auto [whole_dimension, whole] = whole_of(dimension, entity);
  // Skips cells between two partitions: they belong to an entity of more dimensions, and are not the mesh's own.
  const bool kept = whole_dimension == dimension;
  if (!kept) source_.add_only_in_file("the interfaces of its partitions");
  const std::uint32_t origin = kept ? origin_of(dimension, 0, whole) : 0;
  skipped_ += kept ? 0 : number;
  std::array<Index, 8> of_cell{};
  if (!in_.binary) {
    for (std::size_t e = 0; e < number; ++e) {
      const std::int64_t own_tag = in_.size("the number of an element");
      for (std::size_t k = 0; k < corners; ++k) {
        const std::int64_t tag = in_.words.integer("a node of an element");
        of_cell[k] = node(tag, nodes, in_.words.token());
      }
      if (!kept) continue;
      tags_.add(own_tag);
      cells_.add(of_type, of_cell.data(), origin);
    }
    return;
  }
  const char* at = in_.words.block(number * each, "elements").data();
  for (std::size_t e = 0; e < number && kept; ++e, at += each) {
    tags_.add(in_.size_at(at));
    for (std::size_t k = 0; k < corners; ++k) of_cell[k] = node(in_.size_at(at + kSize * (1 + k)), nodes, in_.words.token());
    cells_.add(of_type, of_cell.data(), origin);
  }
}

std::vector<OriginLabels> GmshCells::labels() const {
  std::vector<OriginLabels> labels;
  labels.reserve(origins_.size());
  for (const Origin& origin : origins_) {
    std::span<const int> physical = origin.physical;
    const auto entity = entity_physical_.find({origin.dimension, origin.entity});
    if (in_.version != 2 && entity != entity_physical_.end()) physical = entity->second;
    OriginLabels& made = labels.emplace_back();
    for (const int number : physical) {
      auto name = names_.find({origin.dimension, std::abs(number)});
      if (name == names_.end()) name = names_.find({kAnyDimension, std::abs(number)});
      const bool named = name != names_.end();
      made.labels.push_back({named ? name->second : fmt::format("physical {}", number), std::string(kGmshPhysical), number});
    }
    made.of_elements = !physical.empty();
    if (physical.empty()) made.labels.push_back({fmt::format("entity {}", origin.entity), std::string(kGmshEntity), origin.entity});
  }
  return labels;
}

std::vector<Index> GmshCells::add_to(Mesh& mesh) {
  const std::vector<OriginLabels> of_origins = labels();
  std::vector<Index> rows = split_cells(cells_, of_origins, mesh, source_);
  add_entity_field(mesh, rows);
  return rows;
}

/// Adds the entities of the elements as a field, unless the physical groups give the same partition.
void GmshCells::add_entity_field(Mesh& mesh, std::span<const Index> rows) const {
  std::map<std::vector<int>, int> entity_of;  // entity by physical groups
  bool telling = false;
  for (const Origin& origin : origins_) {
    const auto entity = entity_physical_.find({origin.dimension, origin.entity});
    const std::vector<int>& physical = in_.version != 2 && entity != entity_physical_.end() ? entity->second : origin.physical;
    if (origin.dimension == cells_.dimension()) {
      telling = telling || entity_of.try_emplace(physical, origin.entity).first->second != origin.entity;
    } else if (!physical.empty() && physical.front() != origin.entity) {
      source_.add_only_in_file("the entities of the elements on its boundary");
    }
  }
  if (!telling) return;
  Field field{.name = std::string(kGmshGeometrical), .on = Field::On::Elements, .type = "int", .role = std::string(kGmshEntity)};
  field.values.reserve(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    field.values.push_back(static_cast<double>(origins_[cells_.origin(rows.empty() ? e : rows[e])].entity));
  }
  mesh.fields.push_back(std::move(field));
}

}  // namespace dmoscope
