#include "modeler/domain/select.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "modeler/domain/site_tree.h"
#include "modeler/domain/vertex_list.h"

namespace supple {

namespace {

/// For each sample whether it is chosen.
using Mask = std::vector<char>;

/// Group names in an OBJ g line are many; a tag of another kind has one.
std::vector<std::string_view> names_of(const FaceTag& tag) {
  if (tag.kind != FaceTag::Kind::group) return {tag.name};
  std::vector<std::string_view> names;
  const std::string_view text = tag.name;
  for (std::size_t at = text.find_first_not_of(" \t"); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
    names.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(" \t", end);
  }
  if (names.size() > 1) names.push_back(text);
  return names;
}

/// For each face whether a tag of that name holds it.
Mask faces_in_group(const Mesh& mesh, const Selection& selection) {
  Mask faces(mesh.face_count(), 0);
  std::set<std::string_view> known;
  for (auto tag = mesh.tags.begin(); tag != mesh.tags.end(); ++tag) {
    if (tag->kind == FaceTag::Kind::smoothing) continue;
    const std::vector<std::string_view> names = names_of(*tag);
    known.insert(names.begin(), names.end());
    if (std::find(names.begin(), names.end(), selection.name) == names.end()) continue;
    const auto next = std::find_if(tag + 1, mesh.tags.end(),
                                   [&](const FaceTag& other) { return other.kind == tag->kind; });
    const int end = next == mesh.tags.end() ? mesh.face_count() : next->first_face;
    std::fill(faces.begin() + tag->first_face, faces.begin() + end, 1);
  }
  if (known.count(selection.name) > 0) return faces;
  const std::vector<std::string_view> names(known.begin(), known.end());
  complain(selection.place, names.empty()
                                ? fmt::format("{}: the shape has no groups, objects or materials",
                                              in_quotes(selection.text))
                                : fmt::format("{}: no such group{}", in_quotes(selection.text),
                                              allowed_names(selection.name, names)));
}

/// Of vertices or groups, which points of space are not in.
bool speaks_of_samples(const Selection& selection) {
  return selection.kind == Selection::Kind::vertices || selection.kind == Selection::Kind::group ||
         std::any_of(selection.parts.begin(), selection.parts.end(), speaks_of_samples);
}

class Selector {
 public:
  Selector(const SelectionContext& context, const SurfaceSamples& samples)
      : context_(context), samples_(samples) {}

  Mask choose(const Selection& selection) const {
    switch (selection.kind) {
      case Selection::Kind::compare:
        return compare(selection);
      case Selection::Kind::box:
        return box(selection);
      case Selection::Kind::sphere:
        return sphere(selection);
      case Selection::Kind::nearest:
        return nearest(selection);
      case Selection::Kind::vertices:
        return vertices(selection);
      case Selection::Kind::group:
        return group(selection);
      case Selection::Kind::all:
        return combine(selection, std::bit_and<char>());
      case Selection::Kind::any:
        return combine(selection, std::bit_or<char>());
      case Selection::Kind::negation:
        break;
    }
    Mask mask = choose(selection.parts.front());
    for (char& chosen : mask) chosen = !chosen;
    return mask;
  }

 private:
  /// The samples whose number satisfies `test`.
  template <class Test>
  Mask where(const Test& test) const {
    Mask mask(samples_.size());
    for (Index i = 0; i < samples_.size(); ++i) mask[i] = test(i) ? 1 : 0;
    return mask;
  }

  Vec3 position(Index i) const { return samples_.positions.row(i); }

  Mask compare(const Selection& selection) const {
    const int axis = selection.axis;
    const double bound = resolve_bound(selection, context_.box);
    return where([&](Index i) {
      const double x = samples_.positions(i, axis);
      switch (selection.order) {
        case Selection::Order::less:
          return x < bound;
        case Selection::Order::less_equal:
          return x <= bound;
        case Selection::Order::greater:
          return x > bound;
        case Selection::Order::greater_equal:
          break;
      }
      return x >= bound;
    });
  }

