#include "io/obj/map_statement.h"

#include "io/files/text_file.h"
#include "io/obj/obj_line.h"

#include <algorithm>

namespace candela {

namespace {

struct Option {
  std::string_view name;
  int least, most; ///< number of arguments; optional ones are numbers
};
constexpr Option kOptions[] = {{"-blendu", 1, 1}, {"-blendv", 1, 1},    {"-bm", 1, 1},      {"-boost", 1, 1},
                               {"-cc", 1, 1},     {"-clamp", 1, 1},     {"-imfchan", 1, 1}, {"-mm", 2, 2},
                               {"-o", 1, 3},      {"-s", 1, 3},         {"-t", 1, 3},       {"-texres", 1, 1},
                               {"-type", 1, 1},   {"-colorspace", 1, 1}};

} // namespace

MapStatement read_map_statement(std::string_view words) {
  MapStatement out;
  std::string_view rest = trimmed(words);
  while (rest.starts_with('-')) {
    std::string_view after = rest;
    const std::string_view name = next_word(after);
    const auto* option = std::ranges::find(kOptions, name, &Option::name);
    if (option == std::end(kOptions)) break;
    double values[3] = {0, 0, 0};
    int count = 0;
    for (; count < option->most; ++count) {
      std::string_view next = after;
      const std::string_view word = next_word(next);
      const bool number = parse_real(word, values[count]) == RealWord::good;
      // The last word is the file's name even if it looks like an option or a number.
      if (word.empty() || (count >= option->least && (!number || trimmed(next).empty()))) break;
      after = next;
    }
    if (name == "-o")
      out.offset = {values[0], values[1]};
    else if (name == "-s") // what is left out is 1
      out.scale = {values[0], count > 1 ? values[1] : 1.0};
    else
      out.ignored.push_back(name);
    rest = trimmed(after);
  }
  out.file = rest;
  return out;
}

} // namespace candela
