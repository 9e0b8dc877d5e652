#include "mpi/mesh/partition.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/base/unknown_value.h"
#include "core/io/reading/tokenizer.h"
#include "core/mesh/hilbert_curve.h"
#include "core/mesh/materials.h"
#include "mpi/reading/byte_range.h"

namespace dmoscope {

PartitionChoice parse_partition(const std::string& word) {
  constexpr std::string_view kFile = "file:";
  if (word == "hilbert") return {PartitionChoice::Kind::Hilbert};
  if (word == "block") return {PartitionChoice::Kind::Block};
  if (word.starts_with(kFile)) return {PartitionChoice::Kind::File, word.substr(kFile.size())};
  throw UsageError("--partition: " + unknown_value("partition", word, std::array<std::string_view, 3>{"hilbert", "block", "file:PATH"}));
}

namespace {

/// Cuts the vertices' order along the curve into stretches of about equal numbers.
std::vector<int> along_curve(const World& world, const MeshBlock& block) {
  const PointBox box = world.around_all(box_of(block.positions));
  const HilbertCurve curve(box.low, box.high);
  std::vector<std::uint64_t> keys(block.positions.size());
  for (std::size_t v = 0; v < keys.size(); ++v) keys[v] = curve.key(block.positions[v]);
  std::vector<std::uint64_t> sorted = keys;
  std::ranges::sort(sorted);

  // Starts of the ranks' stretches: for each the least key below which there are enough, found bit by bit and all at once.
  const auto cuts = static_cast<std::size_t>(world.size() - 1);
  const Ranges wanted(block.vertices.size(), world.size());
  std::vector<std::uint64_t> cut(cuts, 0), below(cuts);
  for (std::uint64_t bit = std::uint64_t{1} << 63U; bit > 0 && cuts > 0; bit >>= 1U) {
    for (std::size_t i = 0; i < cuts; ++i)
      below[i] = static_cast<std::uint64_t>(std::ranges::lower_bound(sorted, cut[i] | bit) - sorted.begin());
    world.sum(below);
    for (std::size_t i = 0; i < cuts; ++i)
      if (below[i] <= wanted.begin(static_cast<int>(i) + 1)) cut[i] |= bit;
  }
  std::vector<int> part(keys.size());
  for (std::size_t v = 0; v < keys.size(); ++v) part[v] = static_cast<int>(std::ranges::upper_bound(cut, keys[v]) - cut.begin());
  return part;
}

std::vector<int> from_file(const World& world, const MeshBlock& block, const std::filesystem::path& path) {
  std::optional<RangeFile> file;
  world.together([&] { file.emplace(path); });
  const LineBlock lines = read_lines(world, *file, 0, false);
  std::vector<std::uint64_t> numbers;
  world.together([&] {
    Progress unwatched;
    Tokenizer tokens(lines.text, path.string(), {}, unwatched);
    tokens.seek(0, lines.first_line);
    while (!tokens.at_end()) {
      const std::int64_t number = tokens.read_integer("the number of a part");
      if (number < 0) tokens.fail(fmt::format("the number of a part is {}: they count from 0", number));
      numbers.push_back(static_cast<std::uint64_t>(number) % static_cast<std::uint64_t>(world.size()));
      tokens.end_line();
    }
  });
  const Ranges vertices = world.ranges(numbers.size());
  world.together([&] {
    if (vertices.size() != block.vertices.size())
      throw InputError(path.string(), 0, fmt::format("{} parts are named for {} vertices", vertices.size(), block.vertices.size()));
  });
  std::vector<std::uint64_t> mine(block.positions.size());
  std::iota(mine.begin(), mine.end(), block.vertices.begin(world.rank()));
  return ask_holders<int>(world, vertices, mine,
                          [&](std::uint64_t v) { return static_cast<int>(numbers[v - vertices.begin(world.rank())]); });
}

}  // namespace

std::vector<int> partition(const World& world, const MeshBlock& block, const PartitionChoice& choice) {
  if (choice.kind == PartitionChoice::Kind::File) return from_file(world, block, choice.file);
  if (choice.kind == PartitionChoice::Kind::Hilbert) return along_curve(world, block);
  return std::vector<int>(block.positions.size(), world.rank());
}

namespace {

constexpr double kLargestWhole = 9e15;

/// Counts the different values of the field on all ranks; 0 if one of them is not a whole number.
std::uint64_t count_different(const World& world, const BlockField& field) {
  std::vector<double> values = field.values;
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const bool whole = std::ranges::all_of(values, [](double v) { return v == std::floor(v) && std::abs(v) <= kLargestWhole; });
  if (world.any(!whole)) return 0;
  // Equal values meet on one rank.
  std::vector<std::vector<double>> to(static_cast<std::size_t>(world.size()));
  for (const double value : values) {
    const std::uint64_t mixed = std::bit_cast<std::uint64_t>(value + 0.0) * 0x9e3779b97f4a7c15U;  // + 0.0 turns -0 into 0
    to[(mixed >> 32U) % to.size()].push_back(value + 0.0);
  }
  std::vector<double> here = world.exchange(to).values;
  std::ranges::sort(here);
  return world.sum(static_cast<std::uint64_t>(std::unique(here.begin(), here.end()) - here.begin()));
}

}  // namespace

std::vector<std::size_t> material_fields(const World& world, const MeshBlock& block) {
  std::vector<std::size_t> found;
  for (const Naming naming : {Naming::Materials, Naming::Geometry}) {
    if (!found.empty()) return found;
    for (std::size_t f = 0; f < block.fields.size(); ++f) {
      const BlockField& field = block.fields[f];
      if (field.on != Field::On::Elements || naming_by_name(field.name) != naming) continue;
      const std::uint64_t different = count_different(world, field);
      const bool numbering = 2 * different > block.elements.size() && different > 2;  // see naming_of()
      if (different >= 2 && !numbering) found.push_back(f);
    }
  }
  return found;
}

}  // namespace dmoscope
