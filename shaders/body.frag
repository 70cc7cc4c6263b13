// Cloth and solids under a key light with a shadow, a fill light, the sky and what the ground throws back.
in vec3 to_eye;
in vec3 across;
in vec3 albedo;
in vec3 weight;
in vec3 in_shadow;
flat in vec3 half_width;
flat in vec3 torn;
flat in vec3 thin;
flat in vec3 crease;

uniform sampler2DShadow shadow;
uniform float shadow_spread; // of the taps, in texture coordinates
uniform vec3 key, fill, sky; // unit, towards the lights and up
uniform float back_tint;      // the far side's colour, relative to the near side's
uniform vec4 back;            // the far side's own colour, sRGB; w: 1 if it has one
uniform float transmission;   // of key light through a sheet
uniform float gloss, rim_light, wrap; // finish.h
uniform int sharpness;
uniform int filled; // 0: lines alone, multiplied by their alpha

out vec4 pixel;

// Four taps, each filtered over four texels by the hardware, on a turned square.
float lit() {
  vec2 a = shadow_spread * vec2(0.38, 0.92), b = vec2(-a.y, a.x);
  float sum = texture(shadow, vec3(in_shadow.xy + a, in_shadow.z)) +
              texture(shadow, vec3(in_shadow.xy - a, in_shadow.z)) +
              texture(shadow, vec3(in_shadow.xy + b, in_shadow.z)) +
              texture(shadow, vec3(in_shadow.xy - b, in_shadow.z));
  return 0.25 * sum;
}

// How much of the pixel is line (x: dark, y: torn). A barycentric coordinate over its slope is a distance in
// pixels; one over the slope is the height of the triangle: thin lines go where cells are only a few pixels
// wide.
vec2 lines() {
  vec3 dx = dFdx(weight), dy = dFdy(weight);
  vec3 height = inversesqrt(dx * dx + dy * dy + 1e-12);
  vec3 cover = clamp(half_width + 0.5 - weight * height, 0.0, 1.0);
  vec3 of_cells = 0.62 * clamp(height * 0.09 - 0.4, 0.0, 1.0);
  vec3 of_borders = min(clamp(height * 0.25 - 0.5, 0.0, 1.0) + torn, 1.0) * (1.0 - 0.25 * crease);
  cover *= mix(of_borders, of_cells, thin);
  vec3 dark = cover * (1.0 - torn), bright = cover * torn;
  return vec2(max(dark.x, max(dark.y, dark.z)), max(bright.x, max(bright.y, bright.z)));
}

void main() {
  vec3 n = normalize(across), v = normalize(to_eye);
  if (!gl_FrontFacing) n = -n;
  float to_key = dot(n, key), up = 0.5 + 0.5 * dot(n, sky), facing = max(dot(n, v), 0.0);
  // At the very rim both sides are the same, or a far side that shows by a sample would speckle it.
  float behind = gl_FrontFacing ? 0.0 : min(4.0 * facing, 1.0);
  vec3 surface = mix(albedo * mix(1.0, back_tint, behind), decode(back.rgb), back.w * behind);
  float direct = lit();

  vec2 line = lines();
  if (filled == 0) {
    float cover = max(line.x, line.y);
    pixel = vec4(encode(mix(0.6 * surface, vec3(1.0, 0.46, 0.09), line.y / max(cover, 1e-4))) * cover, cover);
    return;
  }
  surface *= 1.0 - 0.75 * line.x;
  surface = mix(surface, vec3(1.0, 0.46, 0.09), line.y);

  vec3 light = mix(vec3(0.15, 0.135, 0.13), vec3(0.33, 0.36, 0.41), up);
  light += vec3(1.18, 1.12, 1.02) * (direct * (max((to_key + wrap) / (1.0 + wrap), 0.0) + transmission * max(-to_key, 0.0)));
  light += vec3(0.17, 0.18, 0.21) * max(dot(n, fill), 0.0);
  light = mix(light, vec3(1.0), 0.8 * line.y); // a torn edge shows in the shade too

  float rim = 1.0 - facing;
  rim *= rim * rim;
  float sheen = max(dot(reflect(-v, n), key), 0.0);
  for (int n = 0; n < sharpness; ++n) sheen *= sheen;
  vec3 shine = (0.4 * rim_light * rim * up) * vec3(0.9, 0.95, 1.0) + (gloss * sheen * direct);
  pixel = vec4(encode(surface * (light + rim * rim_light * up) + shine * (1.0 - line.x)), 1.0);
}
