#pragma once

#include "io/file_bytes.h"
#include "io/mesh/mesh.h"
#include "io/output_file.h"

/// glTF 2.0, as text with its data beside or inside it, and as one binary file (GLB).
namespace supple {

/// Reads a scene (the default one, or the first) as one mesh. Nodes are flattened: their
/// transforms and the joints of skins are applied, each keeps its name as an object. Materials and
/// images are kept as they are, for glTF again. Strips and fans become triangles; points are read
/// where there are no triangles. Vertex colors go from linear light to sRGB, texture coordinates
/// from the upper left corner to the lower left. What is kept and what is left out stands in the
/// notes.
/// Errors: InputError where the container, the JSON, an index, an offset or a count is wrong, a
/// number is not finite, or an extension is required that is not known here.
Mesh read_gltf(const FileBytes& file);

/// A node an object (one for all where the objects' vertices are not in order), in it a primitive
/// a material. Positions are float32 about a node's translation where they lie far from the
/// origin. Vertices whose corners differ in normal or texture coordinates are doubled, the copies
/// after all others of their object.
void write_glb(const Mesh& mesh, OutputFile& file);

/// The same as text, the data inside it.
void write_gltf(const Mesh& mesh, OutputFile& file);

}  // namespace supple
