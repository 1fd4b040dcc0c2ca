#include "core/segment/curved_growth.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace hewn {
namespace {

constexpr double kMaxNormalDeviation = 0.22;  // radians; of a patch from its first fit
constexpr double kMaxSagittaRatio = 0.024;    // of the radius: steps of 25 degrees for most facets
constexpr double kMaxSagittaOutlier = 0.062;  // and of 40 degrees for each
constexpr double kTightRms = 0.15;            // of the sagitta: corners lie on the surface
/// A candidate as loose as this counts half its area: an exact smaller one goes first.
constexpr double kHalfLooseness = 0.4;
/// Areas of facets of one ring differ by less than this factor, but where they are trimmed.
constexpr double kAlike = 3;
constexpr double kExactLooseness = 0.1;
constexpr double kResampledSlack = 3;
constexpr double kMaxFacetShare = 0.4;  // of a resampled curved group, in one flat facet
/// A smooth component is free-form when it falls into this many surfaces and most of them meet its
/// facets only loosely: those of a design are exact however many they are.
constexpr int kManySurfaces = 60;
constexpr double kLoose = 0.3;
constexpr double kMostlyLoose = 0.8;      // of the surfaces
constexpr double kSignificant = 10;       // F-test
constexpr double kSameFit = 0.3;          // of what exact vertices may stray
constexpr double kCovering = 0.95;        // of a component's free facets on one cylinder,
constexpr int kConfirmed = 2;             // for this many seeds
constexpr double kMaxRadius = 5;          // in diagonals
constexpr double kMinNormalAngle = 0.01;  // radians; counts as a different normal
constexpr int kPatchSizes[] = {5, 12, 30};
constexpr int kResampledPatchSizes[] = {12, 40, 120, 360};

int min_facets(SurfaceKind kind) {
  if (kind == SurfaceKind::Sphere) return 6;
  return kind == SurfaceKind::Torus ? 8 : 4;
}

/// Simple kinds win when both explain the same facets.
double simplicity(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Sphere:
      return 0.97;
    case SurfaceKind::Cone:
      return 0.9;
    case SurfaceKind::Torus:
      return 0.8;
    default:
      return 1;
  }
}

struct GrowthLimits {
  double distance = 0;   // of corners
  double sagitta = 0;    // of facet centres
  double angle_rad = 0;  // of facet normals
};

struct Candidate {
  Surface surface;
  std::vector<int> facets;
  double score = 0;
  double looseness = 0;  // corners' deviation against what the sagitta lets one tell
};

class CurvedGrower {
 public:
  CurvedGrower(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
               const SegmentOptions& options, std::vector<int>& group_of_facet)
      : mesh_(mesh),
        graph_(graph),
        tolerance_(tolerance),
        options_(options),
        smooth_rad_(options.smooth_angle_deg * kPi / 180),
        fitter_(mesh, graph, tolerance),
        group_of_(group_of_facet),
        stamp_of_(graph.facets.size(), 0),
        tried_after_(graph.facets.size(), -1) {}

