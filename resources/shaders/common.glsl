// Common uniforms and functions, put before every stage. Pixels are relative to the middle of the viewport, y up.
uniform vec2 u_offset_high;  // the camera's centre relative to the scene's, in two floats: nothing jitters far from it
uniform vec2 u_offset_low;
uniform float u_zoom;      // pixels per unit of the plane
uniform vec2 u_viewport;   // pixels
uniform float u_widest;    // pixels; wider elements lie across the seam of a mesh that wraps, and are not drawn

vec2 to_pixels(vec2 point) {
  precise vec2 coarse = point - u_offset_high;
  precise vec2 fine = coarse - u_offset_low;
  return fine * u_zoom;
}

vec4 to_clip(vec2 pixels, float depth) { return vec4(pixels * 2.0 / u_viewport, depth, 1.0); }
