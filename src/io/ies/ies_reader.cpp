#include "io/ies/ies_reader.h"

#include "io/files/file_bytes.h"
#include "io/files/text_file.h"
#include "io/ies/ies_words.h"

#include <fmt/format.h>

#include <filesystem>

namespace candela {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr int kMostAngles = 4096, kMostValues = 1 << 20;
constexpr double kLargestCandela = 1e9;

/// Edition of the standard, by the first line; the first edition has no such line.
int edition(std::string_view line) {
  if (line.starts_with("IESNA91")) return 1991;
  if (line.starts_with("IESNA:LM-63-1995")) return 1995;
  if (line.starts_with("IESNA:LM-63-2002")) return 2002;
  if (line.starts_with("IES:LM-63-2019")) return 2019;
  return 1986;
}

/// A grid of values by angles in degrees, as the file has it.
struct Measurement {
  std::vector<double> vertical, horizontal, candela;

  double value(std::size_t h, std::size_t v) const { return candela[h * vertical.size() + v]; }
  /// Adds the mirror images of all half planes but those at `about`; angles must be on one side of it.
  void mirror_horizontal(double about) {
    const bool below = horizontal.front() < about - 1e-6; // the images come after
    Measurement m{vertical, {}, {}};
    auto take = [&](std::size_t h, bool image) {
      m.horizontal.push_back(image ? 2 * about - horizontal[h] : horizontal[h]);
      for (std::size_t v = 0; v < vertical.size(); ++v) m.candela.push_back(value(h, v));
    };
    auto is_on_axis = [&](std::size_t h) { return std::abs(horizontal[h] - about) < 1e-6; };
    const std::size_t n = horizontal.size();
    auto images = [&] {
      for (std::size_t h = n; h-- > 0;)
        if (!is_on_axis(h)) take(h, true);
    };
    if (!below) images();
    for (std::size_t h = 0; h < n; ++h) take(h, false);
    if (below) images();
    *this = std::move(m);
  }
  /// Of angles from 0 up: their images below the equator.
  void mirror_vertical() {
    Measurement m{{}, horizontal, {}};
    const std::size_t n = vertical.size();
    for (std::size_t v = n; v-- > 1;) m.vertical.push_back(-vertical[v]);
    m.vertical.insert(m.vertical.end(), vertical.begin(), vertical.end());
    for (std::size_t h = 0; h < horizontal.size(); ++h) {
      for (std::size_t v = n; v-- > 1;) m.candela.push_back(value(h, v));
      for (std::size_t v = 0; v < n; ++v) m.candela.push_back(value(h, v));
    }
    *this = std::move(m);
  }
};

class IesParser {
public:
  IesParser(std::string_view text, const std::string& file, WarningList& warnings)
      : file_(file), words_(text, file), warnings_(warnings) {}

  IesProfile parse() {
    read_head();
    read_counts();
    read_angles();
    read_values();
    complete();
    return profile();
  }

private:
  void read_head() {
    for (bool first = true;; first = false) {
      if (words_.at_end())
        throw input_error({file_}, "photometry", "no line TILT= is in it", "give a file of IESNA LM-63");
      const std::string_view line = words_.line();
      if (first) edition_ = edition(line);
      if (!line.starts_with("TILT")) continue;
      const std::size_t sign = line.find('=');
      if (sign == std::string_view::npos || !trimmed(line.substr(4, sign - 4)).empty()) continue;
      const std::string_view tilt = trimmed(line.substr(sign + 1));
      if (tilt == "INCLUDE") {
        warnings_.add(words_.where(), "what its lamps do when they are tilted (TILT) is not applied");
        read_tilt();
      } else if (tilt != "NONE") {
        warnings_.add(words_.where(), fmt::format("the file '{}' that TILT names is not read",
                                                  utf8_name(tilt.substr(0, 40))));
      }
      return;
    }
  }

  /// Lamp-to-luminaire geometry, then pairs of angles and factors.
  void read_tilt() {
    words_.choice("lamp geometry", 3);
    const int pairs = words_.count("tilt angles", 0, kMostAngles);
    words_.expect(2 * static_cast<std::size_t>(pairs), "tilt angles");
    for (int i = 0; i < pairs; ++i) words_.number("tilt angle");
    for (int i = 0; i < pairs; ++i) words_.number("tilt factor");
  }

  double positive(std::string_view element) {
    const double value = words_.number(element);
    if (!(value > 0))
      throw input_error(words_.where(), element, fmt::format("{} is not above 0", value),
                        "give a factor above 0");
    return value;
  }

  void read_counts() {
    words_.count("lamps", 0, 1 << 20);
    words_.number("lumens per lamp"); // -1: absolute photometry; the values are candela in any case
    scale_ = positive("multiplier");
    vertical_count_ = words_.count("vertical angles", 1, kMostAngles);
    horizontal_count_ = words_.count("horizontal angles", 1, kMostAngles);
    if (vertical_count_ > kMostValues / horizontal_count_)
      throw limit_error(words_.where(), "angles",
                        fmt::format("{} x {} values are more than the {} that are read", vertical_count_,
                                    horizontal_count_, kMostValues),
                        "give a coarser measurement");
    constexpr PhotometricType kTypes[] = {PhotometricType::c, PhotometricType::b, PhotometricType::a};
    type_ = kTypes[words_.choice("photometric type", 3) - 1];
    words_.choice("units", 2);
    for (const char* side : {"width", "length", "height"}) words_.number(side); // negative: round shapes
    scale_ *= positive("ballast factor");
    const double lamp_factor = words_.number("ballast-lamp factor");
    // The editions from 1995 on keep the place for future use.
    if (edition_ < 1995 && lamp_factor > 0) scale_ *= lamp_factor;
    words_.number("input watts");
    const auto v = static_cast<std::size_t>(vertical_count_), h = static_cast<std::size_t>(horizontal_count_);
    words_.expect(v + h + v * h, "candela values");
  }

