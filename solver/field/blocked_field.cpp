#include "solver/field/blocked_field.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

#include "solver/core/check.h"
#include "solver/core/parallel.h"
#include "solver/field/spatial_order.h"

namespace supple {
namespace {

constexpr Index blocks_per_chunk = 64;

/// Points in their own order are written in one stream: worth so much more to be read.
constexpr double worth_of_own_order = 1.25;

/// Blocks looked at to tell how much an order makes them share.
constexpr Index blocks_tried = 64;

/// Particles in the lists of some blocks, if points were laid out in that order.
std::size_t listed(const MovingLeastSquares<3>& field, const Points& points,
                   const std::vector<int>& order) {
  constexpr Index lanes = BlockedField::lanes;
  const Index block_count = points.rows() / lanes;
  const Index tried = std::min(block_count, blocks_tried);
  std::size_t sum = 0;
  for (Index k = 0; k < tried; ++k) {
    const Index block = k * block_count / tried;
    const std::vector<int> rows(order.begin() + block * lanes, order.begin() + (block + 1) * lanes);
    std::vector<int> particles =
        sample_field(field, points(rows, Eigen::all), SampleContent::values).particles;
    std::sort(particles.begin(), particles.end());
    sum += static_cast<std::size_t>(std::unique(particles.begin(), particles.end()) -
                                    particles.begin());
  }
  return sum;
}

/// The points' own order where neighbours in it lie together well enough, else one by place.
std::vector<int> block_order(const MovingLeastSquares<3>& field, const Points& points) {
  std::vector<int> own(static_cast<std::size_t>(points.rows())), spatial = spatial_order(points);
  std::iota(own.begin(), own.end(), 0);
  const bool together = static_cast<double>(listed(field, points, own)) <=
                        worth_of_own_order * static_cast<double>(listed(field, points, spatial));
  return together ? own : spatial;
}

}  // namespace

BlockedField::BlockedField(const MovingLeastSquares<3>& field, const Points& points)
    : size_(points.rows()),
      order_(block_order(field, points)),
      own_order_(std::is_sorted(order_.begin(), order_.end())) {
  const Index block_count = (size_ + lanes - 1) / lanes;
  order_.resize(static_cast<std::size_t>(block_count * lanes), -1);
  rest_.resize(order_.size(), Vec3::Zero());
  for (std::size_t at = 0; at < order_.size(); ++at)
    if (order_[at] >= 0) rest_[at] = points.row(order_[at]).transpose();

  rest_lanes_.resize(3 * rest_.size());
  for (std::size_t at = 0; at < rest_.size(); ++at)
    for (std::size_t axis = 0; axis < 3; ++axis)
      rest_lanes_[(at / lanes * 3 + axis) * lanes + at % lanes] =
          static_cast<float>(rest_[at][static_cast<Index>(axis)]);

  std::vector<Chunk> chunks(
      static_cast<std::size_t>((block_count + blocks_per_chunk - 1) / blocks_per_chunk));
  parallel_chunks(block_count, blocks_per_chunk, [&](Index begin, Index end) {
    chunks[static_cast<std::size_t>(begin / blocks_per_chunk)] =
        build_chunk(field, points, begin, end);
  });
  join(chunks);
}

/// In a row, so that memory is read in one stream.
void BlockedField::join(std::vector<Chunk>& chunks) {
  std::size_t entries = 0;
  for (const Chunk& chunk : chunks) entries += chunk.particles.size();
  particles_.reserve(entries);
  weights_.reserve(entries * lanes);
  slopes_.reserve(entries * lanes * 3);
  for (Chunk& chunk : chunks) {
    for (std::size_t block = 1; block < chunk.block_starts.size(); ++block)
      block_starts_.push_back(static_cast<int>(particles_.size()) + chunk.block_starts[block]);
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(particles_, chunk.particles);
    append(weights_, chunk.weights);
    append(slopes_, chunk.slopes);
    append(short_spans_, chunk.short_spans);
    entries_ += chunk.entries;
    uncovered_ += chunk.uncovered;
    rank_lost_ += chunk.rank_lost;
    chunk = Chunk();
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
  // As many lanes at a time as the processor has registers for.
  constexpr int width = Sums <= 3 ? lanes : 8;
  const auto walk = [&](Index begin, Index end) {
    alignas(32) std::array<float, Sums * lanes> stored;
    for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end);
         ++block) {
      for (int lane = 0; lane < lanes; lane += width) {
        const auto sums = sum_entries<Sums, width>(block, lane, add);
        for (std::size_t c = 0; c < Sums; ++c) {
          const auto at = c * lanes + static_cast<std::size_t>(lane);
          Eigen::Map<Eigen::Array<float, width, 1>>{stored.data() + at} = sums[c];
        }
      }
      store(stored, block);
    }
  };
  // By reference, so that nothing is allocated.
  parallel_chunks(static_cast<Index>(block_starts_.size()) - 1, blocks_per_chunk, std::cref(walk));
}

template <std::size_t Sums, int Width, class Add>
auto BlockedField::sum_entries(std::size_t block, int lane, const Add& add) const {
  std::array<Eigen::Array<float, Width, 1>, Sums> sums;
  for (auto& sum : sums) sum.setZero();
  for (int entry = block_starts_[block]; entry < block_starts_[block + 1]; ++entry) {
    const auto at = static_cast<std::size_t>(entry);
    add(at, particles_[at], lane, sums);
  }
  return sums;
}

