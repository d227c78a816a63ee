#pragma once

#include <map>
#include <vector>

#include "io/mesh/mesh.h"
#include "modeler/domain/mesh_topology.h"
#include "solver/core/describe.h"

namespace supple {

enum class DefectKind {
  boundary_edges,        ///< edges of one face
  nonmanifold_edges,     ///< edges of three faces or more
  nonmanifold_vertices,  ///< vertices at which faces touch that do not hang together there by edges
  inconsistent_edges,    ///< edges whose two faces look to opposite sides
  duplicate_faces,       ///< faces with the same vertices as one before
  zero_area_triangles,   ///< of those that faces are cut into
  repeated_index_faces,  ///< faces that name a vertex twice
  unreferenced_vertices,  ///< vertices of no face
  duplicated_vertices,    ///< vertices at the position of one before, to the last bit
  self_intersections,     ///< pairs of triangles that share more than a vertex or an edge
};
EnumNames<DefectKind> enum_names(DefectKind);

/// One place of a defect: vertices and faces by their numbers in the file, from 0.
struct DefectPlace {
  std::vector<int> vertices, faces;
  Vec3 position;  ///< [file units]
};

struct Defect {
  DefectKind kind;
  long count = 0;
  bool estimated = false;           ///< `count` is from a sample
  std::vector<DefectPlace> places;  ///< the first few
};

/// A part of the surface that shares vertices, those at one position taken for one.
struct Component {
  long vertices = 0, faces = 0;
  bool closed = true;       ///< no edge has only one face
  double area = 0;          ///< [file units²]
  double volume = 0;        ///< signed [file units³]; of an open one about the shape's centre
  double volume_share = 0;  ///< |volume| over the sum of all
  Box box;
};

/// A mesh as it stands in its file: what it is made of, and what is wrong with it.
struct MeshSurvey {
  long vertices = 0, faces = 0, triangles = 0;
  std::map<int, long> faces_by_sides;
  Box box;  ///< of the vertices that faces use
  double area = 0, volume = 0;

  /// No two faces share a vertex (STL files): vertices at one position then count as one.
  bool loose = false;
  std::vector<Defect> defects;        ///< one of each kind, in the kinds' order
  Topology topology;                  ///< as the file joins the faces
  Topology welded;                    ///< vertices at one position taken for one
  std::vector<Component> components;  ///< by area, largest first

  const Defect& defect(DefectKind kind) const { return defects[static_cast<std::size_t>(kind)]; }
};

/// Of a mesh that has faces.
MeshSurvey survey_mesh(const Mesh& mesh);

}  // namespace supple
