#include "io/gltf/gltf_document.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/gltf/base64.h"

namespace supple {
namespace {

using nlohmann::json;

constexpr std::string_view magic = "glTF";
constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

/// The JSON library writes by recursion; real files nest ten deep.
constexpr int deepest = 200;

/// Of all buffers: a small file must not name a large one many times.
constexpr std::size_t most_bytes = std::size_t{1} << 32;

[[noreturn]] void fail(const std::string& name, std::string_view message) {
  throw InputError(fmt::format("{}: {}", name, message));
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

/// The parts of a file, still in its bytes.
struct Parts {
  std::string_view text, binary;
  bool has_binary = false;
};

Parts split_container(const FileBytes& file, std::vector<std::string>& notes) {
  const std::string_view bytes = file.bytes;
  if (bytes.size() < header_bytes) fail(file.name, "the file is cut short");
  if (word_at(bytes, 4) != 2)
    fail(file.name, fmt::format("GLB of version {}; only 2 is read", word_at(bytes, 4)));
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size())
    fail(file.name, fmt::format("the file is cut short: its header says {} bytes, it has {}",
                                length, bytes.size()));
  if (length < bytes.size())
    notes.push_back(
        fmt::format("left out: {} bytes after the end of the GLB", bytes.size() - length));
  Parts parts;
  for (std::size_t at = header_bytes; at < length;) {
    if (length - at < chunk_header_bytes) fail(file.name, fmt::format("byte {}: half a chunk", at));
    const std::size_t size = word_at(bytes, at);
    const std::uint32_t kind = word_at(bytes, at + 4);
    const std::size_t begin = at + chunk_header_bytes;
    if (size > length - begin)
      fail(file.name,
           fmt::format("byte {}: a chunk of {} bytes, {} are left", at, size, length - begin));
    if (at == header_bytes && kind != json_chunk) fail(file.name, "its first chunk is not JSON");
    if (kind == json_chunk && parts.text.empty()) parts.text = bytes.substr(begin, size);
    if (kind == binary_chunk && !parts.has_binary) {
      parts.binary = bytes.substr(begin, size);
      parts.has_binary = true;
    }
    at = begin + size;
  }
  return parts;
}

void check_depth(std::string_view text, const std::string& name) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepest)
        fail(name, fmt::format("the JSON nests deeper than {} at byte {} of it", deepest, i));
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

json parse(std::string_view text, const std::string& name) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  check_depth(text, name);
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    const std::string_view what = error.what();
    fail(name, fmt::format("it is not JSON: {}", what.substr(0, 200)));
  }
}

void check_asset(const GltfDocument& document) {
  const GltfObject asset = document.root().object("asset");
  const std::string version = asset.text("version", "");
  if (!version.starts_with("2."))
    asset.fail(fmt::format("version \"{}\"; only glTF 2 is read", version.substr(0, 40)));
}

/// Extensions without which the vertices are still what they are.
bool is_known(std::string_view extension) {
  constexpr std::string_view beginnings[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                             "MSFT_texture_", "KHR_lights_"};
  return extension == "KHR_mesh_quantization" ||
         std::any_of(std::begin(beginnings), std::end(beginnings),
                     [&](std::string_view beginning) { return extension.starts_with(beginning); });
}

void check_extensions(const GltfDocument& document) {
  const GltfObject root = document.root();
  for (std::size_t i = 0; i < root.size("extensionsRequired"); ++i) {
    const json& extension = document.json["extensionsRequired"][i];
    if (!extension.is_string()) root.fail("extensionsRequired: texts are expected");
    const std::string name = extension.get<std::string>();
    if (!is_known(name))
      root.fail(fmt::format("it requires the extension {}, which is not read; save it without",
                            name.substr(0, 80)));
  }
}

void take_buffers(GltfDocument& document, const Parts& parts) {
  const GltfObject root = document.root();
  std::size_t read = 0;
  for (std::size_t i = 0; i < root.size("buffers"); ++i) {
    const GltfObject buffer = root.item("buffers", i);
    const std::size_t length = buffer.whole("byteLength");
    std::string bytes;
    if (buffer.has("uri"))
      bytes = uri_bytes(document, buffer.text("uri", ""));
    else if (i == 0 && parts.has_binary)
      bytes = parts.binary;
    else
      buffer.fail("it has no bytes: neither a URI nor a binary chunk");
    if (bytes.size() < length)
      buffer.fail(fmt::format("cut short: byteLength is {}, there are {}", length, bytes.size()));
    read += bytes.size();
    if (read > most_bytes)
      buffer.fail(fmt::format("the buffers have more than {} bytes", most_bytes));
    bytes.resize(length);
    bytes.shrink_to_fit();
    document.buffers.push_back(std::move(bytes));
  }
}

/// %XX as the byte that it stands for.
std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char value = 0;
    const std::string_view digits = uri.substr(i + 1, 2);
    const char* const end = digits.data() + digits.size();
    if (uri[i] == '%' && digits.size() == 2 &&
        std::from_chars(digits.data(), end, value, 16).ptr == end) {
      text += static_cast<char>(value);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// A file may name what lies beside it, and nothing else of the user's: not by links either.
bool stays_in_folder(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path root = std::filesystem::weakly_canonical(folder, error);
  const std::filesystem::path place = std::filesystem::weakly_canonical(root / path, error);
  if (error || path.empty() || path.is_absolute()) return false;
  return std::mismatch(root.begin(), root.end(), place.begin(), place.end()).first == root.end();
}

}  // namespace

std::size_t GltfDocument::size() const {
  std::size_t bytes = 0;
  for (const std::string& buffer : buffers) bytes += buffer.size();
  return bytes;
}

GltfDocument open_gltf(const FileBytes& file) {
  GltfDocument document;
  document.name = file.name;
  Parts parts{.text = file.bytes, .binary = {}};
  if (file.bytes.starts_with(magic)) parts = split_container(file, document.notes);
  document.json = parse(parts.text, file.name);
  check_asset(document);
  check_extensions(document);
  take_buffers(document, parts);
  return document;
}

std::string_view view_bytes(const GltfDocument& document, std::size_t index) {
  const GltfObject view = document.root().item("bufferViews", index);
  const std::size_t buffer = view.index("buffer", document.buffers.size(), "buffers");
  const std::size_t offset = view.whole("byteOffset", 0), length = view.whole("byteLength");
  const std::string_view bytes = document.buffers[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset)
    view.fail(
        fmt::format("{} bytes from {} on, buffer {} has {}", length, offset, buffer, bytes.size()));
  if (length == 0) view.fail("it has no bytes");
  return bytes.substr(offset, length);
}

std::string uri_bytes(const GltfDocument& document, std::string_view uri) {
  if (uri.starts_with("data:")) {
    constexpr std::string_view mark = ";base64,";
    const std::size_t at = uri.substr(0, 200).find(mark);
    const auto bytes = at == uri.npos ? std::nullopt : from_base64(uri.substr(at + mark.size()));
    if (!bytes) fail(document.name, "a data URI is not Base64");
    return *bytes;
  }
  const std::filesystem::path path = percent_decoded(uri);
  const std::filesystem::path folder = std::filesystem::absolute(document.name).parent_path();
  if (!stays_in_folder(path, folder))
    fail(document.name, fmt::format("\"{}\" is not read: it is no file in the folder of this one",
                                    uri.substr(0, 200)));
  return read_file_bytes(std::filesystem::path(document.name).parent_path() / path).bytes;
}

std::string short_name(const GltfObject& object) {
  constexpr std::size_t most = 500;
  return object.text("name", "").substr(0, most);
}

}  // namespace supple
