#include "core/io/solvers/fort14_text.h"

#include <charconv>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace dmoscope {
namespace {

/// Columns behind the node number in a line of a land boundary, by IBTYPE: the node on a weir's other side, then heights and coefficients.
struct WeirColumns {
  bool pair = false;
  int numbers = 0;
};
WeirColumns weir_columns(int type) {
  switch (type) {
    case 3:
    case 13:
    case 23:
      return {false, 2};
    case 4:
    case 24:
      return {true, 3};
    case 5:
    case 25:
      return {true, 5};  // a sixth, the pipe's diameter, is missing in some files
    default:
      return {};
  }
}

class BoundaryReader {
 public:
  BoundaryReader(Tokenizer& tokens, const std::function<Index(Tokenizer&, std::string_view)>& number, SourceFile* source)
      : tokens_(tokens), number_(number), source_(source) {}

  /// Reads the boundaries; a file may end before them, or after the open ones.
  std::vector<Group> read() {
    constexpr std::size_t kShortestBoundary = 2;  // bytes of "0\n"
    if (tokens_.at_end()) return std::move(groups_);
    const std::size_t open = tokens_.read_count("number of open boundaries", kShortestBoundary);
    tokens_.end_line();
    read_total(open, "number of open boundary vertices");
    for (std::size_t b = 0; b < open; ++b) read_open(b);
    if (tokens_.at_end()) return std::move(groups_);
    const std::size_t land = tokens_.read_count("number of land boundaries", kShortestBoundary);
    tokens_.end_line();
    read_total(land, "number of land boundary vertices");
    for (std::size_t b = 0; b < land; ++b) read_land(b);
    if (tokens_.at_end()) return std::move(groups_);
    if (source_ == nullptr) return std::move(groups_);
    source_->add_note(fmt::format("The file goes on after its boundaries (line {}); the rest is kept but not read.", tokens_.line()));
    source_->add_only_in_file("what follows the boundaries");
    return std::move(groups_);
  }

 private:
  void begin_line(std::string_view what) {
    if (tokens_.at_end()) tokens_.fail_at_end(what);
  }

  /// Skips the sum over all boundaries: nothing depends on it, and it is often wrong. Some files end before it if there are no boundaries.
  void read_total(std::size_t boundaries, std::string_view what) {
    if (boundaries == 0 && tokens_.at_end()) return;
    begin_line(what);
    (void)tokens_.read_integer(what);
    tokens_.end_line();
  }

  std::size_t read_size() {
    begin_line("number of vertices of a boundary");
    return tokens_.read_count("number of vertices of a boundary", 2);
  }

  void read_open(std::size_t b) {
    Group group{.name = fmt::format("{} {}", kFort14Open, b + 1), .role = std::string(kFort14Open), .code = 0, .dimension = 0};
    const std::size_t size = read_size();
    const std::string_view type = tokens_.token_on_line();  // IBTYPEE may be missing, with a remark in its place
    int code = 0;
    if (const auto [end, error] = std::from_chars(type.data(), type.data() + type.size(), code);
        error == std::errc() && end == type.data() + type.size()) {
      group.code = code;
    }
    tokens_.end_line();
    group.members.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_line("vertex of an open boundary");
      group.members.push_back(number_(tokens_, "vertex index"));
      tokens_.end_numbers_of("a vertex of a boundary");
    }
    groups_.push_back(std::move(group));
  }

  void read_land(std::size_t b) {
    Group group{.name = fmt::format("{} {}", kFort14Land, b + 1), .role = std::string(kFort14Land), .code = 0, .dimension = 0};
    const std::size_t size = read_size();
    const std::int64_t type = tokens_.read_integer("type of a land boundary (IBTYPE)");
    if (type < -1000000 || type > 1000000) tokens_.fail(fmt::format("type of a land boundary (IBTYPE) out of range: {}", type));
    group.code = static_cast<int>(type);
    tokens_.end_line();
    const WeirColumns columns = weir_columns(group.code);
    if (is_fort14_weir(group.code) && source_ != nullptr)
      source_->add_only_in_file("heights, coefficients and pairs of vertices of the weirs");
    // Adds a group for the far bank of a weir: the file lists both banks in one string, the farther one beside the nearer.
    Group far_side{.name = group.name + ", far side", .role = group.role, .code = group.code, .dimension = 0};
    group.members.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_line("vertex of a land boundary");
      group.members.push_back(number_(tokens_, "vertex index"));
      if (columns.pair) far_side.members.push_back(number_(tokens_, "vertex index"));
      for (int n = 0; n < columns.numbers; ++n) (void)tokens_.read_double("height or coefficient of a weir");
      tokens_.end_line();
    }
    groups_.push_back(std::move(group));
    if (columns.pair) groups_.push_back(std::move(far_side));
  }

  Tokenizer& tokens_;
  const std::function<Index(Tokenizer&, std::string_view)>& number_;
  SourceFile* source_;
  std::vector<Group> groups_;
};

}  // namespace

Fort14Head read_fort14_head(Tokenizer& tokens) {
  constexpr std::size_t kShortestElement = 10;  // bytes of "1 3 1 2 3\n"
  constexpr std::size_t kShortestNode = 8;      // bytes of "1 0 0 0\n"
  Fort14Head head;
  head.title = trimmed(tokens.rest_of_line());
  if (tokens.at_end()) tokens.fail_at_end("number of elements");
  head.elements = tokens.read_count("number of elements", kShortestElement);
  head.nodes = tokens.read_count("number of vertices", kShortestNode);
  tokens.end_line();
  return head;
}

Fort14Node read_fort14_node(Tokenizer& tokens) {
  if (tokens.at_end()) tokens.fail_at_end("number of a vertex");
  Fort14Node node;
  node.number = tokens.read_integer("number of a vertex");
  const std::string_view x = tokens.read_token("x coordinate");
  node.place = tokens.offset_of(x);
  node.position.x = tokens.parse_double(x, "x coordinate");
  node.position.y = tokens.read_double("y coordinate");
  node.depth = tokens.read_double("depth");
  tokens.end_numbers_of("a vertex");
  return node;
}

std::size_t read_fort14_element(Tokenizer& tokens) {
  if (tokens.at_end()) tokens.fail_at_end("number of an element");
  (void)tokens.read_integer("number of an element");
  const std::int64_t corners = tokens.read_integer("number of corners");
  if (corners != 3 && corners != 4)
    tokens.fail(fmt::format("element with {} corners: only triangles and quadrilaterals are read", corners));
  return static_cast<std::size_t>(corners);
}

bool is_fort14_weir(int type) { return weir_columns(type).numbers > 0; }

std::vector<Group> read_fort14_boundaries(Tokenizer& tokens, const std::function<Index(Tokenizer&, std::string_view)>& number,
                                          SourceFile* source) {
  return BoundaryReader(tokens, number, source).read();
}

}  // namespace dmoscope
