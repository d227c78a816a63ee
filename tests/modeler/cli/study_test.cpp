#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/mesh/mesh_files.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

using Json = nlohmann::json;

/// Runs the built program in a fresh folder that holds a small bar and a scene for it.
class StudyProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(make_bar({0.2, 1, 0.2}, {2, 10, 2}), folder / "bar.obj");
    folder.put("scene.yaml",
               "shape: {mesh: bar.obj, particles: 30}\n"
               "pose:\n"
               "  handles:\n"
               "    - fix: y<10%\n"
               "    - move: y>90%\n"
               "      by: [10%, 0, 0]\n");
  }

  ProgramResult study(std::vector<std::string> words) const {
    std::vector<std::string> all = {"study", "scene.yaml", "--quick"};
    all.insert(all.end(), words.begin(), words.end());
    return Program(SUPPLE_PROGRAM, std::move(all), folder.path()).wait();
  }

  bool exists(const std::string& name) const { return std::filesystem::exists(folder / name); }

  TemporaryFolder folder;
};

/// Whether every element of an XML text is closed in its turn, and all "&" are references.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = xml.find_first_of("<&", at)) != std::string::npos; ++at) {
    if (xml[at] == '&') {
      const std::size_t end = xml.find(';', at);
      if (end == std::string::npos || end - at > 8) return false;
      continue;
    }
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (tag[0] == '!') continue;
    if (tag[0] == '/') {
      if (open.empty() || "/" + open.back() != tag) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty();
}

/// The keys of all objects in a JSON value.
void collect_keys(const Json& json, std::set<std::string>& keys) {
  if (json.is_object())
    for (const auto& [key, value] : json.items()) {
      // The scene's keys and the names of stages are values here.
      if (key != "set") collect_keys(value, keys);
      keys.insert(key);
    }
  if (json.is_array())
    for (const Json& value : json) collect_keys(value, keys);
}

