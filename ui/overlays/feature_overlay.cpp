#include "ui/overlays/marks.h"
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

}  // namespace dmoscope::ui
