// What the floor is kept from: x: key light, y: everything, close to where a body touches it.
//
// The penumbra grows with the height of what throws it. `occluders` is a pyramid of ever more blurred pictures
// of the bodies, seen from the light; a coarse level tells how high they are on the average around a point, and
// that says which level is the shadow there.
in vec2 place;
uniform sampler2D occluders, contact;
uniform float penumbra;      // level of the pyramid at height 1: log2 of the penumbra in texels
uniform float contact_level; // level of the other pyramid that is blurred as wide as it should be
uniform vec2 contact_origin, contact_x, contact_y; // from this picture to the contact's
out vec4 pixel;

// A level read smoothly: its texels are large, and plain interpolation would show them as scallops.
vec2 smoothly(vec2 at, float level) {
  vec2 a = vec2(0.5, 0.5) * exp2(level) / vec2(textureSize(occluders, 0)), b = vec2(-a.x, a.y);
  return 0.25 * (textureLod(occluders, at + a, level).xy + textureLod(occluders, at - a, level).xy +
                 textureLod(occluders, at + b, level).xy + textureLod(occluders, at - b, level).xy);
}

void main() {
  vec2 at = 0.5 * place + 0.5;
  vec2 around = smoothly(at, 4.0);
  float height = clamp(1.0 - around.y / max(around.x, 1e-4), 0.002, 1.0);
  height = mix(0.002, height, min(8.0 * around.x, 1.0)); // nothing near: no blur brings anything here
  float dark = smoothly(at, clamp(penumbra + log2(height), 0.5, 4.0)).x;
  float near = textureLod(contact, contact_origin + at.x * contact_x + at.y * contact_y, contact_level).y;
  pixel = vec4(dark, near, 0.0, 1.0);
}
