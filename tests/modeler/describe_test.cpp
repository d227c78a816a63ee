// Every options struct tells its members once, and its defaults keep its own bounds.

#include "solver/core/describe.h"

#include <set>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "io/picture/picture.h"
#include "io/scene/scene.h"
#include "modeler/domain/cell_quadrature.h"
#include "modeler/domain/octree.h"
#include "modeler/domain/octree_particles.h"
#include "modeler/domain/sample_particles.h"
#include "modeler/domain/self_intersections.h"
#include "modeler/domain/volume_samples.h"
#include "solver/field/moving_least_squares.h"
#include "solver/field/supports.h"
#include "solver/minimize/minimize_options.h"

namespace supple {
namespace {

class DefaultsCheck {
 public:
  template <class T>
  void operator()(std::string_view name, const T& value, const Described& described) {
    EXPECT_TRUE(names_.insert(std::string(name)).second) << name << " stands twice";
    EXPECT_FALSE(described.doc.empty()) << name;
    EXPECT_LE(described.min, described.max) << name;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      EXPECT_GE(static_cast<double>(value), described.min) << name;
      EXPECT_LE(static_cast<double>(value), described.max) << name;
    }
    if (described.sweep.kind == Sweep::Kind::range) {
      const Sweep& sweep = described.sweep;
      for (const double end : {sweep.from, sweep.to, sweep.exact != 0 ? sweep.exact : sweep.to}) {
        EXPECT_GT(end, 0) << name << " is swept in equal ratios";
        EXPECT_GE(end, described.min) << name;
        EXPECT_LE(end, described.max) << name;
      }
    }
  }

  std::size_t count() const { return names_.size(); }

 private:
  std::set<std::string> names_;
};

template <class T>
class EveryOptions : public testing::Test {};

using AllOptions =
    testing::Types<MovingLeastSquaresOptions, SupportOptions, MinimizeOptions,
                   ParticleSamplingOptions, VolumeSampleOptions, SelfIntersectionOptions,
                   OctreeOptions, OctreeParticleOptions, CellQuadratureOptions, Camera,
                   PictureOptions, ShapeSpec, TurnSpec, HandleSpec, PoseWeights, StiffnessSpec,
                   MirrorSpec, PoseSpec, Scene>;
TYPED_TEST_SUITE(EveryOptions, AllOptions);

TYPED_TEST(EveryOptions, DescribesItsMembersWithinTheirBounds) {
  const TypeParam options;
  DefaultsCheck check;
  TypeParam::describe(options, check);
  EXPECT_GT(check.count(), 0u);
}

}  // namespace
}  // namespace supple
