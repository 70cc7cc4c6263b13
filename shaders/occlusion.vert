// One triangle that covers the picture, and the depth of the floor behind it.
uniform vec3 floor_plane; // dot(floor_plane, (place, 1)): 1 over the floor's depth [1/m]; 0: no floor
uniform ivec2 end;        // the last pixel of the bodies' picture
uniform vec2 to_nearness;
noperspective out float floor_nearness;
flat out ivec2 last;
flat out vec2 nearness;
void main() {
  vec2 place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  floor_nearness = dot(floor_plane, vec3(place, 1.0));
  last = end;
  nearness = to_nearness;
  gl_Position = vec4(place, 1.0, 1.0);
}
