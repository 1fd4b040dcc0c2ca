#pragma once
/// Points and vectors as JSON.
#include <nlohmann/json.hpp>

#include "core/base/math.h"

namespace hewn {

/// [x, y, z]
template <class Json = nlohmann::json>
Json point_json(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

}  // namespace hewn
