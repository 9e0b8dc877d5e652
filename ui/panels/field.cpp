#include "ui/panels/field.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/analysis/derived.h"
#include "ui/overlays/inspection_marks.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

constexpr render::Rgb kDarkInk{0x10, 0x12, 0x16}, kLightInk{0xff, 0xff, 0xff};

/// Ink that is readable on `ground`.
render::Rgb ink_on(render::Rgb ground) { return render::to_oklab(ground).l > 0.55 ? kDarkInk : kLightInk; }

class FieldPainter {
 public:
  FieldPainter(ImDrawList& list, const FieldPicture& picture, const FieldLook& look, const ToWindow& at)
      : list_(list), picture_(picture), field_(picture.field), look_(look), at_(at) {}

  void fill() {
    const int columns = field_.columns, rows = field_.rows;
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    list_.PrimReserve((columns - 1) * (rows - 1) * 6, columns * rows);
    const unsigned first = list_._VtxCurrentIdx;
    const auto corner = [&](int row, int column) { return static_cast<ImDrawIdx>(first + static_cast<unsigned>(row * columns + column)); };
    for (int row = 0; row + 1 < rows; ++row) {
      for (int column = 0; column + 1 < columns; ++column) {
        for (const auto& [r, c] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}})
          list_.PrimWriteIdx(corner(row + r, column + c));
      }
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) list_.PrimWriteVtx(at_(edge_point(column, row)), white, ground(column, row));
    }
  }

  void hatch() {
    if (look_.only_valid) return;
    const ImU32 ink = colour(kInvalidCandidate, 0.55F);
    constexpr int kEvery = 6;  // samples between strokes
    for (int start = -field_.rows; start < field_.columns; start += kEvery) {
      int begun = -1;  // row in which a stroke of the diagonal began
      for (int row = 0; row <= field_.rows; ++row) {
        const int column = start + row;
        const bool inside = row < field_.rows && column >= 0 && column < field_.columns && !valid(column, row);
        if (inside && begun < 0) begun = row;
        if (inside || begun < 0) continue;
        list_.AddLine(at_(edge_point(start + begun, begun)), at_(edge_point(start + row - 1, row - 1)), ink, look_.scale);
        begun = -1;
      }
    }
  }

  void contours() {
    for (const FieldPicture::Line& line : picture_.lines) {
      const ImU32 ink = colour(ink_on(look_.colours.colour(line.value)), 0.75F);
      for (const ContourPiece& piece : line.pieces) list_.AddLine(at_(point(piece.from)), at_(point(piece.to)), ink, look_.scale);
    }
    for (const bool casing : {true, false}) {
      for (const ContourPiece& piece : picture_.outline) {
        list_.AddLine(at_(point(piece.from)), at_(point(piece.to)), colour(casing ? kDarkInk : kLightInk),
                      (casing ? 3.6F : 1.6F) * look_.scale);
      }
    }
  }

  /// Draws the value of each line at one of its ends that no other value covers.
  void labels() {
    const float size = 0.72F * look_.em;
    std::vector<ImVec2> taken;
    for (const FieldPicture::Line& line : picture_.lines) {
      const std::string text = fmt::format("{:g}", line.value);
      const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(size, 1e6F, 0.0F, text.c_str());
      for (const Vec2<double> end : ends(line)) {
        const ImVec2 on = at_(point(end));
        const bool crowded = std::any_of(taken.begin(), taken.end(), [&](ImVec2 other) {
          return std::abs(other.x - on.x) < extent.x + 3 && std::abs(other.y - on.y) < 0.9F * size;
        });
        if (crowded) continue;
        taken.push_back(on);
        const render::Rgb ground = look_.colours.colour(line.value);
        const ImVec2 low{on.x - extent.x / 2, on.y - extent.y / 2};
        list_.AddRectFilled({low.x - 2, low.y}, {low.x + extent.x + 2, low.y + extent.y}, colour(ground, 0.85F), 2.0F);
        list_.AddText(ImGui::GetFont(), size, low, colour(ink_on(ground)), text.c_str());
        break;
      }
    }
  }

 private:
  /// The outermost points of a line: to the right, left, above and below.
  [[nodiscard]] static std::vector<Vec2<double>> ends(const FieldPicture::Line& line) {
    std::vector<Vec2<double>> found;
    for (const Vec2<double> way : {Vec2<double>{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const auto farthest = std::max_element(line.pieces.begin(), line.pieces.end(), [way](const ContourPiece& a, const ContourPiece& b) {
        return dot(a.from, way) < dot(b.from, way);
      });
      if (farthest != line.pieces.end()) found.push_back(farthest->from);
    }
    return found;
  }
  [[nodiscard]] std::size_t slot(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.columns) + static_cast<std::size_t>(column);
  }
  [[nodiscard]] bool valid(int column, int row) const { return field_.jacobian[slot(column, row)] > 0.0F; }
  [[nodiscard]] ImU32 ground(int column, int row) const {
    if (valid(column, row)) return colour(look_.colours.colour(static_cast<double>(field_.quality[slot(column, row)])));
    return look_.only_valid ? colour(look_.colours.colour(look_.colours.low), 0.0F) : colour(look_.palette.raised);
  }
  /// Point of the window for a place in samples.
  [[nodiscard]] Vec2<double> point(Vec2<double> sample) const {
    return {field_.low.x + (sample.x + 0.5) / field_.columns * (field_.high.x - field_.low.x),
            field_.low.y + (sample.y + 0.5) / field_.rows * (field_.high.y - field_.low.y)};
  }
  /// Point of the window for a sample's place; the outermost samples stand for the border, too.
  [[nodiscard]] Vec2<double> edge_point(int column, int row) const {
    const auto place = [](int k, int count) { return k == 0 ? -0.5 : k == count - 1 ? count - 0.5 : static_cast<double>(k); };
    return point({place(column, field_.columns), place(row, field_.rows)});
  }

  ImDrawList& list_;
  const FieldPicture& picture_;
  const QualityField& field_;
  const FieldLook& look_;
  const ToWindow& at_;
};

