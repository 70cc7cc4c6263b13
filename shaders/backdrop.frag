in vec2 place;
uniform vec3 background; // sRGB
out vec4 pixel;
void main() { pixel = vec4(encode(backdrop(place, decode(background))), 1.0); }
