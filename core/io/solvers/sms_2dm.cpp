// The 2D meshes of Aquaveo's SMS (.2dm), which TUFLOW, BASEMENT, QGIS and others take as well: a card a line, elements, nodes with their
// elevation, and nodestrings.
// https://www.xmswiki.com/wiki/SMS:2D_Mesh_Files_*.2dm

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_in.h"
#include "core/io/mesh_writer.h"
#include "core/io/numbered_mesh.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr TextSyntax k2dmSyntax{};
constexpr std::string_view k2dmSignature = "MESH2D";
constexpr std::string_view kString = "nodestring", kMaterial = "material", kElevation = "elevation";

struct ElementCard {
  std::string_view card;
  std::optional<CellShape> shape;  // none: an element of higher order
};
constexpr std::array kElementCards{
    ElementCard{"E2L", CellShape::Line}, ElementCard{"E3T", CellShape::Triangle}, ElementCard{"E4Q", CellShape::Quadrilateral},
    ElementCard{"E3L", std::nullopt},    ElementCard{"E6T", std::nullopt},        ElementCard{"E8Q", std::nullopt},
    ElementCard{"E9Q", std::nullopt}};
constexpr std::array<std::string_view, 4> kVolumeCards{"E4T", "E5P", "E6W", "E8H"};

class Sms2dmReader {
 public:
  Sms2dmReader(SourceFile& source, const IoContext& context)
      : source_(source), tokens_(source.bytes(), source.path().string(), k2dmSyntax, context.progress), numbered_(source) {
    source.set_layout({.components = 2, .syntax = {}});
  }

  Mesh read() {
    if (tokens_.token() != k2dmSignature) tokens_.fail(fmt::format("a 2dm file begins with {}", k2dmSignature));
    tokens_.end_line();
    while (!tokens_.at_end()) {
      const std::size_t begin = tokens_.offset();
      card(tokens_.token_on_line(), begin);
    }
    if (!string_.empty()) tokens_.fail_at(string_line_, "a nodestring without an end, a negative number");
    finish();
    return std::move(mesh_);
  }

 private:
  void card(std::string_view card, std::size_t begin) {
    const auto* const element =
        std::find_if(kElementCards.begin(), kElementCards.end(), [&](const ElementCard& c) { return c.card == card; });
    if (!string_.empty() && card != "NS") tokens_.fail_at(string_line_, "a nodestring without an end, a negative number");
    if (card == "ND") {
      node();
    } else if (card == "NS") {
      nodestring();
    } else if (element != kElementCards.end()) {
      cell(*element, begin);
    } else if (std::find(kVolumeCards.begin(), kVolumeCards.end(), card) != kVolumeCards.end()) {
      tokens_.fail(fmt::format("{} is a volume element: of these files only the planar ones are read", card));
    } else if (card == "MESHNAME") {
      mesh_.title = unquoted(trimmed(tokens_.rest_of_line()));
    } else if (card == "NUM_MATERIALS_PER_ELEM") {
      materials_ = tokens_.read_count("the number of materials", 0);
      tokens_.end_line();
    } else if (card == "MAT") {
      material_name();
    } else {
      source_.add_only_in_file("settings and other cards");
      (void)tokens_.rest_of_line();
    }
  }

  std::int32_t label(std::string_view what) {
    const std::int64_t value = tokens_.read_integer(what);
    if (value < 1 || value > std::numeric_limits<std::int32_t>::max()) tokens_.fail(fmt::format("{} out of range: {}", what, value));
    return static_cast<std::int32_t>(value);
  }

  void node() {
    const std::int32_t number = label("the number of a node");
    std::size_t place = 0;
    const Vec3 p = tokens_.read_point(2, place);
    elevations_.push_back(tokens_.read_double("elevation of a node"));
    if (tokens_.more_on_line()) tokens_.fail("a node has a number, x, y and an elevation: there is more on this line");
    numbered_.add_node(number, p, place);
    tokens_.end_line();
  }

  void cell(const ElementCard& card, std::size_t begin) {
    if (!card.shape) {
      if (card.card == "E3L") {
        source_.add_only_in_file("lines of three nodes (E3L)");
        return (void)tokens_.rest_of_line();
      }
      tokens_.fail(fmt::format("{} is an element of higher order: only E3T and E4Q are read", card.card));
    }
    const std::int32_t number = label("the number of an element");
    std::array<std::int32_t, 4> nodes{};
    const std::span<std::int32_t> used(nodes.data(), corners_of(*card.shape));
    for (std::int32_t& node : used) node = label("the number of a node");
    int material = 0;
    for (std::size_t m = 0; tokens_.more_on_line(); ++m) {
      if (materials_ && m >= *materials_) tokens_.fail(fmt::format("an element has {} materials: there is more on this line", *materials_));
      const std::string_view token = tokens_.token_on_line();
      const std::optional<int> value = number_in<int>(token);
      if (m == 0 && value) {
        material = *value;
      } else {
        (void)tokens_.parse_double(token, "a material");
        source_.add_only_in_file("further values of its elements");
      }
    }
    numbered_.add_cell(number, *card.shape, used, origin_of(material), begin);
    tokens_.end_line();
  }

