#include "app/cli/convert_command.h"

#include "app/console/outputs.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "io/files/text_file.h"
#include "io/scene_export.h"
#include "io/volumes/cvol_file.h"
#include "io/volumes/volume_reader.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace candela {

namespace {

/// A grid of densities in Candela's own format.
int convert_volume(const std::string& input, const std::string& output) {
  if (lower_ending(output) != ".cvol")
    throw usage_error(output, "volumes are written as .cvol", "name a file that ends in .cvol");
  check_outputs({{"convert", output}});
  WarningList warnings;
  const auto grid = read_volume(input, warnings);
  for (const Warning& warning : warnings.warnings()) say("candela: warning: {}\n", warning.text);
  write_cvol(*grid, output);
  say("candela: wrote {}: {} x {} x {} cells\n", output, grid->cells.x, grid->cells.y, grid->cells.z);
  return 0;
}

} // namespace

int run_convert(const SceneOptions& options, const std::string& output) {
  if (is_volume_name(options.path)) return convert_volume(options.path, output);
  if (lower_ending(output) != ".json")
    throw usage_error(output, "scenes are written as Candela JSON", "name a file that ends in .json");
  std::error_code failed;
  if (std::filesystem::equivalent(options.path, output, failed))
    throw usage_error(output, "it is the scene that is to be converted", "give another name");
  check_outputs({{"convert", output}});
  LoadedScene loaded = load_scene(options);
  for (const std::string& picture : loaded.output_files)
    say("candela: warning: {}: the job's output {} is not part of a scene: left out\n", options.path,
        picture);
  for (const ExportedFile& file : export_candela_json(std::move(loaded.document), output))
    say("candela: copied {} to {}\n", file.from, file.to);
  say("candela: wrote {}\n", output);
  return 0;
}

} // namespace candela
