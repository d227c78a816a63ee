#include "solver/field/blocked_field.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "solver/core/check.h"
#include "solver/core/parallel.h"
#include "solver/field/spatial_order.h"

namespace supple {
namespace {

constexpr Index blocks_per_chunk = 64;

}  // namespace

BlockedField::BlockedField(const MovingLeastSquares<3>& field, const Points& points)
    : size_(points.rows()), order_(spatial_order(points)) {
  const Index block_count = (size_ + lanes - 1) / lanes;
  order_.resize(static_cast<std::size_t>(block_count * lanes), -1);
  rest_.resize(order_.size(), Vec3::Zero());
  for (std::size_t at = 0; at < order_.size(); ++at)
    if (order_[at] >= 0) rest_[at] = points.row(order_[at]).transpose();

  chunks_.resize(static_cast<std::size_t>((block_count + blocks_per_chunk - 1) / blocks_per_chunk));
  parallel_chunks(block_count, blocks_per_chunk, [&](Index begin, Index end) {
    chunks_[static_cast<std::size_t>(begin / blocks_per_chunk)] =
        build_chunk(field, points, begin, end);
  });
}

BlockedField::Chunk BlockedField::build_chunk(const MovingLeastSquares<3>& field,
                                              const Points& points, Index first_block,
                                              Index last_block) const {
  Chunk chunk;
  chunk.first_block = first_block;
  for (Index block = first_block; block < last_block; ++block) {
    const Index first_lane = block * lanes;
    const Index count = std::min<Index>(lanes, size_ - first_lane);
    Points block_points(count, 3);
    for (Index lane = 0; lane < count; ++lane)
      block_points.row(lane) = points.row(order_[static_cast<std::size_t>(first_lane + lane)]);
    const Samples rows = sample_field(field, block_points, SampleContent::values_and_gradients);
    add_block(rows, chunk);
    for (const Samples::ShortSpan& at : rows.short_spans)
      chunk.short_spans.push_back(
          {order_[static_cast<std::size_t>(first_lane + at.sample)], at.span});
  }
  chunk.particles.shrink_to_fit();
  chunk.weights.shrink_to_fit();
  chunk.slopes.shrink_to_fit();
  return chunk;
}

void BlockedField::add_block(const Samples& rows, Chunk& chunk) {
  std::vector<int> shared = rows.particles;
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());

  const std::size_t first = chunk.particles.size();
  chunk.particles.insert(chunk.particles.end(), shared.begin(), shared.end());
  chunk.block_starts.push_back(static_cast<int>(chunk.particles.size()));
  chunk.weights.resize(chunk.particles.size() * lanes, 0.0f);
  chunk.slopes.resize(chunk.particles.size() * lanes * 3, 0.0f);
  for (Index lane = 0; lane < rows.size(); ++lane)
    for (int row_entry = rows.row_begin(lane); row_entry < rows.row_end(lane); ++row_entry) {
      const auto at = static_cast<std::size_t>(row_entry);
      const auto place = std::lower_bound(shared.begin(), shared.end(), rows.particles[at]);
      const std::size_t entry = first + static_cast<std::size_t>(place - shared.begin());
      chunk.weights[entry * lanes + static_cast<std::size_t>(lane)] =
          static_cast<float>(rows.values[at]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        chunk.slopes[(entry * 3 + axis) * lanes + static_cast<std::size_t>(lane)] =
            static_cast<float>(rows.gradients[at][static_cast<Index>(axis)]);
    }
  chunk.entries += static_cast<Index>(rows.particles.size());
  chunk.uncovered += rows.uncovered;
  chunk.rank_lost += rows.rank_lost;
}

template <std::size_t Sums, class Add, class Store>
void BlockedField::for_each_block(const Add& add, const Store& store) const {
  const auto walk = [&](Index begin, Index) {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(begin)];
    for (std::size_t block = 0; block + 1 < chunk.block_starts.size(); ++block) {
      std::array<Lanes, Sums> sums;
      sums.fill(Lanes::Zero());
      const int end = chunk.block_starts[block + 1];
      for (int entry = chunk.block_starts[block]; entry < end; ++entry)
        add(chunk, static_cast<std::size_t>(entry),
            chunk.particles[static_cast<std::size_t>(entry)], sums);
      const std::size_t first_lane = (static_cast<std::size_t>(chunk.first_block) + block) * lanes;
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (order_[first_lane + lane] >= 0)
          store(sums, static_cast<Index>(lane), order_[first_lane + lane],
                rest_[first_lane + lane]);
    }
  };
  // By reference, so that nothing is allocated.
  parallel_chunks(static_cast<Index>(chunks_.size()), 1, std::cref(walk));
}

