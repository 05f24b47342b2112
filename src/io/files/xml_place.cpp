#include "io/files/xml_place.h"

#include "io/files/text_file.h"

namespace candela {

Location XmlPlaces::offset(std::size_t offset) const { return locate(file_, text_, offset); }

Location XmlPlaces::element(pugi::xml_node node) const {
  auto name = node.offset_debug(); // the name's offset, one past the '<'
  return name <= 0 ? Location{file_} : offset(static_cast<std::size_t>(name) - 1);
}

Location XmlPlaces::attribute(pugi::xml_attribute wanted, pugi::xml_node node) const {
  auto name = node.offset_debug();
  if (name <= 0) return element(node);
  // pugixml has checked that the start tag is well-formed: name="value" name='value' …
  std::size_t i = static_cast<std::size_t>(name) + std::string_view(node.name()).size();
  for (pugi::xml_attribute attribute : node.attributes()) {
    i = text_.find_first_not_of(" \t\r\n", i);
    if (i == std::string_view::npos) break;
    if (attribute == wanted) return offset(i);
    std::size_t open = text_.find_first_of("\"'", i);
    if (open == std::string_view::npos) break;
    std::size_t close = text_.find(text_[open], open + 1);
    if (close == std::string_view::npos) break;
    i = close + 1;
  }
  return element(node);
}

} // namespace candela
