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
#include "core/io/numbered_mesh.h"

namespace dmoscope {

namespace {

constexpr std::size_t kField = 8;  // width in columns

char capital(char c) noexcept { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// The text before the first comma, or in the first field's columns.
std::string_view first_field(std::string_view line) {
  const std::size_t comma = line.find(',');
  return trimmed(line.substr(0, comma != std::string_view::npos ? comma : std::min(kField, line.find('\t'))));
}

bool goes_on(std::string_view line) {
  const std::string_view first = first_field(line);
  return first.empty() || first.front() == '+' || first.front() == '*';
}

}  // namespace

void NastranCards::seek(std::size_t offset, std::size_t line) {
  lines_.seek(offset, line);
  held_ = false;
}

bool NastranCards::next_line() {
  while (lines_.next()) {
    line_ = lines_.line().substr(0, lines_.line().find('$'));
    if (!trimmed(line_).empty()) {
      line_begin_ = lines_.begin();
      return true;
    }
    if (line_.size() != lines_.line().size() && on_comment) on_comment(lines_.line());
    passed_over_ = true;
  }
  return false;
}

bool NastranCards::next() {
  if (!held_ && !next_line()) return false;
  held_ = false;
  begin_ = line_begin_;
  end_ = lines_.end();
  number_ = lines_.number();
  interrupted_ = false;
  fields_.clear();
  expanded_.clear();
  name_.clear();
  if (goes_on(line_)) lines_.fail("a line that goes on with a card, but there is none before it");
  for (const char c : first_field(line_)) name_ += capital(c);
  const std::size_t star = name_.find('*');
  if (star != std::string::npos && star + 1 != name_.size()) lines_.fail("repeated cards (*) are not read: write every card out");
  while (name_.ends_with('*') || name_.ends_with(' ')) name_.pop_back();
  if (name_.empty() || name_.front() < 'A' || name_.front() > 'Z') {
    lines_.fail(fmt::format("expected a card such as GRID, got {}", quote_token(trimmed(line_))));
  }
  if (name_ == "ENDDATA") return false;
  take_line(line_);
  passed_over_ = false;
  while (next_line()) {
    if (!goes_on(line_)) {
      held_ = true;
      break;
    }
    interrupted_ = interrupted_ || passed_over_;
    take_line(line_);
    end_ = lines_.end();
  }
  return true;
}

void NastranCards::take_line(std::string_view line) {
  if (line.find('\t') != std::string_view::npos && line.find(',') == std::string_view::npos) {
    std::string& wide = expanded_.emplace_back();
    for (const char c : line) wide.append(c == '\t' ? kField - wide.size() % kField : 1, c == '\t' ? ' ' : c);
    line = wide;
  }
  const std::string_view first = first_field(line);
  const bool large = first.starts_with('*') || first.ends_with('*');
  const std::size_t count = large ? 4 : 8;
  const std::size_t whole = (fields_.size() + count - 1) / count * count;
  fields_.resize(whole);
  const std::size_t before = fields_.size();
  if (line.find(',') != std::string_view::npos) {
    line.remove_prefix(line.find(',') + 1);
    for (std::size_t n = 0;; ++n) {
      const std::size_t comma = line.find(',');
      const std::string_view field = trimmed(line.substr(0, comma));
      if (n < count) {
        fields_.push_back(field);
      } else if (n > count || !(field.empty() || field.front() == '+' || field.front() == '*')) {
        lines_.fail(fmt::format("a line of a card has {} fields at most", count));
      }
      if (comma == std::string_view::npos) break;
      line.remove_prefix(comma + 1);
    }
  } else {
    const std::size_t width = large ? 2 * kField : kField;
    for (std::size_t n = 0; n < count && kField + n * width < line.size(); ++n) {
      fields_.push_back(trimmed(line.substr(kField + n * width, width)));
    }
  }
  fields_.resize(before + count);
}

double NastranCards::real(std::size_t n, std::string_view what) const {
  const std::string_view text = field(n);
  if (text.empty()) return 0.0;
  std::string number;
  for (const char c : text) {
    const bool exponent = (c == '+' || c == '-') && !number.empty() && number.back() != 'E';
    if (exponent) number += 'E';
    number += capital(c) == 'D' ? 'E' : capital(c);
  }
  try {
    return lines_.real(number, what);
  } catch (const InputError&) {
    fail(fmt::format("expected {}, got {}", what, quote_token(text)));
  }
}

std::int32_t NastranCards::label(std::size_t n, std::string_view what) const {
  if (field(n).empty()) fail(fmt::format("a {} without {}", name_, what));
  try {
    return lines_.label(field(n), what);
  } catch (const InputError&) {
    fail(fmt::format("expected {}, got {}", what, quote_token(field(n))));
  }
}

int NastranCards::number_or_zero(std::size_t n, std::string_view what) const {
  return field(n).empty() || field(n) == "0" ? 0 : label(n, what);
}

void NastranCards::fail(const std::string& what) const { lines_.fail_on(number_, what); }

namespace {

/// Cards of elements of one shape.
struct CellCards {
  std::string_view names;
  std::optional<CellShape> shape;  // none: elements of higher order
  bool have_property = true;
};
constexpr std::array kCellCards{
    CellCards{"CTRIA3 CTRIAR CTRAX3 CPLSTN3 CPLSTS3", CellShape::Triangle},
    CellCards{"CQUAD4 CQUADR CSHEAR CQUADX4 CPLSTN4 CPLSTS4", CellShape::Quadrilateral},
    CellCards{"CTETRA", CellShape::Tetrahedron},
    CellCards{"CPYRAM CPYRA", CellShape::Pyramid},
    CellCards{"CPENTA", CellShape::Wedge},
    CellCards{"CHEXA", CellShape::Hexahedron},
    CellCards{"CROD CTUBE CBAR CBEAM", CellShape::Line},
    CellCards{"CONROD PLOTEL", CellShape::Line, false},
    CellCards{"CTRIA6 CQUAD8 CQUAD CTRIAX6 CTRAX6 CQUADX CQUADX8 CTRIAX CPLSTN6 CPLSTN8 CPLSTS6 CPLSTS8", std::nullopt}};

bool begins_bulk(std::string_view line) {
  const std::string words = in_capitals(trimmed(line.substr(0, 80)));
  return words.starts_with("BEGIN") && words.find("BULK") != std::string::npos;
}

/// Reader, see FormatHandler. Free, small and large fields. Throws InputError, Cancelled.
class NastranReader {
 public:
  NastranReader(SourceFile& source, const IoContext& context)
      : source_(source), progress_(context.progress), cards_(source, context.progress), numbered_(source) {}

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
      if (title.empty() && equals != std::string_view::npos && in_capitals(trimmed(line.substr(0, equals))) == "TITLE") {
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
    for (const CellCards& cards : kCellCards)
      if (any_word(cards.names, [&](std::string_view one) { return one == name; })) return cell(cards);
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

  void cell(const CellCards& cards) {
    constexpr std::string_view kLinear = "only elements without nodes beyond their corners are read";
    const std::string& card = cards_.name();
    if (!cards.shape) cards_.fail(fmt::format("{} is an element of higher order: {}", card, kLinear));
    const std::int32_t number = cards_.label(0, "the number of an element");
    const std::size_t first = cards.have_property ? 2 : 1;
    const int property = cards.have_property ? cards_.number_or_zero(1, "the number of a property") : 0;
    std::array<std::int32_t, 8> nodes{};
    const std::span<std::int32_t> used(nodes.data(), corners_of(*cards.shape));
    for (std::size_t k = 0; k < used.size(); ++k) used[k] = cards_.label(first + k, "the number of a node");
    if (dimension_of(*cards.shape) == 3) {
      for (std::size_t k = first + used.size(); k < cards_.field_count(); ++k) {
        if (!cards_.field(k).empty()) cards_.fail(fmt::format("{} {} has more than {} nodes: {}", card, number, used.size(), kLinear));
      }
    }
    numbered_.add_cell(number, *cards.shape, used, origin_of(property, card), cards_.begin());
  }

  std::uint32_t origin_of(int property, std::string_view name) {
    const std::string type(property == 0 ? name : std::string_view());
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
  std::map<std::pair<int, std::string>, std::uint32_t> origins_;  // origins by property, or else by the card's name
  std::map<int, std::string> names_;                              // names of the properties
  std::vector<std::string> other_;
};

/// Whether there is a line BEGIN BULK, or the first card is one that only Nastran has.
bool recognises_nastran(std::string_view bytes) {
  constexpr std::size_t kLook = 65536;
  bytes = bytes.substr(0, kLook);
  bool first = true;
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    if (begins_bulk(line)) return true;
    const std::string_view words = trimmed(line);
    if (first && !words.empty() && words.front() != '$') {
      first = false;
      const std::string card = in_capitals(trimmed(line.substr(0, 8)));
      const std::string_view number = trimmed(line.substr(std::min<std::size_t>(line.size(), 8), 8));
      if (card.starts_with("GRID,") || card.starts_with("GRID*,")) return true;
      // Requires a number behind GRID: a single word may be any file's title.
      if (card == "GRID" || card == "GRID*") return !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
    }
  }
  return false;
}

}  // namespace

constinit const FormatHandler kNastranFormat{
    .info = {"nastran", "Nastran", ".bdf .nas .dat",
             "2D and 3D elements and their properties; free, small and large fields; made anew: large"},
    .recognises = recognises_nastran,
    .read = read_with<NastranReader>,
    .write = write_nastran,
    .patch = patch_nastran};

}  // namespace dmoscope
