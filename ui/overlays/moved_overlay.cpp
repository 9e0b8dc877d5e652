// Marks of how vertices have moved, and of those that move next.
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "ui/overlays/moves.h"
#include "ui/overlays/overlay.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr std::size_t kMostGhosts = 90'000;  // edges; more would be a grey veil

std::string_view since(Reference reference) {
  constexpr std::array<std::string_view, 5> kNames{"", "the input", "the last step", "A", "B"};  // in the order of Reference
  return kNames[static_cast<std::size_t>(reference)];
}
std::string why_not(Reference reference) {
  return reference == Reference::Previous ? "nothing has moved yet" : fmt::format("{} is not marked", since(reference));
}

class GhostOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.positions_of(in.state.stepping.ghost).has_value(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const auto seen = view.unhidden ? view.unhidden : in.scene->unhidden(in.camera, view.view.viewport());
    too_fine_ = !seen || seen->edges.size() > kMostGhosts;
    if (!too_fine_)  // the wireframe is dark in all themes
      add_ghost(marks, view, *in.positions_of(in.state.stepping.ghost), in.frame().positions, seen->edges,
                {{255, 255, 255, 255}, {16, 18, 22, 150}});
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    const Reference of = in.state.stepping.ghost;
    if (of == Reference::None) return {};
    if (!wanted(in)) return fmt::format("no ghost: {}", why_not(of));
    return too_fine_ ? std::string("ghost: zoom in to see it") : fmt::format("ghost of {}", since(of));
  }

 private:
  bool too_fine_ = false;
};

class ArrowOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.positions_of(in.state.stepping.arrows).has_value(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const auto from = *in.positions_of(in.state.stepping.arrows);
    const std::span<const Vec3> to = in.frame().positions;
    const std::tuple key{from.data(), to.data(), in.previous ? in.previous->serial : 0, in.frame().serial};
    if (moved_of_ != key) moved_ = Displacements(view.points, from, to);
    moved_of_ = key;
    factor_ = arrow_factor(view, moved_, in.state.stepping.arrow_scale);
    added_ = add_arrows(marks, view, moved_, factor_, in.inks(230));
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    const Reference of = in.state.stepping.arrows;
    if (of == Reference::None) return {};
    if (!wanted(in)) return fmt::format("no arrows: {}", why_not(of));
    if (in.state.in_space && added_.drawn == 0) {
      const bool cut = in.state.inside.clip.on && in.state.inside.clip.mode == ClipPlane::Mode::Cut;
      return fmt::format("arrows: no visible vertex has moved since {}{}", since(of),
                         cut ? "; whole cells show more of them than cut ones" : "");
    }
    return fmt::format("{}arrows × {:.3g} since {}", added_.left_out > 0 ? "longest " : "", factor_, since(of));
  }

 private:
  Displacements moved_;
  std::tuple<const Vec3*, const Vec3*, std::uint64_t, std::uint64_t> moved_of_;
  double factor_ = 1.0;  // factor of the arrows drawn last
  ArrowsAdded added_;    // counts of the arrows drawn last
};

class NextClassOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return !class_of(in).vertices.empty(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const std::span<const Index> vertices = class_of(in).vertices;
    const render::Rgba accent = in.inks(0).ink;
    add_dots(marks, view, in.input(), in.frame().positions, vertices, accent, 8.0);
    if (in.scene->sees_vertex(vertices.front())) add_ring(marks, view, in.frame().positions[vertices.front()], 20.0F, accent);
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    const NextClass next = class_of(in);
    return next.number == 0 ? "" : fmt::format("next: class {} of {}, {} vertices", next.number, next.count, count(next.vertices.size()));
  }

 private:
  static NextClass class_of(const OverlayInput& in) {
    const bool any = in.state.stepping.next_class && in.run() != nullptr && in.run()->colouring;
    return any ? next_class(*in.run()->colouring, in.frame().moment.visits) : NextClass{};
  }
};

}  // namespace

OverlayPointer ghost_overlay() { return std::make_unique<GhostOverlay>(); }
OverlayPointer arrow_overlay() { return std::make_unique<ArrowOverlay>(); }
OverlayPointer next_class_overlay() { return std::make_unique<NextClassOverlay>(); }

}  // namespace dmoscope::ui
