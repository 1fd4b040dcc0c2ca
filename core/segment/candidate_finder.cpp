#include "core/segment/candidate_finder.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "core/segment/same_axis.h"

namespace hewn {
namespace {

constexpr double kMaxNormalDeviation = 0.22;  // radians; of a patch from its first fit
constexpr double kTightRms = 0.15;            // of the sagitta: corners lie on the surface
constexpr double kTightUncut = 0.05;  // of the sagitta: what tells an exact surface may miss
constexpr double kDepthSlack = 1.6;   // times the sagitta: middles of further facets
/// A candidate as loose as this counts half its area: an exact smaller one goes first.
constexpr double kHalfLooseness = 0.4;
/// Areas of facets of one ring differ by less than this factor, but where they are trimmed.
constexpr double kAlike = 3;
/// So few may meet a cylinder by chance, as chamfers do.
constexpr std::size_t kFewFacets = 4;
constexpr double kSameWidth = 0.01;   // of a side, or of a whole turn in sides
constexpr double kSameSlope = 0.017;  // sine
constexpr double kExactLooseness = 0.1;
constexpr double kResampledSlack = 3;
constexpr double kMostFacetShare = 0.8;  // of a curved group's area, in one flat facet
constexpr double kMostResampledShare = 0.4;
constexpr double kSignificant = 10;       // F-test
constexpr double kSameFit = 0.3;          // of what exact vertices may stray
constexpr double kMaxRadius = 5;          // in diagonals
constexpr double kMinNormalAngle = 0.01;  // radians; counts as a different normal
constexpr double kMaxSlack = 1;           // radians, of a facet's normal, however noisy
constexpr double kMinSeedArea = 1e-8;     // of the squared diagonal
constexpr int kPatchSizes[] = {5, 12, 30};
constexpr int kResampledPatchSizes[] = {12, 40, 120, 360};

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

}  // namespace

CandidateFinder::CandidateFinder(const GrowthInput& input, const std::vector<int>& group_of_facet)
    : mesh_(input.mesh),
      graph_(input.graph),
      tolerance_(input.tolerance),
      options_(input.options),
      component_of_(input.component_of),
      group_of_(group_of_facet),
      steps_(input.steps),
      fitter_(input.mesh, input.graph, input.tolerance),
      stamp_of_(input.graph.facets.size(), 0),
      foreign_stamp_of_(input.graph.facets.size(), 0) {}

void CandidateFinder::begin_component(int component) {
  component_ = component;
  foreign_.clear();
  ++foreign_stamp_;
}

int CandidateFinder::least_facets(SurfaceKind kind) const {
  if (kind == SurfaceKind::Sphere) return 6;
  if (kind == SurfaceKind::Torus) return 8;
  return kind == SurfaceKind::Cylinder ? steps_.least_sides : 4;
}

bool CandidateFinder::is_seed(int facet) const {
  const double diagonal = tolerance_.diagonal;
  return graph_.facets[facet].area >= kMinSeedArea * diagonal * diagonal && !fitter_.is_tiny(facet);
}

Candidate CandidateFinder::best_from(int seed) {
  Candidate best;
  search(seed, best);
  std::sort(best.facets.begin(), best.facets.end());
  return best;
}

void CandidateFinder::search(int seed, Candidate& best) {
  const std::span<const int> sizes = tolerance_.is_resampled
                                         ? std::span<const int>(kResampledPatchSizes)
                                         : std::span<const int>(kPatchSizes);
  // The triangles of a resampled mesh turn anyhow.
  if (!tolerance_.is_resampled) {
    const std::vector<int> smoothest = smoothest_neighborhood(seed, sizes.front());
    if (static_cast<int>(smoothest.size()) >= steps_.least_sides && try_patch(smoothest, best))
      return;
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
bool CandidateFinder::try_patch(const std::vector<int>& patch, Candidate& best) {
  for (const Surface& guess : fitter_.guess(patch)) {
    std::optional<Candidate> c = develop(guess, patch);
    if (!c) continue;
    // A ring of facets of any surface of revolution is an exact cone, and a sphere's larger
    // facets are only reached from larger patches.
    const bool is_simple = guess.kind == SurfaceKind::Cylinder;
    const bool is_exact =
        is_simple && c->looseness < kExactLooseness && c->facets.size() >= 2 * patch.size();
    if (c->score > best.score) best = std::move(*c);
    if (is_exact) return true;
  }
  return false;
}

/// The facets that the smallest turns lead to: it runs around a cylinder or cone before it
/// crosses over to what joins it smoothly.
std::vector<int> CandidateFinder::smoothest_neighborhood(int seed, int size) {
  ++stamp_;
  std::vector<int> patch = {seed};
  stamp_of_[seed] = stamp_;
  while (static_cast<int>(patch.size()) < size) {
    FacetNeighbor next{-1, steps_.smooth_rad};
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
bool CandidateFinder::is_free(int facet) const {
  return group_of_[facet] < 0 && stamp_of_[facet] != stamp_ && !fitter_.is_tiny(facet);
}

std::vector<int> CandidateFinder::neighborhood(int seed, int size) {
  ++stamp_;
  std::vector<int> patch = {seed};
  stamp_of_[seed] = stamp_;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    for (const FacetNeighbor& n : graph_.neighbors(patch[i])) {
      if (static_cast<int>(patch.size()) >= size) return patch;
      if (n.angle_rad >= steps_.smooth_rad || !is_free(n.facet)) continue;
      stamp_of_[n.facet] = stamp_;
      patch.push_back(n.facet);
    }
  }
  return patch;
}

/// Fits the guess to the patch, grows, refits and judges.
std::optional<Candidate> CandidateFinder::develop(Surface s, const std::vector<int>& patch) {
  std::vector<int> core = patch;
  if (!fit_core(s, core)) return std::nullopt;
  FitQuality q = fitter_.evaluate(s, core);
  const bool is_uncut = refine_uncut(s, core, q);
  if (q.max_angle_rad > kMaxNormalDeviation) return std::nullopt;
  const double eps = tolerance_.eps;
  const bool is_tight = q.rms_distance < kTightRms * q.sagitta;
  Limits limits;
  limits.distance = std::max(
      2 * eps, is_tight ? std::min(4e-3 * tolerance_.diagonal, kChordSlack * q.sagitta)
                        : std::min(options_.max_deviation * tolerance_.diagonal, q.sagitta));
  if (!is_uncut && q.rms_distance > 0.6 * limits.distance) return std::nullopt;
  if (!has_fine_facets(s, core)) return std::nullopt;
  limits.sagitta = kDepthSlack * q.sagitta + 2 * eps;
  limits.angle_rad = std::max(steps_.least_slack_rad, 1.6 * q.max_angle_rad);
  limits.least_cosine = std::cos(limits.angle_rad);
  if (is_uncut) allow_chords(s, core, q.sagitta, limits);
  std::vector<int> facets = grow(s, core, limits);
  if (static_cast<int>(facets.size()) < least_facets(s.kind)) return std::nullopt;
  refine_while_growing(s, core, limits, facets);
  return judge(s, std::move(facets));
}

/// Whether the facets' depth suits the radius. Tessellators that work along a parameter leave
/// single wide facets, so most count, not the widest.
bool CandidateFinder::has_fine_facets(const Surface& s, const std::vector<int>& facets) const {
  const SurfaceField field(s);
  const bool is_ring = s.kind == SurfaceKind::Cone || is_ring_of_torus(s, facets);
  std::vector<double> depths;  // of the radius
  depths.reserve(facets.size());
  for (const int f : facets) {
    const double depth = std::abs(field.signed_distance(graph_.facets[f].centroid));
    depths.push_back(is_ring ? depth_about_axis(s, f) : (depth - tolerance_.eps) / s.radius);
  }
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const double largest = *std::max_element(middle, depths.end());
  return *middle <= steps_.sagitta_share && largest <= steps_.sagitta_outlier;
}

/// How deep a facet lies in the circle around the axis that its corners lie on, of the radius. What
/// a torus's other circle adds, or takes away where it bends the other way, does not count.
double CandidateFinder::depth_about_axis(const Surface& s, int facet) const {
  const auto across = [&s](const Vec3& p) {
    const Vec3 d = p - s.point;
    return Vec3(d - s.axis * s.axis.dot(d));
  };
  const Vec3 middle = across(graph_.facets[facet].centroid).normalized();
  double least = 1;  // cosine
  for (const int v : graph_.corners(facet)) {
    const Vec3 corner = across(mesh_.vertices[v]);
    const double distance = corner.norm();
    if (distance > tolerance_.eps) least = std::min(least, middle.dot(corner) / distance);
  }
  return 1 - least;
}

/// Whether the facets are whole sides of one regular polygon.
bool CandidateFinder::are_sides_of_polygon(const Surface& s, const std::vector<int>& facets) const {
  const auto width = [&](int f) { return 2 * std::acos(1 - depth_about_axis(s, f)); };
  const double first = width(facets.front());
  const double sides = 2 * kPi / first;
  if (std::abs(sides - std::round(sides)) > kSameWidth * sides) return false;
  return std::all_of(facets.begin(), facets.end(),
                     [&](int f) { return std::abs(width(f) - first) < kSameWidth * first; });
}

/// One ring of facets, all inclined alike, lies on tori of any radius.
bool CandidateFinder::is_ring_of_torus(const Surface& s, const std::vector<int>& facets) const {
  if (s.kind != SurfaceKind::Torus) return false;
  double lo = kInfinity, hi = -kInfinity;
  for (const int f : facets) {
    const double slope = s.axis.dot(graph_.facets[f].normal);
    lo = std::min(lo, slope);
    hi = std::max(hi, slope);
  }
  return hi - lo < kSameSlope;
}

/// First fit, then one more without the facets that are far off.
bool CandidateFinder::fit_core(Surface& s, std::vector<int>& core) {
  const FacetFitSettings settings{8, false, 0.02};
  if (!fitter_.refine(s, core, settings)) return false;
  std::vector<std::pair<double, int>> errors;
  errors.reserve(core.size());
  for (const int f : core) errors.emplace_back(fitter_.max_distance(s, f), f);
  std::sort(errors.begin(), errors.end());
  const double limit = std::max(3 * errors[errors.size() / 2].first, 2 * tolerance_.eps);
  std::vector<int> kept;
  for (const auto& [error, f] : errors) {
    if (error <= limit) kept.push_back(f);
  }
  if (kept.size() == core.size() || static_cast<int>(kept.size()) < least_facets(s.kind)) {
    return true;
  }
  core = std::move(kept);
  return fitter_.refine(s, core, settings);
}

/// Where the corners are off, fits to what cutting the facets did not move. Whether that agrees
/// with the surface; `q` is its quality, before and after.
bool CandidateFinder::refine_uncut(Surface& s, const std::vector<int>& facets, FitQuality& q) {
  if (fitter_.has_exact_corners(q)) return false;
  const double error = fitter_.refine_uncut(s, facets, q);
  if (!(error < kTightUncut * q.sagitta)) return false;
  q = fitter_.evaluate(s, facets);
  return true;
}

/// Corners that cutting made lie on chords: as deep as the facets' middles, or deeper towards the
/// wide end of a cone.
void CandidateFinder::allow_chords(const Surface& s, const std::vector<int>& facets, double sagitta,
                                   Limits& limits) const {
  const double deepest = sagitta * (s.kind == SurfaceKind::Cone ? widening(s, facets) : 1);
  limits.distance = std::max(limits.distance, kChordSlack * deepest);
  limits.sagitta = std::max(limits.sagitta, kDepthSlack * sagitta + 2 * tolerance_.eps);
}

/// How much wider than at its middle a cone is at a facet's far end, for the facet that is longest.
double CandidateFinder::widening(const Surface& cone, const std::vector<int>& facets) const {
  const auto height = [&](const Vec3& p) { return cone.axis.dot(p - cone.point); };
  double widest = 1;
  for (const int f : facets) {
    const double middle = height(graph_.facets[f].centroid);
    for (const int v : graph_.corners(f)) {
      widest = std::max(widest, height(mesh_.vertices[v]) / middle);
    }
  }
  return widest;
}

void CandidateFinder::refine_while_growing(Surface& s, const std::vector<int>& core, Limits limits,
                                           std::vector<int>& facets) {
  for (int round = 0; round < 3; ++round) {
    Surface next = s;
    if (!fitter_.refine(next, facets, {6, round > 0, 0})) return;
    FitQuality q = fitter_.evaluate(next, facets);
    if (refine_uncut(next, facets, q)) allow_chords(next, facets, q.sagitta, limits);
    std::vector<int> grown = grow(next, core, limits);
    if (static_cast<double>(grown.size()) < 0.98 * static_cast<double>(facets.size())) return;
    const bool has_grown = grown.size() > facets.size();
    s = next;
    facets = std::move(grown);
    if (!has_grown && round > 0) return;
  }
}

std::vector<int> CandidateFinder::grow(const Surface& s, const std::vector<int>& seeds,
                                       const Limits& limits) {
  ++stamp_;
  const SurfaceField field(s);
  std::vector<int> queue;
  double agreement = 0;
  for (const int f : seeds) {
    agreement += field.gradient(graph_.facets[f].centroid).dot(graph_.facets[f].normal);
    if (group_of_[f] < 0) take(f, queue);
  }
  const double side = agreement < 0 ? -1 : 1;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const bool from_tiny = fitter_.is_tiny(queue[i]);
    for (const FacetNeighbor& n : graph_.neighbors(queue[i])) {
      if (stamp_of_[n.facet] == stamp_ || group_of_[n.facet] >= 0) continue;
      const bool may_turn = from_tiny || n.angle_rad <= steps_.growth_rad;
      if (!may_turn && !fitter_.is_tiny(n.facet)) continue;
      if (lies_on(field, n.facet, side, limits)) take(n.facet, queue);
    }
  }
  return queue;
}

/// Puts a free facet into the queue of the surface that grows.
void CandidateFinder::take(int facet, std::vector<int>& queue) {
  stamp_of_[facet] = stamp_;
  queue.push_back(facet);
  if (component_of_[facet] == component_ || foreign_stamp_of_[facet] == foreign_stamp_) return;
  foreign_stamp_of_[facet] = foreign_stamp_;
  foreign_.push_back(facet);
}

bool CandidateFinder::lies_on(const SurfaceField& s, int f, double side,
                              const Limits& limits) const {
  for (const int v : graph_.corners(f)) {
    if (std::abs(s.signed_distance(mesh_.vertices[v])) > limits.distance) return false;
  }
  if (fitter_.is_tiny(f)) return true;
  const Facet& facet = graph_.facets[f];
  if (std::abs(s.signed_distance(facet.centroid)) > limits.sagitta) return false;
  const double cosine = side * s.gradient(facet.centroid).dot(facet.normal);
  if (limits.angle_rad < kMaxSlack && cosine >= limits.least_cosine) return true;
  const double slack = 2 * graph_.normal_error_rad[f];
  return cosine >= std::cos(std::min(limits.angle_rad + slack, kMaxSlack));
}

std::optional<Candidate> CandidateFinder::judge(Surface s, std::vector<int> facets) {
  const FitQuality q = fitter_.evaluate(s, facets);
  if (s.radius > kMaxRadius * tolerance_.diagonal) return std::nullopt;
  if (distinct_normals(facets) < least_facets(s.kind)) return std::nullopt;
  const bool is_exact = q.rms_distance < 1.5 * tolerance_.eps;
  const bool is_cylinder = s.kind == SurfaceKind::Cylinder;
  if (q.sagitta > (is_cylinder ? steps_.max_cylinder_depth : steps_.max_depth)) return std::nullopt;
  const double rms = std::min(q.rms_distance, fitter_.refine_uncut(s, facets, q));
  if (steps_.only_exact && rms > 1.5 * tolerance_.eps) return std::nullopt;
  const double looseness = rms / (0.1 * q.sagitta + tolerance_.eps);
  // A resampled mesh's corners fill the depth of the facets that they lie on.
  const double slack = tolerance_.is_resampled ? kResampledSlack : 1;
  if (looseness > slack * options_.max_looseness) return std::nullopt;
  if (!normals_agree(s, facets, is_exact)) return std::nullopt;
  if (facets.size() < kFewFacets && !are_sides_of_polygon(s, facets)) return std::nullopt;
  if ((s.kind == SurfaceKind::Sphere || s.kind == SurfaceKind::Torus) && is_flat(facets)) {
    return std::nullopt;
  }
  double area = 0, largest = 0;
  for (const int f : facets) {
    area += graph_.facets[f].area;
    largest = std::max(largest, graph_.facets[f].area);
  }
  // A plane with the slivers or straddling triangles at its rim passes for a huge cylinder or cone.
  const double most = tolerance_.is_resampled ? kMostResampledShare : kMostFacetShare;
  if (largest > most * area) return std::nullopt;
  const double excess = looseness / (kHalfLooseness * slack);
  const double tightness = 0.05 + 0.95 / (1 + excess * excess);
  Candidate c{s, std::move(facets), 0, looseness};
  c.score = area * simplicity(s.kind) * tightness * (c.facets.size() < 6 ? 0.5 : 1);
  return c;
}

void CandidateFinder::simplify(Surface& surface, const std::vector<int>& facets) {
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
int CandidateFinder::distinct_normals(const std::vector<int>& facets) const {
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
bool CandidateFinder::normals_agree(const Surface& s, const std::vector<int>& facets,
                                    bool is_exact) {
  ++stamp_;
  for (const int f : facets) stamp_of_[f] = stamp_;
  const double min_area = 1e-8 * tolerance_.diagonal * tolerance_.diagonal;
  const auto counts = [&](int f) {
    return graph_.facets[f].area > min_area && !fitter_.is_tiny(f);
  };
  const SurfaceField field(s);
  std::vector<double> steps;
  double squares = 0, noise = 0;
  int count = 0;
  for (const int f : facets) {
    if (!counts(f)) continue;
    const double angle =
        unsigned_angle(field.gradient(graph_.facets[f].centroid), graph_.facets[f].normal);
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
  const double share = is_exact || tolerance_.is_resampled ? 1.3 : is_ruled(s.kind) ? 0.3 : 0.7;
  return deviation <= share * step + 0.002 + std::sqrt(noise / count);
}

bool CandidateFinder::is_flat(const std::vector<int>& facets) const {
  Mat3 moment = Mat3::Zero();
  for (const int f : facets) {
    moment += graph_.facets[f].normal * graph_.facets[f].normal.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(moment / static_cast<double>(facets.size()));
  return solver.eigenvalues()[0] < 1e-4;
}

}  // namespace hewn
