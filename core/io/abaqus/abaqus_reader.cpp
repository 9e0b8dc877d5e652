// Reader of Abaqus' input files: keywords that begin with a star and lines of data below them.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/io/abaqus/abaqus.h"
#include "core/io/numbered_mesh.h"
#include "core/io/reading/data_lines.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kAbaqusSyntax{.comma_is_blank = true};

// Names of element types up to the number of nodes.
constexpr std::string_view kSolids = "C3D DC3D AC3D COH3D SC F3D CSS EC3D Q3D DCC3D",
                           kPlanar = "CPS CPE CPEG CAX CGAX DCAX ACAX DC2D AC2D S COH2D COHAX DCC2D DCCAX STRI M3D R3D SFM3D DS WARPF2D";

/// A keyword with its parameters, such as "*Element, type=C3D8, elset=Body".
struct Keyword {
  std::string name;  // name in capitals, with one blank between its words
  std::vector<std::pair<std::string, std::string_view>> parameters;

  [[nodiscard]] bool has(std::string_view parameter) const {
    return std::ranges::any_of(parameters, [&](const auto& p) { return p.first == parameter; });
  }
  /// Value of a parameter; empty if there is none.
  [[nodiscard]] std::string_view value(std::string_view parameter) const {
    const auto found = std::ranges::find(parameters, parameter, [](const auto& p) { return std::string_view(p.first); });
    return found == parameters.end() ? std::string_view() : found->second;
  }
};

/// Words in capitals, with single blanks between them and none around.
std::string keyword_words(std::string_view words) {
  std::string result;
  for (const char c : abaqus_key(trimmed(words))) {
    if (c != ' ' && c != '\t') {
      result += c;
    } else if (!result.ends_with(' ')) {
      result += ' ';
    }
  }
  return result;
}

Keyword keyword_of(std::span<const std::string_view> fields) {
  Keyword keyword;
  if (fields.empty()) return keyword;
  keyword.name = keyword_words(fields.front().substr(1));
  for (const std::string_view field : fields.subspan(1)) {
    const std::size_t equals = field.find('=');
    keyword.parameters.emplace_back(keyword_words(field.substr(0, equals)),
                                    equals == std::string_view::npos ? std::string_view() : trimmed(field.substr(equals + 1)));
  }
  return keyword;
}

bool is_number(std::string_view field) { return !field.empty() && field.find_first_not_of("0123456789") == std::string_view::npos; }

/// Reader, see FormatHandler. Files of one part (or none) are read. Throws InputError, Cancelled.
class AbaqusReader {
 public:
  AbaqusReader(SourceFile& source, const IoContext& context) : source_(source), lines_(source, context.progress), numbered_(source) {}

  Mesh read() {
    while (lines_.next()) {
      const std::string_view line = trimmed(lines_.line());
      if (line.starts_with("**")) {
        source_.add_only_in_file("comments");
      } else if (line.starts_with('*')) {
        end_block();
        begin_block();
      } else if (!line.empty()) {
        data();
      }
    }
    end_block();
    finish();
    return std::move(mesh_);
  }

 private:
  enum class Block { Other, Heading, Nodes, Elements, NodeSet, ElementSet, Surface, Instance };

  void begin_block() {
    std::vector<std::string_view> fields(lines_.fields().begin(), lines_.fields().end());
    while (lines_.ends_with_comma() && lines_.next()) fields.insert(fields.end(), lines_.fields().begin(), lines_.fields().end());
    const Keyword keyword = keyword_of(fields);
    begun_ = true;
    block_ = Block::Other;
    const std::string& name = keyword.name;
    if (name == "HEADING") {
      block_ = Block::Heading;
    } else if (name == "NODE") {
      begin_nodes(keyword);
    } else if (name == "ELEMENT") {
      begin_elements(keyword);
    } else if (name == "NSET" || name == "ELSET") {
      begin_set(keyword);
    } else if (name == "SURFACE") {
      begin_surface(keyword);
    } else if (!structure(keyword)) {
      refuse_generators(name);
      say_other(name);
    }
  }

  /// Handles keywords of parts, assembly and instances. False: the keyword is none of these.
  bool structure(const Keyword& keyword) {
    const std::string& name = keyword.name;
    if (name == "PART") {
      ++parts_;
    } else if (name == "ASSEMBLY") {
      scope_ = "ASSEMBLY";
    } else if (name == "END ASSEMBLY") {
      scope_.clear();
    } else if (name == "INSTANCE") {
      if (++instances_ > 1) lines_.fail("a second *INSTANCE: only files with one part, used once, are read; merge the instances");
      in_instance_ = true;
      block_ = Block::Instance;
    } else if (name == "END INSTANCE") {
      in_instance_ = false;
    } else {
      return name == "END PART" || name == "PREPRINT";
    }
    return true;
  }

