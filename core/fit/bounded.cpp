#include "core/fit/bounded.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "core/fit/bounded_parts.h"

namespace hewn {
namespace {

/// Literals closer than this share of the diagonal are the same.
constexpr double kSame = 1e-6;

using Key = std::vector<std::int64_t>;

void append_key(const Literal& literal, double unit, Key& key) {
  const auto append = [&](double value, double step) {
    key.push_back(static_cast<std::int64_t>(std::llround(value / step)));
  };
  key.push_back(static_cast<int>(literal.kind));
  for (const double c : literal.rotation.reshaped()) append(c, kSame);
  for (const double c : literal.origin) append(c, unit);
  for (const double c : literal.size) append(c, unit);
  for (const double c :
       {literal.height, literal.radius, literal.top_radius, literal.major_radius}) {
    append(c, unit);
  }
}

Key key_of(const BoundedPrimitive& primitive, double unit) {
  // A plane may be both a side of a box and separating: the kind tells nothing new.
  Key key;
  append_key(primitive.literal, unit, key);
  if (primitive.minus) append_key(*primitive.minus, unit, key);
  return key;
}

void merge_sorted(std::vector<int>& into, const std::vector<int>& more) {
  std::vector<int> all;
  std::set_union(into.begin(), into.end(), more.begin(), more.end(), std::back_inserter(all));
  into = std::move(all);
}

/// Keeps the first of equal primitives; it takes over the others' groups and halfspaces.
std::vector<BoundedPrimitive> without_duplicates(std::vector<BoundedPrimitive> all, double unit) {
  std::map<Key, std::size_t> seen;
  std::vector<BoundedPrimitive> kept;
  for (BoundedPrimitive& primitive : all) {
    const auto [found, is_new] = seen.try_emplace(key_of(primitive, unit), kept.size());
    if (is_new) {
      kept.push_back(std::move(primitive));
    } else {
      merge_sorted(kept[found->second].groups, primitive.groups);
      merge_sorted(kept[found->second].halfspaces, primitive.halfspaces);
    }
  }
  return kept;
}

}  // namespace

template <>
std::span<const OptionField<BoundedOptions>> option_table<BoundedOptions>() {
  using O = BoundedOptions;
  static constexpr OptionField<O> kTable[] = {
      {"bounded-snap", &O::snap, 1e-8, 1e-2,
       "Distance, as a share of the diagonal, within which a solid ends at a plane."},
      {"cuboid-sides", &O::min_sides, 2, 6, "Sides of a cuboid that lie on planes of the part."},
      {"extra-planes", &O::extra_planes, 0, 1,
       "Whether sides of bounding boxes and separating planes are added."},
      {"fillets", &O::fillets, 0, 1, "Whether compounds of a plane minus a round solid are added."},
  };
  return kTable;
}

double BoundedPrimitive::signed_distance(const Vec3& x) const {
  const double distance = literal.signed_distance(x);
  return minus ? std::max(distance, -minus->signed_distance(x)) : distance;
}

Result<std::vector<BoundedPrimitive>> build_bounded_primitives(const Mesh& mesh,
                                                               const Segmentation& segmentation,
                                                               const SurfaceSet& surfaces,
                                                               const BoundedOptions& options,
                                                               const RunContext& run) {
  const double diagonal = mesh.diagonal();
  const BoundedInput input{mesh, segmentation, surfaces, options.snap * diagonal,
                           options.min_sides};
  std::vector<BoundedPrimitive> all;
  run.report("bounded primitives", 0);
  add_round_solids(input, all);
  add_cuboids(input, run, all);
  if (run.is_cancelled()) return RunContext::cancelled();
  if (options.fillets) add_fillets(input, all);
  if (run.is_cancelled()) return RunContext::cancelled();
  if (options.extra_planes) add_extra_planes(input, all);
  if (run.is_cancelled()) return RunContext::cancelled();
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(a.kind, a.groups.front()) < std::pair(b.kind, b.groups.front());
  });
  run.report("bounded primitives", 1);
  return without_duplicates(std::move(all), kSame * diagonal);
}

const char* name_of(BoundedKind kind) {
  switch (kind) {
    case BoundedKind::Cylinder:
      return "cylinder";
    case BoundedKind::Cone:
      return "cone";
    case BoundedKind::Sphere:
      return "sphere";
    case BoundedKind::Torus:
      return "torus";
    case BoundedKind::Cuboid:
      return "cuboid";
    case BoundedKind::Fillet:
      return "fillet";
    case BoundedKind::ExtraPlane:
      return "extra plane";
    case BoundedKind::SeparatingPlane:
      return "separating plane";
  }
  return "primitive";
}

}  // namespace hewn