ImU32 ink_of(render::Rgba c) { return IM_COL32(c.r, c.g, c.b, c.a); }

/// Draws lines and dots in the style of the mesh's own drawing.
class MarkPen {
 public:
  MarkPen(ImDrawList& list, float scale, render::Rgba casing) : list_(list), scale_(scale), casing_(ink_of(casing)) {}

  void line(ImVec2 from, ImVec2 to, const render::OverlayLine& line) { list_.AddLine(from, to, ink_of(line.colour), line.width * scale_); }
  void dot(ImVec2 at, const render::OverlayDot& dot) {
    const float radius = dot.diameter * scale_ / 2, rim = 1.2F * scale_;
    const ImU32 ink = ink_of(dot.colour);
    switch (dot.shape) {
      case render::DotShape::Round:
        list_.AddCircleFilled(at, radius + rim, casing_);
        list_.AddCircleFilled(at, radius, ink);
        break;
      case render::DotShape::Square:
        list_.AddRectFilled({at.x - radius - rim, at.y - radius - rim}, {at.x + radius + rim, at.y + radius + rim}, casing_);
        list_.AddRectFilled({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, ink);
        break;
      case render::DotShape::Ring:
        list_.AddCircle(at, radius, casing_, 0, 2.2F * scale_ + 2 * rim);
        list_.AddCircle(at, radius, ink, 0, 2.2F * scale_);
        break;
      case render::DotShape::Cross:
        cross(at, radius + rim, casing_, 2.2F * scale_ + 2 * rim);
        cross(at, radius, ink, 2.2F * scale_);
        break;
      case render::DotShape::Diamond:
        diamond(at, radius + 1.4F * rim, casing_);
        diamond(at, radius, ink);
        break;
    }
  }

 private:
  void cross(ImVec2 at, float reach, ImU32 ink, float width) {
    list_.AddLine({at.x - reach, at.y - reach}, {at.x + reach, at.y + reach}, ink, width);
    list_.AddLine({at.x - reach, at.y + reach}, {at.x + reach, at.y - reach}, ink, width);
  }
  void diamond(ImVec2 at, float reach, ImU32 ink) {
    list_.AddQuadFilled({at.x - reach, at.y}, {at.x, at.y - reach}, {at.x + reach, at.y}, {at.x, at.y + reach}, ink);
  }

  ImDrawList& list_;
  float scale_;
  ImU32 casing_;
};

}  // namespace

void draw_field(ImDrawList& list, const FieldPicture& picture, const FieldLook& look, const ToWindow& at) {
  FieldPainter painter(list, picture, look, at);
  painter.fill();
  painter.hatch();
  painter.contours();
  painter.labels();
}

std::optional<std::pair<double, double>> field_at(const QualityField& field, Vec2<double> point) {
  const double x = (point.x - field.low.x) / (field.high.x - field.low.x) * field.columns;
  const double y = (point.y - field.low.y) / (field.high.y - field.low.y) * field.rows;
  if (!(x >= 0.0 && y >= 0.0 && x < field.columns && y < field.rows)) return {};
  const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(field.columns) + static_cast<std::size_t>(x);
  return std::pair{static_cast<double>(field.quality[at]), static_cast<double>(field.jacobian[at])};
}

void draw_field_in_view(PanelContext& context, const PaneFacts& pane) {
  const Rect& rect = pane.rect;
  const ViewState& state = context.state;
  const Inspection& inspection = context.inspection;
  if (!pane.inspected || !state.inspection.open || !state.inspection.field_in_view || !inspection.trace || !inspection.field) return;
  const auto window = [&](Vec2<double> point) {
    const Vec2<double> pixel = pane.camera.to_pixel(point, state.viewport);
    return ImVec2{rect.x + static_cast<float>(pixel.x), rect.y + static_cast<float>(pixel.y)};
  };
  const ToWindow at = [&](Vec2<double> point) { return window({inspection.origin.x + point.x, inspection.origin.y + point.y}); };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_field(list, *inspection.field, {colour_scale(state, context.derived), context.palette, context.em(), context.px(1), true}, at);
  const render::Style style = scene_style(state);
  render::Marks marks;
  add_inspection_marks(marks, state.inspection, inspection, inspection_look(state, context.derived, pane.camera.units_per_pixel));
  MarkPen pen(list, context.px(1), style.casing_colour);
  const auto place = [&](Vec3 point) { return window({point.x, point.y}); };
  for (const render::OverlayLine& line : marks.lines) pen.line(place(line.from), place(line.to), line);
  const Vec2<double> stands = state.inspection.applied ? inspection.trace->step : Vec2<double>{};
  pen.dot(at(stands), {{}, 9.0F, style.highlight_colour, render::DotShape::Round});
  for (const render::OverlayDot& dot : marks.dots) pen.dot(place(dot.point), dot);
}

}  // namespace dmoscope::ui
