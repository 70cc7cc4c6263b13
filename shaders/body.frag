// Cloth and solids under a key light with a shadow, a fill light, the sky and light reflected by the ground.
// TORN: the colour of torn edges, linear. FRONT, BACK: pictures take the place of the colours of either side;
// CUT_OUT: that of the front has holes. Their texels are decoded already, and multiplied by alpha
// (render/draw/uploaded_textures.h). ROUGHNESS: a picture says how rough the surface is.
in vec4 to_eye; // see body.vert
in vec4 across;
in vec4 albedo;
in vec4 in_shadow;
in vec2 turned;
flat in vec4 reach, slope, start, ink;
flat in vec4 far_side;
flat in vec3 squares;

uniform sampler2DShadow shadow;
#if FRONT || ROUGHNESS
in vec2 on_front;
#endif
#if FRONT
uniform sampler2D front;
#endif
#if ROUGHNESS
uniform sampler2D roughness;
#endif
#if BACK
in vec2 on_back;
uniform sampler2D back;
#endif

out vec4 pixel;

float tap(float x, float y) {
  return texture(shadow, vec3(in_shadow.xy + SHADOW_SPREAD * vec2(x, y), in_shadow.z));
}

// Eight taps, each filtered over four texels by the hardware: one in each row and each column of a grid of
// 8 x 8, so that the edge of a shadow along x or y falls in eight even steps.
float lit() {
  return 0.125 * (tap(-1.0, -0.714) + tap(-0.714, 0.143) + tap(-0.429, 1.0) + tap(-0.143, 0.429) +
                  tap(0.143, -0.429) + tap(0.429, 0.714) + tap(0.714, -1.0) + tap(1.0, -0.143));
}

// How much of the pixel is covered by lines (x: dark, y: torn). A barycentric coordinate divided by its slope
// is a distance in pixels; 1 over the slope is the height of the triangle: thin lines fade out where cells are
// only a few pixels wide.
vec2 lines() {
  vec3 weight = vec3(albedo.w, in_shadow.w, 1.0 - albedo.w - in_shadow.w);
  vec2 x = dFdx(weight.xy), y = dFdy(weight.xy);
  vec3 dx = vec3(x, x.x + x.y), dy = vec3(y, y.x + y.y);
  vec3 height = inversesqrt(dx * dx + dy * dy + 1e-12);
  vec3 cover = clamp(reach.xyz - weight * height, 0.0, 1.0);
  cover *= clamp(slope.xyz * height + start.xyz, 0.0, 1.0) * ink.xyz;
  return vec2(max(max(cover.x, cover.y), max(cover.z, 0.0)), -min(min(cover.x, cover.y), min(cover.z, 0.0)));
}

// The power of the cosine `sheen` for the finish alone.
float highlight(float sheen) {
  if (squares.x > 0.5) sheen *= sheen;
  float squared = sheen * sheen;
  if (squares.y > 0.5) sheen = squared * squared;
  squared = sheen * sheen;
  squared *= squared;
  squared *= squared;
  return squares.z > 0.5 ? squared * squared : sheen;
}

void main() {
#if FRONT
  vec4 texel = texture(front, on_front);
#if CUT_OUT
  vec3 own = texel.rgb / max(texel.a, 0.25);
#else
  vec3 own = texel.rgb;
#endif
#else
  vec3 own = albedo.rgb;
#endif
  float near = inversesqrt(dot(to_eye.xyz, to_eye.xyz)), unit = inversesqrt(dot(across.xyz, across.xyz));
  if (!gl_FrontFacing) unit = -unit;
  float to_key = unit * across.w, up = 0.5 + 0.5 * (unit * turned.x);
  float to_viewer = unit * near * dot(across.xyz, to_eye.xyz), facing = max(to_viewer, 0.0);
  // At the silhouette both sides are shaded alike, or samples of the far side would speckle it.
  float behind = gl_FrontFacing ? 0.0 : min(4.0 * facing, 1.0);
#if BACK
  vec3 surface = mix(own, texture(back, on_back).rgb, behind);
#else
  vec3 surface = own * (1.0 + behind * (far_side.w - 1.0)) + behind * far_side.rgb;
#endif

  vec2 line = lines();
#if WIRES // lines only, with premultiplied alpha
  float cover = max(line.x, line.y);
  pixel = vec4(encode(mix(0.6 * surface, TORN, line.y / max(cover, 1e-4))) * cover, cover);
#else
  surface *= 1.0 - 0.75 * line.x;
  surface = mix(surface, TORN, line.y);

  float gloss = reach.w, rim_light = slope.w, transmission = start.w, wrap = ink.w;
  float direct = lit();
  vec3 light = mix(vec3(0.15, 0.135, 0.13), vec3(0.33, 0.36, 0.41), up);
  light += vec3(1.18, 1.12, 1.02) *
           (direct * (max(to_key * (1.0 - wrap) + wrap, 0.0) + transmission * max(-to_key, 0.0)));
  light += vec3(0.17, 0.18, 0.21) * max(unit * turned.y, 0.0);
  light = mix(light, vec3(1.0), 0.8 * line.y); // a torn edge is visible in the shadow too

  float rim = 1.0 - facing;
  rim *= rim * rim;
  float sheen = max(2.0 * to_viewer * to_key - near * to_eye.w, 0.0); // towards the reflected key light
  // The lamp itself, seen in what is glazed: a bright spot with an edge.
  vec3 shine = vec3(gloss * gloss * clamp(40.0 * sheen - 38.4, 0.0, 0.6));
#if ROUGHNESS // finish.h
  float least = 2.0 / ((1.0 + squares.x) * (1.0 + 3.0 * squares.y) * (1.0 + 15.0 * squares.z) + 2.0);
  float wide = mix(sqrt(least), 0.8, texture(roughness, on_front).r);
  wide *= wide;
  float fainter = least / wide;
  shine *= fainter * fainter;
  sheen = fainter * exp2((2.0 / wide - 2.0) * log2(max(sheen, 1e-6)));
#else
  sheen = highlight(sheen);
#endif
  shine = (shine + gloss * sheen) * direct + (0.4 * rim_light * rim * up) * vec3(0.9, 0.95, 1.0);
  pixel = vec4(encode(surface * (light + rim * rim_light * up) + shine * (1.0 - line.x)), 1.0);
#endif
#if CUT_OUT
  if (texel.a < 0.5) discard;
#endif
}
