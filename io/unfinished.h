#pragma once

namespace supple {

/// A file or an empty folder that must not stay where the run is ended in its middle, when no
/// destructor runs any more.
class Unfinished {
 public:
  /// `path` must outlive this. One of very many at once may be left out.
  explicit Unfinished(const char* path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// Removes them all; folders only where they are empty. May be called by a signal handler.
  static void remove_all() noexcept;

 private:
  int slot_;
};

}  // namespace supple
