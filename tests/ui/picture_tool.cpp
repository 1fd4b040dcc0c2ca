/// What the scripts that drive the window need beside it: fine meshes, and pictures compared with
/// references. Prints one line; ends with 1 when pictures differ, 2 when it cannot tell.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <png.h>

#include "core/io/picture.h"
#include "core/mesh/load.h"

namespace hewn {
namespace {

int fail(const std::string& why) {
  std::fprintf(stderr, "picture_tool: %s\n", why.c_str());
  return 2;
}

bool read_png(const std::string& path, Image& out) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str())) return false;
  png.format = PNG_FORMAT_RGB;
  out.width = static_cast<int>(png.width);
  out.height = static_cast<int>(png.height);
  out.rgb.resize(PNG_IMAGE_SIZE(png));
  return png_image_finish_read(&png, nullptr, out.rgb.data(), 0, nullptr) != 0;
}

/// Averages over whole blocks of pixels: what glyphs look like in detail does not matter.
Image shrunk_by(const Image& in, int by) {
  Image out{in.width / by, in.height / by, {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::array<int, 3> sum{};
      for (int k = 0; k < by * by; ++k) {
        const int row = y * by + k / by;
        const int column = x * by + k % by;
        for (int c = 0; c < 3; ++c) sum[c] += in.rgb[3 * (row * in.width + column) + c];
      }
      for (const int s : sum) out.rgb.push_back(static_cast<std::uint8_t>(s / (by * by)));
    }
  }
  return out;
}

constexpr int kBlock = 8;
constexpr int kVisible = 40;  // of 255, in one channel of one block

/// The share of blocks that are seen to differ. Requires: equal sizes.
double difference(const Image& a, const Image& b) {
  int off = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(a.rgb[i + c] - b.rgb[i + c]));
    }
    off += most > kVisible;
  }
  return 3.0 * off / static_cast<double>(a.rgb.size());
}

/// `picture_tool match A B`: two ways to draw the same. Lines may lie a pixel apart.
int match(const std::string& first, const std::string& second) {
  constexpr double kAllowed = 0.005;
  Image a, b;
  if (!read_png(first, a)) return fail("cannot read " + first);
  if (!read_png(second, b)) return fail("cannot read " + second);
  if (a.width != b.width || a.height != b.height) return fail("the pictures differ in size");
  const double share = difference(shrunk_by(a, kBlock), shrunk_by(b, kBlock));
  std::printf("%s, %s: %.2f %% differ\n", first.c_str(), second.c_str(), 100 * share);
  return share <= kAllowed ? 0 : 1;
}

/// `picture_tool compare PICTURE REFERENCE`; the reference is 1/8 as large in each direction. With
/// HEWN_UPDATE_REFERENCES set, writes the reference instead.
int compare(const std::string& picture, const std::string& reference) {
  constexpr double kAllowed = 0.04;  // share of blocks that may be off: texts and tessellations
  Image seen, wanted;
  if (!read_png(picture, seen)) return fail("cannot read " + picture);
  seen = shrunk_by(seen, kBlock);
  if (std::getenv("HEWN_UPDATE_REFERENCES")) {
    return save_png(seen, reference) ? 0 : fail("cannot write " + reference);
  }
  if (!read_png(reference, wanted)) return fail("cannot read " + reference);
  if (seen.width != wanted.width || seen.height != wanted.height) {
    return fail(picture + " has another size than its reference");
  }
  const double share = difference(seen, wanted);
  std::printf("%s: %.2f %% of the picture differs\n", picture.c_str(), 100 * share);
  return share <= kAllowed ? 0 : 1;
}

/// `picture_tool fine-mesh IN OUT PIECES`: every side in so many pieces, every triangle in their
/// square.
int fine_mesh(const std::string& in, const std::string& out, int pieces) {
  const auto loaded = load_mesh(in, {}, RunContext{});
  if (!loaded) return fail(loaded.error().message);
  const Mesh& mesh = loaded->mesh;
  std::vector<Vec3> vertices = mesh.vertices;
  std::vector<Triangle> triangles;
  std::map<std::array<int, 3>, int> on_sides;  // low vertex, high vertex, step from the low one
  for (const Triangle& t : mesh.triangles) {
    std::map<std::pair<int, int>, int> inner;
    const auto at = [&](int i, int j) {  // i steps towards t[1], j towards t[2]
      const std::array<int, 3> steps = {pieces - i - j, i, j};
      std::array<int, 2> used{};
      int count = 0;
      for (int k = 0; k < 3; ++k) {
        if (steps[k] == pieces) return static_cast<int>(t[k]);
        if (steps[k] > 0 && count < 2) used[count++] = k;
      }
      const bool is_side = steps[used[0]] + steps[used[1]] == pieces;
      if (is_side && t[used[0]] > t[used[1]]) std::swap(used[0], used[1]);
      int& place = is_side ? on_sides[{static_cast<int>(t[used[0]]), static_cast<int>(t[used[1]]),
                                       steps[used[1]]}]
                           : inner[{i, j}];
      if (place == 0) {
        Vec3 p = Vec3::Zero();
        if (is_side) {
          p = (mesh.vertices[t[used[0]]] * steps[used[0]] +
               mesh.vertices[t[used[1]]] * steps[used[1]]) /
              pieces;
        } else {
          for (int k = 0; k < 3; ++k) p += mesh.vertices[t[k]] * steps[k] / pieces;
        }
        place = static_cast<int>(vertices.size());
        vertices.push_back(p);
      }
      return place;
    };
    for (int i = 0; i < pieces; ++i) {
      for (int j = 0; i + j < pieces; ++j) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 2 <= pieces) {
          triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
      }
    }
  }
  const auto fine = repair_mesh(std::move(vertices), std::move(triangles), {}, RunContext{});
  if (!fine) return fail(fine.error().message);
  if (auto done = save_mesh(fine->mesh, out); !done) return fail(done.error().message);
  std::printf("%zu triangles\n", fine->mesh.triangles.size());
  return 0;
}

}  // namespace
}  // namespace hewn

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 3 && words[0] == "compare") return hewn::compare(words[1], words[2]);
  if (words.size() == 3 && words[0] == "match") return hewn::match(words[1], words[2]);
  if (words.size() == 4 && words[0] == "fine-mesh") {
    return hewn::fine_mesh(words[1], words[2], std::atoi(words[3].c_str()));
  }
  return hewn::fail("compare PICTURE REFERENCE | match A B | fine-mesh IN OUT PIECES");
}
