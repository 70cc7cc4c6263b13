// Visibility of one pixel along one slice: x; y: its depth [m]. See render/occlusion.h.
uniform sampler2D depths;
uniform vec4 ray;    // of pixel (x, y) at depth 1 [m]: ray.xy + (x, y) * ray.zw
uniform float reach; // [m]
uniform float pixels;  // that 1 m at depth 1 m spans
uniform float longest; // that the reach may span [pixels]
out vec4 pixel;

vec3 place(ivec2 at) {
  float depth = texelFetch(depths, at, 0).x;
  return depth * vec3(ray.xy + vec2(at) * ray.zw, 1.0);
}

// Abramowitz and Stegun 4.4.45, off by less than 7e-5.
float arccos(float x) {
  float a = abs(x);
  float y = sqrt(1.0 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
  return x < 0.0 ? 3.14159265 - y : y;
}

// The nearer of two neighbours: the other may lie on something else.
vec3 along(vec3 before, vec3 here, vec3 after) {
  return abs(after.z - here.z) < abs(here.z - before.z) ? after - here : here - before;
}

// From the horizon's cosine: the integral over one side.
float arc(float cosine, float side, float cos_n, float sin_n) {
  float h = side * arccos(cosine), sine = side * sqrt(max(1.0 - cosine * cosine, 0.0));
  float cos_2h = 2.0 * cosine * cosine - 1.0, sin_2h = 2.0 * sine * cosine;
  return 0.25 * (cos_n + 2.0 * h * sin_n - (cos_2h * cos_n + sin_2h * sin_n));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(depths, 0) - 1;
  vec3 here = place(at);
  vec3 x = along(place(max(at - ivec2(1, 0), ivec2(0))), here, place(min(at + ivec2(1, 0), last)));
  vec3 y = along(place(max(at - ivec2(0, 1), ivec2(0))), here, place(min(at + ivec2(0, 1), last)));
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

  float span = min(reach * pixels / here.z, longest), fall = 1.0 / (reach * reach);
  float ahead = -sin_n, behind = sin_n; // cosines of the horizons: those of the surface itself
  for (int k = 0; k < 4; ++k) {
    float t = (float(k) + offset) * 0.25;
    vec2 away = direction * max(t * t * span, float(k) + 1.0);
    vec3 a = place(clamp(ivec2(gl_FragCoord.xy + away), ivec2(0), last)) - here;
    vec3 b = place(clamp(ivec2(gl_FragCoord.xy - away), ivec2(0), last)) - here;
    float aa = dot(a, a) + 1e-20, bb = dot(b, b) + 1e-20;
    ahead = max(ahead, mix(-sin_n, dot(a, eye) * inversesqrt(aa), clamp(1.0 - aa * fall, 0.0, 1.0)));
    behind = max(behind, mix(sin_n, dot(b, eye) * inversesqrt(bb), clamp(1.0 - bb * fall, 0.0, 1.0)));
  }
  float visible = size * (arc(min(ahead, 1.0), 1.0, cos_n, sin_n) + arc(min(behind, 1.0), -1.0, cos_n, sin_n));
  pixel = vec4(visible, here.z, 0.0, 1.0);
}
