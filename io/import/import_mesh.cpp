#include "io/import/import_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/import/child_process.h"
#include "io/import/importer_protocol.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/mesh_formats.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view program_name = "supple-import";

/// Beside this program, or where the install puts it.
fs::path find_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& candidate :
       {folder / program_name, folder / ".." / SUPPLE_LIBEXEC_FROM_BIN / program_name,
        fs::path(SUPPLE_LIBEXEC) / program_name})
    if (fs::exists(candidate, error)) return candidate;
  return {};
}

/// Generous for honest files: hundreds of bytes in memory a byte of a dense format.
std::size_t memory_for(std::size_t file_bytes) {
  constexpr std::size_t least = std::size_t{768} << 20, most = std::size_t{64} << 30;
  return std::min(least + 128 * file_bytes, most);
}

double seconds_for(std::size_t file_bytes) {
  return 20 + static_cast<double>(file_bytes) / 1e6;
}

[[noreturn]] void fail_foreign(const FileBytes& file, std::string_view why) {
  throw InputError(fmt::format("{}: cannot read: it is of none of our formats ({}); {}", file.name,
                               mesh_formats(), why));
}

[[noreturn]] void fail(const FileBytes& file, std::string_view what) {
  throw ImporterError(fmt::format("{}: cannot read: the importer {}", file.name, what));
}

/// Throws where the importer did not end as it should.
void check_end(const FileBytes& file, const ChildResult& child, double seconds) {
  switch (child.end) {
    case ChildEnd::done:
      break;
    case ChildEnd::killed:
      fail(file, fmt::format("crashed: {}", ::sigdescr_np(child.code)));
    case ChildEnd::too_long:
      fail(file, fmt::format("did not end within {:.3g} s", seconds));
    case ChildEnd::too_much:
      fail(file, "answers with more than its memory could hold");
    case ChildEnd::unknown:
      fail(file, "ended in a way that the system does not tell: SIGCHLD is ignored");
    case ChildEnd::cannot_start:
      fail(file, fmt::format("cannot be started: {}", ::strerrordesc_np(child.code)));
  }
  if (child.code == importer_cannot_read) {
    const std::string why = child.err.substr(0, child.err.find('\n'));
    fail_foreign(file, fmt::format("{} says: {}", program_name, why));
  }
  if (child.code != 0) fail(file, fmt::format("crashed: it ended with code {}", child.code));
}

void take_notes(std::string_view lines, Mesh& mesh) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    if (line.starts_with(importer_note)) mesh.notes.emplace_back(line.substr(importer_note.size()));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
  }
}

}  // namespace

Mesh import_mesh(const FileBytes& file, const ImporterOptions& options) {
  const fs::path program = options.program.empty() ? find_program() : options.program;
  if (program.empty())
    fail_foreign(file, fmt::format("{}, which reads others, is not installed", program_name));
  const std::size_t memory = options.most_bytes.value_or(memory_for(file.bytes.size()));
  const double seconds = options.most_seconds.value_or(seconds_for(file.bytes.size()));
  ChildResult child =
      run_child({program.string(), fmt::format("{}", memory),
                 fmt::format("{:.0f}", std::ceil(seconds)), file.name},
                {.time = std::chrono::duration<double>(seconds), .output_bytes = memory});
  check_end(file, child, seconds);
  Mesh mesh = read_obj({.name = file.name + " (as imported)", .bytes = std::move(child.out)});
  mesh.notes.push_back("read by assimp: the order of the vertices is the importer's");
  take_notes(child.err, mesh);
  return mesh;
}

}  // namespace supple
