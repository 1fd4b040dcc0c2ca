#pragma once
/// What a reader hands to the repairs, and the readers. Internal to core/mesh.
///
/// The readers are this project's own. OpenMesh's (version 9) store every coordinate in single
/// precision, accept truncated files, and drop faces with a bad index or a complex edge with no
/// word to the caller: none of the three can be mended from outside.
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/load.h"

namespace hewn {

struct RawMesh {
  std::string format;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::string> warnings;
};

struct ReadInput {
  std::string_view content;
  std::string name;  ///< the path, for messages
  const MeshLoadOptions& options;
  const RunContext& run;
};

/// Each fails with: Format or BadMesh (where = "path:line" or "path, byte N"), TooLarge, Cancelled.
Result<RawMesh> read_off(const ReadInput& input);
Result<RawMesh> read_obj(const ReadInput& input);
Result<RawMesh> read_ply(const ReadInput& input);
Result<RawMesh> read_stl_ascii(const ReadInput& input);
Result<RawMesh> read_stl_binary(const ReadInput& input);

/// Whether the content has the exact length that a binary STL's triangle count asks for.
bool is_binary_stl(std::string_view content);

/// Rejects counts above the limit, or that cannot fit into the file at `min_bytes` per element.
struct CountCheck {
  std::string_view what;  ///< "vertices", "faces"
  double count = 0;
  std::size_t min_bytes = 1;
  std::string where;
};
Result<void> check_count(const CountCheck& check, const ReadInput& input);

/// The error for a NaN or infinite coordinate.
Error not_finite(std::string where);

/// Appends `loop` as triangles; returns the number of triangles. Needs at least 3 indices in range.
int triangulate_polygon(const std::vector<Vec3>& vertices, const std::vector<int>& loop,
                        std::vector<Triangle>& out);

/// Adds the warning about faces that no reader can use, if there are any.
void warn_of_skipped_faces(int count, RawMesh& mesh);

/// Called every element or so; true once the user has cancelled.
inline bool cancelled_at(std::size_t i, const RunContext& run) {
  return (i & 0xFFFF) == 0 && run.is_cancelled();
}

}  // namespace hewn
