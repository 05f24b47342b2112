#include "app/figures/gallery.h"

#include "core/error.h"
#include "io/candela/json_fields.h"
#include "io/files/path_policy.h"
#include "io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace candela {

namespace {

constexpr std::size_t kMaxGalleryBytes = std::size_t{1} << 24;
constexpr int kMaxSpp = 1 << 24;
constexpr std::uint32_t kMaxFigures = 1000, kMaxPanels = 64, kMaxDetails = 8, kMaxPlotPoints = 64;
/// Limit of the pixels of all panels of a figure.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 27;

class GalleryReader {
public:
  explicit GalleryReader(const std::string& path)
      : folder_(folder_of(path)), policy_(folder_, false),
        tree_(path, read_text_file(path, "gallery", kMaxGalleryBytes)) {}

  std::vector<GalleryFigure> run() {
    constexpr std::string_view kKeys[] = {"gallery", "figures"};
    const JsonValue root = tree_.root();
    expect(root, JsonType::object, "gallery");
    bool versioned = false;
    for (auto [key, value] : root.members()) {
      if (key.string() == "gallery")
        read_integer(value, "gallery", 1, 1), versioned = true;
      else if (key.string() == "figures")
        figures(value);
      else
        throw unknown_key(key, "gallery", kKeys);
    }
    if (!versioned)
      throw input_error(root.where(), "gallery", "the key \"gallery\" is missing",
                        "say \"gallery\": 1, the version of the format, in the outermost object");
    return std::move(figures_);
  }

private:
  static void expect_few(JsonValue array, std::uint32_t most, std::string_view element) {
    expect(array, JsonType::array, element);
    if (array.size() > most)
      throw limit_error(array.where(), element, fmt::format("{} elements", array.size()),
                        fmt::format("give at most {}", most));
  }

  static bool read_boolean(JsonValue value, std::string_view element) {
    expect(value, JsonType::boolean, element);
    return value.boolean();
  }

  /// {"key": value} as KEY=VALUE, each checked against its row.
  static void settings(JsonValue object, std::vector<std::string>& out, const std::string& element) {
    expect(object, JsonType::object, element);
    std::vector<std::string_view> known;
    for (const auto& row : settings_table()) known.push_back(row.key);
    for (auto [key, value] : object.members()) {
      const std::string name = fmt::format("{}.{}", element, key.string());
      const auto* row = find_setting(key.string());
      if (row == nullptr) throw unknown_key(key, element, known);
      if (row->key == "film.width" || row->key == "film.height" || row->key.starts_with("stop."))
        throw input_error(key.where(), element, fmt::format("'{}' has a key of its own", row->key),
                          "use \"size\" and \"spp\" of the figure");
      Document document;
      read_field(*row, row->address(document), value, name);
      out.push_back(fmt::format("{}={}", row->key, field_text(*row, document)));
    }
  }

  std::string scene(JsonValue value, const std::string& element) const {
    return policy_.require(read_string(value, element), folder_, value.where(), element).shown;
  }

  void figures(JsonValue array) {
    expect_few(array, kMaxFigures, "figures");
    std::set<std::string> names;
    for (JsonValue object : array) {
      const std::string element = fmt::format("figures[{}]", figures_.size());
      figures_.push_back(figure(object, element));
      if (!names.insert(figures_.back().name).second)
        throw input_error(object.where(), element,
                          fmt::format("the name '{}' is taken", figures_.back().name), "give it another");
    }
  }

