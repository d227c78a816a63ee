#include "solver/field/blocked_field.h"

#include <algorithm>

#include "solver/core/check.h"
#include "solver/core/parallel.h"
#include "solver/field/spatial_order.h"

namespace supple {
namespace {

constexpr Index blocks_per_chunk = 64;

}  // namespace

/// Some consecutive blocks, before all are put together.
struct BlockedField::Chunk {
  std::vector<int> block_sizes;
  std::vector<int> particles;
  std::vector<float> weights, slopes;
  std::vector<Samples::ShortSpan> short_spans;
  Index entries = 0;
  long uncovered = 0, rank_lost = 0;
};

BlockedField::BlockedField(const MovingLeastSquares<3>& field, const Points& points)
    : size_(points.rows()), order_(spatial_order(points)) {
  const Index block_count = (size_ + lanes - 1) / lanes;
  order_.resize(static_cast<std::size_t>(block_count * lanes), -1);
  rest_.resize(order_.size(), Vec3::Zero());
  for (std::size_t at = 0; at < order_.size(); ++at)
    if (order_[at] >= 0) rest_[at] = points.row(order_[at]).transpose();

  std::vector<Chunk> chunks(
      static_cast<std::size_t>((block_count + blocks_per_chunk - 1) / blocks_per_chunk));
  parallel_chunks(block_count, blocks_per_chunk, [&](Index begin, Index end) {
    chunks[static_cast<std::size_t>(begin / blocks_per_chunk)] =
        build_chunk(field, points, begin, end);
  });
  std::size_t listed = 0;
  for (const Chunk& chunk : chunks) listed += chunk.particles.size();
  particles_.reserve(listed);
  weights_.reserve(listed * lanes);
  slopes_.reserve(listed * lanes * 3);
  for (Chunk& chunk : chunks) {
    append(chunk);
    chunk = {};  // give its memory back before the next one is copied
  }
}

BlockedField::Chunk BlockedField::build_chunk(const MovingLeastSquares<3>& field,
                                              const Points& points, Index first_block,
                                              Index last_block) const {
  Chunk chunk;
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
  return chunk;
}

void BlockedField::add_block(const Samples& rows, Chunk& chunk) {
  std::vector<int> shared = rows.particles;
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());

  const std::size_t first = chunk.particles.size();
  chunk.block_sizes.push_back(static_cast<int>(shared.size()));
  chunk.particles.insert(chunk.particles.end(), shared.begin(), shared.end());
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

void BlockedField::append(const Chunk& chunk) {
  for (const int size : chunk.block_sizes) block_starts_.push_back(block_starts_.back() + size);
  particles_.insert(particles_.end(), chunk.particles.begin(), chunk.particles.end());
  weights_.insert(weights_.end(), chunk.weights.begin(), chunk.weights.end());
  slopes_.insert(slopes_.end(), chunk.slopes.begin(), chunk.slopes.end());
  short_spans_.insert(short_spans_.end(), chunk.short_spans.begin(), chunk.short_spans.end());
  entries_ += chunk.entries;
  uncovered_ += chunk.uncovered;
  rank_lost_ += chunk.rank_lost;
}

template <class Body>
void BlockedField::for_each_block(const Body& body) const {
  parallel_chunks(blocks(), blocks_per_chunk, [&](Index begin, Index end) {
    for (Index block = begin; block < end; ++block) body(block);
  });
}

template <class Body>
void BlockedField::for_each_point(Index block, const Body& body) const {
  for (int lane = 0; lane < lanes; ++lane) {
    const auto at = static_cast<std::size_t>(block * lanes + lane);
    if (order_[at] >= 0) body(lane, order_[at], rest_[at]);
  }
}

void BlockedField::store_gradients(Index block, const RigidMotion& rigid,
                                   const std::array<Lanes, 9>& sum, std::vector<Mat3>& out) const {
  for_each_point(block, [&](int lane, int point, const Vec3&) {
    Mat3 F = rigid.R;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) F(a, b) += sum[static_cast<std::size_t>(3 * a + b)][lane];
    out[static_cast<std::size_t>(point)] = F;
  });
}

