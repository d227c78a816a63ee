#include "io/picture/gl_objects.h"

#include <array>
#include <string>

#include <dlfcn.h>
#include <fmt/format.h>

#include "io/errors.h"
#include "solver/core/check.h"

namespace supple {
namespace {

using GetProcAddress = OSMESAproc (*)(const char*);

/// The library stays mapped when the handle is closed: unloading LLVM while its threads wind
/// down is asking for trouble, and the next picture would load it all again.
GetProcAddress load_osmesa() {
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr)
    throw OutputError(fmt::format("pictures need OSMesa (Debian: libosmesa6): {}", dlerror()));
  void* address = dlsym(library, "OSMesaGetProcAddress");
  dlclose(library);
  if (address == nullptr) throw OutputError("libOSMesa.so.8 has no OSMesaGetProcAddress");
  return reinterpret_cast<GetProcAddress>(address);
}

GlAddress require(GetProcAddress get_address, const char* name) {
  const OSMESAproc address = get_address(name);
  if (address == nullptr) throw OutputError(fmt::format("libOSMesa.so.8 has no {}", name));
  return {address};
}

constexpr std::array context_attributes = {OSMESA_FORMAT,
                                           OSMESA_RGBA,
                                           OSMESA_PROFILE,
                                           OSMESA_CORE_PROFILE,
                                           OSMESA_CONTEXT_MAJOR_VERSION,
                                           3,
                                           OSMESA_CONTEXT_MINOR_VERSION,
                                           3,
                                           0};

GLuint compile(const Gl& gl, GLenum kind, GlProgram::Sources sources) {
  std::string text;
  for (const std::string_view source : sources) text += source;
  const char* start = text.c_str();
  const GLuint shader = gl.create_shader(kind);
  gl.shader_source(shader, 1, &start, nullptr);
  gl.compile_shader(shader);
  return shader;
}

}  // namespace

GlContext::GlContext() {
  const GetProcAddress get_address = load_osmesa();
  gl_ = std::make_unique<Gl>(
      Gl{[get_address](const char* name) { return require(get_address, name); }});
  context_ = gl_->create_context(context_attributes.data(), nullptr);
  if (context_ == nullptr) throw OutputError("libOSMesa.so.8 gives no OpenGL 3.3 context");
  if (!gl_->make_current(context_, pixel_, GL_UNSIGNED_BYTE, 1, 1)) {
    gl_->destroy_context(context_);
    throw OutputError("libOSMesa.so.8 cannot make its context current");
  }
}

GlContext::~GlContext() {
  gl_->destroy_context(context_);
}

GlProgram::GlProgram(const Gl& gl, Sources vertex_shader, Sources fragment_shader)
    : gl_(gl), id_(gl.create_program()) {
  for (const GLuint shader : {compile(gl, GL_VERTEX_SHADER, vertex_shader),
                              compile(gl, GL_FRAGMENT_SHADER, fragment_shader)}) {
    gl_.attach_shader(id_, shader);
    gl_.delete_shader(shader);
  }
  gl_.link_program(id_);
  GLint linked = GL_FALSE;
  gl_.program_value(id_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(2000, '\0');
  GLsizei length = 0;
  gl_.program_log(id_, static_cast<GLsizei>(log.size()), &length, log.data());
  gl_.delete_program(id_);
  throw InternalError(fmt::format("OSMesa refuses a shader: {}", log.substr(0, length)));
}

GlFramebuffer::GlFramebuffer(const Gl& gl, int width, int height)
    : framebuffer_(gl.gen_framebuffers, gl.delete_framebuffers),
      color_(gl.gen_renderbuffers, gl.delete_renderbuffers),
      depth_(gl.gen_renderbuffers, gl.delete_renderbuffers) {
  gl.bind_framebuffer(GL_FRAMEBUFFER, id());
  gl.bind_renderbuffer(GL_RENDERBUFFER, color_.id());
  gl.renderbuffer_storage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  gl.attach_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  gl.bind_renderbuffer(GL_RENDERBUFFER, depth_.id());
  gl.renderbuffer_storage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  gl.attach_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  if (gl.check_framebuffer(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw OutputError(fmt::format("OSMesa cannot draw {}x{} pixels", width, height));
}

}  // namespace supple