  /// False when the component is free-form and was given up.
  Result<bool> grow_component(const std::vector<int>& component, std::vector<GrownGroup>& groups,
                              const RunContext& run) {
    Rng rng(kStream, static_cast<std::uint64_t>(component.front()));
    int failures = 0;
    int found = 0;
    int loose = 0;
    while (failures < options_.max_failures) {
      if (found >= kManySurfaces && loose > kMostlyLoose * found) return false;
      std::vector<int> seeds;
      const int free = untried_seeds(component, seeds);
      if (free < 4 || seeds.empty()) break;
      const bool is_exhaustive = static_cast<int>(seeds.size()) <= 2 * options_.seeds;
      if (!is_exhaustive) {
        for (int i = 0; i < options_.seeds; ++i) {
          const std::size_t j = i + rng.below(seeds.size() - i);
          std::swap(seeds[i], seeds[j]);
        }
        seeds.resize(options_.seeds);
      }
      Candidate best;
      int confirmed = 0;
      for (const int seed : seeds) {
        if (run.is_cancelled()) return RunContext::cancelled();
        try_seed(seed, best);
        tried_after_[seed] = surfaces_;
        // All other seeds would find the one surface that there is.
        if (covers(best, free) && ++confirmed >= kConfirmed) break;
      }
      if (best.score <= 0) {
        if (is_exhaustive) break;
        ++failures;
        continue;
      }
      failures = 0;
      ++found;
      ++surfaces_;
      simplify(best.surface, best.facets);
      loose += best.looseness > (tolerance_.is_resampled ? kResampledSlack : 1) * kLoose;
      for (const int f : best.facets) group_of_[f] = static_cast<int>(groups.size());
      groups.push_back({best.surface, std::move(best.facets)});
    }
    return true;
  }

 private:
  static constexpr std::uint64_t kStream = 12345;

  /// Free facets of the component that were not tried since the last surface was found: trying them
  /// again would end the same. Returns the number of free facets, tried or not.
  int untried_seeds(const std::vector<int>& component, std::vector<int>& seeds) const {
    int free = 0;
    for (const int f : component) {
      if (group_of_[f] >= 0) continue;
      ++free;
      if (tried_after_[f] != surfaces_) seeds.push_back(f);
    }
    return free;
  }

  static bool covers(const Candidate& c, int free) {
    return c.score > 0 && c.surface.kind == SurfaceKind::Cylinder &&
           static_cast<double>(c.facets.size()) > kCovering * free;
  }

  void try_seed(int seed, Candidate& best) {
    const double diagonal = tolerance_.diagonal;
    if (graph_.facets[seed].area < 1e-8 * diagonal * diagonal || fitter_.is_tiny(seed)) return;
    // A seed that the best surface explains exactly would only find it again.
    if (best.score > 0 && best.looseness < kExactLooseness &&
        std::binary_search(best.facets.begin(), best.facets.end(), seed)) {
      return;
    }
    const std::span<const int> sizes = tolerance_.is_resampled
                                           ? std::span<const int>(kResampledPatchSizes)
                                           : std::span<const int>(kPatchSizes);
    // The triangles of a resampled mesh turn anyhow.
    if (!tolerance_.is_resampled) {
      const std::vector<int> smoothest = smoothest_neighborhood(seed, sizes.front());
      if (smoothest.size() >= 4 && try_patch(smoothest, best)) return;
    }
    for (const int size : sizes) {
      const std::vector<int> patch = neighborhood(seed, size);
      if (patch.size() < 4) return;
      if (size > sizes.front() && static_cast<int>(patch.size()) <= size / 3) return;
      if (try_patch(patch, best)) return;
    }
  }

  /// Develops every guess for a patch, simple kinds first. True when one is exact and reaches well
  /// beyond the patch: larger patches and richer kinds would find the same.
  bool try_patch(const std::vector<int>& patch, Candidate& best) {
    for (const Surface& guess : fitter_.guess(patch)) {
      std::optional<Candidate> c = develop(guess, patch);
      if (!c) continue;
      // A ring of facets of any surface of revolution is an exact cone, and a sphere's larger
      // facets are only reached from larger patches.
      const bool is_simple = guess.kind == SurfaceKind::Cylinder;
      const bool is_exact =
          is_simple && c->looseness < kExactLooseness && c->facets.size() >= 2 * patch.size();
      if (c->score > best.score) {
        best = std::move(*c);
        std::sort(best.facets.begin(), best.facets.end());
      }
      if (is_exact) return true;
    }
    return false;
  }

