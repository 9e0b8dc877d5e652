// Tree of CGNS, its zones and their points.

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/io/cgns/cgns.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

std::vector<CgnsNode> CgnsTree::children(const std::string& path) const {
  std::vector<CgnsNode> nodes;
  for (const std::string& name : file_.children(path)) {
    std::string at = (path == "/" ? "" : path) + "/" + name;
    if (name.starts_with(' ')) continue;  // arrays, and HDF5's own nodes
    std::string label = file_.attribute(at, "label");
    if (label.empty() && !file_.opens(at)) {
      file_.fail(fmt::format("{}: damaged, or a link into another file, which is not read: join them with cgnscompress or h5repack",
                             quote_token(at)));
    }
    if (!label.empty()) nodes.push_back({std::move(at), name, std::move(label)});
  }
  return nodes;
}

std::vector<CgnsNode> CgnsTree::children(const CgnsNode& of, std::string_view label) const {
  std::vector<CgnsNode> nodes = children(of.path);
  std::erase_if(nodes, [&](const CgnsNode& node) { return node.label != label; });
  return nodes;
}

std::optional<CgnsNode> CgnsTree::child(const CgnsNode& of, std::string_view label) const {
  std::vector<CgnsNode> nodes = children(of, label);
  if (nodes.empty()) return std::nullopt;
  return std::move(nodes.front());
}

std::optional<CgnsNode> CgnsTree::named(const CgnsNode& of, std::string_view name) const {
  for (CgnsNode& node : children(of.path)) {
    if (node.name == name) return std::move(node);
  }
  return std::nullopt;
}

std::string CgnsTree::text(const CgnsNode& node) const {
  if (!file_.find(array(node))) return {};
  const std::string all = file_.text(array(node));
  return std::string(trimmed(std::string_view(all).substr(0, all.find('\0'))));
}

void CgnsTree::fail(const CgnsNode& node, const std::string& what) const {
  file_.fail(fmt::format("{}: {}", quote_token(node.path), what));
}

namespace {

/// Joins points of different zones at the same place.
class Joiner {
 public:
  explicit Joiner(CgnsPoints& points) : points_(points) {}

  void join(const std::vector<Vec3>& all) {
    points_.vertex_of.resize(all.size());
    for (std::size_t z = 0; z < points_.zones.size(); ++z) {
      const CgnsZone& zone = points_.zones[z];
      for (Index p = zone.first; p < zone.first + zone.count; ++p) points_.vertex_of[p] = vertex(all[p], z);
    }
  }

 private:
  struct Place {
    std::vector<Index> vertices;
    std::size_t used = 0;  // number of them that points of the zone use
    std::size_t zone = 0;
    std::size_t of_others = 0;  // number of them before the zone began
  };
  struct Hash {
    std::size_t operator()(const Vec3& p) const noexcept {
      std::uint64_t mixed = 0;
      for (const double c : {p.x, p.y, p.z}) mixed = (mixed ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15U, mixed ^= mixed >> 29U;
      return mixed;
    }
  };

  Index vertex(Vec3 p, std::size_t zone) {
    Place& place = places_[Vec3{p.x + 0.0, p.y + 0.0, p.z + 0.0}];  // turns -0.0 into 0.0
    if (place.zone != zone) place = {std::move(place.vertices), 0, zone, 0}, place.of_others = place.vertices.size();
    if (place.used < place.of_others) {
      ++points_.joined;
      return place.vertices[place.used++];
    }
    place.vertices.push_back(static_cast<Index>(points_.positions.size()));
    points_.positions.push_back(p);
    return place.vertices.back();
  }

  CgnsPoints& points_;
  std::unordered_map<Vec3, Place, Hash> places_;
};

class ZoneReader {
 public:
  ZoneReader(const CgnsTree& tree, SourceFile* notes) : tree_(tree), notes_(notes) {}

  CgnsPoints read() {
    base();
    for (const CgnsNode& node : tree_.children(base_, "Zone_t")) zone(node);
    if (points_.zones.empty()) tree_.fail(base_, "it holds no zone");
    for (const CgnsZone& zone : points_.zones) grid(zone);
    join();
    return std::move(points_);
  }

