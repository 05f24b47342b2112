#pragma once
// A line plot among the panels' widgets: pan-free, zoom-free, but it tells the numbers under the mouse.

#include "app/figures/plot.h"
#include "app/ui/widgets.h"

namespace candela {

/// Draws the plot into the current ImGui window, as wide as what is free of it and `height` pixels high (at
/// the interface's scale 1), and records it under `name`. The mouse on it shows, for each series, the value
/// of the point whose x is nearest.
void plot_widget(Ui& ui, const char* name, const Plot& plot, float height);

/// The line of a read-out: label, x and y of the series' shown point nearest in x to `x` (on a logarithmic
/// axis: nearest in ratio); empty if it has none.
std::string plot_readout(const Plot& plot, const PlotSeries& series, double x);

} // namespace candela
