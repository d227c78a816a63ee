#include "io/picture/splat_painter.h"

#include <array>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/picture/shaders.h"
#include "io/picture/vertex_array.h"

namespace supple {
namespace {

constexpr double largest_px = 120;  // OSMesa draws points up to 255 pixels wide

void make_sums(const Gl& gl, const GlObject& texture, GLenum attachment, int width, int height) {
  gl.bind_texture(GL_TEXTURE_2D, texture.id());
  gl.texture_image(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  gl.texture_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.attach_texture(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.id(), 0);
}

}  // namespace

void PointScale::set(const GlProgram& program) const {
  program.set("px_per_unit", px_per_unit);
  program.set("default_px", default_px);
  program.set("largest_px", largest_px);
  program.set("depth_per_px", depth_per_px);
}

SplatPainter::SplatPainter(const Gl& gl, int width, int height)
    : gl_(gl),
      splat_(gl, {shaders::point_size, shaders::splat_vertex}, {shaders::splat_fragment}),
      resolve_(gl, {shaders::background_vertex}, {shaders::lighting, shaders::resolve_fragment}),
      framebuffer_(gl.gen_framebuffers, gl.delete_framebuffers),
      normals_(gl.gen_textures, gl.delete_textures),
      colors_(gl.gen_textures, gl.delete_textures),
      depth_(gl.gen_renderbuffers, gl.delete_renderbuffers) {
  gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  make_sums(gl, normals_, GL_COLOR_ATTACHMENT0, width, height);
  make_sums(gl, colors_, GL_COLOR_ATTACHMENT1, width, height);
  gl.bind_renderbuffer(GL_RENDERBUFFER, depth_.id());
  gl.renderbuffer_storage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  gl.attach_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  constexpr std::array<GLenum, 2> targets = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl.draw_buffers(static_cast<GLsizei>(targets.size()), targets.data());
  if (gl.check_framebuffer(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw OutputError(fmt::format("OSMesa cannot blend {}x{} pixels", width, height));
}

void SplatPainter::gather(const Drawing& drawing, const View& view, const PointScale& scale) const {
  const auto count = static_cast<GLsizei>(drawing.splats.size());
  const VertexArray array(gl_, drawing.splats);
  gl_.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  splat_.use();
  splat_.set("to_clip", clip_from(view, world_from_drawing(drawing)));
  splat_.set("to_view", view.rotation);
  scale.set(splat_);

  splat_.set("behind", 1.0);
  gl_.enable(GL_DEPTH_TEST);
  gl_.color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.draw_arrays(GL_POINTS, 0, count);
  gl_.color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

  splat_.set("behind", 0.0);
  gl_.depth_mask(GL_FALSE);
  gl_.enable(GL_BLEND);
  gl_.blend_function(GL_ONE, GL_ONE);
  gl_.draw_arrays(GL_POINTS, 0, count);
  gl_.disable(GL_BLEND);
  gl_.depth_mask(GL_TRUE);
  gl_.disable(GL_DEPTH_TEST);
}

void SplatPainter::resolve(int left) const {
  const VertexArray none(gl_, {});
  resolve_.use();
  resolve_.set("normal_sums", 0);
  resolve_.set("color_sums", 1);
  resolve_.set("left", left);
  gl_.active_texture(GL_TEXTURE1);
  gl_.bind_texture(GL_TEXTURE_2D, colors_.id());
  gl_.active_texture(GL_TEXTURE0);
  gl_.bind_texture(GL_TEXTURE_2D, normals_.id());
  gl_.enable(GL_DEPTH_TEST);
  gl_.draw_arrays(GL_TRIANGLES, 0, 3);
  gl_.disable(GL_DEPTH_TEST);
}

}  // namespace supple
