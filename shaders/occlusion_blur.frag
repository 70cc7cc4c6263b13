// The mean over a block of 4 x 4, whose pixels have all slices and offsets among them, of what is as deep: x; y: depth.
uniform sampler2D visibility;
uniform float tolerance; // [1/m]: 1 over the depth that keeps neighbours apart
out vec4 pixel;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(visibility, 0) - 1;
  float depth = texelFetch(visibility, at, 0).y, sum = 0.0, weights = 0.0;
  for (int j = -2; j < 2; ++j)
    for (int i = -2; i < 2; ++i) {
      vec2 other = texelFetch(visibility, clamp(at + ivec2(i, j), ivec2(0), last), 0).xy;
      float weight = max(1.0 - abs(other.y - depth) * tolerance, 0.0);
      sum += weight * other.x;
      weights += weight;
    }
  pixel = vec4(sum / weights, depth, 0.0, 1.0);
}
