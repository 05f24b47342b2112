#pragma once
// What the readers of volumes share: a place in the bytes of a file, limits, and the values that are allowed.

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/warning_list.h"
#include "media/volume_grid.h"

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace candela {

/// Takes values off the front of bytes. What would be beyond their end is an input_error.
class VolumeBytes {
public:
  VolumeBytes(ByteView bytes, const std::string& file) : all_(bytes), file_(&file) {}

  const std::string& file() const { return *file_; }
  std::size_t position() const { return position_; }
  std::size_t left() const { return all_.size() - position_; }

  /// The next bytes.
  ByteView take(std::uint64_t count) {
    if (count > left()) throw ends_early();
    const ByteView taken = all_.subspan(position_, static_cast<std::size_t>(count));
    position_ += taken.size();
    return taken;
  }
  /// The next value, little-endian.
  template <class T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T out;
    std::memcpy(&out, take(sizeof(T)).data(), sizeof(T));
    return out;
  }
  /// To a place from the start.
  void seek(std::uint64_t position) {
    if (position > all_.size()) throw ends_early();
    position_ = static_cast<std::size_t>(position);
  }

  Error wrong(std::string_view element, std::string_view cause,
              std::string_view remedy = "write the file again") const {
    return input_error({file()}, element, cause, remedy);
  }

private:
  Error ends_early() const { return wrong("volume", "the file ends early", "give the whole file"); }

  ByteView all_;
  const std::string* file_;
  std::size_t position_ = 0;
};

/// Throws input_error where an axis has no cell, and limit_error where there are more than
/// VolumeGrid::kMaxCells of them.
void check_volume_cells(const std::string& file, std::int64_t x, std::int64_t y, std::int64_t z);

/// The bounds of the file. Throws input_error where they are not finite or empty.
Bounds3 checked_volume_bounds(const std::string& file, glm::dvec3 lo, glm::dvec3 hi);

/// Makes the values what VolumeGrid promises, with warnings of what was changed.
void clean_volume_values(VolumeGrid& grid, const std::string& file, WarningList& warnings);

// One for each format; volume_reader.h tells of all.
bool is_cvol(ByteView bytes);
VolumeGrid parse_cvol(ByteView bytes, const std::string& file, WarningList& warnings);
bool is_mitsuba_volume(ByteView bytes);
VolumeGrid parse_mitsuba_volume(ByteView bytes, const std::string& file, WarningList& warnings);
bool is_openvdb(ByteView bytes);
VolumeGrid parse_openvdb(ByteView bytes, const std::string& file, WarningList& warnings);
bool is_nanovdb(ByteView bytes);
VolumeGrid parse_nanovdb(ByteView bytes, const std::string& file, WarningList& warnings);

} // namespace candela
