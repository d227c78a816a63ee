#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace supple {

/// Keys stay in the order in which they were put in.
using Json = nlohmann::ordered_json;

/// Indented, with a line end. Names may hold any bytes; those that are not UTF-8 become U+FFFD.
/// A number that is not finite is null.
std::string json_text(const Json& json);

}  // namespace supple