  /// The facets that the smallest turns lead to: it runs around a cylinder or cone before it
  /// crosses over to what joins it smoothly.
  std::vector<int> smoothest_neighborhood(int seed, int size) {
    ++stamp_;
    std::vector<int> patch = {seed};
    stamp_of_[seed] = stamp_;
    while (static_cast<int>(patch.size()) < size) {
      FacetNeighbor next{-1, smooth_rad_};
      for (const int f : patch) {
        for (const FacetNeighbor& n : graph_.neighbors(f)) {
          if (n.angle_rad >= next.angle_rad || !is_free(n.facet)) continue;
          const double ratio = graph_.facets[n.facet].area / graph_.facets[seed].area;
          if (ratio > kAlike || ratio < 1 / kAlike) continue;
          next = n;
        }
      }
      if (next.facet < 0) break;
      stamp_of_[next.facet] = stamp_;
      patch.push_back(next.facet);
    }
    return patch;
  }

  /// Neither taken, nor in the patch, nor too small to tell anything.
  bool is_free(int facet) const {
    return group_of_[facet] < 0 && stamp_of_[facet] != stamp_ && !fitter_.is_tiny(facet);
  }

  std::vector<int> neighborhood(int seed, int size) {
    ++stamp_;
    std::vector<int> patch = {seed};
    stamp_of_[seed] = stamp_;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const FacetNeighbor& n : graph_.neighbors(patch[i])) {
        if (static_cast<int>(patch.size()) >= size) return patch;
        if (n.angle_rad >= smooth_rad_ || !is_free(n.facet)) continue;
        stamp_of_[n.facet] = stamp_;
        patch.push_back(n.facet);
      }
    }
    return patch;
  }

  /// Fits the guess to the patch, grows, refits and judges.
  std::optional<Candidate> develop(Surface s, const std::vector<int>& patch) {
    std::vector<int> core = patch;
    if (!fit_core(s, core)) return std::nullopt;
    const FitQuality q = fitter_.evaluate(s, core);
    if (q.max_angle_rad > kMaxNormalDeviation) return std::nullopt;
    const double eps = tolerance_.eps;
    const bool is_tight = q.rms_distance < kTightRms * q.sagitta;
    GrowthLimits limits;
    limits.distance = std::max(
        2 * eps, is_tight ? std::min(4e-3 * tolerance_.diagonal, 1.15 * q.sagitta)
                          : std::min(options_.max_deviation * tolerance_.diagonal, q.sagitta));
    if (q.rms_distance > 0.6 * limits.distance) return std::nullopt;
    if (!has_fine_facets(s, core)) return std::nullopt;
    limits.sagitta = 1.6 * q.sagitta + 2 * eps;
    limits.angle_rad = std::max(0.06, 1.6 * q.max_angle_rad);
    std::vector<int> facets = grow(s, core, limits);
    if (static_cast<int>(facets.size()) < min_facets(s.kind)) return std::nullopt;
    refine_while_growing(s, core, limits, facets);
    return judge(s, std::move(facets));
  }

  /// Whether the facets' depth suits the radius. Tessellators that work along a parameter leave
  /// single wide facets, so most count, not the widest.
  bool has_fine_facets(const Surface& s, const std::vector<int>& facets) const {
    if (s.kind == SurfaceKind::Cone) return true;
    std::vector<double> depths;
    for (const int f : facets) {
      depths.push_back(std::abs(s.signed_distance(graph_.facets[f].centroid)));
    }
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    const double largest = *std::max_element(middle, depths.end());
    return *middle <= kMaxSagittaRatio * s.radius + tolerance_.eps &&
           largest <= kMaxSagittaOutlier * s.radius + tolerance_.eps;
  }

  /// How far corners may stray from a surface that meets its patch like this.
  double distance_limit(const FitQuality& q) const {
    const double exact = 4e-3 * tolerance_.diagonal;
    if (q.rms_distance < kTightRms * q.sagitta) return std::min(exact, 1.15 * q.sagitta);
    // Corners between the inscribed and the circumscribed surface.
    if (tolerance_.is_resampled) return std::min(exact, 2 * std::max(q.sagitta, q.rms_distance));
    return std::min(options_.max_deviation * tolerance_.diagonal, q.sagitta);
  }

  /// First fit, then one more without the facets that are far off.
  bool fit_core(Surface& s, std::vector<int>& core) {
    const FacetFitSettings settings{8, false, 0.02};
    if (!fitter_.refine(s, core, settings)) return false;
    std::vector<std::pair<double, int>> errors;
    for (const int f : core) errors.push_back({fitter_.max_distance(s, f), f});
    std::sort(errors.begin(), errors.end());
    const double limit = std::max(3 * errors[errors.size() / 2].first, 2 * tolerance_.eps);
    std::vector<int> kept;
    for (const auto& [error, f] : errors) {
      if (error <= limit) kept.push_back(f);
    }
    if (kept.size() == core.size() || static_cast<int>(kept.size()) < min_facets(s.kind)) {
      return true;
    }
    core = std::move(kept);
    return fitter_.refine(s, core, settings);
  }

  void refine_while_growing(Surface& s, const std::vector<int>& core, const GrowthLimits& limits,
                            std::vector<int>& facets) {
    for (int round = 0; round < 3; ++round) {
      Surface next = s;
      if (!fitter_.refine(next, facets, {6, round > 0, 0})) return;
      std::vector<int> grown = grow(next, core, limits);
      if (static_cast<double>(grown.size()) < 0.98 * static_cast<double>(facets.size())) return;
      const bool has_grown = grown.size() > facets.size();
      s = next;
      facets = std::move(grown);
      if (!has_grown && round > 0) return;
    }
  }

  std::vector<int> grow(const Surface& s, const std::vector<int>& seeds,
                        const GrowthLimits& limits) {
    ++stamp_;
    std::vector<int> queue;
    double agreement = 0;
    for (const int f : seeds) {
      agreement += s.gradient(graph_.facets[f].centroid).dot(graph_.facets[f].normal);
      if (group_of_[f] >= 0) continue;
      stamp_of_[f] = stamp_;
      queue.push_back(f);
    }
    const double side = agreement < 0 ? -1 : 1;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const bool from_tiny = fitter_.is_tiny(queue[i]);
      for (const FacetNeighbor& n : graph_.neighbors(queue[i])) {
        if (stamp_of_[n.facet] == stamp_ || group_of_[n.facet] >= 0) continue;
        const bool is_tiny = fitter_.is_tiny(n.facet);
        if (!is_tiny && !from_tiny && n.angle_rad > smooth_rad_ * 1.5) continue;
        if (!lies_on(s, n.facet, is_tiny, side, limits)) continue;
        stamp_of_[n.facet] = stamp_;
        queue.push_back(n.facet);
      }
    }
    return queue;
  }

  bool lies_on(const Surface& s, int f, bool is_tiny, double side,
               const GrowthLimits& limits) const {
    for (const int v : graph_.corners(f)) {
      if (std::abs(s.signed_distance(mesh_.vertices[v])) > limits.distance) return false;
    }
    if (is_tiny) return true;
    const Facet& facet = graph_.facets[f];
    if (std::abs(s.signed_distance(facet.centroid)) > limits.sagitta) return false;
    const double slack = 2 * graph_.normal_error_rad[f];
    return side * s.gradient(facet.centroid).dot(facet.normal) >=
           std::cos(std::min(limits.angle_rad + slack, 1.0));
  }

  std::optional<Candidate> judge(Surface s, std::vector<int> facets) {
    const FitQuality q = fitter_.evaluate(s, facets);
    if (s.radius > kMaxRadius * tolerance_.diagonal) return std::nullopt;
    if (distinct_normals(facets) < min_facets(s.kind)) return std::nullopt;
    double rms = q.rms_distance;
    if (s.kind == SurfaceKind::Cylinder) {
      rms = std::min(rms, fitter_.refine_on_planes(s, facets, q));
    }
    const double looseness = rms / (0.1 * q.sagitta + tolerance_.eps);
    // A resampled mesh's corners fill the depth of the facets that they lie on.
    const double slack = tolerance_.is_resampled ? kResampledSlack : 1;
    if (looseness > slack * options_.max_looseness) return std::nullopt;
    const bool is_exact = q.rms_distance < 1.5 * tolerance_.eps;
    if (!normals_agree(s, facets, is_exact)) return std::nullopt;
    if ((s.kind == SurfaceKind::Sphere || s.kind == SurfaceKind::Torus) && is_flat(facets)) {
      return std::nullopt;
    }
    double area = 0, largest = 0;
    for (const int f : facets) {
      area += graph_.facets[f].area;
      largest = std::max(largest, graph_.facets[f].area);
    }
    // A plane with the straddling triangles of its rim passes for a huge cylinder.
    if (tolerance_.is_resampled && largest > kMaxFacetShare * area) return std::nullopt;
    const double excess = looseness / (kHalfLooseness * slack);
    const double tightness = 0.05 + 0.95 / (1 + excess * excess);
    Candidate c{s, std::move(facets), 0, looseness};
    c.score = area * simplicity(s.kind) * tightness * (c.facets.size() < 6 ? 0.5 : 1);
    return c;
  }

  /// Takes a cylinder instead of a cone or torus, or a sphere instead of a torus, when that
  /// explains the facets' corners as well: F-test of the parameters that it saves. Small pieces of
  /// a cylinder with inexact corners pass for tori of any size.
  void simplify(Surface& surface, const std::vector<int>& facets) {
    if (surface.kind != SurfaceKind::Cone && surface.kind != SurfaceKind::Torus) return;
    const FacetFitSettings settings{20, false, 0};
    Surface own = surface;
    if (!fitter_.refine(own, facets, settings)) own = surface;
    const FitQuality q = fitter_.evaluate(own, facets);
    const double corners = static_cast<double>(fitter_.corner_indices(facets).size());
    for (Surface s : fitter_.guess(facets)) {
      const bool is_simpler =
          s.kind == SurfaceKind::Cylinder ||
          (s.kind == SurfaceKind::Sphere && surface.kind == SurfaceKind::Torus && !is_flat(facets));
      if (!is_simpler || !fitter_.refine(s, facets, settings)) continue;
      const FitQuality simple = fitter_.evaluate(s, facets);
      const int saved = parameter_count(surface.kind) - parameter_count(s.kind);
      const double freedom = std::max(1.0, corners - parameter_count(surface.kind));
      const double allowed = q.rms_distance * std::sqrt(1 + kSignificant * saved / freedom);
      if (simple.rms_distance > std::max(allowed, kSameFit * tolerance_.eps)) continue;
      const bool turns_alike = simple.max_angle_rad < 1.2 * q.max_angle_rad + kMinNormalAngle;
      if (!turns_alike && !normals_agree(s, facets, false)) continue;
      if (!has_fine_facets(s, facets)) continue;
      surface = s;
      return;
    }
  }

  /// Counts normals that differ, up to 9.
  int distinct_normals(const std::vector<int>& facets) const {
    std::vector<Vec3> seen;
    for (const int f : facets) {
      const Vec3& n = graph_.facets[f].normal;
      if (graph_.normal_error_rad[f] > kMinNormalAngle * 10) continue;
      const bool is_new = std::none_of(seen.begin(), seen.end(), [&](const Vec3& other) {
        return other.dot(n) > std::cos(kMinNormalAngle);
      });
      if (is_new) seen.push_back(n);
      if (seen.size() > 8) break;
    }
    return static_cast<int>(seen.size());
  }

  /// A tessellated surface deviates from each facet's normal by less than the facets' steps.
  bool normals_agree(const Surface& s, const std::vector<int>& facets, bool is_exact) {
    ++stamp_;
    for (const int f : facets) stamp_of_[f] = stamp_;
    const double min_area = 1e-8 * tolerance_.diagonal * tolerance_.diagonal;
    const auto counts = [&](int f) {
      return graph_.facets[f].area > min_area && !fitter_.is_tiny(f);
    };
    std::vector<double> steps;
    double squares = 0, noise = 0;
    int count = 0;
    for (const int f : facets) {
      if (!counts(f)) continue;
      const double angle =
          unsigned_angle(s.gradient(graph_.facets[f].centroid), graph_.facets[f].normal);
      squares += angle * angle;
      noise += graph_.normal_error_rad[f] * graph_.normal_error_rad[f];
      ++count;
      for (const FacetNeighbor& n : graph_.neighbors(f)) {
        if (stamp_of_[n.facet] == stamp_ && counts(n.facet)) steps.push_back(n.angle_rad);
      }
    }
    if (steps.size() < 3) return false;
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                     steps.end());
    const double step = steps[steps.size() / 2];
    const double deviation = std::sqrt(squares / count);
    const bool is_ruled = s.kind == SurfaceKind::Cylinder || s.kind == SurfaceKind::Cone;
    const double share = is_exact || tolerance_.is_resampled ? 1.3 : is_ruled ? 0.3 : 0.7;
    return deviation <= share * step + 0.002 + std::sqrt(noise / count);
  }

  bool is_flat(const std::vector<int>& facets) const {
    Mat3 moment = Mat3::Zero();
    for (const int f : facets) {
      moment += graph_.facets[f].normal * graph_.facets[f].normal.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(moment / static_cast<double>(facets.size()));
    return solver.eigenvalues()[0] < 1e-4;
  }

  const Mesh& mesh_;
  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  const SegmentOptions& options_;
  double smooth_rad_;
  FacetFitter fitter_;
  std::vector<int>& group_of_;
  std::vector<int> stamp_of_;
  int stamp_ = 0;
  std::vector<int> tried_after_;  ///< seeds: the number of surfaces found before the last try
  int surfaces_ = 0;
};

}  // namespace