void BlockedField::displace(const RigidMotion& rigid, const ParticleValues<3>& d,
                            Points& out) const {
  out.resize(size_, 3);
  for_each_block([&](Index block) {
    Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero();
    const int end = block_starts_[static_cast<std::size_t>(block) + 1];
    for (int entry = block_starts_[static_cast<std::size_t>(block)]; entry < end; ++entry) {
      const Eigen::Map<const Lanes> w(entry_weights(entry));
      const float* value = d.data() + 3 * particles_[static_cast<std::size_t>(entry)];
      x += w * value[0];
      y += w * value[1];
      z += w * value[2];
    }
    for_each_point(block, [&](int lane, int point, const Vec3& rest) {
      out.row(point) = (rigid(rest) + Vec3(x[lane], y[lane], z[lane])).transpose();
    });
  });
}

void BlockedField::blend(const RigidMotion& rigid, const ParticleValues<12>& maps,
                         Points& out) const {
  out.resize(size_, 3);
  for_each_block([&](Index block) {
    std::array<Lanes, 12> sum;
    sum.fill(Lanes::Zero());
    const int end = block_starts_[static_cast<std::size_t>(block) + 1];
    for (int entry = block_starts_[static_cast<std::size_t>(block)]; entry < end; ++entry) {
      const Eigen::Map<const Lanes> w(entry_weights(entry));
      const float* value = maps.data() + 12 * particles_[static_cast<std::size_t>(entry)];
      for (std::size_t c = 0; c < 12; ++c) sum[c] += w * value[c];
    }
    for_each_point(block, [&](int lane, int point, const Vec3& rest) {
      Vec3 f = rigid(rest);
      for (std::size_t a = 0; a < 3; ++a) {
        double extra = sum[a][lane];
        for (std::size_t b = 0; b < 3; ++b)
          extra += double(sum[3 + 3 * a + b][lane]) * rest[static_cast<Index>(b)];
        f[static_cast<Index>(a)] += extra;
      }
      out.row(point) = f.transpose();
    });
  });
}

void BlockedField::displace_gradients(const RigidMotion& rigid, const ParticleValues<3>& d,
                                      std::vector<Mat3>& out) const {
  out.resize(static_cast<std::size_t>(size_));
  for_each_block([&](Index block) {
    std::array<Lanes, 9> sum;
    sum.fill(Lanes::Zero());
    const int end = block_starts_[static_cast<std::size_t>(block) + 1];
    for (int entry = block_starts_[static_cast<std::size_t>(block)]; entry < end; ++entry) {
      const float* value = d.data() + 3 * particles_[static_cast<std::size_t>(entry)];
      for (std::size_t b = 0; b < 3; ++b) {
        const Eigen::Map<const Lanes> slope(
            &slopes_[(static_cast<std::size_t>(entry) * 3 + b) * lanes]);
        for (std::size_t a = 0; a < 3; ++a) sum[3 * a + b] += slope * value[a];
      }
    }
    store_gradients(block, rigid, sum, out);
  });
  for (const Samples::ShortSpan& at : short_spans_) {
    Mat3& F = out[static_cast<std::size_t>(at.sample)];
    F = Completion(F - rigid.R * at.span.missing(), at.span).F();
  }
}

void BlockedField::blend_gradients(const RigidMotion& rigid, const ParticleValues<12>& maps,
                                   std::vector<Mat3>& out) const {
  out.resize(static_cast<std::size_t>(size_));
  for_each_block([&](Index block) {
    std::array<Lanes, 9> sum;
    sum.fill(Lanes::Zero());
    const int end = block_starts_[static_cast<std::size_t>(block) + 1];
    for (int entry = block_starts_[static_cast<std::size_t>(block)]; entry < end; ++entry) {
      const Eigen::Map<const Lanes> w(entry_weights(entry));
      const float* value = maps.data() + 12 * particles_[static_cast<std::size_t>(entry)] + 3;
      for (std::size_t c = 0; c < 9; ++c) sum[c] += w * value[c];
    }
    store_gradients(block, rigid, sum, out);
  });
}

}  // namespace supple
