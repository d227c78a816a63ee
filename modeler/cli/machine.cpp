#include "modeler/cli/machine.h"

#include <algorithm>
#include <fstream>
#include <thread>

#include <malloc.h>

namespace supple {

long peak_memory() {
  std::ifstream status("/proc/self/status");
  const std::string key = "VmHWM:";
  for (std::string word; status >> word;) {
    long kilobytes = 0;
    if (word == key && status >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

void forget_peak_memory() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

int thread_count(int limit) {
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return limit > 0 ? std::min(limit, all) : all;
}

}  // namespace supple
