// Marks of where vertices slide, and of inverted elements.
#include <cmath>

#include "render/colour_map.h"
#include "ui/overlays/overlay.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

constexpr float kLine = 2.0F, kCasing = 4.5F, kSquare = 7.0F, kFound = 4.0F, kFoundCasing = 7.5F;  // pixels at scale 1

class FeatureOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return domain_of(in) != nullptr || in.state.edge_under_mouse; }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const std::span<const Vec3> positions = in.frame().positions;
    const Palette& colours = palette(in.state.theme);
    if (const Domain* domain = domain_of(in))
      add_features(marks, view, *domain, positions, {solid(colours.text), solid(colours.background, 200)});
    const auto& edge = in.state.edge_under_mouse;
    if (!edge || (*edge)[1] >= positions.size()) return;
    CasedLines(marks, in.inks(230)).add(view.points.at(positions[(*edge)[0]]), view.points.at(positions[(*edge)[1]]), kFound, kFoundCasing);
  }

 private:
  /// Domain of the run on show if its vertices slide and this is to be shown; else null.
  [[nodiscard]] static const Domain* domain_of(const OverlayInput& in) {
    return in.state.features && in.run() != nullptr ? in.run()->domain.get() : nullptr;
  }
};

class InvertedOverlay final : public Overlay {
 public:
  /// Diamonds are for planar meshes: in space they would lie over what hides the element.
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    return !in.input().in_space() && !in.searching && in.frame().shown_statistics.inverted > 0;
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    if (inverted_of_ != in.frame().serial) inverted_ = inverted_elements(in.frame());
    inverted_of_ = in.frame().serial;
    add_inverted(marks, view, in.frame(), inverted_);
  }

 private:
  std::vector<Index> inverted_;  // inverted elements of the frame with this serial
  std::uint64_t inverted_of_ = 0;
};

}  // namespace

void add_features(render::Marks& marks, const MarkView& view, const Domain& domain, std::span<const Vec3> positions, Inks inks) {
  CasedLines lines(marks, inks);
  for (const EdgeEnds& edge : domain.feature_edges())
    if (view.sees(edge, positions)) lines.add(view.points.at(positions[edge[0]]), view.points.at(positions[edge[1]]), kLine, kCasing);
  for (Index v = 0; v < positions.size(); ++v)
    if (domain.is_held(v) && view.sees(v, positions))
      marks.dots.push_back({view.points.at(positions[v]), kSquare, inks.ink, render::DotShape::Square});
}

OverlayPointer feature_overlay() { return std::make_unique<FeatureOverlay>(); }

std::vector<Index> inverted_elements(const Frame& frame) {
  std::vector<Index> found;
  for (Index e = 0; e < frame.inverted.size(); ++e)
    if (frame.inverted[e] != 0) found.push_back(e);
  const std::size_t stride = (found.size() + kMostMarks - 1) / kMostMarks;
  for (std::size_t k = 1; stride > 1 && k * stride < found.size(); ++k) found[k] = found[k * stride];
  if (stride > 1) found.resize((found.size() + stride - 1) / stride);
  return found;
}

void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements) {
  constexpr double kSmall = 8.0, kApart = 16.0;  // pixels at scale 1
  PlacesTaken taken(view, kApart);
  for (const Index e : elements) {
    render::Bounds3 box;
    const auto corners = frame.input->mesh.elements.corners(e);
    for (const Index v : corners) box.include(view.points.at(frame.positions[v], frame.positions[corners[0]]));
    const Vec3 middle = box.centre();
    if (view.pixels(box.low, box.high) <= kSmall && view.view.holds(middle) && taken.take(middle))
      marks.dots.push_back({middle, static_cast<float>(kSmall), solid(render::kInvertedColour), render::DotShape::Diamond});
  }
}

OverlayPointer inverted_overlay() { return std::make_unique<InvertedOverlay>(); }

}  // namespace dmoscope::ui
