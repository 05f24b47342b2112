#version 330 core
// One quad without a vertex buffer: the corners follow from gl_VertexID.

uniform vec4 rectangle; // left, bottom, width, height of the picture in clip space
uniform sampler2D picture;
out vec2 texture_position; // (0, 0) is the top left of the picture, (1, 1) the bottom right
out vec2 texel_position;   // the same, the bottom right being the picture's size

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  texture_position = vec2(corner.x, 1.0 - corner.y);
  texel_position = texture_position * vec2(textureSize(picture, 0));
  gl_Position = vec4(rectangle.xy + corner * rectangle.zw, 0.0, 1.0);
}
