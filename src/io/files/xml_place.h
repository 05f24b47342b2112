#pragma once
// Places in XML files: pugixml keeps an element's offset, not its attributes'.

#include "core/error.h"

#include <pugixml.hpp>

#include <string>
#include <string_view>

namespace candela {

class XmlPlaces {
public:
  XmlPlaces(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {}

  /// Of the '<' of an element.
  Location element(pugi::xml_node node) const;
  /// Of an attribute's name.
  Location attribute(pugi::xml_attribute attribute, pugi::xml_node node) const;
  Location offset(std::size_t offset) const;

private:
  std::string file_;
  std::string_view text_;
};

} // namespace candela
