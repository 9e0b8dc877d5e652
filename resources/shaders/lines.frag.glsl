noperspective in vec2 v_pixels;
flat in vec4 v_ends;
flat in vec4 v_colour;
flat in float v_half_width;
layout(location = 0) out vec4 colour;

void main() {
  vec2 along = v_ends.zw - v_ends.xy;
  float t = clamp(dot(v_pixels - v_ends.xy, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  float outside = distance(v_pixels, v_ends.xy + t * along);
  // A line thinner than a pixel is drawn fainter.
  float cover = clamp(v_half_width + 0.5 - outside, 0.0, 1.0) * min(1.0, 2.0 * v_half_width);
  float alpha = cover * v_colour.a;
  if (alpha <= 0.0) discard;
  colour = vec4(v_colour.rgb * alpha, alpha);
}
