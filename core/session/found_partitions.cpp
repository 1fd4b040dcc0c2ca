#include "core/session/found_partitions.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/session/document.h"

namespace hewn {

std::string partition_key(const Project& project, const Partition& partition) {
  Project frame = project;
  frame.root = {};
  frame.edits.clear();
  nlohmann::json own = {{"groups", partition.groups},
                        {"cuts", partition.touching_cuts},
                        {"is_subtracted", partition.is_subtracted}};
  return plan_text(frame) + own.dump();
}

std::optional<PartitionResult> FoundPartitions::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&key](const Entry& entry) { return entry.key == key; });
  if (it == entries_.end()) return std::nullopt;
  return it->result;
}

void FoundPartitions::keep(const std::string& key, const PartitionResult& result) {
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&key](const Entry& entry) { return entry.key == key; });
  entries_.push_back({key, result});
  if (entries_.size() > kMost) entries_.pop_front();
}

}  // namespace hewn
