#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/io/gmsh/gmsh.h"
#include "core/io/numbered_mesh.h"

namespace dmoscope {
namespace {

constexpr std::string_view kFormatSection = "$MeshFormat";
constexpr std::size_t kRealBytes = 8;  // size in bytes
constexpr std::size_t kPointBytes = 3 * kRealBytes;

/// Reader, see FormatHandler. Versions 2 and 4.1, ASCII and binary of either byte order. Throws InputError, Cancelled.
class GmshReader {
 public:
  GmshReader(SourceFile& source, const IoContext& context)
      : source_(source), in_(source, context.progress), cells_(in_, source), data_(in_, source) {}

  Mesh read() {
    while (!words().at_end()) section(std::string(words().word("a section")));
    finish();
    return std::move(mesh_);
  }

 private:
  MixedInput& words() { return in_.words; }

  void section(const std::string& name) {
    if (name == "$NOD" || name == "$ELM") words().fail("MSH version 1 is not read: save the mesh in version 2.2 or 4.1");
    if (name.size() < 2 || name.front() != '$') words().fail("expected a section such as $Nodes, got " + quote_token(name));
    const bool known = name == "$PhysicalNames" || name == "$Entities" || name == "$Nodes" || name == "$Elements" || name == "$NodeData" ||
                       name == "$ElementData" || name == "$PartitionedEntities" || name == "$Periodic";
    if (known && in_.version == 0) words().fail(name + " before $MeshFormat");
    if (name == kFormatSection) {
      format();
    } else if (!known) {
      return skip(name);
    } else if (name == "$PartitionedEntities") {
      cells_.partitioned_entities();
    } else if (name == "$PhysicalNames") {
      cells_.physical_names();
    } else if (name == "$Entities") {
      cells_.entities();
    } else if (name == "$Nodes") {
      nodes();
    } else if (!nodes_read_) {
      words().fail(name + " before $Nodes");
    } else if (name == "$Elements") {
      cells_.elements(nodes_);
    } else if (name == "$Periodic") {
      periodic();
    } else {
      const bool of_nodes = name == "$NodeData";
      if (!of_nodes && !cells_.elements_read()) words().fail(name + " before $Elements");
      TagPlaces& tags = of_nodes ? nodes_ : cells_.tags();
      (void)tags.finish();
      data_.read(of_nodes ? Field::On::Vertices : Field::On::Elements, tags);
    }
    const std::string end = "$End" + name.substr(1);
    if (words().word(end) != end) words().fail(fmt::format("expected {} (more lines than the count says?)", end));
  }

  /// Skips an unknown section.
  void skip(const std::string& name) {
    const std::string end = "$End" + name.substr(1);
    source_.add_only_in_file(name);
    (void)words().rest_of_line();
    while (words().left() > 0) {
      if (words().rest_of_line() == end) return;
    }
    (void)words().word(end);  // fails with an error, since there is no such word
  }

  void format() {
    if (in_.version != 0) words().fail("a second $MeshFormat");
    const std::string_view version = words().word("the version");
    if (version == "2" || version.starts_with("2.")) {
      in_.version = 2;
    } else if (version == "4.1") {
      in_.version = 4;
    } else {
      words().fail(fmt::format("MSH version {} is not read: save the mesh in version 2.2 or 4.1", quote_token(version)));
    }
    const std::int64_t type = words().integer("the file type");
    if (type != 0 && type != 1) words().fail(fmt::format("file type {}: 0 (ASCII) and 1 (binary) are known", type));
    if (words().integer("the size of a number") != 8) words().fail("only files with numbers of 8 bytes are read");
    if (type == 1) {
      (void)words().rest_of_line();
      in_.binary = true;
      const char* const one = words().block(4, "the number 1 that tells the byte order").data();
      in_.big_endian = load_number<std::int32_t>(one, true) == 1;
      if (!in_.big_endian && load_number<std::int32_t>(one, false) != 1)
        words().fail("the byte order is told by a number 1, which is not here");
    }
    source_.set_layout(in_.binary ? CoordinateLayout::packed(CoordinateScalar::Float64, in_.big_endian)
                                  : CoordinateLayout{.syntax = {.free_form = true}});
  }

