#include "modeler/pose/region_blend.h"

#include <algorithm>
#include <array>

namespace supple {
namespace {

bool is_named(const Selection& selection) {
  using Kind = Selection::Kind;
  return selection.kind == Kind::nearest || selection.kind == Kind::vertices ||
         selection.kind == Kind::group;
}

RegionShare both(const RegionShare& a, const RegionShare& b) {
  return {a.value * b.value, b.value * a.slope + a.value * b.slope};
}

RegionShare complement(const RegionShare& a) {
  return {1 - a.value, -a.slope};
}

RegionShare either(const RegionShare& a, const RegionShare& b) {
  return complement(both(complement(a), complement(b)));
}

Points rows_where(const Points& points, const std::vector<char>& mask, char wanted) {
  std::vector<Index> rows;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] == wanted) rows.push_back(static_cast<Index>(i));
  return points(rows, Eigen::all);
}

std::unique_ptr<const SiteTree> tree_of(const Points& points) {
  return points.rows() > 0 ? std::make_unique<const SiteTree>(points) : nullptr;
}

Index nearest_site(const SiteTree& tree, const Vec3& x) {
  Index nearest = 0;
  double squared_distance = 0;
  tree.nearest(x, {&nearest, 1}, {&squared_distance, 1});
  return nearest;
}

}  // namespace

RegionBlend::RegionBlend(const Selection& region, double width, const SelectionContext& context,
                         const SurfaceSamples& surface)
    : region_(region), width_(width), context_(context) {
  find_named_parts(region, surface);
  if (named_.empty()) return;
  surface_ = surface.positions;
  to_surface_ = tree_of(surface_);
}

void RegionBlend::find_named_parts(const Selection& selection, const SurfaceSamples& surface) {
  for (const Selection& part : selection.parts) find_named_parts(part, surface);
  if (!is_named(selection)) return;
  NamedPart& part = named_[&selection];
  part.mask = select_mask(selection, context_, surface);
  part.inside = rows_where(surface.positions, part.mask, 1);
  part.outside = rows_where(surface.positions, part.mask, 0);
  part.to_inside = tree_of(part.inside);
  part.to_outside = tree_of(part.outside);
}

RegionShare RegionBlend::at(const Vec3& x) const {
  return share(region_, Side::inside, x);
}

RegionShare RegionBlend::share(const Selection& selection, Side side, const Vec3& x) const {
  const double sign = side == Side::inside ? 1 : -1;
  switch (selection.kind) {
    case Selection::Kind::compare: {
      const bool below = selection.order == Selection::Order::less ||
                         selection.order == Selection::Order::less_equal;
      const Vec3 inward = (below ? -sign : sign) * Vec3::Unit(selection.axis);
      const double bound = resolve_bound(selection, context_.box);
      return ramp((x[selection.axis] - bound) * inward[selection.axis], inward);
    }
    case Selection::Kind::box:
      return box_share(selection, side, x);
    case Selection::Kind::sphere: {
      const Vec3 away = x - resolve_point(selection.center, context_.box);
      const double radius = resolve(selection.radius, context_.box.diagonal());
      return ramp(sign * (radius - away.norm()), -sign * away.normalized());
    }
    case Selection::Kind::all:
    case Selection::Kind::any:
      return joined(selection, side, x);
    case Selection::Kind::negation:
      return share(selection.parts.front(), side == Side::inside ? Side::outside : Side::inside, x);
    default:
      return named_share(selection, side, x);
  }
}

RegionShare RegionBlend::joined(const Selection& selection, Side side, const Vec3& x) const {
  // Outside of all is outside of any, and the other way round.
  const bool all = (selection.kind == Selection::Kind::all) == (side == Side::inside);
  RegionShare result = share(selection.parts.front(), side, x);
  for (std::size_t p = 1; p < selection.parts.size(); ++p) {
    const RegionShare part = share(selection.parts[p], side, x);
    result = all ? both(result, part) : either(result, part);
  }
  return result;
}

RegionShare RegionBlend::box_share(const Selection& selection, Side side, const Vec3& x) const {
  const Vec3 lower = resolve_point(selection.lower, context_.box);
  const Vec3 upper = resolve_point(selection.upper, context_.box);
  RegionShare inside, outside{0, Vec3::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = Vec3::Unit(axis);
    inside =
        both(inside, both(ramp(x[axis] - lower[axis], along), ramp(upper[axis] - x[axis], -along)));
    outside = either(
        outside, either(ramp(lower[axis] - x[axis], -along), ramp(x[axis] - upper[axis], along)));
  }
  return side == Side::inside ? inside : outside;
}

RegionShare RegionBlend::named_share(const Selection& selection, Side side, const Vec3& x) const {
  const NamedPart& part = named_.at(&selection);
  const char wanted = side == Side::inside ? 1 : 0;
  if (part.mask[static_cast<std::size_t>(nearest_site(*to_surface_, x))] != wanted)
    return {0, Vec3::Zero()};
  const std::unique_ptr<const SiteTree>& tree = wanted ? part.to_outside : part.to_inside;
  if (!tree) return {};
  const Points& sites = wanted ? part.outside : part.inside;
  const Vec3 away = x - sites.row(nearest_site(*tree, x)).transpose();
  return ramp(away.norm(), away.normalized());
}

RegionShare RegionBlend::ramp(double depth, const Vec3& inward) const {
  const double t = std::clamp(depth / width_, 0.0, 1.0);
  const double value = t * t * t * (10 - t * (15 - 6 * t));
  return {t < 1 ? value : 1, 30 * t * t * (1 - t) * (1 - t) / width_ * inward};
}

double blend_into(const DeformedSurface& start, const Points& rest, double unit,
                  const RegionBlend& region, DeformedSurface& surface) {
  double taken = 0;
  for (Index i = 0; i < rest.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const RegionShare share = region.at(rest.row(i).transpose());
    if (share.value == 1) continue;
    const Vec3 away = (surface.positions.row(i) - start.positions.row(i)).transpose();
    taken = std::max(taken, (1 - share.value) * away.norm());
    surface.positions.row(i) = start.positions.row(i) + share.value * away.transpose();
    surface.gradients[at] = start.gradients[at] +
                            share.value * (surface.gradients[at] - start.gradients[at]) +
                            unit * away * share.slope.transpose();
    if (share.value > 0) continue;
    surface.positions.row(i) = start.positions.row(i);
    surface.gradients[at] = start.gradients[at];
  }
  return taken;
}

}  // namespace supple
