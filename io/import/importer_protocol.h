#pragma once

#include <string_view>

namespace supple {

// What `supple-import` says beside the OBJ on its standard output.

inline constexpr int importer_cannot_read = 3;               ///< exit code; standard error says why
inline constexpr std::string_view importer_note = "note: ";  ///< begins lines of standard error

}  // namespace supple
