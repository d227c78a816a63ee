#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/mesh/mesh_files.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

using Json = nlohmann::json;

/// Runs `supple inspect` and `supple render` beside a bar along y and the same without an end.
/// The name puts it among the tests that draw.
class InspectProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    Mesh bar = make_bar({0.2, 1, 0.2}, {4, 20, 4});
    write_mesh(bar, folder / "bar.obj");
    bar.face_starts.resize(bar.face_starts.size() - 2);
    bar.face_vertices.resize(bar.face_vertices.size() - 6);
    write_mesh(bar, folder / "open.obj");
  }

  ProgramResult run(std::vector<std::string> words) const {
    return Program(SUPPLE_PROGRAM, std::move(words), folder.path()).wait();
  }

  Json inspect_json(std::vector<std::string> words) const {
    words.insert(words.begin(), "inspect");
    words.push_back("--json");
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return Json::parse(result.out);
  }

  void expect_usage_error(const std::vector<std::string>& words, const std::string& part) const {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }

  TemporaryFolder folder;
};

/// Dotted names of all keys of objects; what arrays hold by "[]".
void collect_keys(const Json& json, const std::string& prefix,
                  const std::function<void(const std::string&)>& take) {
  if (json.is_array() && !json.empty()) collect_keys(json.front(), prefix + "[]", take);
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    const std::string name = prefix.empty() ? key : prefix + "." + key;
    take(name);
    collect_keys(value, name, take);
  }
}

TEST_F(InspectProgramTest, SaysWhatAShapeIs) {
  const ProgramResult result = run({"inspect", "bar.obj"});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* part :
       {"shape      ", "size       0.2 x 1 x 0.2", "watertight, genus 0", "components 1\n",
        "poses as a solid of volume 0.04", "thickness  ", "advice     200 particles"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " in\n" << result.out;
  EXPECT_EQ(run({"inspect", "bar.obj", "--quiet"}).out, "");
}

TEST_F(InspectProgramTest, DefectiveShapesAreInspectedToo) {
  const ProgramResult result = run({"inspect", "open.obj"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("not watertight: open"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("4 boundary edges: vertices "), std::string::npos) << result.out;
  const Json json = inspect_json({"open.obj"});
  EXPECT_EQ(json["surface"]["defects"]["boundary_edges"]["count"], 4);
  EXPECT_EQ(json["surface"]["defects"]["boundary_edges"]["where"].size(), 4u);
  EXPECT_EQ(json["surface"]["watertight"], false);
  EXPECT_TRUE(json["surface"]["genus"].is_null());
}

TEST_F(InspectProgramTest, JsonHoldsNumbers) {
  const Json json = inspect_json({"bar.obj", "--particles", "60", "--select", "y>90%"});
  EXPECT_EQ(json["command"], "inspect");
  EXPECT_EQ(json["shape"]["kind"], "mesh");
  EXPECT_NEAR(json["size"]["diagonal"].get<double>(), std::sqrt(1.08), 1e-6);
  EXPECT_EQ(json["surface"]["watertight"], true);
  EXPECT_EQ(json["solid"]["status"], "ok");
  EXPECT_NEAR(json["solid"]["volume"].get<double>(), 0.04, 1e-6);
  EXPECT_NEAR(json["thickness"]["quantiles_percent"]["50"].get<double>(), 0.2, 1e-3);
  EXPECT_EQ(json["thickness"]["particles"], 60);
  EXPECT_NEAR(json["selection"]["area_share"].get<double>(), (0.04 + 0.08) / 0.88, 0.02);
  EXPECT_EQ(json["components"]["count"], 1);
  EXPECT_GE(json["seconds"]["total"].get<double>(), json["seconds"]["survey"].get<double>());
}

TEST_F(InspectProgramTest, TheManualNamesEveryKey) {
  const std::string manual = bytes_of(std::filesystem::path(SUPPLE_SOURCE_DIR) / "docs/inspect.md");
  folder.put("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  for (const Json& json : {inspect_json({"open.obj", "--select", "y>50%"}),
                           inspect_json({"bar.obj"}), inspect_json({"cloud.obj"})})
    collect_keys(json, "", [&](const std::string& name) {
      const std::string last = name.substr(name.rfind('.') + 1);
      EXPECT_NE(manual.find("`" + last + "`"), std::string::npos) << name;
    });
}

TEST_F(InspectProgramTest, ReportIsTheSameJson) {
  const ProgramResult result = run({"inspect", "bar.obj", "--report", "bar.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("wrote      bar.json"), std::string::npos);
  Json report = Json::parse(bytes_of(folder / "bar.json")), printed = inspect_json({"bar.obj"});
  report.erase("seconds");
  printed.erase("seconds");
  EXPECT_EQ(report, printed);
}

TEST_F(InspectProgramTest, PicturesShowTheInside) {
  for (const std::string inside : {"particles", "supports", "cells", "slice"}) {
    EXPECT_EQ(run({"inspect", "bar.obj", "--show", inside, "--size", "160x120", "--particles", "40",
                   "-o", "a" + inside + ".png"})
                  .code,
              0)
        << inside;
    const ProgramResult rendered = run({"render", "bar.obj", "--show", inside, "--size", "160x120",
                                        "--particles", "40", "-o", "b" + inside + ".png"});
    EXPECT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(bytes_of(folder / ("b" + inside + ".png")).substr(1, 3), "PNG");
  }
  EXPECT_NE(bytes_of(folder / "bparticles.png"), bytes_of(folder / "bslice.png"));
  EXPECT_EQ(run({"inspect", "open.obj", "--select", "y>50%", "-o", "open.png"}).code, 0);
}

TEST_F(InspectProgramTest, WhatCannotBeShownEndsWith1) {
  folder.put("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const std::string command : {"inspect", "render"}) {
    const ProgramResult result = run({command, "flat.obj", "--show", "slice", "-o", "flat.png"});
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_GT(result.err.size(), 20u);
    EXPECT_FALSE(std::filesystem::exists(folder / "flat.png"));
  }
}

TEST_F(InspectProgramTest, ComplainsOfWordsThatDoNotFit) {
  expect_usage_error({"inspect"}, "FILE is missing");
  expect_usage_error({"inspect", "bar.obj", "--show", "slcie", "-o", "a.png"},
                     "did you mean 'slice'?");
  expect_usage_error({"inspect", "bar.obj", "--show", "slice"}, "give -o FILE.png");
  expect_usage_error({"inspect", "bar.obj", "-o", "a.jpg"}, ".png");
  expect_usage_error({"inspect", "bar.obj", "--particles", "0"}, "from 1 to");
  expect_usage_error({"inspect", "bar.obj", "--spacing", "-1%"}, "above 0");
  expect_usage_error({"inspect", "bar.obj", "--spacing", "1%", "--particles", "9"}, "only one");
  expect_usage_error({"inspect", "bar.obj", "--select", "y"}, "quote it");
  expect_usage_error({"inspect", "bar.obj", "--select", "y>200%"}, "selects nothing");
  expect_usage_error({"render", "bar.obj", "-o", "a.png", "--particles", "9"}, "--show");
}

TEST_F(InspectProgramTest, FilesThatCannotBeReadOrWrittenEndWith3) {
  EXPECT_EQ(run({"inspect", "missing.obj"}).code, 3);
  EXPECT_EQ(run({"inspect", "bar.obj", "-o", "no/such/a.png"}).code, 3);
  EXPECT_EQ(run({"inspect", "bar.obj", "--report", "no/such/a.json"}).code, 3);
}

}  // namespace
}  // namespace supple
