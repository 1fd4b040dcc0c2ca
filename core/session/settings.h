#pragma once
/// Every tunable of a reconstruction in one value.
#include <vector>

#include "core/compute/compute.h"
#include "core/fit/surface_set.h"
#include "core/mesh/load.h"
#include "core/segment/curvature/curvature_options.h"
#include "core/segment/segment.h"
#include "core/session/option_io.h"
#include "core/synth/evolve/evolve_tree.h"
#include "core/synth/find_tree.h"

namespace hewn {

/// Where heavy work runs; never changes a result.
struct DeviceOptions {
  int kind = 0;  ///< as `DeviceChoice::Kind`
  int index = 0;

  DeviceChoice choice() const { return {static_cast<DeviceChoice::Kind>(kind), index}; }
};

template <>
std::span<const OptionField<DeviceOptions>> option_table<DeviceOptions>();

/// How a tree is judged against the mesh. See `verify`.
struct VerifySettings {
  int volume_points = 30000;
  int surface_points = 5000;
};

template <>
std::span<const OptionField<VerifySettings>> option_table<VerifySettings>();

template <>
std::span<const OptionField<MeshLoadOptions>> option_table<MeshLoadOptions>();

struct Settings {
  MeshLoadOptions load;
  SegmentOptions segment;
  RegulariseOptions regularise;
  TreeSearchOptions tree;
  EvolveOptions evolve;
  VerifySettings verify;
  DeviceOptions device;
};

/// The option tables of `settings`, in the order of the stages. Valid as long as `settings`.
std::vector<OptionSection> bind_settings(Settings& settings);

/// {"segment": {...}, ...}.
nlohmann::json settings_to_json(Settings settings);

/// Sets what `object` names. Fails with InvalidArgument.
Result<void> settings_from_json(Settings& settings, const nlohmann::json& object);

/// The whole page docs/options.md.
std::string settings_to_markdown();

}  // namespace hewn
