// Shadows on the floor: x: of the key light, y: of all light, close to where a body touches it.
//
// The penumbra grows with the height of the occluder. `occluders` is a pyramid of increasingly blurred pictures
// of the bodies, seen from the light; `blur` says which level of it is the shadow here.
in vec2 place;
uniform sampler2D occluders, contact, blur;
uniform float contact_level; // level of the other pyramid with the right amount of blur
uniform vec2 contact_origin, contact_x, contact_y; // from this picture to the contact picture
out vec4 pixel;

void main() {
  vec2 at = 0.5 * place + 0.5;
  float dark = smoothly(occluders, at, 4.0 * texture(blur, at).x).x;
  float near = textureLod(contact, contact_origin + at.x * contact_x + at.y * contact_y, contact_level).y;
  pixel = vec4(dark, near, 0.0, 1.0);
}
