#include "core/io/picture.h"

#include <algorithm>
#include <filesystem>

#include <doctest/doctest.h>

#include "core/base/file.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

PictureOptions small_picture() {
  PictureOptions options;
  options.width = 60;
  options.height = 40;
  options.samples = 2;
  return options;
}

Tree block_tree(const Vec3& size) {
  Literal block;
  block.size = size;
  Tree tree;
  tree.root = tree.add_literal(block);
  return tree;
}

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)];
  return {p[0], p[1], p[2]};
}

/// Largest difference of the three channels: grey backgrounds have hardly any.
int colourfulness(const std::array<int, 3>& p) {
  return std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]});
}

TEST_CASE("a mesh fills the middle of its picture and leaves the corners free") {
  const Mesh box = solids::box(Vec3::Zero(), Vec3(2, 2, 2));
  const MeshQuery query(std::make_shared<const Mesh>(box));
  const std::vector<int> colours(box.triangles.size(), 3);
  const auto image = render_mesh(query, colours, box.bounds, small_picture(), {});
  REQUIRE(image);
  CHECK(image->rgb.size() == 60u * 40u * 3u);
  CHECK(colourfulness(pixel(*image, 24, 24)) > 20);
  CHECK(colourfulness(pixel(*image, 0, 0)) < 10);
  CHECK(colourfulness(pixel(*image, 59, 39)) < 10);
}

TEST_CASE("a tree and its mesh have the same outline") {
  const Mesh box = solids::box(Vec3::Zero(), Vec3(3, 2, 1));
  const MeshQuery query(std::make_shared<const Mesh>(box));
  const PictureOptions options = small_picture();
  const auto left = render_mesh(query, {}, box.bounds, options, {});
  const auto right = render_tree(block_tree(Vec3(3, 2, 1)), box.bounds, options, {});
  REQUIRE(left);
  REQUIRE(right);
  const auto background = pixel(*left, 0, 20);
  int differing = 0;
  for (int x = 0; x < 60; ++x) {
    const auto is_free = [&](const Image& image) {
      const auto p = pixel(image, x, 20);
      return std::abs(p[0] - background[0]) < 4 && std::abs(p[2] - background[2]) < 4;
    };
    differing += is_free(*left) != is_free(*right);
  }
  CHECK(differing == 0);
}

TEST_CASE("the number of threads leaves no trace in a picture") {
  const Tree tree = block_tree(Vec3(3, 2, 1));
  const Box3 scene = tree.bounds();
  RunContext one;
  one.threads = 1;
  RunContext many;
  many.threads = 8;
  const auto a = render_tree(tree, scene, small_picture(), one);
  const auto b = render_tree(tree, scene, small_picture(), many);
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a->rgb == b->rgb);
}

TEST_CASE("a cancelled picture says so") {
  RunContext run;
  run.cancel->cancel();
  const Tree tree = block_tree(Vec3(1, 1, 1));
  const auto image = render_tree(tree, tree.bounds(), small_picture(), run);
  REQUIRE(!image);
  CHECK(image.error().code == ErrorCode::Cancelled);
}

TEST_CASE("a picture without pixels is refused") {
  PictureOptions options = small_picture();
  options.width = 0;
  const Tree tree = block_tree(Vec3(1, 1, 1));
  const auto image = render_tree(tree, tree.bounds(), options, {});
  REQUIRE(!image);
  CHECK(image.error().code == ErrorCode::InvalidArgument);
}

TEST_CASE("a saved picture is a PNG of its size") {
  const auto path = std::filesystem::temp_directory_path() / "hewn_picture_test.png";
  Image image{7, 5, std::vector<std::uint8_t>(7 * 5 * 3, 128)};
  REQUIRE(save_png(image, path));
  const auto bytes = read_file(path);
  std::filesystem::remove(path);
  REQUIRE(bytes);
  REQUIRE(bytes->size() > 24);
  CHECK(bytes->substr(1, 3) == "PNG");
  CHECK(static_cast<int>((*bytes)[19]) == 7);
  CHECK(static_cast<int>((*bytes)[23]) == 5);
}

TEST_CASE("pictures side by side keep their pixels") {
  const Image left{2, 1, {1, 2, 3, 4, 5, 6}};
  const Image right{1, 1, {7, 8, 9}};
  const Image both = side_by_side(left, right);
  CHECK(both.width == 3);
  CHECK(both.rgb == std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9});
}

TEST_CASE("neighbouring colour numbers differ clearly") {
  for (int i = 0; i < 50; ++i) {
    CHECK((golden_colour(i) - golden_colour(i + 1)).norm() > 0.1);
  }
}

}  // namespace
}  // namespace hewn
