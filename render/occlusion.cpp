#include "render/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/fill.h"

namespace dmoscope::render {
namespace {

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
  std::array<float, 16> to_clip_space{};
  std::ranges::transform(projection.matrix(), to_clip_space.begin(), [](double x) { return static_cast<float>(x); });
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
  program_.set("u_to_clip_space", to_clip_space);
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
