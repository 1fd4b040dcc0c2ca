#include "core/mesh/query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>

#include "core/compute/compute.h"
#include "core/compute/parallel.h"
#include "core/compute/winding.h"
#include "core/mesh/closest_on_triangle.h"
#include "core/mesh/edge_use.h"

namespace hewn {
namespace {

// All lengths below are in units of the mesh's diagonal: the scene is centred and scaled by it.

/// Single precision moves a crossing by less than this; a ray that passes an edge more closely, or
/// a facet more flatly, is not trusted alone.
constexpr double kEdgeMargin = 2e-6;
/// Points that a thread takes at a time.
constexpr std::size_t kGrain = 512;
/// So many points pay for the search tree that an accelerator needs, which one core builds.
constexpr std::size_t kPointsPerTriangle = 8;
/// Rays start this far behind the asked point, outside the mesh: over a whole line entries and
/// exits must balance, which shows when a ray slipped through at a vertex or hit an edge twice.
constexpr double kBackStep = 1.01;
/// Crossings this close to the point are placed again in double precision, so that a point 1e-4 (or
/// 1e-6) off the surface falls on its right side.
constexpr double kNearPoint = 1e-3;

/// Directions with no small-integer ratio between their components, so that rays from a point of a
/// CAD part seldom run along its faces and edges. The first ones spread over the sphere.
constexpr std::array<std::array<double, 3>, 11> kDirections = {{
    {0.5773991, 0.3317541, 0.7460673},
    {-0.8412231, 0.4290817, 0.3289713},
    {0.2137781, -0.9347719, 0.2839871},
    {-0.3391747, -0.5137113, -0.7881157},
    {0.7419311, 0.1233719, -0.6590171},
    {-0.1439923, 0.9013357, -0.4085113},
    {0.8811973, -0.4531339, 0.1343171},
    {-0.6113279, -0.2391151, 0.7543919},
    {0.1377713, 0.6619147, 0.7368319},
    {0.4361111, -0.5871133, -0.6819937},
    {-0.9411977, 0.2113531, -0.2639813},
}};

/// What one ray has crossed so far; the filter adds to it and rejects every hit, so that a single
/// traversal sees them all.
struct CrossingContext {
  RTCIntersectContext embree;  ///< first, so that the filter can cast back
  const std::vector<Vec3>* vertices = nullptr;
  const std::vector<Triangle>* triangles = nullptr;
  const float* edge_margins = nullptr;
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::Zero();
  int winding = 0;        ///< exits less entries ahead of the point
  int balance = 0;        ///< the same over the whole line
  int crossings = 0;      ///< ahead
  int all_crossings = 0;  ///< over the whole line
  bool is_clean = true;   ///< no crossing ahead is near an edge or grazing
};

/// Along the ray from `origin`, in double precision.
double plane_parameter(const CrossingContext& c, unsigned triangle) {
  const auto& [i, j, k] = (*c.triangles)[triangle];
  const Vec3& a = (*c.vertices)[i];
  const Vec3 normal = ((*c.vertices)[j] - a).cross((*c.vertices)[k] - a);
  const double slope = normal.dot(c.direction);
  return slope == 0 ? 0 : normal.dot(a - c.origin) / slope;
}

void count_crossing(const RTCFilterFunctionNArguments* args) {
  if (args->N != 1 || args->valid[0] != -1) return;
  args->valid[0] = 0;
  auto* context = reinterpret_cast<CrossingContext*>(args->context);
  const unsigned triangle = RTCHitN_primID(args->hit, 1, 0);
  const float u = RTCHitN_u(args->hit, 1, 0);
  const float v = RTCHitN_v(args->hit, 1, 0);
  const Vec3 normal(RTCHitN_Ng_x(args->hit, 1, 0), RTCHitN_Ng_y(args->hit, 1, 0),
                    RTCHitN_Ng_z(args->hit, 1, 0));
  const double slope = normal.dot(context->direction);
  const int sign = slope > 0 ? 1 : -1;
  context->balance += sign;
  ++context->all_crossings;
  double t = double{RTCRayN_tfar(args->ray, 1, 0)} - kBackStep;
  if (std::abs(t) < kNearPoint) t = plane_parameter(*context, triangle);
  if (t <= 0) return;
  if (std::min({u, v, 1 - u - v}) < context->edge_margins[triangle] ||
      slope * slope < 1e-6 * normal.squaredNorm()) {
    context->is_clean = false;
  }
  context->winding += sign;
  ++context->crossings;
}

/// The share of a triangle's barycentric range that lies within `kEdgeMargin` of its edges.
float edge_margin(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double twice_area = (b - a).cross(c - a).norm();
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  if (!(twice_area > 0)) return 1;
  return static_cast<float>(std::min(1.0, kEdgeMargin * longest / twice_area));
}

struct SegmentContext {
  RTCIntersectContext embree;  ///< first, so that the filter can cast back
  std::vector<int>* triangles = nullptr;
};

void collect_crossed(const RTCFilterFunctionNArguments* args) {
  if (args->N != 1 || args->valid[0] != -1) return;
  args->valid[0] = 0;
  auto* context = reinterpret_cast<SegmentContext*>(args->context);
  context->triangles->push_back(static_cast<int>(RTCHitN_primID(args->hit, 1, 0)));
}

struct ClosestState {
  const std::vector<Vec3>* vertices;
  const std::vector<Triangle>* triangles;
  Vec3 query;
  double slack;
  Vec3 point = Vec3::Zero();
  double distance2 = kInfinity;
  int triangle = -1;
};

bool visit_triangle(RTCPointQueryFunctionArguments* args) {
  auto* state = static_cast<ClosestState*>(args->userPtr);
  const int t = static_cast<int>(args->primID);
  const auto& [a, b, c] = (*state->triangles)[t];
  const auto& v = *state->vertices;
  const Vec3 point = closest_on_triangle(state->query, v[a], v[b], v[c]);
  const double distance2 = (point - state->query).squaredNorm();
  // The lower index wins a tie, so that the order of traversal does not show.
  const bool is_better =
      distance2 < state->distance2 || (distance2 == state->distance2 && t < state->triangle);
  if (!is_better) return false;
  state->point = point;
  state->distance2 = distance2;
  state->triangle = t;
  // Boxes are culled in single precision: the slack keeps every candidate for the nearest.
  const auto radius = static_cast<float>(std::sqrt(distance2) * (1 + 1e-6) + state->slack);
  if (!(radius < args->query->radius)) return false;
  args->query->radius = radius;
  return true;
}

}  // namespace

struct MeshQuery::Scene {
  std::shared_ptr<const Mesh> mesh;
  Vec3 center = Vec3::Zero();
  double scale = 1;            ///< model units per scene unit
  std::vector<Vec3> vertices;  ///< scene units, double
  std::vector<float> margins;  ///< per triangle, barycentric
  EdgeUse edge_use;
  std::once_flag winding_begun;
  std::unique_ptr<const WindingTree> winding;  ///< for accelerators
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Scene(std::shared_ptr<const Mesh> source);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void attach_triangles();
  Vec3 to_scene(const Vec3& p) const { return (p - center) / scale; }

