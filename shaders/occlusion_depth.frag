// The depth of some pixels [m]: of the bodies, or else of the floor, or else far away.
noperspective in float floor_nearness;
#if SAMPLES == 1
uniform sampler2D depth;
#define last (textureSize(depth, 0) - 1)
#else
uniform sampler2DMS depth;
#define last (textureSize(depth) - 1)
#endif
uniform int part;   // so many pixels of the picture, each way, are one here: the middle one is looked at
uniform int stride; // from a pixel of the picture to one of `depth`
uniform vec2 to_nearness; // 1 / depth [1/m] = x + y * what the depth buffer holds
out vec4 pixel;
void main() {
  float stored = texelFetch(depth, min((ivec2(gl_FragCoord.xy) * part + part / 2) * stride, last), 0).x;
  float nearness = stored < 1.0 ? to_nearness.x + to_nearness.y * stored : floor_nearness;
  pixel = vec4(1.0 / max(nearness, 1e-9), 0.0, 0.0, 1.0);
}
