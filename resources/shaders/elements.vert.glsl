#include "fill.glsl"
layout(location = 0) in vec2 position;
out vec2 v_pixels;
#ifdef BY_CORNERS
out float v_value;
#endif

void main() {
  v_pixels = to_pixels(position);
#ifdef BY_CORNERS
  v_value = values[gl_VertexID];
#endif
  gl_Position = to_clip(v_pixels, 0.0);
}