  /// Leaves all unsure on the processor, where Embree needs no second search tree.
  Result<void> find_inside(Device& chosen, std::span<const Vec3> points, std::span<Inside> out,
                           const RunContext& run) {
    if (!chosen.info().is_accelerator) {
      std::fill(out.begin(), out.end(), Inside::Unsure);
      return {};
    }
    std::call_once(winding_begun, [this] {
      winding =
          std::make_unique<WindingTree>(mesh->vertices, mesh->triangles, edge_use.is_oriented);
    });
    return winding->find_inside(chosen, points, out, run);
  }

  struct Vote {
    bool is_inside = false;
    bool is_clean = false;
  };
  Vote cross(const Vec3& origin, const std::array<double, 3>& direction) const;
};

MeshQuery::Scene::Scene(std::shared_ptr<const Mesh> source) : mesh(std::move(source)) {
  if (!mesh->bounds.is_empty()) center = mesh->bounds.center();
  if (mesh->diagonal() > 0) scale = mesh->diagonal();
  vertices.reserve(mesh->vertices.size());
  for (const Vec3& p : mesh->vertices) vertices.push_back(to_scene(p));
  margins.reserve(mesh->triangles.size());
  for (const auto& [a, b, c] : mesh->triangles) {
    margins.push_back(edge_margin(vertices[a], vertices[b], vertices[c]));
  }
  edge_use = classify_edge_use(mesh->triangles);
  device = rtcNewDevice("set_affinity=0");
  if (device == nullptr) throw std::runtime_error("Embree: no device could be created");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                     RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  // Medium quality: the high one splits triangles and would report one crossing twice.
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  attach_triangles();
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree: the search tree could not be built (out of memory?)");
  }
}

