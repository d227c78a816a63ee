#pragma once

#include <string>

#include "io/scene/quantity.h"

namespace supple {

/// A file that the user named; a relative path is relative to the scene.
struct NamedFile {
  std::string path;
  Place place;
};

}  // namespace supple
