// Reads and writes OFF in ASCII by many ranks.

#include <array>

#include <fmt/format.h>

#include "core/io/polygons/off.h"
#include "mpi/files/text_mesh_file.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kOffSyntax{.comment = '#'};

class OffFile final : public CountedMeshFile {
 public:
  OffFile(const World& world, const std::filesystem::path& path) : CountedMeshFile(world, path, {.syntax = kOffSyntax}) {}

  MeshBlock read(const FieldFilter& /*filter*/) override {
    const LineBlock mine = read_body("faces");
    close();
    VertexLines found;
    std::vector<ElementKind> kinds;
    std::vector<WholeIndex> corners;
    std::array<Index, 4> own{};
    bool extras = false;
    world().together([&] {
      each_line(mine, [&](Tokenizer& tokens, std::uint64_t line) {
        if (line >= vertices_ + elements_) return false;
        if (line < vertices_) return add_vertex(tokens, found);
        const auto face = read_off_face(tokens, vertices_, own, extras);
        kinds.push_back(face.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral);
        corners.insert(corners.end(), face.begin(), face.end());
        return true;
      });
    });
    MeshBlock block = block_of(std::move(found.positions), std::move(kinds));
    block.corners = std::move(corners);
    return block;
  }

 private:
  void read_head(Tokenizer& tokens, std::uint64_t& vertices, std::uint64_t& faces) override {
    static_cast<void>(read_off_word(tokens));
    const std::size_t after_word = tokens.offset(), line = tokens.line();
    if (tokens.token_on_line() == "BINARY") tokens.fail("several ranks read OFF files in ASCII alone");
    tokens.seek(after_word, line);
    for (auto [what, number] : {std::pair{"number of vertices", &vertices}, {"number of faces", &faces}}) {
      if (tokens.at_end()) tokens.fail_at_end(what);
      *number = read_count(tokens, what);
    }
    tokens.end_line();
  }
  void vertices(const LineBlock& lines, VertexLines& found) const override {
    each_line(lines, [&](Tokenizer& tokens, std::uint64_t line) { return line < vertices_ && add_vertex(tokens, found); });
  }
  static bool add_vertex(Tokenizer& tokens, VertexLines& found) {
    bool extras = false;
    std::size_t place = 0;
    found.positions.push_back(read_off_vertex(tokens, place, extras));
    found.places.push_back(place);
    return true;
  }
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared_off(const World& world, const std::filesystem::path& path) {
  return std::make_unique<OffFile>(world, path);
}

}  // namespace dmoscope
