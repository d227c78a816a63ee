#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/errors.h"
#include "io/gltf/base64.h"
#include "io/gltf/gltf_color.h"
#include "io/gltf/gltf_formats.h"
#include "io/gltf/gltf_materials.h"
#include "io/gltf/gltf_parts.h"
#include "io/mesh/binary_output.h"
#include "io/mesh/number_types.h"

namespace supple {
namespace {

using nlohmann::json;

// As OpenGL numbers them.
constexpr int uint16_type = 5123, uint32_type = 5125, float_type = 5126;
constexpr int vertex_target = 34962, index_target = 34963;
constexpr int points_mode = 0, triangles_mode = 4;

/// Most vertices that 16 bits count: their last number marks the end of a strip.
constexpr std::size_t most_short = 65535;

class GltfWriter {
 public:
  GltfWriter(const Mesh& mesh, const OutputFile& file)
      : mesh_(mesh), file_(file), origin_(origin_of(mesh.positions)) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Supple"}};
    put_materials();
    json scene = json::array();
    for (const GltfPart& part : gltf_parts(mesh)) {
      scene.push_back(json_["nodes"].size());
      put_part(part);
    }
    json_["scene"] = 0;
    json_["scenes"] = json::array({json{{"nodes", scene}}});
  }

  /// The document, its one buffer not yet in it.
  json& document() { return json_; }
  const std::string& bytes() const { return bytes_; }

 private:
  /// Zero where float32 serves as it is; else a point in the middle, so coarsely rounded that a
  /// shape that was read from its own file has the same one.
  static Vec3 origin_of(const Points& positions) {
    if (!needs_double(positions)) return Vec3::Zero();
    const Box box = bounding_box(positions);
    const double unit = std::exp2(std::ceil(std::log2(std::max(box.diagonal(), 1e-30))));
    return (box.center() / unit).array().round() * unit;
  }

  void put_part(const GltfPart& part) {
    json primitives = json::array();
    const json attributes = put_vertices(part);
    for (const GltfPrimitive& primitive : part.primitives)
      primitives.push_back(primitive_json(primitive, attributes, part.vertices.size()));
    json mesh = {{"primitives", primitives}};
    json node = {{"mesh", json_["meshes"].size()}};
    if (!part.name.empty()) mesh["name"] = node["name"] = part.name;
    if (origin_ != Vec3::Zero()) node["translation"] = {origin_.x(), origin_.y(), origin_.z()};
    json_["meshes"].push_back(mesh);
    json_["nodes"].push_back(node);
  }

  json primitive_json(const GltfPrimitive& primitive, const json& attributes,
                      std::size_t vertices) {
    json result = {{"attributes", attributes}, {"mode", triangles_mode}};
    if (primitive.corners.empty())
      result["mode"] = points_mode;
    else
      result["indices"] = put_indices(primitive.corners, vertices);
    if (!primitive.material.empty()) result["material"] = material(primitive.material);
    return result;
  }

  json put_vertices(const GltfPart& part) {
    json attributes;
    attributes["POSITION"] = put_positions(part);
    if (!mesh_.normals.empty())
      attributes["NORMAL"] = put_floats(part, 3, [&](const GltfVertex& vertex, double* n) {
        Eigen::Map<Vec3> normal(n);
        normal = vertex.normal < 0 ? Vec3::Zero() : Vec3(mesh_.normals.values.row(vertex.normal));
        normal.stableNormalize();
        if (normal.isZero()) normal = Vec3::UnitZ();  // glTF knows unit lengths alone
      });
    if (!mesh_.texcoords.empty())
      attributes["TEXCOORD_0"] = put_floats(part, 2, [&](const GltfVertex& vertex, double* uv) {
        if (vertex.texcoord < 0) return;
        uv[0] = mesh_.texcoords.values(vertex.texcoord, 0);
        uv[1] = 1 - mesh_.texcoords.values(vertex.texcoord, 1);
      });
    if (!mesh_.colors.empty())
      attributes["COLOR_0"] = put_floats(part, 4, [&](const GltfVertex& vertex, double* rgba) {
        for (int channel = 0; channel < 3; ++channel)
          rgba[channel] = linear_from_srgb(mesh_.colors.values(vertex.position, channel));
        rgba[3] = mesh_.colors.values(vertex.position, 3);
      });
    return attributes;
  }

  std::size_t put_positions(const GltfPart& part) {
    const std::size_t accessor = put_floats(part, 3, [&](const GltfVertex& vertex, double* x) {
      Eigen::Map<Vec3> place(x);
      place = mesh_.positions.row(vertex.position).transpose() - origin_;
    });
    const std::size_t begin = json_["bufferViews"].back()["byteOffset"];
    const Eigen::Map<const Eigen::Matrix<float, 3, Eigen::Dynamic>> written(
        reinterpret_cast<const float*>(bytes_.data() + begin), 3,
        static_cast<Index>(part.vertices.size()));
    const Vec3 least = written.rowwise().minCoeff().cast<double>();
    const Vec3 most = written.rowwise().maxCoeff().cast<double>();
    json_["accessors"].back()["min"] = {least.x(), least.y(), least.z()};
    json_["accessors"].back()["max"] = {most.x(), most.y(), most.z()};
    return accessor;
  }