  GalleryFigure figure(JsonValue object, const std::string& element) {
    constexpr std::string_view kKeys[] = {"name",    "title",     "scene",      "size",
                                          "spp",     "settings",  "panels",     "columns",
                                          "details", "reference", "difference", "plot"};
    expect(object, JsonType::object, element);
    GalleryFigure out;
    GalleryPanel common;
    std::optional<JsonValue> panels, details;
    for (auto [key, value] : object.members()) {
      const std::string name = fmt::format("{}.{}", element, key.string());
      if (key.string() == "name")
        out.name = file_name(value, name);
      else if (key.string() == "title")
        out.title = read_string(value, name);
      else if (key.string() == "scene")
        common.scene = scene(value, name);
      else if (key.string() == "size")
        out.size = size(value, name);
      else if (key.string() == "spp")
        common.spp = read_integer(value, name, 1, kMaxSpp);
      else if (key.string() == "settings")
        settings(value, common.settings, name);
      else if (key.string() == "panels")
        panels = value;
      else if (key.string() == "columns")
        out.columns = read_integer(value, name, 1, static_cast<int>(kMaxPanels));
      else if (key.string() == "details")
        details = value;
      else if (key.string() == "reference")
        out.reference = reference(value, name);
      else if (key.string() == "difference")
        out.difference = read_boolean(value, name);
      else if (key.string() == "plot")
        out.plot = plot(value, name);
      else
        throw unknown_key(key, element, kKeys);
    }
    if (out.name.empty())
      throw input_error(object.where(), element, "it has no name", "give it a \"name\" for its file");
    out.plain = !panels;
    if (panels)
      read_panels(*panels, common, out, element + ".panels");
    else if (common.scene.empty())
      throw input_error(object.where(), element, "it has no scene", "give it a \"scene\"");
    else
      out.panels.push_back(common);
    if (details) read_details(*details, out, element + ".details");
    check(object, out, element);
    return out;
  }

  static void check(JsonValue object, const GalleryFigure& figure, const std::string& element) {
    auto refuse = [&](std::string_view cause, std::string_view remedy) {
      return input_error(object.where(), element, cause, remedy);
    };
    const bool compares = figure.reference || figure.difference || figure.plot || !figure.details.empty();
    if (figure.plain && compares) throw refuse("a plain picture has no reference", "give it \"panels\"");
    if ((figure.difference || figure.plot) && !figure.reference)
      throw refuse("difference and plot need a reference", "give it a \"reference\"");
    const auto pixels = std::int64_t{figure.size.x} * figure.size.y;
    if (pixels * static_cast<std::int64_t>(figure.panels.size()) > kMaxPixels)
      throw limit_error(object.where(), element, "its panels have too many pixels", "make them smaller");
  }

  static std::string file_name(JsonValue value, const std::string& element) {
    std::string name = read_string(value, element);
    constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    if (name.empty() || name.size() > 100 || name.find_first_not_of(kAllowed) != std::string::npos)
      throw input_error(value.where(), element, "it is no name of a file",
                        "use up to 100 letters, digits, '-' and '_'");
    return name;
  }

  static ivec2 size(JsonValue value, const std::string& element) {
    ivec2 out(0);
    expect(value, JsonType::array, element);
    if (value.size() != 2)
      throw input_error(value.where(), element, fmt::format("{} elements", value.size()),
                        "give [width, height]");
    Document document;
    int i = 0;
    for (JsonValue part : value) {
      const auto& row = *find_setting(i == 0 ? "film.width" : "film.height");
      read_field(row, row.address(document), part, element);
      out[i++] = *static_cast<int*>(row.address(document));
    }
    return out;
  }

  GalleryReference reference(JsonValue object, const std::string& element) const {
    constexpr std::string_view kKeys[] = {"spp", "settings", "show"};
    expect(object, JsonType::object, element);
    GalleryReference out;
    for (auto [key, value] : object.members()) {
      const std::string name = fmt::format("{}.{}", element, key.string());
      if (key.string() == "spp")
        out.spp = read_integer(value, name, 1, kMaxSpp);
      else if (key.string() == "settings")
        settings(value, out.settings, name);
      else if (key.string() == "show")
        out.show = read_boolean(value, name);
      else
        throw unknown_key(key, element, kKeys);
    }
    return out;
  }

