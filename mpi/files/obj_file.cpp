// Reads and writes Wavefront OBJ by many ranks.

#include <array>

#include <fmt/format.h>

#include "core/io/polygons/obj.h"
#include "mpi/files/text_mesh_file.h"

namespace dmoscope {
namespace {

class ObjFile final : public TextMeshFile {
 public:
  ObjFile(const World& world, const std::filesystem::path& path) : TextMeshFile(world, path, {.syntax = kObjSyntax}) {}

  MeshBlock read(const FieldFilter& /*filter*/) override {
    const LineBlock mine = lines(open());
    Parsed parsed;
    world().together([&] { parsed = parse(mine); });
    close();
    MeshBlock block;
    block.vertices = world().ranges(parsed.positions.size());
    block.elements = world().ranges(parsed.kinds.size());
    block.positions = std::move(parsed.positions);
    block.positions.shrink_to_fit();
    block.kinds = std::move(parsed.kinds);
    world().together([&] { block.corners = corners(mine, parsed, block); });
    return block;
  }

 private:
  struct Parsed {
    std::vector<Vec3> positions;
    std::vector<ElementKind> kinds;
    std::vector<std::int64_t> corners;   // numbers of the file; backward ones from the first vertex here: -1 is the one before it
    std::vector<std::uint8_t> relative;  // one per corner: 1 if it counts backward
  };

  [[nodiscard]] LineBlock lines(const RangeFile& file) const override { return read_lines(world(), file, 0, true); }
  void vertices(const LineBlock& lines, VertexLines& found) const override {
    each_statement(lines, [&](Tokenizer& tokens, std::string_view word) {
      if (word != "v") return;
      std::size_t place = 0;
      found.positions.push_back(tokens.read_point(3, place));
      found.places.push_back(place);
    });
  }

  template <class Visit>
  void each_statement(const LineBlock& lines, const Visit& visit) const {
    with_tokens(lines.text, lines.first_line, [&](Tokenizer& tokens) {
      while (!tokens.at_end()) {
        visit(tokens, tokens.token_on_line());
        tokens.end_line();
      }
    });
  }

  [[nodiscard]] Parsed parse(const LineBlock& lines) const {
    Parsed parsed;
    each_statement(lines, [&](Tokenizer& tokens, std::string_view word) {
      if (word == "v") {
        std::size_t place = 0;
        parsed.positions.push_back(tokens.read_point(3, place));
      } else if (word == "f") {
        std::array<std::int64_t, 4> named{};
        const std::size_t count = read_obj_face(tokens, named);
        parsed.kinds.push_back(count == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral);
        for (std::size_t i = 0; i < count; ++i) {
          const bool back = named[i] < 0;
          parsed.corners.push_back(back ? static_cast<std::int64_t>(parsed.positions.size()) + named[i] : named[i] - 1);
          parsed.relative.push_back(back ? 1 : 0);
        }
      }
    });
    return parsed;
  }

  [[nodiscard]] std::vector<WholeIndex> corners(const LineBlock& lines, const Parsed& parsed, const MeshBlock& block) const {
    std::vector<WholeIndex> found;
    found.reserve(parsed.corners.size());
    const auto first = static_cast<std::int64_t>(block.vertices.begin(world().rank()));
    const auto count = static_cast<std::int64_t>(block.vertices.size());
    for (std::size_t i = 0; i < parsed.corners.size(); ++i) {
      const std::int64_t corner = parsed.corners[i] + (parsed.relative[i] != 0 ? first : 0);
      if (corner < 0 || corner >= count) fail_at_corner(lines, i, corner, count);
      found.push_back(static_cast<WholeIndex>(corner));
    }
    return found;
  }

  [[noreturn]] void fail_at_corner(const LineBlock& lines, std::size_t wrong, std::int64_t corner, std::int64_t count) const {
    std::size_t seen = 0;
    each_statement(lines, [&](Tokenizer& tokens, std::string_view word) {
      if (word != "f") return;
      std::array<std::int64_t, 4> named{};
      seen += read_obj_face(tokens, named);
      if (seen > wrong) tokens.fail(fmt::format("vertex index {} out of range (the file has {} vertices)", corner + 1, count));
    });
    throw InputError(name(), 0, "a vertex index is out of range");
  }
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared_obj(const World& world, const std::filesystem::path& path) {
  return std::make_unique<ObjFile>(world, path);
}

}  // namespace dmoscope
