#pragma once
// The vertices that a person has chosen to smooth or to fix, and the brush that chooses them.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope::ui {

/// A set of vertices.
class Selection {
 public:
  /// The vertices, ascending, each once.
  [[nodiscard]] const std::vector<Index>& vertices() const noexcept { return vertices_; }
  [[nodiscard]] bool empty() const noexcept { return vertices_.empty(); }
  [[nodiscard]] bool contains(Index vertex) const;
  /// Number that grows with every change, to tell whether it must be drawn again.
  [[nodiscard]] std::uint64_t serial() const noexcept { return serial_; }
  /// Replaces, adds or removes vertices, which may be in any order.
  void assign(std::vector<Index> vertices);
  void add(std::span<const Index> vertices);
  void remove(std::vector<Index> vertices);
  void clear() { assign({}); }

 private:
  std::vector<Index> vertices_;
  std::uint64_t serial_ = 0;
};

/// Effect of a stroke of the brush on the vertices under it.
enum class StrokeKind { Select, Add, Remove };

struct Brush {
  bool on = false;        // whether dragging paints instead of moving the view
  double radius = 20.0;   // pixels at scale 1
  bool painting = false;  // a stroke is under way
  StrokeKind kind = StrokeKind::Select;
  Selection stroke;     // vertices that it has touched so far
  Vec2<double> last{};  // latest place of the brush; pixels of the viewport
};

/// The selection as it will be once the stroke has ended.
[[nodiscard]] Selection after_stroke(const Selection& selection, const Brush& brush);

/// Ascending numbers as words of a command: "3-7 9".
[[nodiscard]] std::string id_ranges(std::span<const Index> vertices);
/// Numbers that such words name; the reverse of id_ranges(). All must be below `count`. Throws UsageError.
[[nodiscard]] std::vector<Index> parse_id_ranges(std::span<const std::string> words, Index count);

}  // namespace dmoscope::ui
