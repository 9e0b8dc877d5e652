// Reads and writes PVTU by many ranks, each of which has whole pieces.

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/same_bits.h"
#include "core/input/declared_floats.h"
#include "core/io/format.h"
#include "core/io/mesh_io.h"
#include "core/io/pvtu/pvtu.h"
#include "core/io/vtu/vtu.h"
#include "core/transfer/field_rules.h"
#include "mpi/files/shared_mesh_file.h"
#include "mpi/mesh/mesh_block.h"
#include "mpi/reading/byte_range.h"

namespace dmoscope {

namespace {

/// Numbers of a rank's things among all things: those that join_pieces() gives.
struct SharedNumbers {
  std::vector<WholeIndex> of_thing;  // by thing
  std::vector<std::uint8_t> first;   // by thing: 1 if it is the first of its number
  Ranges ranges;                     // ranges of the numbers
};

/// Finds for each of `keys` the least place of an equal one.
template <class Key>
std::vector<std::uint64_t> first_of_equals(const std::vector<Key>& keys) {
  std::vector<std::uint64_t> order(keys.size()), first(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::uint64_t a, std::uint64_t b) { return keys[a] < keys[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && keys[order[i]] == keys[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

/// Numbers things by their ids, in ascending order; things of one id are one. The first of them, in the ranks' order, represents all. To be
/// called by all ranks together.
SharedNumbers number_by_id(const World& world, std::span<const std::uint64_t> ids) {
  std::uint64_t most = 0;
  for (const std::uint64_t id : ids) most = std::max(most, id);
  const Ranges space(world.greatest(most) + 1, world.size());
  const Keepers<std::uint64_t> keepers(world, ids, [&](std::uint64_t id) { return space.holder(id); });
  const std::vector<std::uint64_t>& kept = keepers.kept();
  const std::vector<std::uint64_t> first = first_of_equals(kept);
  std::vector<std::uint64_t> order;  // first things of an id
  for (std::uint64_t i = 0; i < kept.size(); ++i)
    if (first[i] == i) order.push_back(i);
  std::ranges::sort(order, {}, [&](std::uint64_t i) { return kept[i]; });
  SharedNumbers numbers;
  numbers.ranges = world.ranges(order.size());
  struct Answer {
    WholeIndex number;
    std::uint64_t first;
  };
  std::vector<Answer> answers(kept.size());
  for (std::size_t k = 0; k < order.size(); ++k) answers[order[k]] = {numbers.ranges.begin(world.rank()) + k, 1};
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (first[i] != i) answers[i] = {answers[first[i]].number, 0};
  for (const Answer& answer : keepers.give_back(answers)) {
    numbers.of_thing.push_back(answer.number);
    numbers.first.push_back(static_cast<std::uint8_t>(answer.first));
  }
  return numbers;
}

/// Numbers places in the order of the ranks and of their things; places with the same bits are one. To be called by all ranks together.
SharedNumbers number_by_place(const World& world, std::span<const Vec3> places) {
  using Bits = std::array<std::uint64_t, 3>;
  std::vector<Bits> keys;
  keys.reserve(places.size());
  for (const Vec3& p : places)
    keys.push_back({std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z)});
  const Keepers<Bits> keepers(world, keys, [&](const Bits& bits) {
    std::uint64_t mixed = 0;
    for (const std::uint64_t b : bits) mixed = (mixed ^ b ^ (mixed >> 29U)) * 0x9e3779b97f4a7c15U;
    return static_cast<int>((mixed >> 32U) % static_cast<std::uint64_t>(world.size()));
  });
  const std::vector<std::uint64_t> first = first_of_equals(keepers.kept());
  std::vector<std::uint8_t> is_first(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) is_first[i] = first[i] == i ? 1 : 0;
  SharedNumbers numbers;
  numbers.first = keepers.give_back(is_first);
  const auto count = static_cast<std::uint64_t>(std::ranges::count(numbers.first, std::uint8_t{1}));
  numbers.ranges = world.ranges(count);
  // The first things know their numbers, and tell the keepers, who tell the others.
  std::vector<WholeIndex> told(places.size(), 0);
  WholeIndex next = numbers.ranges.begin(world.rank());
  for (std::size_t i = 0; i < told.size(); ++i)
    if (numbers.first[i] != 0) told[i] = next++;
  std::vector<WholeIndex> answers = keepers.take_along(told);
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = answers[first[i]];
  numbers.of_thing = keepers.give_back(answers);
  return numbers;
}

/// The elements and fields of all of a rank's pieces, one after the other.
struct Pieces {
  std::vector<Vec3> positions;
  std::vector<std::uint64_t> vertex_ids, element_ids;
  bool all_vertex_ids = true, all_element_ids = true;
  std::vector<ElementKind> kinds;
  std::vector<std::uint64_t> corners;  // indices into positions
  std::vector<BlockField> fields;
  bool floats = false;
};

class PvtuFile final : public SharedMeshFile {
 public:
  PvtuFile(const World& world, std::filesystem::path path) : world_(world), path_(std::move(path)) {}

  MeshBlock read(const FieldFilter& filter) override {
    Pieces mine;
    world_.together([&] {
      const RangeFile file(path_);
      text_ = file.read(0, file.size());
      names_ = pvtu_pieces(text_, path_);
      if (names_.empty()) throw InputError(path_.string(), 0, "it names no pieces");
    });
    pieces_ = Ranges(names_.size(), world_.size());
    world_.together([&] {
      for (std::uint64_t p = pieces_.begin(world_.rank()); p < pieces_.end(world_.rank()); ++p) add_piece(p, filter, mine);
    });
    share_fields(mine);
    const bool ids = !world_.any(!mine.all_vertex_ids);
    SharedNumbers vertices = ids ? number_by_id(world_, mine.vertex_ids) : number_by_place(world_, mine.positions);
    MeshBlock block;
    block.single_precision = world_.any(mine.floats);
    if (block.single_precision) round_to_floats(mine.positions);
    block.vertices = vertices.ranges;
    take_vertices(mine, vertices, block);
    for (std::uint64_t& corner : mine.corners) corner = vertices.of_thing[corner];
    numbers_ = std::move(vertices.of_thing);
    if (!world_.any(!mine.all_element_ids)) {
      take_elements_by_id(mine, block);
    } else {
      block.elements = world_.ranges(mine.kinds.size());
      block.kinds = std::move(mine.kinds);
      block.corners = std::move(mine.corners);
      for (BlockField& field : mine.fields)
        if (field.on == Field::On::Elements) block.fields.push_back(std::move(field));
    }
    world_.together([&] {
      if (block.elements.size() == 0) throw InputError(path_.string(), 0, "its pieces hold no elements");
    });
    block_vertices_ = block.vertices;
    return block;
  }

  std::vector<std::string> write(const std::filesystem::path& target, std::span<const Vec3> positions) override {
    const WholeIndex first = block_vertices_.begin(world_.rank());
    const std::vector<Vec3> mine = ask_holders<Vec3>(world_, block_vertices_, numbers_, [&](WholeIndex v) { return positions[v - first]; });
    const bool same = same_file(path_, target);
    std::vector<std::unique_ptr<AtomicFile>> files;
    std::vector<std::string> notes;
    const FormerMesh former(target);
    world_.together([&] {
      if (!same && !replaced_file(target, path_).empty())
        throw OutputError(target.string(), fmt::format("pieces of {}, which would be replaced: name the output otherwise", path_.string()));
      std::size_t at = 0;
      for (std::uint64_t p = pieces_.begin(world_.rank()); p < pieces_.end(world_.rank()); ++p) {
        files.push_back(std::make_unique<AtomicFile>(same ? names_[p] : target.parent_path() / pvtu_piece_name(target, p)));
        former.require_own(files.back()->path());
        at += write_piece(p, *files.back(), std::span(mine).subspan(at), notes);
      }
    });
    std::unique_ptr<AtomicFile> whole;
    world_.together([&] {
      if (!world_.is_first()) return;
      std::vector<std::string> names;
      for (std::uint64_t p = 0; p < names_.size(); ++p) names.push_back(pvtu_piece_name(target, p));
      whole = std::make_unique<AtomicFile>(target);
      whole->write(same ? text_ : pvtu_with_pieces(text_, path_, names));
      whole->finish();
    });
    world_.together([&] {
      for (const auto& file : files) file->commit();
    });
    world_.together([&] {
      if (!whole) return;
      whole->commit();
      former.settle(notes);
    });
    return notes;
  }
  std::vector<std::string> nodal_fields() const override { return nodal_fields_; }

 private:
  /// Adds a piece, read by the reader of one process, without its ghosts.
  void add_piece(std::uint64_t p, const FieldFilter& filter, Pieces& mine) {
    Progress unwatched;
    const std::int64_t stamp = RangeFile(names_[p]).stamp();
    const Mesh piece = read_mesh(names_[p], unwatched);
    facts_.push_back({piece.positions.size(), stamp});
    const PieceIds ids = piece_ids(piece);
    const std::uint64_t first = mine.positions.size();
    mine.floats = mine.floats || piece.single_precision;
    mine.positions.insert(mine.positions.end(), piece.positions.begin(), piece.positions.end());
    mine.all_vertex_ids = mine.all_vertex_ids && ids.vertices != nullptr;
    mine.all_element_ids = mine.all_element_ids && ids.elements != nullptr;
    const auto add_id = [](const Field* field, Index i, std::vector<std::uint64_t>& to) {
      if (field != nullptr) to.push_back(static_cast<std::uint64_t>(field->values[i]));
    };
    for (Index v = 0; v < piece.vertex_count(); ++v) add_id(ids.vertices, v, mine.vertex_ids);
    for (Index e = 0; e < piece.elements.size(); ++e) {
      if (ids.is_ghost(e)) continue;
      add_id(ids.elements, e, mine.element_ids);
      mine.kinds.push_back(piece.elements.kind(e));
      for (const Index v : piece.elements.corners(e)) mine.corners.push_back(first + v);
    }
    add_fields(piece, ids, filter, mine);
  }

  /// Adds the fields of a piece. Fields that not all of a rank's pieces have are left out, as are those that not all ranks have.
  void add_fields(const Mesh& piece, const PieceIds& ids, const FieldFilter& filter, Pieces& mine) {
    const bool is_first = mine.positions.size() == piece.positions.size();
    std::set<std::pair<std::string, Field::On>> met;  // the first of two fields of one name counts
    for (const Field& field : piece.fields) {
      if (!met.emplace(field.name, field.on).second) continue;
      if (field.on == Field::On::Vertices && !holds_whole_numbers(field) &&
          std::ranges::find(nodal_fields_, field.name) == nodal_fields_.end())
        nodal_fields_.push_back(field.name);
      if (field.components != 1 || !filter.wants(field.name, field.on)) continue;
      const auto known = std::find_if(mine.fields.begin(), mine.fields.end(),
                                      [&](const BlockField& one) { return one.name == field.name && one.on == field.on; });
      if (known == mine.fields.end() && !is_first) continue;
      BlockField& into = known == mine.fields.end() ? mine.fields.emplace_back(BlockField{field.name, field.on, {}}) : *known;
      for (Index i = 0; i < field.values.size(); ++i)
        if (field.on == Field::On::Vertices || !ids.is_ghost(i)) into.values.push_back(field.values[i]);
    }
    std::erase_if(mine.fields, [&](const BlockField& one) {
      return one.values.size() != (one.on == Field::On::Vertices ? mine.positions.size() : mine.kinds.size());
    });
  }

  /// Keeps the fields that all ranks with pieces have, in one order.
  void share_fields(Pieces& mine) const {
    std::string names;
    const auto key = [](const BlockField& field) { return (field.on == Field::On::Vertices ? "v" : "e") + field.name; };
    for (const BlockField& field : mine.fields) names += key(field) + '\n';
    world_.broadcast(names, pieces_.holder(0));  // the fields of the first piece
    std::vector<BlockField> kept;
    for (std::size_t at = 0; at < names.size();) {
      const std::size_t end = names.find('\n', at);
      const std::string name = names.substr(at, end - at);
      at = end + 1;
      const auto found = std::find_if(mine.fields.begin(), mine.fields.end(), [&](const BlockField& field) { return key(field) == name; });
      if (world_.any(found == mine.fields.end() && pieces_.count(world_.rank()) > 0)) continue;
      if (found != mine.fields.end())
        kept.push_back(std::move(*found));
      else
        kept.push_back({name.substr(1), name[0] == 'v' ? Field::On::Vertices : Field::On::Elements, {}});
    }
    mine.fields = std::move(kept);
  }

  /// Sends the value of each number's first thing to the number's holder. `of(i)`: value of thing i.
  template <Plain T, class Of>
  [[nodiscard]] std::vector<T> to_holders(const SharedNumbers& numbers, const Of& of) const {
    struct HeldValue {
      WholeIndex number;
      T value;
    };
    const Parts<HeldValue> to = deal<HeldValue>(world_, [&](const auto& give) {
      for (std::size_t i = 0; i < numbers.of_thing.size(); ++i)
        if (numbers.first[i] != 0) give(numbers.ranges.holder(numbers.of_thing[i]), HeldValue{numbers.of_thing[i], of(i)});
    });
    std::vector<T> held(numbers.ranges.count(world_.rank()));
    for (const HeldValue& one : world_.exchange(to).values) held[one.number - numbers.ranges.begin(world_.rank())] = one.value;
    return held;
  }

  void take_vertices(const Pieces& mine, const SharedNumbers& vertices, MeshBlock& block) const {
    block.positions = to_holders<Vec3>(vertices, [&](std::size_t i) { return mine.positions[i]; });
    for (const BlockField& field : mine.fields)
      if (field.on == Field::On::Vertices)
        block.fields.push_back({field.name, field.on, to_holders<double>(vertices, [&](std::size_t i) { return field.values[i]; })});
    const WholeIndex first = block.vertices.begin(world_.rank());
    const std::vector<Vec3> there =
        ask_holders<Vec3>(world_, block.vertices, vertices.of_thing, [&](WholeIndex v) { return block.positions[v - first]; });
    world_.together([&] {
      for (std::size_t i = 0; i < there.size(); ++i)
        if (!same_bits(there[i], mine.positions[i]))
          throw InputError(path_.string(), 0, fmt::format("pieces disagree on where vertex {} stands", mine.vertex_ids[i]));
    });
  }

  void take_elements_by_id(const Pieces& mine, MeshBlock& block) const {
    struct Element {
      ElementKind kind{};
      std::array<WholeIndex, 8> corners{};
    };
    const SharedNumbers elements = number_by_id(world_, mine.element_ids);
    block.elements = elements.ranges;
    std::vector<std::uint64_t> first_corner{0};
    for (const ElementKind kind : mine.kinds) first_corner.push_back(first_corner.back() + info(kind).corners);
    const auto held = to_holders<Element>(elements, [&](std::size_t e) {
      Element element{mine.kinds[e], {}};
      std::copy_n(mine.corners.begin() + static_cast<std::ptrdiff_t>(first_corner[e]), info(element.kind).corners, element.corners.begin());
      return element;
    });
    for (const Element& element : held) {
      block.kinds.push_back(element.kind);
      block.corners.insert(block.corners.end(), element.corners.begin(), element.corners.begin() + info(element.kind).corners);
    }
    for (const BlockField& field : mine.fields)
      if (field.on == Field::On::Elements)
        block.fields.push_back({field.name, field.on, to_holders<double>(elements, [&](std::size_t i) { return field.values[i]; })});
  }

  /// Writes a piece and returns its number of vertices.
  std::size_t write_piece(std::uint64_t p, AtomicFile& file, std::span<const Vec3> positions, std::vector<std::string>& notes) const {
    Progress unwatched;
    const Mesh piece = read_mesh(names_[p], unwatched);
    const std::size_t count = piece.positions.size();
    const Facts& facts = facts_[p - pieces_.begin(world_.rank())];
    if (count != facts.vertices || RangeFile(names_[p]).stamp() != facts.stamp)
      throw InputError(names_[p].string(), 0, "the file has changed while it was smoothed");
    const std::string name = file.path().filename().string();
    const auto note = [&](const std::string& sentence) { notes.push_back(fmt::format("{}: {}", name, sentence)); };
    if (piece.source->not_patchable().empty()) {
      for (const std::string& sentence : patch_vtu(file, piece, positions.first(count), unwatched)) note(sentence);
    } else {
      note(fmt::format("The file was made anew: {}.", piece.source->not_patchable()));
      for (const std::string& sentence : write_vtu(file, piece, positions.first(count), unwatched)) note(sentence);
      for (const std::string& thing : piece.source->only_in_file())
        note(fmt::format("Dropped: {} of {}.", thing, names_[p].filename().string()));
    }
    if (!file.note().empty()) note(file.note());
    file.finish();
    return count;
  }

  /// Properties of a piece, as it was read.
  struct Facts {
    std::size_t vertices;
    std::int64_t stamp;
  };

  const World& world_;
  std::filesystem::path path_;
  std::string text_;
  std::vector<std::filesystem::path> names_;
  Ranges pieces_, block_vertices_;
  std::vector<Facts> facts_;         // one per piece of the rank
  std::vector<WholeIndex> numbers_;  // vertices of the rank's pieces, one piece after the other
  std::vector<std::string> nodal_fields_;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared_pvtu(const World& world, const std::filesystem::path& path) {
  return std::make_unique<PvtuFile>(world, path);
}

}  // namespace dmoscope
