// The studio floor, behind everything: it has the backdrop's own light, so that it has no end, less what the
// bodies keep away from it.
noperspective in vec2 place;
noperspective in vec3 on_floor;
noperspective in vec2 in_shade;
uniform sampler2D shade;
uniform vec3 background; // sRGB
out vec4 pixel;

void main() {
  float below = 1.0 / max(on_floor.z, 1e-6);
  vec2 at = on_floor.xy * below;
  vec2 kept = texture(shade, in_shade * below).xy;

  float away = min(dot(at, at), 1.0);
  float pool = max(1.0 - 4.0 * away, 0.0); // of the key light, around the middle
  vec3 left = (1.0 - vec3(0.62, 0.59, 0.54) * kept.x) * ((1.0 - 0.70 * kept.y) * (0.94 + 0.08 * pool * pool));
  float fade = away * away * (3.0 - 2.0 * away);
  pixel = vec4(encode(backdrop(place, decode(background)) * mix(left, vec3(1.0), fade)), 1.0);
}
