// Finds out what a file holds and has it read and repaired.
#include "core/mesh/load.h"

#include <array>
#include <cctype>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/mesh/raw_mesh.h"
#include "core/mesh/text_scanner.h"

namespace hewn {
namespace {

enum class FileKind { Unknown, Off, StlBinary, StlAscii, Obj, Ply };

bool starts_with_ignoring_case(std::string_view text, std::string_view head) {
  if (text.size() < head.size()) return false;
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(text[i])) != head[i]) return false;
  }
  return true;
}

bool is_off_keyword(std::string_view word) {
  const std::size_t at = word.find("OFF");
  if (at == std::string_view::npos || at > 5) return false;
  return word.substr(0, at).find_first_not_of("STCN4n") == std::string_view::npos &&
         word.substr(at + 3).find_first_not_of("0123456789") == std::string_view::npos;
}

/// Whether one of the first lines is a vertex of an OBJ file.
bool looks_like_obj(std::string_view content) {
  TextScanner scanner(content.substr(0, 1 << 20));
  for (int lines = 0; lines < 2000 && scanner.next_line(); ++lines) {
    const std::string_view word = scanner.field();
    if (word == "v") return parse_double(scanner.field()).has_value();
    if (word.find('\0') != std::string_view::npos) return false;
  }
  return false;
}

FileKind kind_of_content(std::string_view content) {
  if (starts_with_ignoring_case(content, "ply\n") || starts_with_ignoring_case(content, "ply\r")) {
    return FileKind::Ply;
  }
  // Before the text formats: many binary STL files start with "solid" all the same.
  if (is_binary_stl(content)) return FileKind::StlBinary;
  TextScanner scanner(content.substr(0, 1 << 16));
  const std::string_view word = scanner.next_line() ? scanner.field() : std::string_view();
  if (is_off_keyword(word)) return FileKind::Off;
  if (starts_with_ignoring_case(word, "solid")) {
    const bool is_text = content.substr(0, 1024).find('\0') == std::string_view::npos;
    return is_text ? FileKind::StlAscii : FileKind::StlBinary;
  }
  return looks_like_obj(content) ? FileKind::Obj : FileKind::Unknown;
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

FileKind kind_of_name(const std::string& extension) {
  if (extension == ".off") return FileKind::Off;
  if (extension == ".stl") return FileKind::StlBinary;
  if (extension == ".obj") return FileKind::Obj;
  if (extension == ".ply") return FileKind::Ply;
  return FileKind::Unknown;
}

bool agree(FileKind name, FileKind content) {
  return name == content || (name == FileKind::StlBinary && content == FileKind::StlAscii);
}

/// What people hand over by mistake, and what to do with it.
std::string_view hint(std::string_view content) {
  struct Known {
    std::string_view head, advice;
  };
  static constexpr std::array<Known, 7> kKnown = {{
      {"PK\x03\x04", "it is a ZIP archive (3MF?): unpack it or export an STL"},
      {"ISO-10303", "it is a STEP model: export a mesh from the CAD program"},
      {"<?xml", "it is XML (AMF, COLLADA, 3MF?): export an STL, OFF, OBJ or PLY"},
      {"glTF", "it is glTF: export an STL, OFF, OBJ or PLY"},
      {"{", "it is JSON: a mesh file is needed"},
      {"module ", "it is OpenSCAD source: render it to STL or OFF first"},
      {"\x7f"
       "ELF",
       "it is a program"},
  }};
  for (const Known& known : kKnown) {
    if (content.substr(0, known.head.size()) == known.head) return known.advice;
  }
  return "save the mesh as one of these";
}

Error unknown_content(const ReadInput& input, FileKind by_name) {
  static constexpr std::array<std::string_view, 6> kNames = {
      "a mesh", "OFF (starts with 'OFF')", "STL",
      "STL",    "OBJ (has 'v' lines)",     "PLY (starts with 'ply')"};
  return {ErrorCode::Format,
          fmt::format("the content is not {}, nor any of OFF, STL, OBJ, PLY: {}",
                      kNames[static_cast<std::size_t>(by_name)], hint(input.content)),
          at_line(input.name, 1)};
}

Result<RawMesh> read_as(FileKind kind, const ReadInput& input) {
  switch (kind) {
    case FileKind::Off:
      return read_off(input);
    case FileKind::StlBinary:
      return read_stl_binary(input);
    case FileKind::StlAscii:
      return read_stl_ascii(input);
    case FileKind::Obj:
      return read_obj(input);
    case FileKind::Ply:
      return read_ply(input);
    case FileKind::Unknown:
      break;
  }
  return unknown_content(input, kind);
}

Result<RawMesh> read_content(const ReadInput& input, const std::string& extension) {
  const FileKind by_name = kind_of_name(extension);
  const FileKind by_content = kind_of_content(input.content);
  if (input.content.empty()) {
    return Error{ErrorCode::Format, "the file is empty; get a whole copy", input.name};
  }
  if (by_content == FileKind::Unknown) {
    // A binary STL has no magic word: its reader says how the length fails to match.
    if (by_name == FileKind::StlBinary) return read_stl_binary(input);
    return unknown_content(input, by_name);
  }
  Result<RawMesh> mesh = read_as(by_content, input);
  if (mesh && !agree(by_name, by_content)) {
    mesh->warnings.insert(mesh->warnings.begin(),
                          fmt::format("The name ends in '{}', but the file holds {}; it was read "
                                      "as that.",
                                      extension, mesh->format));
  }
  return mesh;
}

}  // namespace

Result<void> check_count(const CountCheck& check, const ReadInput& input) {
  if (check.count * static_cast<double>(check.min_bytes) >
      static_cast<double>(input.content.size())) {
    return Error{ErrorCode::Format,
                 fmt::format("the header promises {:.0f} {}, more than the file's {} bytes can "
                             "hold; it is truncated or damaged: get a whole copy",
                             check.count, check.what, input.content.size()),
                 check.where};
  }
  if (check.count > input.options.max_triangles) {
    return Error{ErrorCode::TooLarge,
                 fmt::format("the file holds {:.0f} {}, the limit is {}; simplify the mesh or "
                             "raise the limit",
                             check.count, check.what, input.options.max_triangles),
                 check.where};
  }
  return {};
}

Result<LoadedMesh> load_mesh(const std::filesystem::path& path, const MeshLoadOptions& options,
                             const RunContext& run) {
  run.report("reading", 0);
  Result<std::string> content = read_file(path);
  if (!content) return content.error();
  const ReadInput input{*content, path.string(), options, run};
  Result<RawMesh> raw = read_content(input, lower_extension(path));
  if (!raw) return raw.error();
  std::string().swap(*content);
  run.report("reading", 1);
  Result<LoadedMesh> loaded =
      repair_mesh(std::move(raw->vertices), std::move(raw->triangles), options, run);
  if (!loaded) {
    Error error = loaded.error();
    error.where = error.where.empty() ? path.string() : path.string() + ", " + error.where;
    return error;
  }
  loaded->report.format = raw->format;
  auto& warnings = loaded->report.warnings;
  warnings.insert(warnings.begin(), raw->warnings.begin(), raw->warnings.end());
  return loaded;
}

}  // namespace hewn
