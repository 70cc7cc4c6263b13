// What the picture is multiplied by: the light that the four nearest places are left with, of those that are as deep.
#if SAMPLES == 1
uniform sampler2D depth;
#else
uniform sampler2DMS depth;
#endif
uniform sampler2D kept;
uniform vec2 texel;         // of `kept`, in texture coordinates
uniform float part, back;   // pixels of the picture that are one of `kept`; half of that less its whole part
uniform int stride;         // from a pixel of the picture to one of `depth`
uniform vec2 to_nearness; // see occlusion_depth.frag
uniform float tolerance;  // [1/m]
out vec4 pixel;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float stored = 1.0; // of a pixel on an edge, the nearest: the farther part is darkened on its other pixels
  for (int k = 0; k < SAMPLES; ++k) stored = min(stored, texelFetch(depth, at * stride, k).x);
  float deep = 1.0 / (to_nearness.x + to_nearness.y * stored);

  vec2 from = (vec2(at) + back) / part; // the blur of place i reaches from i - 2 to i + 1, with i - 1/2 in its middle
  vec2 first = floor(from), share = from - first;
  float sum = 0.0, weights = 0.0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      vec2 other = texture(kept, (first + vec2(i, j) + 0.5) * texel).xy;
      float weight = (i == 0 ? 1.0 - share.x : share.x) * (j == 0 ? 1.0 - share.y : share.y) + 0.01;
      weight *= max(1.0 - abs(other.y - deep) * tolerance, 0.0) + 1e-4;
      sum += weight * other.x;
      weights += weight;
    }
  pixel = vec4(encode(vec3(1.0 - sum / weights)), 1.0);
}
