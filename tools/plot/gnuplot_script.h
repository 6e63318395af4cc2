#pragma once

#include <string>

#include "tools/plot/plot.h"

namespace talus {

/// Throws std::invalid_argument if the plot's numbers do not fit together.
void check(const Plot& plot);

/// The input with which gnuplot writes the plot as SVG to its standard output, data included.
std::string gnuplot_script(const Plot& plot);

}  // namespace talus
