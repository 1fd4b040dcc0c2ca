#pragma once
/// Runs the real binary, as a user would.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace hewn::cli {

struct Outcome {
  int exit_code = -1;  ///< 128 + n when signal n ended it
  std::string out, err;
  double seconds = 0;
  double peak_mb = 0;  ///< resident memory

  bool says(const std::string& text) const { return err.find(text) != std::string::npos; }
};

/// Runs `hewn` with these arguments, no terminal and no input; sends SIGINT after
/// `interrupt_after_s` seconds when that is not negative (`seconds` then counts from there).
Outcome run_hewn(const std::vector<std::string>& arguments, double interrupt_after_s = -1);

/// What the system denies the program.
struct Denied {
  /// Files cannot grow beyond this, as on a disk that fills up; negative: they can.
  long file_bytes = -1;
  /// Even root must heed the permissions of files.
  bool is_privileged = true;
  std::string out;  ///< where standard output goes; empty: it is captured
};
Outcome run_hewn_with(const Denied& denied, const std::vector<std::string>& arguments);

/// Runs `hewn` with its messages on a terminal and sends SIGINT as soon as its progress line names
/// `stage`; `seconds` counts from there. False in `has_reached` when that never came.
struct StageInterrupt {
  Outcome outcome;  ///< `err` is what the terminal showed
  bool has_reached = false;
};
StageInterrupt interrupt_at(const std::string& stage, const std::vector<std::string>& arguments);

/// A folder of its own for one test, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& content) const;
  /// Names of the files in it, in order.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

/// The content of a file; empty when it is not there.
std::string content_of(const std::string& path);

/// A mesh to be written as text.
struct TextMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 3>> triangles;

  /// The corners of `other` in their places, its triangles after this mesh's.
  TextMesh operator+(const TextMesh& other) const;
  /// Turned inside out.
  TextMesh flipped() const;
  std::string off() const;
};

/// The cube [corner, corner + size].
TextMesh cube_mesh(double size = 10, const std::array<double, 3>& corner = {0, 0, 0});

/// A cube as OFF text; `size` scales it.
std::string cube_off(double size = 10);

}  // namespace hewn::cli
