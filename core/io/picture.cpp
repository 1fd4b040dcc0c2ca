#include "core/io/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <png.h>

#include "core/base/file.h"
#include "core/compute/parallel.h"
#include "core/csg/tree_ray.h"

namespace hewn {
namespace {

constexpr int kBackground = -1;
constexpr int kUncoloured = -2;

/// What one ray sees.
struct Hit {
  double depth = kInfinity;
  Vec3 normal = Vec3::Zero();
  double offset = std::nan("");  ///< of the plane through the hit, of trees
  int face = kBackground;        ///< lines are drawn between different ones
  int colour = kUncoloured;      ///< number of the hue
};

struct Ray {
  Vec3 origin, direction;
};

/// Casts one ray; called from several threads.
using Caster = std::function<Hit(const Ray&)>;

/// A camera far enough away that parallel edges look parallel, near enough to look solid.
class Camera {
 public:
  Camera(const Box3& scene, const PictureOptions& options) {
    const double diagonal = std::max(scene.diagonal(), 1e-300);
    back_ = options.view.normalized();
    const Vec3 up = std::abs(back_.z()) > 0.999 ? Vec3::UnitY() : Vec3::UnitZ();
    right_ = up.cross(back_).normalized();
    up_ = back_.cross(right_);
    constexpr double kDistance = 4;  // in diagonals
    eye_ = scene.center() + back_ * (kDistance * diagonal);
    // The smallest window that holds all corners of the box, with a margin.
    double reach = 0;
    const double aspect = static_cast<double>(options.width) / options.height;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p(corner & 1 ? scene.hi.x() : scene.lo.x(),
                   corner & 2 ? scene.hi.y() : scene.lo.y(),
                   corner & 4 ? scene.hi.z() : scene.lo.z());
      const Vec3 r = p - eye_;
      const double depth = -r.dot(back_);
      reach =
          std::max({reach, std::abs(r.dot(right_)) / depth / aspect, std::abs(r.dot(up_)) / depth});
    }
    half_height_ = 1.06 * reach;
    half_width_ = half_height_ * aspect;
  }

  /// Through (x, y) in [-1, 1], y upwards. The direction has unit length.
  Ray through(double x, double y) const {
    return {eye_, (right_ * (x * half_width_) + up_ * (y * half_height_) - back_).normalized()};
  }
  const Vec3& back() const { return back_; }
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }

 private:
  Vec3 eye_, back_, right_, up_;
  double half_width_ = 1, half_height_ = 1;
};

Vec3 oklab_to_linear(double lightness, double a, double b) {
  const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
  const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
  const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
  const Vec3 cubes(l * l * l, m * m * m, s * s * s);
  Mat3 to_rgb;
  to_rgb << 4.0767416621, -3.3077115913, 0.2309699292, -1.2684380046, 2.6097574011, -0.3413193965,
      -0.0041960863, -0.7034186147, 1.7076147010;
  return (to_rgb * cubes).cwiseMax(0).cwiseMin(1);
}

double to_linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::uint8_t to_srgb_byte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * srgb));
}

Vec3 from_hex(unsigned rgb) {
  return {to_linear(((rgb >> 16) & 255) / 255.0), to_linear(((rgb >> 8) & 255) / 255.0),
          to_linear((rgb & 255) / 255.0)};
}

struct Palette {
  Vec3 top, bottom, line, plain;
};

Palette palette(bool is_dark) {
  if (is_dark) {
    return {from_hex(0x1d2126), from_hex(0x121417), from_hex(0x0b0d0f), from_hex(0x9aa0a6)};
  }
  return {from_hex(0xfbfcfd), from_hex(0xe6eaee), from_hex(0x2a3038), from_hex(0x9aa0a6)};
}

/// Soft light from the camera's upper left, with a weaker one from the right and from the sky.
Vec3 shade(const Hit& hit, const Camera& camera, const Palette& colours) {
  const Vec3 base = hit.colour < 0 ? colours.plain : golden_colour(hit.colour);
  const Vec3 key = (camera.back() * 0.75 - camera.right() * 0.5 + camera.up() * 0.75).normalized();
  const Vec3 fill = (camera.back() * 0.6 + camera.right() * 0.9).normalized();
  const double wrapped = 0.5 + 0.5 * hit.normal.dot(key);
  const double light = 0.16 + 0.78 * wrapped * wrapped +
                       0.16 * std::max(0.0, hit.normal.dot(fill)) +
                       0.06 * std::max(0.0, hit.normal.dot(camera.up()));
  const Vec3 half_way = (key + camera.back()).normalized();
  const double gloss = 0.10 * std::pow(std::max(0.0, hit.normal.dot(half_way)), 40);
  return base * light + Vec3::Constant(gloss);
}

