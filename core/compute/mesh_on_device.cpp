#include "core/compute/mesh_on_device.h"

#include <vector>

namespace hewn {
namespace {

DeviceBuffer<PlainVec> upload_vectors(DeviceJob& job, std::span<const Vec3> from) {
  std::vector<PlainVec> plain;
  plain.reserve(from.size());
  for (const Vec3& v : from) plain.push_back({v.x(), v.y(), v.z()});
  return job.upload(std::span<const PlainVec>(plain));
}

DeviceBuffer<int> upload_triples(DeviceJob& job, std::span<const std::array<int, 3>> from) {
  static_assert(sizeof(std::array<int, 3>) == 3 * sizeof(int));
  return job.upload(std::span<const int>(from.empty() ? nullptr : from[0].data(), from.size() * 3));
}

}  // namespace

MeshOnDevice::MeshOnDevice(DeviceJob& job, const MeshArrays& mesh)
    : vertices_(upload_vectors(job, mesh.vertices)),
      normals_(upload_vectors(job, mesh.normals)),
      triangles_(upload_triples(job, mesh.triangles)),
      neighbors_(upload_triples(job, mesh.neighbors)),
      corners_(job.upload(mesh.corners)),
      first_corner_(job.upload(mesh.first_corner)),
      areas_(job.upload(mesh.areas)),
      form_{vertices_.data(),
            triangles_.data(),
            normals_.data(),
            areas_.data(),
            neighbors_.data(),
            corners_.data(),
            first_corner_.data(),
            static_cast<std::int64_t>(mesh.vertices.size()),
            static_cast<std::int64_t>(mesh.triangles.size())} {}

}  // namespace hewn
