#include "ui/view/id_picking.h"

#include <algorithm>

namespace hewn {

std::vector<int> groups_in(const IdImage& ids, const PixelBox& box, bool must_enclose) {
  std::vector<int> inside, outside;
  const auto count = [](std::vector<int>& counts, int label) {
    if (static_cast<std::size_t>(label) >= counts.size()) counts.resize(label + 1, 0);
    ++counts[label];
  };
  for (int y = 0; y < ids.height; ++y) {
    for (int x = 0; x < ids.width; ++x) {
      const int label = ids.at(x, y);
      if (label < 0) continue;
      const bool is_in = x >= box.x0 && x <= box.x1 && y >= box.y0 && y <= box.y1;
      count(is_in ? inside : outside, label);
    }
  }
  outside.resize(std::max(inside.size(), outside.size()), 0);
  std::vector<int> groups;
  for (std::size_t g = 0; g < inside.size(); ++g) {
    if (inside[g] > 0 && (!must_enclose || outside[g] == 0)) groups.push_back(static_cast<int>(g));
  }
  return groups;
}

std::vector<int> groups_around(const IdImage& ids, const std::vector<std::array<float, 2>>& line) {
  std::vector<int> balance;
  std::vector<float> crossings;
  for (int y = 0; y < ids.height; ++y) {
    const float at = static_cast<float>(y) + 0.5F;
    crossings.clear();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto &a = line[i], &b = line[(i + 1) % line.size()];
      if ((a[1] > at) == (b[1] > at)) continue;
      crossings.push_back(a[0] + (at - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    for (int x = 0; x < ids.width; ++x) {
      while (passed < crossings.size() && crossings[passed] <= static_cast<float>(x)) ++passed;
      const int label = ids.at(x, y);
      if (label < 0) continue;
      if (static_cast<std::size_t>(label) >= balance.size()) balance.resize(label + 1, 0);
      balance[label] += passed % 2 == 1 ? 1 : -1;
    }
  }
  std::vector<int> groups;
  for (std::size_t g = 0; g < balance.size(); ++g) {
    if (balance[g] > 0) groups.push_back(static_cast<int>(g));
  }
  return groups;
}

}  // namespace hewn
