#include "app/cli/gallery_command.h"

#include "app/console/denoised_picture.h"
#include "app/console/outputs.h"
#include "app/console/picture_output.h"
#include "app/console/progress_bar.h"
#include "app/figures/figure.h"
#include "app/figures/reference_seed.h"
#include "app/platform/data_file.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "imaging/compare.h"
#include "io/images/image_file.h"
#include "io/scene_reader.h"
#include "render/film/film_view.h"
#include "session/offline_render.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <system_error>

namespace candela {

namespace {

constexpr int kQuickSize = 2;
constexpr float kQuickSpp = 1.0f / 16;

struct Rendering {
  Image image;
  RgbPicture picture; ///< as it is displayed
  int spp = 0;        ///< the average with adaptive sampling
  double seconds = 0; ///< including the denoiser's
  bool denoised = false;
};

int mean_samples(const OfflineResult& result) {
  const double pixels = static_cast<double>(result.film.width()) * result.film.height();
  return static_cast<int>(std::lround(static_cast<double>(result.rays.samples) / pixels));
}

class GalleryMaker {
public:
  explicit GalleryMaker(const GalleryOptions& options) : options_(options), bar_(options.quiet) {}

  /// Collected, because a figure that cannot be written must not end the others.
  ExitCode make(const std::vector<const GalleryFigure*>& figures) {
    std::vector<PlannedOutput> outputs;
    for (const GalleryFigure* figure : figures) outputs.push_back({"gallery", path_of(*figure)});
    check_outputs(outputs, {options_.file});
    for (const GalleryFigure* figure : figures) total_ += work_of(*figure);
    for (const GalleryFigure* figure : figures) {
      name_ = figure->name;
      const std::string path = path_of(*figure);
      const RgbPicture picture = figure->plain
                                     ? render(*figure, document_of(*figure, figure->panels[0])).picture
                                     : draw_figure(compose(*figure), face_);
      writer_.attempt(path, [&] {
        write_srgb8_image(picture.width, picture.height, picture.rgb, path);
        bar_.finish(path);
      });
    }
    return writer_.code();
  }

private:
  std::string path_of(const GalleryFigure& figure) const {
    return fmt::format("{}/{}.png", options_.folder, figure.name);
  }

