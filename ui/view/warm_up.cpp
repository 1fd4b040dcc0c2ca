#include "ui/view/warm_up.h"

namespace hewn {
namespace {

DisplayMesh triangle() {
  DisplayMesh mesh;
  mesh.corners = {
      {{-1, -1, 0}, {0, 0, 1}, 0, 0}, {{1, -1, 0}, {0, 0, 1}, 0, 0}, {{0, 1, 0}, {0, 0, 1}, 0, 0}};
  mesh.indices = {0, 1, 2};
  mesh.lines = {{{-1, -1, 0}, {0, 0}}, {{1, -1, 0}, {0, 0}}};
  mesh.labels = 1;
  return mesh;
}

}  // namespace

void warm_up(RenderEngine& engine, int width, int height) {
  const DisplayMesh mesh = triangle();
  engine.show_mesh(MeshSlot::Input, &mesh);
  const LabelState plain;
  engine.set_states(MeshSlot::Input, {&plain, 1});
  Scene scene;
  scene.items = {{MeshSlot::Input}};
  for (const int samples : {1, 4}) engine.draw(scene, width, height, samples);
  IdImage ids;
  engine.read_ids(scene, width, height, ids);
  engine.show_mesh(MeshSlot::Input, nullptr);
}

}  // namespace hewn