namespace {

/// sums[First + c] += weights·values[c] for c < Count, written out, so that the sums stay in
/// registers.
template <std::size_t First, std::size_t Count, class Sums>
void add_products(const float* weights, const float* values, Sums& sums) {
  using Pack = typename Sums::value_type;
  const Pack w = Eigen::Map<const Pack>(weights);
  [&]<std::size_t... c>(std::index_sequence<c...>) {
    ((sums[First + c] += w * values[c]), ...);
  }
  (std::make_index_sequence<Count>());
}

}  // namespace

void BlockedField::displace(const RigidMotion& rigid, const ParticleValues<3>& d,
                            Points& out) const {
  out.resize(size_, 3);
  for_each_block<3>(
      [&](std::size_t entry, int particle, int lane, auto& sums) {
        add_products<0, 3>(&weights_[entry * lanes + std::size_t(lane)], d.data() + 3 * particle,
                           sums);
      },
      [&](const auto& sums, std::size_t block) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          const int point = order_[block * lanes + lane];
          if (point < 0) continue;
          const Vec3 moved(sums[lane], sums[lanes + lane], sums[2 * lanes + lane]);
          out.row(point) = (rigid(rest_[block * lanes + lane]) + moved).transpose();
        }
      });
}

void BlockedField::displace(const RigidMotion& rigid, const ParticleValues<3>& d,
                            FloatPoints& out) const {
  out.resize(size_, 3);
  const Eigen::Matrix3f R = rigid.R.cast<float>();
  const Eigen::Vector3f t = rigid.t.cast<float>();
  for_each_block<3>(
      [&](std::size_t entry, int particle, int lane, auto& sums) {
        add_products<0, 3>(&weights_[entry * lanes + std::size_t(lane)], d.data() + 3 * particle,
                           sums);
      },
      [&](auto& sums, std::size_t block) {
        const float* rest = &rest_lanes_[3 * block * lanes];
        const Eigen::Map<const Lanes> x(rest), y(rest + lanes), z(rest + 2 * lanes);
        for (int a = 0; a < 3; ++a)
          Eigen::Map<Lanes>(&sums[std::size_t(a) * lanes]) +=
              R(a, 0) * x + R(a, 1) * y + R(a, 2) * z + t[a];
        if (own_order_ && static_cast<Index>((block + 1) * lanes) <= size_) {
          // In one stream, without asking where each lane goes.
          float* to = out.data() + 3 * block * lanes;
          for (std::size_t lane = 0; lane < lanes; ++lane, to += 3) {
            to[0] = sums[lane];
            to[1] = sums[lanes + lane];
            to[2] = sums[2 * lanes + lane];
          }
          return;
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          const int point = order_[block * lanes + lane];
          if (point >= 0) out.row(point) << sums[lane], sums[lanes + lane], sums[2 * lanes + lane];
        }
      });
}

void BlockedField::blend(const RigidMotion& rigid, const ParticleValues<12>& maps,
                         Points& out) const {
  out.resize(size_, 3);
  for_each_block<12>(
      [&](std::size_t entry, int particle, int lane, auto& sums) {
        add_products<0, 12>(&weights_[entry * lanes + std::size_t(lane)],
                            maps.data() + 12 * particle, sums);
      },
      [&](const auto& sums, std::size_t block) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          const int point = order_[block * lanes + lane];
          if (point < 0) continue;
          const Vec3& rest = rest_[block * lanes + lane];
          Vec3 f = rigid(rest);
          for (std::size_t a = 0; a < 3; ++a) {
            double extra = sums[a * lanes + lane];
            for (std::size_t b = 0; b < 3; ++b)
              extra += double(sums[(3 + 3 * a + b) * lanes + lane]) * rest[static_cast<Index>(b)];
            f[static_cast<Index>(a)] += extra;
          }
          out.row(point) = f.transpose();
        }
      });
}

template <class Add>
void BlockedField::sum_gradients(const RigidMotion& rigid, const Add& add,
                                 std::vector<Mat3>& out) const {
  out.resize(static_cast<std::size_t>(size_));
  for_each_block<9>(add, [&](const auto& sums, std::size_t block) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const int point = order_[block * lanes + lane];
      if (point < 0) continue;
      Mat3 F = rigid.R;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) F(a, b) += sums[std::size_t(3 * b + a) * lanes + lane];
      out[static_cast<std::size_t>(point)] = F;
    }
  });
}

/// The sums are F's columns, one after the other.
void BlockedField::displace_gradients(const RigidMotion& rigid, const ParticleValues<3>& d,
                                      std::vector<Mat3>& out) const {
  const auto add = [&](std::size_t entry, int particle, int lane, auto& sums) {
    const float* slopes = &slopes_[entry * 3 * lanes + std::size_t(lane)];
    const float* value = d.data() + 3 * particle;
    add_products<0, 3>(slopes, value, sums);
    add_products<3, 3>(slopes + lanes, value, sums);
    add_products<6, 3>(slopes + 2 * lanes, value, sums);
  };
  sum_gradients(rigid, add, out);
  for (const Samples::ShortSpan& at : short_spans_) {
    Mat3& F = out[static_cast<std::size_t>(at.sample)];
    F = Completion(F - rigid.R * at.span.missing(), at.span).F();
  }
}

void BlockedField::blend_gradients(const RigidMotion& rigid, const ParticleValues<12>& maps,
                                   std::vector<Mat3>& out) const {
  const auto add = [&](std::size_t entry, int particle, int lane, auto& sums) {
    // A map's matrix stands by rows.
    const float* w = &weights_[entry * lanes + std::size_t(lane)];
    const float* B = maps.data() + 12 * particle + 3;
    const std::array<float, 9> by_columns{B[0], B[3], B[6], B[1], B[4], B[7], B[2], B[5], B[8]};
    add_products<0, 9>(w, by_columns.data(), sums);
  };
  sum_gradients(rigid, add, out);
}

}  // namespace supple
