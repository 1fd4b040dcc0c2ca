#include "core/synth/evolve/evolve_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/sampling.h"
#include "core/sample/sample_table.h"
#include "core/synth/evolve/surface_evolution.h"
#include "core/synth/verify.h"

namespace hewn {
namespace {

constexpr std::uint64_t kSampleStream = 0x600000;
constexpr std::uint64_t kAgreementStream = 0x620000;
constexpr int kAgreementPoints = 10'000;
constexpr std::size_t kMostPrimitives = 2000;  ///< more are hopeless

std::vector<BoundedPrimitive> primitives_of(std::vector<BoundedPrimitive> all,
                                            const Labeller& label) {
  std::erase_if(all, [&](const BoundedPrimitive& p) {
    return std::none_of(p.groups.begin(), p.groups.end(),
                        [&](int g) { return label.owns_group(g); });
  });
  return all;
}

/// Points by area, moved onto the surfaces that were fitted to their groups.
std::vector<SurfaceSample> sample_surface(const TreeProblem& problem, const Labeller& label,
                                          int count, Rng rng) {
  const Mesh& mesh = problem.query->mesh();
  std::vector<int> triangles;
  std::vector<int> group_of(mesh.triangles.size(), -1);
  const auto& groups = problem.segmentation->groups;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!label.owns_group(static_cast<int>(g))) continue;
    for (const int t : groups[g].triangles) {
      group_of[static_cast<std::size_t>(t)] = static_cast<int>(g);
      triangles.push_back(t);
    }
  }
  const SurfaceSampler sampler(mesh, std::move(triangles));
  if (sampler.is_empty()) return {};
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < count; ++i) {
    const SurfacePoint drawn = sampler.draw(rng);
    SurfaceSample s{drawn.position, drawn.normal};
    const int group = group_of[static_cast<std::size_t>(drawn.triangle)];
    const int h = problem.surfaces->halfspace_of_group[static_cast<std::size_t>(group)];
    if (h >= 0) {
      const Surface& surface = problem.surfaces->halfspaces[static_cast<std::size_t>(h)].surface;
      s.position -= surface.gradient(s.position) * surface.signed_distance(s.position);
      const Vec3 normal = surface.gradient(s.position);
      s.normal = normal.dot(s.normal) < 0 ? Vec3(-normal) : normal;
    }
    if (problem.is_subtracted) s.normal = -s.normal;
    samples.push_back(s);
  }
  return samples;
}

int add_primitive(const BoundedPrimitive& p, Tree& tree) {
  const int node = tree.add_literal(p.literal);
  return p.minus ? tree.add_node(Op::Difference, {node, tree.add_literal(*p.minus)}) : node;
}

Tree tree_of(const Genome& genome, const std::vector<BoundedPrimitive>& primitives) {
  Tree tree;
  std::vector<int> stack;
  for (const Token token : genome) {
    if (token >= 0) {
      stack.push_back(add_primitive(primitives[static_cast<std::size_t>(token)], tree));
      continue;
    }
    const int right = stack.back();
    stack.pop_back();
    stack.back() = tree.add_node(op_of(token), {stack.back(), right});
  }
  tree.root = stack.back();
  return flattened(tree);
}

double agreement_of(const TreeProblem& problem, const Labeller& label, const Tree& tree,
                    const RunContext& run) {
  std::vector<int> triangles;
  for (const int g : problem.groups) {
    const auto& own = problem.segmentation->groups[static_cast<std::size_t>(g)].triangles;
    triangles.insert(triangles.end(), own.begin(), own.end());
  }
  SampleSpace space;
  space.label = &label;
  space.segmentation = problem.segmentation;
  space.halfspaces = &problem.surfaces->halfspaces;
  space.frame = find_frame(problem.query->mesh(), triangles, *problem.surfaces);
  space.diagonal = problem.query->mesh().diagonal();
  return measure_agreement(
      space, [&tree](const Vec3& p) { return tree.contains(p); }, kAgreementPoints,
      kAgreementStream, run);
}

constexpr OptionField<EvolveOptions> kOptions[] = {
    {"samples", &EvolveOptions::samples, 100, 1'000'000, "points of the surface"},
    {"population", &EvolveOptions::population, 2, 100'000, "trees of a generation"},
    {"mutation", &EvolveOptions::mutation, 0, 1, "share of the trees that are changed at random"},
    {"crossover", &EvolveOptions::crossover, 0, 1, "share of the trees with two parents"},
    {"tournament", &EvolveOptions::tournament, 1, 100, "trees of which the best is a parent"},
    {"elite", &EvolveOptions::elite, 0, 1000, "trees that pass on unchanged"},
    {"iterations", &EvolveOptions::iterations, 0, 1'000'000, "generations at most"},
    {"most-idle", &EvolveOptions::most_idle, 1, 1'000'000, "generations without a better tree"},
    {"enough", &EvolveOptions::enough, 0, 1, "score of a surface at which the search ends"},
    {"distance", &EvolveOptions::distance, 1e-6, 0.1,
     "share of the diagonal at which a point counts for 1 / e"},
    {"angle", &EvolveOptions::angle_deg, 0.1, 90, "degrees at which a normal counts for 1 / e"},
    {"size-penalty", &EvolveOptions::size_penalty, 0, 1000,
     "what a node costs, in units of log(samples) / (2 samples)"},
};

}  // namespace

template <>
std::span<const OptionField<EvolveOptions>> option_table<EvolveOptions>() {
  return kOptions;
}

Result<TreeAnswer> evolve_tree(const TreeProblem& problem, const EvolveOptions& options,
                               const RunContext& run) {
  auto built = build_bounded_primitives(problem.query->mesh(), *problem.segmentation,
                                        *problem.surfaces, {}, run);
  if (!built) return built.error();
  Labeller label(*problem.query, *problem.segmentation, problem.groups, problem.is_subtracted);
  label.ignore(problem.ignored);
  const std::vector<BoundedPrimitive> primitives = primitives_of(std::move(*built), label);
  if (primitives.empty() || primitives.size() > kMostPrimitives) {
    return Error{ErrorCode::NotFound,
                 primitives.empty() ? "no bounded primitive fits the face groups; search with list"
                                    : "too many primitives to evolve; search with list"};
  }
  const std::vector<SurfaceSample> samples =
      sample_surface(problem, label, options.samples, Rng(run.seed, kSampleStream));
  const double degree = kPi / 180;
  const SurfaceReach reach{options.distance * problem.query->mesh().diagonal(),
                           options.angle_deg * degree};
  SurfaceFitness fitness(primitives, samples, reach, run);
  Result<Evolved> evolved = evolve_on_surface(fitness, options, run);
  if (!evolved) return evolved.error();
  TreeAnswer answer;
  answer.tree = tree_of(evolved->best, primitives);
  answer.halfspaces = static_cast<int>(problem.surfaces->halfspaces.size());
  answer.evaluations = evolved->evaluations;
  answer.agreement = agreement_of(problem, label, answer.tree, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return answer;
}

}  // namespace hewn