  /// Reads pairs of vertices, by curves and surfaces. In version 2 these are words even in a binary file.
  void periodic() {
    source_.add_only_in_file("$Periodic");
    if (in_.version == 2) {
      const std::size_t links = words().count("the number of periodic entities", 8.0);
      for (std::size_t i = 0; i < links; ++i) link_2();
      return;
    }
    in_.begin_data();
    const std::size_t links = in_.count("the number of periodic entities", 8.0, 20.0);
    for (std::size_t i = 0; i < links; ++i) {
      for (const char* what : {"a dimension", "an entity", "its master"}) (void)in_.whole(what);
      const std::size_t numbers = in_.count("how many numbers transform", 2.0, 8.0);
      for (std::size_t k = 0; k < numbers; ++k) (void)in_.real("a number of a transformation");
      const std::size_t pairs = in_.count("the number of pairs of nodes", 4.0, 16.0);
      for (std::size_t k = 0; k < pairs; ++k) {
        const std::int64_t node = in_.size("the number of a node"), master = in_.size("the number of its master");
        add_pair(node, master);
      }
    }
  }
  void link_2() {
    for (const char* what : {"a dimension", "an entity", "its master"}) (void)words().integer(what);
    (void)words().rest_of_line();
    if (words().peek_word() == "Affine") (void)words().rest_of_line();
    const std::size_t pairs = words().count("the number of pairs of nodes", 4.0);
    for (std::size_t k = 0; k < pairs; ++k) {
      const std::int64_t node = words().integer("the number of a node"), master = words().integer("the number of its master");
      add_pair(node, master);
    }
  }
  void add_pair(std::int64_t node, std::int64_t master) {
    const Index one = nodes_.find(node), other = nodes_.find(master);
    if (one == kNoIndex || other == kNoIndex)
      words().fail(fmt::format("$Periodic pairs node {} with {}, and $Nodes has not both", node, master));
    if (one != other) mesh_.periodic.push_back({one, other});
  }

  // --- Nodes ---

  void nodes() {
    if (nodes_read_) words().fail("a second $Nodes");
    nodes_read_ = true;
    if (in_.version == 2) {
      nodes_2();
    } else {
      nodes_4();
    }
    if (const auto twice = nodes_.finish()) {
      words().fail_at(source_.place(*twice), fmt::format("the number of node {} of $Nodes is taken by a node before it", *twice + 1));
    }
    if (!nodes_.count_from_one()) source_.add_only_in_file("the numbers of its nodes");
  }

  void reserve(std::size_t count) {
    reserve_large(mesh_.positions, count);
    source_.reserve_places(count);
  }

  /// Reads x, y and z as words.
  void text_point() {
    Vec3 p;
    p.x = words().coordinate();
    source_.add_place(words().token());
    p.y = words().coordinate();
    p.z = words().coordinate();
    mesh_.positions.push_back(p);
  }

  /// Reads x, y and z at `bytes`, which is byte `place` of the file.
  void binary_point(const char* bytes, std::size_t place) {
    const Vec3 p{in_.real_at(bytes), in_.real_at(bytes + kRealBytes), in_.real_at(bytes + 2 * kRealBytes)};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      words().fail_at(place, fmt::format("a coordinate of node {} of $Nodes is not a finite number", mesh_.positions.size() + 1));
    }
    source_.add_place(place);
    mesh_.positions.push_back(p);
  }

  void nodes_2() {
    constexpr std::size_t kNode = 4 + kPointBytes;
    const std::size_t count = words().count("the number of nodes", in_.binary ? static_cast<double>(kNode) : 8.0);
    reserve(count);
    if (!in_.binary) {
      for (std::size_t v = 0; v < count; ++v) {
        nodes_.add(words().integer("the number of a node"));
        text_point();
      }
      return;
    }
    in_.begin_data();
    const char* const bytes = words().block(count * kNode, "the nodes").data();
    const std::size_t first = words().token();
    for (std::size_t v = 0; v < count; ++v) {
      nodes_.add(in_.int_at(bytes + v * kNode));
      binary_point(bytes + v * kNode + 4, first + v * kNode + 4);
    }
  }

