#pragma once
/// Makes a driver ready before anybody waits for a picture.
#include "ui/view/scene.h"

namespace hewn {

/// Draws an input, roughly and finely: drivers compile a shader and fetch a picture's memory when
/// they first draw, which takes a tenth of a second without a graphics card. Leaves no mesh behind.
void warm_up(RenderEngine& engine, int width, int height);

}  // namespace hewn