  int scaled_spp(int spp) const {
    const float scale = options_.spp_scale * (options_.quick ? kQuickSpp : 1);
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(spp) * static_cast<double>(scale))));
  }

  Document document_of(const GalleryFigure& figure, const GalleryPanel& panel) {
    auto [found, is_new] = scenes_.try_emplace(panel.scene);
    if (is_new) found->second = read_scene(panel.scene).document;
    Document document = found->second;
    for (const std::string& setting : panel.settings) apply_setting(document, setting);
    FilmSettings& film = document.settings.film;
    if (figure.size.x > 0) film.width = figure.size.x, film.height = figure.size.y;
    if (options_.quick) {
      film.width = std::max(film.width / kQuickSize, 1);
      film.height = std::max(film.height / kQuickSize, 1);
    }
    StopSettings& stop = document.settings.stop;
    const int scenes_own = stop.spp > 0 ? stop.spp : StopSettings{}.spp;
    stop = {};
    stop.spp = scaled_spp(panel.spp > 0 ? panel.spp : scenes_own);
    if (auto problem = document_problem(document); !problem.empty())
      throw Error(ExitCode::bad_input,
                  fmt::format("gallery: figure '{}': {}: correct its settings", figure.name, problem));
    return document;
  }

  Document reference_of(const GalleryFigure& figure) {
    GalleryPanel panel = figure.panels[0];
    // The settings that all panels share: those of one panel without its own.
    std::erase_if(panel.settings, [&](const std::string& s) {
      return std::ranges::any_of(figure.panels, [&](const GalleryPanel& other) {
        return std::ranges::find(other.settings, s) == other.settings.end();
      });
    });
    panel.settings.insert(panel.settings.end(), figure.reference->settings.begin(),
                          figure.reference->settings.end());
    panel.spp = figure.reference->spp;
    Document document = document_of(figure, panel);
    document.settings.sampler.seed ^= kReferenceSeed;
    return document;
  }

  /// Pixels times samples, for the progress bar.
  double work_of(const GalleryFigure& figure) {
    auto work = [](const Document& d) {
      return static_cast<double>(d.settings.film.width) * d.settings.film.height * d.settings.stop.spp;
    };
    double sum = figure.reference ? work(reference_of(figure)) : 0;
    for (const GalleryPanel& panel : figure.panels) {
      const Document document = document_of(figure, panel);
      sum += work(document);
      if (!figure.plot) continue;
      for (int spp : figure.plot->spp) sum += work(document) / document.settings.stop.spp * scaled_spp(spp);
    }
    return sum;
  }

  Rendering render(const GalleryFigure& figure, const Document& document) {
    const double work = static_cast<double>(document.settings.film.width) * document.settings.film.height *
                        document.settings.stop.spp;
    OfflineOptions offline;
    offline.pass.threads = options_.threads;
    offline.progress = [&](const OfflineProgress& p) {
      bar_.update((done_ + work * p.fraction) / total_, fmt::format("{}, {} spp", name_, p.spp));
    };
    OfflineResult result = render_document(document, offline);
    done_ += work;
    if (result.nonfinite.count > 0)
      say("candela: warning: figure '{}': {} samples were not finite and are left out\n", figure.name,
          result.nonfinite.count);
    Rendering out{view_image(result.film, document.settings.view),
                  {},
                  mean_samples(result),
                  result.render_seconds,
                  false};
    if (auto denoised = denoised_picture(document, result, offline.pass)) {
      out.image = std::move(denoised->image);
      out.seconds += denoised->seconds;
      out.denoised = true;
    }
    out.picture = {
        out.image.width, out.image.height,
        displayed_srgb8(out.image, document.settings.display, document.settings.view, result.display_scale)};
    return out;
  }

  Figure compose(const GalleryFigure& source) {
    std::optional<Rendering> reference;
    if (source.reference) reference = render(source, reference_of(source));
    Figure figure;
    figure.title = source.title;
    if (options_.quick && source.size.x > 0)
      figure.picture_width = source.size.x; // the layout of the full figure
    for (Box box : source.details) {
      if (options_.quick)
        box = {box.x / kQuickSize, box.y / kQuickSize, std::max(box.width / kQuickSize, 1),
               std::max(box.height / kQuickSize, 1)};
      figure.details.push_back(box);
    }
    std::vector<FigurePanel> pictures, differences;
    for (const GalleryPanel& panel : source.panels) {
      const Rendering made = render(source, document_of(source, panel));
      std::vector<std::string> caption{
          fmt::format("{} spp, {}{:.2f} s", made.spp, made.denoised ? "denoised, " : "", made.seconds)};
      if (reference)
        caption.push_back("relMSE " + plot_number(relative_mse(made.image.pixels, reference->image.pixels)));
      pictures.push_back({panel.label, caption, made.picture, std::nullopt, std::nullopt});
      if (source.difference)
        differences.push_back(
            {"",
             {},
             {made.image.width, made.image.height, relative_error_picture(made.image, reference->image)},
             std::nullopt,
             color_bar(ColorMap::magma, {1e-3, 1, true}, "relative error")});
    }
    if (reference && source.reference->show) {
      pictures.push_back({"Reference",
                          {fmt::format("{} spp, {:.2f} s", reference->spp, reference->seconds)},
                          reference->picture,
                          std::nullopt,
                          std::nullopt});
      if (source.difference) differences.emplace_back();
    }
    // Row by row: pictures, then their differences below.
    const std::size_t columns =
        source.columns > 0 ? static_cast<std::size_t>(source.columns) : pictures.size();
    figure.columns = static_cast<int>(std::min(columns, pictures.size()));
    for (std::size_t first = 0; first < pictures.size(); first += columns)
      for (auto* row : {&pictures, &differences})
        for (std::size_t i = first; i < std::min(first + columns, row->size()); ++i)
          figure.panels.push_back(std::move((*row)[i]));
    if (source.plot) figure.panels.push_back(plot_panel(source, *reference));
    return figure;
  }

  FigurePanel plot_panel(const GalleryFigure& source, const Rendering& reference) {
    Plot plot;
    plot.x = {source.plot->over_seconds ? "seconds" : "samples a pixel", true};
    plot.y = {"relMSE", true};
    for (const GalleryPanel& panel : source.panels) {
      PlotSeries series{panel.label, {}, false};
      int last = 0;
      for (int spp : source.plot->spp) {
        Document document = document_of(source, panel);
        document.settings.stop.spp = scaled_spp(spp);
        if (document.settings.stop.spp == last) continue; // after scaling, some counts are equal
        last = document.settings.stop.spp;
        const Rendering made = render(source, document);
        series.points.push_back({source.plot->over_seconds ? made.seconds : static_cast<double>(made.spp),
                                 relative_mse(made.image.pixels, reference.image.pixels)});
      }
      plot.series.push_back(std::move(series));
    }
    plot.series.push_back(inverse_guide(plot, source.plot->over_seconds ? "1/t" : "1/N"));
    FigurePanel panel;
    panel.plot = std::move(plot);
    panel.whole_row = true;
    return panel;
  }

  const GalleryOptions& options_;
  ProgressBar bar_;
  OutputWriter writer_;
  Typeface face_ = Typeface::installed();
  std::map<std::string, Document> scenes_;
  std::string name_;
  double done_ = 0, total_ = 0;
};

std::vector<const GalleryFigure*> chosen(const std::vector<GalleryFigure>& all,
                                         const std::vector<std::string>& names) {
  std::vector<const GalleryFigure*> out;
  std::vector<std::string_view> known;
  for (const GalleryFigure& figure : all) known.push_back(figure.name);
  for (const std::string& name : names) {
    const auto found = std::ranges::find(all, name, &GalleryFigure::name);
    if (found == all.end()) {
      const std::string near = nearest_name(name, known);
      throw usage_error(fmt::format("gallery {}", name), "there is no such figure",
                        near.empty() ? "see `candela gallery --list`"
                                     : fmt::format("did you mean '{}'?", near));
    }
    out.push_back(&*found);
  }
  if (names.empty())
    for (const GalleryFigure& figure : all) out.push_back(&figure);
  return out;
}

} // namespace

int run_gallery(const GalleryOptions& options) {
  const std::string file =
      options.file.empty() ? find_data_file("scenes/gallery.json").string() : options.file;
  const std::vector<GalleryFigure> all = read_gallery(file);
  const std::vector<const GalleryFigure*> figures = chosen(all, options.names);
  if (options.list) {
    std::string list;
    for (const GalleryFigure* figure : figures)
      list += fmt::format("{:<24} {}\n", figure->name,
                          !figure->title.empty()
                              ? figure->title
                              : std::filesystem::path(figure->panels[0].scene).filename().string());
    print_result(list);
    return 0;
  }
  std::error_code failed;
  std::filesystem::create_directories(options.folder, failed);
  if (failed)
    throw output_error(options.folder, failed.message(), "name a folder that you may write to with -o");
  return static_cast<int>(GalleryMaker(options).make(figures));
}

} // namespace candela
