#include "core/input/declared_floats.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/rounding.h"
#include "core/io/reading/source_file.h"
#include "core/io/source_again.h"
#include "core/quality/quality.h"

namespace dmoscope {
namespace {

bool declares_floats(const Mesh& mesh) {
  if (!mesh.source) return false;
  const CoordinateLayout& layout = mesh.source->layout();
  return !layout.binary && std::ranges::find(layout.scalar, CoordinateScalar::Float32) != layout.scalar.end();
}

}  // namespace

std::string seen_as_floats(const InputMesh& input, std::span<const Vec3> positions, Metric metric, ThreadPool* pool) {
  if (!declares_floats(input.mesh)) return {};
  const std::string word = "its points are declared as float, but judged by their digits";
  std::vector<Vec3> rounded(positions.begin(), positions.end());
  for (Vec3& p : rounded) {
    p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
    if (!std::isfinite(p.x + p.y + p.z)) return word + "; a program that takes the word cannot hold them";
  }
  const std::span<const Index> none;
  const Statistics digits = compute_statistics(input.quality_context(), positions, metric, none, pool);
  const Statistics floats = compute_statistics(input.quality_context(), rounded, metric, none, pool);
  constexpr double kShows = 5e-5;  // in the fourth decimal
  if (!(std::abs(digits.minimum - floats.minimum) > kShows) && digits.inverted == floats.inverted) return {};
  return fmt::format("{}; a program that takes the word sees a minimum of {:.4g} and {} inverted (here {:.4g} and {})", word,
                     floats.minimum, floats.inverted, digits.minimum, digits.inverted);
}

std::string written_as_floats(const std::filesystem::path& path, const InputMesh& input, std::span<const Vec3> positions, Metric metric,
                              ThreadPool* pool) {
  return writes_source_again(path, input.mesh) ? seen_as_floats(input, positions, metric, pool) : std::string();
}

}  // namespace dmoscope
