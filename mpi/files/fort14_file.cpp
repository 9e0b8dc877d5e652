// Reads and writes ADCIRC's fort.14 by many ranks.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/io/solvers/fort14.h"
#include "mpi/files/text_mesh_file.h"
#include "mpi/world/world.h"

namespace dmoscope {

namespace {

/// Answers about the things that a rank asked for by number.
struct NumberLookup {
  /// The first thing of each asked number; kNone if no thing has it.
  std::vector<std::uint64_t> found;
  std::uint64_t twice = kNone;  // the least thing whose number an earlier one has, on any rank; kNone: there is none
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
};

struct Numbered {
  std::int64_t number;
  std::uint64_t thing;
  friend auto operator<=>(const Numbered&, const Numbered&) = default;
};

/// The rank that keeps the answers about a number.
int keeper(std::int64_t number, int ranks) {
  const std::uint64_t mixed = static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15U;
  return static_cast<int>((mixed >> 32U) % static_cast<std::uint64_t>(ranks));
}

/// Looks numbers up. `numbers`: of this rank's things, which are things first, first + 1, ... of all; `asked`: wanted numbers. To be called
/// by all ranks together.
NumberLookup look_up_numbers(const World& world, std::span<const std::int64_t> numbers, std::uint64_t first,
                             std::span<const std::int64_t> asked) {
  const Parts<Numbered> known = deal<Numbered>(world, [&](const auto& give) {
    for (std::size_t i = 0; i < numbers.size(); ++i) give(keeper(numbers[i], world.size()), Numbered{numbers[i], first + i});
  });
  std::vector<Numbered> kept = world.exchange(known).values;
  std::ranges::sort(kept);
  NumberLookup lookup;
  for (std::size_t i = 1; i < kept.size(); ++i)
    if (kept[i].number == kept[i - 1].number) lookup.twice = std::min(lookup.twice, kept[i].thing);
  lookup.twice = world.least(lookup.twice);

  const Keepers<std::int64_t> questions(world, asked, [&](std::int64_t number) { return keeper(number, world.size()); });
  std::vector<std::uint64_t> answers;
  answers.reserve(questions.kept().size());
  for (const std::int64_t number : questions.kept()) {
    const auto at = std::ranges::lower_bound(kept, number, {}, &Numbered::number);
    answers.push_back(at != kept.end() && at->number == number ? at->thing : NumberLookup::kNone);
  }
  lookup.found = questions.give_back(answers);
  return lookup;
}

class Fort14File final : public CountedMeshFile {
 public:
  Fort14File(const World& world, const std::filesystem::path& path)
      : CountedMeshFile(world, path, {.components = 2, .syntax = kFort14Syntax}) {}

  MeshBlock read(const FieldFilter& filter) override {
    const LineBlock mine = read_body("elements");
    Parsed parsed;
    world().together([&] { parsed = parse(mine); });
    const Strings strings = read_strings(mine);
    close();

    MeshBlock block = block_of(std::move(parsed.positions), std::move(parsed.kinds));
    if (filter.wants("depth", Field::On::Vertices)) block.fields.push_back({"depth", Field::On::Vertices, std::move(parsed.depths)});
    resolve(mine, parsed, strings, block);
    return block;
  }
  std::vector<std::string> nodal_fields() const override { return {"depth"}; }

 private:
  struct Parsed {
    std::vector<Vec3> positions;
    std::vector<double> depths;
    std::vector<std::int64_t> numbers;  // numbers of the nodes
    std::vector<ElementKind> kinds;
    std::vector<std::int64_t> corners;  // node numbers
  };
  /// The boundary strings: their members are indices into `numbers`, the nodes' numbers in the file.
  struct Strings {
    std::vector<Group> groups;
    std::vector<std::int64_t> numbers;
  };

  void read_head(Tokenizer& tokens, std::uint64_t& nodes, std::uint64_t& elements) override {
    static_cast<void>(tokens.rest_of_line());
    if (tokens.at_end()) tokens.fail_at_end("number of elements");
    elements = read_count(tokens, "number of elements");
    nodes = read_count(tokens, "number of vertices");
    tokens.end_line();
  }

