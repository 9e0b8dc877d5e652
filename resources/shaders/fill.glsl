// Colour of an element or of a corner, and which elements count. Included by shaders that need it.
layout(std430, binding = 1) readonly buffer Shades { float shades[]; };    // quality by element, see shade_of
layout(std430, binding = 2) readonly buffer Order { uint order[]; };       // element of each drawn index
layout(std430, binding = 5) readonly buffer Values { float values[]; };    // values shown instead of quality, by element or by vertex
layout(std430, binding = 6) readonly buffer Members { uint members[]; };   // two bits an element: it is a member, it is tinted
uniform int u_by;              // 0 quality, 1 values of elements, 2 values of vertices
uniform int u_categories;      // number of categories that the values are numbers of; 0: they go through the map
uniform sampler2D u_colours;   // the map
uniform sampler2D u_palette;   // colours of categories
uniform vec2 u_range;          // values of the first and of the last colour of the map
uniform vec4 u_inverted_colour;
uniform vec4 u_undefined_colour;
uniform vec4 u_neutral_colour;  // colour of no category
uniform vec4 u_filter;          // lowest and highest quality that counts; 1: the filter is on; 1: inverted elements count
uniform int u_has_members;
uniform vec4 u_tint;            // straight alpha; 0: nothing is tinted

bool has_bit(uint element, uint bit) { return (members[element / 16u] >> (2u * (element % 16u) + bit) & 1u) != 0u; }

bool counts(uint element) {
  if (u_has_members != 0 && !has_bit(element, 0u)) return false;
  if (u_filter.z == 0.0) return true;
  float shade = shades[element];
  if (shade < -1e38) return u_filter.w != 0.0;
  return shade >= u_filter.x && shade <= u_filter.y;
}

bool inverted(uint element) { return shades[element] < -1e38; }

// Colour of a value: rgb; 0 plain, 2 not defined.
vec4 colour_of(float value) {
  if (value > 1e38) return vec4(u_undefined_colour.rgb, 2.0);
  if (u_categories > 0) {
    int category = int(floor(value + 0.5));
    if (category < 0) return vec4(u_neutral_colour.rgb, 0.0);
    return vec4(texelFetch(u_palette, ivec2(min(category, u_categories - 1), 0), 0).rgb, 0.0);
  }
  int last = textureSize(u_colours, 0).x - 1;
  float t = clamp((value - u_range.x) / (u_range.y - u_range.x), 0.0, 1.0);
  return vec4(texelFetch(u_colours, ivec2(int(t * float(last) + 0.5), 0), 0).rgb, 0.0);
}

// Colour of an element, unless it is coloured corner by corner: rgb; 0 plain, 1 inverted, 2 not defined.
vec4 fill_of(uint element) {
  vec4 fill = inverted(element) ? vec4(u_inverted_colour.rgb, 1.0) : colour_of(u_by == 1 ? values[element] : shades[element]);
  if (u_tint.a > 0.0 && has_bit(element, 1u)) fill.rgb = mix(fill.rgb, u_tint.rgb, u_tint.a);
  return fill;
}