/// Whether a line belongs between two neighbouring samples.
bool is_edge(const Hit& a, const Hit& b, double depth_step) {
  if (a.face != b.face) return true;
  if (a.face == kBackground) return false;
  constexpr double kCrease = 0.9;  // cosine; facets of one curved face stay below it
  return a.normal.dot(b.normal) < kCrease || std::abs(a.depth - b.depth) > depth_step;
}

/// All samples of the picture, row by row from the top.
struct Samples {
  int columns = 0, rows = 0;
  std::vector<Hit> hits;
  const Hit& at(int x, int y) const { return hits[static_cast<std::size_t>(y) * columns + x]; }
};

Result<Samples> cast_all(const Caster& caster, const Camera& camera, const PictureOptions& options,
                         const RunContext& run) {
  Samples samples;
  samples.columns = options.width * options.samples;
  samples.rows = options.height * options.samples;
  samples.hits.resize(static_cast<std::size_t>(samples.columns) * samples.rows);
  const auto cast_row = [&](std::size_t row) {
    if (run.is_cancelled()) return;
    const double y = 1 - (2.0 * static_cast<double>(row) + 1) / samples.rows;
    for (int column = 0; column < samples.columns; ++column) {
      const double x = (2.0 * column + 1) / samples.columns - 1;
      samples.hits[row * samples.columns + column] = caster(camera.through(x, y));
    }
  };
  for_each_index(run.threads, samples.rows, cast_row);
  if (run.is_cancelled()) return RunContext::cancelled();
  return samples;
}

/// Gives each flat face one colour, that of most of it: where operands are flush, chance decides
/// which one a ray meets first.
void unify_flat_faces(Samples& samples, double near) {
  constexpr double kFlat = 1 - 1e-9;
  const auto is_one_face = [near](const Hit& a, const Hit& b) {
    return b.face != kBackground && a.normal.dot(b.normal) > kFlat &&
           std::abs(a.offset - b.offset) < near;
  };
  const int columns = samples.columns;
  std::vector<char> is_seen(samples.hits.size(), 0);
  std::vector<std::size_t> face;
  for (std::size_t start = 0; start < samples.hits.size(); ++start) {
    if (is_seen[start] || samples.hits[start].face == kBackground) continue;
    face.assign(1, start);
    is_seen[start] = 1;
    std::map<std::pair<int, int>, int> shares;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Hit& here = samples.hits[face[i]];
      ++shares[{here.face, here.colour}];
      const int x = static_cast<int>(face[i]) % columns;
      const int y = static_cast<int>(face[i]) / columns;
      for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        if (x + dx < 0 || x + dx >= columns || y + dy < 0 || y + dy >= samples.rows) continue;
        const auto next = static_cast<std::size_t>(y + dy) * columns + (x + dx);
        if (is_seen[next] || !is_one_face(here, samples.hits[next])) continue;
        is_seen[next] = 1;
        face.push_back(next);
      }
    }
    const auto most = std::max_element(shares.begin(), shares.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    for (const std::size_t i : face) {
      std::tie(samples.hits[i].face, samples.hits[i].colour) = most->first;
    }
  }
}

/// The share of the 3 x 3 neighbourhood that lies across an edge, as a soft line about two
/// samples wide.
double line_weight(const Samples& samples, int x, int y, double depth_step) {
  const Hit& here = samples.at(x, y);
  int across = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int nx = std::clamp(x + dx, 0, samples.columns - 1);
      const int ny = std::clamp(y + dy, 0, samples.rows - 1);
      across += is_edge(here, samples.at(nx, ny), depth_step);
    }
  }
  return across == 0 ? 0.0 : std::min(1.0, 0.55 + 0.15 * across);
}

Image resolve(const Samples& samples, const Camera& camera, double depth_step,
              const PictureOptions& options, const RunContext& run) {
  Image image{options.width, options.height, {}};
  image.rgb.resize(static_cast<std::size_t>(3) * options.width * options.height);
  const Palette colours = palette(options.is_dark);
  const int n = options.samples;
  const auto sample_colour = [&](int x, int y) {
    const Hit& hit = samples.at(x, y);
    const double down = (y + 0.5) / samples.rows;
    const Vec3 surface = hit.face == kBackground
                             ? Vec3(colours.top * (1 - down) + colours.bottom * down)
                             : shade(hit, camera, colours);
    const double line = line_weight(samples, x, y, depth_step);
    return Vec3(surface * (1 - line) + colours.line * line);
  };
  for_each_index(run.threads, options.height, [&](std::size_t row) {
    for (int column = 0; column < options.width; ++column) {
      Vec3 sum = Vec3::Zero();
      for (int sub = 0; sub < n * n; ++sub) {
        sum += sample_colour(column * n + sub % n, static_cast<int>(row) * n + sub / n);
      }
      std::uint8_t* pixel = &image.rgb[3 * (row * options.width + column)];
      for (int k = 0; k < 3; ++k) pixel[k] = to_srgb_byte(sum[k] / (n * n));
    }
  });
  return image;
}

