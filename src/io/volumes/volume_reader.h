#pragma once
// Files of smoke, cloud and fire: Candela's own (cvol_file.h), Mitsuba's .vol, OpenVDB's .vdb and NanoVDB's
// .nvdb.

#include "io/files/file_bytes.h"
#include "io/files/warning_list.h"
#include "media/volume_grid.h"

#include <memory>
#include <string>
#include <string_view>

namespace candela {

/// Endings of such files, in lower case.
inline constexpr std::string_view kVolumeEndings[] = {".cvol", ".vol", ".vdb", ".nvdb"};
/// By its ending.
bool is_volume_name(std::string_view path);

/// Reads such a file; its content tells the format. Negative, infinite and undefined values are taken for 0,
/// with a warning of how many. Temperatures above 1 are divided by the largest one, colours above 1 taken for
/// 1, with a warning. Throws input_error where the file is not what its format says ("smoke.vdb: grid
/// 'density': cause: remedy"), limit_error above VolumeGrid::kMaxCells, before anything is allocated for
/// them, and Cancelled.
std::shared_ptr<const VolumeGrid> read_volume(const std::string& path, WarningList& warnings);

/// The same of bytes in memory; `file` is what messages call them.
VolumeGrid parse_volume(ByteView bytes, const std::string& file, WarningList& warnings);

} // namespace candela
