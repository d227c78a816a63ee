#include "io/gltf/gltf_materials.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "io/errors.h"

namespace supple {
namespace {

using nlohmann::json;

/// Of images beside the file.
constexpr std::size_t most_image_bytes = std::size_t{1} << 29;

json array_of(const GltfDocument& document, const char* key) {
  const GltfObject root = document.root();
  for (std::size_t i = 0; i < root.size(key); ++i) root.item(key, i);
  return root.has(key) ? document.json[key] : json::array();
}

/// Looks through a material for what refers to textures; takes out those that need other texture
/// coordinates than the first.
class TextureReferences {
 public:
  explicit TextureReferences(std::size_t textures) : textures_(textures) {}

  int taken_out() const { return taken_out_; }

  void check(json& object, const std::string& path) {
    if (!object.is_object()) return;
    for (auto member = object.begin(); member != object.end();) {
      const bool is_texture = member.key().ends_with("Texture") && member->is_object();
      if (is_texture && uses_other_coordinates({*member, path + "." + member.key()})) {
        member = object.erase(member);
        ++taken_out_;
        continue;
      }
      if (member.key() != "extras") check(*member, path);
      ++member;
    }
  }

 private:
  bool uses_other_coordinates(const GltfObject& texture) const {
    texture.index("index", textures_, "textures");
    constexpr const char* moved = "KHR_texture_transform";
    const std::size_t set = texture.whole("texCoord", 0);
    if (!texture.has("extensions") || !texture.object("extensions").has(moved)) return set > 0;
    return texture.object("extensions").object(moved).whole("texCoord", set) > 0;
  }

  std::size_t textures_;
  int taken_out_ = 0;
};

/// Extensions of a texture name images of other kinds, as `source` does.
void check_texture(const GltfObject& texture, const GltfMaterials& materials) {
  const auto check_source = [&](const GltfObject& object) {
    if (object.has("source")) object.index("source", materials.images.size(), "images");
  };
  check_source(texture);
  if (texture.has("sampler")) texture.index("sampler", materials.samplers.size(), "samplers");
  if (!texture.has("extensions")) return;
  const GltfObject extensions = texture.object("extensions");
  for (const auto& extension : extensions.value().items())
    if (extension.value().is_object()) check_source(extensions.object(extension.key()));
}

std::string media_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xff\xd8")) return "image/jpeg";
  if (bytes.starts_with("RIFF")) return "image/webp";
  if (bytes.starts_with("\xabKTX 20")) return "image/ktx2";
  return {};
}

/// The bytes of an image. Files are embedded only where they are images: a file must not make the
/// user give away what else lies in its folder.
std::string image_bytes(const GltfDocument& document, const GltfObject& image) {
  if (image.has("bufferView")) {
    const std::size_t views = document.root().size("bufferViews");
    return std::string(view_bytes(document, image.index("bufferView", views, "bufferViews")));
  }
  const std::string uri = image.text("uri", "");
  std::string bytes = uri_bytes(document, uri);
  if (bytes.empty() || (!uri.starts_with("data:") && media_type(bytes).empty()))
    image.fail(fmt::format("\"{}\" is no PNG, JPEG, WebP or KTX2", uri.substr(0, 200)));
  return bytes;
}

/// The same, taken out of the JSON; where they cannot be had its URI stays.
std::string take_image(const GltfDocument& document, const GltfObject& source, json& image,
                       std::vector<std::string>& missing) {
  std::string bytes;
  try {
    bytes = image_bytes(document, source);
  } catch (const InputError& error) {
    if (!source.has("uri")) throw;
    missing.emplace_back(error.what());
    return {};
  }
  image.erase("bufferView");
  image.erase("uri");
  if (!image.contains("mimeType")) {
    const std::string type = media_type(bytes);
    image["mimeType"] = type.empty() ? "application/octet-stream" : type;
  }
  return bytes;
}

/// The names by which faces are tagged: the file's, made different where they are not.
std::vector<std::string> different_names(const GltfDocument& document) {
  const GltfObject root = document.root();
  std::vector<std::string> names;
  std::set<std::string> taken;
  std::map<std::string, int> copies;
  for (std::size_t i = 0; i < root.size("materials"); ++i) {
    const std::string given = short_name(root.item("materials", i));
    const std::string base = given.empty() ? fmt::format("material {}", i) : given;
    std::string name = base;
    int& copy = copies.try_emplace(base, 1).first->second;
    while (!taken.insert(name).second) name = fmt::format("{} ({})", base, ++copy);
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> used_extensions(const GltfMaterials& materials) {
  std::set<std::string> used;
  const auto collect = [&](const auto& self, const json& value) -> void {
    if (value.is_object() && value.contains("extensions") && value["extensions"].is_object())
      for (const auto& extension : value["extensions"].items()) used.insert(extension.key());
    if (value.is_structured())
      for (const json& member : value) self(self, member);
  };
  for (const json* list :
       {&materials.materials, &materials.textures, &materials.samplers, &materials.images})
    collect(collect, *list);
  return {used.begin(), used.end()};
}

}  // namespace

std::shared_ptr<const GltfMaterials> take_materials(const GltfDocument& document,
                                                    std::vector<std::string>& notes) {
  const GltfObject root = document.root();
  auto result = std::make_shared<GltfMaterials>();
  result->copyright = root.object("asset").text("copyright", "");
  result->materials = array_of(document, "materials");
  if (result->materials.empty() && result->copyright.empty()) return nullptr;
  result->textures = array_of(document, "textures");
  result->samplers = array_of(document, "samplers");
  result->images = array_of(document, "images");
  TextureReferences references(result->textures.size());
  for (std::size_t i = 0; i < result->materials.size(); ++i)
    references.check(result->materials[i], root.item("materials", i).path());
  for (std::size_t i = 0; i < result->textures.size(); ++i)
    check_texture(root.item("textures", i), *result);
  std::size_t bytes = 0;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < result->images.size(); ++i) {
    const GltfObject image = root.item("images", i);
    result->image_bytes.push_back(take_image(document, image, result->images[i], missing));
    bytes += result->image_bytes.back().size();
    if (bytes > document.size() + most_image_bytes)
      image.fail("the images together are larger than they could be without sharing their bytes");
  }
  result->names = different_names(document);
  result->extensions = used_extensions(*result);
  for (std::size_t i = 0; i < root.size("extensionsRequired"); ++i) {
    const std::string name = document.json["extensionsRequired"][i];
    if (std::binary_search(result->extensions.begin(), result->extensions.end(), name))
      result->required_extensions.push_back(name);
  }
  if (!missing.empty())
    notes.push_back(fmt::format("{} images are only named, their bytes are missing: {}",
                                missing.size(), missing.front()));
  if (references.taken_out() > 0)
    notes.push_back(
        fmt::format("left out: {} textures of materials that lie by other texture "
                    "coordinates than the first",
                    references.taken_out()));
  return result;
}

}  // namespace supple
