#include "core/smooth/size_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/geographic.h"
#include "core/smooth/edge_neighbours.h"

namespace dmoscope {

namespace {

constexpr double kLeastDistance = 1e-9;  // share of the mesh's size: a vertex at the very point has a size, too

bool is_scalar(const Field& field) { return field.on == Field::On::Vertices && field.components == 1; }

double correlation(std::span<const double> a, std::span<const double> b) {
  const auto count = static_cast<double>(a.size());
  const auto mean = [count](std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / count;
  };
  const double mean_a = mean(a), mean_b = mean(b);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = a[i] - mean_a, db = b[i] - mean_b;
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  // Compares with a share: rounding makes values that are all the same vary by some last bits.
  const double least = 1e-24 * count;
  const bool vary = aa > least * mean_a * mean_a && bb > least * mean_b * mean_b;
  return vary ? ab / (std::sqrt(aa) * std::sqrt(bb)) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<std::string> scalar_fields(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields)
    if (is_scalar(field)) names.push_back(field.name);
  return names;
}

SizeField::SizeField(std::shared_ptr<const InputMesh> input, SizeFunction function)
    : input_(std::move(input)), function_(std::move(function)), least_distance_(kLeastDistance * input_->geometry.size) {
  if (!(least_distance_ > 0.0)) least_distance_ = std::numeric_limits<double>::min();
  if (function_.kind == SizeFunction::Kind::Field) read_field();
}

void SizeField::read_field() {
  const Mesh& mesh = input_->mesh;
  const std::string& name = function_.field;
  const auto found = std::ranges::find_if(mesh.fields, [&](const Field& field) { return is_scalar(field) && field.name == name; });
  if (found == mesh.fields.end()) {
    const auto known = scalar_fields(mesh);
    throw UsageError(known.empty() ? fmt::format("the mesh has no nodal field '{}', nor any other with one number per vertex", name)
                                   : fmt::format("the mesh has no nodal field '{}'; it has {}", name, fmt::join(known, ", ")));
  }
  std::vector<double> sizes = found->values;
  double least = std::numeric_limits<double>::infinity();
  for (Index v = 0; v < sizes.size(); ++v) {
    if (!std::isfinite(sizes[v])) throw UsageError(fmt::format("{} cannot be a size: it is {} at vertex {}", name, sizes[v], v));
    if (sizes[v] > 0.0) least = std::min(least, sizes[v]);
  }
  if (!std::isfinite(least)) throw UsageError(fmt::format("{} cannot be a size: it is positive at no vertex", name));
  std::size_t raised = 0;
  Index first = kNoIndex;
  for (Index v = 0; v < sizes.size(); ++v) {
    if (sizes[v] > 0.0) continue;
    sizes[v] = least;
    if (raised++ == 0) first = v;
  }
  if (raised > 0)
    note_ = fmt::format("{} is not positive at {} {} (the first is {}): there the size is taken to be {}, its least positive value", name,
                        raised, raised == 1 ? "vertex" : "vertices", first, least);
  field_ = std::make_unique<NodalField>(mesh, input_->topology, input_->geometry.plane, std::move(sizes));
}

double SizeField::at(Index vertex, Vec3 place) const {
  // Stretches sizes as the map does: on it all is longer than on the Earth.
  const double stretch = input_->mesh.degrees ? stretch_of_map(place.y) : 1.0;
  if (field_) return stretch * field_->at(vertex, place);
  const SizeFormula plain{function_.kind, on_map(input_->mesh, function_.point), least_distance_};
  return stretch * plain.at(input_->geometry.plane, place);
}

std::optional<SizeFormula> SizeField::formula() const {
  if (field_ || input_->mesh.degrees) return std::nullopt;
  return SizeFormula{function_.kind, function_.point, least_distance_};
}

DensityTarget<Plane> SizeField::target(const PlanarView& mesh, PositionView positions, Index vertex) const {
  return density_target_by(mesh, positions, vertex, [this](Index other, Vec3 place) { return at(other, place); });
}

double local_edge_length(const PlanarView& mesh, PositionView positions, Index vertex) {
  double sum = 0.0;
  std::size_t count = 0;
  for_edge_neighbours(mesh, vertex, [&](Index other) {
    const Vec2<double> edge = mesh.frame.offset(positions[other], positions[vertex]);
    sum += std::sqrt(dot(edge, edge));
    ++count;
  });
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

SizeCorrelation size_correlation(const SizeField& size, const InputMesh& input, PositionView positions, std::span<const Index> vertices) {
  const PlanarView mesh = input.planar_view();
  std::vector<double> edges, targets;
  for (const Index v : vertices) {
    const double edge = local_edge_length(mesh, positions, v);
    if (!(edge > 0.0)) continue;
    edges.push_back(edge);
    targets.push_back(size.at(v, positions[v]));
  }
  SizeCorrelation found{.sizes = correlation(edges, targets)};
  for (auto* values : {&edges, &targets})
    for (double& value : *values) value = std::log(value);
  found.logarithms = correlation(edges, targets);
  return found;
}

}  // namespace dmoscope
