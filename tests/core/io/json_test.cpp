#include "core/io/json.h"

#include <doctest/doctest.h>

#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

Error error_of(std::string_view text) {
  const Result<Tree> result = tree_from_json(text, "part.json");
  REQUIRE_FALSE(result);
  CHECK(result.error().code == ErrorCode::Format);
  return result.error();
}

std::string with_root(const std::string& root) {
  return R"({"format": "hewn-tree", "version": 1, "root": )" + root + "}";
}

TEST_CASE("random trees come back with the same bits") {
  Rng rng(71);
  for (int i = 0; i < 100; ++i) {
    Tree tree = testing::random_tree(rng, {.has_complements = true, .has_names = true});
    tree.literals[0].facets = {30, rng.uniform(), 12, rng.uniform()};
    const std::string text = tree_to_json(tree);
    const Result<Tree> back = tree_from_json(text, "memory");
    REQUIRE(back);
    CHECK(tree_to_json(*back) == text);
    CHECK(tree_size(*back) == tree_size(tree));
    for (int k = 0; k < 20; ++k) {
      const Vec3 x = testing::random_point(rng, 2);
      CHECK(back->signed_distance(x) == tree.signed_distance(x));
    }
  }
}

TEST_CASE("the empty tree comes back empty") {
  const Result<Tree> back = tree_from_json(tree_to_json(Tree{}), "memory");
  REQUIRE(back);
  CHECK(back->is_empty());
}

TEST_CASE("a fault is named with its place") {
  const std::string sphere = R"({"op": "sphere", "rotation": [1,0,0,0,1,0,0,0,1],
                                 "origin": [0,0,0], "radius": )";
  CHECK(error_of(with_root(sphere + "\"big\"}")).where == "part.json: /root/radius");
  CHECK(error_of(with_root(sphere + "-1}")).message.find("negative") != std::string::npos);
  CHECK(error_of(with_root(sphere + "null}")).message.find("finite") != std::string::npos);
  const Error nested =
      error_of(with_root(R"({"op": "union", "children": [)" + sphere + R"(1}, {"op": "blob"}]})"));
  CHECK(nested.where == "part.json: /root/children/1/op");
  CHECK(nested.message.find("unknown op \"blob\"") != std::string::npos);
  CHECK(error_of(with_root(R"({"op": "union"})")).message.find("\"children\" is missing") !=
        std::string::npos);
  CHECK(error_of(with_root("[]")).where == "part.json: /root");
  CHECK(error_of(R"({"format": "hewn-tree", "version": 99, "root": null})").where ==
        "part.json: /version");
  CHECK(error_of(R"({"format": "other"})").message.find("not a tree") != std::string::npos);
  const Error skewed = error_of(with_root(
      R"({"op": "sphere", "rotation": [1,1,0,0,1,0,0,0,1], "origin": [0,0,0], "radius": 1})"));
  CHECK(skewed.where == "part.json: /root/rotation");
}

TEST_CASE("a polyhedron's triangles must name vertices that exist") {
  const std::string text = with_root(
      R"({"op": "polyhedron", "rotation": [1,0,0,0,1,0,0,0,1], "origin": [0,0,0],
          "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,3]]})");
  CHECK(error_of(text).where == "part.json: /root/triangles/0/2");
}

TEST_CASE("text that is cut off anywhere gives a message") {
  Rng rng(72);
  const std::string text = tree_to_json(testing::random_tree(rng, {}));
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    CHECK(error_of(std::string_view(text).substr(0, length)).message.size() > 10);
  }
}

TEST_CASE("damaged bytes give a tree or a message, and trees can be written again") {
  Rng rng(73);
  const std::string text = tree_to_json(testing::random_tree(rng, {.has_complements = true}));
  int messages = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = text;
    const std::size_t at = rng.below(damaged.size());
    damaged[at] = static_cast<char>(rng.below(256));
    const Result<Tree> result = tree_from_json(damaged, "memory");
    if (result) {
      CHECK(tree_from_json(tree_to_json(*result), "memory").has_value());
    } else {
      CHECK(result.error().code == ErrorCode::Format);
      ++messages;
    }
  }
  CHECK(messages > 100);
}

TEST_CASE("nesting without end is refused") {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += R"({"op":"union","children":[)";
  CHECK(error_of(with_root(deep)).message.find("not valid JSON") != std::string::npos);
  std::string closed = deep;
  for (int i = 0; i < 100000; ++i) closed += "]}";
  CHECK(error_of(with_root(closed)).message.find("nested deeper") != std::string::npos);
}

TEST_CASE("a number that is not finite is not written") {
  Tree tree;
  Literal s;
  s.origin.x() = kInfinity;
  tree.root = tree.add_literal(s);
  const auto result = write_tree_json(tree, "/tmp/never.json");
  REQUIRE_FALSE(result);
  CHECK(result.error().message.find("literal 0 (cube)") != std::string::npos);
  CHECK(read_tree_json("/no/such/file.json").error().code == ErrorCode::FileNotFound);
}

}  // namespace
}  // namespace hewn
