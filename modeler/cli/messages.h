#pragma once

#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>

namespace supple {

/// `text` on one line of a terminal, whatever names it holds: control characters are escaped.
std::string one_line(std::string_view text);

/// Writes "beginning: text" and a line end to standard error, `text` on one line. Allocates
/// nothing: that memory is short may be what there is to tell.
void tell(std::string_view beginning, std::string_view text);

/// Where text for people goes: standard output, or standard error where one of `outputs` is "-"
/// and has standard output for itself.
std::FILE* text_stream(std::initializer_list<std::string_view> outputs);

}  // namespace supple
