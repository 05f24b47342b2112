#include "app/bench/scale_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace candela {

namespace {

using Row = std::vector<std::string>;

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.0f}", static_cast<double>(bytes) / (1 << 20));
}

/// "0.034", "2.1", "340": three digits.
std::string seconds(double s) {
  return s < 0.9995  ? fmt::format("{:.3f}", s)
         : s < 9.995 ? fmt::format("{:.2f}", s)
                     : fmt::format("{:.1f}", s);
}

Row heading(int threads) {
  return {"scene",
          "triangles",
          "placed",
          "lights",
          "read, s",
          "build, s",
          "first image, s",
          "BVH, MiB",
          "peak, MiB",
          "Msamples/s, 1 thread",
          fmt::format("{} threads", threads),
          "ratio"};
}

Row row_of(const ScaleResult& r) {
  return {r.name,
          r.spheres > 0 ? fmt::format("{} + {} spheres", grouped_digits(r.distinct_triangles),
                                      grouped_digits(r.spheres))
                        : grouped_digits(r.distinct_triangles),
          r.placed_triangles > r.distinct_triangles ? grouped_digits(r.placed_triangles) : "",
          grouped_digits(r.lights),
          seconds(r.load_s),
          seconds(r.build_s),
          seconds(r.to_first_image_s()),
          fmt::format("{:.1f}", static_cast<double>(r.accel_bytes) / (1 << 20)),
          megabytes(r.peak_bytes),
          fmt::format("{:.2f}", r.samples_per_s_one / 1e6),
          fmt::format("{:.2f}", r.samples_per_s / 1e6),
          fmt::format("{:.2f}", r.speedup)};
}

std::string table(const std::vector<Row>& rows, TableFormat format) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      if (format == TableFormat::markdown)
        out += fmt::format("| {} ", rows[r][i]);
      else if (i == 0)
        out += fmt::format("{:<{}}", rows[r][i], widths[i]);
      else
        out += fmt::format("  {:>{}}", rows[r][i], widths[i]);
    }
    out += format == TableFormat::markdown ? "|\n" : "\n";
    if (format == TableFormat::markdown && r == 0) {
      for (std::size_t i = 0; i < rows[r].size(); ++i) out += "|---";
      out += "|\n";
    }
  }
  return out;
}

std::string table(const std::vector<ScaleResult>& results, TableFormat format) {
  if (results.empty()) return {};
  std::vector<Row> rows = {heading(results.front().threads)};
  for (const ScaleResult& r : results) rows.push_back(row_of(r));
  return table(rows, format) + "\n";
}

PlotSeries series(std::string label, const std::vector<ScaleResult>& results) {
  PlotSeries out{std::move(label), {}, false};
  for (const ScaleResult& r : results)
    out.points.push_back({static_cast<double>(r.placed_triangles), r.samples_per_s / 1e6});
  return out;
}

} // namespace

std::string grouped_digits(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (int i = static_cast<int>(text.size()) - 3; i > 0; i -= 3) text.insert(text.begin() + i, ',');
  return text;
}

std::string scale_tables(const ScaleReport& report, TableFormat format) {
  std::string out;
  for (const auto* results : {&report.scenes, &report.landscapes, &report.stones})
    out += table(*results, format);
  if (!report.scenes.empty() || !report.landscapes.empty()) {
    const ScaleResult& first = report.scenes.empty() ? report.landscapes.front() : report.scenes.front();
    out +=
        fmt::format("Pictures of {}x{}; the first image has one sample a pixel, and its seconds hold reading "
                    "and building. The machine's load was {:.1f} before and {:.1f} in the end.\n",
                    first.width, first.height, report.load[0], report.load[1]);
  }
  if (const auto& p = report.picture)
    out += fmt::format(
        "{}x{}, {} samples a pixel by {} threads, not denoised: read {} s, build {} s, render {} s; "
        "relMSE {:.2g} (of two seeds at an eighth of the size; by the variance of samples {:.2g}); peak {} "
        "MiB.\n",
        p->width, p->height, p->spp, p->threads, seconds(p->load_s), seconds(p->build_s),
        seconds(p->render_s), p->relmse, p->variance_relmse, megabytes(p->peak_bytes));
  return out;
}

Plot scale_plot(const ScaleReport& report) {
  Plot plot;
  const ScaleResult* any = !report.landscapes.empty() ? &report.landscapes.front()
                           : !report.stones.empty()   ? &report.stones.front()
                                                      : nullptr;
  plot.x = {"triangles in the scene", true};
  plot.y = {any != nullptr ? fmt::format("Msamples/s, {} threads", any->threads) : "Msamples/s", false, true};
  if (!report.landscapes.empty())
    plot.series.push_back(series("mountains, every triangle distinct", report.landscapes));
  if (!report.stones.empty()) plot.series.push_back(series("1,000 instances of a stone", report.stones));
  return plot;
}

std::string scale_json(const ScaleReport& report) {
  nlohmann::ordered_json out;
  out["version"] = CANDELA_VERSION;
  out["load_average"] = report.load;
  auto add = [&](const char* name, const std::vector<ScaleResult>& results) {
    for (const ScaleResult& r : results) out[name].push_back(nlohmann::ordered_json::parse(to_json(r)));
  };
  add("scenes", report.scenes);
  add("landscapes", report.landscapes);
  add("stones", report.stones);
  if (report.picture) out["picture"] = nlohmann::ordered_json::parse(to_json(*report.picture));
  return out.dump(2) + "\n";
}

} // namespace candela