  [[nodiscard]] Parsed parse(const LineBlock& lines) const {
    Parsed parsed;
    each_line(lines, [&](Tokenizer& tokens, std::uint64_t line) {
      if (line >= vertices_ + elements_) return false;
      if (line < vertices_) {
        const Fort14Node node = read_fort14_node(tokens);
        parsed.positions.push_back(node.position);
        parsed.depths.push_back(node.depth);
        parsed.numbers.push_back(node.number);
        return true;
      }
      const std::size_t count = read_fort14_element(tokens);
      for (std::size_t i = 0; i < count; ++i) parsed.corners.push_back(tokens.read_integer("vertex index"));
      tokens.end_numbers_of("an element");
      parsed.kinds.push_back(count == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral);
      return true;
    });
    return parsed;
  }
  void vertices(const LineBlock& lines, VertexLines& found) const override {
    each_line(lines, [&](Tokenizer& tokens, std::uint64_t line) {
      if (line >= vertices_) return false;
      const Fort14Node node = read_fort14_node(tokens);
      found.positions.push_back(node.position);
      found.places.push_back(node.place);
      return true;
    });
  }

  /// Reads the boundary strings, on all ranks: all after the elements is short.
  [[nodiscard]] Strings read_strings(const LineBlock& lines) const {
    struct Place {
      std::uint64_t offset, line;
    };
    Place begin{file().size(), 0};
    each_line(lines, [&](Tokenizer& tokens, std::uint64_t line) {
      if (line == vertices_ + elements_) begin = {lines.offset + tokens.offset(), tokens.line()};
      if (line < vertices_ + elements_) tokens.end_line();
      return line < vertices_ + elements_;
    });
    for (const Place& one : world().all_of(begin))
      if (one.offset < begin.offset) begin = one;
    Strings strings;
    world().together([&] {
      const auto number = [&](Tokenizer& own, std::string_view what) {
        strings.numbers.push_back(own.read_integer(what));
        return static_cast<Index>(strings.numbers.size() - 1);
      };
      with_tokens(file().read(begin.offset, file().size() - begin.offset), begin.line,
                  [&](Tokenizer& tokens) { strings.groups = read_fort14_boundaries(tokens, number, nullptr); });
    });
    return strings;
  }

  /// Translates the file's numbers of nodes to vertices.
  void resolve(const LineBlock& lines, const Parsed& parsed, const Strings& strings, MeshBlock& block) const {
    const std::uint64_t first = block.vertices.begin(world().rank());
    std::vector<std::int64_t> asked = parsed.corners;
    asked.insert(asked.end(), strings.numbers.begin(), strings.numbers.end());
    std::vector<std::uint64_t> found;
    if (world().any(!counts_up(parsed.numbers, first))) {
      const NumberLookup lookup = look_up_numbers(world(), parsed.numbers, first, asked);
      world().together([&] {
        if (lookup.twice != NumberLookup::kNone)
          throw InputError(name(), 0, fmt::format("vertex {} has the number of one before it", lookup.twice + 1));
      });
      found = lookup.found;
    } else {
      for (const std::int64_t number : asked)
        found.push_back(number >= 1 && static_cast<std::uint64_t>(number) <= vertices_ ? static_cast<std::uint64_t>(number - 1)
                                                                                       : NumberLookup::kNone);
    }
    world().together([&] { require_found(lines, parsed, strings, found); });
    block.corners.assign(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(parsed.corners.size()));
    for (const Group& group : strings.groups) {
      VertexString string{group.name, {}};
      for (const Index member : group.members) string.vertices.push_back(found[parsed.corners.size() + member]);
      block.strings.push_back(std::move(string));
    }
  }
  static bool counts_up(const std::vector<std::int64_t>& numbers, std::uint64_t first) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (numbers[i] != static_cast<std::int64_t>(first + i) + 1) return false;
    return true;
  }

  void require_found(const LineBlock& lines, const Parsed& parsed, const Strings& strings, const std::vector<std::uint64_t>& found) const {
    const auto missing = static_cast<std::size_t>(std::ranges::find(found, NumberLookup::kNone) - found.begin());
    if (missing == found.size()) return;
    if (missing >= parsed.corners.size())
      throw InputError(name(), 0,
                       fmt::format("a boundary names vertex {}, which does not exist", strings.numbers[missing - parsed.corners.size()]));
    std::size_t seen = 0;
    each_line(lines, [&](Tokenizer& tokens, std::uint64_t line) {
      if (line < vertices_) {
        tokens.end_line();
        return true;
      }
      seen += read_fort14_element(tokens);
      if (seen > missing) tokens.fail(fmt::format("vertex index {}: no vertex has this number", parsed.corners[missing]));
      tokens.end_line();
      return true;
    });
  }
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared_fort14(const World& world, const std::filesystem::path& path) {
  return std::make_unique<Fort14File>(world, path);
}

}  // namespace dmoscope
