#include "tests/cli/program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hewn::cli {
namespace {

void redirect(const char* path, int flags, int to) {
  const int file = ::open(path, flags, 0600);
  ::dup2(file, to);
}

/// In the child: never returns.
[[noreturn]] void become_hewn(const std::vector<std::string>& arguments, const std::string& out,
                              const std::string& err) {
  redirect("/dev/null", O_RDONLY, 0);
  redirect(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 1);
  redirect(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 2);
  std::vector<std::string> words{HEWN_BINARY_DIR "/bin/hewn"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

Outcome run_hewn(const std::vector<std::string>& arguments, double interrupt_after_s) {
  const Folder folder;
  const std::string out = folder / "out";
  const std::string err = folder / "err";
  auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become_hewn(arguments, out, err);
  if (interrupt_after_s >= 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(interrupt_after_s));
    start = std::chrono::steady_clock::now();
    ::kill(child, SIGINT);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = content_of(out);
  outcome.err = content_of(err);
  outcome.seconds = passed.count();
  return outcome;
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "hewn_cli_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
  return *this / name;
}

std::vector<std::string> Folder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TextMesh TextMesh::operator+(const TextMesh& other) const {
  TextMesh joined = *this;
  const int first = static_cast<int>(vertices.size());
  joined.vertices.insert(joined.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) {
    joined.triangles.push_back({first + a, first + b, first + c});
  }
  return joined;
}

TextMesh TextMesh::flipped() const {
  TextMesh turned = *this;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  return turned;
}

std::string TextMesh::off() const {
  std::string text = fmt::format("OFF\n{} {} 0\n", vertices.size(), triangles.size());
  for (const auto& [x, y, z] : vertices) text += fmt::format("{} {} {}\n", x, y, z);
  for (const auto& [a, b, c] : triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

TextMesh cube_mesh(double size, const std::array<double, 3>& corner) {
  TextMesh mesh;
  for (int v = 0; v < 8; ++v) {
    mesh.vertices.push_back({corner[0] + ((v & 1) != 0 ? size : 0),
                             corner[1] + ((v & 2) != 0 ? size : 0),
                             corner[2] + ((v & 4) != 0 ? size : 0)});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

std::string cube_off(double size) { return cube_mesh(size).off(); }

}  // namespace hewn::cli