void MeshQuery::Scene::attach_triangles() {
  if (mesh->triangles.empty()) return;
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  for (const Vec3& p : vertices) {
    for (int k = 0; k < 3; ++k) *points++ = static_cast<float>(p[k]);
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh->triangles.size()));
  for (const Triangle& t : mesh->triangles) {
    for (const int i : t) *indices++ = static_cast<unsigned>(i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

namespace {

RTCRayHit make_ray(const Vec3& origin, const Vec3& direction) {
  RTCRayHit ray = {};
  ray.ray.org_x = static_cast<float>(origin.x());
  ray.ray.org_y = static_cast<float>(origin.y());
  ray.ray.org_z = static_cast<float>(origin.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = 0xFFFFFFFFu;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace

MeshQuery::Scene::Vote MeshQuery::Scene::cross(const Vec3& origin,
                                               const std::array<double, 3>& direction) const {
  CrossingContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = count_crossing;
  context.vertices = &vertices;
  context.triangles = &mesh->triangles;
  context.edge_margins = margins.data();
  context.origin = origin;
  context.direction = Vec3(direction[0], direction[1], direction[2]).normalized();
  RTCRayHit ray = make_ray(origin - kBackStep * context.direction, context.direction);
  rtcIntersect1(scene, &context.embree, &ray);
  // The winding number is right for overlapping solids too; parity needs no orientation.
  const bool is_inside = edge_use.is_oriented ? context.winding > 0 : context.crossings % 2 != 0;
  const bool is_balanced =
      edge_use.is_oriented ? context.balance == 0 : context.all_crossings % 2 == 0;
  return {is_inside, context.is_clean && is_balanced};
}

MeshQuery::MeshQuery(std::shared_ptr<const Mesh> mesh)
    : scene_(std::make_unique<Scene>(std::move(mesh))) {}
MeshQuery::~MeshQuery() = default;
MeshQuery::MeshQuery(MeshQuery&&) noexcept = default;
MeshQuery& MeshQuery::operator=(MeshQuery&&) noexcept = default;

bool MeshQuery::contains(const Vec3& p) const {
  if (!scene_->mesh->bounds.contains(p)) return false;
  const Vec3 origin = scene_->to_scene(p);
  int inside_votes = 0;
  for (const auto& direction : kDirections) {
    const Scene::Vote vote = scene_->cross(origin, direction);
    if (vote.is_clean && scene_->edge_use.is_closed) return vote.is_inside;
    inside_votes += vote.is_inside ? 1 : 0;
  }
  return 2 * inside_votes > static_cast<int>(kDirections.size());
}

std::vector<char> MeshQuery::contains(std::span<const Vec3> points, const RunContext& run) const {
  std::vector<char> is_inside(points.size(), 0);
  std::vector<Inside> found(points.size(), Inside::Unsure);
  // Rays through holes must vote.
  if (scene_->edge_use.is_closed &&
      points.size() >= kPointsPerTriangle * scene_->mesh->triangles.size()) {
    // Should a device fail, all is left to the loop below, as it is on the processor.
    static_cast<void>(compute_of(run)->run(
        WindingTree::seconds_for(points.size()), run,
        [&](Device& device) { return scene_->find_inside(device, points, found, run); }));
  }
  for_each_chunk(run.threads, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (run.is_cancelled()) return;
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_sure = found[i] != Inside::Unsure;
      is_inside[i] = (is_sure ? found[i] == Inside::Yes : contains(points[i])) ? 1 : 0;
    }
  });
  return is_inside;
}

ClosestPoint MeshQuery::closest(const Vec3& p) const {
  ClosestState state{&scene_->vertices, &scene_->mesh->triangles, scene_->to_scene(p), 0};
  state.slack = 4e-7 * (1 + state.query.norm());
  RTCPointQuery query = {};
  query.x = static_cast<float>(state.query.x());
  query.y = static_cast<float>(state.query.y());
  query.z = static_cast<float>(state.query.z());
  query.radius = std::numeric_limits<float>::infinity();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->scene, &query, &context, visit_triangle, &state);
  if (state.triangle < 0) return {};
  return {state.point * scene_->scale + scene_->center, state.triangle,
          std::sqrt(state.distance2) * scene_->scale};
}

RayHit MeshQuery::cast(const Vec3& origin, const Vec3& direction) const {
  const double length = direction.norm();
  if (!(length > 0)) return {};
  CrossingContext context;
  rtcInitIntersectContext(&context.embree);
  context.vertices = &scene_->vertices;
  context.triangles = &scene_->mesh->triangles;
  context.origin = scene_->to_scene(origin);
  context.direction = direction / length;
  RTCRayHit ray = make_ray(context.origin, context.direction);
  rtcIntersect1(scene_->scene, &context.embree, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const double t = std::max(0.0, plane_parameter(context, ray.hit.primID));
  return {t * scene_->scale / length, static_cast<int>(ray.hit.primID)};
}

void MeshQuery::crossed_by(const Vec3& a, const Vec3& b, std::vector<int>& triangles) const {
  const Vec3 from = scene_->to_scene(a);
  const Vec3 step = scene_->to_scene(b) - from;
  if (!(step.norm() > 0)) return;
  SegmentContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = collect_crossed;
  context.triangles = &triangles;
  RTCRayHit ray = make_ray(from, step.normalized());
  ray.ray.tfar = static_cast<float>(step.norm());
  rtcIntersect1(scene_->scene, &context.embree, &ray);
}

double MeshQuery::signed_distance(const Vec3& p) const {
  const double distance = closest(p).distance;
  return contains(p) ? -distance : distance;
}

const Mesh& MeshQuery::mesh() const { return *scene_->mesh; }

}  // namespace hewn