void expect_usage_error(const ProgramResult& result, const std::string& words) {
  EXPECT_EQ(result.code, 2) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST(WellFormed, IsTold) {
  EXPECT_TRUE(is_well_formed("<!DOCTYPE html><a b=\"c\"><d/>x &amp; y</a>"));
  EXPECT_FALSE(is_well_formed("<a><b></a></b>"));
  EXPECT_FALSE(is_well_formed("<a>x & y</a>"));
  EXPECT_FALSE(is_well_formed("<a>"));
}

TEST_F(StudyProgramTest, WritesTablesAndCharts) {
  const ProgramResult run =
      study({"-o", "study", "--knobs", "particles,tolerance", "--report", "r.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* file : {"study.csv", "study.json", "study.svg", "study.png", "study.html"})
    EXPECT_GT(std::filesystem::file_size(folder / "study" / file), 100u) << file;
  EXPECT_TRUE(is_well_formed(bytes_of(folder / "study/study.svg")));
  const std::string page = bytes_of(folder / "study/study.html");
  EXPECT_TRUE(is_well_formed(page));
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos) << "the page needs no other file";
  EXPECT_EQ(bytes_of(folder / "study/study.json"), bytes_of(folder / "r.json"));
  EXPECT_NE(run.out.find("Pareto front"), std::string::npos) << run.out;
}

TEST_F(StudyProgramTest, RowsHoldWhatWasMeasured) {
  const ProgramResult run = study({"-o", "study", "--knobs", "particles,tolerance", "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  const Json json = Json::parse(bytes_of(folder / "study/study.json"));
  ASSERT_EQ(json["rows"].size(), 3u + 4) << "15, 30, 60 particles; 3 tolerances and the own";
  for (const Json& row : json["rows"]) {
    EXPECT_EQ(row["status"], "ok");
    EXPECT_GT(row["error"].get<double>(), 0);
    EXPECT_LT(row["error"].get<double>(), 0.1);
    EXPECT_GT(row["total_error"].get<double>(), 0);
    EXPECT_GE(row["seconds"]["runs"].size(), 3u);
    EXPECT_GT(row["seconds"]["median"].get<double>(), 0);
    EXPECT_GT(row["iterations"].get<int>(), 0);
    EXPECT_GT(row["peak_bytes"].get<long>(), 1000000);
    if (row["knob"] != "particles") continue;
    EXPECT_EQ(row["unknowns"].get<int>(), 3 * std::stoi(row["value"].get<std::string>()));
  }
  EXPECT_LT(json["rows"][6]["error"], json["rows"][3]["error"]) << "tolerance 1e-12 and 1e-2";
  EXPECT_GT(json["reference"]["uncertainty"].get<double>(), 0);
  EXPECT_FALSE(json["pareto"].empty());
  EXPECT_EQ(json["sources"].size(), 2u);

  std::istringstream csv(bytes_of(folder / "study/study.csv"));
  std::string line;
  std::getline(csv, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  std::size_t rows = 0;
  for (; std::getline(csv, line); ++rows)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
  EXPECT_EQ(rows, json["rows"].size());
}

TEST_F(StudyProgramTest, EveryKeyOfTheJsonIsInTheManual) {
  ASSERT_EQ(
      study({"-o", "study", "--knobs", "particles", "--target-error", "5%", "--time-budget", "60s"})
          .code,
      0);
  const std::string manual = bytes_of(SUPPLE_SOURCE_DIR "/docs/study.md");
  std::set<std::string> keys;
  collect_keys(Json::parse(bytes_of(folder / "study/study.json")), keys);
  EXPECT_GT(keys.size(), 30u);
  for (const std::string& key : keys)
    EXPECT_NE(manual.find("`" + key + "`"), std::string::npos) << key;
}

TEST_F(StudyProgramTest, FindsASettingForATime) {
  const ProgramResult run =
      study({"-o", "study", "--knobs", "particles", "--time-budget", "1000s"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("A pose within 1e+03 s: "), std::string::npos) << run.out;
  const Json json = Json::parse(bytes_of(folder / "study/study.json"));
  EXPECT_EQ(json["for_time"]["met"], true);
  const Json& best = json["rows"][json["pareto"].back().get<std::size_t>()];
  EXPECT_EQ(json["for_time"]["error"], best["error"]);
  EXPECT_EQ(json["for_error"], nullptr);
}

TEST_F(StudyProgramTest, ASpacingIsCountedInParticles) {
  const ProgramResult run = study(
      {"-o", "study", "--knobs", "particles", "--set", "shape={mesh: bar.obj, spacing: 0.12}"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("the study counts in particles"), std::string::npos) << run.err;
}

TEST_F(StudyProgramTest, TinyBudgetLeavesOutWhatItSays) {
  const ProgramResult run =
      study({"-o", "study", "--knobs", "particles", "--study-budget", "0.000001s"});
  EXPECT_EQ(run.code, 1) << run.out << run.err;
  EXPECT_NE(run.out.find("left out: the budget is spent"), std::string::npos) << run.out;
  const Json json = Json::parse(bytes_of(folder / "study/study.json"));
  EXPECT_TRUE(json["pareto"].empty());
  EXPECT_TRUE(is_well_formed(bytes_of(folder / "study/study.svg")));
}

TEST_F(StudyProgramTest, MistakesAreNamed) {
  expect_usage_error(study({}), "give -o FOLDER");
  expect_usage_error(study({"-o", "s", "--knobs", "particels"}), "did you mean 'particles'?");
  expect_usage_error(study({"-o", "s", "--study-budget", "0"}), "a time above 0");
  expect_usage_error(study({"-o", "s", "--study-budget", "120m"}), "a time above 0");
  expect_usage_error(study({"-o", "s", "--time-budget", "0s"}), "--time-budget '0s'");
  expect_usage_error(study({"-o", "s", "--target-error", "-1%"}), "an error above 0");
  folder.put("scene.yaml", "shape: {mesh: bar.obj}\n");
  expect_usage_error(study({"-o", "s"}), "scene.yaml:1:8: pose is missing");
  folder.put("scene.yaml", "shape: {mesh: bar.obj}\npose: {}\n");
  expect_usage_error(study({"-o", "s"}), "scene.yaml:2:7: pose.handles is empty");
  EXPECT_FALSE(exists("s")) << "nothing is left of a study that did not run";
}

TEST_F(StudyProgramTest, SaysWhereItCannotWrite) {
  folder.put("file", "");
  const ProgramResult file = study({"-o", "file"});
  EXPECT_EQ(file.code, 3);
  EXPECT_NE(file.err.find("file: cannot write: it is a file"), std::string::npos) << file.err;
  EXPECT_EQ(study({"-o", "no/such/folder"}).code, 3);
  EXPECT_EQ(study({"-o", "study", "--report", "no/such/r.json"}).code, 3);
  EXPECT_FALSE(exists("study"));
}

TEST_F(StudyProgramTest, AShapeThatCannotBePosedFails) {
  folder.put("bar.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramResult run = study({"-o", "study", "--knobs", "tolerance"});
  EXPECT_EQ(run.code, 1) << run.out;
  const Json json = Json::parse(bytes_of(folder / "study/study.json"));
  for (const Json& row : json["rows"]) EXPECT_EQ(row["status"], "failed");
  EXPECT_EQ(json["shortfalls"].size(), 5u);
}

TEST_F(StudyProgramTest, ASignalLeavesNothingBehind) {
  Program program(SUPPLE_PROGRAM, {"study", "scene.yaml", "-o", "study", "--particles", "1500"},
                  folder.path());
  for (int wait = 0; wait < 500 && !exists("study"); ++wait) ::usleep(10000);
  ASSERT_TRUE(exists("study"));
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait().code, 128 + SIGTERM);
  EXPECT_FALSE(exists("study"));
}

}  // namespace
}  // namespace supple
