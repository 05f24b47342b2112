#include "io/images/exr_layers.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace candela {

namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// How well the name fits the main image; 0: not at all.
int fitness(const std::string& name) {
  const std::string last = lower(name.substr(name.rfind('.') + 1)); // npos + 1 is 0
  if (last == "combined" || last == "beauty" || last == "rgba") return 2;
  return name.empty() ? 1 : 0;
}

/// Appends the colour layers of a part.
void add_layers(const Imf::Header& header, int part, std::vector<ExrLayer>& layers) {
  // By prefix ("diffuse."), in the order of the file: the channels' names in capitals.
  std::vector<std::pair<std::string, std::map<std::string, std::string>>> prefixes;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    const std::string full = i.name(), prefix = full.substr(0, full.rfind('.') + 1);
    auto known = std::ranges::find_if(prefixes, [&](const auto& p) { return p.first == prefix; });
    if (known == prefixes.end()) {
      prefixes.emplace_back().first = prefix;
      known = prefixes.end() - 1;
    }
    known->second.emplace(lower(full.substr(prefix.size())), full);
  }
  for (const auto& [prefix, channels] : prefixes) {
    auto named = [&channels = channels](const char* key) {
      auto found = channels.find(key);
      return found == channels.end() ? std::string() : found->second;
    };
    ExrLayer layer{part, prefix.substr(0, prefix.size() - !prefix.empty()), named("r"), named("g"),
                   named("b")};
    if (layer.r.empty() && layer.g.empty() && layer.b.empty()) {
      // Y together with X and Z is a coordinate.
      if (channels.contains("x") || channels.contains("z")) continue;
      layer.r = layer.g = layer.b = named("y");
      if (layer.r.empty()) continue;
      layer.luminance_chroma =
          part == 0 && prefix.empty() && channels.contains("ry") && channels.contains("by");
    }
    if (header.hasName() && header.name() != layer.name)
      layer.name = header.name() + (layer.name.empty() ? "" : "." + layer.name);
    layers.push_back(std::move(layer));
  }
}

std::string shown(const ExrLayer& layer) {
  return layer.name.empty() ? "(without a name)" : fmt::format("'{}'", layer.name.substr(0, 60));
}

} // namespace

ExrLayer choose_exr_layer(const Imf::MultiPartInputFile& file, const Location& where, WarningList* warnings) {
  constexpr std::size_t kLongestList = 200;
  std::vector<ExrLayer> layers;
  std::string names;
  bool deep = false;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (header.hasType() && Imf::isDeepData(header.type())) {
      deep = true;
      continue;
    }
    add_layers(header, part, layers);
    for (auto i = header.channels().begin(); i != header.channels().end() && names.size() < kLongestList; ++i)
      names += (names.empty() ? "" : ", ") + std::string(i.name());
  }
  if (layers.empty() && deep && names.empty())
    throw input_error(where, "image", "its pixels are deep", "flatten it");
  if (layers.empty())
    throw input_error(where, "image", fmt::format("its channels are {}", names.empty() ? "none" : names),
                      "give it R, G, B or Y");
  const auto best = std::ranges::max_element(layers, {}, [](const ExrLayer& l) { return fitness(l.name); });
  std::string others;
  for (const ExrLayer& layer : layers)
    if (&layer != &*best && others.size() < kLongestList)
      others += (others.empty() ? "" : ", ") + shown(layer);
  if (warnings && !others.empty())
    warnings->add(where, fmt::format("of its layers {} is taken; the others are {}", shown(*best), others));
  return *best;
}

} // namespace candela
