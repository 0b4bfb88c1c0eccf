#include "lab/origin.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "tenon/base/parallel_for.h"

namespace tenon {

namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

// The first line of what a program prints; empty when it cannot be started.
std::string first_line(const std::string& command) {
  std::FILE* program = popen((command + " 2>/dev/null").c_str(), "r");
  if (program == nullptr) return "";
  char text[256] = "";
  if (std::fgets(text, sizeof text, program) == nullptr) text[0] = 0;
  pclose(program);
  std::string line = text;
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line;
}

std::string find_commit(const std::string& root) {
  const std::string git = "git -C '" + root + "' ";
  const std::string commit = first_line(git + "rev-parse --short=10 HEAD");
  if (commit.empty()) return "unknown";
  return commit + (first_line(git + "status --porcelain --untracked-files=no -- src include apps scenes lab").empty()
                       ? ""
                       : "+");
}

}  // namespace

LabOrigin find_origin(const std::string& root) {
  LabOrigin origin;
  origin.cores = available_threads();
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  char text[64];
  std::snprintf(text, sizeof text, ", %d cores, %.0f GiB", origin.cores, memory / 0x1p30);
  origin.machine = processor() + text;
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  origin.date = text;
#ifdef NDEBUG
  origin.compiler = TENON_COMPILER ", optimised";
#else
  origin.compiler = TENON_COMPILER ", with assertions";
#endif
  origin.commit = find_commit(root);
  getloadavg(&origin.load, 1);
  return origin;
}

}  // namespace tenon