void BlockedField::displace(const RigidMotion& rigid, const ParticleValues<3>& d,
                            Points& out) const {
  out.resize(size_, 3);
  for_each_block<3>(
      [&](const Chunk& chunk, std::size_t entry, int particle, auto& sums) {
        const Eigen::Map<const Lanes> w(&chunk.weights[entry * lanes]);
        const float* value = d.data() + 3 * particle;
        for (std::size_t a = 0; a < 3; ++a) sums[a] += w * value[a];
      },
      [&](const auto& sums, Index lane, int point, const Vec3& rest) {
        const Vec3 moved(sums[0][lane], sums[1][lane], sums[2][lane]);
        out.row(point) = (rigid(rest) + moved).transpose();
      });
}

void BlockedField::blend(const RigidMotion& rigid, const ParticleValues<12>& maps,
                         Points& out) const {
  out.resize(size_, 3);
  for_each_block<12>(
      [&](const Chunk& chunk, std::size_t entry, int particle, auto& sums) {
        const Eigen::Map<const Lanes> w(&chunk.weights[entry * lanes]);
        const float* value = maps.data() + 12 * particle;
        for (std::size_t c = 0; c < 12; ++c) sums[c] += w * value[c];
      },
      [&](const auto& sums, Index lane, int point, const Vec3& rest) {
        Vec3 f = rigid(rest);
        for (std::size_t a = 0; a < 3; ++a) {
          double extra = sums[a][lane];
          for (std::size_t b = 0; b < 3; ++b)
            extra += double(sums[3 + 3 * a + b][lane]) * rest[static_cast<Index>(b)];
          f[static_cast<Index>(a)] += extra;
        }
        out.row(point) = f.transpose();
      });
}

template <class Add>
void BlockedField::sum_gradients(const RigidMotion& rigid, const Add& add,
                                 std::vector<Mat3>& out) const {
  out.resize(static_cast<std::size_t>(size_));
  for_each_block<9>(add, [&](const auto& sums, Index lane, int point, const Vec3&) {
    Mat3 F = rigid.R;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) F(a, b) += sums[static_cast<std::size_t>(3 * a + b)][lane];
    out[static_cast<std::size_t>(point)] = F;
  });
}

void BlockedField::displace_gradients(const RigidMotion& rigid, const ParticleValues<3>& d,
                                      std::vector<Mat3>& out) const {
  const auto add = [&](const Chunk& chunk, std::size_t entry, int particle, auto& sums) {
    const float* value = d.data() + 3 * particle;
    for (std::size_t b = 0; b < 3; ++b) {
      const Eigen::Map<const Lanes> slope(&chunk.slopes[(entry * 3 + b) * lanes]);
      for (std::size_t a = 0; a < 3; ++a) sums[3 * a + b] += slope * value[a];
    }
  };
  sum_gradients(rigid, add, out);
  for (const Chunk& chunk : chunks_)
    for (const Samples::ShortSpan& at : chunk.short_spans) {
      Mat3& F = out[static_cast<std::size_t>(at.sample)];
      F = Completion(F - rigid.R * at.span.missing(), at.span).F();
    }
}

void BlockedField::blend_gradients(const RigidMotion& rigid, const ParticleValues<12>& maps,
                                   std::vector<Mat3>& out) const {
  const auto add = [&](const Chunk& chunk, std::size_t entry, int particle, auto& sums) {
    const Eigen::Map<const Lanes> w(&chunk.weights[entry * lanes]);
    const float* value = maps.data() + 12 * particle + 3;
    for (std::size_t c = 0; c < 9; ++c) sums[c] += w * value[c];
  };
  sum_gradients(rigid, add, out);
}

long BlockedField::uncovered() const {
  return std::accumulate(chunks_.begin(), chunks_.end(), 0L,
                         [](long sum, const Chunk& chunk) { return sum + chunk.uncovered; });
}

long BlockedField::rank_lost() const {
  return std::accumulate(chunks_.begin(), chunks_.end(), 0L,
                         [](long sum, const Chunk& chunk) { return sum + chunk.rank_lost; });
}

Index BlockedField::entries() const {
  return std::accumulate(chunks_.begin(), chunks_.end(), Index(0),
                         [](Index sum, const Chunk& chunk) { return sum + chunk.entries; });
}

Index BlockedField::padded_entries() const {
  return std::accumulate(chunks_.begin(), chunks_.end(), Index(0), [](Index sum, const Chunk& c) {
    return sum + static_cast<Index>(c.weights.size());
  });
}

}  // namespace supple
