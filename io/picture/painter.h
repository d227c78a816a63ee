#pragma once

#include <vector>

#include "io/picture/gl_objects.h"
#include "io/picture/view.h"

namespace supple {

/// Draws into one anti-aliased picture.
class Painter {
 public:
  /// Errors: OutputError.
  Painter(int width, int height);

  /// Surface (unless it is translucent), sheets and points of one item, and the shade on the ground
  /// where asked for and `view` looks down on it.
  struct Place {
    int column;
    bool ground_shadow;
  };
  void draw_shape(const Drawing& drawing, const View& view, const Place& place) const;

  void draw_markers(const Drawing& drawing, const View& view, int column) const;

  void draw_lines(const Drawing& drawing, const View& view, int column) const;

  /// The surface where it is translucent: its side that looks to the viewer, over what was drawn.
  void draw_veil(const Drawing& drawing, const View& view, int column) const;

  /// How far towards the viewer each pixel lies that was drawn so far [px], top row first;
  /// −infinity where there is nothing but background.
  std::vector<float> depth(const View& view) const;

  Picture picture() const;

 private:
  void draw_background() const;
  void draw_shadow(const Drawing& drawing, const View& view) const;
  void draw_surface(const Drawing& drawing, const View& view) const;
  void draw_splats(const Drawing& drawing, const View& view, int column) const;
  void draw_flat(const Drawing& drawing, const DrawnSheet& sheet, const View& view) const;
  void draw_balls(const Drawing& drawing, const std::vector<DrawnVertex>& balls,
                  const View& view) const;
  void use_column(const View& view, int column) const;
  template <class Value>
  std::vector<Value> read_canvas(GLenum format, GLenum type, int channels) const;

  int width_, height_;
  GlContext context_;
  const Gl& gl_;
  GlProgram background_, surface_, ball_, flat_, ground_;
  GlFramebuffer canvas_;
};

}  // namespace supple
