#include "core/sample/arrangement_walk.h"

#include <array>
#include <bit>
#include <cmath>

#include "core/csg/literal_bounds.h"
#include "core/sample/near_middle.h"

namespace hewn {
namespace {

Vec3 on_circle(const ProbeCircle& probe, double angle) {
  return probe.center + std::cos(angle) * probe.u + std::sin(angle) * probe.w;
}

}  // namespace

void Walker::line(const ProbeLine& probe) {
  const double reach = 2 * place_.box.diagonal() + (probe.point - place_.box.center()).norm();
  const Vec3 from = probe.point - reach * probe.direction;
  events_.clear();
  place_.rays.cast_literals(from, probe.direction, stretches_);
  for (const TreeInterval& s : stretches_) {
    events_.emplace_back(s.enter.t, s.enter.literal);
    events_.emplace_back(s.leave.t, s.leave.literal);
  }
  // In whatever order those at the same place: no cell lies between them.
  sort_(events_, [](const auto& event) { return event.first; });
  std::uint64_t key = 0;
  const double shortest = 4 * kUncertain * place_.arrangement.scale;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    key ^= place_.keys[static_cast<std::size_t>(events_[i].second)];
    const bool is_last = i + 1 == events_.size();
    const double next = is_last ? events_[i].first + reach * 0.01 : events_[i + 1].first;
    if (next - events_[i].first < shortest || place_.known.contains(key)) continue;
    finds_.add(from + near_middle(events_[i].first, next) * probe.direction, key);
  }
}

void Walker::circle(const ProbeCircle& probe) {
  // The same angles for every circle.
  static const auto places = [] {
    std::array<std::pair<double, double>, kSamples + 1> all;
    for (int k = 0; k <= kSamples; ++k) {
      const double angle = 2 * kPi * k / kSamples;
      all[static_cast<std::size_t>(k)] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  find_near(probe);
  for (int k = 0; k <= kSamples; ++k) {
    const double angle = 2 * kPi * k / kSamples;
    const auto [cosine, sine] = places[static_cast<std::size_t>(k)];
    take(probe.center + cosine * probe.u + sine * probe.w, angle * radius_, here_);
    if (k > 0) refine(probe, angle - 2 * kPi / kSamples, angle, last_, here_, 0);
    std::swap(last_, here_);
  }
}

/// The literals whose bounds meet those of the circle.
void Walker::find_near(const ProbeCircle& probe) {
  const Arrangement& all = place_.arrangement;
  near_.clear();
  radius_ = probe.u.norm();
  const Vec3 reach = (probe.u.array().square() + probe.w.array().square()).sqrt();
  for (std::size_t k = 0; k < all.literals.size(); ++k) {
    const LiteralBounds& bounds = all.bounds[k];
    const Vec3 margin = reach + Vec3::Constant(2 * (all.uncertain[k] + bounds.slack));
    const bool is_apart = ((bounds.box.lo - margin).array() > probe.center.array()).any() ||
                          ((bounds.box.hi + margin).array() < probe.center.array()).any();
    if (!is_apart) near_.push_back({k});
  }
}

/// The literal's signed distance, or a smaller one of the same sign that is certain, too. Signed
/// distances grow by at most the way gone.
double Walker::distance_of(Near& near, const Vec3& p, double at) const {
  const Arrangement& all = place_.arrangement;
  const double margin = all.uncertain[near.literal];
  if (std::abs(at - near.at) + 2 * margin < std::abs(near.distance)) return near.distance;
  const LiteralBounds& bounds = all.bounds[near.literal];
  const double beyond = (bounds.box.lo - p).cwiseMax(p - bounds.box.hi).maxCoeff();
  const bool is_told =
      beyond > bounds.slack + margin || (bounds.is_filled && beyond < -bounds.slack - margin);
  near.at = at;
  near.distance = is_told ? beyond - std::copysign(bounds.slack, beyond)
                          : all.literals[near.literal].signed_distance(p);
  return near.distance;
}

/// Adds the cell of `p` to the finds, unless a surface is too near to tell it.
void Walker::take(const Vec3& p, double at, Sample& out) {
  const Arrangement& all = place_.arrangement;
  out.is_certain = false;
  out.holds.assign((near_.size() + 63) / 64, 0);
  std::uint64_t key = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const std::size_t k = near_[i].literal;
    const double d = distance_of(near_[i], p, at);
    if (std::abs(d) < all.uncertain[k]) return;
    if (d >= 0) continue;
    set_bit(out.holds.data(), i);
    key ^= place_.keys[k];
  }
  out.is_certain = true;
  // Mostly the cell of the sample before.
  if (key == last_key_) return;
  last_key_ = key;
  if (!place_.known.contains(key)) finds_.add(p, key);
}

void Walker::refine(const ProbeCircle& probe, double from, double to, const Sample& a,
                    const Sample& b, int depth) {
  if (depth >= kDeepest || !a.is_certain || !b.is_certain) return;
  int different = 0;
  for (std::size_t i = 0; i < a.holds.size(); ++i) {
    different += std::popcount(a.holds[i] ^ b.holds[i]);
  }
  if (different < 2) return;
  const double middle = (from + to) / 2;
  Sample& m = middle_[depth];
  take(on_circle(probe, middle), middle * radius_, m);
  refine(probe, from, middle, a, m, depth + 1);
  refine(probe, middle, to, m, b, depth + 1);
}

}  // namespace hewn
