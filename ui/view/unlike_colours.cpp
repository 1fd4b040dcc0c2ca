#include "ui/view/unlike_colours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hewn {
namespace {

constexpr double kTurn_deg = 360;
constexpr double kGolden_deg = 137.50776405003785;
constexpr double kUnlike_deg = 40;
constexpr int kTries = 60;

/// Between the hues of two numbers, in [0, 180].
double apart(int a, int b) {
  const double turned = std::fmod(std::abs(a - b) * kGolden_deg, kTurn_deg);
  return std::min(turned, kTurn_deg - turned);
}

/// (face, face beside it with a lower label), ascending, each once.
std::vector<std::pair<int, int>> lower_neighbours(const DisplayMesh& mesh) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < mesh.lines.size(); i += 2) {
    const auto [a, b] = mesh.lines[i].labels;
    if (a != b && a >= 0 && b >= 0) pairs.emplace_back(std::max(a, b), std::min(a, b));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<int> unlike_colours(const DisplayMesh& mesh) {
  const auto pairs = lower_neighbours(mesh);
  std::vector<int> numbers(static_cast<std::size_t>(mesh.labels));
  auto beside = pairs.begin();
  for (int label = 0; label < mesh.labels; ++label) {
    const auto first = beside;
    while (beside != pairs.end() && beside->first == label) ++beside;
    double best = -1;
    for (int number = label; number < label + kTries && best < kUnlike_deg; ++number) {
      double nearest = kTurn_deg;
      for (auto it = first; it != beside; ++it) {
        nearest = std::min(nearest, apart(number, numbers[static_cast<std::size_t>(it->second)]));
      }
      if (nearest <= best) continue;
      best = nearest;
      numbers[static_cast<std::size_t>(label)] = number;
    }
  }
  return numbers;
}

}  // namespace hewn
