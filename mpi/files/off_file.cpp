// Reads and writes OFF in ASCII by many ranks.

#include <array>

#include <fmt/format.h>

#include "core/io/polygons/off.h"
#include "mpi/files/text_mesh_file.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kOffSyntax{.comment = '#'};

class OffFile final : public TextMeshFile {
 public:
  OffFile(const World& world, const std::filesystem::path& path) : TextMeshFile(world, path, {.syntax = kOffSyntax}) {}

  MeshBlock read(const FieldFilter& /*filter*/) override {
    const RangeFile& file = open();
    world().together([&] { read_head(file); });
    const LineBlock mine = lines(file);
    const Ranges data = world().ranges(count_data_lines(mine.text, kOffSyntax.comment));
    close();
    first_ = data.begin(world().rank());
    world().together([&] {
      if (data.size() < vertices_ + faces_)
        throw InputError(name(), 0, fmt::format("the file ends before its {} vertices and {} faces", vertices_, faces_));
    });
    MeshBlock block;
    world().together([&] { parse(mine, block); });
    block.vertices = world().ranges(block.positions.size());
    block.elements = world().ranges(block.kinds.size());
    require_counts(block, vertices_, faces_);
    return block;
  }

 private:
  [[nodiscard]] LineBlock lines(const RangeFile& file) const override { return read_lines(world(), file, body_, false); }

  void read_head(const RangeFile& file) {
    with_tokens(file.read(0, kLongestHead), 1, [&](Tokenizer& tokens) {
      static_cast<void>(read_off_word(tokens));
      const std::size_t after_word = tokens.offset(), line = tokens.line();
      if (tokens.token_on_line() == "BINARY") tokens.fail("several ranks read OFF files in ASCII alone");
      tokens.seek(after_word, line);
      for (auto [what, number] : {std::pair{"number of vertices", &vertices_}, {"number of faces", &faces_}}) {
        if (tokens.at_end()) tokens.fail_at_end(what);
        *number = read_count(tokens, what);
      }
      tokens.end_line();
      body_ = tokens.offset();
    });
  }

  /// Visits the rank's lines with tokens by their numbers among all such lines: vertices, then faces.
  template <class Vertex, class Face>
  void each_line(const LineBlock& lines, const Vertex& vertex, const Face& face) const {
    with_tokens(lines.text, lines.first_line, [&](Tokenizer& tokens) {
      for (std::uint64_t i = first_; i < vertices_ + faces_ && !tokens.at_end(); ++i) {
        if (i < vertices_)
          vertex(tokens);
        else if (!face(tokens))
          return;
      }
    });
  }

  void parse(const LineBlock& lines, MeshBlock& block) const {
    bool extras = false;
    std::size_t place = 0;
    std::array<Index, 4> own{};
    each_line(
        lines, [&](Tokenizer& tokens) { block.positions.push_back(read_off_vertex(tokens, place, extras)); },
        [&](Tokenizer& tokens) {
          const auto corners = read_off_face(tokens, vertices_, own, extras);
          block.kinds.push_back(corners.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral);
          block.corners.insert(block.corners.end(), corners.begin(), corners.end());
          return true;
        });
  }
  void vertices(const LineBlock& lines, VertexLines& found) const override {
    bool extras = false;
    each_line(
        lines,
        [&](Tokenizer& tokens) {
          std::size_t place = 0;
          found.positions.push_back(read_off_vertex(tokens, place, extras));
          found.places.push_back(place);
        },
        [](Tokenizer&) { return false; });
  }

  std::uint64_t vertices_ = 0, faces_ = 0;
  std::uint64_t body_ = 0;   // start of the lines of vertices
  std::uint64_t first_ = 0;  // number of the rank's first line among those after the head
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared_off(const World& world, const std::filesystem::path& path) {
  return std::make_unique<OffFile>(world, path);
}

}  // namespace dmoscope
