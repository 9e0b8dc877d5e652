#include "core/target/target_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/corner_tables.h"
#include "core/mesh/edges.h"
#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"
#include "core/mesh/topology.h"
#include "core/target/boundary_layers.h"

namespace dmoscope {

using std::numbers::sqrt3;

SmallMatrix ideal_edges(ElementKind kind) {
  SmallMatrix e = SmallMatrix::identity(info(kind).dimension);
  switch (kind) {
    case ElementKind::Triangle:
    case ElementKind::Wedge:
      e.at[0][1] = 0.5;
      e.at[1][1] = 0.5 * sqrt3;
      break;
    case ElementKind::Tetrahedron:
      e.at = {{{1.0, 0.5, 0.5}, {0.0, 0.5 * sqrt3, sqrt3 / 6.0}, {0.0, 0.0, std::sqrt(2.0 / 3.0)}}};
      break;
    case ElementKind::Pyramid:
      e.at = {{{1.0, 0.0, 0.5}, {0.0, 1.0, 0.5}, {0.0, 0.0, std::sqrt(0.5)}}};
      break;
    default:
      break;
  }
  return e;
}

std::size_t matrix_count(ElementKind kind) {
  const Index corners = info(kind).corners;
  return static_cast<int>(corners) == info(kind).dimension + 1 ? 1 : kind == ElementKind::Pyramid ? 4 : corners;
}

SmallMatrix edges_at(ElementKind kind, const std::array<Vec3, 8>& places, std::size_t corner) {
  std::array<std::size_t, 4> frame{};
  const std::size_t n = info(kind).corners;
  const int dimension = info(kind).dimension;
  if (dimension == 2) {
    frame = {corner, (corner + 1) % n, (corner + n - 1) % n, 0};
  } else if (kind == ElementKind::Tetrahedron) {
    frame = {corner, corner ^ 1U, corner ^ 2U, corner ^ 3U};
  } else {
    const CornerTable row = corner_row(kind, corner);
    frame = {row[0], row[1], row[2], row[3]};
  }
  SmallMatrix a{dimension, {}};
  for (std::size_t column = 0; static_cast<int>(column) < dimension; ++column) {
    const Vec3 edge = places[frame[column + 1]] - places[frame[0]];
    a.at[0][column] = edge.x;
    a.at[1][column] = edge.y;
    if (dimension == 3) a.at[2][column] = edge.z;
  }
  return a;
}

bool is_metric_field(const Field& field, int n) {
  if (field.on != Field::On::Vertices) return false;
  return field.components == (n == 2 ? 3 : 6) || field.components == 9;
}

SmallMatrix metric_tensor(const Field& field, Index vertex, int n) {
  const double* v = field.values.data() + std::size_t{vertex} * static_cast<std::size_t>(field.components);
  if (field.components == 1) return scaled(1.0 / (v[0] * v[0]), SmallMatrix::identity(n));
  SmallMatrix m{n, {}};
  if (field.components == 9) {
    for (std::size_t i = 0; static_cast<int>(i) < n; ++i)
      for (std::size_t j = 0; static_cast<int>(j) < n; ++j) m.at[i][j] = 0.5 * (v[3 * i + j] + v[3 * j + i]);
    return m;
  }
  m.at[0][0] = v[0];
  m.at[0][1] = m.at[1][0] = v[1];
  m.at[1][1] = v[2];
  if (n == 3) {
    m.at[0][2] = m.at[2][0] = v[3];
    m.at[1][2] = m.at[2][1] = v[4];
    m.at[2][2] = v[5];
  }
  return m;
}

class TargetTable::Maker {
 public:
  Maker(TargetTable& table, const Mesh& mesh, const ElementFrames& frames, const OfStretched& of_stretched)
      : table_(table), mesh_(mesh), frames_(frames), of_stretched_(of_stretched) {
    n_ = frames.geometry.shape == Shape::Volume ? 3 : 2;
    table_.size_ = static_cast<std::size_t>(n_ * n_);
  }

