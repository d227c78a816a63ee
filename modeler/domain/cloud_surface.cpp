#include "modeler/domain/cloud_surface.h"

namespace supple {

SurfaceSamples cloud_samples(const Points& positions, const CloudSurface& surface) {
  SurfaceSamples samples = point_samples(positions(surface.points, Eigen::all), surface.areas);
  samples.vertices = surface.points;
  return samples;
}

}  // namespace supple