  template <class Value>
  std::size_t put_floats(const GltfPart& part, std::size_t columns, const Value& value_of) {
    constexpr const char* types[] = {"", "", "VEC2", "VEC3", "VEC4"};
    begin_view(vertex_target);
    for (const GltfVertex& vertex : part.vertices) {
      std::array<double, 4> values{};
      value_of(vertex, values.data());
      for (std::size_t column = 0; column < columns; ++column)
        append_binary(bytes_, checked_float(values[column], file_));
    }
    return end_view(float_type, types[columns], part.vertices.size());
  }

  std::size_t put_indices(const std::vector<int>& corners, std::size_t vertices) {
    begin_view(index_target);
    const bool narrow = vertices <= most_short;
    for (const int corner : corners)
      if (narrow)
        append_binary(bytes_, static_cast<std::uint16_t>(corner));
      else
        append_binary(bytes_, static_cast<std::uint32_t>(corner));
    return end_view(narrow ? uint16_type : uint32_type, "SCALAR", corners.size());
  }

  void begin_view(int target) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}};
    if (target != 0) view["target"] = target;
    json_["bufferViews"].push_back(view);
  }

  std::size_t end_view(int type, const char* columns, std::size_t count) {
    close_view();
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", type},
                                  {"type", columns},
                                  {"count", count}});
    return json_["accessors"].size() - 1;
  }

  void close_view() {
    json& view = json_["bufferViews"].back();
    view["byteLength"] = bytes_.size() - view["byteOffset"].get<std::size_t>();
  }

  void put_materials() {
    if (!mesh_.gltf_materials) return;
    const GltfMaterials& from = *mesh_.gltf_materials;
    if (!from.copyright.empty()) json_["asset"]["copyright"] = from.copyright;
    for (std::size_t i = 0; i < from.names.size(); ++i) materials_[from.names[i]] = i;
    const std::pair<const char*, const json&> lists[] = {
        {"materials", from.materials}, {"textures", from.textures}, {"samplers", from.samplers}};
    for (const auto& [key, list] : lists)
      if (!list.empty()) json_[key] = list;
    for (std::size_t i = 0; i < from.images.size(); ++i) put_image(from, i);
    if (!from.extensions.empty()) json_["extensionsUsed"] = from.extensions;
    if (!from.required_extensions.empty()) json_["extensionsRequired"] = from.required_extensions;
  }

  void put_image(const GltfMaterials& from, std::size_t index) {
    json image = from.images[index];
    if (!from.image_bytes[index].empty()) {
      begin_view(0);
      bytes_ += from.image_bytes[index];
      close_view();
      image["bufferView"] = json_["bufferViews"].size() - 1;
    }
    json_["images"].push_back(image);
  }

  /// Number of the material of that name, made where there is none.
  std::size_t material(const std::string& name) {
    const auto [found, is_new] = materials_.try_emplace(name, json_["materials"].size());
    if (is_new) json_["materials"].push_back({{"name", name}});
    return found->second;
  }

  const Mesh& mesh_;
  const OutputFile& file_;
  Vec3 origin_;
  json json_;
  std::string bytes_;
  std::map<std::string, std::size_t> materials_;
};

/// JSON whose texts are Unicode, whatever bytes the names were.
std::string text_of(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

void append_chunk(OutputFile& file, std::string_view kind, std::string_view bytes, char padding) {
  const std::size_t rest = (4 - bytes.size() % 4) % 4;
  std::string header;
  append_binary(header, static_cast<std::uint32_t>(bytes.size() + rest));
  file.write(header.append(kind));
  file.write(bytes);
  file.write(std::string(rest, padding));
}

std::size_t chunk_bytes(std::string_view bytes) {
  return 8 + (bytes.size() + 3) / 4 * 4;
}

}  // namespace

void write_glb(const Mesh& mesh, OutputFile& file) {
  GltfWriter writer(mesh, file);
  writer.document()["buffers"] = json::array({json{{"byteLength", writer.bytes().size()}}});
  const std::string text = text_of(writer.document());
  const std::size_t length = 12 + chunk_bytes(text) + chunk_bytes(writer.bytes());
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw OutputError(fmt::format("{}: cannot write: a GLB has at most 4 GiB, this has {} bytes",
                                  file.path().string(), length));
  std::string header = "glTF";
  append_binary<std::uint32_t>(header, 2);
  append_binary(header, static_cast<std::uint32_t>(length));
  file.write(header);
  append_chunk(file, "JSON", text, ' ');
  append_chunk(file, std::string_view("BIN\0", 4), writer.bytes(), '\0');
}

void write_gltf(const Mesh& mesh, OutputFile& file) {
  GltfWriter writer(mesh, file);
  const std::string uri = "data:application/octet-stream;base64," + to_base64(writer.bytes());
  const json buffer = {{"byteLength", writer.bytes().size()}, {"uri", uri}};
  writer.document()["buffers"] = json::array({buffer});
  file.write(text_of(writer.document()));
}

}  // namespace supple
