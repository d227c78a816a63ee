#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "io/errors.h"
#include "tests/cases/cases.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace supple {
namespace {

/// A file whose bytes have a place `@` for what does not belong there.
struct Template {
  std::string name, bytes;

  std::string with(std::string_view value) const {
    std::string filled = bytes;
    const std::size_t place = filled.find('@');
    return filled.replace(place, 1, value);
  }
};

const std::string ply_head =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ascii_ply = "ply\nformat ascii 1.0\n" + ply_head;
const std::string pcd_head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nHEIGHT 1\n";

/// A number in each format that knows text; the message must name vertex 1, or 2 counted from 1.
const Template texts_with_a_number[] = {
    {"a.obj", "v 0 0 0\nv 1 @ 0\nv 0 1 0\nf 1 2 3\n"},
    {"a.off", "OFF\n3 1 0\n0 0 0\n1 @ 0\n0 1 0\n3 0 1 2\n"},
    {"a.ply", ascii_ply + "0 0 0\n1 @ 0\n0 1 0\n3 0 1 2\n"},
    {"a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 @ 0\nvertex 0 1 0\n"
     "endloop\nendfacet\nendsolid a\n"},
    {"a.xyz", "0 0 0\n1 @ 0\n0 1 0\n"},
    {"a.pwn", "3\n0 0 0 0 0 1\n1 @ 0 0 0 1\n0 1 0 0 0 1\n"},
    {"a.pcd", pcd_head + "WIDTH 3\nPOINTS 3\nDATA ascii\n0 0 0\n1 @ 0\n0 1 0\n"}};

/// How InputError calls what is wrong; empty where the file is read.
std::string refusal(const std::filesystem::path& path) {
  try {
    read_mesh(path);
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

bool names_second_vertex(const std::string& message) {
  const auto holds = [&](const char* words) { return message.find(words) != std::string::npos; };
  return holds("vertex 1") || holds("vertex 2") || holds("point 1") || holds("point 2");
}

template <class Number>
std::string little_endian(Number number) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  return {bytes.begin(), bytes.end()};
}

/// Three points (0, 0, 0), (0, `odd`, 0), (0, 0, 0) with `per_point` more zero bytes each.
std::string binary_points(float odd, std::size_t per_point = 0) {
  std::string bytes(3 * (12 + per_point), '\0');
  return bytes.replace(12 + per_point + 4, 4, little_endian(odd));
}

std::vector<SampleFile> binaries_with(float odd) {
  const std::string face = "\3" + little_endian(0) + little_endian(1) + little_endian(2);
  return {
      {"a.ply", "ply\nformat binary_little_endian 1.0\n" + ply_head + binary_points(odd) + face},
      {"a.stl", std::string(80, '\0') + little_endian(1) + std::string(12, '\0') +
                    binary_points(odd) + std::string(2, '\0')},
      {"a.pcd", pcd_head + "WIDTH 3\nPOINTS 3\nDATA binary\n" + binary_points(odd)}};
}

/// A pixel of a depth camera that saw nothing is (nan, nan, nan) in PCD: left out, and said.
bool is_told_hole(const SampleFile& file, const std::filesystem::path& path) {
  return file.name == "a.pcd" && refusal(path).empty() && !read_mesh(path).notes.empty();
}

void measure_not_finite(Figures& figures) {
  const TemporaryFolder folder;
  std::vector<SampleFile> files;
  for (const Template& text : texts_with_a_number)
    for (const char* number : {"inf", "-inf", "nan", "-nan", "1e400", "-1e400", "infinity", "NAN"})
      files.push_back({text.name, text.with(number)});
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float odd : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()})
    for (SampleFile& file : binaries_with(odd)) files.push_back(std::move(file));
  int accepted = 0, named = 0;
  for (const SampleFile& file : files) {
    const std::filesystem::path path = folder.put(file.name, file.bytes);
    if (is_told_hole(file, path)) continue;
    const std::string message = refusal(path);
    accepted += message.empty();
    named += names_second_vertex(message);
    if (!names_second_vertex(message)) fmt::print(stderr, "K1: {}: {}\n", file.name, message);
  }
  int read = 0;
  for (const Template& text : texts_with_a_number)
    read += refusal(folder.put(text.name, text.with("0.5"))).empty();
  for (const SampleFile& file : binaries_with(0.5f))
    read += refusal(folder.put(file.name, file.bytes)).empty();
  figures = {{"accepted", accepted}, {"named", named}, {"control_read", read}};
}

void measure_empty_files(Figures& figures) {
  const TemporaryFolder folder;
  double refused = 0, said = 0, count = 0;
  std::vector<std::string> names = {"a.unknown", "noextension"};
  for (const SampleFile& sample : sample_files()) names.push_back(sample.name);
  for (const std::string& name : names) {
    folder.put(name, "");
    const ProgramResult run = Program(SUPPLE_PROGRAM, {"inspect", name}, folder.path()).wait();
    refused += run.code == 3;
    said += run.err.find("empty") != std::string::npos;
    ++count;
  }
  folder.put("a.yaml", "");
  const ProgramResult run = Program(SUPPLE_PROGRAM, {"plan", "a.yaml"}, folder.path()).wait();
  figures["refused"] = refused / count;
  figures["said"] = said / count;
  figures["scene_exit_code"] = run.code;
  figures["scene_placed"] = run.err.starts_with("supple: a.yaml:1:1: the scene is empty");
}

