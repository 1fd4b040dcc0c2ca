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
#include <linux/capability.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hewn::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Streams {
  int out = -1, err = -1;
};

void deny(const Denied& denied) {
  if (denied.file_bytes >= 0) {
    const auto limit = static_cast<rlim_t>(denied.file_bytes);
    const rlimit limits{limit, limit};
    ::signal(SIGXFSZ, SIG_IGN);  // writes then fail as they do on a full disk
    ::setrlimit(RLIMIT_FSIZE, &limits);
  }
  if (denied.is_privileged) return;
  for (const int capability : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH}) {
    ::prctl(PR_CAPBSET_DROP, capability, 0, 0, 0);
  }
}

/// In the child: never returns.
[[noreturn]] void become_hewn(std::vector<char*> argv, const Streams& streams,
                              const Denied& denied) {
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(streams.out, STDOUT_FILENO);
  ::dup2(streams.err, STDERR_FILENO);
  deny(denied);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

pid_t start_hewn(const std::vector<std::string>& arguments, const Streams& streams,
                 const Denied& denied) {
  std::vector<std::string> words{HEWN_BINARY_DIR "/bin/hewn"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become_hewn(std::move(argv), streams, denied);
  return child;
}

int open_for_writing(const std::string& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
}

/// Waits for the end and fills in all but the texts.
Outcome wait_for(pid_t child, Clock::time_point start) {
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  outcome.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return outcome;
}

Outcome run_captured(const Denied& denied, const std::vector<std::string>& arguments,
                     double interrupt_after_s) {
  const Folder folder;
  const std::string out = denied.out.empty() ? folder / "out" : denied.out;
  const Streams streams{open_for_writing(out), open_for_writing(folder / "err")};
  auto start = Clock::now();
  const pid_t child = start_hewn(arguments, streams, denied);
  ::close(streams.out);
  ::close(streams.err);
  if (interrupt_after_s >= 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(interrupt_after_s));
    start = Clock::now();
    ::kill(child, SIGINT);
  }
  Outcome outcome = wait_for(child, start);
  if (denied.out.empty()) outcome.out = content_of(out);
  outcome.err = content_of(folder / "err");
  return outcome;
}

}  // namespace

Outcome run_hewn(const std::vector<std::string>& arguments, double interrupt_after_s) {
  return run_captured({}, arguments, interrupt_after_s);
}

Outcome run_hewn_with(const Denied& denied, const std::vector<std::string>& arguments) {
  return run_captured(denied, arguments, -1);
}

StageInterrupt interrupt_at(const std::string& stage, const std::vector<std::string>& arguments) {
  const Folder folder;
  Streams streams{open_for_writing(folder / "out"), -1};
  int terminal = -1;
  if (::openpty(&terminal, &streams.err, nullptr, nullptr, nullptr) != 0) {
    throw std::runtime_error("no terminal");
  }
  ::fcntl(terminal, F_SETFD, FD_CLOEXEC);
  const pid_t child = start_hewn(arguments, streams, {});
  ::close(streams.out);
  ::close(streams.err);
  StageInterrupt result;
  std::string shown;
  auto start = Clock::now();
  char buffer[4096];
  // The end of the child ends the terminal's other side: reading then fails.
  for (ssize_t n = 0; (n = ::read(terminal, buffer, sizeof buffer)) > 0;) {
    shown.append(buffer, static_cast<std::size_t>(n));
    if (result.has_reached || shown.find("\033[K" + stage) == std::string::npos) continue;
    result.has_reached = true;
    start = Clock::now();
    ::kill(child, SIGINT);
  }
  result.outcome = wait_for(child, start);
  ::close(terminal);
  result.outcome.out = content_of(folder / "out");
  result.outcome.err = shown;
  return result;
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
