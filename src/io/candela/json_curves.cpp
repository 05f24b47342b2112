#include "io/candela/json_curves.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

namespace candela {

namespace {

constexpr std::string_view kBasisNames[] = {"bspline", "bezier"};

CurveBasis read_basis(JsonValue value, const std::string& element) {
  const std::string name = read_string(value, element);
  const auto found = std::ranges::find(kBasisNames, name);
  if (found == std::end(kBasisNames))
    throw input_error(value.where(), element, fmt::format("there is no basis '{}'", name.substr(0, 60)),
                      "give one of bspline, bezier");
  return static_cast<CurveBasis>(found - std::begin(kBasisNames));
}

float read_width(JsonValue value, const std::string& element) {
  const float width = read_real(value, element);
  if (!(width >= 0))
    throw input_error(value.where(), element, fmt::format("{} is below 0", width), "give a diameter");
  return width;
}

void read_points(JsonValue value, const std::string& element, Strands& out) {
  expect(value, JsonType::array, element);
  for (JsonValue point : value) {
    float p[3];
    read_reals(point, std::span<float>(p), element);
    out.points.emplace_back(p[0], p[1], p[2]);
  }
  const std::size_t count = value.size();
  if (curve_segments(out.basis, count) == 0)
    throw input_error(value.where(), element, fmt::format("{} control points", count),
                      out.basis == CurveBasis::bspline ? "give 4 or more to a B-spline"
                                                       : "give 4, 7, 10 … to Bezier curves");
  out.counts.push_back(static_cast<std::uint32_t>(count));
}

} // namespace

Strands read_json_strands(const JsonStrands& parts, JsonValue object, const std::string& element,
                          const WarningList& warnings) {
  Strands out;
  if (parts.source) out.source = read_string(*parts.source, element + ".source");
  if (parts.basis) out.basis = read_basis(*parts.basis, element + ".basis");
  if (!parts.strands || parts.strands->type() != JsonType::array || parts.strands->size() == 0)
    throw input_error((parts.strands ? *parts.strands : object).where(), element, "it has no strands",
                      "give \"strands\": [[[x, y, z], …], …], or a \"file\"");
  for (JsonValue strand : *parts.strands) {
    warnings.check_stop();
    read_points(strand, fmt::format("{}.strands[{}]", element, out.counts.size()), out);
  }
  if (parts.width && parts.widths)
    throw input_error(parts.widths->where(), element, "it has both width and widths", "keep one of them");
  if (!parts.width && !parts.widths)
    throw input_error(object.where(), element, "it has no width",
                      "give \"width\": d or [root, tip], or \"widths\": a list for each strand");
  if (parts.width) {
    const std::string name = element + ".width";
    if (parts.width->type() != JsonType::array) {
      out.widths.assign(2, read_width(*parts.width, name));
      return out;
    }
    if (parts.width->size() != 2)
      throw input_error(parts.width->where(), name, fmt::format("{} widths", parts.width->size()),
                        "give one, or those of root and tip");
    out.widths.clear();
    for (JsonValue value : *parts.width) out.widths.push_back(read_width(value, name));
    return out;
  }
  const std::string name = element + ".widths";
  expect(*parts.widths, JsonType::array, name);
  if (parts.widths->size() != out.counts.size())
    throw input_error(parts.widths->where(), name,
                      fmt::format("{} lists for {} strands", parts.widths->size(), out.counts.size()),
                      "give one for each strand");
  out.widths.clear();
  std::size_t strand = 0;
  for (JsonValue list : *parts.widths) {
    warnings.check_stop();
    const std::string which = fmt::format("{}[{}]", name, strand);
    expect(list, JsonType::array, which);
    if (list.size() != out.counts[strand])
      throw input_error(list.where(), which,
                        fmt::format("{} widths for {} control points", list.size(), out.counts[strand]),
                        "give one for each control point");
    for (JsonValue value : list) out.widths.push_back(read_width(value, which));
    ++strand;
  }
  return out;
}

std::string json_strands_members(const Strands& strands, std::string_view indent) {
  std::string out;
  if (strands.basis != Strands().basis)
    out += fmt::format("\"basis\": \"{}\", ", kBasisNames[static_cast<std::size_t>(strands.basis)]);
  /// [[of the first strand], [of the second], …], a line each.
  auto by_strand = [&](auto to_text) {
    std::string text;
    text.push_back('[');
    std::size_t at = 0;
    for (std::size_t strand = 0; strand < strands.counts.size(); ++strand) {
      text += fmt::format("{}\n{}  [", strand == 0 ? "" : ",", indent);
      for (std::uint32_t i = 0; i < strands.counts[strand]; ++i, ++at) {
        if (i > 0) text += ", ";
        text += to_text(at);
      }
      text.push_back(']');
    }
    text.push_back(']');
    return text;
  };
  out += "\"strands\": " + by_strand([&](std::size_t i) {
           const vec3 p = strands.points[i];
           return fmt::format("[{}, {}, {}]", p.x, p.y, p.z);
         });
  if (strands.has_width_per_point())
    out += fmt::format(",\n{}\"widths\": {}", indent,
                       by_strand([&](std::size_t i) { return fmt::format("{}", strands.widths[i]); }));
  else if (strands.widths[0] == strands.widths[1])
    out += fmt::format(",\n{}\"width\": {}", indent, strands.widths[0]);
  else
    out += fmt::format(",\n{}\"width\": [{}, {}]", indent, strands.widths[0], strands.widths[1]);
  if (!strands.source.empty()) out += fmt::format(",\n{}\"source\": {}", indent, json_quoted(strands.source));
  return out;
}

} // namespace candela
