// The studio floor, behind everything: it has the backdrop's own light, so that it has no end, less what the
// bodies keep away from it.
in vec2 place;
uniform vec3 eye;        // the eye relative to the middle of the floor [reach]
uniform vec3 ray, ray_x, ray_y; // of the picture's middle, and per unit of place [reach]
uniform vec2 shade_origin, shade_x, shade_y; // from the floor [reach] to the texture
uniform sampler2D shade;
uniform vec3 background; // sRGB
out vec4 pixel;

void main() {
  vec3 along = ray + place.x * ray_x + place.y * ray_y;
  float down = max(-along.z, 1e-6);
  vec2 at = eye.xy + along.xy * (eye.z / down);
  vec2 kept = texture(shade, shade_origin + at.x * shade_x + at.y * shade_y).xy;

  vec3 behind = backdrop(place, decode(background));
  float away = min(dot(at, at), 1.0);
  float pool = max(1.0 - 4.0 * away, 0.0); // of the key light, around the middle
  vec3 light = behind * (0.94 + 0.08 * pool * pool);
  light *= 1.0 - vec3(0.62, 0.59, 0.54) * kept.x;
  light *= 1.0 - 0.70 * kept.y;
  float fade = away * away * (3.0 - 2.0 * away);
  pixel = vec4(encode(mix(light, behind, fade)), 1.0);
}
