// Rectangles of the picture, and the points of the floor seen at their corners. All of it is linear over the
// picture and is passed to fragments interpolated or flat: each component of a uniform costs them some 25
// cycles.
layout(location = 0) in vec2 at; // corners of the picture at -1 and 1
#if BEHIND
uniform vec3 background; // sRGB
flat out vec3 light;     // linear
noperspective out vec2 place; // corners of the picture at -1 and 1
#endif
#if BEHIND > 1
uniform vec3 eye;               // relative to the centre of the floor [reach]
uniform vec3 ray, ray_x, ray_y; // of the picture's centre, and per unit of place [reach]
noperspective out vec3 on_floor; // xy over z: where the floor is hit [reach]; z > 0 below the horizon
#endif
#if BEHIND > 2
uniform vec2 shade_origin, shade_x, shade_y; // from the floor [reach] to the texture
noperspective out vec2 in_shade; // times that z: the texture's coordinates there
#endif

void main() {
#if BEHIND
  light = decode(background);
  place = at;
#endif
#if BEHIND > 1
  vec3 along = ray + at.x * ray_x + at.y * ray_y;
  float down = -along.z;
  on_floor = vec3(eye.xy * down + eye.z * along.xy, down);
#endif
#if BEHIND > 2
  in_shade = shade_origin * down + on_floor.x * shade_x + on_floor.y * shade_y;
#endif
  gl_Position = vec4(at, 1.0, 1.0);
}
