#include <chrono>
#include <thread>

#include "tests/modeler/cli/program_fixture.h"

namespace supple {
namespace {

TEST_F(ProgramTest, SaysWhatItIs) {
  const ProgramResult version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("supple ", 0), 0u) << version.out;
  EXPECT_EQ(run({"--help"}).code, 0);
  expect_contains(run({"--help"}).out, "supple pose");
  const ProgramResult bare = run({});
  EXPECT_EQ(bare.code, 2);
  expect_contains(bare.err, "Usage: supple");
}

TEST_F(ProgramTest, NamesTheNearestCommand) {
  expect_usage_error(run({"psoe"}), "did you mean 'pose'?");
  expect_usage_error(run({"animate", "scene.yaml"}), "animate is not available yet");
}

TEST_F(ProgramTest, HelpHasExamplesThatWork) {
  write_mesh(make_bar({0.5, 1, 0.4}, {5, 10, 4}), folder / "bunny.obj");
  for (const std::string command : {"pose", "inspect", "render", "plan"}) {
    const ProgramResult help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    std::istringstream lines(help.out);
    int examples = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::string start = "  supple ";
      if (line.rfind(start, 0) != 0) continue;
      ++examples;
      const std::string call = SUPPLE_PROGRAM " " + line.substr(start.size());
      const ProgramResult result = Program("/bin/sh", {"-c", call}, folder.path()).wait();
      EXPECT_EQ(result.code, 0) << line << "\n" << result.out << result.err;
    }
    EXPECT_GE(examples, 2) << help.out;
  }
}

TEST_F(ProgramTest, MisspeltOptionNamesTheNearest) {
  expect_usage_error(pose_bar({"--partcles", "3"}), "did you mean --particles?");
  expect_usage_error(pose_bar({"--shove", "y>85%"}), "unknown option '--shove'");
}

TEST_F(ProgramTest, MisspeltKeyNamesPlaceAndNearest) {
  folder.put("wrong.yaml", "shape: {mesh: bar.obj, partcles: 60}\n");
  expect_usage_error(run({"plan", "wrong.yaml"}), "wrong.yaml:1:24");
  expect_usage_error(run({"plan", "wrong.yaml"}), "did you mean 'particles'?");
}

TEST_F(ProgramTest, ComplainsOfWordsThatDoNotFit) {
  expect_usage_error(pose_bar({"0,0.1"}), "one word too many");
  expect_usage_error(pose_bar({"--by"}), "--by needs a value: X,Y,Z");
  expect_usage_error(pose_bar({"--by="}), "no value behind '='");
  expect_usage_error(pose_bar({"--quiet=maybe"}), "quiet");
  expect_usage_error(pose_bar({"-o", "other.obj"}), "given twice");
  expect_usage_error(run({"pose"}), "SHAPE is missing");
  expect_usage_error(run({"pose", "bar.obj"}), "nothing to write");
}

TEST_F(ProgramTest, ComplainsOfValuesThatAreNotAllowed) {
  expect_usage_error(pose_bar({"--by", "nan,0,0"}), "--by nan,0,0");
  expect_usage_error(pose_bar({"--by", "inf,0,0"}), "finite");
  expect_usage_error(pose_bar({"--turn", "0,0,0,30"}), "the axis must have a length");
  expect_usage_error(pose_bar({"--turn", "0,0,1"}), "four numbers");
  expect_usage_error(pose_bar({"--weight", "-1"}), "above 0");
  expect_usage_error(pose_bar({"--scale", "0"}), "above 0");
  expect_usage_error(pose_bar({"--kernel", "boxx"}), "did you mean 'box'?");
  expect_usage_error(pose_bar({"--weights-volume", "-1"}), "--weights-volume -1: ");
  expect_usage_error(pose_bar({"--set", "pose.wieghts.volume=2"}), "did you mean 'weights'?");
  expect_usage_error(pose_bar({"--set", "pose.handles[0].weight=2"}), "only with a scene file");
  expect_usage_error(pose_bar({"--fix", "y"}), "quote it");
  expect_usage_error(pose_bar({"--size", "12"}), "WIDTHxHEIGHT");
  expect_usage_error(pose_bar({"--threads", "0"}), "from 1 to");
  expect_usage_error(pose_bar({"--allow-degraded=handle_mis"}), "did you mean 'handle_miss'?");
  expect_usage_error(run({"pose", "bar.obj", "-o", "posed.fbx"}), "obj, off, ply, stl");
  expect_usage_error(run({"pose", "bar.obj", "--picture", "posed.jpg"}), ".png");
  expect_usage_error(pose_bar({"--report", "posed.obj"}), "named for two outputs");
}

