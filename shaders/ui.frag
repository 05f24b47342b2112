#version 330 core

uniform sampler2D atlas;
in vec2 fragment_texture_position;
in vec4 fragment_color;
out vec4 color;

void main() { color = fragment_color * texture(atlas, fragment_texture_position); }
