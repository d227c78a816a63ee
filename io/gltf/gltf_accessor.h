#pragma once

#include <Eigen/Core>
#include <vector>

#include "io/gltf/gltf_document.h"

namespace supple {

/// A row an element, a column a component; normalised integers in [0, 1] or [−1, 1].
using AccessorValues = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The accessor that a member of `owner` names: an attribute, "indices", ...
std::size_t accessor_of(const GltfDocument& document, const GltfObject& owner,
                        std::string_view name);

/// The numbers of an accessor, also a sparse one.
/// Errors: InputError where it does not exist, lies outside its buffer, is of a kind that glTF does
/// not know, does not have one of the numbers of `columns`, or holds a number that is not finite;
/// `what` names it.
AccessorValues read_accessor(const GltfDocument& document, std::size_t index,
                             std::initializer_list<int> columns, std::string_view what);

/// The unsigned whole numbers of an accessor of indices; errors as above, and where one is not
/// below `count`.
std::vector<int> read_indices(const GltfDocument& document, std::size_t index, std::size_t count);

}  // namespace supple