  /// Refuses keywords that generate nodes or elements, which the file then does not list.
  void refuse_generators(const std::string& name) const {
    constexpr std::array<std::string_view, 8> kGenerators{"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "PARAMETER"};
    if (name == "INCLUDE") lines_.fail("*INCLUDE: files in several parts are not read; put all into one");
    if (std::ranges::find(kGenerators, name) != kGenerators.end()) {
      lines_.fail(fmt::format("*{}: only nodes and elements that the file lists are read; save the mesh flat", name));
    }
  }

  void say_other(const std::string& name) {
    constexpr std::size_t kNamed = 8;
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 -_";
    if (other_.size() >= kNamed || name.empty() || name.find_first_not_of(kLetters) != std::string::npos) {
      source_.add_only_in_file("other keywords");
    } else if (std::ranges::find(other_, name) == other_.end()) {
      other_.push_back(name);
      source_.add_only_in_file("*" + name);
    }
  }

  /// Whether to skip nodes, elements or sets of the assembly itself (reference points): their numbers may be those of the part's, too.
  bool of_the_assembly() {
    if (scope_.empty() || in_instance_) return false;
    source_.add_only_in_file("reference points and connectors of the assembly");
    return true;
  }

  void begin_nodes(const Keyword& keyword) {
    if (of_the_assembly()) return;
    if (keyword.has("INPUT")) lines_.fail("*NODE, INPUT=: files in several parts are not read; put all into one");
    const std::string system = keyword_words(keyword.value("SYSTEM"));
    if (!system.empty() && system != "R") {
      lines_.fail(fmt::format("*NODE, SYSTEM={}: only rectangular coordinates are read", quote_token(system)));
    }
    if (numbered_.node_count() > 0 && part_of_nodes_ != parts_) {
      lines_.fail("nodes of a second *PART: only files with one part are read; merge the parts");
    }
    part_of_nodes_ = parts_;
    block_ = Block::Nodes;
    set_ = keyword.has("NSET") ? &sets_.set(AbaqusSets::Of::Nodes, "", keyword.value("NSET"), true) : nullptr;
  }

  void begin_elements(const Keyword& keyword) {
    if (of_the_assembly()) return;
    if (keyword.has("INPUT")) lines_.fail("*ELEMENT, INPUT=: files in several parts are not read; put all into one");
    const std::string type = keyword_words(keyword.value("TYPE"));
    if (type.empty()) lines_.fail("*ELEMENT without TYPE=");
    type_ = abaqus_type(type);
    if (type_.higher_order) {
      lines_.fail(fmt::format("elements of type {} have nodes beyond their corners: only linear elements are read", quote_token(type)));
    }
    const auto known = std::ranges::find(types_, type);
    origin_ = static_cast<std::uint32_t>(known - types_.begin());
    if (known == types_.end()) types_.push_back(type);
    block_ = Block::Elements;
    set_ = keyword.has("ELSET") ? &sets_.set(AbaqusSets::Of::Elements, "", keyword.value("ELSET"), true) : nullptr;
  }

  void begin_set(const Keyword& keyword) {
    const bool of_nodes = keyword.name == "NSET";
    const std::string_view name = keyword.value(keyword.name);
    if (name.empty()) lines_.fail(fmt::format("*{} without {}=", keyword.name, keyword.name));
    if (!keyword.has("INSTANCE") && of_the_assembly()) return;
    if (keyword.has("ELSET") && of_nodes) return say_other("NSET");  // a set of the elements' nodes
    of_ = of_nodes ? AbaqusSets::Of::Nodes : AbaqusSets::Of::Elements;
    set_ = &sets_.set(of_, scope_, name, !keyword.has("INTERNAL"));
    generate_ = keyword.has("GENERATE");
    block_ = of_nodes ? Block::NodeSet : Block::ElementSet;
  }

  void begin_surface(const Keyword& keyword) {
    const std::string type = keyword_words(keyword.value("TYPE"));
    if (keyword.value("NAME").empty() || (!type.empty() && type != "ELEMENT" && type != "NODE") || keyword.has("COMBINE")) {
      return say_other("SURFACE");
    }
    const std::string_view name = unquoted(keyword.value("NAME"));
    surface_ = &sets_.add_surface(std::string(name), type == "NODE");
    block_ = Block::Surface;
  }

  void data() {
    if (!begun_) lines_.fail("expected a keyword such as *NODE (the .inp files of AVS are another format, which is not read)");
    if (lines_.fields().empty()) return;
    switch (block_) {
      case Block::Heading:
        if (mesh_.title.empty()) mesh_.title = trimmed(lines_.line());
        return;
      case Block::Nodes:
        return node();
      case Block::Elements:
        return element();
      case Block::NodeSet:
      case Block::ElementSet:
        return members();
      case Block::Surface:
        return side();
      case Block::Instance:
        return source_.add_only_in_file("the place of its instance in the assembly");
      case Block::Other:
        return;
    }
  }

  void node() {
    const auto fields = lines_.fields();
    const std::int32_t number = lines_.label(fields[0], "the number of a node");
    if (fields.size() < 3) lines_.fail(fmt::format("node {} has no y coordinate", number));
    const std::size_t coordinates = std::min<std::size_t>(fields.size() - 1, 3);
    for (std::size_t k = 1; k <= coordinates; ++k) {
      if (fields[k].empty()) lines_.fail(fmt::format("a coordinate of node {} is left out", number));
    }
    if (fields.size() > 4) source_.add_only_in_file("the normals at its nodes");
    if (coordinates_ != 0 && coordinates_ != coordinates) source_.set_not_patchable("some of its nodes leave z out");
    coordinates_ = std::max(coordinates_, coordinates);
    Vec3 p;
    p.x = lines_.real(fields[1], "x coordinate");
    p.y = lines_.real(fields[2], "y coordinate");
    if (coordinates == 3) p.z = lines_.real(fields[3], "z coordinate");
    numbered_.add_node(number, p, lines_.offset_of(fields[1]));
    if (set_ != nullptr) set_->add(number);
  }

  /// Reads an element, which may continue over several lines.
  void element() {
    auto fields = lines_.fields();
    if (!element_) {
      element_ = lines_.label(fields[0], "the number of an element");
      element_begin_ = lines_.begin();
      nodes_.clear();
      fields = fields.subspan(1);
    }
    for (const std::string_view field : fields) nodes_.push_back(lines_.label(field, "the number of a node"));
    if (!type_.shape) {
      if (!lines_.ends_with_comma()) end_other_element();
      return;
    }
    const Index corners = corners_of(*type_.shape);
    if (nodes_.size() > corners) lines_.fail(wrong_count());
    if (nodes_.size() == corners) add_element(*type_.shape);
  }

  [[nodiscard]] std::string wrong_count() const {
    return fmt::format("element {} has {} nodes, but a {} has {}", *element_, nodes_.size(), quote_token(types_[origin_]),
                       type_.shape ? corners_of(*type_.shape) : 0);
  }

  void add_element(CellShape shape) {
    numbered_.add_cell(*element_, shape, nodes_, origin_, element_begin_);
    if (set_ != nullptr) set_->add(*element_);
    element_.reset();
  }

  /// Ends an element of another type: masses are points, trusses and beams lines; others that are no triangle, quadrilateral or volume
  /// element are skipped.
  void end_other_element() {
    if (nodes_.size() == 1) return add_element(CellShape::Point);
    if (nodes_.size() == 2) return add_element(CellShape::Line);
    element_.reset();
    if (passed_over_ == types_[origin_]) return;
    passed_over_ = types_[origin_];
    source_.add_only_in_file("elements of other types");
    source_.add_note(fmt::format("Elements of type {} are not shown.", quote_token(passed_over_)));
  }

  void end_block() {
    if (block_ == Block::Elements && element_) {
      if (type_.shape) lines_.fail_at(element_begin_, wrong_count());
      end_other_element();
    }
    if (block_ == Block::NodeSet || block_ == Block::ElementSet) set_->tidy();
    block_ = Block::Other;
  }

  void members() {
    const auto fields = lines_.fields();
    if (generate_) {
      if (fields.size() < 2 || fields.size() > 3) lines_.fail("expected the first and last number of a set, and perhaps a step");
      const AbaqusSet::Range range{lines_.label(fields[0], "the first number"), lines_.label(fields[1], "the last number"),
                                   fields.size() == 3 ? lines_.label(fields[2], "the step") : 1};
      if (range.last < range.first) lines_.fail(fmt::format("the last number, {}, is below the first, {}", range.last, range.first));
      return set_->add(range);
    }
    for (const std::string_view field : fields) {
      if (!field.empty()) add_member(*set_, of_, field);
    }
  }

  /// Adds a number, or the members of the set with this name.
  void add_member(AbaqusSet& set, AbaqusSets::Of of, std::string_view field) {
    if (is_number(field)) return set.add(lines_.label(field, "the number of a member"));
    if (const AbaqusSet* other = sets_.find(of, scope_, field)) return set.add(*other);
    const std::size_t dot = field.rfind('.');  // name such as Part-1-1.7
    if (dot != std::string_view::npos && is_number(field.substr(dot + 1))) {
      return set.add(lines_.label(field.substr(dot + 1), "the number of a member"));
    }
    lines_.fail(fmt::format("there is no set {} before this", quote_token(field)));
  }

  void side() {
    const auto fields = lines_.fields();
    AbaqusSets::SurfaceItem item;
    if (fields[0].empty()) return source_.add_only_in_file("surfaces of all free sides");
    add_member(item.set, surface_->of_nodes ? AbaqusSets::Of::Nodes : AbaqusSets::Of::Elements, fields[0]);
    if (fields.size() > 1) item.side = keyword_words(fields[1]);
    surface_->items.push_back(std::move(item));
  }

  void finish() {
    source_.set_layout({.components = coordinates_ == 2 ? 2 : 3, .syntax = kAbaqusSyntax, .width = kAbaqusNumber});
    numbered_.finish(mesh_);
    const std::vector<OriginLabels> unlabelled(types_.size(), OriginLabels{{}, false});
    const std::vector<Index> rows = split_cells(numbered_.cells(), unlabelled, mesh_, source_);
    sets_.add_groups(numbered_, elements_of_cells(numbered_.cells(), mesh_, rows), types_, mesh_, source_);
  }

  SourceFile& source_;
  DataLines lines_;
  NumberedMesh numbered_;
  AbaqusSets sets_;
  Mesh mesh_;
  bool begun_ = false;  // whether there was a keyword
  Block block_ = Block::Other;
  std::string scope_;  // "ASSEMBLY" within the assembly
  int parts_ = 0, part_of_nodes_ = 0, instances_ = 0;
  bool in_instance_ = false;
  std::size_t coordinates_ = 0;  // coordinates of a node: 2 or 3
  std::vector<std::string> types_, other_;
  std::string passed_over_;
  // --- State of the present block ---
  AbaqusSet* set_ = nullptr;
  AbaqusSets::Of of_ = AbaqusSets::Of::Nodes;
  bool generate_ = false;
  AbaqusSets::Surface* surface_ = nullptr;
  AbaqusType type_;
  std::uint32_t origin_ = 0;
  std::optional<std::int32_t> element_;  // number of the present element
  std::size_t element_begin_ = 0;
  std::vector<std::int32_t> nodes_;
};

/// Whether the first keyword is one that Abaqus' files begin with.
bool recognises_abaqus(std::string_view bytes) {
  constexpr std::array<std::string_view, 7> kFirst{"HEADING", "NODE", "PART", "PREPRINT", "ELEMENT", "NSET", "INCLUDE"};
  while (!bytes.empty()) {
    const std::string_view line = trimmed(take_line(bytes));
    if (!line.empty() && !line.starts_with("**")) {
      if (!line.starts_with('*')) return false;
      const std::string name = keyword_words(line.substr(1, line.find(',') - 1));
      return std::ranges::find(kFirst, name) != kFirst.end();
    }
  }
  return false;
}

}  // namespace