  Mask box(const Selection& selection) const {
    const Vec3 lower = resolve_point(selection.lower, context_.box);
    const Vec3 upper = resolve_point(selection.upper, context_.box);
    return where([&](Index i) {
      const Vec3 x = position(i);
      return (x.array() >= lower.array()).all() && (x.array() <= upper.array()).all();
    });
  }

  Mask sphere(const Selection& selection) const {
    const Vec3 center = resolve_point(selection.center, context_.box);
    const double radius = resolve(selection.radius, context_.box.diagonal());
    return where([&](Index i) { return (position(i) - center).norm() <= radius; });
  }

  Mask nearest(const Selection& selection) const {
    const Vec3 center = resolve_point(selection.center, context_.box);
    Mask mask(samples_.size(), 0);
    if (mask.empty()) return mask;
    Index chosen;
    (samples_.positions.rowwise() - center.transpose()).rowwise().squaredNorm().minCoeff(&chosen);
    mask[chosen] = 1;
    return mask;
  }

  Mask vertices(const Selection& selection) const {
    const Mask listed =
        read_vertex_list(context_.folder / selection.name,
                         static_cast<int>(context_.mesh.positions.rows()), selection.place);
    return where([&](Index i) { return listed[samples_.vertices[i]]; });
  }

  Mask group(const Selection& selection) const {
    const Mask faces = faces_in_group(context_.mesh, selection);
    return where(
        [&](Index i) { return faces[context_.triangulation.faces[samples_.triangles[i]]]; });
  }

  template <class Operation>
  Mask combine(const Selection& selection, const Operation& operation) const {
    Mask mask = choose(selection.parts.front());
    for (std::size_t p = 1; p < selection.parts.size(); ++p) {
      const Mask part = choose(selection.parts[p]);
      std::transform(mask.begin(), mask.end(), part.begin(), mask.begin(), operation);
    }
    return mask;
  }

  const SelectionContext& context_;
  const SurfaceSamples& samples_;
};

}  // namespace

double resolve_bound(const Selection& half_space, const Box& box) {
  const double bound = half_space.bound.value;
  if (half_space.bound.unit != Length::Unit::percent) return bound;
  return box.lower[half_space.axis] + 0.01 * bound * box.size()[half_space.axis];
}

std::vector<char> select_mask(const Selection& selection, const SelectionContext& context,
                              const SurfaceSamples& samples) {
  return Selector(context, samples).choose(selection);
}

SurfaceSamples stand_ins(const Points& points, const SurfaceSamples& surface) {
  SurfaceSamples stand_ins;
  stand_ins.positions = points;
  const SiteTree tree(surface.positions);
  for (Index i = 0; i < points.rows(); ++i) {
    Index nearest = 0;
    double squared_distance = 0;
    tree.nearest(points.row(i).transpose(), {&nearest, 1}, {&squared_distance, 1});
    stand_ins.triangles.push_back(surface.triangles[static_cast<std::size_t>(nearest)]);
    stand_ins.vertices.push_back(surface.vertices[static_cast<std::size_t>(nearest)]);
  }
  return stand_ins;
}

SurfaceSamples stand_ins(const Points& points, const SurfaceSamples& surface,
                         const Selection& selection) {
  if (speaks_of_samples(selection)) return stand_ins(points, surface);
  SurfaceSamples bare;
  bare.positions = points;
  return bare;
}

void complain_of_nothing(const Selection& selection, const Box& box, std::string_view of) {
  const Vec3 &a = box.lower, &b = box.upper;
  complain(selection.place,
           fmt::format("{} selects nothing of {}; its box goes from ({:.4g}, {:.4g}, {:.4g}) to "
                       "({:.4g}, {:.4g}, {:.4g})",
                       in_quotes(selection.text), of, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()));
}

std::vector<int> select(const Selection& selection, const SelectionContext& context,
                        const SurfaceSamples& samples) {
  const Mask mask = select_mask(selection, context, samples);
  std::vector<int> chosen;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i]) chosen.push_back(static_cast<int>(i));
  if (chosen.empty()) complain_of_nothing(selection, context.box, "the shape");
  return chosen;
}

}  // namespace supple