  void run(const Target& target) {
    table_.mean_measure_ = mean_measure();
    if (target.is_ideal()) return;
    table_.first_.assign(mesh_.elements.size(), kNone);
    table_.which_.assign(mesh_.elements.size(), kFree);
    for (const Target::OfGroup& one : target.groups) take(one.shape, elements_of(one.group), fmt::format("of {}", one.group));
    std::vector<Index> rest;
    for (Index e = 0; e < mesh_.elements.size(); ++e)
      if (table_.which_[e] == kFree) rest.push_back(e);
    if (!rest.empty()) take(target.others, rest, {});
    facts();
  }

 private:
  static constexpr std::uint8_t kFree = 255;
  static constexpr std::size_t kMostShapes = kFree / kElementKindCount;

  [[nodiscard]] double measure(Index e) const {
    if (n_ == 3) return signed_volume(mesh_, e);
    const auto p = points(e);
    const auto c = mesh_.elements.corners(e);
    const auto cross2 = [](Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; };
    return 0.5 * (c.size() == 3 ? cross2(p[1], p[2]) : cross2(p[2], p[3] - p[1]));
  }
  [[nodiscard]] double mean_measure() const {
    double sum = 0.0;
    for (Index e = 0; e < mesh_.elements.size(); ++e) sum += std::abs(measure(e));
    const double mean = sum / std::max<double>(1.0, mesh_.elements.size());
    return mean > 0.0 && std::isfinite(mean) ? mean : 1.0;
  }

  [[nodiscard]] std::array<Vec3, 8> points(Index e) const {
    std::array<Vec3, 8> out{};
    frames_.gather(
        mesh_.elements.corners(e), e, n_, [this](Index v) { return mesh_.positions[v]; }, out);
    return out;
  }

  // Groups.

  [[nodiscard]] std::vector<Index> elements_of(const std::string& name) const {
    std::vector<std::string_view> names;
    for (const Group& group : mesh_.groups) {
      if (group.name != name) {
        if (group.of_elements()) names.push_back(group.name);
        continue;
      }
      if (!group.of_elements()) throw UsageError(fmt::format("targets are of groups of elements, and '{}' has none", name));
      return group.members;
    }
    if (name == kLayersName) {
      BoundaryLayers layers = find_boundary_layers(mesh_, frames_.geometry);
      if (layers.empty())
        throw UsageError(
            "the mesh has no boundary layers: no stretched quadrilaterals, pairs of triangles, wedges or hexahedra stand on its boundary");
      return std::move(layers.elements);
    }
    names.push_back(kLayersName);
    throw UsageError(unknown_value("group of elements", name, names));
  }

  // Shapes.

  void take(const TargetShape& shape, const std::vector<Index>& elements, const std::string& of) {
    if (table_.spaces_.size() >= kMostShapes) throw UsageError(fmt::format("a target has at most {} groups", kMostShapes - 1));
    const std::size_t first = table_.spaces_.size() * kElementKindCount;
    std::vector<Index> mine;
    for (const Index e : elements)
      if (table_.which_[e] == kFree) mine.push_back(e);
    bool present[kElementKindCount] = {};
    for (const Index e : mine) {
      const auto kind = static_cast<std::size_t>(mesh_.elements.kind(e));
      table_.which_[e] = static_cast<std::uint8_t>(first + kind);
      present[kind] = true;
    }
    table_.spaces_.push_back(shape.kind == TargetShape::Kind::Input ? FormulaSpace::Target : FormulaSpace::Stretched);
    for (std::size_t kind = 0; kind < kElementKindCount; ++kind)
      table_.steepness_.push_back(present[kind] ? steepness(shape, static_cast<ElementKind>(kind)) : 1.0);
    if (shape.kind == TargetShape::Kind::Input) as_they_were(shape, mine);
    if (shape.kind == TargetShape::Kind::Field) by_field(shape, mine);
    if (shape.kind == TargetShape::Kind::Aspect) by_aspect(shape, mine);
    phrases_.push_back({shape, of, mine.size()});
  }

