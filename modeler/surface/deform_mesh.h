#pragma once

#include "io/mesh/mesh.h"
#include "modeler/surface/surface_embedding.h"

namespace supple {

/// A normal carried by the deformation: n' = cof(F) n with the length it had; the zero vector
/// where F flattens it away (Adams & Wicke 2009, section 7.2; errata).
Vec3 carry_normal(const Mat3& F, const Vec3& normal);

/// A point's radius carried by the deformation: r' = r √|cof(F) n|, the root of what its disc's
/// area grows by; r ∛|det F| for a point without a normal (`normal` = 0).
double carry_radius(const Mat3& F, const Vec3& normal, double radius);

/// `mesh` with deformed vertices, normals and radii; faces, UVs, colours, groups stay as they are.
/// A normal shared by several vertices that turn differently is split.
Mesh deform_mesh(const Mesh& mesh, const DeformedSurface& surface);

}  // namespace supple