  std::vector<double> ascending(std::string_view element, int count, double least, double most) {
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) {
      const double angle = words_.number(element);
      if (!(angle >= least && angle <= most))
        throw input_error(words_.where(), element,
                          fmt::format("{} is not in {} to {} degrees", angle, least, most),
                          "give the angles of the photometric type");
      if (i > 0 && !(angle > angles.back()))
        throw input_error(words_.where(), element, fmt::format("{} follows {}", angle, angles.back()),
                          "give angles that ascend");
      angles.push_back(angle);
    }
    return angles;
  }

  void read_angles() {
    const bool polar = type_ == PhotometricType::c;
    grid_.vertical = ascending("vertical angles", vertical_count_, polar ? 0 : -90, polar ? 180 : 90);
    grid_.horizontal = ascending("horizontal angles", horizontal_count_, polar ? 0 : -90, polar ? 360 : 90);
  }

  void read_values() {
    bool negative = false;
    grid_.candela.reserve(grid_.vertical.size() * grid_.horizontal.size());
    for (std::size_t h = 0; h < grid_.horizontal.size(); ++h) {
      warnings_.check_stop();
      for (std::size_t v = 0; v < grid_.vertical.size(); ++v) {
        const double value = words_.number("candela values") * scale_;
        if (value > kLargestCandela)
          throw input_error(words_.where(), "candela values",
                            fmt::format("{:g} cd with its factors is above {:g} cd", value, kLargestCandela),
                            "give candela");
        negative |= value < 0;
        grid_.candela.push_back(std::max(value, 0.0));
      }
    }
    if (negative) warnings_.add({file_}, "negative candela values are taken for 0");
    if (words_.more()) warnings_.add(words_.where(), "what follows the last candela value is ignored");
  }

  /// All around, by the symmetry that the range of the angles tells.
  void complete() {
    const auto is = [](double angle, double expected) { return std::abs(angle - expected) < 1e-3; };
    const double first = grid_.horizontal.front(), last = grid_.horizontal.back();
    if (type_ != PhotometricType::c) {
      // Half planes at 0 alone would be a cut, of which nobody knows the rest.
      if (grid_.horizontal.size() < 2) fail_symmetry(first, last);
      if (is(first, 0)) grid_.mirror_horizontal(0);
      if (is(grid_.vertical.front(), 0)) grid_.mirror_vertical();
      return;
    }
    if (grid_.horizontal.size() == 1) return; // the same all around
    if (is(first, 0) && is(last, 90)) {
      grid_.mirror_horizontal(90);
      grid_.mirror_horizontal(180);
    } else if (is(first, 0) && is(last, 180)) {
      grid_.mirror_horizontal(180);
    } else if (is(first, 90) && is(last, 270)) {
      grid_.mirror_horizontal(270); // symmetric about the plane of 90 and 270 degrees
    } else if (last - first > 180 && !is(last - first, 360)) {
      // A whole turn whose last half plane is not repeated.
      grid_.horizontal.push_back(first + 360);
      for (std::size_t v = 0; v < grid_.vertical.size(); ++v) grid_.candela.push_back(grid_.value(0, v));
    } else if (!is(last - first, 360)) {
      fail_symmetry(first, last);
    }
  }

  [[noreturn]] void fail_symmetry(double first, double last) const {
    throw input_error({file_}, "horizontal angles",
                      fmt::format("from {} to {} degrees they have no known symmetry", first, last),
                      "measure 0, 0 to 90, 0 to 180, 90 to 270 or 0 to 360 degrees");
  }

  IesProfile profile() const {
    IesProfile p;
    p.name = std::filesystem::path(file_).filename().string();
    p.source = file_;
    p.type = type_;
    const double pole = type_ == PhotometricType::c ? 0 : 90; // others count from the equator
    auto radians_of = [](double angle) { return static_cast<float>(angle * std::numbers::pi / 180); };
    for (double angle : grid_.vertical) p.vertical.push_back(radians_of(angle + pole));
    for (double angle : grid_.horizontal) p.horizontal.push_back(radians_of(angle));
    for (double value : grid_.candela) p.candela.push_back(static_cast<float>(value));
    if (const std::string_view problem = ies_profile_problem(p);
        !problem.empty()) // angles less than a float apart
      throw input_error({file_}, "photometry", problem, "give angles that a float tells apart");
    return p;
  }

  std::string file_;
  IesWords words_;
  WarningList& warnings_;
  int edition_ = 1986;
  PhotometricType type_ = PhotometricType::c;
  double scale_ = 1;
  int vertical_count_ = 0, horizontal_count_ = 0;
  Measurement grid_;
};

} // namespace

IesProfile parse_ies(std::string_view text, const std::string& file, WarningList& warnings) {
  return IesParser(text, file, warnings).parse();
}

std::shared_ptr<const IesProfile> read_ies(const std::string& path, WarningList& warnings) {
  // Descriptions are in any encoding, so the bytes are not taken for a text file.
  const std::string text = read_file_characters(path, "photometry", kMaxBytes, &warnings.progress());
  return std::make_shared<const IesProfile>(parse_ies(text, path, warnings));
}

} // namespace candela
