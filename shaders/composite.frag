// A pixel of the picture: the mean of the bodies' samples, darkened by occlusion, over the background.
//
// BODIES: 1 where there may be some. OCCLUDED: 1 with ambient occlusion. BEHIND: 0 nothing, 1 the backdrop, 2
// the floor without shadows, 3 the floor, 4 its shadows alone. SAMPLES of each of FINE x FINE pixels make one
// of the picture.
#if BEHIND
noperspective in vec2 place; // see composite.vert
flat in vec3 light;
#endif
#if BEHIND > 1
noperspective in vec3 on_floor;
#endif
#if BEHIND > 2
noperspective in vec2 in_shade;
uniform sampler2D shade;
#endif
#if SAMPLES == 1
#define Sampled sampler2D
#else
#define Sampled sampler2DMS
#endif
#if BODIES
uniform Sampled colours; // premultiplied by alpha
#endif
out vec4 pixel;

#if BODIES
vec4 bodies() {
  ivec2 at = ivec2(gl_FragCoord.xy) * FINE;
  vec4 sum = vec4(0.0);
  for (int j = 0; j < FINE; ++j)
    for (int i = 0; i < FINE; ++i)
      for (int k = 0; k < SAMPLES; ++k) sum += texelFetch(colours, at + ivec2(i, j), k);
  return sum / float(FINE * FINE * SAMPLES);
}
#endif

#if OCCLUDED
uniform Sampled depth;
uniform sampler2D kept;
uniform vec2 texel;       // of `kept`, in texture coordinates
uniform vec2 to_nearness; // see occlusion_depth.frag
uniform float tolerance;  // [1/m]

// The light that is not occluded: from the four nearest texels, weighted by equal depth.
vec3 open() {
  // of a pixel on an edge, the nearest depth: the farther part is darkened in its other pixels
  float stored = 1.0;
  ivec2 at = ivec2(gl_FragCoord.xy);
  for (int k = 0; k < SAMPLES; ++k) stored = min(stored, texelFetch(depth, at * FINE, k).x);
  float deep = 1.0 / (to_nearness.x + to_nearness.y * stored);

  const float back = 0.5 * float(PART) - float(PART / 2);
  vec2 spot = (vec2(at) + back) / float(PART) - 0.5;
  vec2 first = floor(spot), share = spot - first;
  float sum = 0.0, weights = 0.0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      vec2 other = texture(kept, (first + vec2(i, j) + 0.5) * texel).xy;
      float weight = (i == 0 ? 1.0 - share.x : share.x) * (j == 0 ? 1.0 - share.y : share.y) + 0.01;
      weight *= max(1.0 - abs(other.y - deep) * tolerance, 0.0) + 1e-4;
      sum += weight * other.x;
      weights += weight;
    }
  return encode(vec3(1.0 - sum / weights));
}
#endif

#if BEHIND
// Between -1/2 and 1/2 of a level, in a pattern of 4 x 4 pixels (Bayer 1973): without it, the backdrop shows
// bands that are a level apart.
float dither() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int x = at.x ^ at.y, y = at.y;
  int rank = (x & 1) << 3 | (y & 1) << 2 | (x & 2) | (y & 2) >> 1;
  return (float(rank) - 7.5) / (16.0 * 255.0);
}
#endif

#if BEHIND > 1
// What is left of the studio's light on its floor, linear: a pool of light, and the bodies' shadows.
vec3 on_the_floor() {
  float below = 1.0 / max(on_floor.z, 1e-6);
  vec2 at = on_floor.xy * below;
  float away = min(dot(at, at), 1.0);
#if BEHIND == 4
  vec3 left = vec3(1.0);
#else
  float pool = max(1.0 - 4.0 * away, 0.0); // of the key light, around the centre
  vec3 left = vec3(0.94 + 0.08 * pool * pool);
#endif
#if BEHIND > 2
  vec2 lost = texture(shade, in_shade * below).xy;
  left *= (1.0 - vec3(0.62, 0.59, 0.54) * lost.x) * (1.0 - 0.70 * lost.y);
#endif
  float fade = away * away * (3.0 - 2.0 * away);
  return mix(left, vec3(1.0), fade);
}
#endif

#if BEHIND == 4
// Black, as strong as the shadow is: over any picture it takes as much light as over the floor.
vec4 behind() { return vec4(vec3(0.0), 1.0 - encode(on_the_floor()).g); }
#elif BEHIND
// The studio floor has the same light as the backdrop, so that it has no visible end.
vec4 behind() {
  vec3 all = backdrop(place, light);
#if BEHIND > 1
  all *= on_the_floor();
#endif
  return vec4(encode(all) + dither(), 1.0);
}
#endif

void main() {
  pixel = vec4(0.0);
#if BODIES
  pixel = bodies();
#endif
#if OCCLUDED
  pixel.rgb *= open();
#endif
#if BEHIND
  pixel += (1.0 - pixel.a) * behind();
#endif
}