AbaqusType abaqus_type(std::string_view name) {
  const auto nodes = [&](std::string_view prefix) {
    const std::string_view rest = name.starts_with(prefix) ? name.substr(prefix.size()) : std::string_view();
    return rest.substr(0, rest.find_first_not_of("0123456789"));
  };
  for (const std::string_view prefix : words_of(kSolids)) {
    const std::string_view digits = nodes(prefix);
    if (digits.empty()) continue;
    if (digits == "4") return {CellShape::Tetrahedron};
    if (digits == "5") return {CellShape::Pyramid};
    if (digits == "6") return {CellShape::Wedge};
    if (digits == "8") return {CellShape::Hexahedron};
    return {{}, true};
  }
  for (const std::string_view prefix : words_of(kPlanar)) {
    const std::string_view digits = nodes(prefix);
    if (digits.empty()) continue;
    if (digits == "3") return {CellShape::Triangle};
    if (digits == "4") return {CellShape::Quadrilateral};
    return {{}, true};
  }
  return {};
}

constinit const FormatHandler kAbaqusFormat{
    .info = {"abaqus", "Abaqus", ".inp", "2D and 3D elements, node sets, element sets, surfaces; files of one part; also CalculiX's"},
    .recognises = recognises_abaqus,
    .read = read_with<AbaqusReader>,
    .write = write_abaqus};

}  // namespace dmoscope
