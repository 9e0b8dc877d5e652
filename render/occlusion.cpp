#include "render/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/fill.h"

namespace dmoscope::render {
namespace {

/// Inverse of an invertible 4 x 4 matrix, column after column, by Gauss-Jordan elimination.
std::array<double, 16> inverse_of(std::array<double, 16> m) {
  std::array<double, 16> inverse{};
  for (std::size_t i = 0; i < 4; ++i) inverse[5 * i] = 1.0;
  const auto swap_rows = [](std::array<double, 16>& of, std::size_t a, std::size_t b) {
    for (std::size_t c = 0; c < 4; ++c) std::swap(of[4 * c + a], of[4 * c + b]);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < 4; ++r)
      if (std::abs(m[4 * i + r]) > std::abs(m[4 * i + pivot])) pivot = r;
    swap_rows(m, i, pivot);
    swap_rows(inverse, i, pivot);
    const double scale = 1.0 / m[5 * i];
    for (std::size_t c = 0; c < 4; ++c) {
      m[4 * c + i] *= scale;
      inverse[4 * c + i] *= scale;
    }
    for (std::size_t r = 0; r < 4; ++r) {
      const double times = r == i ? 0.0 : m[4 * i + r];
      for (std::size_t c = 0; c < 4 && times != 0.0; ++c) {
        m[4 * c + r] -= times * m[4 * c + i];
        inverse[4 * c + r] -= times * inverse[4 * c + i];
      }
    }
  }
  return inverse;
}

Handle<DeleteFramebuffer> make_framebuffer() {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateFramebuffers(1, &id));
  return Handle<DeleteFramebuffer>(id);
}

}  // namespace

OcclusionPainter::OcclusionPainter()
    : program_({"occlusion.vert.glsl", {}, "occlusion.frag.glsl"}), nothing_(make_array()), colours_(make_framebuffer()) {}

int OcclusionPainter::reach(Vec2<double> viewport, const Style& style) {
  const auto scale = static_cast<double>(style.scale);
  return static_cast<int>(std::lround(std::clamp(0.03 * viewport.y, 8.0 * scale, 40.0 * scale)));
}

void OcclusionPainter::darken(Framebuffer& target, const Projection& projection, int reach, const Style& style) const {
  std::array<float, 16> from_clip_space{};
  std::ranges::transform(inverse_of(projection.matrix()), from_clip_space.begin(), [](double x) { return static_cast<float>(x); });
  DMOSCOPE_GL(glNamedFramebufferTexture(colours_.id(), GL_COLOR_ATTACHMENT0, target.texture(), 0));
  DMOSCOPE_GL(glBindFramebuffer(GL_FRAMEBUFFER, colours_.id()));
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
  program_.use();
  DMOSCOPE_GL(glBindTextureUnit(0, target.depth_texture()));
  program_.set("u_depth", 0);
  program_.set("u_viewport", Vec2<float>{static_cast<float>(target.width()), static_cast<float>(target.height())});
  program_.set("u_from_clip_space", from_clip_space);
  program_.set("u_reach", static_cast<float>(reach));
  program_.set("u_line", 1.25F * style.scale);
  program_.set("u_line_strength", kEdgeDarkened);
  program_.set("u_most", kMostDarkened);
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
  DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, 3));
  glDisable(GL_BLEND);
  target.bind();
}

}  // namespace dmoscope::render
