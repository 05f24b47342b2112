#include "app/platform/gl.h"

#include "app/platform/data_file.h"
#include "core/error.h"

#include <fmt/format.h>

#include <string>

namespace candela {

namespace {

template <class Function>
void load(GlGetter get, Function& function, const char* name) {
  function = reinterpret_cast<Function>(get(name));
  if (function == nullptr)
    throw Error(ExitCode::display,
                fmt::format("OpenGL: the driver has no {}: install a driver with OpenGL 3.3 (libgl1-mesa-dri "
                            "draws without a GPU), or use `candela render`",
                            name));
}

GLuint compile(const Gl& gl, GLenum kind, const std::string& file) {
  const std::string source = read_text_file(find_data_file(file));
  const char* text = source.c_str();
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  gl.DeleteShader(shader);
  throw Error(ExitCode::display,
              fmt::format("{}: shader: {}", file, log.substr(0, static_cast<std::size_t>(length))));
}

} // namespace

Gl load_gl(GlGetter get) {
  Gl gl;
  load(get, gl.ActiveTexture, "glActiveTexture");
  load(get, gl.AttachShader, "glAttachShader");
  load(get, gl.BindBuffer, "glBindBuffer");
  load(get, gl.BindTexture, "glBindTexture");
  load(get, gl.BindVertexArray, "glBindVertexArray");
  load(get, gl.BlendFuncSeparate, "glBlendFuncSeparate");
  load(get, gl.BufferData, "glBufferData");
  load(get, gl.Clear, "glClear");
  load(get, gl.ClearColor, "glClearColor");
  load(get, gl.CompileShader, "glCompileShader");
  load(get, gl.CreateProgram, "glCreateProgram");
  load(get, gl.CreateShader, "glCreateShader");
  load(get, gl.DeleteBuffers, "glDeleteBuffers");
  load(get, gl.DeleteProgram, "glDeleteProgram");
  load(get, gl.DeleteShader, "glDeleteShader");
  load(get, gl.DeleteTextures, "glDeleteTextures");
  load(get, gl.DeleteVertexArrays, "glDeleteVertexArrays");
  load(get, gl.Disable, "glDisable");
  load(get, gl.DrawArrays, "glDrawArrays");
  load(get, gl.DrawElementsBaseVertex, "glDrawElementsBaseVertex");
  load(get, gl.Enable, "glEnable");
  load(get, gl.EnableVertexAttribArray, "glEnableVertexAttribArray");
  load(get, gl.Finish, "glFinish");
  load(get, gl.GenBuffers, "glGenBuffers");
  load(get, gl.GenerateMipmap, "glGenerateMipmap");
  load(get, gl.GenTextures, "glGenTextures");
  load(get, gl.GenVertexArrays, "glGenVertexArrays");
  load(get, gl.GetError, "glGetError");
  load(get, gl.GetIntegerv, "glGetIntegerv");
  load(get, gl.GetProgramInfoLog, "glGetProgramInfoLog");
  load(get, gl.GetProgramiv, "glGetProgramiv");
  load(get, gl.GetShaderInfoLog, "glGetShaderInfoLog");
  load(get, gl.GetShaderiv, "glGetShaderiv");
  load(get, gl.GetString, "glGetString");
  load(get, gl.GetTexImage, "glGetTexImage");
  load(get, gl.GetUniformLocation, "glGetUniformLocation");
  load(get, gl.LinkProgram, "glLinkProgram");
  load(get, gl.PixelStorei, "glPixelStorei");
  load(get, gl.ReadPixels, "glReadPixels");
  load(get, gl.Scissor, "glScissor");
  load(get, gl.ShaderSource, "glShaderSource");
  load(get, gl.TexImage2D, "glTexImage2D");
  load(get, gl.TexParameteri, "glTexParameteri");
  load(get, gl.TexSubImage2D, "glTexSubImage2D");
  load(get, gl.Uniform1i, "glUniform1i");
  load(get, gl.Uniform2f, "glUniform2f");
  load(get, gl.Uniform4f, "glUniform4f");
  load(get, gl.UseProgram, "glUseProgram");
  load(get, gl.VertexAttribPointer, "glVertexAttribPointer");
  load(get, gl.Viewport, "glViewport");
  return gl;
}

GLuint build_program(const Gl& gl, const char* vertex_name, const char* fragment_name) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, fmt::format("shaders/{}.vert", vertex_name));
  const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, fmt::format("shaders/{}.frag", fragment_name));
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, vertex);
  gl.AttachShader(program, fragment);
  gl.LinkProgram(program);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
  gl.DeleteProgram(program);
  throw Error(ExitCode::display, fmt::format("shaders/{}: link: {}", fragment_name,
                                             log.substr(0, static_cast<std::size_t>(length))));
}

} // namespace candela
