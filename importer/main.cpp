/// supple-import BYTES SECONDS FILE: reads FILE by assimp and writes it as OBJ to standard output.
/// It runs for itself, with no more memory and time than it is given, so that a hostile file ends
/// nothing but this process. Exit code 3: the file cannot be read; standard error says why.
#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "importer/import_scene.h"
#include "io/import/importer_protocol.h"
#include "io/mesh/mesh_formats.h"
#include "io/output_file.h"

namespace {

constexpr int exit_usage = 2;

bool parse(std::string_view text, rlim_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// No more than it needs: no bytes into files, and it does not outlive who asked.
void confine(rlim_t bytes, rlim_t seconds) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#ifdef SUPPLE_SANITIZED  // which maps all addresses there are
  static_cast<void>(bytes);
#else
  limit(RLIMIT_AS, bytes);
#endif
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NPROC, 0);
}

int import(const char* path) {
  try {
    const supple::Mesh mesh = supple::import_scene(path);
    supple::OutputFile out("/dev/stdout");
    supple::write_obj(mesh, out);
    out.commit();
    for (const std::string& note : mesh.notes)
      std::fprintf(stderr, "%s%s\n", supple::importer_note.data(), note.c_str());
    return 0;
  } catch (const std::bad_alloc&) {
    std::fputs("it asks for more memory than such a file may take\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return supple::importer_cannot_read;
}

}  // namespace

int main(int count, char** words) {
  rlim_t bytes = 0, seconds = 0;
  if (count != 4 || !parse(words[1], bytes) || !parse(words[2], seconds)) {
    std::fputs("usage: supple-import BYTES SECONDS FILE\n", stderr);
    return exit_usage;
  }
  confine(bytes, seconds);
  const int code = import(words[3]);
  std::fflush(stderr);
  ::_exit(code);  // what a broken import left behind need not be taken apart
}
