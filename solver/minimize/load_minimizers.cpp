#include <dlfcn.h>
#include <fmt/format.h>

#include "solver/core/installation_error.h"
#include "solver/minimize/loaded/minimizers.h"

namespace supple {
namespace {

/// Never closed: threads of the libraries that come with it outlive every solve.
const Minimizers& load_minimizers() {
  void* library = dlopen("libsupple_minimizers.so", RTLD_NOW | RTLD_LOCAL);
  void* address = library ? dlsym(library, "supple_minimizers") : nullptr;
  if (!address)
    throw InstallationError(
        fmt::format("the trust region and NLopt cannot be loaded: {}", dlerror()));
  return *reinterpret_cast<decltype(supple_minimizers)*>(address)();
}

}  // namespace

const Minimizers& minimizers() {
  static const Minimizers& loaded = load_minimizers();
  return loaded;
}

}  // namespace supple
