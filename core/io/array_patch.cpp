#include "core/io/array_patch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

double& coordinate_of(Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
double coordinate_of(const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Calls each(number in the array, vertex, axis) for all numbers of an array.
template <class Each>
void for_each_number(const CoordinateArray& array, Each&& each) {
  const auto n = static_cast<std::size_t>(array.axis < 0 ? array.components : 1);
  for (std::size_t i = 0; i < array.count; ++i) {
    const std::size_t vertex = array.vertices.empty() ? array.first + i : array.vertices[i];
    for (std::size_t c = 0; c < n; ++c) {
      each(array.by_axis ? c * array.count + i : i * n + c, vertex, array.axis < 0 ? static_cast<int>(c) : array.axis);
    }
  }
}

}  // namespace

void CoordinateArrays::read(ArrayFile& file, CoordinateArray array, std::span<Vec3> positions) {
  const std::optional<ArrayInfo> info = file.find(array.name);
  if (!info) file.fail(fmt::format("the file has no array {}", quote_token(array.name)));
  array.type = info->type;
  const std::uint64_t expected = std::uint64_t{array.count} * static_cast<std::uint64_t>(array.axis < 0 ? array.components : 1);
  if (info->count() != expected) {
    file.fail(fmt::format("array {}: {} numbers, but {} belong there", quote_token(array.name), info->count(), expected));
  }
  const std::vector<double> values = file.numbers(array.name);
  for_each_number(array, [&](std::size_t i, std::size_t vertex, int axis) {
    if (!std::isfinite(values[i])) {
      file.fail(fmt::format("array {}: number {} (from 0) is not finite, which a coordinate must be", quote_token(array.name), i));
    }
    coordinate_of(positions[vertex], axis) = values[i];
  });
  arrays_.push_back(std::move(array));
}

void CoordinateArrays::describe(SourceFile& source) const {
  if (std::ranges::any_of(arrays_, [](const CoordinateArray& array) { return is_whole(array.type); }))
    source.set_not_patchable("its coordinates are whole numbers");
  source.set_layout(layout());
}

CoordinateLayout CoordinateArrays::layout() const {
  CoordinateLayout layout;
  layout.components = 0;
  layout.binary = true;
  for (const CoordinateArray& array : arrays_) {
    const int first = array.axis < 0 ? 0 : array.axis;
    const int last = array.axis < 0 ? array.components - 1 : array.axis;
    for (int axis = first; axis <= last; ++axis) {
      if (array.type == ScalarType::Float32) layout.scalar[static_cast<std::size_t>(axis)] = CoordinateScalar::Float32;
    }
    layout.components = std::max(layout.components, last + 1);
  }
  return layout;
}

std::vector<ArrayValues> changed_arrays(ArrayFile& file, const Mesh& mesh, std::span<const FieldValues> fields, Notes& notes) {
  std::vector<ArrayValues> changed;
  for (const FieldValues& one : fields) {
    const Field& field = mesh.fields[one.field];
    if (field.place.array.empty()) {
      notes.push_back(fmt::format("Field \"{}\" was carried: where it stands in the file is not known.", field.name));
      continue;
    }
    auto array = std::ranges::find(changed, field.place.array, &ArrayValues::name);
    if (array == changed.end()) array = changed.insert(changed.end(), {field.place.array, file.numbers(field.place.array)});
    if (field.place.begin + one.values.size() <= array->values.size())
      std::ranges::copy(one.values, array->values.begin() + static_cast<std::ptrdiff_t>(field.place.begin));
  }
  return changed;
}

void CoordinateArrays::renumber(std::span<const Index> vertex_of) {
  for (CoordinateArray& array : arrays_) {
    if (array.vertices.empty()) {
      array.vertices.resize(array.count);
      for (Index i = 0; i < array.count; ++i) array.vertices[i] = array.first + i;
    }
    for (Index& vertex : array.vertices) vertex = vertex_of[vertex];
  }
}

std::string CoordinateArrays::replaced(ArrayFile& file, std::span<const Vec3> before, std::span<const Vec3> moved,
                                       const std::string& target, Notes& notes, std::vector<ArrayValues> changed) const {
  const CoordinateLayout held = layout();
  for (std::size_t v = 0; v < moved.size() && held.components == 2; ++v) {
    if (moved[v].z != 0.0) throw OutputError(target, fmt::format("vertex {} has z = {}, but the file holds only x and y", v, moved[v].z));
  }
  std::size_t rounded = 0;
  for (const CoordinateArray& array : arrays_) {
    ArrayValues values{array.name, file.numbers(array.name)};
    bool any = false;
    for_each_number(array, [&](std::size_t i, std::size_t vertex, int axis) {
      double value = coordinate_of(moved[vertex], axis);
      if (same_bits(value, coordinate_of(before[vertex], axis)) || i >= values.values.size()) return;
      // Rounds to float first: a vertex may be in several arrays, of floats and of doubles, and must have one place in all of them.
      if (held.scalar[static_cast<std::size_t>(axis)] == CoordinateScalar::Float32) {
        if (!std::isfinite(static_cast<float>(value))) {
          throw OutputError(target, fmt::format("coordinate {} of vertex {} is too large for a 32-bit float", value, vertex));
        }
        if (static_cast<double>(static_cast<float>(value)) != value) ++rounded;
        value = static_cast<double>(static_cast<float>(value));
      }
      values.values[i] = value;
      any = true;
    });
    if (any) changed.push_back(std::move(values));
  }
  if (rounded > 0)
    notes.push_back(fmt::format("{} moved coordinates were rounded to 32-bit floats, which is what the file holds.", rounded));
  return file.replaced(changed);
}

}  // namespace dmoscope
