#pragma once

#include "io/picture/drawing.h"
#include "io/picture/gl_objects.h"
#include "io/picture/view.h"

namespace supple {

/// How large points are on the canvas.
struct PointScale {
  double px_per_unit;   ///< [px] of a length 1 in the drawing's coordinates
  double default_px;    ///< [px] radius of points without one of their own
  double depth_per_px;  ///< depth in [0, 1] over a pixel's width

  /// Uniforms of the program in use.
  void set(const GlProgram& program) const;
};

/// Draws points with normals so that they look like a surface: discs across their normals that
/// overlap, with normals and colours blended where they do (Botsch et al. 2005, "High-quality
/// surface splatting on today's GPUs": visibility, blending, lighting).
class SplatPainter {
 public:
  /// Errors: OutputError.
  SplatPainter(const Gl& gl, int width, int height);

  /// Adds up the drawing's splats. Leaves its own framebuffer bound.
  void gather(const Drawing& drawing, const View& view, const PointScale& scale) const;

  /// Lights the sums, into the framebuffer that is bound, `left` pixels from its left edge.
  void resolve(int left) const;

 private:
  const Gl& gl_;
  GlProgram splat_, resolve_;
  GlObject framebuffer_, normals_, colors_, depth_;
};

}  // namespace supple
