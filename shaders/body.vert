// A corner of a triangle: three in a row are a triangle, so that a corner knows which one it is.
layout(location = 0) in vec3 position; // [m]
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;   // sRGB
layout(location = 3) in uvec4 line;    // [k]: kind of line along the side opposite to corner k

uniform mat4 world_to_clip;
uniform mat4 world_to_shadow; // to the texture: [0, 1]³
uniform vec3 eye;             // [m]
uniform vec3 key;             // unit, towards the key light
uniform float shadow_offset;  // how far a point steps out of its own shadow [m]
uniform float line_scale;     // pixels per pixel of a picture 720 high
uniform int cells;            // 1: lines between cells are drawn
uniform float hidden_below;   // height under which nothing is seen: under the floor [m]

out vec3 to_eye;
out vec3 across; // the normal
out vec3 albedo; // linear
out vec3 weight; // barycentric coordinates
out vec3 in_shadow;
flat out vec3 half_width; // of the line opposite to each corner [pixels]; negative: no line
flat out vec3 torn;       // 1 where that line is a torn edge
flat out vec3 thin;       // 1 where it lies between cells
flat out vec3 crease;     // 1 where it is a sharp edge of a solid

void main() {
  gl_Position = world_to_clip * vec4(position, 1.0);
  gl_ClipDistance[0] = position.z - hidden_below;
  to_eye = eye - position;
  across = normal;
  albedo = decode(colour.rgb);
  int corner = gl_VertexID % 3;
  weight = vec3(corner == 0, corner == 1, corner == 2);
  for (int k = 0; k < 3; ++k) {
    uint kind = line[k];
    torn[k] = float(kind == 3u);
    thin[k] = float(kind == 1u);
    crease[k] = float(kind == 4u);
    half_width[k] = kind == 3u ? 1.7 : kind == 2u ? 1.2 : cells == 0 ? -8.0 : kind == 4u ? 0.9 : kind == 1u ? 0.55 : -8.0;
  }
  half_width *= line_scale;
  float facing = dot(normal, key);
  vec3 step_out = normal * (facing >= 0.0 ? shadow_offset : -shadow_offset);
  in_shadow = (world_to_shadow * vec4(position + step_out, 1.0)).xyz;
}
