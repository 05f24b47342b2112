#pragma once
// What Candela uses of Open Image Denoise's C++ API (the same in 1.4 and 2.x), around an identity filter.

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#define OIDN_VERSION_STRING "0.0.0"

namespace oidn {

enum class DeviceType { Default, CPU };
enum class Format { Undefined, Float, Float2, Float3 };
enum class Error {
  None,
  Unknown,
  InvalidArgument,
  InvalidOperation,
  OutOfMemory,
  UnsupportedHardware,
  Cancelled
};
typedef bool (*ProgressMonitorFunction)(void* user, double n);

/// What tests see and set; no part of the API.
struct StandIn {
  struct Image {
    float* data = nullptr;
    std::size_t width = 0, height = 0;
  };
  DeviceType device = DeviceType::Default;
  std::map<std::string, int> parameters;
  std::map<std::string, Image> images;
  std::function<void()> at_half; ///< called half-way, before the progress monitor
  Error error = Error::None;     ///< to be given when next asked
};
inline StandIn stand_in;

class FilterRef {
public:
  void setImage(const char* name, void* data, Format format, std::size_t width, std::size_t height) {
    if (format != Format::Float3) stand_in.error = Error::InvalidArgument;
    stand_in.images[name] = {static_cast<float*>(data), width, height};
  }
  void set(const char* name, bool value) { stand_in.parameters[name] = value; }
  void setProgressMonitorFunction(ProgressMonitorFunction function, void* user = nullptr) {
    monitor_ = function;
    user_ = user;
  }
  void commit() { committed_ = true; }
  void execute() {
    if (!committed_) stand_in.error = Error::InvalidOperation;
    if (stand_in.error != Error::None) return;
    if (stand_in.at_half) stand_in.at_half();
    if (monitor_ && !monitor_(user_, 0.5)) {
      stand_in.error = Error::Cancelled;
      return;
    }
    const StandIn::Image& color = stand_in.images["color"];
    const std::size_t values = 3 * color.width * color.height;
    for (std::size_t i = 0; i < values; ++i) stand_in.images["output"].data[i] = color.data[i];
  }

private:
  ProgressMonitorFunction monitor_ = nullptr;
  void* user_ = nullptr;
  bool committed_ = false;
};

class DeviceRef {
public:
  void set(const char* name, bool value) { stand_in.parameters[name] = value; }
  void set(const char* name, int value) { stand_in.parameters[name] = value; }
  void commit() {}
  FilterRef newFilter(const char*) const { return {}; }
  Error getError(const char*& message) {
    message = "made to fail";
    const Error error = stand_in.error;
    stand_in.error = Error::None;
    return error;
  }
};

inline DeviceRef newDevice(DeviceType type = DeviceType::Default) {
  stand_in = {type, {}, {}, std::move(stand_in.at_half), stand_in.error};
  return {};
}

} // namespace oidn