  static GalleryPlot plot(JsonValue object, const std::string& element) {
    constexpr std::string_view kKeys[] = {"spp", "x"};
    constexpr std::string_view kAxes[] = {"samples", "seconds"};
    expect(object, JsonType::object, element);
    GalleryPlot out;
    for (auto [key, value] : object.members()) {
      const std::string name = fmt::format("{}.{}", element, key.string());
      if (key.string() == "spp") {
        expect_few(value, kMaxPlotPoints, name);
        for (JsonValue number : value) out.spp.push_back(read_integer(number, name, 1, kMaxSpp));
      } else if (key.string() == "x") {
        const std::string axis = read_string(value, name);
        if (std::ranges::find(kAxes, axis) == std::end(kAxes))
          throw input_error(value.where(), name, fmt::format("there is no axis '{}'", axis.substr(0, 60)),
                            "give \"samples\" or \"seconds\"");
        out.over_seconds = axis == kAxes[1];
      } else {
        throw unknown_key(key, element, kKeys);
      }
    }
    if (out.spp.size() < 2 || std::ranges::adjacent_find(out.spp, std::greater_equal()) != out.spp.end())
      throw input_error(object.where(), element, "\"spp\" does not rise",
                        "list two samples a pixel or more, each above the one before");
    return out;
  }

  void read_panels(JsonValue array, const GalleryPanel& common, GalleryFigure& out,
                   const std::string& element) const {
    constexpr std::string_view kKeys[] = {"label", "scene", "settings", "spp"};
    expect_few(array, kMaxPanels, element);
    if (array.size() == 0)
      throw input_error(array.where(), element, "it is empty", "leave it out for a plain picture");
    for (JsonValue object : array) {
      const std::string own = fmt::format("{}[{}]", element, out.panels.size());
      expect(object, JsonType::object, own);
      GalleryPanel panel = common;
      for (auto [key, value] : object.members()) {
        const std::string name = fmt::format("{}.{}", own, key.string());
        if (key.string() == "label")
          panel.label = read_string(value, name);
        else if (key.string() == "scene") {
          panel.scene = scene(value, name);
          if (out.reference && panel.scene != common.scene)
            throw input_error(value.where(), name, "one reference cannot be that of two scenes",
                              "leave out this scene or the figure's \"reference\"");
        } else if (key.string() == "settings")
          settings(value, panel.settings, name);
        else if (key.string() == "spp")
          panel.spp = read_integer(value, name, 1, kMaxSpp);
        else
          throw unknown_key(key, own, kKeys);
      }
      if (panel.scene.empty())
        throw input_error(object.where(), own, "it has no scene", "give it or its figure a \"scene\"");
      out.panels.push_back(std::move(panel));
    }
  }

  static void read_details(JsonValue array, GalleryFigure& out, const std::string& element) {
    expect_few(array, kMaxDetails, element);
    for (JsonValue box : array) {
      const std::string own = fmt::format("{}[{}]", element, out.details.size());
      expect(box, JsonType::array, own);
      if (out.size.x == 0)
        throw input_error(box.where(), own, "the figure has no size", "give it a \"size\"");
      if (box.size() != 4)
        throw input_error(box.where(), own, fmt::format("{} elements", box.size()),
                          "give [x, y, width, height]");
      int v[4] = {0, 0, 0, 0};
      int i = 0;
      for (JsonValue part : box) {
        // The box must lie within the picture.
        const int side = i % 2 == 0 ? out.size.x : out.size.y;
        const int most = i < 2 ? side - 1 : side - v[i - 2];
        v[i] = read_integer(part, own, i < 2 ? 0 : 1, most);
        ++i;
      }
      out.details.push_back({v[0], v[1], v[2], v[3]});
    }
  }

  std::string folder_;
  PathPolicy policy_;
  JsonTree tree_;
  std::vector<GalleryFigure> figures_;
};

} // namespace

std::vector<GalleryFigure> read_gallery(const std::string& path) { return GalleryReader(path).run(); }

} // namespace candela
