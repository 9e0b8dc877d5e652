#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/format.h"
#include "core/io/vtu/vtu.h"
#include "core/io/vtu/vtu_data.h"
#include "core/io/vtu/vtu_document.h"
#include "core/io/writing/patch_writer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

/// Encodes the points anew that are base64 or compressed, and moves the offsets of what comes behind them in appended data.
class VtuPatcher {
 public:
  VtuPatcher(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : file_(file), mesh_(mesh), positions_(positions), context_(context), document_(*mesh.source, context.progress) {}

  Notes write() {
    std::size_t first = 0;
    for (const pugi::xml_node piece : document_.grid().children("Piece")) {
      const std::size_t count = document_.count(piece, "NumberOfPoints", mesh_.positions.size() - first);
      if (count > 0) points(piece.child("Points").child("DataArray"), first, count);
      first += count;
    }
    move_offsets();
    apply();
    if (rounded_ == 0) return {};
    return {fmt::format("{} moved coordinates were rounded to 32-bit floats, which is what the file holds.", rounded_)};
  }

 private:
  /// Bytes of the source that others take the place of.
  struct Replacement {
    std::size_t begin, end;
    std::string bytes;
    bool appended;
  };

  void points(pugi::xml_node node, std::size_t first, std::size_t count) {
    bool moved = false;
    for (std::size_t v = first; v < first + count && !moved; ++v) moved = !same_bits(mesh_.positions[v], positions_[v]);
    if (!moved) return;
    const VtuArray array = *document_.array(node);
    const std::size_t size = size_of(array.type);
    const VtuData before = vtu_data(document_, array, 3 * count * size);
    std::string bytes(before.bytes);
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p = positions_[first + v];
      put(bytes.data() + (3 * v) * size, array.type, p.x, mesh_.positions[first + v].x, first + v);
      put(bytes.data() + (3 * v + 1) * size, array.type, p.y, mesh_.positions[first + v].y, first + v);
      put(bytes.data() + (3 * v + 2) * size, array.type, p.z, mesh_.positions[first + v].z, first + v);
    }
    const VtuEncoding encoding{document_.big_endian(), document_.header(), document_.compressed(), array.base64, before.block};
    const std::size_t blanks = array.appended ? 0 : document_.bytes().find_first_not_of(" \t\r\n", array.begin) - array.begin;
    replacements_.push_back(
        {array.begin + blanks, before.end, vtu_encoded(file_.path().string(), bytes, encoding, context_.pool), array.appended});
  }

  void put(char* at, ScalarType type, double value, double before, std::size_t vertex) {
    if (std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(before)) return;
    if (type == ScalarType::Float32) {
      if (!std::isfinite(static_cast<float>(value))) {
        throw OutputError(file_.path().string(), fmt::format("coordinate {} of vertex {} is too large for a 32-bit float", value, vertex));
      }
      if (static_cast<double>(static_cast<float>(value)) != value) ++rounded_;
    }
    store_scalar(at, type, document_.big_endian(), value);
  }

  /// What comes behind points whose encoded size changed moves with them.
  void move_offsets() {
    const auto by_begin = [](const Replacement& a, const Replacement& b) { return a.begin < b.begin; };
    std::sort(replacements_.begin(), replacements_.end(), by_begin);
    std::vector<std::size_t> ends;    // of replaced appended data, ascending
    std::vector<std::size_t> growth;  // of all up to there; below zero it wraps around, and back when it is added
    for (const Replacement& one : replacements_) {
      if (!one.appended) continue;
      ends.push_back(one.end);
      growth.push_back((growth.empty() ? 0 : growth.back()) + one.bytes.size() - (one.end - one.begin));
    }
    for (const auto& array : document_.appended()) {
      const auto before = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), array.begin) - ends.begin());
      if (before == 0 || growth[before - 1] == 0) continue;
      const auto [begin, size] = document_.attribute_place(array.node, "offset");
      replacements_.push_back({begin, begin + size, std::to_string(array.offset + growth[before - 1]), false});
    }
    std::sort(replacements_.begin(), replacements_.end(), by_begin);
  }

  void apply() {
    TextWriter out(file_, context_);
    std::size_t copied = 0;
    for (const Replacement& one : replacements_) {
      out.bytes(document_.bytes().substr(copied, one.begin - copied));
      out.bytes(one.bytes);
      copied = one.end;
    }
    out.bytes(document_.bytes().substr(copied));
  }

  AtomicFile& file_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  const IoContext& context_;
  VtuDocument document_;
  std::vector<Replacement> replacements_;
  std::size_t rounded_ = 0;
};

}  // namespace

Notes patch_vtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  if (mesh.source->place_count() == positions.size()) return write_patched(file, mesh, positions, context);
  return VtuPatcher(file, mesh, positions, context).write();
}

}  // namespace dmoscope
