#include "core/transfer/moved_fields.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/same_bits.h"
#include "core/io/reading/binary.h"
#include "core/mesh/geographic.h"
#include "core/mesh/thin.h"
#include "core/numeric/small_matrix.h"
#include "core/target/target_table.h"
#include "core/transfer/mesh_place.h"

namespace dmoscope {
namespace {

/// The dimension of a field's metric tensors; none if it has none. They must be symmetric and positive definite at every vertex: other
/// fields with as many components are vectors, or any matrices.
std::optional<int> metric_dimension(const Field& field, bool planar) {
  constexpr double kSymmetric = 1e-9;
  if (field.role == "VECTORS" || field.role == "NORMALS" || field.role == "TENSORS6") return std::nullopt;
  const auto definite = [&field](int n) {
    const auto vertices = static_cast<Index>(field.values.size() / static_cast<std::size_t>(field.components));
    for (Index v = 0; v < vertices; ++v) {
      const double* at = field.values.data() + std::size_t{v} * static_cast<std::size_t>(field.components);
      for (std::size_t i = 0; field.components == 9 && i < 3; ++i)
        for (std::size_t j = 0; j < i; ++j) {
          if (!(std::abs(at[3 * i + j] - at[3 * j + i]) <= kSymmetric * (std::abs(at[4 * i]) + std::abs(at[4 * j])))) return false;
          if (n == 2 && i == 2 && at[3 * i + j] != 0.0) return false;
        }
      const Eigen found = eigen(metric_tensor(field, v, n));
      for (std::size_t k = 0; static_cast<int>(k) < n; ++k)
        if (!(found.values[k] > 0.0 && std::isfinite(found.values[k]))) return false;
    }
    return true;
  };
  if (field.components == 3 && planar && definite(2)) return 2;
  if (field.components == 6 && definite(3)) return 3;
  if (field.components == 9) {
    if (definite(3)) return 3;
    if (planar && definite(2)) return 2;
  }
  return std::nullopt;
}

/// Stores a tensor in the order that metric_tensor() reads.
void put_tensor(const SmallMatrix& m, int components, double* at) {
  const auto n = static_cast<std::size_t>(m.n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (components == 9) at[3 * i + j] = m.at[i][j];
      if (components != 9 && j <= i) at[i * (i + 1) / 2 + j] = m.at[i][j];  // order 11 12 22 13 23 33
    }
}

/// A field that is interpolated at new places.
class PlacedField {
 public:
  PlacedField(const Field& field, std::size_t number, bool planar) : field_(field), values_{number, field.values} {
    if (scalar_of_word(field.type, type_)) rounds_ = true;
    tensors_ = metric_dimension(field, planar);
  }

  template <std::size_t N>
  void take(Index vertex, const MeshPlace<N>& place) {
    const auto n = static_cast<std::size_t>(field_.components);
    double* const to = values_.values.data() + std::size_t{vertex} * n;
    for (std::size_t c = 0; c < n; ++c) {
      const double first = field_.values[place.corners[0] * n + c];
      double value = first;  // keeps a constant field constant
      for (std::size_t k = 1; k < N; ++k) value += place.weights[k] * (field_.values[place.corners[k] * n + c] - first);
      if (std::isfinite(value) && std::isfinite(to[c])) to[c] = value;
    }
    if (tensors_) take_tensor(place, to);
    for (std::size_t c = 0; rounds_ && c < n; ++c) to[c] = rounded_to(type_, to[c]);
  }

  [[nodiscard]] bool changed() const {
    return !std::ranges::equal(values_.values, field_.values, [](double a, double b) { return same_bits(a, b); });
  }
  [[nodiscard]] FieldValues& values() noexcept { return values_; }

