// Faces of volume elements, where they are. Included by those that need it.
struct Face {
  uint corners[4];  // the last of a triangle: 0xffffffff less 1, 2, 4 for every edge that is none (from its first, second, third corner)
  uint element;
};
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };  // relative to the middle of the mesh
layout(std430, binding = 3) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 4) readonly buffer Means { float means[]; };  // of an element's corners; only while elements are shrunk
uniform mat4 u_to_clip_space;
uniform vec4 u_eye;     // where it is, 1; or the direction towards it, 0
uniform vec4 u_light;   // the direction towards it
uniform float u_shading; // 1: faces are lit; 0: their colours tell their values alone
uniform vec4 u_plane;   // clip plane: normal, offset; what is beyond is not drawn
uniform float u_shrink; // about the means; 1: not at all
uniform int u_sides;    // 1: the skin of what is seen is closed; 2: both sides of a surface are seen

bool is_triangle(Face face) { return face.corners[3] >= 0xfffffff0u; }

vec3 corner_of(Face face, uint i) {
  uint v = 3u * face.corners[i];
  vec3 point = vec3(positions[v], positions[v + 1u], positions[v + 2u]);
  if (u_shrink == 1.0) return point;
  uint m = 3u * face.element;
  return mix(vec3(means[m], means[m + 1u], means[m + 2u]), point, u_shrink);
}

float kept_by_plane(vec3 point) { return u_plane.w - dot(u_plane.xyz, point); }

vec3 towards_eye(vec3 point) { return u_eye.w > 0.0 ? normalize(u_eye.xyz - point) : u_eye.xyz; }

// Where the skin of what is seen is closed, faces that look away are hidden by others. Not those of inverted elements, whose outside is inside.
bool looks_away(vec3 a, vec3 b, vec3 c, vec3 d) {
  vec3 to_eye = u_eye.w > 0.0 ? u_eye.xyz - a : u_eye.xyz;
  return dot(cross(b - a, c - a), to_eye) < 0.0 && dot(cross(c - a, d - a), to_eye) <= 0.0;
}

bool hidden_by_others(bool away, bool is_inverted) { return u_sides == 1 && away && !is_inverted; }

// A surface is a little darker where its elements look away.
float side_brightness(bool away, bool is_inverted) { return u_sides == 2 && away && !is_inverted ? 0.8 : 1.0; }

// A light beside the eye: faces that are turned away are darker, none is dark.
float brightness(vec3 normal, vec3 middle) {
  if (u_shading == 0.0) return 1.0;
  vec3 to_eye = towards_eye(middle);
  float size = length(normal);
  vec3 towards = size > 0.0 ? normal / size : to_eye;
  if (dot(towards, to_eye) < 0.0) towards = -towards;
  return 0.70 + 0.30 * max(dot(towards, u_light.xyz), 0.0);
}
