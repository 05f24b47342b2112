#pragma once
// A line plot as a widget, which shows the values under the mouse. It has neither pan nor zoom.

#include "app/figures/plot.h"
#include "app/ui/widgets.h"

namespace candela {

/// Draws the plot into the current ImGui window, as wide as the free space and `height` pixels high (at the
/// interface's scale 1), and records it under `name`. Under the mouse it shows, for each series, the value of
/// the point with the nearest x.
void plot_widget(Ui& ui, const char* name, const Plot& plot, float height);

/// The text of a read-out: label, x and y of the series' visible point with x nearest to `x` (on a
/// logarithmic axis: nearest in ratio); empty without points.
std::string plot_readout(const Plot& plot, const PlotSeries& series, double x);

} // namespace candela
