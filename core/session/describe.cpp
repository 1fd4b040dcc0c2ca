#include "core/session/describe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hewn {
namespace {

bool are_coaxial(const PreparedMesh& prepared, const std::vector<int>& groups) {
  const auto& all = prepared.segmentation.groups;
  const Surface& first = all[groups.front()].surface;
  const double reach = 1e-4 * prepared.mesh->diagonal();
  return std::all_of(groups.begin(), groups.end(), [&](int g) {
    const Surface& s = all[g].surface;
    const bool has_line = s.kind != SurfaceKind::Plane && s.kind != SurfaceKind::Sphere;
    return has_line && s.axis.cross(first.axis).norm() < 1e-3 &&
           (s.point - first.point).cross(first.axis).norm() < reach;
  });
}

std::string radius_text(const std::vector<double>& radii) {
  const auto [lo, hi] = std::minmax_element(radii.begin(), radii.end());
  if (*hi - *lo <= 1e-4 * *hi) return fmt::format("r {}", short_number(*lo));
  return fmt::format("r {} to {}", short_number(*lo), short_number(*hi));
}

}  // namespace

std::string short_number(double value) {
  const double size = std::abs(value);
  if (size > 0 && (size < 1e-4 || size >= 1e6)) return fmt::format("{:.3e}", value);
  const int before = size < 1 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
  const int leading =
      size > 0 && size < 1 ? static_cast<int>(-std::floor(std::log10(size))) - 1 : 0;
  std::string text = fmt::format("{:.{}f}", value, std::max(0, 4 - before + leading + (size < 1)));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string describe_group(const FaceGroup& group) {
  if (!group.is_fitted) return "free form";
  const Surface& s = group.surface;
  switch (s.kind) {
    case SurfaceKind::Plane:
      return "plane";
    case SurfaceKind::Sphere:
      return fmt::format("sphere r {}", short_number(s.radius));
    case SurfaceKind::Cylinder:
      return fmt::format("cylinder r {}", short_number(s.radius));
    case SurfaceKind::Cone:
      return fmt::format("cone {}\u00b0", short_number(s.half_angle_rad * 180 / kPi));
    case SurfaceKind::Torus:
      break;
  }
  return fmt::format("torus {} / {}", short_number(s.major_radius), short_number(s.radius));
}

std::string describe_selection(const PreparedMesh& prepared, const std::vector<int>& groups) {
  if (groups.empty()) return "nothing selected";
  const auto& all = prepared.segmentation.groups;
  const FaceGroup& first = all[groups.front()];
  double area = 0;
  bool is_one_kind = true;
  std::vector<double> radii;
  for (const int g : groups) {
    area += all[g].area;
    is_one_kind &= all[g].is_fitted && all[g].surface.kind == first.surface.kind;
    radii.push_back(all[g].surface.radius);
  }
  const double share = 100 * area / std::max(prepared.mesh->total_area, 1e-300);
  std::string text;
  if (groups.size() == 1) {
    text = describe_group(first);
  } else if (!is_one_kind) {
    text = fmt::format("{} groups", groups.size());
  } else {
    text = fmt::format("{} {}s", groups.size(), name_of(first.surface.kind));
    const SurfaceKind kind = first.surface.kind;
    if (kind == SurfaceKind::Cylinder || kind == SurfaceKind::Sphere) {
      text += ", " + radius_text(radii);
    }
    if (are_coaxial(prepared, groups)) text += ", coaxial";
  }
  return text + fmt::format(", {} % of the area", short_number(std::round(share * 10) / 10));
}

std::string describe_literal(const Literal& literal) {
  switch (literal.kind) {
    case SolidKind::Box:
      return fmt::format("box {} x {} x {}", short_number(literal.size.x()),
                         short_number(literal.size.y()), short_number(literal.size.z()));
    case SolidKind::Cylinder:
      if (literal.radius != literal.top_radius) {
        return fmt::format("cone r {} to {}, h {}", short_number(literal.radius),
                           short_number(literal.top_radius), short_number(literal.height));
      }
      return fmt::format("cylinder r {}, h {}", short_number(literal.radius),
                         short_number(literal.height));
    case SolidKind::Prism:
      return fmt::format("prism of {} sides, r {}, h {}", literal.sides,
                         short_number(literal.radius), short_number(literal.height));
    case SolidKind::Sphere:
      return fmt::format("sphere r {}", short_number(literal.radius));
    case SolidKind::Torus:
      return fmt::format("torus {} / {}", short_number(literal.major_radius),
                         short_number(literal.radius));
    case SolidKind::Polyhedron:
      break;
  }
  return fmt::format("polyhedron, {} triangles",
                     literal.polyhedron ? literal.polyhedron->triangles.size() : 0);
}

}  // namespace hewn
