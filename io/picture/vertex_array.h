#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/picture/drawing.h"
#include "io/picture/gl_objects.h"

namespace supple {

/// Vertices (and triangles) handed to OpenGL, ready to draw as long as this lives.
class VertexArray {
 public:
  VertexArray(const Gl& gl, const std::vector<DrawnVertex>& vertices,
              const std::vector<std::uint32_t>& indices = {})
      : array_(gl.gen_vertex_arrays, gl.delete_vertex_arrays),
        vertices_(gl.gen_buffers, gl.delete_buffers),
        indices_(gl.gen_buffers, gl.delete_buffers) {
    gl.bind_vertex_array(array_.id());
    gl.bind_buffer(GL_ARRAY_BUFFER, vertices_.id());
    fill(gl, GL_ARRAY_BUFFER, vertices);
    gl.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    fill(gl, GL_ELEMENT_ARRAY_BUFFER, indices);
    set_attribute(gl, 0, 3, GL_FLOAT, offsetof(DrawnVertex, position));
    set_attribute(gl, 1, 3, GL_FLOAT, offsetof(DrawnVertex, normal));
    set_attribute(gl, 2, 4, GL_UNSIGNED_BYTE, offsetof(DrawnVertex, color));
    set_attribute(gl, 3, 1, GL_FLOAT, offsetof(DrawnVertex, radius));
  }

 private:
  template <class Value>
  static void fill(const Gl& gl, GLenum target, const std::vector<Value>& values) {
    gl.buffer_data(target, static_cast<GLsizeiptr>(values.size() * sizeof(Value)), values.data(),
                   GL_STATIC_DRAW);
  }

  static void set_attribute(const Gl& gl, GLuint index, GLint count, GLenum type,
                            std::size_t offset) {
    const GLboolean normalized = type == GL_UNSIGNED_BYTE;
    gl.attribute_pointer(index, count, type, normalized, sizeof(DrawnVertex),
                         reinterpret_cast<const void*>(offset));
    gl.enable_attribute(index);
  }

  GlObject array_, vertices_, indices_;
};

}  // namespace supple
