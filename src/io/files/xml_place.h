#pragma once
// Locations in XML files: pugixml stores offsets of elements but not of attributes.

#include "core/error.h"

#include <pugixml.hpp>

#include <string>
#include <string_view>

namespace candela {

class XmlPlaces {
public:
  XmlPlaces(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {}

  /// Location of an element's '<'.
  Location element(pugi::xml_node node) const;
  /// Location of an attribute's name.
  Location attribute(pugi::xml_attribute attribute, pugi::xml_node node) const;
  Location offset(std::size_t offset) const;

private:
  std::string file_;
  std::string_view text_;
};

} // namespace candela
