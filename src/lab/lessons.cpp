#include "lab/lessons.h"

#include <algorithm>

namespace candela {

namespace {

constexpr LessonInfo kLessons[] = {
    {"pi", "Pi by rejection",
     "The error of independent points falls as 1/sqrt(N): a digit more costs a hundred times the points. "
     "Well-distributed points do better."},
    {"solid-angle", "Solid angle of a disc",
     "One answer by four densities: the more samples hit and the closer the pdf follows the integrand, the "
     "smaller the standard deviation."},
    {"integral", "Integral of a function",
     "With x sampled in proportion to the function, f / pdf hardly varies: increase the cells to reduce the "
     "standard deviation. Smooth functions gain most from well-distributed points."},
    {"points", "Points of the samplers",
     "Count the points in each box of the grid: one in every elementary interval is what makes a (0,2)-net. "
     "Two dimensions that are not sampled together show how they are padded."},
    {"warps", "Maps of the square",
     "The histogram must look like the density next to it: a p-value below a millionth, with independent "
     "samples, means that the samples do not follow the pdf."},
    {"brdf", "Lobes of a material",
     "Turn the view towards grazing: the lobe stretches, and the albedo must not exceed 1. Directions by "
     "the material follow the lobe, others waste samples on directions that reflect little."},
    {"medium", "A slab of matter",
     "With an albedo of 1 and a deep slab nearly all light comes back, after many collisions; forward "
     "scattering lets it through. Free flights are exponential: most are shorter than the mean."},
    {"lens", "Lenses of many elements",
     "Open the stop: the film's corners darken faster than cos^4, and the spot of a point in focus, which a "
     "thin lens draws sharp, keeps the size of the aberrations. Stop down: the two agree."},
};

} // namespace

std::span<const LessonInfo> lessons() { return kLessons; }

const LessonInfo& lesson(std::string_view name) {
  return *std::ranges::find(kLessons, name, &LessonInfo::name);
}

} // namespace candela
