#pragma once

#include <memory>
#include <string_view>

#include "io/mesh/ply_header.h"

namespace supple {

/// The numbers of a PLY file's body, one after the other, in whichever format.
/// Errors (everywhere): InputError with the file, the line or byte, and the row.
class PlySource {
 public:
  virtual ~PlySource() = default;

  /// Begins row `row` of the element `name`, which must outlive the row.
  virtual void begin_row(std::string_view name, long long row) = 0;
  virtual void end_row() = 0;
  /// The next number, as it stands: it may be infinite or not a number.
  virtual double next(PlyType type) = 0;
  virtual void skip(PlyType type) = 0;
  virtual bool at_end() = 0;
  [[noreturn]] virtual void fail(std::string_view message) const = 0;

  /// The length of a list.
  long long next_count(PlyType type);
  void skip(const PlyProperty& property);
};

/// What `scanner` has left behind the header.
std::unique_ptr<PlySource> open_ply_body(const FileBytes& file, TextScanner& scanner,
                                         PlyFormat format);

}  // namespace supple
