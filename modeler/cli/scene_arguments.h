#pragma once

#include <string>
#include <vector>

#include "io/scene/scene.h"
#include "io/scene/scene_reader.h"
#include "modeler/cli/command_line.h"
#include "modeler/cli/handle_arguments.h"
#include "modeler/cli/part_arguments.h"

namespace supple {

/// What is posed and how, as the command line says it: a scene file or a shape, handles, and an
/// option for every knob that the shape and the pose describe.
class SceneArguments {
 public:
  /// Declares the options; `*this` must outlive the parsing.
  void declare(CommandLine& line);

  /// Reads the scene file, or makes a scene of the shape; adds the handles of the command line.
  /// Errors: UsageError, InputError.
  Scene take();

  const std::string& path() const { return path_; }

  /// True where path() names a scene and not a shape.
  bool is_scene_file() const;

 private:
  /// An option that stands for a key of the scene.
  struct Knob {
    std::string words;  ///< "--particles 300"
    std::string key;    ///< "shape.particles"
    std::string value;
  };

  void declare_set(CommandLine& line);
  template <class Spec>
  void declare_knobs(CommandLine& line, const std::string& key, const std::string& prefix);
  template <class Member>
  void declare_knob(CommandLine& line, const std::string& key, const std::string& option,
                    const Described& described);
  /// What an option asked for is said to come from that option, not from the key it stands for.
  void name_by_option(Place& place) const;
  void name_by_option(Selection& selection) const;
  Scene read() const;
  Scene read_shape(const SceneOverrides& overrides) const;

  std::string path_;
  HandleArguments handles_;
  PartArguments parts_;
  std::vector<Knob> knobs_;
};

}  // namespace supple
