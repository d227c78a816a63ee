#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/mesh/mesh_files.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace supple {

using Json = nlohmann::json;

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in:\n" << text;
}

inline void expect_lacks(const std::string& text, const std::string& part) {
  EXPECT_EQ(text.find(part), std::string::npos) << "\"" << part << "\" in:\n" << text;
}

/// Runs the built program in a fresh folder that holds a bar along y and a scene for it.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(make_bar({0.2, 1, 0.2}, {4, 20, 4}), folder / "bar.obj");
    folder.put("scene.yaml",
               "shape: {mesh: bar.obj, particles: 60}\n"
               "pose:\n"
               "  handles:\n"
               "    - fix: y<10%\n"
               "    - move: y>90%\n"
               "      by: [10%, 0, 0]\n");
  }

  ProgramResult run(std::vector<std::string> words) const {
    return Program(SUPPLE_PROGRAM, std::move(words), folder.path()).wait();
  }

  /// `words` behind a pose of the bar that would work.
  ProgramResult pose_bar(std::vector<std::string> words) const {
    std::vector<std::string> all = {"pose",  "bar.obj", "--particles", "60", "--fix",
                                    "y<10%", "--move",  "y>90%",       "-o", "posed.obj"};
    all.insert(all.end(), words.begin(), words.end());
    return run(all);
  }

  bool exists(const std::string& name) const { return std::filesystem::exists(folder / name); }

  Json json(const std::string& name) const { return Json::parse(bytes_of(folder / name)); }

  TemporaryFolder folder;
};

inline void expect_usage_error(const ProgramResult& result, const std::string& words) {
  EXPECT_EQ(result.code, 2) << result.err;
  expect_contains(result.err, words);
  EXPECT_EQ(result.out, "");
}

}  // namespace supple