 private:
  void base() {
    std::vector<CgnsNode> bases = tree_.children("/");
    std::erase_if(bases, [](const CgnsNode& node) { return node.label != "CGNSBase_t"; });
    if (bases.empty()) tree_.file().fail("this is an HDF5 file, but no CGNS file: it has no CGNSBase_t");
    if (bases.size() > 1) {
      std::erase_if(bases, [&](const CgnsNode& node) { return tree_.children(node, "Zone_t").empty(); });
      if (bases.size() != 1) tree_.file().fail(fmt::format("{} bases with zones: one is read; save it as a file of its own", bases.size()));
    }
    base_ = bases.front();
    const std::vector<std::int64_t> dimensions = tree_.wholes(base_);
    if (dimensions.size() != 2 || dimensions[0] < 2 || dimensions[0] > 3 || dimensions[1] < dimensions[0] || dimensions[1] > 3) {
      tree_.fail(base_, "its cells and coordinates have dimensions that are not read: 2 and 2, 2 and 3, 3 and 3 are");
    }
    points_.cell_dimension = static_cast<int>(dimensions[0]);
    points_.base = base_.name;
    physical_ = static_cast<int>(dimensions[1]);
  }

  void zone(const CgnsNode& node) {
    CgnsZone zone{.node = node, .sizes = {}};
    const auto type = tree_.child(node, "ZoneType_t");
    const std::string word = type ? tree_.text(*type) : "Structured";
    if (word != "Unstructured" && word != "Structured") tree_.fail(node, fmt::format("a zone of type {} is not read", quote_token(word)));
    zone.structured = word == "Structured";
    const std::vector<std::int64_t> numbers = tree_.wholes(node);
    const std::size_t indices = zone.structured ? static_cast<std::size_t>(points_.cell_dimension) : 1;
    if (numbers.size() != 3 * indices) tree_.fail(node, "damaged: it does not have the sizes of a zone");
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < indices; ++i) {
      if (numbers[i] < 1 || static_cast<std::uint64_t>(numbers[i]) >= kNoIndex / count) tree_.fail(node, "too many points, or none");
      count *= static_cast<std::uint64_t>(numbers[i]);
      zone.sizes.push_back(numbers[i]);
    }
    if (all_.size() + count >= kNoIndex) tree_.fail(node, "too many points");
    zone.first = static_cast<Index>(all_.size());
    zone.count = static_cast<Index>(count);
    tree_.file().take_room(count, sizeof(Vec3));
    all_.resize(all_.size() + count, Vec3{0.0, 0.0, 0.0});
    points_.zones.push_back(std::move(zone));
  }

  void grid(const CgnsZone& zone) {
    const std::vector<CgnsNode> grids = tree_.children(zone.node, "GridCoordinates_t");
    const auto original = std::ranges::find(grids, std::string("GridCoordinates"), &CgnsNode::name);
    if (original == grids.end()) tree_.fail(zone.node, "it has no GridCoordinates");
    if (grids.size() > 1 && notes_ != nullptr) notes_->add_only_in_file("further coordinates");
    for (const CgnsNode& rind : tree_.children(*original, "Rind_t")) {
      const std::vector<std::int64_t> planes = tree_.wholes(rind);
      if (std::ranges::any_of(planes, [](std::int64_t n) { return n != 0; })) tree_.fail(*original, "rind points are not read");
    }
    for (const CgnsNode& array : tree_.children(*original, "DataArray_t")) {
      if (array.name == "CoordinateR" || array.name == "CoordinateTheta" || array.name == "CoordinatePhi") {
        tree_.fail(*original, fmt::format("cylindrical or spherical coordinates ({}) are not read", array.name));
      }
    }
    for (int axis = 0; axis < physical_; ++axis) {
      const std::string name = std::string("Coordinate") + "XYZ"[axis];
      const auto node = tree_.named(*original, name);
      if (!node) tree_.fail(*original, fmt::format("it has no {}", name));
      points_.coordinates.read(
          tree_.file(), {.name = CgnsTree::array(*node), .axis = axis, .components = 1, .first = zone.first, .count = zone.count}, all_);
    }
  }

  void join() {
    if (points_.zones.size() == 1) {
      points_.positions = std::move(all_);
      points_.vertex_of.resize(points_.positions.size());
      for (std::size_t p = 0; p < points_.vertex_of.size(); ++p) points_.vertex_of[p] = static_cast<Index>(p);
      return;
    }
    Joiner(points_).join(all_);
    points_.coordinates.renumber(points_.vertex_of);
  }

  const CgnsTree& tree_;
  SourceFile* notes_;
  CgnsPoints points_;
  CgnsNode base_;
  int physical_ = 3;
  std::vector<Vec3> all_;  // positions by point
};

}  // namespace

CgnsPoints read_cgns_points(const CgnsTree& tree, SourceFile* notes) { return ZoneReader(tree, notes).read(); }

}  // namespace dmoscope
