#include "core/session/settings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hewn {
namespace {

constexpr OptionField<MeshLoadOptions> kLoadOptions[] = {
    {"weld-tolerance", &MeshLoadOptions::weld_tolerance, 0, 0.01,
     "vertices closer than this share of the bounding box's diagonal become one"},
    {"max-triangles", &MeshLoadOptions::max_triangles, 1, 100'000'000, "larger meshes are refused"},
};

constexpr OptionField<DeviceOptions> kDeviceOptions[] = {
    {"kind", &DeviceOptions::kind, 0, 2,
     "auto: a GPU for jobs that are large enough; cpu: never one; cuda: a GPU for every job that "
     "it can do",
     "auto,cpu,cuda"},
    {"index", &DeviceOptions::index, 0, 255, "which of several GPUs, as the driver numbers them"},
};

constexpr OptionField<VerifySettings> kVerifyOptions[] = {
    {"volume-points", &VerifySettings::volume_points, 1000, 10'000'000,
     "random points that measure agreement and intersection over union"},
    {"surface-points", &VerifySettings::surface_points, 100, 10'000'000,
     "random surface points, each way, that measure distances"},
};

}  // namespace

template <>
std::span<const OptionField<MeshLoadOptions>> option_table<MeshLoadOptions>() {
  return kLoadOptions;
}

template <>
std::span<const OptionField<VerifySettings>> option_table<VerifySettings>() {
  return kVerifyOptions;
}

template <>
std::span<const OptionField<DeviceOptions>> option_table<DeviceOptions>() {
  return kDeviceOptions;
}

std::vector<OptionSection> bind_settings(Settings& settings) {
  return {
      {"load", "Reading and repairing the mesh.", bind_options(settings.load)},
      {"segment", "Dividing the mesh into face groups.", bind_options(settings.segment)},
      {"curvature", "Dividing by curvature (`--segment-method curvature`).",
       bind_options(settings.segment.curvature)},
      {"regularise", "Cleaning up fitted surfaces.", bind_options(settings.regularise)},
      {"tree", "Finding the tree of one partition. Budgets count steps, never seconds.",
       bind_options(settings.tree)},
      {"evolve", "The genetic search (`--search evolve`).", bind_options(settings.evolve)},
      {"verify", "Judging the tree on fresh points.", bind_options(settings.verify)},
      {"device",
       "Where heavy work runs; never changes a result. `--device auto|cpu|cuda[:INDEX]` sets both.",
       bind_options(settings.device)},
  };
}

nlohmann::json settings_to_json(Settings settings) {
  nlohmann::json object = nlohmann::json::object();
  for (const OptionSection& section : bind_settings(settings)) {
    object[std::string(section.name)] = options_to_json(section);
  }
  return object;
}

Result<void> settings_from_json(Settings& settings, const nlohmann::json& object) {
  if (!object.is_object()) {
    return Error{ErrorCode::InvalidArgument, "'options' must be an object of sections"};
  }
  const std::vector<OptionSection> sections = bind_settings(settings);
  for (const auto& [name, values] : object.items()) {
    const OptionSection* found = nullptr;
    for (const OptionSection& section : sections) {
      if (section.name == name) found = &section;
    }
    if (found == nullptr) {
      return Error{
          ErrorCode::InvalidArgument,
          fmt::format("there is no section '{}' of options; `hewn options` lists them", name)};
    }
    if (Result<void> set = options_from_json(*found, values); !set) return set.error();
  }
  return {};
}

std::string settings_to_markdown() {
  Settings defaults;
  std::string page =
      "# Options\n\n"
      "Made by `hewn options --markdown` from the tables in the sources. In a project file an\n"
      "option stands under its section's name, without the prefix (docs/project-file.md).\n";
  for (const OptionSection& section : bind_settings(defaults)) {
    page += "\n" + options_to_markdown(section);
  }
  return page;
}

}  // namespace hewn
