// Diagonal stripes, rising for inverted elements and falling for those without a value; they need some room. Included by shaders that need
// them.
uniform float u_hatch_period;     // pixels
uniform vec2 u_hatch_phase;       // phase of the rising and of the falling stripes, periods

// Whether a pixel belongs to a rising stripe, 0 or 1: about a third do.
float stripes(vec2 pixel) {
  float along = (pixel.x - pixel.y) / u_hatch_period + u_hatch_phase.x;
  return abs(fract(along) - 0.5) < 0.17 ? 1.0 : 0.0;
}

// Colour with stripes. fill: rgb; 1 inverted, 2 not defined, else plain. pixel: relative to the middle of the viewport. size: of the
// element, pixels.
vec3 hatched(vec4 fill, vec2 pixel, float size) {
  if (fill.a != 1.0 && fill.a != 2.0) return fill.rgb;
  float along = fill.a == 1.0 ? (pixel.x - pixel.y) / u_hatch_period + u_hatch_phase.x
                              : (pixel.x + pixel.y) / u_hatch_period + u_hatch_phase.y;
  float stripe = abs(fract(along) - 0.5) * u_hatch_period;  // distance from the stripe's middle, pixels along x
  float cover = clamp(0.16 * u_hatch_period - stripe + 0.7, 0.0, 1.0) * smoothstep(0.6, 1.6, size / u_hatch_period);
  return mix(fill.rgb, fill.rgb * 0.35, cover);
}
