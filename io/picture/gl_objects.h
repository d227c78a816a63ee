#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>

#include "io/picture/gl.h"

namespace supple {

/// The OSMesa library and an OpenGL 3.3 context that is current as long as this lives.
class GlContext {
 public:
  /// Errors: OutputError where the library or such a context cannot be had.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  const Gl& gl() const { return *gl_; }

 private:
  std::unique_ptr<Gl> gl_;
  OSMesaContext context_ = nullptr;
  unsigned char pixel_[4] = {};  // a context wants a picture of its own; ours are framebuffers
};

/// An object of OpenGL that is deleted with this handle; the context must outlive it.
class GlObject {
 public:
  using Generate = void (*)(GLsizei, GLuint*);
  using Delete = void (*)(GLsizei, const GLuint*);

  GlObject(Generate generate, Delete remove) : remove_(remove) { generate(1, &id_); }
  GlObject(GlObject&& other) noexcept : remove_(other.remove_), id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&&) = delete;
  ~GlObject() {
    if (id_ != 0) remove_(1, &id_);
  }

  GLuint id() const { return id_; }

 private:
  Delete remove_;
  GLuint id_ = 0;
};

/// A linked pair of shaders.
class GlProgram {
 public:
  using Sources = std::initializer_list<std::string_view>;
  GlProgram(const Gl& gl, Sources vertex_shader, Sources fragment_shader);
  ~GlProgram() { gl_.delete_program(id_); }
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const { gl_.use_program(id_); }
  // Uniforms of the program in use:
  void set(const char* name, double value) const {
    gl_.uniform_1f(uniform(name), static_cast<GLfloat>(value));
  }
  void set(const char* name, int value) const { gl_.uniform_1i(uniform(name), value); }
  void set(const char* name, const Eigen::Vector4f& vector) const {
    gl_.uniform_4fv(uniform(name), 1, vector.data());
  }
  void set(const char* name, const Eigen::Matrix4d& matrix) const {
    gl_.uniform_matrix4(uniform(name), 1, GL_FALSE, matrix.cast<float>().eval().data());
  }
  void set(const char* name, const Eigen::Matrix3d& matrix) const {
    gl_.uniform_matrix3(uniform(name), 1, GL_FALSE, matrix.cast<float>().eval().data());
  }

 private:
  GLint uniform(const char* name) const { return gl_.uniform_location(id_, name); }

  const Gl& gl_;
  GLuint id_;
};

/// Colour and depth to draw into.
class GlFramebuffer {
 public:
  GlFramebuffer(const Gl& gl, int width, int height);
  GLuint id() const { return framebuffer_.id(); }

 private:
  GlObject framebuffer_, color_, depth_;
};

}  // namespace supple