  void nodes_4() {
    in_.begin_data();
    const std::size_t blocks = in_.count("the number of blocks of nodes", 8.0, 20.0);
    const std::size_t count = in_.count("the number of nodes", 8.0, static_cast<double>(8 + kPointBytes));
    (void)in_.size("the smallest number of a node");
    (void)in_.size("the largest number of a node");
    reserve(count);
    for (std::size_t b = 0; b < blocks; ++b) block_4(count);
    if (mesh_.positions.size() != count) {
      words().fail(fmt::format("{} nodes in the blocks, but $Nodes says {}", mesh_.positions.size(), count));
    }
  }

  void block_4(std::size_t count) {
    const int dimension = in_.whole("the dimension of an entity");
    if (dimension < 0 || dimension > 3) words().fail(fmt::format("an entity of {} dimensions", dimension));
    (void)in_.whole("the number of an entity");
    const int parametric = in_.whole("0 or 1 for parametric coordinates");
    if (parametric != 0 && parametric != 1) words().fail(fmt::format("expected 0 or 1 for parametric coordinates, got {}", parametric));
    const std::size_t more = parametric == 1 ? static_cast<std::size_t>(dimension) : 0;  // numbers behind x, y and z
    if (more > 0) source_.add_only_in_file("the parametric coordinates of its nodes");
    const std::size_t each = kPointBytes + more * kRealBytes;
    const std::size_t number = in_.count("a number of nodes", 8.0, static_cast<double>(8 + each));
    if (number > count - mesh_.positions.size()) words().fail(fmt::format("more nodes in the blocks than the {} that $Nodes says", count));
    if (!in_.binary) {
      for (std::size_t v = 0; v < number; ++v) nodes_.add(in_.size("the number of a node"));
      for (std::size_t v = 0; v < number; ++v) {
        text_point();
        for (std::size_t k = 0; k < more; ++k) (void)words().number("a parametric coordinate");
      }
      return;
    }
    const char* const tags = words().block(number * 8, "the numbers of nodes").data();
    for (std::size_t v = 0; v < number; ++v) nodes_.add(in_.size_at(tags + 8 * v));
    const char* const bytes = words().block(number * each, "the nodes").data();
    const std::size_t first = words().token();
    for (std::size_t v = 0; v < number; ++v) binary_point(bytes + v * each, first + v * each);
  }

  void finish() {
    if (in_.version == 0) words().fail_at(source_.bytes().size(), "the file has no $MeshFormat");
    if (!nodes_read_) words().fail_at(source_.bytes().size(), "the file has no $Nodes");
    if (cells_.cells().dimension() < 2) words().fail_at(source_.bytes().size(), "the file holds no elements of two or three dimensions");
    const std::vector<Index> rows = cells_.add_to(mesh_);
    data_.add_to(mesh_, rows);
  }

  SourceFile& source_;
  GmshInput in_;
  GmshCells cells_;
  GmshData data_;
  TagPlaces nodes_;
  Mesh mesh_;
  bool nodes_read_ = false;
};

bool recognises_gmsh(std::string_view bytes) { return bytes.starts_with(kFormatSection) || bytes.starts_with("$NOD"); }

}  // namespace

constinit const FormatHandler kGmshFormat{
    .info = {"gmsh", "Gmsh", ".msh",
             "2D and 3D elements, physical groups, data; versions 2.2 and 4.1, ASCII and binary; made anew: 2.2 ASCII"},
    .recognises = recognises_gmsh,
    .read = read_with<GmshReader>,
    .write = write_gmsh,
    .comment = {"$Comments\n", "\n$EndComments\n"}};

}  // namespace dmoscope
