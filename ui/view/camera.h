#pragma once
/// A turntable camera with z upwards. Scene coordinates: model coordinates less the scene's origin.
#include <glm/glm.hpp>

#include "core/base/math.h"

namespace hewn {

struct ViewRay {
  Vec3 origin, direction;  ///< scene coordinates; the direction is unit
};

enum class StandardView { Front, Back, Left, Right, Top, Bottom, Oblique };

class Camera {
 public:
  /// Shows a sphere about `center`.
  void fit(const Vec3& center, double radius);
  void look(StandardView view);
  /// Turns by a drag of so many pixels.
  void orbit(double dx, double dy);
  /// Moves with the cursor, in the plane through the target. `height`: of the view in pixels.
  void pan(double dx, double dy, double height);
  /// `steps` > 0 comes nearer; the point under (x, y) stays there. Coordinates as for `ray`.
  void zoom(double steps, double x, double y, double aspect);

  /// Through (x, y) in [-1, 1], y upwards.
  ViewRay ray(double x, double y, double aspect) const;
  /// Where a point appears, same coordinates; z: its depth along the view.
  Vec3 project(const Vec3& p, double aspect) const;
  glm::mat4 view() const;
  glm::mat4 projection(double aspect) const;
  Vec3 back() const;   ///< unit, from the part to the camera
  Vec3 right() const;  ///< unit
  Vec3 up() const;     ///< unit
  /// Model units per pixel at the target.
  double unit_per_pixel(double height) const;

  bool is_perspective = true;
  Vec3 target = Vec3::Zero();
  double distance = 3;  ///< of the eye from the target
  double radius = 1;    ///< of what must stay within the depth range
  double yaw_rad = -1.0, pitch_rad = 0.5;

 private:
  Vec3 eye() const { return target + back() * distance; }
};

}  // namespace hewn
