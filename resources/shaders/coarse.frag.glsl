flat in vec3 v_fill;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(v_fill, 1.0); }
