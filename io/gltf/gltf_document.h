#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/file_bytes.h"
#include "io/gltf/gltf_object.h"

namespace supple {

/// A glTF file opened: its JSON, and the bytes of its buffers.
struct GltfDocument {
  std::string name;  ///< of the file, for messages
  nlohmann::json json;
  std::vector<std::string> buffers;
  std::vector<std::string> notes;

  GltfObject root() const { return {json, name + ": "}; }
  /// Bytes of all buffers.
  std::size_t size() const;
};

/// Opens text or GLB: the container, the JSON, the version, the extensions that are required, the
/// buffers (in the file, in data URIs, or beside it in its folder).
/// Errors: InputError.
GltfDocument open_gltf(const FileBytes& file);

/// The bytes of a buffer view.
/// Errors: InputError where it lies outside its buffer.
std::string_view view_bytes(const GltfDocument& document, std::size_t view);

/// The bytes that a URI stands for: of a data URI, or of a file in the folder of `document` or
/// below.
/// Errors: InputError where it is neither, or cannot be read.
std::string uri_bytes(const GltfDocument& document, std::string_view uri);

/// The beginning of a name: a small file must not become a large one by repeating a long one.
std::string short_name(const GltfObject& object);

}  // namespace supple