Result<Image> render(const Caster& caster, const Box3& scene, const PictureOptions& options,
                     const RunContext& run) {
  if (options.width <= 0 || options.height <= 0 || options.samples <= 0 || scene.is_empty()) {
    return Error{ErrorCode::InvalidArgument, "a picture needs at least one pixel and a part"};
  }
  const Camera camera(scene, options);
  auto samples = cast_all(caster, camera, options, run);
  if (!samples) return samples.error();
  unify_flat_faces(*samples, 1e-6 * scene.diagonal());
  return resolve(*samples, camera, 0.02 * scene.diagonal(), options, run);
}

void append_png(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

/// libpng reports errors by a long jump: no object with a destructor may live in this frame.
bool encode_png(const Image& image, std::string* out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png))) {  // NOLINT: the library's error protocol
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, out, append_png, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int row = 0; row < image.height; ++row) {
    png_write_row(png, &image.rgb[static_cast<std::size_t>(3) * row * image.width]);
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

Vec3 golden_colour(int index) {
  constexpr double kGoldenAngle = 2.39996322972865332;
  const double hue = 0.5 + kGoldenAngle * index;
  return oklab_to_linear(0.74, 0.10 * std::cos(hue), 0.10 * std::sin(hue));
}

Result<Image> render_mesh(const MeshQuery& query, const std::vector<int>& colour_of_triangle,
                          const Box3& scene, const PictureOptions& options, const RunContext& run) {
  const Caster caster = [&](const Ray& ray) {
    Hit hit;
    const RayHit found = query.cast(ray.origin, ray.direction);
    if (found.triangle < 0) return hit;
    const Vec3 normal = query.mesh().normals[found.triangle];
    hit.depth = found.t;
    hit.normal = normal.dot(ray.direction) > 0 ? Vec3(-normal) : normal;
    const bool is_coloured = static_cast<std::size_t>(found.triangle) < colour_of_triangle.size();
    hit.colour = is_coloured ? colour_of_triangle[found.triangle] : kUncoloured;
    hit.face = std::max(hit.colour, 0);
    return hit;
  };
  return render(caster, scene, options, run);
}

Result<Image> render_tree(const Tree& tree, const Box3& scene, const PictureOptions& options,
                          const RunContext& run) {
  const TreeRays rays(tree);
  const Caster caster = [&](const Ray& ray) {
    Hit hit;
    TreeRayScratch scratch;
    const auto& stretches = rays.cast(ray.origin, ray.direction, scratch);
    if (stretches.empty()) return hit;
    const TreeCrossing& first = stretches.front().enter;
    hit.depth = first.t;
    const Vec3 position = ray.origin + first.t * ray.direction;
    hit.normal = rays.normal(first, position, ray.direction);
    hit.offset = hit.normal.dot(position);
    hit.face = 8 * (first.literal + 1) + first.face;
    hit.colour = first.literal;
    return hit;
  };
  return render(caster, scene, options, run);
}

Image side_by_side(const Image& left, const Image& right) {
  Image both{left.width + right.width, std::min(left.height, right.height), {}};
  both.rgb.resize(static_cast<std::size_t>(3) * both.width * both.height);
  const auto left_bytes = static_cast<std::size_t>(left.width) * 3;
  const auto right_bytes = static_cast<std::size_t>(right.width) * 3;
  for (std::size_t row = 0; row < static_cast<std::size_t>(both.height); ++row) {
    std::uint8_t* out = &both.rgb[row * (left_bytes + right_bytes)];
    std::memcpy(out, &left.rgb[row * left_bytes], left_bytes);
    std::memcpy(out + left_bytes, &right.rgb[row * right_bytes], right_bytes);
  }
  return both;
}

Result<void> save_png(const Image& image, const std::filesystem::path& path) {
  std::string bytes;
  if (!encode_png(image, &bytes)) {
    return Error{ErrorCode::Internal, "libpng could not encode the picture", path.string()};
  }
  return write_file(path, bytes);
}

}  // namespace hewn