  /// Factor by which the metric falls faster, so that it is 0 for an element whose aspect changes by the tolerance.
  [[nodiscard]] double steepness(const TargetShape& shape, ElementKind kind) const {
    if (!(shape.tolerance > 0.0)) return 1.0;
    const double lost = 1.0 - of_stretched_(kind, 1.0 + 0.01 * shape.tolerance);
    return lost > 1e-12 ? std::max(1.0, 1.0 / lost) : 1.0;  // some metrics do not depend on aspects
  }

  void begin(Index e, std::size_t matrices) {
    const std::size_t first = table_.matrices_.size() / table_.size_;
    if (first + matrices >= kNone) throw UsageError("the mesh is too large for targets");
    table_.first_[e] = static_cast<std::uint32_t>(first);
  }
  void push(const SmallMatrix& m) {
    for (std::size_t i = 0; static_cast<int>(i) < n_; ++i)
      for (std::size_t j = 0; static_cast<int>(j) < n_; ++j) table_.matrices_.push_back(m.at[i][j]);
  }

  void as_they_were(const TargetShape& shape, const std::vector<Index>& elements) {
    const std::vector<SmallMatrix> means = shape.rounds > 0 ? averaged(shape.rounds) : std::vector<SmallMatrix>();
    std::vector<SmallMatrix> matrices;
    for (const Index e : elements) {
      const ElementKind kind = mesh_.elements.kind(e);
      const SmallMatrix ideal = ideal_edges(kind);
      const auto p = points(e);
      matrices.clear();
      for (std::size_t corner = 0; corner < matrix_count(kind); ++corner) {
        SmallMatrix wished = edges_at(kind, p, corner);
        if (!is_sound(wished)) break;
        if (!means.empty()) wished = means[e] * polar(wished * inverse(ideal)).rotation * ideal;
        matrices.push_back(inverse(wished) * ideal);
      }
      if (matrices.size() < matrix_count(kind)) {
        ++table_.facts_.degenerate;
        continue;
      }
      begin(e, matrices.size());
      for (const SmallMatrix& m : matrices) push(m);
    }
  }

  [[nodiscard]] bool is_sound(const SmallMatrix& edges) const {
    double product = 1.0;
    for (std::size_t column = 0; static_cast<int>(column) < n_; ++column) {
      double square = 0.0;
      for (std::size_t row = 0; static_cast<int>(row) < n_; ++row) square += edges.at[row][column] * edges.at[row][column];
      product *= std::sqrt(square);
    }
    // Compares with a small share: an element that is stretched k times has about 1/k, a tetrahedron along one of its edges 1/k^2.
    return determinant(edges) > (n_ == 2 ? 1e-9 : 1e-13) * product;
  }

  /// Stretches of the elements against ideal ones, averaged with their neighbours; by the logarithms, so that no mean is flat.
  [[nodiscard]] std::vector<SmallMatrix> averaged(int rounds) const {
    const auto count = mesh_.elements.size();
    std::vector<SmallMatrix> logs(count);
    std::vector<std::uint8_t> known(count);
    for (Index e = 0; e < count; ++e) {
      const ElementKind kind = mesh_.elements.kind(e);
      const SmallMatrix to_ideal = inverse(ideal_edges(kind));
      const auto p = points(e);
      SmallMatrix sum{n_, {}};
      double corners = 0.0;
      for (std::size_t corner = 0; corner < matrix_count(kind); ++corner) {
        const SmallMatrix edges = edges_at(kind, p, corner);
        if (!is_sound(edges)) continue;
        sum = sum + apply(polar(edges * to_ideal).stretch, [](double value) { return std::log(value); });
        corners += 1.0;
      }
      known[e] = corners > 0.0 ? 1 : 0;
      logs[e] = scaled(corners > 0.0 ? 1.0 / corners : 0.0, sum);
    }
    const auto neighbours = this->neighbours();
    for (int round = 0; round < rounds; ++round) {
      std::vector<SmallMatrix> next = logs;
      for (Index e = 0; e < count; ++e) {
        SmallMatrix sum = logs[e];
        double weight = known[e];
        for (const Index other : neighbours[e]) {
          if (known[other] == 0) continue;
          sum = sum + logs[other];
          weight += 1.0;
        }
        if (weight > 0.0) next[e] = scaled(1.0 / weight, sum);
      }
      logs = std::move(next);
    }
    for (SmallMatrix& m : logs) m = apply(m, [](double value) { return std::exp(value); });
    return logs;
  }