  std::uint32_t origin_of(int material) {
    const auto [at, added] = origins_.try_emplace(material, static_cast<std::uint32_t>(labels_.size()));
    if (added) {
      labels_.push_back({{{fmt::format("material {}", material), std::string(kMaterial), material}}, material != 0});
    }
    return at->second;
  }

  void material_name() {
    const std::optional<int> number = number_in<int>(tokens_.token_on_line());
    const std::string_view name = unquoted(trimmed(tokens_.rest_of_line()));
    if (number && !name.empty()) names_[*number] = name;
  }

  /// Reads nodes over one or more lines; the last one is negative. The string's number and name may follow.
  void nodestring() {
    if (string_.empty()) string_line_ = tokens_.line();
    while (tokens_.more_on_line()) {
      const std::int64_t number = tokens_.read_integer("the number of a node");
      if (number == 0) tokens_.fail("a nodestring names node 0");
      string_.push_back({number < 0 ? -number : number, tokens_.line()});
      if (number < 0) return end_string();
    }
    tokens_.end_line();
  }

  void end_string() {
    String string{std::move(string_), 0, {}};
    string_.clear();
    const std::size_t offset = tokens_.offset();
    const std::size_t line = tokens_.line();
    if (const std::optional<int> number = number_in<int>(tokens_.token_on_line())) {
      string.number = *number;
    } else {
      tokens_.seek(offset, line);
    }
    string.name = unquoted(trimmed(tokens_.rest_of_line()));
    strings_.push_back(std::move(string));
  }

  void finish() {
    numbered_.finish(mesh_);
    for (OriginLabels& labels : labels_) {
      const auto name = names_.find(labels.labels.front().code);
      if (name != names_.end()) labels.labels.front().name = name->second;
    }
    (void)split_cells(numbered_.cells(), labels_, mesh_, source_);
    mesh_.fields.push_back({.name = std::string(kElevation),
                            .on = Field::On::Vertices,
                            .type = "double",
                            .role = std::string(kElevation),
                            .values = std::move(elevations_),
                            .place = {.with_positions = true, .at = 2}});
    add_strings();
  }

  /// Adds a group for each number; strings without one are groups of their own.
  void add_strings() {
    std::map<std::pair<int, int>, std::size_t> known;  // index of each group by number and dimension
    for (const String& string : strings_) {
      std::vector<Index> vertices;
      for (const auto& [number, line] : string.nodes) {
        vertices.push_back(numbered_.vertex(number));
        if (vertices.back() == kNoIndex)
          tokens_.fail_at(line, fmt::format("a nodestring names node {}, which the file does not have", number));
      }
      const int dimension = vertices.size() == 1 ? 0 : 1;
      const auto found = string.number > 0 ? known.find({string.number, dimension}) : known.end();
      const std::size_t at = found != known.end() ? found->second : mesh_.groups.size();
      if (found == known.end()) {
        const std::string plain = fmt::format("nodestring {}", string.number > 0 ? static_cast<std::size_t>(string.number) : ++unnumbered_);
        mesh_.groups.push_back({.name = string.name.empty() ? plain : std::string(string.name),
                                .role = std::string(kString),
                                .code = std::max(string.number, 0),
                                .dimension = dimension});
        if (string.number > 0) known[{string.number, dimension}] = at;
      }
      std::vector<Index>& members = mesh_.groups[at].members;
      if (dimension == 0) members.push_back(vertices.front());
      for (std::size_t i = 1; i < vertices.size(); ++i) members.insert(members.end(), {vertices[i - 1], vertices[i]});
    }
  }

  struct String {
    std::vector<std::pair<std::int64_t, std::size_t>> nodes;  // nodes, with the line of each
    int number = 0;
    std::string_view name;
  };

  SourceFile& source_;
  Tokenizer tokens_;
  NumberedMesh numbered_;
  Mesh mesh_;
  std::optional<std::size_t> materials_;
  std::vector<double> elevations_;
  std::vector<OriginLabels> labels_;
  std::map<int, std::uint32_t> origins_;  // origins by material
  std::map<int, std::string_view> names_;
  std::vector<std::pair<std::int64_t, std::size_t>> string_;  // nodes of the present string
  std::size_t string_line_ = 0;
  std::vector<String> strings_;
  std::size_t unnumbered_ = 0;
};

