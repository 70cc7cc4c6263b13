// For one pixel and one slice, x: occlusion; y: depth [m]. See render/draw/occlusion.h.
uniform sampler2D depths;
uniform vec2 texel;    // in texture coordinates
uniform vec4 ray;      // of pixel (x, y) at depth 1 [m]: ray.xy + (x, y) * ray.zw
uniform float reach;   // [m]
uniform float pixels;  // that 1 m at depth 1 m spans
uniform float longest; // that the reach may span [pixels]
out vec4 pixel;

vec3 place(vec2 at) { return texture(depths, at * texel).x * vec3(ray.xy + at * ray.zw, 1.0); }

// Abramowitz and Stegun 4.4.45, error below 7e-5.
float arccos(float x) {
  float a = abs(x);
  float y = sqrt(1.0 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
  return x < 0.0 ? 3.14159265 - y : y;
}

// The difference to the neighbour closer in depth: the other may lie on another surface.
vec3 along(vec3 before, vec3 here, vec3 after) {
  return abs(after.z - here.z) < abs(here.z - before.z) ? after - here : here - before;
}

// The integral over one side (1 or -1), with the sine of the horizon's angle above the surface.
float arc(float rise, float side, float cos_n, float sin_n) {
  float cosine = clamp(cos_n * rise - side * sin_n * sqrt(1.0 - rise * rise), -1.0, 1.0);
  float h = side * arccos(cosine), sine = side * sqrt(1.0 - cosine * cosine);
  float cos_2h = 2.0 * cosine * cosine - 1.0, sin_2h = 2.0 * sine * cosine;
  return 0.25 * (cos_n + 2.0 * h * sin_n - (cos_2h * cos_n + sin_2h * sin_n));
}

void main() {
  vec2 middle = gl_FragCoord.xy;
  ivec2 at = ivec2(middle);
  vec3 here = place(middle);
  vec3 x = along(place(middle - vec2(1.0, 0.0)), here, place(middle + vec2(1.0, 0.0)));
  vec3 y = along(place(middle - vec2(0.0, 1.0)), here, place(middle + vec2(0.0, 1.0)));
  vec3 eye = -normalize(here), n = normalize(cross(x, y));
  if (dot(n, eye) < 0.0) n = -n;

  int turn = (((at.x + at.y) & 3) << 2) + (at.x & 3);
  float angle = (float(turn) + 0.5) * (3.14159265 / 16.0), offset = (float((at.y - at.x) & 3) + 0.5) * 0.25;
  vec2 direction = vec2(cos(angle), sin(angle));
  vec3 flat_direction = vec3(direction, 0.0);
  vec3 tangent = normalize(flat_direction - eye * dot(flat_direction, eye)), axis = cross(tangent, eye);
  vec3 projected = n - axis * dot(n, axis);
  float size = max(length(projected), 1e-4);
  float sin_n = dot(projected, tangent) / size, cos_n = clamp(dot(projected, eye) / size, 0.0, 1.0);

  // Horizons are measured from the surface, so that a plane does not occlude itself through pixels beside the
  // slice.
  float span = min(reach * pixels / here.z, longest), fall = 1.0 / (reach * reach);
  float ahead = 0.0, behind = 0.0; // squared sines, reduced by distance
  for (int k = 0; k < 4; ++k) {
    float t = (float(k) + offset) * 0.25;
    vec2 away = floor(direction * max(t * t * span, float(k) + 1.0) + 0.5);
    vec3 a = place(middle + away) - here;
    vec3 b = place(middle - away) - here;
    float up_a = max(dot(a, n), 0.0), near_a = 1.0 / (dot(a, a) + 1e-20);
    float up_b = max(dot(b, n), 0.0), near_b = 1.0 / (dot(b, b) + 1e-20);
    ahead = max(ahead, up_a * up_a * min(near_a, 1.5 * (near_a - fall)));
    behind = max(behind, up_b * up_b * min(near_b, 1.5 * (near_b - fall)));
  }
  ahead = min(sqrt(ahead) / size, 1.0);
  behind = min(sqrt(behind) / size, 1.0);
  float free = cos_n + arccos(cos_n) * abs(sin_n); // without occluders
  float seen = arc(ahead, 1.0, cos_n, sin_n) + arc(behind, -1.0, cos_n, sin_n);
  float kept = size * (free - seen);
  // Where neighbours are as thin as a pixel, directions vanish: a resulting NaN fails the comparison.
  pixel = vec4(kept > 0.0 ? min(kept, 1.0) : 0.0, here.z, 0.0, 1.0);
}
