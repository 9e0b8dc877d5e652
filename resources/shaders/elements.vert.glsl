layout(location = 0) in vec2 position;
out vec2 v_pixels;

void main() {
  v_pixels = to_pixels(position);
  gl_Position = to_clip(v_pixels, 0.0);
}