TEST_F(ProgramTest, MovementsBindToTheMoveBeforeThem) {
  const ProgramResult plan = run({"plan", "bar.obj", "--move", "y>90%", "--by", "-5%,0,0", "--turn",
                                  "0,1,0,-90", "--about", "0,0,0", "--move=y<10%", "--by=-0.1,0,0",
                                  "--scale", "2", "--fix", "x<10%", "--weight", "3"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  expect_contains(plan.out, "move y>90% by -5%,0,0 turn 0,1,0,-90 about 0,0,0;");
  expect_contains(plan.out, "move y<10% by -0.1,0,0 scale 2,2,2;");
  expect_contains(plan.out, "fix x<10% weight 3\n");

  expect_usage_error(run({"plan", "bar.obj", "--by", "1,0,0", "--move", "y>90%"}),
                     "no --move stands before it");
  expect_usage_error(run({"plan", "bar.obj", "--fix", "y>90%", "--by", "1,0,0"}),
                     "only behind a --move");
  expect_usage_error(pose_bar({"--by", "1,0,0", "--by", "2,0,0"}), "given twice for --move");
  expect_usage_error(pose_bar({"--about", "1,0,0"}), "has no --turn");
}

TEST_F(ProgramTest, KnobsOfTheSceneAreOptions) {
  const ProgramResult plan = run({"plan", "scene.yaml", "--json", "--weights-volume", "0",
                                  "--surface", "particle_gradients", "--set", "pose.substeps=4"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  const Json effects = Json::parse(plan.out).at("effects");
  expect_contains(effects.at("off").at("volume").get<std::string>(), "weights.volume is 0");
  expect_contains(effects.at("active").at("surface").at("because").get<std::string>(),
                  "particle_gradients");
  expect_contains(effects.at("active").at("substeps").at("because").get<std::string>(),
                  "substeps is 4");
}

TEST_F(ProgramTest, InputsThatCannotBeReadEndWith3) {
  folder.put("empty.obj", "");
  folder.put("nan.obj", "v 0 0 nan\n");
  for (const std::string file : {"missing.obj", "missing.yaml", "empty.obj", "nan.obj"}) {
    const ProgramResult result = run({"pose", file, "-o", "posed.obj"});
    EXPECT_EQ(result.code, 3) << file << result.err;
    expect_contains(result.err, file);
    EXPECT_FALSE(exists("posed.obj"));
  }
}

TEST_F(ProgramTest, OutputsAreTriedBeforeAnythingIsRead) {
  std::filesystem::create_directory(folder / "folder.obj");
  for (const std::string output : {"no/such/posed.obj", "folder.obj"}) {
    const ProgramResult result = run({"pose", "missing.obj", "-o", output});
    EXPECT_EQ(result.code, 3) << result.err;
    expect_contains(result.err, "cannot");
    expect_contains(result.err, output);
  }
}

TEST_F(ProgramTest, PosesAndReports) {
  const ProgramResult result = run({"pose", "scene.yaml", "-o", "posed.ply", "--picture",
                                    "posed.png", "--report", "posed.json", "--size", "320x200"});
  ASSERT_EQ(result.code, 0) << result.err;
  expect_contains(result.out, "status     ok");
  expect_contains(result.out, "wrote      posed.ply");
  EXPECT_EQ(bytes_of(folder / "posed.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_mesh(folder / "posed.ply").positions.rows(),
            read_mesh(folder / "bar.obj").positions.rows());

  const Json report = json("posed.json");
  for (const char* key :
       {"command", "version", "status", "reasons", "seconds", "particles", "vertices", "iterations",
        "energies", "handles", "volume", "min_det_F", "effects", "memory_peak_bytes"})
    EXPECT_TRUE(report.contains(key)) << key;
  for (const char* stage : {"load", "sample", "field", "solve", "deform", "write", "total"})
    EXPECT_TRUE(report["seconds"][stage].is_number()) << stage;
  EXPECT_EQ(report["command"], "pose");
  EXPECT_EQ(report["status"], "ok");
  EXPECT_EQ(report["reasons"], Json::array());
  EXPECT_GT(report["particles"], 30);
  EXPECT_LT(report["handles"]["max_error"], 0.01);
  EXPECT_NEAR(report["volume"]["before"], 0.04, 1e-6);
  EXPECT_NEAR(report["volume"]["change"], 0, 0.05);
  EXPECT_GT(report["min_det_F"], 0.3);
  EXPECT_GT(report["memory_peak_bytes"], 1 << 20);
  EXPECT_GT(report["effects"]["active"]["rigidity"]["seconds"], 0);
  EXPECT_EQ(report["effects"]["off"]["motion"], "the scene has no motion");
  EXPECT_GE(report["seconds"]["total"], report["seconds"]["solve"]);
}

TEST_F(ProgramTest, WithoutHandlesTheShapeStays) {
  const ProgramResult result = run({"pose", "bar.obj", "-o", "posed.obj"});
  EXPECT_EQ(result.code, 0) << result.err;
  expect_contains(result.err, "no handles");
  EXPECT_EQ(read_mesh(folder / "posed.obj").positions, read_mesh(folder / "bar.obj").positions);
}

TEST_F(ProgramTest, QuietSaysNothing) {
  const ProgramResult result = pose_bar({"--by", "0.1,0,0", "--quiet"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_TRUE(exists("posed.obj"));
}

TEST_F(ProgramTest, DegradedRunsWriteAndEndWith1UnlessAllowed) {
  const std::vector<std::string> far = {"--by", "0,5,0",    "--weights-handles",
                                        "1",    "--report", "posed.json"};
  const auto with = [&](const std::string& word) {
    std::vector<std::string> words = far;
    words.push_back(word);
    return words;
  };
  EXPECT_EQ(pose_bar(far).code, 1);
  EXPECT_TRUE(exists("posed.obj"));
  const Json report = json("posed.json");
  EXPECT_EQ(report["status"], "degraded");
  expect_contains(report["reasons"].dump(), "handle_miss");
  EXPECT_EQ(pose_bar(with("--allow-degraded")).code, 0);
  EXPECT_EQ(pose_bar(with("--allow-degraded=uncovered")).code, 1);
}

TEST_F(ProgramTest, ShapesThatCannotBePosedEndWith1AndReport) {
  folder.put("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramResult result =
      run({"pose", "flat.obj", "-o", "posed.obj", "--report", "posed.json"});
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_FALSE(exists("posed.obj"));
  EXPECT_EQ(json("posed.json")["status"], "failed");
  EXPECT_GT(json("posed.json")["details"][0]["text"].get<std::string>().size(), 10u);
}

TEST_F(ProgramTest, SelectionsOfNothingAreUsageErrors) {
  expect_usage_error(pose_bar({"--fix", "y<-10%"}), "y<-10%");
}

TEST_F(ProgramTest, UnlikelySizesAreNoted) {
  Mesh huge = make_box({5000, 5000, 5000});
  write_mesh(huge, folder / "huge.obj");
  const ProgramResult result = run({"pose", "huge.obj", "--particles", "30", "-o", "posed.obj"});
  EXPECT_EQ(result.code, 0) << result.err;
  expect_contains(result.err, "unlikely");
  expect_lacks(
      run({"pose", "huge.obj", "--particles", "30", "--units", "mm", "-o", "posed.obj"}).err,
      "unlikely");
}

TEST_F(ProgramTest, SignalsStopARunWithNothingHalfWritten) {
  const Program program(SUPPLE_PROGRAM,
                        {"pose", "bar.obj", "--particles", "3000", "--fix", "y<10%", "--move",
                         "y>90%", "--turn", "1,0,0,170", "--substeps", "500", "-o", "posed.obj"},
                        folder.path());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  program.signal(SIGTERM);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.code, 128 + SIGTERM);
  expect_contains(result.err, "stopped");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    expect_lacks(entry.path().filename().string(), "posed");
}

/// As nohup and shells' background jobs have it.
TEST_F(ProgramTest, SignalsThatTheCallerIgnoresStopNothing) {
  const std::string lines =
      "trap '' HUP INT; \"$0\" study bar.obj --fix 'y<10%' --move 'y>90%' --by 10%,0,0 "
      "--knobs particles --quick --quiet -o study & pid=$!; sleep 0.3; kill -HUP $pid; "
      "kill -INT $pid; kill -0 $pid || exit 99; wait $pid";
  const ProgramResult result =
      Program("/bin/sh", {"-c", lines, SUPPLE_PROGRAM}, folder.path()).wait();
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(exists("study/study.csv"));
}

TEST_F(ProgramTest, StandardOutputTakesOneOutput) {
  const std::vector<std::string> pose = {"pose",  "bar.obj", "--particles", "60",   "--fix",
                                         "y<10%", "--move",  "y>90%",       "--by", "0.1,0,0"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), pose.begin(), pose.end());
    return run(words);
  };
  const ProgramResult file = with({"-o", "posed.obj"}), stream = with({"-o", "-"});
  EXPECT_EQ(stream.code, 0) << stream.err;
  EXPECT_EQ(stream.out, bytes_of(folder / "posed.obj"));
  expect_contains(stream.err, "shape");  // what people read moves aside
  EXPECT_TRUE(with({"-o", "-", "--format", "glb"}).out.starts_with("glTF"));
  EXPECT_EQ(Json::parse(with({"--report", "-"}).out)["status"], "ok");
  EXPECT_TRUE(run({"render", "bar.obj", "-o", "-"}).out.starts_with("\x89PNG"));
  EXPECT_EQ(with({"-o", "-", "--report", "-"}).code, 2);
  expect_usage_error(with({"-o", "-", "--format", "fbx"}), "allowed: obj");
}

TEST_F(ProgramTest, AFullStandardOutputIsAnError) {
  const std::string call = SUPPLE_PROGRAM " plan scene.yaml > /dev/full";
  EXPECT_EQ(Program("/bin/sh", {"-c", call}, folder.path()).wait().code, 3);
}

TEST_F(ProgramTest, ReportsHoldNamesWithOddBytes) {
  const std::string odd = "b\xff\"\\\n.obj";
  std::filesystem::copy_file(folder / "bar.obj", folder / odd);
  const ProgramResult result = run({"pose", odd, "--report", "posed.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(json("posed.json")["input"], "b\xef\xbf\xbd\"\\\n.obj");
}

}  // namespace
}  // namespace supple
