#pragma once

#define GL_GLEXT_PROTOTYPES  // the declarations lend us the functions' types; nothing links them
#include <functional>

#include <GL/osmesa.h>

namespace supple {

/// A function's address that turns into whatever pointer it initialises.
struct GlAddress {
  OSMESAproc address;
  template <class Function>
  operator Function*() const {
    return reinterpret_cast<Function*>(address);
  }
};

/// The functions of OpenGL that pictures need, every one by `load` out of OSMesa itself: where
/// the process holds another OpenGL too, calls linked by name would end there and draw nothing.
struct Gl {
  std::function<GlAddress(const char* name)> load;

  decltype(&OSMesaCreateContextAttribs) create_context = load("OSMesaCreateContextAttribs");
  decltype(&OSMesaDestroyContext) destroy_context = load("OSMesaDestroyContext");
  decltype(&OSMesaMakeCurrent) make_current = load("OSMesaMakeCurrent");

  decltype(&glActiveTexture) active_texture = load("glActiveTexture");
  decltype(&glAttachShader) attach_shader = load("glAttachShader");
  decltype(&glBindBuffer) bind_buffer = load("glBindBuffer");
  decltype(&glBindFramebuffer) bind_framebuffer = load("glBindFramebuffer");
  decltype(&glBindRenderbuffer) bind_renderbuffer = load("glBindRenderbuffer");
  decltype(&glBindTexture) bind_texture = load("glBindTexture");
  decltype(&glBindVertexArray) bind_vertex_array = load("glBindVertexArray");
  decltype(&glBlendFunc) blend_function = load("glBlendFunc");
  decltype(&glBufferData) buffer_data = load("glBufferData");
  decltype(&glCheckFramebufferStatus) check_framebuffer = load("glCheckFramebufferStatus");
  decltype(&glClear) clear = load("glClear");
  decltype(&glColorMask) color_mask = load("glColorMask");
  decltype(&glCompileShader) compile_shader = load("glCompileShader");
  decltype(&glCreateProgram) create_program = load("glCreateProgram");
  decltype(&glCreateShader) create_shader = load("glCreateShader");
  decltype(&glDeleteBuffers) delete_buffers = load("glDeleteBuffers");
  decltype(&glDeleteFramebuffers) delete_framebuffers = load("glDeleteFramebuffers");
  decltype(&glDeleteProgram) delete_program = load("glDeleteProgram");
  decltype(&glDeleteRenderbuffers) delete_renderbuffers = load("glDeleteRenderbuffers");
  decltype(&glDeleteShader) delete_shader = load("glDeleteShader");
  decltype(&glDeleteTextures) delete_textures = load("glDeleteTextures");
  decltype(&glDeleteVertexArrays) delete_vertex_arrays = load("glDeleteVertexArrays");
  decltype(&glDepthFunc) depth_function = load("glDepthFunc");
  decltype(&glDepthMask) depth_mask = load("glDepthMask");
  decltype(&glDisable) disable = load("glDisable");
  decltype(&glDrawArrays) draw_arrays = load("glDrawArrays");
  decltype(&glDrawBuffers) draw_buffers = load("glDrawBuffers");
  decltype(&glDrawElements) draw_elements = load("glDrawElements");
  decltype(&glEnable) enable = load("glEnable");
  decltype(&glEnableVertexAttribArray) enable_attribute = load("glEnableVertexAttribArray");
  decltype(&glFramebufferRenderbuffer) attach_renderbuffer = load("glFramebufferRenderbuffer");
  decltype(&glFramebufferTexture2D) attach_texture = load("glFramebufferTexture2D");
  decltype(&glGenBuffers) gen_buffers = load("glGenBuffers");
  decltype(&glGenFramebuffers) gen_framebuffers = load("glGenFramebuffers");
  decltype(&glGenRenderbuffers) gen_renderbuffers = load("glGenRenderbuffers");
  decltype(&glGenTextures) gen_textures = load("glGenTextures");
  decltype(&glGenVertexArrays) gen_vertex_arrays = load("glGenVertexArrays");
  decltype(&glGetProgramInfoLog) program_log = load("glGetProgramInfoLog");
  decltype(&glGetProgramiv) program_value = load("glGetProgramiv");
  decltype(&glGetUniformLocation) uniform_location = load("glGetUniformLocation");
  decltype(&glLinkProgram) link_program = load("glLinkProgram");
  decltype(&glPixelStorei) pixel_store = load("glPixelStorei");
  decltype(&glReadPixels) read_pixels = load("glReadPixels");
  decltype(&glRenderbufferStorage) renderbuffer_storage = load("glRenderbufferStorage");
  decltype(&glScissor) scissor = load("glScissor");
  decltype(&glShaderSource) shader_source = load("glShaderSource");
  decltype(&glTexImage2D) texture_image = load("glTexImage2D");
  decltype(&glTexParameteri) texture_parameter = load("glTexParameteri");
  decltype(&glUniform1i) uniform_1i = load("glUniform1i");
  decltype(&glUniform1f) uniform_1f = load("glUniform1f");
  decltype(&glUniform4fv) uniform_4fv = load("glUniform4fv");
  decltype(&glUniformMatrix3fv) uniform_matrix3 = load("glUniformMatrix3fv");
  decltype(&glUniformMatrix4fv) uniform_matrix4 = load("glUniformMatrix4fv");
  decltype(&glUseProgram) use_program = load("glUseProgram");
  decltype(&glVertexAttribPointer) attribute_pointer = load("glVertexAttribPointer");
  decltype(&glViewport) viewport = load("glViewport");
};

}  // namespace supple
