// Reader and writer of universal files (.unv of I-deas, as Salome, Gmsh and others write them): the datasets of nodes, elements and groups.
// https://www.ceas3.uc.edu/sdrluff/all_files.php (datasets 2411, 2412, 2477 and their predecessors)

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_in.h"
#include "core/base/same_bits.h"
#include "core/io/format.h"
#include "core/io/numbered_mesh.h"
#include "core/io/reading/data_lines.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr std::size_t kWholeColumns = 10;
constexpr std::string_view kDatasetMark = "-1";  // alone on a line, begins or ends a dataset
constexpr std::string_view kBlanks = " \t";

/// Entries of a line, at most `most`; where they touch, by columns.
std::vector<std::string_view> entries_of(std::string_view line, std::size_t most, std::size_t columns) {
  std::vector<std::string_view> words = words_of(line, most);
  if (std::ranges::all_of(words, [columns](std::string_view word) { return word.size() <= columns; })) return words;
  words.clear();
  for (std::size_t at = 0; at < line.size() && words.size() < most; at += columns) {
    const std::string_view word = trimmed(line.substr(at, columns));
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

/// Dataset of nodes: how many columns a coordinate has, and whether all coordinates stand behind the node's number.
struct NodeSet {
  std::string_view number;
  std::size_t columns;
  bool on_one_line;
};
constexpr std::array kNodeSets{NodeSet{"2411", 25, false}, NodeSet{"781", 25, false}, NodeSet{"15", 13, true}};

class UnvReader {
 public:
  UnvReader(SourceFile& source, const IoContext& context) : source_(source), lines_(source, context.progress), numbered_(source) {}

  Mesh read() {
    while (lines_.next()) {
      if (is_blank()) continue;
      if (!is_mark()) lines_.fail("a dataset begins with -1");
      if (!lines_.next()) lines_.fail("the file ends before the number of a dataset");
      dataset(trimmed(lines_.line()));
    }
    finish();
    return std::move(mesh_);
  }

 private:
  struct Cell {
    std::int32_t number, property;
    CellShape shape;
    std::array<std::int32_t, 8> nodes;
    std::size_t place;
  };
  struct NamedSet {
    std::string name;
    std::int32_t number;
    std::vector<std::int32_t> cells, nodes;
  };

  [[nodiscard]] bool is_blank() const { return trimmed(lines_.line()).empty(); }
  [[nodiscard]] bool is_mark() const { return trimmed(lines_.line()) == kDatasetMark; }
  /// Goes to the next line of the dataset; false at its end.
  [[nodiscard]] bool next_record() {
    if (!lines_.next()) lines_.fail("the file ends within a dataset, which ends with -1");
    return !is_mark();
  }
  void need_record(std::string_view what) {
    if (!next_record()) lines_.fail(fmt::format("the dataset ends before {}", what));
  }
  [[nodiscard]] std::vector<std::string_view> wholes(std::size_t most = 8) const { return entries_of(lines_.line(), most, kWholeColumns); }
  [[nodiscard]] std::string_view nth(const std::vector<std::string_view>& words, std::size_t n, std::string_view what) const {
    if (n >= words.size()) lines_.fail(fmt::format("expected {}", what));
    return words[n];
  }
  [[nodiscard]] std::int32_t label(const std::vector<std::string_view>& words, std::size_t n, std::string_view what) const {
    return lines_.label(nth(words, n, what), what);
  }

  void dataset(std::string_view number) {
    if (const auto* set = std::ranges::find(kNodeSets, number, &NodeSet::number); set != kNodeSets.end()) return nodes(*set);
    if (number == "2412") return elements();
    for (const std::string_view known : {"2435", "2452", "2467", "2477"})
      if (number == known) return groups();
    source_.add_only_in_file(fmt::format("the dataset {}", number.substr(0, kWholeColumns)));
    while (next_record()) continue;
  }

  void nodes(const NodeSet& set) {
    if (columns_ != 0 && columns_ != set.columns) lines_.fail("nodes in datasets of two kinds");
    columns_ = set.columns;
    constexpr std::size_t kHead = 4;  // words before the coordinates: the number, two systems, a colour
    while (next_record()) {
      std::vector<std::string_view> words = entries_of(lines_.line(), kHead, kWholeColumns);
      const std::int32_t number = label(words, 0, "the number of a node");
      std::string_view coordinates = lines_.line();
      if (set.on_one_line) {
        const std::string_view last = nth(words, kHead - 1, "the colour of a node");
        coordinates.remove_prefix(static_cast<std::size_t>(last.data() - coordinates.data()) + last.size());
      } else {
        need_record("the coordinates of a node");
        coordinates = lines_.line();
      }
      words = entries_of(coordinates, 4, columns_);
      if (words.size() != 3) lines_.fail(fmt::format("a node has 3 coordinates, not {}", words.size()));
      if (static_cast<std::size_t>(words[1].data() - words[0].data()) == words[0].size())
        source_.set_not_patchable("coordinates touch each other");
      const Vec3 p{lines_.real(words[0], "x coordinate"), lines_.real(words[1], "y coordinate"), lines_.real(words[2], "z coordinate")};
      numbered_.add_node(number, p, lines_.offset_of(coordinates));
    }
  }

  /// Shape of an element by its number of nodes, for there are many kinds of plates and solids; none: no element of a mesh (springs,
  /// masses).
  [[nodiscard]] std::optional<CellShape> shape_of_kind(std::int32_t kind, std::int32_t nodes) const {
    constexpr std::int32_t kFirstFlat = 41, kFirstSolid = 101, kFirstOther = 121;
    if (kind >= kFirstOther) return std::nullopt;
    if (kind >= kFirstSolid) {
      if (nodes == 4) return CellShape::Tetrahedron;
      if (nodes == 5) return CellShape::Pyramid;
      if (nodes == 6) return CellShape::Wedge;
      if (nodes == 8) return CellShape::Hexahedron;
    } else if (kind >= kFirstFlat) {
      if (nodes == 3) return CellShape::Triangle;
      if (nodes == 4) return CellShape::Quadrilateral;
    } else if (nodes == 2) {
      return CellShape::Line;
    }
    lines_.fail(fmt::format("an element of kind {} with {} nodes: only elements without nodes beyond their corners are read", kind, nodes));
  }

  void elements() {
    constexpr std::int32_t kMostNodes = 1000;
    while (next_record()) {
      const std::size_t place = lines_.begin();
      const auto head = wholes();
      const std::int32_t number = label(head, 0, "the number of an element"), kind = label(head, 1, "the kind of an element");
      const std::int32_t count = label(head, 5, "how many nodes an element has");
      if (count > kMostNodes) lines_.fail(fmt::format("an element with {} nodes", count));
      const auto shape = shape_of_kind(kind, count);
      need_record("the nodes of an element");
      constexpr std::int32_t kFirstFlat = 41;
      if (kind < kFirstFlat && wholes().size() == 3) need_record("the nodes of a beam");  // the nodes follow its orientation and sections
      Cell cell{number, 0, shape.value_or(CellShape::Point), {}, place};
      const std::int64_t property = lines_.integer(nth(head, 2, "the property of an element"), "the property of an element");
      if (property > 0 && property < 0x7fffffff) cell.property = static_cast<std::int32_t>(property);
      for (std::int32_t k = 0; k < count;) {
        const auto words = wholes();
        if (words.empty()) lines_.fail("expected the number of a node");
        for (const std::string_view word : words) {
          if (k == count) lines_.fail(fmt::format("more than {} nodes", count));
          const std::int32_t node = lines_.label(word, "the number of a node");
          if (shape) cell.nodes[static_cast<std::size_t>(k)] = node;
          ++k;
        }
        if (k < count) need_record("the nodes of an element");
      }
      if (shape)
        cells_.push_back(cell);
      else
        source_.add_only_in_file("elements that are no piece of a mesh (springs, masses)");
    }
  }

  /// Reads groups. Each has its number, the number of its entities as the last of eight words, its name, and then kind, number and two more
  /// words of each entity.
  void groups() {
    constexpr std::int64_t kNode = 7, kElement = 8;
    while (next_record()) {
      const auto head = wholes();
      NamedSet set{{}, label(head, 0, "the number of a group"), {}, {}};
      const std::int64_t count = lines_.integer(nth(head, 7, "how many entities a group has"), "how many entities a group has");
      need_record("the name of a group");
      set.name = trimmed(lines_.line());
      for (std::int64_t k = 0; k < count;) {
        need_record("the entities of a group");
        const auto words = wholes();
        if (words.empty() || words.size() % 4 != 0) lines_.fail(fmt::format("each entity of a group has 4 numbers, not {}", words.size()));
        for (std::size_t w = 0; w < words.size(); w += 4, ++k) {
          const std::int64_t kind = lines_.integer(words[w], "the kind of an entity");
          if (kind == kNode || kind == kElement)
            (kind == kNode ? set.nodes : set.cells).push_back(lines_.label(words[w + 1], "the number of an entity"));
          else
            source_.add_only_in_file("entities of groups that are neither nodes nor elements");
        }
      }
      groups_.push_back(std::move(set));
    }
  }

  void finish() {
    if (numbered_.node_count() == 0) throw InputError(source_.path().string(), 0, "the universal file has no nodes (dataset 2411)");
    CoordinateLayout layout;
    layout.width = static_cast<std::uint8_t>(columns_ - 1);
    source_.set_layout(layout);
    name_cells();
    numbered_.finish(mesh_);
    (void)split_cells(numbered_.cells(), labels_, mesh_, source_);
    for (const NamedSet& set : groups_) {
      if (set.nodes.empty()) continue;
      Group group{.name = set.name, .role = "group", .code = set.number, .dimension = 0};
      for (const std::int32_t node : set.nodes)
        if (const Index v = numbered_.vertex(node); v != kNoIndex) group.members.push_back(v);
      mesh_.groups.push_back(std::move(group));
    }
  }

  /// Gives each cell its origin: the groups that have it, and its property, where cells have several.
  void name_cells() {
    std::map<std::int32_t, std::vector<std::uint32_t>> groups_of;  // by number of the cell
    for (std::uint32_t g = 0; g < groups_.size(); ++g)
      for (const std::int32_t cell : groups_[g].cells) groups_of[cell].push_back(g);
    const auto other = [this](const Cell& cell) { return cell.property != cells_.front().property; };
    const bool several = std::ranges::any_of(cells_, other);
    std::map<std::pair<std::int32_t, std::vector<std::uint32_t>>, std::uint32_t> origins;
    for (const Cell& cell : cells_) {
      const std::int32_t property = several ? cell.property : 0;
      const auto found = groups_of.find(cell.number);
      const auto [at, added] = origins.try_emplace({property, found == groups_of.end() ? std::vector<std::uint32_t>() : found->second},
                                                   static_cast<std::uint32_t>(labels_.size()));
      if (added) {
        OriginLabels& labels = labels_.emplace_back();
        if (property > 0) labels.labels.push_back({fmt::format("property {}", property), "property", property});
        for (const std::uint32_t g : at->first.second) labels.labels.push_back({groups_[g].name, "group", groups_[g].number});
      }
      numbered_.add_cell(cell.number, cell.shape, std::span(cell.nodes).first(corners_of(cell.shape)), at->second, cell.place);
    }
  }

  SourceFile& source_;
  DataLines lines_;
  NumberedMesh numbered_;
  Mesh mesh_;
  std::size_t columns_ = 0;  // columns of a coordinate; 0: there was no node yet
  std::vector<Cell> cells_;
  std::vector<NamedSet> groups_;
  std::vector<OriginLabels> labels_;
};

/// Number in the columns of one that it replaces, with that one's letter for the power of ten. `token`: the one it replaces.
std::string number_like(std::string_view token, double value, std::size_t width, std::atomic<std::size_t>& rounded) {
  constexpr std::size_t kAllDigits = 24;  // -1.2345678901234567E-100
  std::string text = fmt::format("{:.16E}", value);
  if (width < kAllDigits) {
    FieldNumber number = number_in_field(value, width, ExponentStyle::Letter);
    if (number.value != value) ++rounded;
    text = std::move(number.text);
  }
  const bool with_d = token.find_first_of("Dd") != std::string_view::npos;
  if (with_d) std::ranges::replace(text, 'E', 'D'), std::ranges::replace(text, 'e', 'D');
  return text;
}

/// Writes the file with new numbers, which end in the columns where those ended that they replace, as far as there is room.
Notes patch_unv(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  constexpr std::size_t kGrain = 16384;
  const SourceFile& source = *mesh.source;
  const std::string_view bytes = source.bytes();
  std::atomic<std::size_t> rounded = 0;
  TextWriter out(file, context);
  out.bytes(bytes.substr(0, source.place(0)));
  out.in_parts(source.place_count(), kGrain, [&](TextBuffer& part, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 before = mesh.positions[source.vertex_at(i)], after = moved.positions[source.vertex_at(i)];
      const std::array<std::pair<double, double>, 3> changes{{{before.x, after.x}, {before.y, after.y}, {before.z, after.z}}};
      std::size_t at = source.place(i);
      for (const auto& [from, to] : changes) {
        const std::size_t begin = bytes.find_first_not_of(kBlanks, at), end = std::min(bytes.find_first_of(" \t\r\n", begin), bytes.size());
        const std::string_view token = bytes.substr(begin, end - begin);
        if (same_bits(from, to)) {
          part << bytes.substr(at, end - at);
        } else {
          const std::string text = number_like(token, to, source.layout().width, rounded);
          const std::size_t least = at == 0 || bytes[at - 1] == '\n' || bytes[at - 1] == '\r' ? 0 : 1;  // number of blanks before it
          part << std::string(std::max(least, end - at > text.size() ? end - at - text.size() : 0), ' ') << text;
        }
        at = end;
      }
      const std::size_t next = i + 1 < source.place_count() ? source.place(i + 1) : bytes.size();
      part << bytes.substr(at, next - at);
    }
  });
  out.finish();
  if (rounded == 0) return {};
  return {fmt::format("{} coordinates were rounded to the {} characters that the file has for a number.", rounded.load(),
                      source.layout().width)};
}

bool recognises_unv(std::string_view bytes) {
  return trimmed(take_line(bytes)) == kDatasetMark && number_in<int>(trimmed(take_line(bytes))).value_or(0) > 0;
}

}  // namespace

constinit const FormatHandler kUnvFormat{
    .info = {"unv", "Universal file (I-deas)", ".unv", "2D and 3D elements, properties and groups; only written where it was read"},
    .recognises = recognises_unv,
    .read = read_with<UnvReader>,
    .patch = patch_unv,
    .not_written = "a universal file is written only where one was read: write it as .msh or .bdf"};

}  // namespace dmoscope
