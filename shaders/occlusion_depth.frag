// The depth of some pixels [m]: of the bodies, else of the floor, else far away.
noperspective in float floor_nearness;
flat in ivec2 last;    // see occlusion.vert
flat in vec2 nearness; // 1 / depth [1/m] = x + y * the value in the depth buffer
#if SAMPLES == 1
uniform sampler2D depth;
#define size textureSize(depth, 0)
#else
uniform sampler2DMS depth;
#define size textureSize(depth)
#endif
out vec4 pixel;
void main() {
  // PART x PART pixels of the picture are one here: the centre one is read.
  ivec2 at = min((ivec2(gl_FragCoord.xy) * PART + PART / 2) * FINE, last);
  bool held = all(lessThan(at, size)); // outside the bodies, the depth texture may end
  float stored = held ? texelFetch(depth, at, 0).x : 1.0;
  float near = stored < 1.0 ? nearness.x + nearness.y * stored : floor_nearness;
  pixel = vec4(1.0 / max(near, 1e-9), 0.0, 0.0, 1.0);
}