 private:
  /// Interpolates tensors by the mean of their logarithms (Arsigny et al. 2006).
  template <std::size_t N>
  void take_tensor(const MeshPlace<N>& place, double* to) {
    SmallMatrix sum{*tensors_, {}};
    for (std::size_t k = 0; k < N; ++k) {
      if (place.weights[k] == 0.0) continue;
      const SmallMatrix tensor = metric_tensor(field_, place.corners[k], *tensors_);
      sum = sum + scaled(place.weights[k], apply(tensor, [](double x) { return std::log(x); }));
    }
    put_tensor(apply(sum, [](double x) { return std::exp(x); }), field_.components, to);
  }

  const Field& field_;
  FieldValues values_;
  ScalarType type_ = ScalarType::Float64;
  bool rounds_ = false;
  std::optional<int> tensors_;
};

/// The place on the back behind one on the front; none if the mesh has no back.
template <std::size_t N>
std::optional<MeshPlace<N>> place_behind(const Mesh& mesh, MeshPlace<N> place) {
  if (!mesh.thin) return std::nullopt;
  for (Index& corner : place.corners) corner = mesh.thin->back[corner];
  return place;
}

template <std::size_t N>
void take_all(std::span<PlacedField> fields, const InputMesh& input, std::span<const Vec3> positions, ThreadPool* pool,
              Progress& progress) {
  constexpr std::size_t kGrain = 4096;
  const Mesh& mesh = input.mesh;
  const PlaceSearch<N> search(mesh, mesh.degrees ? *mesh.degrees : mesh.positions, input.topology, input.geometry);
  for_chunks(pool, positions.size(), kGrain, [&](std::size_t first, std::size_t last) {
    progress.check();
    for (std::size_t v = first; v < last; ++v) {
      if (same_bits(positions[v], mesh.positions[v])) continue;
      const auto vertex = static_cast<Index>(v);
      const MeshPlace<N> place = search.at(vertex, place_in_file(mesh, vertex, positions[v]));
      for (PlacedField& field : fields) field.take(vertex, place);
      if (const std::optional<MeshPlace<N>> behind = place_behind(mesh, place); behind && mesh.thin->back[v] != kNoIndex)
        for (PlacedField& field : fields) field.take(mesh.thin->back[v], *behind);
    }
  });
}

std::string was(const std::vector<std::string>& names, std::string_view what) {
  constexpr std::size_t kMost = 12;
  const std::vector<std::string> some(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(kMost, names.size())));
  const std::string more = names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : std::string();
  return fmt::format("{}{} {} {}", fmt::join(some, ", "), more, names.size() == 1 ? "was" : "were", what);
}

}  // namespace

std::string MovedFields::sentence() const {
  std::vector<std::string> parts;
  if (!placed.empty()) parts.push_back(was(placed, "taken anew at the new places (linear in the input's elements)"));
  if (!whole.empty()) parts.push_back(was(whole, "carried (whole numbers)"));
  if (!carried.empty()) parts.push_back(was(carried, "carried"));
  return fmt::format("{}", fmt::join(parts, "; "));
}

MovedFields move_fields(const InputMesh& input, const FieldRules& rules, std::span<const Vec3> positions, ThreadPool* pool,
                        Progress& progress) {
  require_fields(rules, input.mesh);
  MovedFields moved;
  std::vector<PlacedField> fields;
  for (std::size_t f = 0; f < input.mesh.fields.size(); ++f) {
    const Field& field = input.mesh.fields[f];
    if (field.on != Field::On::Vertices || field.components < 1) continue;
    if (rule_for(field, rules) == FieldRule::Place) {
      fields.emplace_back(field, f, input.geometry.shape == Shape::Planar);
      moved.placed.push_back(field.name);
    } else {
      (holds_whole_numbers(field) ? moved.whole : moved.carried).push_back(field.name);
    }
  }
  if (fields.empty()) return moved;
  if (input.is_volume())
    take_all<4>(fields, input, positions, pool, progress);
  else
    take_all<3>(fields, input, positions, pool, progress);
  for (PlacedField& field : fields)
    if (field.changed()) moved.values.push_back(std::move(field.values()));
  return moved;
}

}  // namespace dmoscope
