// Reader of Nastran's bulk data: GRID cards and elements of first order; properties become groups.

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/nastran/nastran.h"
#include "core/io/nastran/nastran_cards.h"
#include "core/io/numbered_mesh.h"

namespace dmoscope {
namespace {

struct CellCard {
  std::string_view name;
  std::optional<CellShape> shape;  // none: an element of higher order
  bool has_property = true;
};
constexpr std::array kCellCards{CellCard{"CTRIA3", CellShape::Triangle},
                                CellCard{"CTRIAR", CellShape::Triangle},
                                CellCard{"CTRAX3", CellShape::Triangle},
                                CellCard{"CPLSTN3", CellShape::Triangle},
                                CellCard{"CPLSTS3", CellShape::Triangle},
                                CellCard{"CQUAD4", CellShape::Quadrilateral},
                                CellCard{"CQUADR", CellShape::Quadrilateral},
                                CellCard{"CSHEAR", CellShape::Quadrilateral},
                                CellCard{"CQUADX4", CellShape::Quadrilateral},
                                CellCard{"CPLSTN4", CellShape::Quadrilateral},
                                CellCard{"CPLSTS4", CellShape::Quadrilateral},
                                CellCard{"CTETRA", CellShape::Tetrahedron},
                                CellCard{"CPYRAM", CellShape::Pyramid},
                                CellCard{"CPYRA", CellShape::Pyramid},
                                CellCard{"CPENTA", CellShape::Wedge},
                                CellCard{"CHEXA", CellShape::Hexahedron},
                                CellCard{"CROD", CellShape::Line},
                                CellCard{"CTUBE", CellShape::Line},
                                CellCard{"CBAR", CellShape::Line},
                                CellCard{"CBEAM", CellShape::Line},
                                CellCard{"CONROD", CellShape::Line, false},
                                CellCard{"PLOTEL", CellShape::Line, false},
                                CellCard{"CTRIA6", std::nullopt},
                                CellCard{"CQUAD8", std::nullopt},
                                CellCard{"CQUAD", std::nullopt},
                                CellCard{"CTRIAX6", std::nullopt},
                                CellCard{"CTRAX6", std::nullopt},
                                CellCard{"CQUADX", std::nullopt},
                                CellCard{"CQUADX8", std::nullopt},
                                CellCard{"CTRIAX", std::nullopt},
                                CellCard{"CPLSTN6", std::nullopt},
                                CellCard{"CPLSTN8", std::nullopt},
                                CellCard{"CPLSTS6", std::nullopt},
                                CellCard{"CPLSTS8", std::nullopt}};

std::string words_in_capitals(std::string_view text) {
  std::string result(trimmed(text));
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

bool begins_bulk(std::string_view line) {
  const std::string words = words_in_capitals(line.substr(0, 80));
  return words.starts_with("BEGIN") && words.find("BULK") != std::string::npos;
}

class NastranReader {
 public:
  NastranReader(SourceFile& source, Progress& progress)
      : source_(source), progress_(progress), cards_(source, progress), numbered_(source) {}

  Mesh read() {
    find_bulk();
    cards_.on_comment = [this](std::string_view line) { comment(line); };
    while (cards_.next()) card();
    finish();
    return std::move(mesh_);
  }

 private:
  /// Finds the begin of the bulk data: text before BEGIN BULK instructs the solver; included files have the bulk data alone.
  void find_bulk() {
    DataLines lines(source_, progress_);
    std::string title;
    while (lines.next()) {
      if (begins_bulk(lines.line())) {
        cards_.seek(lines.end(), lines.number() + 1);
        mesh_.title = title;
        source_.add_only_in_file("what stands before BEGIN BULK");
        return;
      }
      const std::string_view line = trimmed(lines.line());
      const std::size_t equals = line.find('=');
      if (title.empty() && equals != std::string_view::npos && words_in_capitals(line.substr(0, equals)) == "TITLE") {
        title = trimmed(line.substr(equals + 1));
      }
    }
  }

  /// Reads a comment by which HyperMesh and others name a property: $HMNAME PROP 5"wing".
  void comment(std::string_view line) {
    constexpr std::string_view kName = "$HMNAME PROP";
    source_.add_only_in_file("comments");
    if (!line.starts_with(kName)) return;
    line = trimmed(line.substr(kName.size()));
    int number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    const std::size_t open = line.find('"');
    const std::size_t close = line.find('"', open + 1);
    if (error != std::errc() || open == std::string_view::npos || close == std::string_view::npos) return;
    names_[number] = line.substr(open + 1, close - open - 1);
  }

  void card() {
    const std::string& name = cards_.name();
    if (name == "GRID") return node();
    const auto* const element = std::find_if(kCellCards.begin(), kCellCards.end(), [&](const CellCard& card) { return card.name == name; });
    if (element != kCellCards.end()) return cell(*element);
    if (name == "GRDSET" && cards_.number_or_zero(1, "a coordinate system") != 0) refuse_system("GRDSET");
    if (name.starts_with("INCLUDE")) cards_.fail("INCLUDE: files in several parts are not read; put all into one");
    say_other(name);
  }

  void say_other(const std::string& name) {
    constexpr std::size_t kNamed = 8;
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    if (other_.size() >= kNamed || name.find_first_not_of(kLetters) != std::string::npos) {
      source_.add_only_in_file("other cards");
    } else if (std::ranges::find(other_, name) == other_.end()) {
      other_.push_back(name);
      source_.add_only_in_file(name + " cards");
    }
  }

  [[noreturn]] void refuse_system(const std::string& who) const {
    cards_.fail(fmt::format("{} names a coordinate system: only nodes in the basic one (CP 0) are read", who));
  }

  void node() {
    const std::int32_t number = cards_.label(0, "the number of a node");
    if (cards_.number_or_zero(1, "a coordinate system") != 0) refuse_system(fmt::format("node {}", number));
    if (cards_.interrupted()) source_.set_not_patchable("comments stand inside its GRID cards");
    const Vec3 p{cards_.real(2, "x coordinate"), cards_.real(3, "y coordinate"), cards_.real(4, "z coordinate")};
    numbered_.add_node(number, p, cards_.begin());
  }

  void cell(const CellCard& card) {
    constexpr std::string_view kLinear = "only elements without nodes beyond their corners are read";
    if (!card.shape) cards_.fail(fmt::format("{} is an element of higher order: {}", card.name, kLinear));
    const std::int32_t number = cards_.label(0, "the number of an element");
    const std::size_t first = card.has_property ? 2 : 1;
    const int property = card.has_property ? cards_.number_or_zero(1, "the number of a property") : 0;
    std::array<std::int32_t, 8> nodes{};
    const std::span<std::int32_t> used(nodes.data(), corners_of(*card.shape));
    for (std::size_t k = 0; k < used.size(); ++k) used[k] = cards_.label(first + k, "the number of a node");
    if (dimension_of(*card.shape) == 3) {
      for (std::size_t k = first + used.size(); k < cards_.field_count(); ++k) {
        if (!cards_.field(k).empty()) cards_.fail(fmt::format("{} {} has more than {} nodes: {}", card.name, number, used.size(), kLinear));
      }
    }
    numbered_.add_cell(number, *card.shape, used, origin_of(property, card.name), cards_.begin());
  }

  std::uint32_t origin_of(int property, std::string_view name) {
    const std::string_view type = property == 0 ? name : std::string_view();
    const auto [at, added] = origins_.try_emplace({property, type}, static_cast<std::uint32_t>(labels_.size()));
    if (added && property == 0) labels_.push_back({{{std::string(name), "element type", 0}}, false});
    if (added && property != 0)
      labels_.push_back({{{fmt::format("property {}", property), std::string(kNastranProperty), property}}, true});
    return at->second;
  }

  void finish() {
    if (numbered_.node_count() == 0) {
      throw InputError(source_.path().string(), 0, "the file has no GRID card (it was taken for Nastran's bulk data)");
    }
    source_.set_layout({.syntax = {}, .width = kNastranNumber});
    numbered_.finish(mesh_);
    for (OriginLabels& labels : labels_) {
      const auto name = names_.find(labels.labels.front().code);
      if (labels.of_elements && name != names_.end()) labels.labels.front().name = name->second;
    }
    (void)split_cells(numbered_.cells(), labels_, mesh_, source_);
  }

  SourceFile& source_;
  Progress& progress_;
  NastranCards cards_;
  NumberedMesh numbered_;
  Mesh mesh_;
  std::vector<OriginLabels> labels_;
  std::map<std::pair<int, std::string_view>, std::uint32_t> origins_;  // origins by property, or else by the card's name
  std::map<int, std::string> names_;                                   // names of the properties
  std::vector<std::string> other_;
};

/// Whether there is a line BEGIN BULK, or the first card is one that only Nastran has.
bool recognises_nastran(std::string_view bytes) {
  constexpr std::size_t kLook = 65536;
  bytes = bytes.substr(0, kLook);
  bool first = true;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
    const std::string_view line = bytes.substr(0, end);
    if (begins_bulk(line)) return true;
    const std::string_view words = trimmed(line);
    if (first && !words.empty() && words.front() != '$') {
      first = false;
      const std::string card = words_in_capitals(line.substr(0, 8));
      const std::string_view number = trimmed(line.substr(std::min<std::size_t>(line.size(), 8), 8));
      if (card.starts_with("GRID,") || card.starts_with("GRID*,")) return true;
      // Requires a number behind GRID: a single word may be any file's title.
      if (card == "GRID" || card == "GRID*") return !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
    }
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return false;
}

}  // namespace

Mesh read_nastran(SourceFile& source, const IoContext& context) { return NastranReader(source, context.progress).read(); }

const FormatHandler& nastran_format() {
  static const FormatHandler handler{
      {"nastran", "Nastran", ".bdf .nas .dat", "2D and 3D elements and their properties; free, small and large fields; made anew: large"},
      recognises_nastran,
      read_nastran,
      write_nastran,
      patch_nastran};
  return handler;
}

}  // namespace dmoscope
