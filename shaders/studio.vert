// One triangle that covers the picture, and what of the floor is seen in its corners. All of it is linear over the
// picture, and comes to the fragments interpolated: each number of a uniform costs them as much as six cycles.
uniform vec3 eye;               // relative to the middle of the floor [reach]
uniform vec3 ray, ray_x, ray_y; // of the picture's middle, and per unit of place [reach]
uniform vec2 shade_origin, shade_x, shade_y; // from the floor [reach] to the texture

noperspective out vec2 place; // corners of the picture at -1 and 1
noperspective out vec3 on_floor; // xy over z: where the floor is hit [reach]; z > 0 below the horizon
noperspective out vec2 in_shade; // over that z: the texture's coordinates there

void main() {
  place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vec3 along = ray + place.x * ray_x + place.y * ray_y;
  float down = -along.z;
  on_floor = vec3(eye.xy * down + eye.z * along.xy, down);
  in_shade = shade_origin * down + on_floor.x * shade_x + on_floor.y * shade_y;
  gl_Position = vec4(place, 1.0, 1.0);
}
