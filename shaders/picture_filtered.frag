#version 330 core
// Smaller than it is. The picture is tone-mapped and encoded already; its bytes go to the screen as they are.

uniform sampler2D picture;
in vec2 texture_position;
out vec4 color;

void main() { color = vec4(texture(picture, texture_position).rgb, 1.0); }
