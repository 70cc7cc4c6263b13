// The mean over a block of 4 x 4 pixels, which together have all slices and offsets, of those on the same
// surface: x; y: depth.
uniform sampler2D kept;
uniform vec2 texel; // in texture coordinates
uniform float first; // of the block, along each axis: -2, or -1 where -2 came before
uniform float tolerance; // [1/m]: 1 over the largest distance from the surface
out vec4 pixel;

vec2 at(vec2 away) { return texture(kept, (gl_FragCoord.xy + away) * texel).xy; }
float nearer(float before, float after) { return abs(after) < abs(before) ? after : before; }

void main() {
  float depth = at(vec2(0.0)).y, sum = 0.0, weights = 0.0;
  vec2 slope = vec2(nearer(depth - at(vec2(-1.0, 0.0)).y, at(vec2(1.0, 0.0)).y - depth),
                    nearer(depth - at(vec2(0.0, -1.0)).y, at(vec2(0.0, 1.0)).y - depth));
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      vec2 away = first + vec2(i, j);
      vec2 other = at(away);
      float weight = max(1.0 - abs(other.y - depth - dot(slope, away)) * tolerance, 0.0);
      sum += weight * other.x;
      weights += weight;
    }
  pixel = vec4(sum / weights, depth, 0.0, 1.0);
}
