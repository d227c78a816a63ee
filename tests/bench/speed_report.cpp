// Makes the README's table and chart of what pose_bench measured.
//   speed_report FAST.json BASELINE.json README.md CHART.png
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/chart/log_axis.h"
#include "io/chart/sketch.h"
#include "io/output_file.h"
#include "io/picture/picture.h"

namespace supple {
namespace {

using Json = nlohmann::json;

std::string read(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("{} cannot be read", path));
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What one run of pose_bench measured.
class Measured {
 public:
  explicit Measured(const char* path) : runs_(Json::parse(read(path)).at("benchmarks")) {}

  double operator()(const std::string& benchmark, const std::string& counter) const {
    for (const Json& run : runs_)
      if (run.at("name").get<std::string>() == benchmark + "/iterations:1")
        return run.at(counter).get<double>();
    throw std::runtime_error(fmt::format("no benchmark {}", benchmark));
  }

 private:
  Json runs_;
};

/// A line of the table: what, and how it is said of each run.
struct Line {
  std::string what;
  std::string goal;
  std::string (*say)(const Measured& of);
};

std::string over_sizes(const Measured& of, const char* counter, const char* form,
                       std::initializer_list<int> sizes) {
  std::string text;
  for (const int size : sizes)
    text += (text.empty() ? "" : " / ") +
            fmt::format(fmt::runtime(form), of(fmt::format("drag/{}", size), counter));
  return text;
}

double energy_gap(const Measured& of) {
  double gap = 0;
  for (const int size : {60, 200, 1000}) {
    const std::string name = fmt::format("drag/{}", size);
    gap = std::max(gap, of(name, "energy") / of(name, "trust_region_energy") - 1);
  }
  return gap;
}

const Line lines[] = {
    {"a drag step at 60 / 200 / 1000 / 5000 particles [ms]", "",
     [](const Measured& of) {
       return over_sizes(of, "ms", "{:.2g}", {60, 200, 1000, 5000});
     }},
    {"… times faster than Ceres' trust region (60 / 200 / 1000)", "≥ 20",
     [](const Measured& of) {
       return over_sizes(of, "faster_than_trust_region", "{:.0f}", {60, 200, 1000});
     }},
    {"… energy above the trust region's, greatest", "≤ 0.1 %",
     [](const Measured& of) { return fmt::format("{:.3f} %", 100 * energy_gap(of)); }},
    {"… over the same step written out by hand", "≤ 2",
     [](const Measured& of) {
       return over_sizes(of, "over_limit", "{:.2f}", {60, 200, 1000, 5000});
     }},
    {"… a step of 5000 particles over one of 200", "≤ 160",
     [](const Measured& of) {
       return fmt::format("{:.0f}", of("drag/5000", "ms") / of("drag/200", "ms"));
     }},
    {"hard handles over soft ones, 1000 particles; miss over the size; set-up [ms]", "≤ 10; 1e-9",
     [](const Measured& of) {
       return fmt::format("{:.1f}; {:.0e}; {:.0f}", of("hard_handles/1000", "over_soft"),
                          of("hard_handles/1000", "miss_over_size"),
                          of("hard_handles/1000", "set_up_ms"));
     }},
    {"half a turn in one request, 200 particles: twisted / bent [ms]", "",
     [](const Measured& of) {
       return fmt::format("{:.0f} / {:.0f}", of("half_turn/twisted", "ms"),
                          of("half_turn/bent", "ms"));
     }},
    {"… energy over that of the trust region's way; least det F", "≤ 1.001; > 0",
     [](const Measured& of) {
       const auto ratio = [&](const char* name) {
         return of(name, "energy") / of(name, "trust_region_energy");
       };
       return fmt::format("{:.4f} / {:.4f}; {:.2f} / {:.2f}", ratio("half_turn/twisted"),
                          ratio("half_turn/bent"), of("half_turn/twisted", "min_det_F"),
                          of("half_turn/bent", "min_det_F"));
     }},
    {"a surface of 100,000 / 500,000 vertices deformed, one thread [ms]", "",
     [](const Measured& of) {
       return fmt::format("{:.2f} / {:.2f}", of("deform/100000/1", "ms"),
                          of("deform/500000/1", "ms"));
     }},
    {"… over reading the bytes that must be read", "≤ 1.3",
     [](const Measured& of) {
       return fmt::format("{:.2f} / {:.2f}", of("deform/100000/1", "over_read_sum"),
                          of("deform/500000/1", "over_read_sum"));
     }},
    {"… times faster than plain rows of doubles", "≥ 5",
     [](const Measured& of) {
       return fmt::format("{:.1f} / {:.1f}", of("deform/100000/1", "faster_than_plain_rows"),
                          of("deform/500000/1", "faster_than_plain_rows"));
     }},
    {"frames a second, 60 particles: 100,000 / 500,000 vertices", "≥ 550 / 100",
     [](const Measured& of) {
       return fmt::format("{:.0f} / {:.0f}", of("frames/100000", "frames_per_second"),
                          of("frames/500000", "frames_per_second"));
     }},
    {"… with normals", "≥ 275 / 50",
     [](const Measured& of) {
       return fmt::format("{:.0f} / {:.0f}", of("frames/100000", "shaded_frames_per_second"),
                          of("frames/500000", "shaded_frames_per_second"));
     }},
    {"a drag step of 104,002 vertices, 200 particles: times faster than CGAL's at volume weight 1 "
     "/ 10",
     "≥ 300",
     [](const Measured& of) {
       return fmt::format("{:.0f} / {:.0f}", of("beside_cgal/1", "faster_than_cgal"),
                          of("beside_cgal/10", "faster_than_cgal"));
     }},
    {"… change of volume, ours / CGAL's", "less",
     [](const Measured& of) {
       return fmt::format("{:.1f} %, {:.2f} % / {:.1f} %",
                          100 * of("beside_cgal/1", "volume_change"),
                          100 * of("beside_cgal/10", "volume_change"),
                          100 * of("beside_cgal/1", "cgal_volume_change"));
     }},
};

std::string table(const Measured& fast, const Measured& baseline) {
  std::string text = "| | goal | x86-64-v3 | every x86-64 |\n|---|---|---|---|\n";
  for (const Line& line : lines)
    text += fmt::format("| {} | {} | {} | {} |\n", line.what, line.goal, line.say(fast),
                        line.say(baseline));
  return text;
}

/// One drag step over the number of particles, both logarithmic.
Sketch chart(const Measured& of) {
  struct Curve {
    const char *counter, *name;
    Color color;
    std::vector<int> sizes;
  };
  const Curve curves[] = {
      {"trust_region_ms", "Ceres' trust region", {0.85f, 0.35f, 0.1f}, {60, 200, 1000}},
      {"ms", "Supple", {0.1f, 0.35f, 0.75f}, {60, 200, 1000, 5000}},
      {"limit_ms", "written out by hand", {0.45f, 0.45f, 0.5f}, {60, 200, 1000, 5000}}};
  Sketch sketch{.width = 900, .height = 520};
  sketch.add(SketchArea{Frame{0, 0, 900, 520}.corners(), {1, 1, 1}});
  const Frame frame{90, 60, 680, 450};
  const LogAxis x(50, 6000, frame.left, frame.right), y(0.05, 5000, frame.bottom, frame.top);
  const Color grid{0.85f, 0.85f, 0.88f};
  for (const int size : {60, 200, 1000, 5000}) {
    sketch.add(SketchLine{{{x.at(size), frame.top}, {x.at(size), frame.bottom}}, grid});
    sketch.add(SketchText{
        {x.at(size), frame.bottom + 18}, std::to_string(size), SketchText::Anchor::middle});
  }
  for (const double tick : y.ticks()) {
    sketch.add(SketchLine{{{frame.left, y.at(tick)}, {frame.right, y.at(tick)}}, grid});
    sketch.add(SketchText{{frame.left - 8, y.at(tick)}, tick_text(tick), SketchText::Anchor::end});
  }
  sketch.add(
      SketchText{{frame.left, 30}, "One drag step, same energy within 0.1 %: ms over particles"});
  for (const Curve& curve : curves) {
    SketchLine line{{}, curve.color, 2.5};
    for (const int size : curve.sizes) {
      line.points.emplace_back(x.at(size), y.at(of(fmt::format("drag/{}", size), curve.counter)));
      sketch.add(SketchCircle{line.points.back(), 5, curve.color});
    }
    sketch.add(line);
    const double lower = std::string_view(curve.counter) == "limit_ms" ? 16 : 0;
    sketch.add(SketchText{line.points.back() + Pixel(12, lower), curve.name,
                          SketchText::Anchor::start, curve.color});
  }
  return sketch;
}

constexpr std::string_view begin_mark = "<!-- made by tests/bench/run.sh -->\n",
                           end_mark = "<!-- to here -->\n";

std::string with_table(const std::string& readme, const std::string& made) {
  const std::size_t begin = readme.find(begin_mark), end = readme.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error("the README has no place for the table");
  return readme.substr(0, begin + begin_mark.size()) + made + readme.substr(end);
}

int run(char** words) {
  const Measured fast(words[1]), baseline(words[2]);
  const std::string made = table(fast, baseline);
  OutputFile readme(words[3]);
  readme.write(with_table(read(words[3]), made));
  readme.commit();
  write_png(rasterize(chart(fast)), words[4]);
  fmt::print("{}", made);
  return 0;
}

}  // namespace
}  // namespace supple

int main(int count, char** words) {
  if (count != 5) {
    fmt::print(stderr, "usage: speed_report FAST.json BASELINE.json README.md CHART.png\n");
    return 2;
  }
  try {
    return supple::run(words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "speed_report: {}\n", error.what());
    return 1;
  }
}
