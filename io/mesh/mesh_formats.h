#pragma once

#include "io/file_bytes.h"
#include "io/mesh/mesh.h"
#include "io/output_file.h"

/// One reader and one writer a format; read_mesh and write_mesh choose among them.
namespace supple {

Mesh read_obj(const FileBytes& file);

/// Faces of fewer than three vertices are left out with a note, as in PLY.
Mesh read_off(const FileBytes& file);

/// Triangle strips (`tristrips`) become triangles; a list `texcoord` on the faces becomes
/// texture coordinates per corner. Points without faces may have a `radius` (or `radii`).
Mesh read_ply(const FileBytes& file);

/// STL shares no vertices: triangle t has the vertices 3t, 3t+1, 3t+2. Facet normals follow
/// from the vertices and are not kept.
Mesh read_stl(const FileBytes& file);

void write_obj(const Mesh& mesh, OutputFile& file);

/// Header letters say what is there: ST (texture), C (colors), N (normals).
void write_off(const Mesh& mesh, OutputFile& file);

/// Binary, little-endian. Positions are float32, or double where float32 would move a vertex
/// by more than 2⁻²² of the bounding box's diagonal, or a point of a cloud at all: measurements
/// stay as they are. Colors are bytes where all are multiples of 1/255, float32 otherwise. Where
/// texture coordinates are per corner, a corner without any gets (0, 0).
void write_ply(const Mesh& mesh, OutputFile& file);

/// Binary; polygons in triangles.
/// Errors: OutputError for a point cloud and for coordinates beyond float32.
void write_stl(const Mesh& mesh, OutputFile& file);

}  // namespace supple