  [[nodiscard]] std::vector<std::vector<Index>> neighbours() const {
    std::vector<std::vector<Index>> all(mesh_.elements.size());
    if (n_ == 3) {
      const FaceNeighbours faces(mesh_);
      for (Index e = 0; e < mesh_.elements.size(); ++e)
        for (const Index other : faces.of(e))
          if (other != kNoIndex) all[e].push_back(other);
      return all;
    }
    const Topology topology(mesh_);
    for_each_edge(mesh_, topology, [&](Edge, std::span<const EdgeSide> sides) {
      if (sides.size() != 2) return;
      all[sides[0].element].push_back(sides[1].element);
      all[sides[1].element].push_back(sides[0].element);
    });
    return all;
  }

  void require_flat(std::string_view what) const {
    const Vec3 n = frames_.geometry.plane.normal;
    if (frames_.geometry.shape == Shape::Surface)
      throw UsageError(fmt::format("{} are of planar meshes and volumes, not of curved surfaces", what));
    if (n_ == 2 && !(n.x == 0.0 && n.y == 0.0))
      throw UsageError(fmt::format("{} of a planar mesh need one whose plane is that of x and y", what));
  }

  void by_aspect(const TargetShape& shape, const std::vector<Index>& elements) {
    require_flat("aspects with a direction");
    if (shape.planar != (n_ == 2))
      throw UsageError(n_ == 2 ? "the direction of an aspect in the plane is given in degrees: aspect:RATIO:DEGREES"
                               : "the direction of an aspect in space is given by x, y and z: aspect:RATIO:X:Y:Z");
    const Vec3 d = (1.0 / length(shape.direction)) * shape.direction;
    const std::array<double, 3> along{d.x, d.y, d.z};
    for (const Index e : elements) {
      const double unit = std::pow(table_.mean_measure_ / ideal_measure(mesh_.elements.kind(e)), 1.0 / n_);
      const double width = unit * std::pow(shape.aspect, -1.0 / n_), stretch = width * shape.aspect;
      SmallMatrix m = scaled(1.0 / (width * width), SmallMatrix::identity(n_));
      for (std::size_t i = 0; static_cast<int>(i) < n_; ++i)
        for (std::size_t j = 0; static_cast<int>(j) < n_; ++j)
          m.at[i][j] += (1.0 / (stretch * stretch) - 1.0 / (width * width)) * along[i] * along[j];
      begin(e, 1);
      push(upper_root(m));
    }
  }

  [[nodiscard]] const Field& field_named(const std::string& name) const {
    std::vector<std::string_view> names;
    const Field *found = nullptr, *size = nullptr;
    for (const Field& field : mesh_.fields) {
      if (size == nullptr && field.on == Field::On::Vertices && field.components == 1) size = &field;
      if (!name.empty() && field.name == name) {
        if (!is_metric_field(field, n_) && !(field.on == Field::On::Vertices && field.components == 1))
          throw UsageError(fmt::format("the field '{}' has no metric tensors: those have {} components a vertex (or 9), or 1 (a size)",
                                       name, n_ == 2 ? 3 : 6));
        return field;
      }
      if (!is_metric_field(field, n_)) continue;
      names.push_back(field.name);
      if (found == nullptr) found = &field;
    }
    if (names.empty())
      throw UsageError(fmt::format(
          "the mesh has no metric field: its file needs symmetric tensors of {} components at the vertices, or a .sol file beside it{}",
          n_ == 2 ? 3 : 6,
          size == nullptr ? std::string() : fmt::format(". It has numbers: {} takes them for sizes", as_text(size->name))));
    if (!name.empty()) throw UsageError(unknown_value("metric field", name, names));
    if (names.size() > 1)
      throw UsageError(fmt::format("the mesh has {} metric fields: name one, such as field:{}", names.size(), names[0]));
    return *found;
  }

