#pragma once

#include <string>
#include <string_view>

#include "io/mesh/mesh.h"

namespace supple {

/// `name` as OBJ can hold it: on one line, no comment, no line joined to the next. Names that come
/// from OBJ stay as they are.
std::string plain_name(std::string_view name);

/// Whether no name of the mesh's tags and material libraries needs that.
bool names_are_plain(const Mesh& mesh);

}  // namespace supple
