#include "mpi/files/text_mesh_file.h"

#include <algorithm>

#include "core/io/writing/patch_writer.h"

namespace dmoscope {

const RangeFile& TextMeshFile::open() {
  world_.together([&] { file_.emplace(path_); });
  stamp_ = file_->stamp();
  return *file_;
}

std::vector<std::string> TextMeshFile::write(const std::filesystem::path& target, std::span<const Vec3> positions) {
  const std::int64_t read = stamp_;
  const RangeFile& file = open();
  world_.together([&] { file.require_unchanged(read); });
  LineBlock mine = lines(file);
  TextBuffer out(mine.text.size() + 8 * positions.size());  // longer numbers may replace short ones
  const std::uint64_t offset = mine.offset;
  world_.together([&] {
    VertexLines before;
    before.positions.reserve(positions.size());
    before.places.reserve(positions.size());
    vertices(mine, before);
    if (before.positions.size() != positions.size()) throw InputError(name(), 0, "the file has changed while it was smoothed");
    SourceFile source(path_, FileBytes(mine.text));
    std::string().swap(mine.text);
    source.set_layout(layout_);
    source.add_places(before.places);
    patch_part(out, target.string(), source, before.positions, positions);
  });
  // Starts with the head: the text before the first line that was dealt out.
  std::uint64_t head = offset;
  world_.broadcast(head, 0);
  const Ranges sizes = world_.ranges(out.text().size());
  SharedOutput output(world_, target, head + sizes.size());
  world_.together([&] {
    if (world_.is_first()) output.write(0, file.read(0, head));
    output.write(head + sizes.begin(world_.rank()), out.text());
  });
  close();
  return output.commit();
}

namespace {

/// Counts lines that hold more than blanks and a comment.
std::uint64_t count_data_lines(std::string_view text, char comment) {
  std::uint64_t count = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t first = text.find_first_not_of(" \t\v\f\r", at);
    if (first < end && (comment == '\0' || text[first] != comment)) ++count;
    at = end + 1;
  }
  return count;
}

}  // namespace

LineBlock CountedMeshFile::read_body(std::string_view elements) {
  const RangeFile& file = open();
  world().together([&] {
    with_tokens(file.read(0, kLongestHead), 1, [&](Tokenizer& tokens) {
      read_head(tokens, vertices_, elements_);
      body_ = tokens.offset();
    });
  });
  LineBlock mine = lines(file);
  const Ranges data = world().ranges(count_data_lines(mine.text, syntax().comment));
  first_ = data.begin(world().rank());
  world().together([&] {
    if (data.size() < vertices_ + elements_)
      throw InputError(name(), 0, fmt::format("the file ends before its {} vertices and {} {}", vertices_, elements_, elements));
  });
  return mine;
}

MeshBlock CountedMeshFile::block_of(std::vector<Vec3> positions, std::vector<ElementKind> kinds) const {
  MeshBlock block;
  block.vertices = world().ranges(positions.size());
  block.elements = world().ranges(kinds.size());
  block.positions = std::move(positions);
  block.kinds = std::move(kinds);
  world().together([&] {
    if (block.vertices.size() != vertices_ || block.elements.size() != elements_)
      throw InputError(name(), 0, "some of its lines end with a carriage return alone, which several ranks cannot read");
  });
  return block;
}

}  // namespace dmoscope
