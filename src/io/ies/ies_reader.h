#pragma once
// Photometric files of luminaires: IESNA LM-63 of 1986, 1991, 1995, 2002 and 2019.

#include "io/files/warning_list.h"
#include "lights/ies_profile.h"

#include <memory>
#include <string>
#include <string_view>

namespace candela {

/// Reads a file of LM-63. Half and quarter measurements are completed by their symmetry; the multiplier and
/// the ballast factors are in the values. What lamps do when they are tilted is checked but not applied, with
/// a warning. Throws input_error where the text is not what the format says ("lamp.ies:12:3: vertical angles:
/// cause: remedy"), limit_error above the caps, before anything is allocated, and Cancelled.
std::shared_ptr<const IesProfile> read_ies(const std::string& path, WarningList& warnings);

/// The same of a text in memory; `file` is what messages call it.
IesProfile parse_ies(std::string_view text, const std::string& file, WarningList& warnings);

} // namespace candela
