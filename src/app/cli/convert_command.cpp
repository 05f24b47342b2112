#include "app/cli/convert_command.h"

#include "app/console/outputs.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "io/files/text_file.h"
#include "io/scene_export.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace candela {

int run_convert(const SceneOptions& options, const std::string& output) {
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
