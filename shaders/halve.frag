// Half as many pixels along each axis, blurred: the centre and four diagonal neighbours.
in vec2 place;
uniform sampler2D source;
out vec4 pixel;
void main() {
  vec2 at = 0.5 * place + 0.5, texel = 1.0 / vec2(textureSize(source, 0));
  vec2 other = vec2(texel.x, -texel.y);
  pixel = 0.5 * texture(source, at) + 0.125 * (texture(source, at + texel) + texture(source, at - texel) +
                                               texture(source, at + other) + texture(source, at - other));
}
