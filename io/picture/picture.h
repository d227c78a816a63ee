#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh.h"
#include "solver/core/describe.h"

namespace supple {

/// Red, green, blue in [0, 1].
using Color = std::array<float, 3>;

/// Points drawn as small balls over the surface: handles, particles.
struct Markers {
  Points positions = {};  ///< [m], n×3
  Color color{1, 0, 0};
  double radius = 0;               ///< [m]; 0: a share of the picture's size that reads well
  std::vector<Color> colors = {};  ///< one a point; empty: `color` for all
};

/// Straight lines: edges of cells, axes, rings.
struct Lines {
  Points ends = {};  ///< [m], 2n×3: the two ends of one line after the other
  Color color{0.2f, 0.2f, 0.2f};
  double width = 1.5;              ///< [px]
  std::vector<Color> colors = {};  ///< one a line; empty: `color` for all
};

/// A piece of surface in colours that no light changes: a slice coloured by a field.
struct Sheet {
  Points positions = {};  ///< [m], n×3
  Triangles triangles = {};
  std::vector<Color> colors = {};  ///< n
};

/// Short text in space, in front of everything.
struct Note {
  Vec3 position = Vec3::Zero();  ///< [m], of its middle
  std::string text = {};
};

/// The points x with normal·x > offset.
struct HalfSpace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  ///< [m] where the normal is of unit length
};

/// One view of the picture, drawn left to right. Points with normals, of a mesh without faces, are
/// drawn as discs that make up a surface, others as balls; of their radii where the mesh has them.
struct PictureItem {
  const Mesh* mesh = nullptr;
  std::vector<Markers> markers = {};
  std::string label = {};                 ///< small text below the view
  std::vector<Color> vertex_colors = {};  ///< empty: the mesh's own, else plain clay
  double opacity = 1;  ///< of the surface, above 0; below 1 what lies inside shows through
  std::optional<HalfSpace> cut = {};  ///< what of the surface is left out
  std::vector<Lines> lines = {};
  std::vector<Sheet> sheets = {};
  std::vector<Note> notes = {};
};

/// An orthographic camera that fits all items into the picture.
struct Camera {
  double azimuth_deg = 30;
  double elevation_deg = 15;
  Vec3 up = Vec3::UnitY();
  double zoom = 1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("azimuth_deg", self.azimuth_deg,
          {.doc = "about `up`; 0 looks along −z where y is up, along +y where z is", .unit = "°"});
    visit("elevation_deg", self.elevation_deg,
          {.doc = "above the horizon", .unit = "°", .min = -90, .max = 90});
    visit("up", self.up, {.doc = "upward direction, any length but 0"});
    visit("zoom", self.zoom,
          {.doc = "above 1 parts may be cut off", .min = 0, .exclusive_min = true});
  }
};

struct PictureOptions {
  int width = 1280, height = 720;
  Camera camera;
  bool ground_shadow = true;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("width", self.width, {.doc = "of the picture", .unit = "px", .min = 1});
    visit("height", self.height, {.doc = "of the picture", .unit = "px", .min = 1});
    visit("camera", self.camera, {.doc = "where it is seen from"});
    visit("ground_shadow", self.ground_shadow,
          {.doc = "soft shade below the shapes, where seen from above"});
  }
};

/// Width × height RGB bytes, top row first.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Draws the items side by side with one camera and one scale, on the processor (OSMesa, loaded
/// at the first call). Surfaces are shaded by their geometry, smooth but for creases of 40°; what
/// touches a coordinate that is not finite is left out.
/// Errors: UsageError for a size or camera that cannot be; OutputError where OSMesa cannot be had.
Picture render(const std::vector<PictureItem>& items, const PictureOptions& options = {});

/// Errors: OutputError.
void write_png(const Picture& picture, const std::filesystem::path& path);

}  // namespace supple