std::vector<std::vector<int>> smooth_components(const FacetGraph& graph, double smooth_rad) {
  std::vector<std::vector<int>> components;
  std::vector<bool> is_seen(graph.facets.size(), false);
  for (int start = 0; start < graph.size(); ++start) {
    if (is_seen[start] || graph.facets[start].area <= 0) continue;
    std::vector<int> component = {start};
    is_seen[start] = true;
    for (std::size_t i = 0; i < component.size(); ++i) {
      for (const FacetNeighbor& n : graph.neighbors(component[i])) {
        if (n.angle_rad >= smooth_rad || is_seen[n.facet]) continue;
        if (graph.facets[n.facet].area <= 0) continue;
        is_seen[n.facet] = true;
        component.push_back(n.facet);
      }
    }
    components.push_back(std::move(component));
  }
  return components;
}

Result<int> grow_curved_groups(const Mesh& mesh, const FacetGraph& graph,
                               const SurfaceTolerance& tolerance, const SegmentOptions& options,
                               std::vector<GrownGroup>& groups, std::vector<int>& group_of_facet,
                               const RunContext& run) {
  CurvedGrower grower(mesh, graph, tolerance, options, group_of_facet);
  std::size_t done = 0;
  int given_up = 0;
  const auto components = smooth_components(graph, options.smooth_angle_deg * kPi / 180);
  for (const std::vector<int>& component : components) {
    done += component.size();
    if (component.size() < 4) continue;
    const Result<bool> grown = grower.grow_component(component, groups, run);
    if (!grown) return grown.error();
    given_up += !*grown;
    run.report("segment", static_cast<double>(done) / graph.size());
  }
  return given_up;
}

}  // namespace hewn