/// A count in each format that states one.
std::vector<SampleFile> exaggerated_files() {
  const std::string binary = "ply\nformat binary_little_endian 1.0\n";
  const Template counted[] = {
      {"a.off", "OFF\n@ 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.off", "OFF\n3 @ 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n@ 0 1 2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex @\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n0 0 0\n"},
      {"a.ply", binary +
                    "element vertex @\nproperty float x\nproperty float y\n"
                    "property float z\nend_header\n" +
                    std::string(36, '\0')},
      {"a.ply", binary +
                    "element vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nelement face @\nproperty list uchar int "
                    "vertex_indices\nend_header\n" +
                    std::string(40, '\0')},
      {"a.ply", binary +
                    "element vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nelement odd @\nproperty list uchar int "
                    "odd\nend_header\n" +
                    std::string(40, '\0')},
      {"a.pwn", "@\n0 0 0 0 0 1\n1 0 0 0 0 1\n"},
      {"a.xyz", "@\n0 0 0\n1 0 0\n"},
      {"a.pcd", pcd_head + "WIDTH @\nPOINTS 3\nDATA binary\n" + std::string(36, '\0')},
      {"a.pcd", pcd_head + "WIDTH 3\nPOINTS @\nDATA binary\n" + std::string(36, '\0')},
      {"a.pcd", pcd_head + "WIDTH 3\nPOINTS @\nDATA ascii\n0 0 0\n"}};
  std::vector<SampleFile> files;
  for (const Template& file : counted)
    for (const char* count :
         {"100000", "4000000000", "4294967295", "9223372036854775807", "18446744073709551615"})
      files.push_back({file.name, file.with(count)});
  for (const std::uint32_t count : {100'000u, 1u << 31, ~0u})
    files.push_back(
        {"a.stl", std::string(80, '\0') + little_endian(count) + std::string(50, '\0')});
  for (const std::uint32_t size : {1u << 28, 1u << 31, ~0u}) {
    const std::string head = pcd_head + "WIDTH 3\nPOINTS 3\nDATA binary_compressed\n";
    files.push_back({"a.pcd", head + little_endian(8u) + little_endian(size) + "12345678"});
    files.push_back({"a.pcd", head + little_endian(size) + little_endian(36u) + "12345678"});
  }
  for (const std::uint32_t corners : {1u << 30, ~0u})
    files.push_back({"a.ply", binary +
                                  "element vertex 1\nproperty float x\nproperty float y\n"
                                  "property float z\nelement face 1\nproperty list uint int "
                                  "vertex_indices\nend_header\n" +
                                  std::string(12, '\0') + little_endian(corners) +
                                  std::string(12, '\0')});
  return files;
}

void measure_exaggerated_counts(Figures& figures) {
  const TemporaryFolder folder;
  double seconds = 0, bytes = 0;
  int refused = 0, count = 0;
  for (const SampleFile& file : exaggerated_files()) {
    folder.put(file.name, file.bytes);
    const ProgramResult run = Program(SUPPLE_PROGRAM, {"inspect", file.name}, folder.path()).wait();
    seconds = std::max(seconds, run.seconds);
    bytes = std::max(bytes, run.peak_bytes);
    refused += run.code == 3;
    ++count;
    if (run.code != 3) fmt::print(stderr, "K4: {} is read: {}\n", file.name, run.out);
  }
  figures = {{"refused", refused / static_cast<double>(count)},
             {"seconds", seconds},
             {"peak_gigabytes", bytes / 1e9}};
}

/// An index of a corner in each format with faces; what counts from 0 and what from 1.
const Template indices_from_0[] = {{"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 @\n"},
                                   {"a.ply", ascii_ply + "0 0 0\n1 0 0\n0 1 0\n3 0 1 @\n"}};
const Template indices_from_1[] = {
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 @\n"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/@\n"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//2 3//@\n"}};

void measure_indices(Figures& figures) {
  const TemporaryFolder folder;
  int tried = 0, accepted = 0, named = 0;
  const auto measure = [&](const Template& file, const std::vector<std::string>& indices) {
    for (const std::string& index : indices) {
      const std::string message = refusal(folder.put(file.name, file.with(index)));
      ++tried;
      accepted += message.empty();
      named += message.find(index) != std::string::npos;
    }
  };
  const std::vector<std::string> far = {"77", "2147483648", "4294967296", "9999999999999999999"};
  for (const Template& file : indices_from_0) {
    measure(file, {"3", "-1", "-2147483648"});
    measure(file, far);
  }
  for (const Template& file : indices_from_1) {
    measure(file, {"4", "0", "-4", "-2147483648"});
    measure(file, far);
  }
  for (const std::uint32_t index : {3u, 77u, ~0u}) {
    const std::string message = refusal(
        folder.put("a.ply", "ply\nformat binary_little_endian 1.0\n" + ply_head + binary_points(1) +
                                "\3" + little_endian(0) + little_endian(1) + little_endian(index)));
    ++tried;
    accepted += message.empty();
    named += message.find(fmt::format("{}", static_cast<int>(index))) != std::string::npos;
  }
  figures["accepted"] = accepted;
  figures["named"] = named / static_cast<double>(tried);
}

constexpr Case cases[] = {{"K1", measure_not_finite},
                          {"K2", measure_empty_files},
                          {"K4", measure_exaggerated_counts},
                          {"K5", measure_indices}};

}  // namespace

std::span<const Case> hostile_file_cases() {
  return cases;
}

}  // namespace supple
