// A corner of a triangle: three consecutive ones are a triangle, so that a corner knows which one it is.
//
// Each component of a uniform that a fragment reads costs llvmpipe a gather of eight, some 25 cycles; so
// fragments have none. What is constant in a draw call is passed flat, which is one instruction per component,
// and products with constant directions are computed here, since they are linear over a triangle.
layout(location = 0) in vec3 position; // [m]
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;   // sRGB
layout(location = 3) in uvec4 line;    // [k]: kind of line along the side opposite to corner k
#if FRONT || BACK || ROUGHNESS
layout(location = 4) in vec2 place;    // in the picture
#endif

uniform mat4 world_to_clip;
uniform mat4 world_to_shadow; // to the texture: [0, 1]³
uniform vec3 eye;             // [m]
uniform vec3 key, fill, sky;  // unit, towards the lights and up
uniform float shadow_offset;  // shadow bias: offset of a point towards the light [m]
uniform float line_scale;     // relative to a picture of height 720 pixels
uniform int cells;            // 1: lines between cells are drawn
uniform float torn_reach;     // half the width of torn edges [pixels]; 0: they are not drawn
uniform float hidden_below;   // height below which nothing is visible: under the floor [m]
uniform vec4 finish;          // finish.h: gloss, rim, transmission, wrap / (1 + wrap)
uniform vec3 sheen;           // 1 for each squaring of the sheen: once, twice more, four times more
uniform vec4 far_colour;      // the far side's own colour, sRGB; w: share of the near side's colour

out vec4 to_eye;    // [m]; w: dot product with key
out vec4 across;    // the normal; w: dot product with key
out vec4 albedo;    // linear; w: first barycentric coordinate
out vec4 in_shadow; // w: second barycentric coordinate
out vec2 turned;    // dot products of the normal with sky and fill
// For the line opposite to each corner: half its width plus half a pixel [pixels]; how it fades where the
// triangle is low: its strength is ink times slope x height + start, clamped to [0, 1]; ink is negative for
// torn edges. w: finish
flat out vec4 reach, slope, start, ink;
flat out vec4 far_side; // linear; w: far_colour.w
flat out vec3 squares;  // sheen
#if FRONT || ROUGHNESS
out vec2 on_front;
#endif
#if BACK
uniform float back_height; // v - 1/2 in the picture of the back, over that in the front's
out vec2 on_back;
#endif

// The line of that kind: half width [pixels], slope [1/pixel], start, ink.
vec4 line_of(uint kind) {
  if (kind == 3u && torn_reach > 0.0)
    return vec4(torn_reach, 0.0, 1.0, -1.0); // torn: independent of the triangle's height
  if (kind == 2u) return vec4(1.2, 0.25, -0.5, 1.0); // a border
  if (cells == 1 && kind == 4u) return vec4(0.9, 0.25, -0.5, 0.75); // a crease
  if (cells == 1 && kind == 1u) return vec4(0.55, 0.09, -0.4, 0.62); // between cells
  return vec4(-8.0, 0.0, 0.0, 0.0);
}

void main() {
  gl_Position = world_to_clip * vec4(position, 1.0);
  gl_ClipDistance[0] = position.z - hidden_below;
  int corner = gl_VertexID % 3;
  float facing = dot(normal, key);
  vec3 step_out = normal * (facing >= 0.0 ? shadow_offset : -shadow_offset);
  to_eye = vec4(eye - position, dot(eye - position, key));
  across = vec4(normal, facing);
  albedo = vec4(decode(colour.rgb), corner == 0);
  in_shadow = vec4((world_to_shadow * vec4(position + step_out, 1.0)).xyz, corner == 1);
  turned = vec2(dot(normal, sky), dot(normal, fill));

  mat3x4 lines = mat3x4(line_of(line.x), line_of(line.y), line_of(line.z));
  mat4x3 parts = transpose(lines);
  reach = vec4(parts[0] * line_scale + 0.5, finish.x);
  slope = vec4(parts[1], finish.y);
  start = vec4(parts[2], finish.z);
  ink = vec4(parts[3], finish.w);
  far_side = vec4(decode(far_colour.rgb), far_colour.w);
  squares = sheen;
#if FRONT || ROUGHNESS
  on_front = place;
#endif
#if BACK // seen from behind it reads from left to right
  on_back = vec2(1.0 - place.x, 0.5 + back_height * (place.y - 0.5));
#endif
}