bool recognises_2dm(std::string_view bytes) {
  return bytes.starts_with(k2dmSignature) && bytes.size() > k2dmSignature.size() &&
         static_cast<unsigned char>(bytes[k2dmSignature.size()]) <= ' ';
}

// --- Writing new files ---

class Writer : MeshWriter {
 public:
  Writer(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, kSms2dmFormat.info.title, kString) {
    require_surface_elements(file, mesh, title_);
    require_constant_z(file, positions, title_, notes_);
  }

  Notes write() {
    const std::vector<int> materials = numbers_of_elements(mesh_, numbers_, title_, notes_);
    out_ << k2dmSignature << '\n';
    if (!mesh_.title.empty()) out_ << "MESHNAME \"" << in_quotes(mesh_.title) << "\"\n";
    out_.for_each(mesh_.elements.size(), [&](TextBuffer& part, std::size_t e) {
      const FileCorners corners = file_corners(mesh_, e);
      part << (corners.size() == 3 ? "E3T " : "E4Q ") << e + 1;
      put_corners(part, corners, 1);
      part << ' ' << materials[e] << '\n';
    });
    nodes();
    for (std::size_t i = 0; i < groups_.size(); ++i) strings(i);
    material_names();
    return finish();
  }

 private:
  /// Elevation of each node. A depth counts downwards.
  std::vector<double> elevations() {
    std::vector<double> values(positions_.size(), 0.0);
    for (const std::string_view name : {kElevation, std::string_view("depth")}) {
      for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
        const Field& field = mesh_.fields[i];
        if (field.name != name || field.on != Field::On::Vertices || field.components != 1) continue;
        const bool depth = name != kElevation;
        std::size_t without = 0;
        for (std::size_t v = 0; v < values.size(); ++v) {
          if (std::isfinite(field.values[v])) {
            values[v] = depth && field.values[v] != 0.0 ? -field.values[v] : field.values[v];
          } else {
            ++without;
          }
        }
        if (depth) notes_.emplace_back("Field \"depth\" was written as the elevation, with its sign turned.");
        if (without > 0) notes_.push_back(fmt::format("Field \"{}\" is no number at {} vertices: 0 was written.", name, without));
        kept_fields_.push_back(i);
        return values;
      }
    }
    notes_.emplace_back("The mesh has no elevation: 0 was written for every vertex.");
    return values;
  }

  void nodes() {
    const std::vector<double> z = elevations();
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << "ND " << v + 1 << ' ' << positions_[v].x << ' ' << positions_[v].y << ' ' << z[v] << '\n';
    });
  }

  void strings(std::size_t i) {
    const Group& group = groups_[i];
    const bool points = group.dimension == 0 && group.role == kString;
    if ((group.dimension != 1 && !points) || group.members.empty()) return;
    kept_groups_.push_back(i);
    std::vector<Index> chain;
    if (points) {
      for (const Index v : group.members) {
        chain.assign(1, v);
        end_string(i, chain);
      }
      return;
    }
    for (std::size_t k = 0; k + 1 < group.members.size(); k += 2) {
      if (!chain.empty() && chain.back() != group.members[k]) end_string(i, chain);
      if (chain.empty()) chain.push_back(group.members[k]);
      chain.push_back(group.members[k + 1]);
    }
    end_string(i, chain);
  }

  void end_string(std::size_t group, std::vector<Index>& chain) {
    constexpr std::size_t kOnLine = 10;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (k % kOnLine == 0) out_ << (k == 0 ? "NS" : "\nNS");
      out_ << (k + 1 == chain.size() ? " -" : " ") << chain[k] + 1;
    }
    out_ << ' ' << numbers_[group];
    if (groups_[group].name != fmt::format("nodestring {}", numbers_[group])) out_ << " \"" << in_quotes(groups_[group].name) << '"';
    out_ << '\n';
    chain.clear();
  }

  void material_names() {
    bool begun = false;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (!groups_[i].of_elements() || groups_[i].members.empty()) continue;
      kept_groups_.push_back(i);
      if (groups_[i].name == fmt::format("material {}", numbers_[i])) continue;
      if (!begun) out_ << "BEG2DMBC\n";
      begun = true;
      out_ << "MAT " << numbers_[i] << " \"" << in_quotes(groups_[i].name) << "\"\n";
    }
    if (begun) out_ << "END2DMBC\n";
  }
};

}  // namespace

constinit const FormatHandler kSms2dmFormat{
    .info = {"2dm", "SMS 2dm", ".2dm", "x, y and elevation, triangles and quadrilaterals, materials, nodestrings"},
    .recognises = recognises_2dm,
    .read = read_with<Sms2dmReader>,
    .write = write_with<Writer>};

}  // namespace dmoscope
