#pragma once

#include "io/file_bytes.h"
#include "io/mesh/mesh.h"
#include "io/output_file.h"

/// Point clouds: meshes without faces. read_mesh and write_mesh choose among these formats too.
namespace supple {

/// One point a line: x y z, then a normal, then a color, each where there is one. Numbers stand
/// between blanks, commas or semicolons; # and // begin comments; lines without a number before
/// the first point are headers. A header (or a comment) that names columns x, y, z, nx, ny, nz,
/// r, g, b says what they are; without one, three whole numbers of 0 to 255 are a color. A first
/// line with nothing but a whole number is the count of points.
Mesh read_xyz(const FileBytes& file);

/// Points with normals: a line with the count, then lines of six numbers, or all positions and
/// then all normals. Lines of six numbers may also stand alone.
Mesh read_pwn(const FileBytes& file);

/// The Point Cloud Library's format 0.7: ascii, binary and binary_compressed; fields x y z,
/// normal_x normal_y normal_z, rgb or rgba, radius. An organised cloud marks pixels that saw
/// nothing by nan: these points are left out, and counted in a note. A normal that is nan becomes
/// the zero vector.
Mesh read_pcd(const FileBytes& file);

/// A comment names the columns where there are more than x y z. Colors are whole numbers of 0 to
/// 255 where all are multiples of 1/255, else numbers of 0 to 1.
void write_xyz(const Mesh& mesh, OutputFile& file);

/// A line with the count, then a line a point.
/// Errors: OutputError where there are no normals.
void write_pwn(const Mesh& mesh, OutputFile& file);

/// Binary; colors are bytes. Positions are float32, since PCL's points take nothing else, or
/// double where that would move a point by more than 2⁻²² of the bounding box's diagonal.
void write_pcd(const Mesh& mesh, OutputFile& file);

}  // namespace supple
