// Shared by all shaders. Light is added in linear colours; the sRGB curve is approximated by a square and its
// inverse by a square root, which is close enough to the eye and costs a quarter of two powers.

vec3 decode(vec3 colour) { return colour * colour; }
vec3 encode(vec3 light) { return sqrt(light); }

// The studio's backdrop at a place of the picture (corners at -1 and 1), linear: lightest a little above the
// centre, and darker towards the corners.
vec3 backdrop(vec2 place, vec3 background) {
  vec2 from = place - vec2(0.0, 0.15);
  float fall = dot(from * from, vec2(0.11, 0.16));
  return background * (1.0 - fall);
}

// Smooth interpolation of a pyramid level: its texels are large, and bilinear interpolation would show as
// scallops.
vec2 smoothly(sampler2D pyramid, vec2 at, float level) {
  vec2 a = vec2(0.5, 0.5) * exp2(level) / vec2(textureSize(pyramid, 0)), b = vec2(-a.x, a.y);
  return 0.25 * (textureLod(pyramid, at + a, level).xy + textureLod(pyramid, at - a, level).xy +
                 textureLod(pyramid, at + b, level).xy + textureLod(pyramid, at - b, level).xy);
}
