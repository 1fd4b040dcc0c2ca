/// Embree's functions, from its library when the first one is called: loading it takes longer than
/// optimising a small tree, which needs no ray through a mesh.
#include <stdexcept>
#include <string>

#include <dlfcn.h>
#include <embree3/rtcore.h>

namespace {

void* library() {
  static void* const handle = ::dlopen(HEWN_EMBREE_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  return handle;
}

/// Throws when there is none.
template <class Function>
Function* loaded(const char* name) {
  void* const symbol = library() ? ::dlsym(library(), name) : nullptr;
  if (symbol != nullptr) return reinterpret_cast<Function*>(symbol);
  throw std::runtime_error(std::string("Embree cannot be loaded: ") + ::dlerror());
}

}  // namespace

/// Looks a function up once.
#define HEWN_FORWARD(name, ...)                                \
  static auto* const function = loaded<decltype(name)>(#name); \
  return function(__VA_ARGS__)

extern "C" {

RTCDevice rtcNewDevice(const char* config) { HEWN_FORWARD(rtcNewDevice, config); }
void rtcReleaseDevice(RTCDevice device) { HEWN_FORWARD(rtcReleaseDevice, device); }
RTCError rtcGetDeviceError(RTCDevice device) { HEWN_FORWARD(rtcGetDeviceError, device); }

RTCScene rtcNewScene(RTCDevice device) { HEWN_FORWARD(rtcNewScene, device); }
void rtcReleaseScene(RTCScene scene) { HEWN_FORWARD(rtcReleaseScene, scene); }
void rtcCommitScene(RTCScene scene) { HEWN_FORWARD(rtcCommitScene, scene); }
void rtcSetSceneFlags(RTCScene scene, RTCSceneFlags flags) {
  HEWN_FORWARD(rtcSetSceneFlags, scene, flags);
}
void rtcSetSceneBuildQuality(RTCScene scene, RTCBuildQuality quality) {
  HEWN_FORWARD(rtcSetSceneBuildQuality, scene, quality);
}

RTCGeometry rtcNewGeometry(RTCDevice device, RTCGeometryType type) {
  HEWN_FORWARD(rtcNewGeometry, device, type);
}
void rtcReleaseGeometry(RTCGeometry geometry) { HEWN_FORWARD(rtcReleaseGeometry, geometry); }
void rtcCommitGeometry(RTCGeometry geometry) { HEWN_FORWARD(rtcCommitGeometry, geometry); }
unsigned rtcAttachGeometry(RTCScene scene, RTCGeometry geometry) {
  HEWN_FORWARD(rtcAttachGeometry, scene, geometry);
}
void* rtcSetNewGeometryBuffer(RTCGeometry geometry, RTCBufferType type, unsigned slot,
                              RTCFormat format, std::size_t stride, std::size_t count) {
  HEWN_FORWARD(rtcSetNewGeometryBuffer, geometry, type, slot, format, stride, count);
}

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
  HEWN_FORWARD(rtcIntersect1, scene, context, ray);
}
bool rtcPointQuery(RTCScene scene, RTCPointQuery* query, RTCPointQueryContext* context,
                   RTCPointQueryFunction visit, void* user) {
  HEWN_FORWARD(rtcPointQuery, scene, query, context, visit, user);
}

}  // extern "C"