  [[nodiscard]] static std::string as_text(const std::string& field) {
    return to_text({.others = {.kind = TargetShape::Kind::Field, .field = field}});
  }

  void by_field(const TargetShape& shape, const std::vector<Index>& elements) {
    require_flat("metric fields");
    if (mesh_.degrees)
      throw UsageError("metric fields are of the coordinates as they stand, which is not possible on the Earth (--geographic off)");
    const Field& field = field_named(shape.field);
    std::vector<SmallMatrix> logs(mesh_.positions.size());
    std::vector<std::uint8_t> known(mesh_.positions.size());
    for (const Index e : elements) {
      SmallMatrix sum{n_, {}};
      const auto corners = mesh_.elements.corners(e);
      for (const Index v : corners) {
        if (known[v] == 0) logs[v] = log_of(field, v);
        known[v] = 1;
        sum = sum + logs[v];
      }
      const SmallMatrix mean = scaled(1.0 / static_cast<double>(corners.size()), sum);
      begin(e, 1);
      push(upper_root(apply(mean, [](double value) { return std::exp(value); })));
    }
  }

  [[noreturn]] void fail(const Field& field, Index vertex, const std::string& what) const {
    const auto number = static_cast<std::size_t>(&field - mesh_.fields.data());
    const std::string sentence = fmt::format("{} at vertex {}", what, vertex);
    if (!mesh_.source) throw InputError(mesh_.name.empty() ? "mesh" : mesh_.name, 0, sentence);
    throw InputError(mesh_.source->file_of_field(number).string(), mesh_.source->line_of_row(mesh_, number, vertex), sentence);
  }

  [[nodiscard]] SmallMatrix log_of(const Field& field, Index v) const {
    if (field.components == 1 && !(field.values[v] > 0.0)) fail(field, v, fmt::format("the size '{}' is not above 0", field.name));
    const SmallMatrix m = metric_tensor(field, v, n_);
    const Eigen e = eigen(m);
    for (std::size_t i = 0; static_cast<int>(i) < n_; ++i)
      if (!(e.values[i] > 0.0 && std::isfinite(e.values[i])))
        fail(field, v, fmt::format("the metric '{}' is not positive definite", field.name));
    return apply(m, [](double value) { return std::log(value); });
  }

  // Words.

  void facts() {
    for (const std::uint32_t first : table_.first_) table_.facts_.with_target += first != kNone ? 1U : 0U;
    for (const Part& part : phrases_) {
      using Kind = TargetShape::Kind;
      const TargetShape& shape = part.shape;
      const std::string what = shape.kind == Kind::Field    ? "by the metric field"
                               : shape.kind == Kind::Aspect ? fmt::format("stretched {:g} times", shape.aspect)
                               : shape.kind == Kind::Ideal  ? "ideal"
                               : shape.rounds > 0           ? "as they and their neighbours were"
                                                            : "as they were";
      table_.facts_.phrase += fmt::format("{}{} elements{}{} {}", table_.facts_.phrase.empty() ? "" : ", ", part.count,
                                          part.of.empty() ? "" : " ", part.of, what);
    }
    if (table_.facts_.degenerate > 0)
      table_.facts_.phrase += fmt::format(" ({} of them were inverted or flat, for which ideal ones are wished)", table_.facts_.degenerate);
  }

  struct Part {
    TargetShape shape;
    std::string of;
    std::size_t count;
  };
  TargetTable& table_;
  const Mesh& mesh_;
  const ElementFrames& frames_;
  const OfStretched& of_stretched_;
  int n_ = 2;
  std::vector<Part> phrases_;
};

TargetTable::TargetTable(const Target& target, const Mesh& mesh, const ElementFrames& frames, const OfStretched& of_stretched) {
  Maker(*this, mesh, frames, of_stretched).run(target);
}

}  // namespace dmoscope
